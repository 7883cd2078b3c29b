// SPDX-License-Identifier: MIT
//
// Cast with rotation, by conservative advancement (Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems,
// 1996): the distance at a time has a separating plane, and until the fastest point of B can have reached it, B is
// free.
//
// Speed along the plane's normal n is that of the position, v . n, and at most w R of the rotation: R is the farthest
// that B reaches from its own origin, w the largest angular speed. The mean of two quaternions p apart (an angle of
// the sphere of quaternions, half of the rotation's) turns fastest at half time, by 4 tan(p / 2), which takes a root
// and no transcendental function. Evaluating the plane along the whole motion (Zhang, Lee, Kim, Interactive Continuous
// Collision Detection for Non-Convex Polyhedra, 2006) takes fewer and dearer steps.

#include "base/assert.h"
#include "convex/core/minkowski.h"
#include "math/tolerance.h"

#include <string.h>

// A pose of floats: its position is rounded, its rotation to a few roundings.
#define POSE_ROUNDING (8.0 * (double)TL_FLOAT_ROUNDING)

typedef struct turning_cast {
    tl_transform from, to;
    tl_vec3d velocity;
    double turn_speed; // of B's farthest point, metres in the whole time
    double noise;      // metres that a pose in between may be off
} turning_cast;

static tl_quat unit_quat(tl_quat q)
{
    bool zero = q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 0.0f;
    return zero ? tl_quat_identity() : tl_quat_normalize(q);
}

// How far any point of a shape is from its origin, at most.
static double reach_of(const tl_convex *shape)
{
    tl_aabb box = tl_convex_bounds(shape, tl_transform_identity());
    tl_vec3 far = tl_max(tl_abs(box.min), tl_abs(box.max));
    return tl_vec3d_length(tl_vec3d_from(far));
}

static bool start_turning(turning_cast *c, const tl_convex *b, tl_transform from, tl_transform to)
{
    c->from = from;
    c->to = to;
    c->from.rotation = unit_quat(from.rotation);
    c->to.rotation = unit_quat(to.rotation);
    tl_quat p = c->from.rotation, q = c->to.rotation;
    double cosine =
        (double)p.x * (double)q.x + (double)p.y * (double)q.y + (double)p.z * (double)q.z + (double)p.w * (double)q.w;
    if (cosine < 0.0) { // the shorter way
        tl_quat other = { -q.x, -q.y, -q.z, -q.w };
        c->to.rotation = other;
        cosine = -cosine;
    }
    cosine = cosine < 1.0 ? cosine : 1.0;
    double reach = reach_of(b);
    // Floats leave of a small angle what the root of a rounding is: the difference of both bounds it as well.
    tl_quat r = c->to.rotation;
    double x = (double)r.x - (double)p.x, y = (double)r.y - (double)p.y, z = (double)r.z - (double)p.z,
           w = (double)r.w - (double)p.w;
    double chord = sqrt(x * x + y * y + z * z + w * w); // twice the sine of half the angle
    c->turn_speed = 2.0 * chord / sqrt(0.5 * (1.0 + cosine)) * reach * (1.0 + 16.0 * (double)TL_FLOAT_ROUNDING);
    c->velocity = tl_vec3d_sub(tl_vec3d_from(to.position), tl_vec3d_from(from.position));
    c->noise = POSE_ROUNDING *
               (tl_vec3d_size(tl_vec3d_from(from.position)) + tl_vec3d_size(tl_vec3d_from(to.position)) + reach);
    return isfinite(c->turn_speed + c->noise);
}

static float mix(float p, float q, double t)
{
    return (float)((double)p * (1.0 - t) + (double)q * t);
}

static tl_transform pose_at(const turning_cast *c, double t)
{
    const tl_quat p = c->from.rotation, q = c->to.rotation;
    tl_quat r = { mix(p.x, q.x, t), mix(p.y, q.y, t), mix(p.z, q.z, t), mix(p.w, q.w, t) };
    tl_transform pose = { tl_quat_normalize(r),
                          tl_vec3d_to_float(tl_vec3d_mul_add(tl_vec3d_from(c->from.position), c->velocity, t)) };
    return pose;
}

// Not late when rounded to float.
static float float_not_later(double t)
{
    float rounded = (float)t;
    return (double)rounded > t ? rounded * (1.0f - 2.0f * TL_FLOAT_ROUNDING) : rounded;
}

bool tl_convex_cast_turning(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform from,
                            tl_transform to, float gap, tl_convex_hit *hit_out)
{
    TL_ASSERT(a != NULL && b != NULL && hit_out != NULL);
    memset(hit_out, 0, sizeof *hit_out);
    tl_minkowski pair;
    turning_cast c;
    if (!tl_minkowski_init(&pair, a, &pose_a, b, &from) || !tl_minkowski_init(&pair, a, &pose_a, b, &to) ||
        !(gap > 0.0f) || !start_turning(&c, b, from, to)) {
        hit_out->status = TL_CONVEX_NOT_FINITE;
        return false;
    }
    tl_simplex_cache cache = { 0 };
    tl_separation s;
    double t = 0.0;
    for (;;) {
        tl_convex_distance(a, pose_a, b, pose_at(&c, t), &cache, &s);
        double free = (double)s.lower_bound - c.noise;
        if (s.overlap || s.distance <= gap || free <= 0.25 * (double)gap) {
            break;
        }
        // Along the plane's normal, which leads from A to B.
        double rate = c.turn_speed - tl_vec3d_dot(c.velocity, tl_vec3d_from(s.normal)) +
                      tl_vec3d_size(c.velocity) * 4.0 * (double)TL_FLOAT_ROUNDING;
        if (rate <= 0.0 || t + free / rate > 1.0) {
            return false;
        }
        t += free / rate;
        if (++hit_out->iterations == TL_MAX_CAST_ITERATIONS) {
            hit_out->status = TL_CONVEX_ITERATIONS;
            break;
        }
    }
    hit_out->hit = true;
    hit_out->initial_overlap = s.overlap && t == 0.0;
    hit_out->t = float_not_later(t);
    hit_out->gap = s.distance;
    hit_out->point = s.point_a;
    hit_out->normal = hit_out->initial_overlap ? tl_vec3_make(0.0f, 0.0f, 0.0f) : s.normal;
    return true;
}
