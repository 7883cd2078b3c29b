// SPDX-License-Identifier: MIT
//
// The boxes that a ray enters, for walks to its end.

#ifndef TALUS_SRC_SOUP_LINE_REGION_H
#define TALUS_SRC_SOUP_LINE_REGION_H

#include "soup/query/region_walk.h"

typedef struct tl_line_region {
    double origin[3];
    double inverse[3]; ///< 1 / direction, or 0 where the direction is 0
    double end;        ///< t
} tl_line_region;

/// A finite ray whose direction is not zero; tmax >= 0 or INFINITY.
void tl_line_region_make(const tl_ray *ray, tl_line_region *region_out);

/// A tl_region_enter_fn: skips no box that holds a hit of the ray.
uint32_t tl_region_enter_line(const tl_walk_boxes *boxes, const void *line_region);

/// TL_ERR_NOT_FINITE (origin or direction) or TL_ERR_ARGUMENT (a zero direction, a tmax that is negative or NaN).
tl_result tl_ray_check(const tl_ray *ray);

#endif
