// SPDX-License-Identifier: MIT
//
// What the support query's parts share: the climb's blocks and the two ways to answer.
//
// All float estimates here are of edge vectors or of positions relative to the hull's own middle, never of world
// positions, so their error bounds scale with the hull and not with its distance from the origin.

#ifndef TALUS_SRC_HULL_SUPPORT_H
#define TALUS_SRC_HULL_SUPPORT_H

#include "base/arena.h"

#include <talus/hull.h>

// Hulls up to this many vertices are scanned: there the scan and the climb from the table take equally long (SSE2), and
// the mask of candidates is one word.
#define TL_HULL_SCAN_LIMIT 48u

// Directions whose largest component lies between these need no scaling: no product of a component and an edge of a
// hull within TL_MAX_HULL_COORDINATE overflows, and underflow is covered by TL_SUPPORT_UNDERFLOW.
#define TL_SUPPORT_DIRECTION_MIN 9.5367432e-7f // 2^-20
#define TL_SUPPORT_DIRECTION_MAX 1048576.0f    // 2^20

// Each of at most 8 operations on a dot product may underflow by half of the smallest float: 8 * 2^-150 < 2^-145.
#define TL_SUPPORT_UNDERFLOW 2.2420775e-44f // 2^-145

#define TL_CLIMB_LANES       8u
#define TL_CLIMB_MORE        0x80000000u // in the first link: the next block belongs to the same vertex

// Up to eight neighbours of a vertex: the vectors to them and their blocks. Unused lanes repeat a neighbour.
typedef struct tl_climb_block {
    float x[TL_CLIMB_LANES], y[TL_CLIMB_LANES], z[TL_CLIMB_LANES];
    uint32_t link[TL_CLIMB_LANES];
} tl_climb_block;

static inline const uint32_t *tl_hull_vertex_blocks(const tl_hull *hull)
{
    return (const uint32_t *)(const void *)((const char *)hull + hull->vertex_blocks);
}

static inline const float *tl_hull_block_errors(const tl_hull *hull)
{
    return (const float *)(const void *)((const char *)hull + hull->block_errors);
}

static inline const uint32_t *tl_hull_block_vertices(const tl_hull *hull)
{
    return (const uint32_t *)(const void *)((const char *)hull + hull->block_vertices);
}

static inline const tl_climb_block *tl_hull_blocks(const tl_hull *hull)
{
    return (const tl_climb_block *)(const void *)((const char *)hull + hull->blocks);
}

// support_scan.c. Needs scan_count > 0 and a direction in the range above.
uint32_t tl_hull_scan(const tl_hull *hull, tl_vec3 direction);

// support_exact.c. Climbs on the half-edges with exact comparisons, any direction.
uint32_t tl_hull_climb_exact(const tl_hull *hull, tl_vec3 direction, uint32_t vertex);

// direction_table.c; the look-up is in direction_table.h.
// Cells along a side for a hull of so many vertices.
uint32_t tl_hull_table_side(uint32_t vertex_count);
// Fills the table of an otherwise finished hull.
void tl_hull_fill_table(tl_hull *hull);

// layout.c
// Fills in the offsets and the counts that follow from V, F, 2 E and block_count; the size of the whole.
uint64_t tl_hull_lay_out(tl_hull *head);
tl_vec3 tl_hull_edge_vector(tl_vec3 from, tl_vec3 to);
// Bound of the error of direction . edge vector over a block, for a direction with |x| + |y| + |z| = 1.
float tl_hull_block_error(const tl_climb_block *block);
// Row entry `index` of the scan: a vertex relative to the middle of the bounds; beyond V the last vertex again.
tl_vec3 tl_hull_scan_point(const tl_hull *hull, uint32_t index);
float tl_hull_scan_error(const tl_hull *hull);

// mass.c
void tl_hull_measure_mass(tl_hull *hull);

#endif
