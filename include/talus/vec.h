// SPDX-License-Identifier: MIT
//
// Vectors, boxes and transforms, by value. All inline: a call costs what its arithmetic costs.
//
// Lengths are metres unless a name says otherwise, y is up, angles are radians. The order of operations in
// each function is part of its contract: the library's results are reproducible bit by bit. Functions without a comment
// do what their names say, component by component where that makes sense.

#ifndef TALUS_VEC_H
#define TALUS_VEC_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A point in metres, or a direction.
typedef struct tl_vec3 {
    float x, y, z;
} tl_vec3;

/// A rotation as a unit quaternion w + xi + yj + zk. All zero is the identity, in every function of talus that takes a
/// quaternion or a transform, so a zeroed transform is one too. Any other quaternion must be unit.
typedef struct tl_quat {
    float x, y, z, w;
} tl_quat;

/// A rigid motion: rotate, then translate. All zero is the identity.
typedef struct tl_transform {
    tl_quat rotation; ///< first
    tl_vec3 position; ///< metres, added then
} tl_transform;

/// A closed axis-aligned box. Empty when min > max on any axis; `tl_aabb_empty()` is the neutral element of union.
typedef struct tl_aabb {
    tl_vec3 min, max;
} tl_aabb;

static inline tl_vec3 tl_vec3_make(float x, float y, float z)
{
    tl_vec3 v = { x, y, z };
    return v;
}

