// SPDX-License-Identifier: MIT
//
// The scans of farthest.h with four points in a register, which take half of the instructions: see there.

#ifndef TALUS_SRC_CONVEX_SCAN_FOUR_H
#define TALUS_SRC_CONVEX_SCAN_FOUR_H

#include "base/cpu.h"
#include "math/vec3d.h"

#include <talus/convex.h>

// Points of A - B by their coordinates.
typedef struct tl_placed_points {
    double x[TL_KEPT_POINTS], y[TL_KEPT_POINTS], z[TL_KEPT_POINTS];
} tl_placed_points;

// Vertices in a row.
typedef struct tl_vertex_row {
    const tl_vec3 *points;
    uint32_t count;
} tl_vertex_row;

#if TL_CPU_LEVELS >= 2

// Of 4 .. 4 * TL_SCAN_FOURS points: a mask of them is one word.
enum { TL_SCAN_FOURS = 8 };

uint32_t tl_scan_farthest_avx2(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction);
void tl_scan_reach_avx2(const tl_vec3 *points, uint32_t count, const tl_vec3d *directions, int direction_count,
                        double *reach_out);
double tl_scan_image_sq_avx2(const tl_vec3 *points, uint32_t count, const tl_frame *map);

// Differences of vertices of A and B, in A's frame, of at least four pairs. False where a row has no such vertex.
bool tl_scan_place_avx2(const tl_frame *b_to_a, tl_vertex_row row_a, tl_vertex_row row_b, const uint16_t (*vertices)[2],
                        uint32_t count, tl_placed_points *points_out);
// How near the planes of four to 64 triangles are to the origin, as polytope_hold.c has it. Returns the first that is
// nearest; `count` where the origin is outside of one.
uint32_t tl_scan_nearest_avx2(const tl_placed_points *points, const uint8_t (*corners)[3], uint32_t count,
                              double turned, double *nearness_out);

// The first of a hull's planes whose normals have the largest product with a direction, of at most TL_SCAN_PLANES in
// blocks of so many lanes.
enum { TL_SCAN_PLANES = 64 };
uint32_t tl_scan_planes_avx2(const double *blocks, uint32_t count, uint32_t lanes, const tl_vec3d *direction);

#endif

#endif
