// SPDX-License-Identifier: MIT
//
// Sweeping a convex shape through the soup: which triangle it hits first.
//
// The shape's box is cast through the BVH from near to far; a triangle whose box it meets before the best hit so far is
// tested by itself. Each triangle's time depends only on the triangle and the shape, and of equal times the lowest
// index wins: so the answer does not depend on the tree.
//
// Touching: positions are floats, so a capsule on a floor stands some roundings above or inside it. A shape may
// penetrate a triangle that deep and still pass; otherwise the floor that it slides on would stop it, and every inner
// edge of it.
//
// Sources: van den Bergen, Ray Casting against General Convex Objects, 2004 (convex/cast.c); for the tree, Ericson,
// Real-Time Collision Detection, 2005, section 5.5.

#include "base/assert.h"
#include "base/min_max.h"
#include "math/predicates.h"
#include "soup/query/triangle_cast.h"
#include "soup/query/walk_scale.h"
#include "soup/triangle/triangle_point.h"

// Metres that count as touching, as a share of the largest coordinate that the shape reaches: a position and a corner
// round by half an ulp each, along three axes.
#define SOUP_TOUCH_SHARE (4.0 * (double)TL_FLOAT_ROUNDING)

// A shape that moves less than this along an axis (metres) counts as not moving there, with a box wider by as much.
#define STANDING 1e-30f

// A time at which boxes meet: a difference and a product round, boxes and limit round once each.
#define TIME_ERROR TL_FLOAT_GAMMA(6)

typedef struct sweep_search {
    const tl_soup *soup;
    const tl_ray_filter *filter;
    const tl_query_shape *shape;
    tl_motion motion;
    bool capsule;
    float low[3], high[3]; // the shape's box
    bool moves[3];
    float inverse[3]; // 1 / step, where it moves
    tl_triangle_cast best;
    double limit; // later times do not count
    float limit_key;
    uint32_t triangle; // UINT32_MAX: none
    tl_vec3 corners[3];
    bool back;
} sweep_search;

static void prepare_sweep(sweep_search *s)
{
    const float step[3] = { s->motion.step.x, s->motion.step.y, s->motion.step.z };
    const tl_aabb *box = &s->shape->bounds;
    const float low[3] = { box->min.x, box->min.y, box->min.z }, high[3] = { box->max.x, box->max.y, box->max.z };
    double reach = 0.0;
    for (int i = 0; i < 3; i++) {
        s->moves[i] = fabsf(step[i]) >= STANDING;
        s->inverse[i] = s->moves[i] ? 1.0f / step[i] : 0.0f;
        s->low[i] = s->moves[i] ? low[i] : low[i] - STANDING;
        s->high[i] = s->moves[i] ? high[i] : high[i] + STANDING;
        double farthest = tl_max_f64(fabs((double)low[i]), fabs((double)high[i])) + fabs((double)step[i]);
        reach = tl_max_f64(reach, farthest);
    }
    s->motion.touch = SOUP_TOUCH_SHARE * reach;
    s->capsule = (s->shape->kind == TL_QUERY_SPHERE || s->shape->kind == TL_QUERY_CAPSULE) &&
                 s->shape->radius > TL_ROUND_RADIUS * s->motion.touch;
}

// When the moving box enters and leaves a fixed one along one axis. Where it does not move: always, or never.
static inline void meet_axis(const sweep_search *s, int axis, float min, float max, float *enter, float *leave)
{
    float before = min - s->high[axis], behind = max - s->low[axis];
    if (s->moves[axis]) {
        float a = before * s->inverse[axis], b = behind * s->inverse[axis];
        *enter = tl_maxf(*enter, tl_minf(a, b));
        *leave = tl_minf(*leave, tl_maxf(a, b));
    } else {
        *leave = before <= 0.0f && behind >= 0.0f ? *leave : -1.0f;
    }
}

// A lower bound of the time at which boxes meet that are together between two times; INFINITY when they never are.
static inline float meet_time(float enter, float leave)
{
    enter -= enter * TIME_ERROR;
    const bool meets = (enter <= leave + TIME_ERROR * leave) & (leave >= 0.0f);
    return meets ? enter : INFINITY;
}

static inline float meet_box(const sweep_search *s, const float min[3], const float max[3])
{
    float enter = 0.0f, leave = 1.0f;
    for (int axis = 0; axis < 3; axis++) {
        meet_axis(s, axis, min[axis], max[axis], &enter, &leave);
    }
    return meet_time(enter, leave);
}

static void enter_swept_node(const sweep_search *s, tl_walk *walk, uint32_t node)
{
    tl_walk_boxes boxes;
    tl_walk_read_boxes(walk, node, &boxes);
    float enter[TL_WALK_WIDTH], leave[TL_WALK_WIDTH], keys[TL_WALK_WIDTH];
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        enter[i] = 0.0f;
        leave[i] = 1.0f;
    }
    for (int axis = 0; axis < 3; axis++) {
        const float *min = tl_walk_min(&boxes, (uint32_t)axis), *max = tl_walk_max(&boxes, (uint32_t)axis);
        for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
            meet_axis(s, axis, min[i], max[i], &enter[i], &leave[i]);
        }
    }
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        keys[i] = meet_time(enter[i], leave[i]);
    }
    uint32_t mask = 0;
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        mask |= (uint32_t)(keys[i] <= s->limit_key) << i;
    }
    tl_walk_enter(walk, &boxes, mask, keys);
}

