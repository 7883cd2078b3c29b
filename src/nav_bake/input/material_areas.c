// SPDX-License-Identifier: MIT
//
// Materials give triangles their areas: one lookup each, before anything is voxelized.

#include "base/exact_floats.h"

#include <talus/nav_bake.h>

void tl_nav_areas_from_materials(const tl_mesh_view *mesh, const uint8_t *material_areas, uint32_t material_count,
                                 uint8_t *areas_out)
{
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t material = mesh->materials != NULL ? mesh->materials[i] : 0;
        areas_out[i] = material < material_count ? material_areas[material] : TL_NAV_WALKABLE_AREA;
    }
}
