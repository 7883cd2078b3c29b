// SPDX-License-Identifier: MIT
//
// Sweeping a shape through a scene: each instance that its box may meet is queried by itself.
//
// What counts as touching is a share of coordinates, since these are what was rounded; and the shape's position is
// given in the world's coordinates. A prop's own coordinates are small, and so is what its soup takes for touching: a
// character that stands on it, a kilometre from the origin, would be caught. So a start that penetrates a soup no
// deeper than the world's coordinates explain is moved out, by that depth, and the sweep begins there.
//
// A shape that slides along a convex instance is hit by it again and again, as a rounded shape's normal is known no
// better than the root of the gap. Whether it ever penetrates deeper than touching takes a second sweep: it begins
// moved out by as much as touching is, and where that is free the shape passes.

#include "base/assert.h"
#include "base/compiler.h"
#include "math/tolerance.h"
#include "scene/moved_shape.h"

#include <string.h>

// As for soups: a position and a corner round by half an ulp each, along three axes.
#define WORLD_TOUCH_SHARE (4.0 * (double)TL_FLOAT_ROUNDING)

// At a corner the shape leaves three faces; each step out of one may lead a little into another.
enum { MAX_STEPS_OUT = 4 };

typedef struct scene_sweep {
    const tl_scene_instance *instances;
    const tl_scene_record *records;
    const tl_scene_place *places;
    const tl_scene_filter *filter;
    const tl_moved_shape *shape;
    tl_vec3 motion;
    double touch; // metres
    tl_scene_shape_hit *hit;
    uint32_t instance; // TL_NO_INSTANCE: none yet
} scene_sweep;

static tl_transform move_out(tl_transform pose, tl_vec3 normal, double by)
{
    tl_vec3d at = tl_vec3d_mul_add(tl_vec3d_from(pose.position), tl_vec3d_from(normal), by);
    pose.position = tl_vec3d_to_float(at);
    return pose;
}

// What needs the room of a record is not on the stack during the sweep, which fills it.
static TL_NOINLINE tl_transform begin_at_soup(const scene_sweep *s, uint32_t instance, tl_vec3 *motion_out)
{
    tl_scene_record room;
    const tl_scene_record *record = tl_scene_rigid(&s->records[instance], &room);
    *motion_out = tl_scene_direction_to_instance(record, s->motion);
    return tl_scene_pose_to_instance(record, s->shape->pose);
}

static TL_NOINLINE void turn_to_world(const scene_sweep *s, uint32_t instance, tl_shape_hit *hit)
{
    tl_scene_record room;
    const tl_scene_record *record = tl_scene_rigid(&s->records[instance], &room);
    hit->point = tl_scene_point_to_world(record, hit->point);
    hit->normal = tl_scene_normal_to_world(record, hit->normal);
    hit->face_normal = tl_scene_normal_to_world(record, hit->face_normal);
}

static bool sweep_at_soup(const scene_sweep *s, uint32_t instance, tl_shape_hit *hit)
{
    const tl_scaled_soup soup = tl_scene_soup(&s->places[instance], s->instances[instance].soup);
    tl_vec3 motion;
    tl_transform pose = begin_at_soup(s, instance, &motion);
    double touch = s->touch;
    for (uint32_t step = 0;; step++) {
        if (tl_scaled_soup_cast_shape(&soup, s->shape->convex, pose, motion, tl_scene_triangles(s->filter), hit) !=
            TL_OK) {
            return false;
        }
        bool stands_on = hit->initial_overlap && (double)hit->depth <= touch;
        if (!stands_on || step == MAX_STEPS_OUT ||
            tl_scene_rigid_way(&s->records[instance].pose) == TL_SCENE_IDENTITY) {
            break;
        }
        touch -= (double)hit->depth;
        double rounding = 2.0 * (double)TL_FLOAT_ROUNDING * tl_vec3d_size(tl_vec3d_from(pose.position));
        pose = move_out(pose, hit->normal, (double)hit->depth + rounding);
    }
    turn_to_world(s, instance, hit);
    return true;
}

