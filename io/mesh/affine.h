// SPDX-License-Identifier: MIT
//
// Affine maps of scene nodes, in double, so that a level deep in a tree of nodes is placed as exactly as its vertices
// are stored.

#ifndef TALUS_IO_AFFINE_H
#define TALUS_IO_AFFINE_H

#include <talus/vec.h>

/// Three rows of four.
typedef struct tl_affine {
    double row[3][4];
} tl_affine;

static inline tl_affine tl_affine_identity(void)
{
    return (tl_affine){ { { 1.0, 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0, 0.0 } } };
}

/// First b, then a.
static inline tl_affine tl_affine_multiply(const tl_affine *a, const tl_affine *b)
{
    tl_affine result;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            result.row[i][k] = a->row[i][0] * b->row[0][k] + a->row[i][1] * b->row[1][k] + a->row[i][2] * b->row[2][k] +
                               (k == 3 ? a->row[i][3] : 0.0);
        }
    }
    return result;
}

static inline tl_vec3 tl_affine_apply(const tl_affine *a, double x, double y, double z)
{
    return tl_vec3_make((float)(a->row[0][0] * x + a->row[0][1] * y + a->row[0][2] * z + a->row[0][3]),
                        (float)(a->row[1][0] * x + a->row[1][1] * y + a->row[1][2] * z + a->row[1][3]),
                        (float)(a->row[2][0] * x + a->row[2][1] * y + a->row[2][2] * z + a->row[2][3]));
}

/// Whether it turns inside out.
static inline bool tl_affine_mirrors(const tl_affine *a)
{
    double x = a->row[1][1] * a->row[2][2] - a->row[1][2] * a->row[2][1];
    double y = a->row[1][2] * a->row[2][0] - a->row[1][0] * a->row[2][2];
    double z = a->row[1][0] * a->row[2][1] - a->row[1][1] * a->row[2][0];
    return a->row[0][0] * x + a->row[0][1] * y + a->row[0][2] * z < 0.0;
}

#endif
