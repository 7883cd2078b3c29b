// SPDX-License-Identifier: MIT
//
// The vertices of two hulls of four to eight vertices each, placed in A's frame: a support query is eight products for
// each and no rotation, neither of the direction nor of what is found. Half of what GJK waits for in each step.

#ifndef TALUS_SRC_CONVEX_PLACED_PAIR_H
#define TALUS_SRC_CONVEX_PLACED_PAIR_H

#include "convex/core/scan_four.h"

// By coordinates. Of a hull of n vertices, 4 .. 8, places 0 to 3 are vertices 0 to 3, and 4 to 7 the last four.
typedef struct tl_placed_hull {
    double x[8], y[8], z[8];
    uint32_t spare; // 8 - n
} tl_placed_hull;

typedef struct tl_placed_pair {
    tl_placed_hull a, b;
} tl_placed_pair;

static inline uint32_t tl_placed_vertex(const tl_placed_hull *hull, uint32_t place)
{
    return place - (place >> 2) * hull->spare;
}

static inline tl_vec3d tl_placed_point(const tl_placed_hull *hull, uint32_t place)
{
    return tl_vec3d_make(hull->x[place], hull->y[place], hull->z[place]);
}

void tl_placed_pair_set_base(tl_placed_pair *pair, tl_vertex_row a, tl_vertex_row b, const tl_frame *b_to_a);
uint32_t tl_placed_pair_support_base(const tl_placed_pair *pair, double x, double y, double z);

#if TL_CPU_LEVELS >= 2
void tl_placed_pair_set_avx2(tl_placed_pair *pair, tl_vertex_row a, tl_vertex_row b, const tl_frame *b_to_a);
uint32_t tl_placed_pair_support_avx2(const tl_placed_pair *pair, double x, double y, double z);
#endif

static inline void tl_placed_pair_set(tl_placed_pair *pair, tl_vertex_row a, tl_vertex_row b, const tl_frame *b_to_a)
{
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        tl_placed_pair_set_avx2(pair, a, b, b_to_a);
        return;
    }
#endif
    tl_placed_pair_set_base(pair, a, b, b_to_a);
}

// The lowest of the vertices of A farthest along a direction, and of B farthest against it: their places, times 8
// and 1.
static inline uint32_t tl_placed_pair_support(const tl_placed_pair *pair, double x, double y, double z)
{
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        return tl_placed_pair_support_avx2(pair, x, y, z);
    }
#endif
    return tl_placed_pair_support_base(pair, x, y, z);
}

#endif
