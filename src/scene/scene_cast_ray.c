// SPDX-License-Identifier: MIT
//
// Rays and lines of sight through a scene: each instance that the walk meets is queried in its own space
// (scene_ray.inl).

#include "base/assert.h"
#include "math/tolerance.h"
#include "scene/scene_ray.h"

#include <string.h>

// Error of a segment in an instance's space, as a share of its ends' coordinates.
#define SIGHT_ERROR (4.0 * (double)TL_FLOAT_ROUNDING)

static void begin_ray_search(tl_scene_ray_search *s, const tl_scene *scene, const tl_scene_instance *instances,
                             const tl_scene_filter *filter)
{
    s->instances = instances;
    s->records = tl_scene_records(scene);
    s->filter = filter;
    s->triangles = tl_scene_triangles(filter);
    s->instance = TL_NO_INSTANCE;
}

// Shapes are asked where they are; scaled ones in their own space, where t is the same, and a hull is a hull.
static bool cast_at_shape(const tl_convex *shape, const tl_scene_record *record, const tl_scene_line *line, float whole,
                          tl_convex_hit *found)
{
    if (!tl_scene_is_scaled(record)) {
        return tl_convex_cast_ray(shape, record->pose, line->from, line->direction, whole, found);
    }
    bool hits = tl_convex_cast_ray(shape, tl_transform_identity(), tl_scene_point_to_instance(record, line->from),
                                   tl_scene_direction_to_instance(record, line->direction), whole, found);
    found->normal = tl_scene_normal_to_world(record, found->normal);
    return hits;
}

bool tl_scene_ray_meets_shape(const tl_scene_line *line, uint32_t instance, tl_scene_hit *hit)
{
    const tl_scene_ray_search *s = line->user;
    tl_convex_hit found;
    const tl_convex *shape = s->instances[instance].shape;
    if (shape == NULL || !cast_at_shape(shape, &s->records[instance], line, s->whole, &found)) {
        return false;
    }
    if (hit != NULL) {
        memset(hit, 0, sizeof *hit);
        hit->hit.t = found.t;
        hit->hit.triangle = TL_NO_TRIANGLE;
        hit->hit.normal = found.normal;
        hit->inside = found.initial_overlap;
        hit->status = found.status;
    }
    return true;
}

// Without a branch a coordinate: 0 times what is not finite is no number.
static bool is_castable(const tl_ray *ray)
{
    tl_vec3 o = ray->origin, d = ray->direction;
    bool moves = (d.x != 0.0f) | (d.y != 0.0f) | (d.z != 0.0f);
    float zero = 0.0f * o.x + 0.0f * o.y + 0.0f * o.z + 0.0f * d.x + 0.0f * d.y + 0.0f * d.z;
    return moves & (zero == 0.0f) & (ray->tmax >= 0.0f);
}

// The best hit as it is reported.
static void report_best(const tl_scene_ray_search *s, tl_scene_hit *hit_out)
{
    if (s->hit != hit_out) {
        *hit_out = *s->hit;
    }
    hit_out->instance = s->instance;
    if (hit_out->hit.triangle != TL_NO_TRIANGLE) {
        hit_out->hit.normal = tl_scene_normal_to_world(&s->records[s->instance], hit_out->hit.normal);
    }
}

// Of the two places for hits one is the caller's: mostly the first hit is the best, and a copy would wait for what was
// just written piece by piece.
bool tl_scene_cast_ray_with(tl_scene_walk_fn *walk, const tl_scene *scene, const tl_scene_instance *instances,
                            const tl_ray *ray, const tl_scene_filter *filter, tl_scene_hit *hit_out)
{
    TL_ASSERT(tl_scene_has_instances(scene, instances) && ray != NULL);
    if (!is_castable(ray)) {
        return false;
    }
    tl_scene_ray_search s;
    begin_ray_search(&s, scene, instances, filter);
    s.whole = s.tmax = ray->tmax;
    tl_scene_hit other;
    s.hit = hit_out != NULL ? &other : NULL;
    s.candidate = hit_out;
    tl_scene_line line;
    tl_scene_line_make(&line, scene, tl_scene_mask(filter), ray->origin, ray->direction, ray->tmax);
    line.kind = TL_SCENE_LINE_RAY;
    line.user = &s;
    line.any = hit_out == NULL;
    line.walk = walk != NULL ? walk : line.walk;
    tl_scene_line_walk(&line);
    if (s.instance == TL_NO_INSTANCE) {
        return false;
    }
    if (hit_out != NULL) {
        report_best(&s, hit_out);
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
bool tl_scene_shape_hides(const tl_scene_line *line, uint32_t instance)
{
    const tl_scene_ray_search *s = line->user;
    const tl_convex *shape = s->instances[instance].shape;
    if (shape == NULL) {
        return false;
    }
    const tl_scene_record *record = &s->records[instance];
    tl_transform pose = record->pose;
    tl_vec3 from = line->from, to = s->end;
    if (tl_scene_is_scaled(record)) {
        pose = tl_transform_identity();
        from = tl_scene_point_to_instance(record, from);
        to = tl_scene_point_to_instance(record, to);
    }
    bool reversed = precedes_point(to, from);
    tl_convex segment = tl_convex_capsule(reversed ? to : from, reversed ? from : to, 0.0f);
    return tl_convex_overlap(shape, pose, &segment, tl_transform_identity(), NULL);
}

bool tl_scene_line_of_sight(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 a, tl_vec3 b,
                            const tl_scene_filter *filter)
{
    TL_ASSERT(tl_scene_has_instances(scene, instances));
    if (!tl_is_finite(a) || !tl_is_finite(b)) {
        return true;
    }
    tl_scene_ray_search s;
    begin_ray_search(&s, scene, instances, filter);
    s.end = b;
    tl_scene_line line;
    tl_scene_line_make(&line, scene, tl_scene_mask(filter), a, tl_sub(b, a), 1.0f);
    // Both ends move by roundings of their own, and the difference rounds.
    double wide = SIGHT_ERROR * (tl_vec3d_size(tl_vec3d_from(a)) + tl_vec3d_size(tl_vec3d_from(b)));
    line.half.x = line.half.y = line.half.z = (float)(wide * (1.0 + TL_FLOAT_OUTWARD));
    line.kind = TL_SCENE_LINE_SIGHT;
    line.user = &s;
    line.any = true;
    tl_scene_line_walk(&line);
    return s.instance == TL_NO_INSTANCE;
}
