// SPDX-License-Identifier: MIT
//
// Box against triangle.

#ifndef TALUS_SRC_SOUP_BOX_TRIANGLE_H
#define TALUS_SRC_SOUP_BOX_TRIANGLE_H

#include "math/vec3d.h"

/// Whether a triangle, given in the box's frame, shares a point with the box of these half extents around the origin.
bool tl_box_touches_triangle(const double half[3], const tl_vec3d corners[3]);

#endif
