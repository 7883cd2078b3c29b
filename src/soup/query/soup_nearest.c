// SPDX-License-Identifier: MIT
//
// The nearest point of the soup: best-first BVH traversal, boxes pruned by the best distance so far.
//
// Boxes, and the triangles' own boxes, give lower bounds in float; a triangle that they cannot rule out is measured in
// double, from its own three corners. So the answer is the minimum over all triangles, whatever the tree looks like.
//
// Source: Roussopoulos, Kelley, Vincent, Nearest Neighbor Queries, 1995.

#include "base/assert.h"
#include "math/predicates.h"
#include "soup/query/walk_scale.h"
#include "soup/ray/ray_filter.h"
#include "soup/triangle/triangle_point.h"

// A squared distance to a box in float: a difference, a square and two sums, each rounded, and a share to spare for the
// limit's own rounding.
#define BOX_KEY_SHRINK (1.0f - TL_FLOAT_GAMMA(8))

typedef struct soup_nearest_search {
    const tl_soup *soup;
    const tl_ray_filter *filter;
    tl_vec3 at;
    tl_vec3d point;
    double limit_sq; // nothing beyond it counts
    float limit_key;
    tl_triangle_point best;
    uint32_t triangle; // UINT32_MAX: none yet
    tl_vec3 corners[3];
} soup_nearest_search;

// A lower bound of the squared distance to a box.
static float box_key(tl_vec3 at, tl_aabb box)
{
    float x = tl_maxf(tl_maxf(box.min.x - at.x, at.x - box.max.x), 0.0f);
    float y = tl_maxf(tl_maxf(box.min.y - at.y, at.y - box.max.y), 0.0f);
    float z = tl_maxf(tl_maxf(box.min.z - at.z, at.z - box.max.z), 0.0f);
    return (x * x + y * y + z * z) * BOX_KEY_SHRINK;
}

static void enter_nearest_node(const soup_nearest_search *s, tl_walk *walk, uint32_t node)
{
    tl_walk_boxes boxes;
    tl_walk_read_boxes(walk, node, &boxes);
    float keys[TL_WALK_WIDTH];
    uint32_t mask = 0;
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        keys[i] = box_key(s->at, tl_walk_box(&boxes, i));
    }
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        mask |= (uint32_t)(keys[i] <= s->limit_key) << i;
    }
    tl_walk_enter(walk, &boxes, mask, keys);
}

static tl_seen seen_from_point(const tl_vec3 corners[3], tl_vec3 point)
{
    int side = tl_orient3d(corners[0], corners[1], corners[2], point);
    return side > 0 ? TL_SEEN_FRONT : side < 0 ? TL_SEEN_BACK : TL_SEEN_BOTH;
}

static void set_nearest_limit(soup_nearest_search *s, double limit_sq)
{
    s->limit_sq = limit_sq;
    s->limit_key = limit_sq < (double)FLT_MAX ? (float)limit_sq + FLT_MIN : INFINITY;
}

static void measure_distance(soup_nearest_search *s, const tl_walk_triangle *triangle)
{
    if (box_key(s->at, tl_walk_triangle_box(triangle)) > s->limit_key) {
        return;
    }
    tl_triangle_point found;
    tl_triangle_nearest(triangle->corners, s->point, &found);
    bool better =
        found.distance_sq < s->limit_sq || (found.distance_sq == s->limit_sq && triangle->triangle < s->triangle);
    if (!better || (s->filter != NULL && !tl_ray_filter_accepts(s->soup, s->filter, triangle->triangle,
                                                                seen_from_point(triangle->corners, s->at)))) {
        return;
    }
    s->best = found;
    s->triangle = triangle->triangle;
    memcpy(s->corners, triangle->corners, sizeof s->corners);
    set_nearest_limit(s, found.distance_sq);
}

static void visit_nearest_leaf(soup_nearest_search *s, const tl_walk *walk, uint32_t child)
{
    tl_walk_leaf leaf;
    tl_walk_open_leaf(walk, child, &leaf);
    tl_walk_triangle triangle;
    for (uint32_t lane = 0; lane < leaf.lane_count; lane++) {
        for (bool more = tl_walk_read_triangle(&leaf, lane, &triangle); more;
             more = tl_walk_next_coincident(&triangle)) {
            measure_distance(s, &triangle);
        }
    }
}

static void describe_nearest(const soup_nearest_search *s, const tl_walk_scale *scale, tl_soup_point *nearest_out)
{
    nearest_out->point = tl_vec3d_to_float(s->best.point);
    nearest_out->distance = (float)sqrt(s->best.distance_sq);
    nearest_out->triangle = s->triangle;
    nearest_out->feature =
        scale != NULL && scale->mirrored ? tl_walk_mirrored_feature(s->best.feature) : s->best.feature;
    nearest_out->normal = tl_triangle_normal(s->corners);
    nearest_out->material = tl_soup_material(s->soup, s->triangle);
    nearest_out->back = seen_from_point(s->corners, s->at) == TL_SEEN_BACK;
}

tl_result tl_scaled_soup_nearest(const tl_scaled_soup *scaled, tl_vec3 point, float max_distance,
                                 const tl_ray_filter *filter, tl_soup_point *nearest_out)
{
    if (nearest_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(nearest_out, 0, sizeof *nearest_out);
    tl_walk_scale scale;
    const tl_walk_scale *used;
    TL_TRY(tl_walk_scale_make(scaled, &scale, &used));
    if (!tl_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!(max_distance >= 0.0f)) {
        return TL_ERR_ARGUMENT;
    }
    soup_nearest_search s = {
        .soup = scaled->soup, .filter = filter, .at = point, .point = tl_vec3d_from(point), .triangle = UINT32_MAX
    };
    set_nearest_limit(&s, (double)max_distance * (double)max_distance);
    tl_walk walk;
    tl_walk_begin_scaled(&walk, scaled->soup, used);
    uint32_t child;
    while (tl_walk_next(&walk, s.limit_key, &child)) {
        if (tl_walk_is_leaf(child)) {
            visit_nearest_leaf(&s, &walk, child);
        } else {
            enter_nearest_node(&s, &walk, child);
        }
    }
    if (s.triangle == UINT32_MAX) {
        return TL_NOT_FOUND;
    }
    describe_nearest(&s, used, nearest_out);
    return TL_OK;
}

tl_result tl_soup_nearest(const tl_soup *soup, tl_vec3 point, float max_distance, const tl_ray_filter *filter,
                          tl_soup_point *nearest_out)
{
    const tl_scaled_soup as_it_is = tl_unscaled_soup(soup);
    return tl_scaled_soup_nearest(&as_it_is, point, max_distance, filter, nearest_out);
}
