// SPDX-License-Identifier: MIT
//
// Linear cast: B moves along a line until it touches A. GJK ray cast: the origin is cast as a ray at the Minkowski
// difference A - B, grown by the radii. The support along the simplex's nearest point is a plane between the two, and
// the origin may go as far as that plane without looking at anything else. One simplex serves the whole way.
// Source: van den Bergen, Ray Casting against General Convex Objects with Application to Continuous Collision
// Detection, 2004; conservative advancement: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996.
//
// A ray at a hull without a radius needs none of this: the hull's planes are clipped, many at a time.
//
// The time only grows by what a plane proves to be free, less the rounding, so the time reported is never late.

#include "convex/core/simplex.h"

#include "base/assert.h"
#include "math/tolerance.h"

#include <string.h>

// Shapes closer than four float roundings of their size, in coordinates that are floats, touch.
#define TOUCH_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

// Two rotated points, a shift and their difference.
#define CAST_POINT_ERROR TL_DOUBLE_GAMMA(24)

typedef struct linear_cast {
    tl_minkowski *pair;
    tl_vec3d motion; // A's frame
    double t, t_max, radii;
    tl_simplex simplex; // points unshifted; weights and nearest for the time t
    tl_vec3d nearest;
    double distance; // of the cores at t, from above
    double size;     // spread of the points seen, and the radii
    tl_vec3d normal; // of the last plane
    bool inside, moved;
} linear_cast;

static double cast_noise(const linear_cast *c)
{
    return CAST_POINT_ERROR * (c->pair->scale + c->t * tl_vec3d_size(c->motion));
}

static double touch_gap(const linear_cast *c)
{
    return TOUCH_GAP * c->size + 2.0 * c->pair->direction_error + 2.0 * cast_noise(c);
}

// The simplex seen from the origin at time t.
static void update_nearest(linear_cast *c)
{
    tl_simplex shifted; // of its points only w is read
    shifted.count = c->simplex.count;
    for (uint32_t i = 0; i < shifted.count; i++) {
        shifted.points[i].w = tl_vec3d_mul_add(tl_vec3d_load_apart(&c->simplex.points[i].w), c->motion, -c->t);
    }
    tl_simplex_point nearest;
    tl_simplex_solve(&shifted, &nearest);
    tl_simplex_keep(&c->simplex, &nearest);
    c->nearest = nearest.point;
    c->distance = sqrt(nearest.distance_sq);
    c->inside = nearest.count == 4 || c->distance <= cast_noise(c);
}

static void grow_size(linear_cast *c, const tl_minkowski_point *point)
{
    double spread = tl_vec3d_length(tl_vec3d_sub(point->w, c->simplex.points[0].w)) + c->radii;
    c->size = spread > c->size ? spread : c->size;
}

static void start_cast(linear_cast *c)
{
    tl_minkowski_place_hulls(c->pair);
    tl_minkowski_support(c->pair, tl_vec3d_neg(tl_minkowski_offset(c->pair)), &c->simplex.points[0]);
    c->simplex.count = 1;
    grow_size(c, &c->simplex.points[0]);
    update_nearest(c);
    c->normal = c->inside ? tl_vec3d_make(0.0, 0.0, 0.0) : tl_vec3d_scale(c->nearest, -1.0 / c->distance);
}

typedef enum cast_step { STEP_ON, STEP_HIT, STEP_MISS, STEP_STUCK } cast_step;

static cast_step advance_cast(linear_cast *c)
{
    if (c->inside || c->distance <= c->radii) {
        return STEP_HIT;
    }
    tl_vec3d u = tl_vec3d_scale(c->nearest, 1.0 / c->distance);
    double closing = tl_vec3d_dot(u, c->motion);
    bool touches = c->distance <= c->radii + touch_gap(c);
    if (touches && closing > 0.0) {
        c->normal = c->moved && c->radii == 0.0 ? c->normal : tl_vec3d_neg(u);
        return STEP_HIT;
    }
    tl_minkowski_point *point = &c->simplex.points[c->simplex.count]; // four of them have the origin inside
    tl_minkowski_support(c->pair, tl_vec3d_neg(u), point);
    grow_size(c, point);
    double slack = c->pair->direction_error + cast_noise(c);
    double free = tl_vec3d_dot(u, tl_vec3d_mul_add(point->w, c->motion, -c->t)) - c->radii;
    // Nothing comes nearer along this plane, and it separates the shapes; where they touch, to within rounding.
    if (closing <= 0.0 && free > (touches ? -slack : slack)) {
        return STEP_MISS;
    }
    bool advanced = free > slack && closing > 0.0;
    if (advanced) {
        c->t += (free - slack) / closing;
        if (c->t > c->t_max) {
            return STEP_MISS;
        }
        c->normal = tl_vec3d_neg(u);
        c->moved = true;
    }
    double before = c->distance;
    bool known = tl_simplex_holds(&c->simplex, point);
    if (known && !advanced) {
        return STEP_STUCK;
    }
    if (!known) {
        c->simplex.count++;
    }
    update_nearest(c);
    return advanced || c->inside || c->distance < before ? STEP_ON : STEP_STUCK;
}

