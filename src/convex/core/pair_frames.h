// SPDX-License-Identifier: MIT
//
// The frames of two poses at once: that of A in the world, and of B in A.

#ifndef TALUS_SRC_CONVEX_PAIR_FRAMES_H
#define TALUS_SRC_CONVEX_PAIR_FRAMES_H

#include "math/simd2d.h"
#include "math/vec3d.h"

#include <assert.h>

#if TL_HAS_F64X2 && !defined(__wasm__) // whose module is downloaded: one by one takes fewer bytes

// The elements of a frame are stored by twos, in their order, as compilers load them again: a load of two numbers that
// were stored apart waits for both stores.
static_assert(sizeof(tl_frame) == 12 * sizeof(double), "six times two");

static inline void tl_frame_store(tl_frame *frame, const tl_f64x2 rows[4], double last, tl_vec3d origin)
{
    double *const at = (double *)frame;
    for (int i = 0; i < 4; i++) {
        tl_f64x2_store(at + 2 * i, rows[i]);
    }
    tl_f64x2_store(at + 8, tl_f64x2_of_two(last, origin.x));
    tl_f64x2_store(at + 10, tl_f64x2_of_two(origin.y, origin.z));
}

// tl_frame_set of two rotations, A to the world and B to A, one in each lane; `offset` is from A to B in the world.
static inline void tl_pair_frames_set(tl_frame *a_to_world, tl_frame *b_to_a, tl_quatd p, tl_quatd q, tl_vec3d position,
                                      tl_vec3d offset)
{
    const tl_f64x2 s = tl_f64x2_div(tl_f64x2_all(2.0), tl_f64x2_of_two(p.length_sq, q.length_sq)),
                   one = tl_f64x2_all(1.0), qx = tl_f64x2_of_two(p.x, q.x), qy = tl_f64x2_of_two(p.y, q.y),
                   qz = tl_f64x2_of_two(p.z, q.z), qw = tl_f64x2_of_two(p.w, q.w), x = tl_f64x2_mul(s, qx),
                   y = tl_f64x2_mul(s, qy), z = tl_f64x2_mul(s, qz);
    const tl_f64x2 xx = tl_f64x2_mul(x, qx), yy = tl_f64x2_mul(y, qy), zz = tl_f64x2_mul(z, qz),
                   xy = tl_f64x2_mul(x, qy), xz = tl_f64x2_mul(x, qz), yz = tl_f64x2_mul(y, qz),
                   xw = tl_f64x2_mul(x, qw), yw = tl_f64x2_mul(y, qw), zw = tl_f64x2_mul(z, qw);
    const tl_f64x2 e[9] = {
        tl_f64x2_sub(one, tl_f64x2_add(yy, zz)), tl_f64x2_sub(xy, zw), tl_f64x2_add(xz, yw), tl_f64x2_add(xy, zw),
        tl_f64x2_sub(one, tl_f64x2_add(xx, zz)), tl_f64x2_sub(yz, xw), tl_f64x2_sub(xz, yw), tl_f64x2_add(yz, xw),
        tl_f64x2_sub(one, tl_f64x2_add(xx, yy))
    };
    tl_f64x2 rows_p[4], rows_q[4];
    double first[9];
    for (int i = 0; i < 4; i++) {
        rows_p[i] = tl_f64x2_lows(e[2 * i], e[2 * i + 1]);
        rows_q[i] = tl_f64x2_highs(e[2 * i], e[2 * i + 1]);
    }
    for (int i = 0; i < 9; i++) {
        first[i] = tl_f64x2_get_x(e[i]);
    }
    const tl_vec3d turned_back = { first[0] * offset.x + first[3] * offset.y + first[6] * offset.z,
                                   first[1] * offset.x + first[4] * offset.y + first[7] * offset.z,
                                   first[2] * offset.x + first[5] * offset.y + first[8] * offset.z };
    tl_frame_store(a_to_world, rows_p, first[8], position);
    tl_frame_store(b_to_a, rows_q, tl_f64x2_get_y(e[8]), turned_back);
}

#else

static inline void tl_pair_frames_set(tl_frame *a_to_world, tl_frame *b_to_a, tl_quatd p, tl_quatd q, tl_vec3d position,
                                      tl_vec3d offset)
{
    tl_frame_set(a_to_world, p, position);
    tl_frame_set(b_to_a, q, tl_frame_rotate_back(a_to_world, offset));
}

#endif

#endif
