// SPDX-License-Identifier: MIT
//
// The triangles that a convex shape touches: boxes of the tree against the shape's box, then triangle by triangle.

#include "base/assert.h"
#include "soup/query/query_shape.h"
#include "soup/query/region_walk.h"

typedef struct search {
    const tl_soup *soup;
    const tl_query_shape *shape;
    const tl_ray_filter *filter;
    uint32_t *triangles;
    uint32_t capacity;
    uint32_t count;
} search;

static bool belongs(const tl_walk_triangle *triangle, void *user)
{
    const search *s = user;
    if (!tl_aabb_overlaps(tl_walk_triangle_box(triangle), s->shape->bounds) ||
        !tl_query_shape_touches(s->shape, triangle->corners)) {
        return false;
    }
    return s->filter == NULL || tl_ray_filter_accepts(s->soup, s->filter, triangle->triangle,
                                                      tl_query_shape_sees(s->shape, triangle->corners));
}

static bool add(const tl_walk_triangle *triangle, void *user)
{
    search *s = user;
    if (s->count < s->capacity) {
        s->triangles[s->count] = triangle->triangle;
    }
    s->count++;
    return true;
}

static bool stop(const tl_walk_triangle *triangle, void *user)
{
    search *s = user;
    (void)triangle;
    s->count++;
    return false;
}

tl_result tl_soup_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose, const tl_ray_filter *filter,
                           bool *overlaps_out)
{
    TL_ASSERT(soup != NULL && shape != NULL && overlaps_out != NULL);
    tl_query_shape query;
    TL_TRY(tl_query_shape_make(shape, pose, &query));
    search s = { soup, &query, filter, NULL, 0, 0 };
    tl_region region = { tl_region_enter_box, &query.bounds, belongs, stop, &s };
    *overlaps_out = !tl_region_walk(soup, &region);
    return TL_OK;
}

tl_result tl_soup_find_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose,
                                const tl_ray_filter *filter, uint32_t *triangles_out, uint32_t capacity,
                                uint32_t *count_out)
{
    TL_ASSERT(soup != NULL && shape != NULL && count_out != NULL && (triangles_out != NULL || capacity == 0));
    tl_query_shape query;
    TL_TRY(tl_query_shape_make(shape, pose, &query));
    search s = { soup, &query, filter, triangles_out, capacity, 0 };
    tl_region region = { tl_region_enter_box, &query.bounds, belongs, add, &s };
    tl_region_walk(soup, &region);
    *count_out = s.count;
    return s.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
