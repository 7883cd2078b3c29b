// SPDX-License-Identifier: MIT
//
// One step of quickhull: find what the new point sees, and close the hole with a cone of triangles to the point.
//
// The visible region is flooded from the face that the point is filed under. Its border edges need not be met in order:
// each border vertex starts exactly one of them, so a table by vertex links the cone.

#include "hull/bake/quickhull.h"

#include "base/assert.h"

void tl_quickhull_flood_visible(tl_quickhull *hull, uint32_t first, tl_vec3 eye)
{
    const uint32_t hidden = 2 * ++hull->step, shown = hidden + 1;
    hull->visible_count = 0;
    hull->horizon_count = 0;
    hull->conflicts[first].seen = shown;
    hull->visible[hull->visible_count++] = first;
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        uint32_t face = hull->visible[i];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = tl_half_edge_face(hull->faces[face].across[k]);
            uint32_t *seen = &hull->conflicts[other].seen;
            if (*seen < hidden) {
                double height;
                bool visible = tl_quickhull_side(hull, &hull->faces[other], eye, &height) > 0;
                *seen = visible ? shown : hidden;
                hull->visible[hull->visible_count] = other;
                hull->visible_count += visible;
            }
            hull->horizon[hull->horizon_count] = 4 * face + k;
            hull->horizon_count += *seen == hidden;
        }
    }
}

tl_result tl_quickhull_add_point(tl_quickhull *hull, uint32_t face)
{
    uint32_t point = hull->conflicts[face].farthest;
    tl_quickhull_flood_visible(hull, face, hull->local[point].position);
    TL_TRY(tl_quickhull_reserve(hull, hull->horizon_count));
    hull->created_count = 0;
    for (uint32_t i = 0; i < hull->horizon_count; i++) {
        uint32_t old = tl_half_edge_face(hull->horizon[i]), k = tl_half_edge_corner(hull->horizon[i]);
        uint32_t from = hull->faces[old].vertex[k];
        uint32_t to = hull->faces[old].vertex[k == 2 ? 0 : k + 1];
        uint32_t outer = hull->faces[old].across[k];
        uint32_t created = tl_quickhull_new_face(hull, from, to, point);
        hull->faces[created].across[0] = outer;
        hull->faces[tl_half_edge_face(outer)].across[tl_half_edge_corner(outer)] = 4 * created;
        hull->cone_face[from] = created;
        hull->created[hull->created_count++] = created;
    }
    for (uint32_t i = 0; i < hull->created_count; i++) {
        uint32_t created = hull->created[i];
        uint32_t beside = hull->cone_face[hull->faces[created].vertex[1]];
        hull->faces[created].across[1] = 4 * beside + 2;
        hull->faces[beside].across[2] = 4 * created + 1;
    }
    return TL_OK;
}