static void run_cast(linear_cast *c, tl_convex_hit *hit)
{
    start_cast(c);
    bool at_start = c->inside || c->distance <= c->radii;
    cast_step state = STEP_ON;
    while (state == STEP_ON) {
        state = advance_cast(c);
        at_start = at_start || (!c->moved && (c->inside || c->distance <= c->radii));
        if (state == STEP_ON && ++hit->iterations == TL_MAX_CAST_ITERATIONS) {
            hit->status = TL_CONVEX_ITERATIONS;
            break;
        }
    }
    double gap = c->inside || c->distance <= c->radii ? 0.0 : c->distance - c->radii;
    if (state == STEP_STUCK && gap > 2.0 * touch_gap(c)) {
        hit->status = TL_CONVEX_DEGENERATE;
    }
    if (state == STEP_MISS) {
        return;
    }
    hit->hit = true;
    hit->initial_overlap = at_start && !c->moved;
    hit->gap = (float)gap;
    tl_vec3d on_a, on_b;
    tl_simplex_witness(&c->simplex, &on_a, &on_b);
    hit->point = tl_minkowski_to_world(c->pair, tl_vec3d_mul_add(on_a, c->normal, (double)c->pair->a->radius));
    if (!hit->initial_overlap) {
        hit->normal = tl_vec3d_to_float(tl_frame_rotate(&c->pair->a_to_world, c->normal));
    }
}

// Not late when rounded to float.
static float round_time_down(double t)
{
    float rounded = (float)t;
    return (double)rounded > t ? rounded * (1.0f - 2.0f * TL_FLOAT_ROUNDING) : rounded;
}

static bool cast_pair(tl_minkowski *pair, tl_vec3 motion, double t_max, tl_convex_hit *hit_out)
{
    linear_cast c;
    memset(&c, 0, sizeof c);
    memset(hit_out, 0, sizeof *hit_out);
    c.pair = pair;
    c.motion = tl_frame_rotate_back(&pair->a_to_world, tl_vec3d_from(motion));
    c.t_max = t_max;
    c.radii = (double)pair->a->radius + (double)pair->b->radius;
    c.size = c.radii;
    run_cast(&c, hit_out);
    if (hit_out->hit) {
        hit_out->t = round_time_down(c.t);
    }
    return hit_out->hit;
}

static bool refuse_not_finite(tl_convex_hit *hit_out)
{
    memset(hit_out, 0, sizeof *hit_out);
    hit_out->status = TL_CONVEX_NOT_FINITE;
    return false;
}

bool tl_convex_cast(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b, tl_vec3 motion,
                    tl_convex_hit *hit_out)
{
    TL_ASSERT(a != NULL && b != NULL && hit_out != NULL);
    tl_minkowski pair;
    if (!tl_minkowski_init(&pair, a, &pose_a, b, &pose_b) || !tl_is_finite(motion)) {
        return refuse_not_finite(hit_out);
    }
    return cast_pair(&pair, motion, 1.0, hit_out);
}

// A ray against a hull's planes. False when that does not decide: the ray starts inside or on the surface.
static bool clip_by_hull(const tl_minkowski *pair, tl_vec3 direction, double t_max, tl_convex_hit *hit_out)
{
    tl_vec3d from = tl_frame_point(&pair->b_to_a, tl_vec3d_make(0.0, 0.0, 0.0));
    tl_vec3d along = tl_frame_rotate_back(&pair->a_to_world, tl_vec3d_from(direction));
    const double origin[3] = { from.x, from.y, from.z }, motion[3] = { along.x, along.y, along.z };
    double t;
    uint32_t face;
    memset(hit_out, 0, sizeof *hit_out);
    if (!tl_hull_clip_ray(pair->a->hull, origin, motion, t_max, &t, &face)) {
        return true;
    }
    if (face == TL_NO_VERTEX) {
        return false;
    }
    tl_hull_plane plane = tl_hull_face_plane(pair->a->hull, face);
    tl_vec3d normal = tl_vec3d_make(plane.normal[0], plane.normal[1], plane.normal[2]);
    hit_out->hit = true;
    hit_out->t = round_time_down(t);
    hit_out->point = tl_minkowski_to_world(pair, tl_vec3d_mul_add(from, along, t));
    hit_out->normal = tl_vec3d_to_float(tl_frame_rotate(&pair->a_to_world, normal));
    return true;
}

bool tl_convex_cast_ray(const tl_convex *shape, tl_transform pose, tl_vec3 origin, tl_vec3 direction, float t_max,
                        tl_convex_hit *hit_out)
{
    TL_ASSERT(shape != NULL && hit_out != NULL);
    tl_convex point = tl_convex_sphere(tl_vec3_make(0.0f, 0.0f, 0.0f), 0.0f);
    tl_transform at_origin = tl_transform_identity();
    at_origin.position = origin;
    tl_minkowski pair;
    if (!tl_minkowski_init(&pair, shape, &pose, &point, &at_origin) || !tl_is_finite(direction) || isnan(t_max)) {
        return refuse_not_finite(hit_out);
    }
    if (shape->kind == TL_CONVEX_HULL && shape->radius == 0.0f &&
        clip_by_hull(&pair, direction, (double)t_max, hit_out)) {
        return hit_out->hit;
    }
    return cast_pair(&pair, direction, (double)t_max, hit_out);
}
