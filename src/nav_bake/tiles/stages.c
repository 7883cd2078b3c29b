// SPDX-License-Identifier: MIT
//
// Freeing a tile's intermediate data.

#include "base/exact_floats.h"

#include <talus/nav_bake.h>

#include <string.h>

void tl_nav_stages_free(tl_nav_stages *stages)
{
    if (stages == NULL) {
        return;
    }
    tl_nav_heightfield_free(&stages->heightfield);
    tl_nav_compact_free(&stages->compact);
    tl_nav_contours_free(&stages->contours);
    tl_polygon_mesh_free(&stages->polygons);
    tl_nav_detail_free(&stages->detail);
    memset(stages, 0, sizeof *stages);
}
