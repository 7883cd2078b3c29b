// SPDX-License-Identifier: MIT
//
// Welding: vertices that are the same point become one index.
//
// A hash grid with cells as wide as the tolerance holds the vertices that were kept so far. Each vertex in turn looks
// into the 27 cells around it for the earliest kept vertex within the tolerance. Kept vertices lie more than a
// tolerance apart, so that a cell holds a bounded number of them and the whole is linear. Rejected: joining
// transitively (union-find), by which a finely tessellated curve collapses into one point; sorting along an axis,
// quadratic on a flat wall. With tolerance 0 see weld_points.c.

#include "mesh/weld.h"

#include "base/assert.h"
#include "base/hash.h"

#include <math.h>
#include <string.h>

typedef struct weld_grid {
    const tl_vec3 *vertices;
    double tolerance;
    uint32_t *slots; // first kept vertex of the chain, or TL_WELD_UNUSED
    uint32_t *next;  // [vertex_count] next kept vertex of the same slot
    uint32_t mask;
} weld_grid;

// Cells are numbered in double: where a coordinate is so large that cell numbers lose their last bits, distinct floats
// are farther apart than the tolerance anyway, and equal ones still get the same number.
typedef struct weld_cell {
    double x, y, z;
} weld_cell;

static weld_cell cell_of(const weld_grid *grid, tl_vec3 p)
{
    weld_cell cell = { floor((double)p.x / grid->tolerance), floor((double)p.y / grid->tolerance),
                       floor((double)p.z / grid->tolerance) };
    return cell;
}

static uint64_t cell_bits(double value)
{
    double without_sign_of_zero = value + 0.0;
    uint64_t bits;
    memcpy(&bits, &without_sign_of_zero, sizeof bits);
    return bits;
}

static uint32_t grid_slot(const weld_grid *grid, weld_cell cell)
{
    uint64_t hash = tl_hash_mix(cell_bits(cell.x));
    hash = tl_hash_mix(hash ^ cell_bits(cell.y));
    hash = tl_hash_mix(hash ^ cell_bits(cell.z));
    return (uint32_t)hash & grid->mask;
}

static bool within_tolerance(const weld_grid *grid, uint32_t a, uint32_t b)
{
    double x = (double)grid->vertices[a].x - (double)grid->vertices[b].x;
    double y = (double)grid->vertices[a].y - (double)grid->vertices[b].y;
    double z = (double)grid->vertices[a].z - (double)grid->vertices[b].z;
    return x * x + y * y + z * z <= grid->tolerance * grid->tolerance;
}

static uint32_t earliest_in_slot(const weld_grid *grid, uint32_t slot, uint32_t vertex, uint32_t best)
{
    for (uint32_t kept = grid->slots[slot]; kept != TL_WELD_UNUSED; kept = grid->next[kept]) {
        if (kept < best && within_tolerance(grid, kept, vertex)) {
            best = kept;
        }
    }
    return best;
}

static uint32_t find_earliest(const weld_grid *grid, uint32_t vertex, weld_cell cell)
{
    uint32_t best = TL_WELD_UNUSED;
    for (int i = 0; i < 27; i++) {
        weld_cell near = { cell.x + (i % 3 - 1), cell.y + (i / 3 % 3 - 1), cell.z + (i / 9 - 1) };
        best = earliest_in_slot(grid, grid_slot(grid, near), vertex, best);
    }
    return best;
}

static uint32_t table_size(uint32_t count)
{
    uint32_t size = 16;
    // At most half full; TL_MAX_MESH_VERTICES is below 2^31, so that the size fits 32 bits.
    while (size / 2 < count && size < 0x80000000u) {
        size *= 2;
    }
    return size;
}

tl_result tl_weld(const tl_mesh_view *view, float tolerance, tl_stage *stage, tl_arena *arena, uint32_t *representative)
{
    uint32_t size = table_size(view->vertex_count);
    weld_grid grid = { view->vertices, (double)tolerance, TL_PUSH(arena, uint32_t, size),
                       TL_PUSH(arena, uint32_t, view->vertex_count), size - 1 };
    if (grid.slots == NULL || grid.next == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(grid.slots, 0xff, (size_t)size * sizeof *grid.slots);
    for (uint32_t v = 0; v < view->vertex_count; v++) {
        // 27 cells a vertex: a step is an eighth of the usual one.
        if (v % (TL_STAGE_STEP / 8) == 0) {
            TL_TRY(tl_stage_add(stage, v > 0 ? TL_STAGE_STEP / 8 : 0));
        }
        if (representative[v] == TL_WELD_UNUSED) {
            continue;
        }
        weld_cell cell = cell_of(&grid, view->vertices[v]);
        uint32_t kept = find_earliest(&grid, v, cell);
        if (kept == TL_WELD_UNUSED) {
            uint32_t slot = grid_slot(&grid, cell);
            grid.next[v] = grid.slots[slot];
            grid.slots[slot] = v;
            kept = v;
        }
        representative[v] = kept;
    }
    return TL_OK;
}