static bool sweep_at_shape(const scene_sweep *s, uint32_t instance, tl_shape_hit *hit)
{
    tl_scaled_convex room;
    const tl_convex *other = tl_scene_shape(&s->places[instance], s->instances[instance].shape, &room);
    tl_transform at = s->records[instance].pose;
    tl_convex_hit met;
    if (!tl_convex_cast(other, at, s->shape->convex, s->shape->pose, s->motion, &met)) {
        return false;
    }
    memset(hit, 0, sizeof *hit);
    hit->t = met.t;
    hit->triangle = TL_NO_TRIANGLE;
    hit->point = met.point;
    hit->normal = met.normal;
    hit->status = met.status;
    if (met.initial_overlap) {
        tl_penetration in;
        tl_convex_penetration(other, at, s->shape->convex, s->shape->pose, NULL, &in);
        hit->initial_overlap = (double)in.depth > s->touch;
        hit->depth = hit->initial_overlap ? in.depth : 0.0f;
        hit->point = in.point_a;
        hit->normal = in.normal;
        hit->status = in.status;
    }
    hit->face_normal = hit->normal;
    if (hit->initial_overlap) {
        return true;
    }
    tl_transform outside = move_out(s->shape->pose, hit->normal, s->touch);
    return tl_convex_cast(other, at, s->shape->convex, outside, s->motion, &met);
}

static bool sweep_at_instance(const scene_sweep *s, uint32_t instance, tl_shape_hit *hit)
{
    return s->instances[instance].soup != NULL
               ? sweep_at_soup(s, instance, hit)
               : s->instances[instance].shape != NULL && sweep_at_shape(s, instance, hit);
}

// Earlier wins; of overlaps the deeper one; then the lower instance.
static bool is_better_hit(const scene_sweep *s, const tl_shape_hit *hit, uint32_t instance)
{
    const tl_shape_hit *best = &s->hit->hit;
    if (s->instance == TL_NO_INSTANCE || hit->t != best->t) {
        return s->instance == TL_NO_INSTANCE || hit->t < best->t;
    }
    if (hit->initial_overlap != best->initial_overlap) {
        return hit->initial_overlap;
    }
    return hit->depth != best->depth ? hit->depth > best->depth : instance < s->instance;
}

static bool visit_by_shape(tl_scene_line *line, uint32_t instance)
{
    scene_sweep *s = line->user;
    tl_shape_hit hit;
    if (tl_scene_accepts(s->filter, instance) && sweep_at_instance(s, instance, &hit) &&
        is_better_hit(s, &hit, instance)) {
        s->hit->hit = hit;
        s->instance = instance;
        tl_scene_line_shorten(line, hit.t);
    }
    return true;
}

tl_result tl_scene_cast_shape(const tl_scene *scene, const tl_scene_instance *instances, const tl_convex *shape,
                              tl_transform pose, tl_vec3 motion, const tl_scene_filter *filter,
                              tl_scene_shape_hit *hit_out)
{
    if (hit_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(hit_out, 0, sizeof *hit_out);
    if (!tl_scene_has_instances(scene, instances) || shape == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_moved_shape moved;
    TL_TRY(tl_moved_shape_make(shape, pose, motion, &moved));
    scene_sweep s = { .instances = instances, .filter = filter, .shape = &moved, .hit = hit_out };
    s.records = tl_scene_records(scene);
    s.places = tl_scene_places(scene);
    s.motion = motion;
    s.touch = WORLD_TOUCH_SHARE * moved.reach;
    s.instance = TL_NO_INSTANCE;
    tl_scene_line line;
    tl_scene_line_make(&line, scene, tl_scene_mask(filter), moved.middle, motion, 1.0f);
    line.half = moved.half;
    line.kind = TL_SCENE_LINE_OTHER;
    line.any = false;
    line.visit = visit_by_shape;
    line.user = &s;
    tl_scene_line_walk(&line);
    if (s.instance == TL_NO_INSTANCE) {
        return TL_NOT_FOUND;
    }
    hit_out->instance = s.instance;
    return TL_OK;
}
