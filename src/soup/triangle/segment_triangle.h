// SPDX-License-Identifier: MIT
//
// The distance between a segment and a triangle.

#ifndef TALUS_SRC_SOUP_SEGMENT_TRIANGLE_H
#define TALUS_SRC_SOUP_SEGMENT_TRIANGLE_H

#include "math/vec3d.h"

/// The nearest points of a segment and a triangle.
typedef struct tl_segment_triangle {
    double distance_sq; ///< 0 when the segment crosses the face; the points are then not set
    tl_vec3d on_segment, on_triangle;
} tl_segment_triangle;

void tl_segment_triangle_nearest(const tl_vec3d ends[2], const tl_vec3 corners[3], tl_segment_triangle *nearest_out);

#endif
