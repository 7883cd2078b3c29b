// SPDX-License-Identifier: MIT
//
// The nearest point of one triangle.

#ifndef TALUS_SRC_SOUP_TRIANGLE_POINT_H
#define TALUS_SRC_SOUP_TRIANGLE_POINT_H

#include "math/vec3d.h"

#include <talus/soup.h>

typedef struct tl_triangle_point {
    tl_vec3d point;
    double distance_sq;
    tl_triangle_feature feature;
} tl_triangle_point;

/// The point of a triangle nearest to `p`. The triangle may have shrunk to a segment or point.
void tl_triangle_nearest(const tl_vec3 corners[3], tl_vec3d p, tl_triangle_point *nearest_out);

/// (b - a) x (c - a), scaled to unit length; zero for a triangle too thin for doubles to tell.
tl_vec3 tl_triangle_normal(const tl_vec3 corners[3]);

#endif
