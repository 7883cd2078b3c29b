// SPDX-License-Identifier: MIT
//
// Fills the table of directions: see direction_table.h.

#include "hull/direction_table.h"

#include "hull/support_climb.h"

// More cells than this no longer fit a second-level cache beside the blocks.
#define MAX_SIDE 512u

uint32_t tl_hull_table_side(uint32_t vertex_count)
{
    uint32_t side = (uint32_t)(2.0f * sqrtf((float)vertex_count)) + 1;
    return side < MAX_SIDE ? side : MAX_SIDE;
}

static tl_vec3 middle_of_cell(const tl_hull *hull, uint32_t row, uint32_t column)
{
    float side = (float)hull->table_cells;
    float u = 2.0f * ((float)column + 0.5f) / side - 1.0f;
    float v = 2.0f * ((float)row + 0.5f) / side - 1.0f;
    float z = 1.0f - fabsf(u) - fabsf(v);
    if (z < 0.0f) {
        float folded = tl_octahedron_fold(u, v);
        v = tl_octahedron_fold(v, u);
        u = folded;
    }
    return tl_vec3_make(u / hull->table_scale.x, v / hull->table_scale.y, z / hull->table_scale.z);
}

void tl_hull_fill_table(tl_hull *hull)
{
    uint32_t *table = (uint32_t *)(void *)((char *)hull + hull->table);
    uint32_t block = 0;
    for (uint32_t row = 0; row < hull->table_cells; row++) {
        for (uint32_t i = 0; i < hull->table_cells; i++) {
            // Back and forth, so that each cell starts from a neighbour's answer.
            uint32_t column = row % 2 == 0 ? i : hull->table_cells - 1 - i;
            tl_climber climber = tl_climber_make(middle_of_cell(hull, row, column));
            tl_hull_climb(hull, &climber, &block); // where it ends will do, proven or not
            table[row * hull->table_cells + column] = block;
        }
    }
}
