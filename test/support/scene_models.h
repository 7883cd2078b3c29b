// SPDX-License-Identifier: MIT
//
// Scenes for tests: soups and shapes at random poses and scales, and the way of a question into an instance's space.

#ifndef TALUS_TEST_SCENE_MODELS_H
#define TALUS_TEST_SCENE_MODELS_H

#include "math/scale.h"
#include "math/vec3d.h"
#include "soup_models.h"

#include <talus/scene.h>

enum { SCENE_SOUPS = 5, SCENE_SHAPES = 7 };

/// What instances are made of.
typedef struct scene_parts {
    model models[SCENE_SOUPS];
    tl_soup *soups[SCENE_SOUPS];
    tl_hull *hulls[2];
    tl_vec3 points[9];
    tl_convex shapes[SCENE_SHAPES];
} scene_parts;

static inline tl_hull *scene_hull(uint32_t count, float size, uint64_t seed)
{
    test_random random = { seed };
    tl_vec3 points[64];
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(test_random_direction(&random), size);
    }
    tl_hull *hull = NULL;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    return hull;
}

/// Soups of about `size` metres; one lies far from its own origin, one is flat.
static inline void scene_parts_make(scene_parts *parts, float size)
{
    memset(parts, 0, sizeof *parts);
    parts->models[0] = model_ball(2, size, 0.1f, tl_vec3_make(0, 0, 0), 1);
    parts->models[1] = model_random(60, size, 0.3f * size, 2);
    parts->models[2] = model_ball(1, 0.3f * size, 0.0f, tl_vec3_make(40 * size, -7 * size, 3 * size), 3);
    parts->models[3] = model_terrain(6, 1, tl_vec3_make(-3, 0, -3), 4);
    model flat = { 0 };
    model_vertex(&flat, -size, 0, -size);
    model_vertex(&flat, size, 0, -size);
    model_vertex(&flat, size, 0, size);
    model_vertex(&flat, -size, 0, size);
    model_triangle(&flat, 0, 2, 1);
    model_triangle(&flat, 0, 3, 2);
    parts->models[4] = flat;
    for (uint32_t i = 0; i < SCENE_SOUPS; i++) {
        tl_soup_def def = model_soup_def(i == 1 ? MODEL_COMPACT : MODEL_BOXES);
        parts->soups[i] = model_soup(&parts->models[i], &def);
    }
    parts->hulls[0] = scene_hull(12, size, 5);
    parts->hulls[1] = scene_hull(60, size, 6);
    test_random random = { 7 };
    for (uint32_t i = 0; i < 9; i++) {
        parts->points[i] =
            test_random_point(&random, tl_vec3_make(-size, -size, -size), tl_vec3_make(size, size, size));
    }
    tl_vec3 zero = tl_vec3_make(0, 0, 0), up = tl_vec3_make(0, size, 0);
    parts->shapes[0] = tl_convex_from_hull(parts->hulls[0], 0);
    parts->shapes[1] = tl_convex_from_hull(parts->hulls[1], 0.1f * size);
    parts->shapes[2] = tl_convex_box(up, tl_vec3_make(size, 0.5f * size, 0.2f * size), 0);
    parts->shapes[3] = tl_convex_sphere(up, size);
    parts->shapes[4] = tl_convex_capsule(zero, up, 0.3f * size);
    parts->shapes[5] = tl_convex_from_points(parts->points, 9, 0);
    parts->shapes[6] = tl_convex_cylinder(zero, up, 0.5f * size, 0);
}

static inline void scene_parts_free(scene_parts *parts)
{
    for (uint32_t i = 0; i < SCENE_SOUPS; i++) {
        tl_blob_free(parts->soups[i]);
        model_free(&parts->models[i]);
    }
    tl_blob_free(parts->hulls[0]);
    tl_blob_free(parts->hulls[1]);
}

static inline tl_quat scene_rotation(test_random *random)
{
    tl_quat q = { test_random_range(random, -1, 1), test_random_range(random, -1, 1), test_random_range(random, -1, 1),
                  test_random_range(random, -1, 1) };
    return q; // of any length
}

static inline float scene_factor(test_random *random)
{
    uint32_t kind = test_random_below(random, 4);
    return kind == 0   ? 2.0f
           : kind == 1 ? -test_random_range(random, 0.4f, 2.5f)
                       : test_random_range(random, 0.4f, 2.5f);
}

/// Mostly none; else one for all axes, mirrored or not, or, where the instance takes it, one for each.
static inline tl_vec3 scene_scale(test_random *random, const tl_convex *shape)
{
    uint32_t kind = test_random_below(random, 6);
    float x = scene_factor(random), y = scene_factor(random), z = scene_factor(random);
    if (kind < 3) {
        return kind == 0 ? tl_vec3_make(1, 1, 1) : tl_vec3_make(0, 0, 0);
    }
    if (kind == 3 || (shape != NULL && shape->radius > 0)) {
        return tl_vec3_make(x, y < 0 ? -x : x, x);
    }
    return tl_vec3_make(x, y, shape != NULL && shape->kind == TL_CONVEX_CYLINDER ? -x : z);
}

/// A random instance within `range` of `center`: a soup or a shape, turned, moved only, or nothing at all; some scaled.
static inline tl_scene_instance scene_instance(const scene_parts *parts, test_random *random, tl_vec3 center,
                                               float range)
{
    tl_scene_instance instance = { .pose = tl_transform_identity(), .mask = 1u << test_random_below(random, 4) };
    uint32_t what = test_random_below(random, 20);
    if (what < 12) {
        instance.soup = parts->soups[what % SCENE_SOUPS];
    } else if (what < 19) {
        instance.shape = &parts->shapes[what - 12];
    }
    tl_vec3 wide = tl_vec3_make(range, range, range);
    instance.pose.position = test_random_point(random, tl_sub(center, wide), tl_add(center, wide));
    if (test_random_below(random, 5) != 0) {
        instance.pose.rotation = scene_rotation(random);
    }
    instance.scale = scene_scale(random, instance.shape);
    return instance;
}

