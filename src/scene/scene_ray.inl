// SPDX-License-Identifier: MIT
//
// What a ray or a line of sight does at an instance: a part of the walk, compiled once for each instruction set.
//
// Of the instances whose boxes in the world a ray enters it meets a third in their own boxes, so these are tested
// before anything else is read: one cache line and fifty instructions decide, in float. The exact way into the
// instance's space, in double, is left to those that pass. With S the sizes of all that rounds on the way, the line of
// the test is off by 11 u S, the query's by 3 u S, and the slabs by 6 u S; the boxes in the world are widened by 44 u S
// (instance_box.c, scene_walk.h), which is right for what shapes answer too; the pad is 128 u S. A component of the
// direction below 2^-30 of the largest is taken as that: over the length of S it moves the ray by 2^-29 S. A scaled
// instance's box is scaled, and lengths are the world's: a factor changes no rounding's share of a coordinate.
//
// A soup gets the best t so far as the ray's end, which cuts its own walk short and changes no answer: a hit's t does
// not depend on where the ray ends, and ends count. A shape's t does, by a rounding, so shapes get the whole ray.

#include "base/compiler.h"
#include "math/simd4d.h"
#include "scene/scene_ray.h"

#define OWN_BOX_PAD    0x1p-17f
#define OWN_BOX_LENGTH (1.0f + OWN_BOX_PAD)
#define OWN_BOX_SLOPE  0x1p-30f

// By the operations of tl_scene_rotate_back; the fourth lane means nothing.
static TL_ALWAYS_INLINE tl_f32x4 rotate_lanes_back(const tl_scene_record *record, tl_f64x4 v)
{
    tl_f64x4 x = tl_f64x4_mul(tl_f64x4_load(&record->rows[0].x), tl_f64x4_all(tl_f64x4_get_x(v)));
    tl_f64x4 y = tl_f64x4_mul(tl_f64x4_load(&record->rows[1].x), tl_f64x4_all(tl_f64x4_get_y(v)));
    tl_f64x4 z = tl_f64x4_mul(tl_f64x4_load(&record->rows[2].x), tl_f64x4_all(tl_f64x4_get_z(v)));
    return tl_f64x4_to_floats(tl_f64x4_add(tl_f64x4_add(x, y), z));
}

static inline tl_f64x4 lanes_of_point(const tl_vec3 *p)
{
    return tl_f64x4_gather_three(&p->x, 1);
}

// tl_scene_point_to_instance and tl_scene_direction_to_instance.
static TL_ALWAYS_INLINE tl_f32x4 point_to_local(const tl_scene_record *record, const tl_vec3 *p)
{
    if (!tl_scene_has_matrix(record)) {
        tl_vec3 moved = tl_scene_point_to_instance(record, *p);
        return tl_f32x4_make(moved.x, moved.y, moved.z, 0.0f);
    }
    return rotate_lanes_back(record, tl_f64x4_sub(lanes_of_point(p), lanes_of_point(&record->pose.position)));
}

static TL_ALWAYS_INLINE tl_f32x4 direction_to_local(const tl_scene_record *record, const tl_vec3 *d)
{
    return tl_scene_has_matrix(record) ? rotate_lanes_back(record, lanes_of_point(d)) : tl_f32x4_load_three(&d->x);
}