static inline tl_vec3 tl_add(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline tl_vec3 tl_sub(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline tl_vec3 tl_neg(tl_vec3 a)
{
    return tl_vec3_make(-a.x, -a.y, -a.z);
}

static inline tl_vec3 tl_scale(tl_vec3 a, float s)
{
    return tl_vec3_make(a.x * s, a.y * s, a.z * s);
}

/// Componentwise product.
static inline tl_vec3 tl_mul(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

/// a + b * s
static inline tl_vec3 tl_mul_add(tl_vec3 a, tl_vec3 b, float s)
{
    return tl_vec3_make(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

/// a at t = 0, b at t = 1, exactly at both ends.
static inline tl_vec3 tl_lerp(tl_vec3 a, tl_vec3 b, float t)
{
    float s = 1.0f - t;
    return tl_vec3_make(a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t);
}

static inline float tl_dot(tl_vec3 a, tl_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline tl_vec3 tl_cross(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float tl_length_sq(tl_vec3 a)
{
    return tl_dot(a, a);
}

static inline float tl_length(tl_vec3 a)
{
    return sqrtf(tl_dot(a, a));
}

static inline float tl_distance_sq(tl_vec3 a, tl_vec3 b)
{
    return tl_length_sq(tl_sub(a, b));
}

static inline float tl_distance(tl_vec3 a, tl_vec3 b)
{
    return tl_length(tl_sub(a, b));
}

/// The direction of a, or zero when a is zero or its squared length underflows.
static inline tl_vec3 tl_normalize(tl_vec3 a)
{
    float length = tl_length(a);
    return length > 0.0f ? tl_scale(a, 1.0f / length) : tl_vec3_make(0.0f, 0.0f, 0.0f);
}

/// The second of equal ones, and when either is NaN.
static inline float tl_minf(float a, float b)
{
    return a < b ? a : b;
}

/// The second of equal ones, and when either is NaN.
static inline float tl_maxf(float a, float b)
{
    return a > b ? a : b;
}

static inline float tl_clampf(float value, float low, float high)
{
    return value < low ? low : value > high ? high : value;
}

static inline tl_vec3 tl_min(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(tl_minf(a.x, b.x), tl_minf(a.y, b.y), tl_minf(a.z, b.z));
}

static inline tl_vec3 tl_max(tl_vec3 a, tl_vec3 b)
{
    return tl_vec3_make(tl_maxf(a.x, b.x), tl_maxf(a.y, b.y), tl_maxf(a.z, b.z));
}

static inline tl_vec3 tl_abs(tl_vec3 a)
{
    return tl_vec3_make(fabsf(a.x), fabsf(a.y), fabsf(a.z));
}

static inline bool tl_is_finite(tl_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/// The box of no points: min is +infinity, max is -infinity.
static inline tl_aabb tl_aabb_empty(void)
{
    tl_aabb box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    return box;
}

static inline tl_aabb tl_aabb_add_point(tl_aabb box, tl_vec3 point)
{
    tl_aabb result = { tl_min(box.min, point), tl_max(box.max, point) };
    return result;
}

static inline tl_aabb tl_aabb_union(tl_aabb a, tl_aabb b)
{
    tl_aabb result = { tl_min(a.min, b.min), tl_max(a.max, b.max) };
    return result;
}

static inline tl_aabb tl_aabb_intersection(tl_aabb a, tl_aabb b)
{
    tl_aabb result = { tl_max(a.min, b.min), tl_min(a.max, b.max) };
    return result;
}

/// Whether min > max, or either is NaN, on any axis.
static inline bool tl_aabb_is_empty(tl_aabb box)
{
    return !(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
}

/// Whether two closed boxes share a point.
static inline bool tl_aabb_overlaps(tl_aabb a, tl_aabb b)
{
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y && a.min.z <= b.max.z &&
           a.max.z >= b.min.z;
}

/// Whether a point lies in a closed box.
static inline bool tl_aabb_contains(tl_aabb box, tl_vec3 p)
{
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
           p.z <= box.max.z;
}

static inline tl_vec3 tl_aabb_center(tl_aabb box)
{
    return tl_scale(tl_add(box.min, box.max), 0.5f);
}

static inline tl_vec3 tl_aabb_size(tl_aabb box)
{
    return tl_sub(box.max, box.min);
}

/// Half of the surface: the measure of the surface area heuristic. The box must not be empty.
static inline float tl_aabb_half_area(tl_aabb box)
{
    tl_vec3 size = tl_aabb_size(box);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

static inline tl_quat tl_quat_identity(void)
{
    tl_quat q = { 0.0f, 0.0f, 0.0f, 1.0f };
    return q;
}

/// v rotated by q: v + 2w(u x v) + 2(u x (u x v)), u the vector part.
static inline tl_vec3 tl_rotate(tl_quat q, tl_vec3 v)
{
    tl_vec3 u = tl_vec3_make(q.x, q.y, q.z);
    tl_vec3 t = tl_scale(tl_cross(u, v), 2.0f);
    return tl_add(tl_mul_add(v, t, q.w), tl_cross(u, t));
}

/// The identity when q is all zero, else q.
static inline tl_quat tl_quat_or_identity(tl_quat q)
{
    bool zero = q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 0.0f;
    return zero ? tl_quat_identity() : q;
}

/// The rotation back. Of an all zero quaternion the same, all zero.
static inline tl_quat tl_quat_conjugate(tl_quat q)
{
    tl_quat r = { -q.x, -q.y, -q.z, q.w };
    return r;
}

/// v rotated back: the inverse of tl_rotate.
static inline tl_vec3 tl_inverse_rotate(tl_quat q, tl_vec3 v)
{
    return tl_rotate(tl_quat_conjugate(q), v);
}

/// First b, then a.
static inline tl_quat tl_quat_mul(tl_quat a, tl_quat b)
{
    a = tl_quat_or_identity(a);
    b = tl_quat_or_identity(b);
    tl_quat r = { a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                  a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z };
    return r;
}

/// The unit quaternion in the direction of q, or the identity when q is zero or its squared length underflows.
static inline tl_quat tl_quat_normalize(tl_quat q)
{
    float length = sqrtf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    if (!(length > 0.0f)) {
        return tl_quat_identity();
    }
    float s = 1.0f / length;
    tl_quat r = { q.x * s, q.y * s, q.z * s, q.w * s };
    return r;
}

static inline tl_transform tl_transform_identity(void)
{
    tl_transform t = { { 0.0f, 0.0f, 0.0f, 1.0f }, { 0.0f, 0.0f, 0.0f } };
    return t;
}

/// p rotated, then moved.
static inline tl_vec3 tl_transform_point(tl_transform t, tl_vec3 p)
{
    return tl_add(tl_rotate(t.rotation, p), t.position);
}

/// p moved back, then rotated back: the inverse of tl_transform_point.
static inline tl_vec3 tl_inverse_transform_point(tl_transform t, tl_vec3 p)
{
    return tl_inverse_rotate(t.rotation, tl_sub(p, t.position));
}

/// First b, then a.
static inline tl_transform tl_transform_mul(tl_transform a, tl_transform b)
{
    tl_transform t = { tl_quat_mul(a.rotation, b.rotation), tl_transform_point(a, b.position) };
    return t;
}

/// b seen from a: inverse(a) * b.
static inline tl_transform tl_transform_relative(tl_transform a, tl_transform b)
{
    tl_transform t = { tl_quat_mul(tl_quat_conjugate(a.rotation), b.rotation),
                       tl_inverse_transform_point(a, b.position) };
    return t;
}

#ifdef __cplusplus
}
#endif

#endif
