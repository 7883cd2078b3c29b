// SPDX-License-Identifier: MIT
//
// Welding: vertices that are the same point become one index.
//
// A hash grid with cells as wide as the tolerance holds the vertices that were kept so far. Each vertex in turn looks
// into the 27 cells around it for the earliest kept vertex within the tolerance. Kept vertices lie more than a
// tolerance apart, so that a cell holds a bounded number of them and the whole is linear. Rejected: joining
// transitively (union-find), by which a finely tessellated curve collapses into one point. With tolerance 0 see
// weld_points.c.

#include "mesh/weld.h"

#include "base/assert.h"
#include "math/point_grid.h"

static uint32_t find_earliest(const tl_point_grid *grid, const tl_vec3 *vertices, uint32_t vertex, tl_point_cell cell)
{
    uint32_t best = TL_WELD_UNUSED;
    for (int around = 0; around < 27; around++) {
        uint32_t kept = grid->slots[tl_point_grid_slot(grid, cell, around)];
        for (; kept != TL_POINT_GRID_NONE; kept = grid->next[kept]) {
            if (kept < best && tl_points_are_within(vertices[kept], vertices[vertex], grid->distance)) {
                best = kept;
            }
        }
    }
    return best;
}

tl_result tl_weld(const tl_mesh_view *view, float tolerance, tl_stage *stage, tl_arena *arena, uint32_t *representative)
{
    const uint32_t size = tl_point_grid_slots(view->vertex_count); // TL_MAX_MESH_VERTICES is below 2^31
    uint32_t *slots = TL_PUSH(arena, uint32_t, size), *next = TL_PUSH(arena, uint32_t, view->vertex_count);
    if (slots == NULL || next == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_point_grid grid = tl_point_grid_make((double)tolerance, slots, size, next);
    for (uint32_t v = 0; v < view->vertex_count; v++) {
        // 27 cells a vertex: a step is an eighth of the usual one.
        if (v % (TL_STAGE_STEP / 8) == 0) {
            TL_TRY(tl_stage_add(stage, v > 0 ? TL_STAGE_STEP / 8 : 0));
        }
        if (representative[v] == TL_WELD_UNUSED) {
            continue;
        }
        const tl_point_cell cell = tl_point_grid_cell(&grid, view->vertices[v]);
        representative[v] = find_earliest(&grid, view->vertices, v, cell);
        if (representative[v] == TL_WELD_UNUSED) {
            tl_point_grid_keep(&grid, cell, v);
            representative[v] = v;
        }
    }
    return TL_OK;
}
