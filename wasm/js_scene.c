// SPDX-License-Identifier: MIT
//
// Scenes. JavaScript keeps soups and hulls alive; instances, shapes and the tree over them are here.

#include "js_scene.h"
#include "js_convex.h"

#include <stdlib.h>
#include <string.h>

static tl_scene_filter scene_filter;

void TL_JS_FULL_EXPORT(js_scene_free)(tl_js_scene *self)
{
    tl_blob_free(self->scene);
    free(self->instances);
    free(self->shapes);
    free(self);
}

/// A scene of `count` instances of nothing, not baked. NULL: out of memory.
tl_js_scene *TL_JS_FULL_EXPORT(js_scene_create)(uint32_t count)
{
    tl_js_scene *self = calloc(1, sizeof *self);
    if (self == NULL) {
        return NULL;
    }
    self->count = count;
    self->instances = calloc(count > 0 ? count : 1, sizeof *self->instances);
    self->shapes = calloc(count > 0 ? count : 1, sizeof *self->shapes);
    if (self->instances == NULL || self->shapes == NULL) {
        js_scene_free(self);
        return NULL;
    }
    return self;
}

/// Makes an instance one of a soup; of the shape in the slot, where `soup` is NULL and `shaped` says so; or of nothing.
void TL_JS_FULL_EXPORT(js_scene_set)(tl_js_scene *self, uint32_t i, const tl_soup *soup, int32_t shaped)
{
    self->instances[i].soup = soup;
    self->instances[i].shape = NULL;
    if (shaped) {
        self->shapes[i] = tl_js_shape(0);
        self->instances[i].shape = &self->shapes[i];
    }
}

/// Slot: the pose.
void TL_JS_FULL_EXPORT(js_scene_place)(tl_js_scene *self, uint32_t i)
{
    self->instances[i].pose = tl_js_pose(0);
}

/// Slot: the factors.
void TL_JS_FULL_EXPORT(js_scene_scale)(tl_js_scene *self, uint32_t i)
{
    self->instances[i].scale = tl_js_vec3(0);
}

void TL_JS_FULL_EXPORT(js_scene_mask)(tl_js_scene *self, uint32_t i, uint32_t mask)
{
    self->instances[i].mask = mask;
}

/// Bakes the tree, or bakes it anew; what was there stays where that fails.
tl_result TL_JS_FULL_EXPORT(js_scene_bake)(tl_js_scene *self)
{
    tl_scene *scene;
    const tl_result result = tl_scene_bake(self->instances, self->count, tl_js_host(), &scene, &tl_js_report);
    if (result == TL_OK) {
        tl_blob_free(self->scene);
        self->scene = scene;
    }
    return result;
}

/// Slot: how many times the tree's cost has grown.
tl_result TL_JS_FULL_EXPORT(js_scene_refit)(tl_js_scene *self)
{
    float growth = 0.0f;
    const tl_result result = tl_scene_refit(self->scene, self->instances, self->count, &growth, &tl_js_report);
    tl_js_put(0, (double)growth);
    return result;
}

/// The filter for the calls that are given what this returns.
tl_scene_filter *TL_JS_FULL_EXPORT(js_set_scene_filter)(uint32_t ignored_mask, uint32_t first, uint32_t count,
                                                        const tl_ray_filter *triangles)
{
    scene_filter.ignored_mask = ignored_mask;
    scene_filter.first_ignored = first;
    scene_filter.ignored_count = count;
    scene_filter.triangles = triangles;
    return &scene_filter;
}

// ---------------------------------------------------------------------------------------------------------
// Queries.

