// SPDX-License-Identifier: MIT
//
// Depths of two boxes along their 15 axes, three axes a register. The file that includes this names the function.

#include "math/simd4d.h"

// Edges whose cross product is shorter are parallel, and then the faces' normals are as shallow to so much of the size.
#define BOX_PARALLEL 1e-7

// Of three vectors, each times a number.
static inline tl_f64x4 four_sum(const tl_f64x4 v[3], const double s[3])
{
    const tl_f64x4 xy = tl_f64x4_add(tl_f64x4_mul(v[0], tl_f64x4_all(s[0])), tl_f64x4_mul(v[1], tl_f64x4_all(s[1])));
    return tl_f64x4_add(xy, tl_f64x4_mul(v[2], tl_f64x4_all(s[2])));
}

void TL_FIND_BOX_AXES(tl_box_axes *p)
{
    tl_f64x4 turn[3], size[3], columns[3], column_sizes[3];
    for (int i = 0; i < 3; i++) {
        turn[i] = tl_f64x4_load_twos(p->turn[i]);
        size[i] = tl_f64x4_abs(turn[i]);
        columns[i] = tl_f64x4_load_twos(p->columns[i]);
        column_sizes[i] = tl_f64x4_abs(columns[i]);
    }
    const tl_f64x4 half_a = tl_f64x4_load_twos(p->half_a), half_b = tl_f64x4_load_twos(p->half_b),
                   apart = tl_f64x4_load_twos(p->apart);
    const tl_f64x4 faces_a = tl_f64x4_add(half_a, four_sum(column_sizes, p->half_b)),
                   faces_b = tl_f64x4_add(half_b, four_sum(size, p->half_a));
    tl_f64x4_store(p->depths[0], tl_f64x4_sub(faces_a, tl_f64x4_abs(apart)));
    tl_f64x4_store(p->depths[1], tl_f64x4_sub(faces_b, tl_f64x4_abs(four_sum(turn, p->apart))));
    const tl_f64x4 next_b = tl_f64x4_rotate_three(half_b), last_b = tl_f64x4_rotate_three(next_b);
    for (int i = 0; i < 3; i++) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        const tl_f64x4 n1 = tl_f64x4_sub(tl_f64x4_all(0.0), turn[i2]), n2 = turn[i1],
                       length_sq = tl_f64x4_add(tl_f64x4_mul(n1, n1), tl_f64x4_mul(n2, n2)),
                       next_size = tl_f64x4_rotate_three(size[i]), last_size = tl_f64x4_rotate_three(next_size);
        const tl_f64x4 reach_a = tl_f64x4_add(tl_f64x4_mul(tl_f64x4_all(p->half_a[i1]), size[i2]),
                                              tl_f64x4_mul(tl_f64x4_all(p->half_a[i2]), size[i1])),
                       reach_b = tl_f64x4_add(tl_f64x4_mul(next_b, last_size), tl_f64x4_mul(last_b, next_size)),
                       along = tl_f64x4_add(tl_f64x4_mul(n1, tl_f64x4_all(p->apart[i1])),
                                            tl_f64x4_mul(n2, tl_f64x4_all(p->apart[i2]))),
                       deep = tl_f64x4_sub(tl_f64x4_add(reach_a, reach_b), tl_f64x4_abs(along));
        tl_f64x4_store(p->depths[2 + i], tl_f64x4_where_less(tl_f64x4_all(BOX_PARALLEL * BOX_PARALLEL), length_sq,
                                                             tl_f64x4_div(deep, tl_f64x4_sqrt(length_sq)),
                                                             tl_f64x4_all((double)INFINITY)));
    }
}

#undef TL_FIND_BOX_AXES
