// SPDX-License-Identifier: MIT
//
// Where a climb starts: the vertex that is farthest for the middle of the direction's cell in an octahedral map.
//
// The octahedron unfolds to a square without branches and wastes no cell, unlike a grid over the cube's volume. The
// direction is scaled by the hull's box first: the support of a stretched body in direction d is that of the body in
// the stretched direction, so this makes a needle's table as even as a ball's.
// Source of the map: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3, 2014.

#ifndef TALUS_SRC_HULL_DIRECTION_TABLE_H
#define TALUS_SRC_HULL_DIRECTION_TABLE_H

#include "hull/support.h"

#include <float.h>

static inline float tl_octahedron_fold(float near, float far)
{
    float folded = 1.0f - fabsf(far);
    return near < 0.0f ? -folded : folded;
}

static inline uint32_t tl_octahedron_cell(float u, uint32_t side)
{
    float cell = (u * 0.5f + 0.5f) * (float)side;
    uint32_t index = cell > 0.0f ? (uint32_t)cell : 0;
    return index < side ? index : side - 1;
}

static inline uint32_t tl_hull_table_block(const tl_hull *hull, tl_vec3 direction)
{
    const uint32_t *table = (const uint32_t *)(const void *)((const char *)hull + hull->table);
    tl_vec3 d = tl_mul(direction, hull->table_scale);
    float size = fabsf(d.x) + fabsf(d.y) + fabsf(d.z);
    float inverse = size >= FLT_MIN ? 1.0f / size : 0.0f; // only where to start: any cell is right
    float u = d.x * inverse, v = d.y * inverse;
    if (d.z < 0.0f) {
        float folded = tl_octahedron_fold(u, v);
        v = tl_octahedron_fold(v, u);
        u = folded;
    }
    return table[tl_octahedron_cell(v, hull->table_cells) * hull->table_cells +
                 tl_octahedron_cell(u, hull->table_cells)];
}

#endif
