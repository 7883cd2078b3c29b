// SPDX-License-Identifier: MIT
//
// An instance's box in its own space, and in the world: the box around its rotated box.
//
// The box of the rotated box is looser than that of the rotated triangles, but it costs 20 ns and reads no triangle; a
// ray that enters an instance in vain leaves it after the box of its root.
//
// What must not be missed (u is 2^-24, sizes are sums over three coordinates, as these bound all norms; |p| that of the
// position, r of the farthest corner of the instance's box from the instance's own origin, |o| that of the query):
//
// - A query in the instance's space moves a point there by u times its distance from the instance's origin. So a ray at
//   the t of its hit is off by u (|o'| + t |d'|), where |o'| <= |o| + |p| and t |d'| <= |o'| + r: by
//   u (2 |o| + 2 |p| + r).
// - A cast at a shape may stop early, by up to 8 u of the shapes' diameters: 16 u r of this one.
// - Planes are rounded to float: u (|p| + r). Frames and sums in double, of about forty roundings, are off by 2^-23 of
//   that.
//
// So the box is widened by 32 u (|p| + r), the instance's part; the part of |o| widens the query.

#include "scene/instance_box.h"

#include "math/tolerance.h"

#include <float.h>

static float round_out(double at, double sign)
{
    return (float)(at + sign * (fabs(at) * TL_FLOAT_OUTWARD + (double)FLT_MIN));
}

// A hull's own bounds, grown: its six support points would cost more than everything else.
static tl_aabb hull_box(const tl_hull *hull, float radius)
{
    tl_vec3 low = hull->bounds.min, high = hull->bounds.max;
    double r = (double)radius;
    tl_aabb box = {
        { round_out((double)low.x - r, -1.0), round_out((double)low.y - r, -1.0), round_out((double)low.z - r, -1.0) },
        { round_out((double)high.x + r, 1.0), round_out((double)high.y + r, 1.0), round_out((double)high.z + r, 1.0) }
    };
    return box;
}

static bool is_within_range(tl_vec3 a)
{
    return fabsf(a.x) <= TL_MAX_COORDINATE && fabsf(a.y) <= TL_MAX_COORDINATE && fabsf(a.z) <= TL_MAX_COORDINATE;
}

tl_result tl_scene_read_instance(const tl_scene_instance *instance, tl_aabb *local_out)
{
    tl_quat q = instance->pose.rotation;
    if (!tl_is_finite(instance->pose.position) || !isfinite(q.x) || !isfinite(q.y) || !isfinite(q.z) ||
        !isfinite(q.w)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!is_within_range(instance->pose.position)) {
        return TL_ERR_RANGE;
    }
    const tl_convex *shape = instance->shape;
    if (shape == NULL && instance->soup == NULL) {
        *local_out = tl_aabb_empty();
        return TL_OK;
    }
    if (shape != NULL && (instance->soup != NULL || !(shape->radius >= 0.0f))) {
        return TL_ERR_ARGUMENT;
    }
    *local_out = shape == NULL                   ? tl_soup_bounds(instance->soup)
                 : shape->kind == TL_CONVEX_HULL ? hull_box(shape->hull, shape->radius)
                                                 : tl_convex_bounds(shape, tl_transform_identity());
    if (!tl_is_finite(local_out->min) || !tl_is_finite(local_out->max)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!is_within_range(local_out->min) || !is_within_range(local_out->max)) {
        return TL_ERR_RANGE;
    }
    return tl_aabb_is_empty(*local_out) ? TL_ERR_ARGUMENT : TL_OK;
}

// In double, rounded once; nothing is here: a point.
static tl_scene_own_box own_box(const tl_frame *frame, tl_vec3 position, tl_aabb local)
{
    tl_vec3d low = tl_vec3d_make(0.0, 0.0, 0.0), high = low;
    if (!tl_aabb_is_empty(local)) {
        low = tl_vec3d_from(local.min);
        high = tl_vec3d_from(local.max);
    }
    tl_vec3d middle = tl_vec3d_scale(tl_vec3d_add(low, high), 0.5), at = tl_vec3d_from(position);
    tl_vec3d half = tl_vec3d_scale(tl_vec3d_sub(high, low), 0.5);
    const tl_vec3d *r = frame->rows;
    tl_vec3d local_at =
        tl_vec3d_make(r[0].x * at.x + r[1].x * at.y + r[2].x * at.z, r[0].y * at.x + r[1].y * at.y + r[2].y * at.z,
                      r[0].z * at.x + r[1].z * at.y + r[2].z * at.z);
    tl_scene_own_box own;
    for (int i = 0; i < 3; i++) {
        own.axes[i] = tl_vec3d_to_float(r[i]);
    }
    own.offset = tl_vec3d_to_float(tl_vec3d_neg(tl_vec3d_add(local_at, middle)));
    own.half = tl_vec3d_to_float(half);
    own.size = (float)(tl_vec3d_size(at) + tl_vec3d_size(middle) + tl_vec3d_size(half));
    return own;
}

void tl_scene_place_instance(tl_scene_record *record, tl_transform pose, tl_aabb local)
{
    tl_frame frame = tl_frame_from(pose);
    for (int i = 0; i < 3; i++) {
        record->rows[i] = frame.rows[i];
    }
    record->own = own_box(&frame, pose.position, local);
    record->pose = pose;
    record->local = local;
}

static void span(tl_vec3d row, tl_vec3d middle, tl_vec3d half, float position, double wider, float *min, float *max)
{
    double at = row.x * middle.x + row.y * middle.y + row.z * middle.z + (double)position;
    double reach = fabs(row.x) * half.x + fabs(row.y) * half.y + fabs(row.z) * half.z + wider;
    *min = (float)(at - reach);
    *max = (float)(at + reach);
}

tl_aabb tl_scene_world_box(const tl_scene_record *record)
{
    if (tl_aabb_is_empty(record->local)) {
        return record->local;
    }
    tl_vec3d low = tl_vec3d_from(record->local.min), high = tl_vec3d_from(record->local.max);
    tl_vec3d middle = tl_vec3d_scale(tl_vec3d_add(low, high), 0.5);
    tl_vec3d half = tl_vec3d_scale(tl_vec3d_sub(high, low), 0.5);
    tl_vec3 at = record->pose.position;
    double size = tl_scene_size(at) + tl_vec3d_size(middle) + tl_vec3d_size(half);
    double wider = (double)TL_SCENE_WIDEN * size + (double)FLT_MIN;
    tl_aabb box;
    span(record->rows[0], middle, half, at.x, wider, &box.min.x, &box.max.x);
    span(record->rows[1], middle, half, at.y, wider, &box.min.y, &box.max.y);
    span(record->rows[2], middle, half, at.z, wider, &box.min.z, &box.max.z);
    return box;
}
