// SPDX-License-Identifier: MIT
//
// Traversal of the top-level BVH by anything that moves along a line: a ray, a shape that moves, or one that does not.
//
// A moving shape's box meets a box where its middle meets that box grown by its half extents (their Minkowski sum); so
// all of these are rays with wider slabs. Boxes are skipped in float, only when they are proven to be out of the
// question, so instruction sets may round differently and answers do not.
//
// Times are those of the unit line: t times the direction's largest component. With O the middle, M the largest
// distance along an axis from it to a corner of the scene's box, and u = 2^-24: plane p is met at p inv - O inv. inv,
// both products and the difference round once: at most u |inv| (3 |p| + 2 |O|) <= u |inv| (5 |O| + 3 M), where the
// machine does not fuse. A query in an instance's space moves the line by 2 u |O| more (instance_box.c), and a reported
// t is off by u t, which is u |inv| M along the largest axis. The pad is 12 u (|O| + M) |inv|, with |O| a sum over
// axes.
//
// A component below 2^-70 of the largest is taken as 2^-70: over the length of the scene that is nothing beside M u.

#ifndef TALUS_SRC_SCENE_SCENE_WALK_H
#define TALUS_SRC_SCENE_SCENE_WALK_H

#include "base/cpu.h"
#include "math/tolerance.h"
#include "scene/scene_layout.h"

#include <float.h>

typedef struct tl_scene_line tl_scene_line;

/// Called for each instance whose box the line meets, nearest boxes first; it may shorten the line. False ends the
/// walk.
typedef bool tl_scene_visit_fn(tl_scene_line *line, uint32_t instance);

/// Walks the BVH, compiled once per instruction set. False when a visit ended it.
typedef bool tl_scene_walk_fn(tl_scene_line *line);

/// What the line belongs to: visits of rays and sight are compiled into the walk, others are called.
typedef enum tl_scene_line_kind { TL_SCENE_LINE_OTHER, TL_SCENE_LINE_RAY, TL_SCENE_LINE_SIGHT } tl_scene_line_kind;

struct tl_scene_line {
    const tl_scene *scene;
    tl_scene_walk_fn *walk;
    tl_scene_line_kind kind;
    tl_scene_visit_fn *visit; ///< of TL_SCENE_LINE_OTHER
    void *user;               ///< of rays and sight: tl_scene_ray_search
    uint32_t mask;            ///< mask bits of instances that count
    bool any;                 ///< nearest first does not matter
    tl_vec3 from, direction;  ///< the middle and its motion: for t from 0 to `limit`
    tl_vec3 half;             ///< extents around the middle
    float limit;              ///< boxes entered later are skipped: t, and in a walk a time of the unit line

    // Filled by the walk. Plane p of axis i is met at p * scale[i] + near_base[i] at the earliest, and with far_base at
    // the latest.
    _Alignas(16) float scale[4];
    float near_base[4];
    float far_base[4];
    uint32_t backward; ///< bit i: it runs down along axis i, so it enters a box by its max plane
    float size;        ///< of the coordinates where it begins, and where a line of sight ends, summed over all axes
    float per_t;       ///< times of the unit line per t
    float longest;     ///< no part of the line within the scene's box is longer
    bool is_usual;     ///< neither tiny nor huge: instances' own boxes may be tested
};

/// Sets the line of `from + t * direction`, all finite, for t up to `limit`. A zero direction does not move. The caller
/// sets `kind`, `any` and `user`, and where they are needed `half`, which is zero, and `visit`.
void tl_scene_line_make(tl_scene_line *line, const tl_scene *scene, uint32_t mask, tl_vec3 from, tl_vec3 direction,
                        float limit);

/// The time of the unit line beyond which there is no t or less, both rounded.
static inline float tl_scene_line_time(const tl_scene_line *line, float t)
{
    return t * line->per_t * (1.0f + 8.0f * TL_FLOAT_ROUNDING) + FLT_MIN;
}

/// Shortens the line to end at t, during a walk.
static inline void tl_scene_line_shorten(tl_scene_line *line, float t)
{
    line->limit = tl_scene_line_time(line, t);
}

/// Visits the instances whose boxes the line meets. False when a visit ended it.
bool tl_scene_line_walk(tl_scene_line *line);

tl_scene_walk_fn tl_scene_walk_scalar;
#if TL_CPU_LEVELS >= 1
tl_scene_walk_fn tl_scene_walk_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_scene_walk_fn tl_scene_walk_avx2;
#endif

/// The walk of a level (base/cpu.h), up to 2. NULL where this machine or build lacks it.
tl_scene_walk_fn *tl_scene_walk_for(int level);

/// tl_scene_cast_ray and tl_scene_occluded (without `hit_out`) with a walk of the caller's choice.
bool tl_scene_cast_ray_with(tl_scene_walk_fn *walk, const tl_scene *scene, const tl_scene_instance *instances,
                            const tl_ray *ray, const tl_scene_filter *filter, tl_scene_hit *hit_out);

#endif
