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
//
// A scale changes none of that, where r is that of the scaled box: coordinates are divided by a factor each, and the
// rounding of each is a share of itself. Corners and support points of a scaled instance round once more, by u r.

#include "scene/instance_box.h"

#include "base/assert.h"
#include "base/compiler.h"
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

// Whether the shape takes the scale, and the scaled box is within range.
static TL_NOINLINE tl_result check_scaled(const tl_scene_instance *instance, tl_aabb local)
{
    tl_scaled_convex room;
    if (instance->shape != NULL) {
        TL_TRY(tl_scaled_convex_make(instance->shape, instance->scale, &room, NULL));
    }
    bool within =
        is_within_range(tl_mul(local.min, instance->scale)) && is_within_range(tl_mul(local.max, instance->scale));
    return within ? TL_OK : TL_ERR_RANGE;
}

tl_result tl_scene_read_instance(const tl_scene_instance *instance, tl_aabb *local_out)
{
    if (!tl_pose_is_finite(instance->pose)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!is_within_range(instance->pose.position)) {
        return TL_ERR_RANGE;
    }
    bool is_scaled = !tl_scale_is_one(instance->scale);
    if (is_scaled) {
        TL_TRY(tl_scale_check(instance->scale, TL_MAX_SCALE));
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
    if (tl_aabb_is_empty(*local_out)) {
        return TL_ERR_ARGUMENT;
    }
    return is_scaled ? check_scaled(instance, *local_out) : TL_OK;
}

// An instance's box at its scale, in the frame of its rotation.
typedef struct scaled_box {
    tl_vec3d middle, half;
    double size; // of the position, the middle and the extents, summed over all axes
} scaled_box;

// Where nothing is, a point.
static scaled_box scale_box(tl_aabb local, tl_vec3d by, tl_vec3d at)
{
    scaled_box box = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, tl_vec3d_size(at) };
    if (!tl_aabb_is_empty(local)) {
        tl_vec3d low = tl_vec3d_mul(tl_vec3d_from(local.min), by), high = tl_vec3d_mul(tl_vec3d_from(local.max), by);
        tl_vec3d size = tl_vec3d_sub(high, low); // negative along mirrored axes
        box.middle = tl_vec3d_scale(tl_vec3d_add(low, high), 0.5);
        box.half = tl_vec3d_scale(tl_vec3d_make(fabs(size.x), fabs(size.y), fabs(size.z)), 0.5);
        box.size += tl_vec3d_size(box.middle) + tl_vec3d_size(box.half);
    }
    return box;
}

// In double, rounded once.
static tl_scene_own_box own_box(const tl_frame *frame, const scaled_box *box)
{
    const tl_vec3d *r = frame->rows;
    tl_scene_own_box own;
    for (int i = 0; i < 3; i++) {
        own.axes[i] = tl_vec3d_to_float(r[i]);
    }
    tl_vec3d local_at = tl_frame_rotate_back(frame, frame->origin);
    own.offset = tl_vec3d_to_float(tl_vec3d_neg(tl_vec3d_add(local_at, box->middle)));
    own.half = tl_vec3d_to_float(box->half);
    own.size = (float)box->size;
    return own;
}

static void span(tl_vec3d row, const scaled_box *box, double position, double wider, float *min, float *max)
{
    double at = row.x * box->middle.x + row.y * box->middle.y + row.z * box->middle.z + position;
    double reach = fabs(row.x) * box->half.x + fabs(row.y) * box->half.y + fabs(row.z) * box->half.z + wider;
    *min = (float)(at - reach);
    *max = (float)(at + reach);
}

static tl_aabb world_box(const tl_frame *frame, const scaled_box *box)
{
    double wider = (double)TL_SCENE_WIDEN * box->size + (double)FLT_MIN;
    tl_aabb world;
    span(frame->rows[0], box, frame->origin.x, wider, &world.min.x, &world.max.x);
    span(frame->rows[1], box, frame->origin.y, wider, &world.min.y, &world.max.y);
    span(frame->rows[2], box, frame->origin.z, wider, &world.min.z, &world.max.z);
    return world;
}

tl_aabb tl_scene_place_instance(tl_scene_record *record, tl_scene_place *place, const tl_scene_instance *instance,
                                tl_aabb local)
{
    tl_frame frame = tl_frame_from(instance->pose);
    place->scale = tl_scale_factors(instance->scale);
    tl_vec3d by = tl_vec3d_from(place->scale);
    scaled_box box = scale_box(local, by, frame.origin);
    record->own = own_box(&frame, &box);
    record->pose = instance->pose;
    record->local = local;
    record->way = tl_scale_is_one(place->scale) ? tl_scene_rigid_way(&instance->pose) : (uint32_t)TL_SCENE_SCALED;
    for (int i = 0; i < 3; i++) {
        const tl_vec3d row = frame.rows[i];
        record->rows[i] = tl_scene_is_scaled(record) ? tl_vec3d_make(row.x / by.x, row.y / by.y, row.z / by.z) : row;
    }
    return tl_aabb_is_empty(local) ? local : world_box(&frame, &box);
}