/// Slot, where it returns 1: t, triangle, u, v, normal, material, back, instance, inside.
int32_t TL_JS_FULL_EXPORT(js_scene_cast_ray)(const tl_js_scene *self, float ox, float oy, float oz, float dx, float dy,
                                             float dz, float max_t, const tl_scene_filter *filter)
{
    const tl_ray ray = { { ox, oy, oz }, { dx, dy, dz }, max_t };
    tl_scene_hit found;
    if (!tl_scene_cast_ray(self->scene, self->instances, &ray, filter, &found)) {
        return 0;
    }
    const tl_ray_hit *h = &found.hit;
    uint32_t at = tl_js_put(tl_js_put(0, (double)h->t), h->triangle);
    at = tl_js_put_vec3(tl_js_put(tl_js_put(at, (double)h->u), (double)h->v), h->normal);
    at = tl_js_put(tl_js_put(at, h->material), h->back);
    tl_js_put(tl_js_put(at, found.instance), found.inside);
    return 1;
}

int32_t TL_JS_FULL_EXPORT(js_scene_occluded)(const tl_js_scene *self, float ox, float oy, float oz, float dx, float dy,
                                             float dz, float max_t, const tl_scene_filter *filter)
{
    const tl_ray ray = { { ox, oy, oz }, { dx, dy, dz }, max_t };
    return tl_scene_occluded(self->scene, self->instances, &ray, filter);
}

int32_t TL_JS_FULL_EXPORT(js_scene_line_of_sight)(const tl_js_scene *self, float ax, float ay, float az, float bx,
                                                  float by, float bz, const tl_scene_filter *filter)
{
    const tl_vec3 a = { ax, ay, az }, b = { bx, by, bz };
    return tl_scene_line_of_sight(self->scene, self->instances, a, b, filter);
}

/// Slot: the point and the greatest distance; then point, distance, normal, triangle, instance.
tl_result TL_JS_FULL_EXPORT(js_scene_nearest)(const tl_js_scene *self, const tl_scene_filter *filter)
{
    tl_scene_point p;
    memset(&p, 0, sizeof p);
    const tl_result result = tl_scene_nearest(self->scene, self->instances, tl_js_vec3(0), tl_js_f32(3), filter, &p);
    uint32_t at = tl_js_put(tl_js_put_vec3(0, p.point.point), (double)p.point.distance);
    at = tl_js_put_vec3(at, p.point.normal);
    tl_js_put(tl_js_put(at, p.point.triangle), p.instance);
    return result;
}

enum { POSE = TL_JS_SHAPE_NUMBERS, MOTION = POSE + 7 };

/// Slot: shape, pose, motion; then t, overlap at the start, triangle, depth, point, normal, instance.
tl_result TL_JS_FULL_EXPORT(js_scene_cast_shape)(const tl_js_scene *self, const tl_scene_filter *filter)
{
    const tl_convex shape = tl_js_shape(0);
    tl_scene_shape_hit found;
    memset(&found, 0, sizeof found);
    const tl_result result =
        tl_scene_cast_shape(self->scene, self->instances, &shape, tl_js_pose(POSE), tl_js_vec3(MOTION), filter, &found);
    const tl_shape_hit *h = &found.hit;
    uint32_t at = tl_js_put(tl_js_put(0, (double)h->t), h->initial_overlap);
    at = tl_js_put(tl_js_put(at, h->triangle), (double)h->depth);
    tl_js_put(tl_js_put_vec3(tl_js_put_vec3(at, h->point), h->normal), found.instance);
    return result;
}

/// Slot: shape, pose; then how many things it touches, and where they stand: pairs of instance and triangle.
tl_result TL_JS_FULL_EXPORT(js_scene_find_overlaps)(const tl_js_scene *self, const tl_scene_filter *filter)
{
    const tl_convex shape = tl_js_shape(0);
    const tl_scene_overlap_query query = { &shape, tl_js_pose(POSE), filter };
    uint32_t capacity = 64, count = 0;
    tl_scene_overlap *found;
    tl_result result;
    do {
        found = tl_js_buffer_room(capacity * sizeof *found);
        if (found == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_scene_find_overlaps(self->scene, self->instances, &query, found, capacity, &count);
        capacity = count;
    } while (result == TL_INCOMPLETE);
    tl_js_put_pointer(tl_js_put(0, count), found);
    return result;
}
