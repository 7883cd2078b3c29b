// SPDX-License-Identifier: MIT
//
// The triangles that a convex shape touches: boxes of the BVH against the shape's box, then triangle by triangle.

#include "base/assert.h"
#include "soup/query/query_shape.h"
#include "soup/query/region_walk.h"
#include "soup/query/walk_scale.h"

typedef struct overlap_search {
    const tl_soup *soup;
    const tl_query_shape *shape;
    const tl_ray_filter *filter;
    uint32_t *triangles;
    uint32_t capacity;
    uint32_t count;
} overlap_search;

static bool is_touched(const tl_walk_triangle *triangle, void *user)
{
    const overlap_search *s = user;
    if (!tl_query_shape_touches(s->shape, triangle->corners)) {
        return false;
    }
    return s->filter == NULL || tl_ray_filter_accepts(s->soup, s->filter, triangle->triangle,
                                                      tl_query_shape_sees(s->shape, triangle->corners));
}

static bool add_overlap(const tl_walk_triangle *triangle, void *user)
{
    overlap_search *s = user;
    if (s->count < s->capacity) {
        s->triangles[s->count] = triangle->triangle;
    }
    s->count++;
    return true;
}

static bool stop_at_first(const tl_walk_triangle *triangle, void *user)
{
    overlap_search *s = user;
    (void)triangle;
    s->count++;
    return false;
}

tl_result tl_scaled_soup_overlaps(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                  const tl_ray_filter *filter, bool *overlaps_out)
{
    if (overlaps_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *overlaps_out = false;
    if (shape == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_walk_scale scale;
    const tl_walk_scale *used;
    TL_TRY(tl_walk_scale_make(scaled, &scale, &used));
    tl_query_shape query;
    TL_TRY(tl_query_shape_make(shape, pose, &query));
    overlap_search s = { scaled->soup, &query, filter, NULL, 0, 0 };
    tl_region region = { .box = &query.bounds, .belongs = is_touched, .found = stop_at_first, .user = &s };
    *overlaps_out = !tl_region_walk_scaled(scaled->soup, used, &region);
    return TL_OK;
}

tl_result tl_soup_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose, const tl_ray_filter *filter,
                           bool *overlaps_out)
{
    const tl_scaled_soup as_it_is = tl_unscaled_soup(soup);
    return tl_scaled_soup_overlaps(&as_it_is, shape, pose, filter, overlaps_out);
}

tl_result tl_scaled_soup_find_overlaps(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                       const tl_ray_filter *filter, uint32_t *triangles_out, uint32_t capacity,
                                       uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (shape == NULL || (triangles_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    tl_walk_scale scale;
    const tl_walk_scale *used;
    TL_TRY(tl_walk_scale_make(scaled, &scale, &used));
    tl_query_shape query;
    TL_TRY(tl_query_shape_make(shape, pose, &query));
    overlap_search s = { scaled->soup, &query, filter, triangles_out, capacity, 0 };
    tl_region region = { .box = &query.bounds, .belongs = is_touched, .found = add_overlap, .user = &s };
    tl_region_walk_scaled(scaled->soup, used, &region);
    *count_out = s.count;
    return s.count <= capacity ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_soup_find_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose,
                                const tl_ray_filter *filter, uint32_t *triangles_out, uint32_t capacity,
                                uint32_t *count_out)
{
    const tl_scaled_soup as_it_is = tl_unscaled_soup(soup);
    return tl_scaled_soup_find_overlaps(&as_it_is, shape, pose, filter, triangles_out, capacity, count_out);
}