// False: the line surely does not meet the instance's box in its own space before tmax.
static TL_ALWAYS_INLINE bool may_meet_own_box(const tl_scene_line *line, const tl_scene_own_box *own, float tmax)
{
    const tl_vec3 *from = &line->from, *along = &line->direction;
    tl_f32x4 x = tl_f32x4_load(&own->axes[0].x), y = tl_f32x4_load(&own->axes[1].x);
    tl_f32x4 z = tl_f32x4_load(&own->axes[2].x), offset = tl_f32x4_load(&own->offset.x);
    tl_f32x4 direction = tl_f32x4_mul_add(y, tl_f32x4_all(along->y), tl_f32x4_mul(x, tl_f32x4_all(along->x)));
    direction = tl_f32x4_mul_add(z, tl_f32x4_all(along->z), direction);
    tl_f32x4 steep = tl_f32x4_abs(direction);
    tl_f32x4 least = tl_f32x4_mul(tl_f32x4_max_of_three(steep), tl_f32x4_all(OWN_BOX_SLOPE));
    tl_f32x4 inverse = tl_f32x4_div(tl_f32x4_all(1.0f), tl_f32x4_if_less(steep, least, least, direction));
    tl_f32x4 origin = tl_f32x4_mul_add(y, tl_f32x4_all(from->y), tl_f32x4_mul_add(x, tl_f32x4_all(from->x), offset));
    origin = tl_f32x4_mul_add(z, tl_f32x4_all(from->z), origin);
    float pad = (line->size + own->size) * OWN_BOX_PAD + FLT_MIN;
    tl_f32x4 reach = tl_f32x4_mul(tl_f32x4_add(tl_f32x4_load(&own->half.x), tl_f32x4_all(pad)), tl_f32x4_abs(inverse));
    tl_f32x4 middle = tl_f32x4_mul(origin, inverse); // the box's middle is passed at -middle
    float first = -tl_f32x4_least_of_three(tl_f32x4_add(middle, reach));
    float last = tl_f32x4_least_of_three(tl_f32x4_sub(reach, middle));
    return (first <= last) & (last >= 0.0f) & (first <= tmax * OWN_BOX_LENGTH);
}

// A ray as its lanes are stored: those behind each point are overwritten by what follows.
typedef union local_ray {
    tl_ray ray;
    float lane[8];
} local_ray;

// The candidate is a hit: keeps it if it is better than the best.
static TL_ALWAYS_INLINE void keep_candidate(tl_scene_line *line, tl_scene_ray_search *s, uint32_t instance)
{
    tl_scene_hit *found = s->candidate;
    if (found->hit.t < s->tmax || (found->hit.t == s->tmax && instance < s->instance)) {
        s->candidate = s->hit;
        s->hit = found;
        s->tmax = found->hit.t;
        s->instance = instance;
        tl_scene_line_shorten(line, found->hit.t);
    }
}

static TL_ALWAYS_INLINE bool visit_by_ray(tl_scene_line *line, uint32_t instance)
{
    tl_scene_ray_search *s = line->user;
    const tl_scene_record *record = &s->records[instance];
    if ((line->is_usual && !may_meet_own_box(line, &record->own, s->tmax)) || !tl_scene_accepts(s->filter, instance)) {
        return true;
    }
    const tl_soup *soup = s->instances[instance].soup;
    local_ray local;
    tl_f32x4_store(&local.lane[0], point_to_local(record, &line->from));
    tl_f32x4_store(&local.lane[3], direction_to_local(record, &line->direction));
    local.ray.tmax = s->tmax;
    if (s->hit == NULL) {
        bool met = soup != NULL ? tl_soup_occluded(soup, &local.ray, s->triangles)
                                : tl_scene_ray_meets_shape(line, instance, NULL);
        s->instance = met ? instance : s->instance;
        return !met;
    }
    if (soup == NULL) {
        if (tl_scene_ray_meets_shape(line, instance, s->candidate)) {
            keep_candidate(line, s, instance);
        }
    } else if (tl_soup_cast_ray(soup, &local.ray, s->triangles, &s->candidate->hit)) {
        s->candidate->inside = false;
        s->candidate->status = TL_CONVEX_CONVERGED;
        keep_candidate(line, s, instance);
    }
    return true;
}

static TL_ALWAYS_INLINE bool visit_by_sight(tl_scene_line *line, uint32_t instance)
{
    tl_scene_ray_search *s = line->user;
    const tl_scene_record *record = &s->records[instance];
    if ((line->is_usual && !may_meet_own_box(line, &record->own, 1.0f)) || !tl_scene_accepts(s->filter, instance)) {
        return true;
    }
    const tl_soup *soup = s->instances[instance].soup;
    local_ray local;
    tl_f32x4_store(&local.lane[0], point_to_local(record, &line->from));
    tl_f32x4_store(&local.lane[3], point_to_local(record, &s->end));
    bool hidden = soup != NULL ? !tl_soup_line_of_sight(soup, local.ray.origin, local.ray.direction, s->triangles)
                               : tl_scene_shape_hides(line, instance);
    s->instance = hidden ? instance : s->instance;
    return !hidden;
}
