// SPDX-License-Identifier: MIT
//
// The kernels of a ray against a hull's planes, one per instruction set.

#ifndef TALUS_SRC_HULL_RAY_H
#define TALUS_SRC_HULL_RAY_H

#include <talus/hull.h>

// As tl_hull_clip_ray.
typedef bool tl_ray_planes_fn(const tl_hull *hull, const double origin[3], const double direction[3], double max_t,
                              double *t_out, uint32_t *face_out);

tl_ray_planes_fn tl_ray_planes_scalar;
#if defined(__x86_64__) && defined(__GNUC__)
tl_ray_planes_fn tl_ray_planes_sse42, tl_ray_planes_avx2, tl_ray_planes_avx512;
#endif

// Of 0 scalar, 1 SSE4.2, 2 AVX2, 3 AVX-512: NULL where the machine has it not.
tl_ray_planes_fn *tl_ray_planes_for(int level);

#endif
