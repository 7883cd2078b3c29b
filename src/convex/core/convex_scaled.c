// SPDX-License-Identifier: MIT
//
// Shapes at a scale. What is given by a few numbers is scaled by them; what points elsewhere gets a support function:
// the support of S A along d is S times that of A along S d, since d . S p = S d . p.
//
// Source: van den Bergen, Collision Detection in Interactive 3D Environments, 2003, section 4.3 (affine images).

#include <talus/convex_scaled.h>

#include "base/assert.h"
#include "base/host.h"
#include "convex/core/farthest.h"
#include "math/scale.h"

#include <string.h>

// Larger hulls climb.
#define SCANNED_SCALED 12u

static tl_vec3 farthest_of(const tl_convex *shape, tl_vec3 direction)
{
    const tl_vec3d along = tl_vec3d_from(direction);
    if (shape->kind == TL_CONVEX_CUSTOM) {
        return shape->support(direction, shape->user);
    }
    if (shape->kind == TL_CONVEX_POINTS) {
        return shape->points[tl_farthest(shape->points, shape->point_count, &along)];
    }
    const tl_vec3 *vertices = tl_hull_vertices(shape->hull);
    return vertices[shape->hull->vertex_count <= SCANNED_SCALED
                        ? tl_farthest(vertices, shape->hull->vertex_count, &along)
                        : tl_hull_support(shape->hull, direction, TL_NO_VERTEX)];
}

static tl_vec3 scaled_support(tl_vec3 direction, void *user)
{
    const tl_scaled_convex *s = (const tl_scaled_convex *)user;
    return tl_mul(farthest_of(s->of, tl_mul(direction, s->scale)), s->scale);
}

// The size of the factors across a cylinder's or cone's axis, where they are the same; else 0.
static float scale_across(const tl_convex *shape, tl_vec3 scale)
{
    tl_vec3 axis = tl_sub(shape->corners[1], shape->corners[0]), size = tl_abs(scale);
    if (axis.y == 0.0f && axis.z == 0.0f) {
        return size.y == size.z ? size.y : 0.0f;
    }
    if (axis.x == 0.0f && axis.z == 0.0f) {
        return size.x == size.z ? size.x : 0.0f;
    }
    return size.x == size.y && (size.y == size.z || (axis.x == 0.0f && axis.y == 0.0f)) ? size.x : 0.0f;
}

static bool scale_fields(const tl_convex *shape, tl_vec3 scale, tl_convex *scaled)
{
    if (shape->radius != 0.0f && !tl_scale_is_uniform(scale)) {
        return false;
    }
    *scaled = *shape;
    scaled->radius = shape->radius * fabsf(scale.x);
    for (int i = 0; i < 3; i++) {
        scaled->corners[i] = tl_mul(shape->corners[i], scale);
    }
    if (shape->kind == TL_CONVEX_BOX) {
        scaled->corners[1] = tl_mul(shape->corners[1], tl_abs(scale));
    }
    if (shape->kind == TL_CONVEX_CYLINDER || shape->kind == TL_CONVEX_CONE) {
        const float across = scale_across(shape, scale);
        scaled->corners[2] = tl_scale(shape->corners[2], across);
        return across > 0.0f;
    }
    return true;
}

tl_result tl_scaled_convex_make(const tl_convex *shape, tl_vec3 scale, tl_scaled_convex *scaled_out,
                                tl_report *report_out)
{
    tl_report_begin(report_out, "scale shape");
    if (scaled_out != NULL) {
        memset(scaled_out, 0, sizeof *scaled_out);
    }
    if (shape == NULL || scaled_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, shape == NULL ? "shape" : "scaled_out",
                               "give a shape and a place for the scaled one");
    }
    const tl_result result = tl_scale_check(scale, TL_MAX_SCALE);
    if (result != TL_OK) {
        return tl_report_field(report_out, result, "scale", "make each factor finite, within TL_MAX_SCALE, and not 0");
    }
    scale = tl_scale_factors(scale);
    tl_convex scaled;
    if (!scale_fields(shape, scale, &scaled)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "scale", "scale a rounded shape alike along all axes");
    }
    scaled_out->of = shape;
    scaled_out->scale = scale;
    scaled_out->shape = scaled;
    const bool points_elsewhere =
        shape->kind == TL_CONVEX_HULL || shape->kind == TL_CONVEX_POINTS || shape->kind == TL_CONVEX_CUSTOM;
    if (points_elsewhere && !tl_scale_is_one(scale)) {
        scaled_out->shape = tl_convex_custom(scaled_support, scaled_out, scaled.radius);
    }
    return TL_OK;
}
