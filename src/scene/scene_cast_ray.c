// SPDX-License-Identifier: MIT
//
// Rays and lines of sight through a scene: each instance that the walk meets is queried in its own space.
//
// A soup gets the best t so far as the ray's end, which cuts its own walk short and changes no answer: a hit's t does
// not depend on where the ray ends, and ends count. A shape's t does, by a rounding, so shapes get the whole ray.

#include "base/assert.h"
#include "math/tolerance.h"
#include "scene/scene_walk.h"

#include <string.h>

// Error of a segment in an instance's space, as a share of its ends' coordinates.
#define SIGHT_ERROR (4.0 * (double)TL_FLOAT_ROUNDING)

typedef struct scene_ray_search {
    const tl_scene_instance *instances;
    const tl_scene_record *records;
    const tl_scene_filter *filter;
    const tl_ray_filter *triangles;
    tl_ray ray;
    tl_vec3 to;        // of a line of sight: from ray.origin to it
    float tmax;        // of the best
    tl_scene_hit *hit; // NULL: any will do
    uint32_t instance; // TL_NO_INSTANCE: none yet
} scene_ray_search;

static scene_ray_search begin_ray_search(const tl_scene *scene, const tl_scene_instance *instances,
                                         const tl_scene_filter *filter)
{
    scene_ray_search s = {
        .instances = instances, .records = tl_scene_records(scene), .filter = filter, .instance = TL_NO_INSTANCE
    };
    s.triangles = tl_scene_triangles(filter);
    return s;
}

static bool cast_ray_at_soup(const scene_ray_search *s, uint32_t instance, tl_scene_hit *hit)
{
    const tl_scene_record *record = &s->records[instance];
    tl_ray ray = { tl_scene_point_to_instance(record, s->ray.origin),
                   tl_scene_direction_to_instance(record, s->ray.direction), s->tmax };
    if (s->hit == NULL) {
        return tl_soup_occluded(s->instances[instance].soup, &ray, s->triangles);
    }
    if (!tl_soup_cast_ray(s->instances[instance].soup, &ray, s->triangles, &hit->hit)) {
        return false;
    }
    hit->inside = false;
    hit->status = TL_CONVEX_CONVERGED;
    return true;
}

static bool cast_ray_at_shape(const scene_ray_search *s, uint32_t instance, tl_scene_hit *hit)
{
    tl_convex_hit found;
    if (!tl_convex_cast_ray(s->instances[instance].shape, s->records[instance].pose, s->ray.origin, s->ray.direction,
                            s->ray.tmax, &found)) {
        return false;
    }
    memset(hit, 0, sizeof *hit);
    hit->hit.t = found.t;
    hit->hit.triangle = TL_NO_TRIANGLE;
    hit->hit.normal = found.normal;
    hit->inside = found.initial_overlap;
    hit->status = found.status;
    return true;
}

static bool visit_by_ray(tl_scene_line *line, uint32_t instance)
{
    scene_ray_search *s = line->user;
    if (!tl_scene_accepts(s->filter, instance)) {
        return true;
    }
    tl_scene_hit hit;
    bool is_soup = s->instances[instance].soup != NULL;
    bool met = is_soup ? cast_ray_at_soup(s, instance, &hit)
                       : s->instances[instance].shape != NULL && cast_ray_at_shape(s, instance, &hit);
    if (!met) {
        return true;
    }
    if (s->hit == NULL) {
        s->instance = instance;
        return false;
    }
    if (hit.hit.t < s->tmax || (hit.hit.t == s->tmax && instance < s->instance)) {
        hit.instance = instance;
        *s->hit = hit;
        s->tmax = hit.hit.t;
        s->instance = instance;
        tl_scene_line_shorten(line, (double)hit.hit.t);
    }
    return true;
}

// Sums in double are finite when their terms are.
static bool is_castable(const tl_ray *ray)
{
    double from = tl_vec3d_size(tl_vec3d_from(ray->origin)), along = tl_vec3d_size(tl_vec3d_from(ray->direction));
    return (from < (double)INFINITY) & (along > 0.0) & (along < (double)INFINITY) & (ray->tmax >= 0.0f);
}