// The side from which the motion hits the triangle; a shape that does not move sees it from where it is.
static tl_seen seen_from(const sweep_search *s, const tl_vec3 corners[3])
{
    tl_vec3 zero = tl_vec3_make(0.0f, 0.0f, 0.0f);
    if (s->motion.step.x == 0.0f && s->motion.step.y == 0.0f && s->motion.step.z == 0.0f) {
        return tl_query_shape_sees(s->shape, corners);
    }
    double along = tl_normal_dot(corners[0], corners[1], corners[2], s->motion.step, zero);
    return along < 0.0 ? TL_SEEN_FRONT : along > 0.0 ? TL_SEEN_BACK : TL_SEEN_BOTH;
}

// Earlier wins; of overlaps the deeper one; then the lower index.
static bool is_better_cast(const sweep_search *s, const tl_triangle_cast *cast, uint32_t triangle)
{
    if (cast->t != s->best.t) {
        return cast->t < s->best.t;
    }
    if (cast->depth != s->best.depth) {
        return cast->depth > s->best.depth;
    }
    return cast->overlap == s->best.overlap ? triangle < s->triangle : cast->overlap;
}

static void visit_triangle(sweep_search *s, const tl_walk_triangle *triangle)
{
    tl_aabb own = tl_walk_triangle_box(triangle);
    const float min[3] = { own.min.x, own.min.y, own.min.z }, max[3] = { own.max.x, own.max.y, own.max.z };
    if (!(meet_box(s, min, max) <= s->limit_key)) {
        return;
    }
    tl_triangle_cast cast;
    bool hit = s->capsule ? tl_triangle_cast_capsule(s->shape, &s->motion, triangle->corners, s->limit, &cast)
                          : tl_triangle_cast_shape(s->shape, &s->motion, triangle->corners, s->limit, &cast);
    if (!hit || (s->triangle != UINT32_MAX && !is_better_cast(s, &cast, triangle->triangle))) {
        return;
    }
    if (s->filter != NULL &&
        !tl_ray_filter_accepts(s->soup, s->filter, triangle->triangle, seen_from(s, triangle->corners))) {
        return;
    }
    s->best = cast;
    s->triangle = triangle->triangle;
    memcpy(s->corners, triangle->corners, sizeof s->corners);
    s->limit = cast.t;
    s->limit_key = (float)cast.t * (1.0f + TIME_ERROR) + FLT_MIN;
}

static void describe_hit(const sweep_search *s, tl_shape_hit *hit)
{
    // Rounded down: never late.
    float t = (float)s->best.t;
    hit->t = (double)t > s->best.t ? t * (1.0f - 2.0f * TL_FLOAT_ROUNDING) : t;
    hit->initial_overlap = s->best.overlap;
    hit->depth = (float)s->best.depth;
    hit->point = s->best.point;
    hit->normal = s->best.normal;
    hit->triangle = s->triangle;
    hit->material = tl_soup_material(s->soup, s->triangle);
    hit->back = seen_from(s, s->corners) == TL_SEEN_BACK;
    hit->face_normal = tl_triangle_normal(s->corners);
    hit->status = s->best.status;
}

static void visit_swept_leaf(sweep_search *s, const tl_walk *walk, uint32_t child)
{
    tl_walk_leaf leaf;
    tl_walk_open_leaf(walk, child, &leaf);
    tl_walk_triangle triangle;
    for (uint32_t lane = 0; lane < leaf.lane_count; lane++) {
        for (bool more = tl_walk_read_triangle(&leaf, lane, &triangle); more;
             more = tl_walk_next_coincident(&triangle)) {
            visit_triangle(s, &triangle);
        }
    }
}

tl_result tl_scaled_soup_cast_shape(const tl_scaled_soup *scaled, const tl_convex *shape, tl_transform pose,
                                    tl_vec3 motion, const tl_ray_filter *filter, tl_shape_hit *hit_out)
{
    if (hit_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(hit_out, 0, sizeof *hit_out);
    if (shape == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_walk_scale scale;
    const tl_walk_scale *used;
    TL_TRY(tl_walk_scale_make(scaled, &scale, &used));
    if (!tl_is_finite(motion)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_query_shape query;
    TL_TRY(tl_query_shape_make(shape, pose, &query));
    sweep_search s = { .soup = scaled->soup, .filter = filter, .shape = &query, .triangle = UINT32_MAX };
    s.motion.step = motion;
    s.limit = 1.0;
    s.limit_key = 1.0f;
    prepare_sweep(&s);
    tl_walk walk;
    tl_walk_begin_scaled(&walk, scaled->soup, used);
    uint32_t child;
    while (tl_walk_next(&walk, s.limit_key, &child)) {
        if (tl_walk_is_leaf(child)) {
            visit_swept_leaf(&s, &walk, child);
        } else {
            enter_swept_node(&s, &walk, child);
        }
    }
    if (s.triangle == UINT32_MAX) {
        return TL_NOT_FOUND;
    }
    describe_hit(&s, hit_out);
    return TL_OK;
}

tl_result tl_soup_cast_shape(const tl_soup *soup, const tl_convex *shape, tl_transform pose, tl_vec3 motion,
                             const tl_ray_filter *filter, tl_shape_hit *hit_out)
{
    const tl_scaled_soup as_it_is = tl_unscaled_soup(soup);
    return tl_scaled_soup_cast_shape(&as_it_is, shape, pose, motion, filter, hit_out);
}
