// SPDX-License-Identifier: MIT
//
// One step of quickhull: find what the new point sees, and close the hole with a cone of triangles to the point.
//
// The visible region is flooded from the face that the point is filed under. Its border edges need not be met in order:
// each border vertex starts exactly one of them, so a table by vertex links the cone.

#include "hull/quickhull.h"

#include "base/assert.h"

static void flood_visible(tl_quickhull *hull, uint32_t first, tl_vec3 eye)
{
    hull->stamp++;
    hull->visible_count = 0;
    hull->horizon_count = 0;
    hull->faces[first].stamp = hull->stamp;
    hull->faces[first].visible = true;
    hull->visible[hull->visible_count++] = first;
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        uint32_t face = hull->visible[i];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = tl_half_edge_face(hull->faces[face].across[k]);
            tl_quickhull_face *neighbour = &hull->faces[other];
            if (neighbour->stamp != hull->stamp) {
                double value;
                neighbour->stamp = hull->stamp;
                neighbour->visible = tl_side_plane_test(&neighbour->plane, eye, &value) > 0;
                if (neighbour->visible) {
                    hull->visible[hull->visible_count++] = other;
                }
            }
            if (!neighbour->visible) {
                hull->horizon[hull->horizon_count++] = 3 * face + k;
            }
        }
    }
}

tl_result tl_quickhull_add_point(tl_quickhull *hull, uint32_t face)
{
    uint32_t point = hull->faces[face].farthest;
    flood_visible(hull, face, hull->points[point]);
    TL_TRY(tl_quickhull_reserve(hull, hull->horizon_count));
    hull->created_count = 0;
    for (uint32_t i = 0; i < hull->horizon_count; i++) {
        uint32_t edge = hull->horizon[i];
        uint32_t old = tl_half_edge_face(edge), k = edge % 3;
        uint32_t from = hull->faces[old].vertex[k];
        uint32_t to = hull->faces[old].vertex[(k + 1) % 3];
        uint32_t outer = hull->faces[old].across[k];
        uint32_t created = tl_quickhull_new_face(hull, from, to, point);
        hull->faces[created].across[0] = outer;
        hull->faces[tl_half_edge_face(outer)].across[outer % 3] = 3 * created;
        hull->cone_face[from] = created;
        hull->created[hull->created_count++] = created;
    }
    for (uint32_t i = 0; i < hull->created_count; i++) {
        uint32_t created = hull->created[i];
        uint32_t beside = hull->cone_face[hull->faces[created].vertex[1]];
        hull->faces[created].across[1] = 3 * beside + 2;
        hull->faces[beside].across[2] = 3 * created + 1;
    }
    return TL_OK;
}