bool tl_scene_cast_ray_with(tl_scene_walk_fn *walk, const tl_scene *scene, const tl_scene_instance *instances,
                            const tl_ray *ray, const tl_scene_filter *filter, tl_scene_hit *hit_out)
{
    TL_ASSERT(tl_scene_has_instances(scene, instances) && ray != NULL);
    if (!is_castable(ray)) {
        return false;
    }
    scene_ray_search s = begin_ray_search(scene, instances, filter);
    s.ray = *ray;
    s.tmax = ray->tmax;
    tl_scene_hit hit;
    s.hit = hit_out != NULL ? &hit : NULL;
    tl_scene_line line = { .instances = instances, .visit = visit_by_ray, .user = &s, .any = hit_out == NULL };
    tl_scene_line_make(&line, scene, tl_scene_mask(filter), ray->origin, ray->direction, tl_vec3d_make(0.0, 0.0, 0.0),
                       (double)ray->tmax);
    line.walk = walk != NULL ? walk : line.walk;
    tl_scene_line_walk(&line);
    if (s.instance == TL_NO_INSTANCE) {
        return false;
    }
    if (hit_out != NULL) {
        hit.hit.normal = hit.hit.triangle != TL_NO_TRIANGLE
                             ? tl_scene_direction_to_world(&s.records[s.instance], hit.hit.normal)
                             : hit.hit.normal;
        *hit_out = hit;
    }
    return true;
}

bool tl_scene_cast_ray(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                       const tl_scene_filter *filter, tl_scene_hit *hit_out)
{
    TL_ASSERT(hit_out != NULL);
    return tl_scene_cast_ray_with(NULL, scene, instances, ray, filter, hit_out);
}

bool tl_scene_occluded(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                       const tl_scene_filter *filter)
{
    return tl_scene_cast_ray_with(NULL, scene, instances, ray, filter, NULL);
}

// An order of two points, whichever of them is given first.
static bool precedes_point(tl_vec3 a, tl_vec3 b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// A shape blocks the view where the segment touches it.
static bool hides(const scene_ray_search *s, uint32_t instance)
{
    const tl_scene_record *record = &s->records[instance];
    const tl_scene_instance *it = &s->instances[instance];
    if (it->soup != NULL) {
        return !tl_soup_line_of_sight(it->soup, tl_scene_point_to_instance(record, s->ray.origin),
                                      tl_scene_point_to_instance(record, s->to), s->triangles);
    }
    if (it->shape == NULL) {
        return false;
    }
    bool reversed = precedes_point(s->to, s->ray.origin);
    tl_convex segment = tl_convex_capsule(reversed ? s->to : s->ray.origin, reversed ? s->ray.origin : s->to, 0.0f);
    return tl_convex_overlap(it->shape, record->pose, &segment, tl_transform_identity(), NULL);
}

static bool visit_by_sight(tl_scene_line *line, uint32_t instance)
{
    scene_ray_search *s = line->user;
    if (tl_scene_accepts(s->filter, instance) && hides(s, instance)) {
        s->instance = instance;
        return false;
    }
    return true;
}

bool tl_scene_line_of_sight(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 a, tl_vec3 b,
                            const tl_scene_filter *filter)
{
    TL_ASSERT(tl_scene_has_instances(scene, instances));
    if (!tl_is_finite(a) || !tl_is_finite(b)) {
        return true;
    }
    scene_ray_search s = begin_ray_search(scene, instances, filter);
    s.ray.origin = a;
    s.to = b;
    tl_scene_line line = { .instances = instances, .visit = visit_by_sight, .user = &s, .any = true };
    // Both ends move by roundings of their own, and the difference rounds.
    double wide = SIGHT_ERROR * (tl_vec3d_size(tl_vec3d_from(a)) + tl_vec3d_size(tl_vec3d_from(b)));
    tl_scene_line_make(&line, scene, tl_scene_mask(filter), a, tl_sub(b, a), tl_vec3d_make(wide, wide, wide), 1.0);
    tl_scene_line_walk(&line);
    return s.instance == TL_NO_INSTANCE;
}
