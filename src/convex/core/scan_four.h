// SPDX-License-Identifier: MIT
//
// The scans of farthest.h with four points in a register, which take half of the instructions: see there.

#ifndef TALUS_SRC_CONVEX_SCAN_FOUR_H
#define TALUS_SRC_CONVEX_SCAN_FOUR_H

#include "base/cpu.h"
#include "math/vec3d.h"

#if TL_CPU_LEVELS >= 2

// Of 4 .. 4 * TL_SCAN_FOURS points: a mask of them is one word.
enum { TL_SCAN_FOURS = 8 };

uint32_t tl_scan_farthest_avx2(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction);
void tl_scan_reach_avx2(const tl_vec3 *points, uint32_t count, const tl_vec3d *directions, int direction_count,
                        double *reach_out);
double tl_scan_image_sq_avx2(const tl_vec3 *points, uint32_t count, const tl_frame *map);

#endif

#endif
