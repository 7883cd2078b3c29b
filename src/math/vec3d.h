// SPDX-License-Identifier: MIT
//
// Double vectors, for queries that compute in the pair's own frame.

#ifndef TALUS_SRC_MATH_VEC3D_H
#define TALUS_SRC_MATH_VEC3D_H

#include "base/compiler.h"

#include <talus/vec.h>

typedef struct tl_vec3d {
    double x, y, z;
} tl_vec3d;

static inline tl_vec3d tl_vec3d_make(double x, double y, double z)
{
    tl_vec3d r = { x, y, z };
    return r;
}

// Loads three numbers one by one. Compilers make a vector of two of them, and a load of two that were stored apart, or
// each with another neighbour, waits until both stores are done: a dozen cycles.
static inline tl_vec3d tl_vec3d_load_apart(const tl_vec3d *a)
{
    tl_vec3d r = *a;
#if defined(__SSE2__)
    TL_KEEP_VECTOR(r.x);
    TL_KEEP_VECTOR(r.y);
    TL_KEEP_VECTOR(r.z);
#endif
    return r;
}

static inline tl_vec3d tl_vec3d_from(tl_vec3 a)
{
    return tl_vec3d_make((double)a.x, (double)a.y, (double)a.z);
}

static inline tl_vec3 tl_vec3d_to_float(tl_vec3d a)
{
    return tl_vec3_make((float)a.x, (float)a.y, (float)a.z);
}

static inline tl_vec3d tl_vec3d_add(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline tl_vec3d tl_vec3d_sub(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline tl_vec3d tl_vec3d_neg(tl_vec3d a)
{
    return tl_vec3d_make(-a.x, -a.y, -a.z);
}

static inline tl_vec3d tl_vec3d_scale(tl_vec3d a, double s)
{
    return tl_vec3d_make(a.x * s, a.y * s, a.z * s);
}

/// Axis by axis.
static inline tl_vec3d tl_vec3d_mul(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline tl_vec3d tl_vec3d_mul_add(tl_vec3d a, tl_vec3d b, double s)
{
    return tl_vec3d_make(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

static inline double tl_vec3d_dot(tl_vec3d a, tl_vec3d b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline tl_vec3d tl_vec3d_cross(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double tl_vec3d_length(tl_vec3d a)
{
    return sqrt(tl_vec3d_dot(a, a));
}

// The sum of the components' sizes: a bound of the length that costs no root.
static inline double tl_vec3d_size(tl_vec3d a)
{
    return fabs(a.x) + fabs(a.y) + fabs(a.z);
}

// The direction of a vector, rounded to float; zero when its length underflows.
static inline tl_vec3 tl_vec3d_unit_or_zero(tl_vec3d a)
{
    double length_sq = tl_vec3d_dot(a, a);
    return tl_vec3d_to_float(tl_vec3d_scale(a, length_sq > 0.0 ? 1.0 / sqrt(length_sq) : 0.0));
}

// A unit vector across a unit vector.
static inline tl_vec3d tl_vec3d_perpendicular(tl_vec3d d)
{
    // Across the axis that d is least along; chosen without a branch, since it is as good as random.
    double x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    int least_x = (x <= y) & (x <= z), least_y = (y <= z) & (1 - least_x);
    double along_x = (double)least_x, along_y = (double)least_y;
    tl_vec3d axis = tl_vec3d_make(along_x, along_y, 1.0 - along_x - along_y);
    tl_vec3d p = tl_vec3d_cross(d, axis);
    return tl_vec3d_scale(p, 1.0 / tl_vec3d_length(p));
}

// The rotation matrix's rows, and where the origin goes.
typedef struct tl_frame {
    tl_vec3d rows[3];
    tl_vec3d origin;
} tl_frame;

// A rotation. Its length is free, since `length_sq` is divided out.
typedef struct tl_quatd {
    double x, y, z, w, length_sq;
} tl_quatd;

// A zero quaternion is the identity.
static inline tl_quatd tl_quatd_from(tl_quat r)
{
    tl_quatd q = { (double)r.x, (double)r.y, (double)r.z, (double)r.w, 0.0 };
    q.length_sq = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (!(q.length_sq > 0.0)) {
        q.w = q.length_sq = 1.0;
    }
    return q;
}

// The rotation by `by`, then back by `from`.
static inline tl_quatd tl_quatd_between(tl_quatd from, tl_quatd by)
{
    tl_quatd q = { (from.w * by.x - from.x * by.w) - (from.y * by.z - from.z * by.y),
                   (from.w * by.y - from.y * by.w) - (from.z * by.x - from.x * by.z),
                   (from.w * by.z - from.z * by.w) - (from.x * by.y - from.y * by.x),
                   (from.w * by.w + from.x * by.x) + (from.y * by.y + from.z * by.z), from.length_sq * by.length_sq };
    return q;
}

static inline void tl_frame_set(tl_frame *frame, tl_quatd q, tl_vec3d origin)
{
    double s = 2.0 / q.length_sq, x = s * q.x, y = s * q.y, z = s * q.z;
    double xx = x * q.x, yy = y * q.y, zz = z * q.z, xy = x * q.y, xz = x * q.z, yz = y * q.z, xw = x * q.w,
           yw = y * q.w, zw = z * q.w;
    frame->rows[0] = tl_vec3d_make(1.0 - (yy + zz), xy - zw, xz + yw);
    frame->rows[1] = tl_vec3d_make(xy + zw, 1.0 - (xx + zz), yz - xw);
    frame->rows[2] = tl_vec3d_make(xz - yw, yz + xw, 1.0 - (xx + yy));
    frame->origin = origin;
}

static inline bool tl_pose_is_finite(tl_transform pose)
{
    tl_quat q = pose.rotation;
    return tl_is_finite(pose.position) && isfinite(q.x) && isfinite(q.y) && isfinite(q.z) && isfinite(q.w);
}

static inline tl_frame tl_frame_from(tl_transform pose)
{
    tl_frame f;
    tl_frame_set(&f, tl_quatd_from(pose.rotation), tl_vec3d_from(pose.position));
    return f;
}

static inline tl_vec3d tl_frame_rotate(const tl_frame *f, tl_vec3d v)
{
    return tl_vec3d_make(tl_vec3d_dot(f->rows[0], v), tl_vec3d_dot(f->rows[1], v), tl_vec3d_dot(f->rows[2], v));
}

static inline tl_vec3d tl_frame_rotate_back(const tl_frame *f, tl_vec3d v)
{
    return tl_vec3d_make(f->rows[0].x * v.x + f->rows[1].x * v.y + f->rows[2].x * v.z,
                         f->rows[0].y * v.x + f->rows[1].y * v.y + f->rows[2].y * v.z,
                         f->rows[0].z * v.x + f->rows[1].z * v.y + f->rows[2].z * v.z);
}

static inline tl_vec3d tl_frame_point(const tl_frame *f, tl_vec3d p)
{
    return tl_vec3d_add(tl_frame_rotate(f, p), f->origin);
}

#endif
