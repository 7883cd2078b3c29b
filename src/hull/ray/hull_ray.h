// SPDX-License-Identifier: MIT
//
// The kernels of a ray against a hull's planes, one per instruction set.

#ifndef TALUS_SRC_HULL_RAY_H
#define TALUS_SRC_HULL_RAY_H

#include "base/cpu.h"

#include <talus/hull.h>

// As tl_hull_clip_ray.
typedef bool tl_ray_planes_fn(const tl_hull *hull, const double origin[3], const double direction[3], double max_t,
                              double *t_out, uint32_t *face_out);

tl_ray_planes_fn tl_ray_planes_scalar;
#if TL_CPU_LEVELS >= 1
tl_ray_planes_fn tl_ray_planes_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_ray_planes_fn tl_ray_planes_avx2, tl_ray_planes_avx512;
#endif

// Of a level (base/cpu.h); NULL where this machine or build lacks it.
tl_ray_planes_fn *tl_ray_planes_for(int level);

#endif
