// SPDX-License-Identifier: MIT
//
// A soup seen at a scale, without a copy: a crate of twice the size, a tree 1.3 times as tall, a door mirrored. Shapes
// against triangles, and the nearest point; rays and lines of sight take a scene of one instance (scene.h), which has
// a scale of its own.
//
//   tl_scaled_soup tall = { tree, { 1, 1.3f, 1 } };
//   tl_scaled_soup_cast_shape(&tall, &body, pose, step, NULL, &hit);
//
// The corners are multiplied by the scale, each coordinate rounded once, as the query reads them. The answer is that of
// a soup baked of these corners, bit for bit; where triangles tie, the lowest index wins in both. Lengths, depths and
// distances are those of the scaled soup.
//
// Mirroring keeps outsides outside: where one factor or all three are negative, each triangle's corners run the other
// way round, so fronts stay fronts. Features and corners are named as in the view.
//
// Functions refuse NULL as their counterparts in soup.h do, TL_ERR_ARGUMENT, and zero their outputs. A scale that is
// not finite gives TL_ERR_NOT_FINITE; TL_ERR_RANGE: a factor that is 0, unless all are, or whose size is beyond
// TL_MAX_SCALE or below its inverse. Threads as in soup.h; nothing is allocated.
//
// Queries of a scaled soup take some 15% more instructions than of a soup as it is.

#ifndef TALUS_SOUP_SCALED_H
#define TALUS_SOUP_SCALED_H

#include <talus/convex_scaled.h>
#include <talus/soup.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A soup at a scale.
typedef struct tl_scaled_soup {
    const tl_soup *soup; ///< borrowed
    tl_vec3 scale;       ///< factors along the soup's own axes, none of them 0; all zero: 1
} tl_scaled_soup;

/// tl_soup_nearest of a soup at a scale. Errors as there, and for the scale.
TL_API tl_result tl_scaled_soup_nearest(const tl_scaled_soup *scaled, tl_vec3 point, float max_distance,
                                        const tl_ray_filter *filter, tl_soup_point *nearest_out);

/// tl_soup_overlaps of a soup at a scale. Errors as there, and for the scale.
TL_API tl_result tl_scaled_soup_overlaps(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                         const tl_ray_filter *filter, bool *overlaps_out);

/// tl_soup_find_overlaps of a soup at a scale. Errors as there, and for the scale.
TL_API tl_result tl_scaled_soup_find_overlaps(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                              const tl_ray_filter *filter, uint32_t *triangles_out, uint32_t capacity,
                                              uint32_t *count_out);

/// tl_soup_cast_shape of a soup at a scale. Errors as there, and for the scale.
TL_API tl_result tl_scaled_soup_cast_shape(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                           tl_vec3 motion, const tl_ray_filter *filter, tl_shape_hit *hit_out);

#ifdef __cplusplus
}
#endif

#endif
