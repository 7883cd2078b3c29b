// SPDX-License-Identifier: MIT
//
// The depths of two boxes along their 15 axes.

#ifndef TALUS_SRC_CONVEX_BOX_AXES_H
#define TALUS_SRC_CONVEX_BOX_AXES_H

enum { TL_BOX_AXES = 15 };

// Vectors have a fourth lane of zero.
typedef struct tl_box_axes {
    double half_a[4], half_b[4];
    double apart[4];                  // from A's middle to B's, along A's axes
    double turn[3][4], columns[3][4]; // the rotation from B to A
    // Of A's faces; of B's; of a_i x b_j, row 2 + i; infinite where these are parallel.
    double depths[5][4];
} tl_box_axes;

// Finds the depths; for each level of instructions.
void tl_box_axes_base(tl_box_axes *axes);
void tl_box_axes_avx2(tl_box_axes *axes);

#endif
