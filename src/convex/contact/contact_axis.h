// SPDX-License-Identifier: MIT
//
// The normal of a pair that penetrates, without a search: of two boxes, and of a pair whose depth was proven before.

#ifndef TALUS_SRC_CONVEX_CONTACT_AXIS_H
#define TALUS_SRC_CONVEX_CONTACT_AXIS_H

#include "convex/depth/core_depth.h"

// The deepest points of both cores.
typedef struct tl_deepest {
    tl_vec3d normal;      // unit, from A to B
    double separation;    // of the cores along it, negative when they overlap
    double lower_depth;   // the cores are no less deep
    bool has_points;      // false: they are among the corners of the patch
    tl_vec3d on_a, on_b;  // deepest points
    uint32_t features[2]; // theirs, or 0
} tl_deepest;

// box_depth.c
typedef struct tl_box {
    tl_vec3d middle, half;
} tl_box;

// Whether the shape is a box along its own axes: as such, or as a hull of just these corners.
bool tl_box_of(const tl_convex *shape, tl_box *box_out);

// Depth of two boxes by their 15 axes, exact to double rounding. When the boxes are apart, `separation` is positive,
// less than or equal to the distance, and nothing else is set.
void tl_box_depth(tl_minkowski *pair, const tl_box *a, const tl_box *b, tl_deepest *deepest_out);

// contact_axis.c
typedef enum tl_axis_trial {
    TL_AXIS_GONE, // there is none, or the pair has moved by more than the slack
    TL_AXIS_NEAR, // it has moved by less, but that alone does not prove the last normal
    TL_AXIS_HOLDS // the last normal is, to the slack, still the one of least depth
} tl_axis_trial;

// Tries the last normal; `slack` is in metres. Sets the depth along it, unless it is gone.
tl_axis_trial tl_axis_try(tl_minkowski *pair, const tl_contact_cache *cache, double slack, tl_deepest *deepest_out);
void tl_axis_store(const tl_minkowski *pair, const tl_deepest *deepest, tl_contact_cache *cache);

#endif
