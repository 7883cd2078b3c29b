// SPDX-License-Identifier: MIT
//
// The end of a tile's intermediate data.

#include <talus/nav_bake.h>

#include <string.h>

void tl_nav_stages_free(tl_nav_stages *stages, const tl_allocator *allocator)
{
    if (stages == NULL) {
        return;
    }
    stages->heightfield.allocator = allocator;
    stages->compact.allocator = allocator;
    stages->contours.allocator = allocator;
    tl_nav_heightfield_free(&stages->heightfield);
    tl_nav_compact_free(&stages->compact);
    tl_nav_contours_free(&stages->contours);
    tl_polygon_mesh_free(&stages->polygons, allocator);
    tl_nav_detail_free(&stages->detail, allocator);
    memset(stages, 0, sizeof *stages);
}