/// So many of them, one after the other.
static inline void scene_fill(const scene_parts *parts, test_random *random, tl_vec3 center, float range,
                              tl_scene_instance *instances, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = scene_instance(parts, random, center, range);
    }
}

static inline tl_scene *scene_build(const tl_scene_instance *instances, uint32_t count)
{
    tl_scene *scene = NULL;
    TEST_RESULT(tl_scene_bake(instances, count, NULL, &scene, NULL), TL_OK);
    return scene;
}

static inline bool scene_is_turned(const tl_scene_instance *instance)
{
    tl_quat q = instance->pose.rotation;
    return q.x != 0 || q.y != 0 || q.z != 0;
}

/// In the instance's space but for its scale, as scene.h says: in double, rounded once.
static inline tl_vec3 scene_direction_in(const tl_scene_instance *instance, tl_vec3 v)
{
    tl_frame frame = tl_frame_from(instance->pose);
    return scene_is_turned(instance) ? tl_vec3d_to_float(tl_frame_rotate_back(&frame, tl_vec3d_from(v))) : v;
}

static inline tl_vec3 scene_point_in(const tl_scene_instance *instance, tl_vec3 p)
{
    tl_frame frame = tl_frame_from(instance->pose);
    tl_vec3d v = tl_vec3d_sub(tl_vec3d_from(p), frame.origin);
    return tl_vec3d_to_float(scene_is_turned(instance) ? tl_frame_rotate_back(&frame, v) : v);
}

/// And back.
static inline tl_vec3 scene_direction_out(const tl_scene_instance *instance, tl_vec3 v)
{
    tl_frame frame = tl_frame_from(instance->pose);
    return scene_is_turned(instance) ? tl_vec3d_to_float(tl_frame_rotate(&frame, tl_vec3d_from(v))) : v;
}

static inline tl_vec3 scene_point_out(const tl_scene_instance *instance, tl_vec3 p)
{
    tl_frame frame = tl_frame_from(instance->pose);
    return tl_vec3d_to_float(tl_frame_point(&frame, tl_vec3d_from(p)));
}

/// The same for a ray, whose way in divides by the scale. The library's own, as its rounding is part of the answer.
static inline tl_frame scene_ray_frame(const tl_scene_instance *instance)
{
    tl_frame frame = tl_frame_from(instance->pose);
    for (int i = 0; i < 3; i++) {
        frame.rows[i].x /= (double)instance->scale.x;
        frame.rows[i].y /= (double)instance->scale.y;
        frame.rows[i].z /= (double)instance->scale.z;
    }
    return frame;
}

static inline tl_vec3 scene_ray_direction_in(const tl_scene_instance *instance, tl_vec3 v)
{
    if (tl_scale_is_one(instance->scale)) {
        return scene_direction_in(instance, v);
    }
    tl_frame frame = scene_ray_frame(instance);
    return tl_vec3d_to_float(tl_frame_rotate_back(&frame, tl_vec3d_from(v)));
}

static inline tl_vec3 scene_ray_point_in(const tl_scene_instance *instance, tl_vec3 p)
{
    if (tl_scale_is_one(instance->scale)) {
        return scene_point_in(instance, p);
    }
    tl_frame frame = scene_ray_frame(instance);
    return tl_vec3d_to_float(tl_frame_rotate_back(&frame, tl_vec3d_sub(tl_vec3d_from(p), frame.origin)));
}

static inline tl_vec3 scene_ray_normal_out(const tl_scene_instance *instance, tl_vec3 v)
{
    if (tl_scale_is_one(instance->scale)) {
        return scene_direction_out(instance, v);
    }
    tl_frame frame = scene_ray_frame(instance);
    return tl_vec3d_unit_or_zero(tl_frame_rotate(&frame, tl_vec3d_from(v)));
}

/// An instance's soup and shape at its scale.
static inline tl_scaled_soup scene_scaled_soup(const tl_scene_instance *instance)
{
    tl_scaled_soup scaled = { instance->soup, instance->scale };
    return scaled;
}

static inline const tl_convex *scene_scaled_shape(const tl_scene_instance *instance, tl_scaled_convex *room)
{
    TEST_RESULT(tl_scaled_convex_make(instance->shape, instance->scale, room, NULL), TL_OK);
    return &room->shape;
}

static inline bool scene_passes(const tl_scene_filter *filter, const tl_scene_instance *instances, uint32_t instance)
{
    return filter == NULL ||
           ((instances[instance].mask & ~filter->ignored_mask) != 0 &&
            !(instance >= filter->first_ignored && instance < filter->first_ignored + filter->ignored_count) &&
            (filter->accept == NULL || filter->accept(instance, filter->accept_user)));
}

static inline bool scene_accept_thirds(uint32_t instance, void *user)
{
    (void)user;
    return instance % 3 != 0;
}

/// A random filter, or NULL.
static inline const tl_scene_filter *scene_filter(test_random *random, uint32_t count, tl_scene_filter *filter)
{
    memset(filter, 0, sizeof *filter);
    switch (test_random_below(random, 6)) {
    case 0:
        filter->ignored_mask = ~(1 + test_random_below(random, 15));
        return filter;
    case 1:
        filter->first_ignored = test_random_below(random, count + 1);
        filter->ignored_count = 1 + filter->first_ignored % 3;
        return filter;
    case 2:
        filter->accept = scene_accept_thirds;
        return filter;
    default:
        return NULL;
    }
}

#endif
