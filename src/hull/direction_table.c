// SPDX-License-Identifier: MIT
//
// Where a climb starts: the vertex that is farthest for the middle of the direction's cell in an octahedral map.
//
// The octahedron unfolds to a square without branches and wastes no cell, unlike a grid over the cube's volume. The
// direction is scaled by the hull's box first: the support of a stretched body in direction d is that of the body in
// the stretched direction, so this makes a needle's table as even as a ball's.
// Source of the map: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3, 2014.

#include "hull/support.h"

// More cells than this no longer fit a second-level cache beside the blocks.
#define MAX_SIDE 512u

static inline float fold(float near, float far)
{
    float folded = 1.0f - fabsf(far);
    return near < 0.0f ? -folded : folded;
}

static inline uint32_t cell_of(float u, uint32_t side)
{
    float cell = (u * 0.5f + 0.5f) * (float)side;
    uint32_t index = cell > 0.0f ? (uint32_t)cell : 0;
    return index < side ? index : side - 1;
}

uint32_t tl_hull_table_block(const tl_hull *hull, tl_vec3 direction)
{
    const uint32_t *table = (const uint32_t *)(const void *)((const char *)hull + hull->table);
    tl_vec3 d = tl_mul(direction, hull->table_scale);
    float size = fabsf(d.x) + fabsf(d.y) + fabsf(d.z);
    float inverse = size >= 1e-30f ? 1.0f / size : 0.0f; // only where to start: any cell is right
    float u = d.x * inverse, v = d.y * inverse;
    if (d.z < 0.0f) {
        float folded = fold(u, v);
        v = fold(v, u);
        u = folded;
    }
    return table[cell_of(v, hull->table_cells) * hull->table_cells + cell_of(u, hull->table_cells)];
}

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
        float folded = fold(u, v);
        v = fold(v, u);
        u = folded;
    }
    return tl_vec3_make(u / hull->table_scale.x, v / hull->table_scale.y, z / hull->table_scale.z);
}

void tl_hull_fill_table(tl_hull *hull)
{
    uint32_t *table = (uint32_t *)(void *)((char *)hull + hull->table);
    uint32_t vertex = 0;
    for (uint32_t row = 0; row < hull->table_cells; row++) {
        for (uint32_t i = 0; i < hull->table_cells; i++) {
            // Back and forth, so that each cell starts from a neighbour's answer.
            uint32_t column = row % 2 == 0 ? i : hull->table_cells - 1 - i;
            uint32_t start = tl_hull_vertex_blocks(hull)[vertex];
            vertex = tl_hull_climb(hull, middle_of_cell(hull, row, column), start);
            table[row * hull->table_cells + column] = tl_hull_vertex_blocks(hull)[vertex];
        }
    }
}
