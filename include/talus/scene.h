// SPDX-License-Identifier: MIT
//
// A scene: many placed copies of soups and convex shapes, asked together. Doors, props, vehicles, other agents.
//
//   tl_scene_instance [count] --tl_scene_bake--> tl_scene --tl_scene_cast_ray, tl_scene_cast_shape ...--> instance,
//   triangle
//          moved          --tl_scene_refit------^
//
// The caller keeps the instances. A scene is a tree over their boxes, with their poses and masks as they were when it
// was built or refitted last; it holds no pointer, so every query takes the instances again and finds soups and shapes
// there. Answers are those of the last build or refit: who moves instances meanwhile moves nothing in the scene, and
// the soups and shapes must be there still, as they were then.
//
// What the answers promise:
//
// - They are defined by the instances alone: asking each in turn and taking the first, the nearest, the lowest gives
// the
//   same, bit for bit. The tree only leaves out instances whose boxes are proven to be out of the question.
// - A soup whose pose is the identity answers with the very bits that it has alone.
// - A soup elsewhere is asked in its own space: points are brought there in double, R^T (p - position), and each
//   coordinate is rounded to float once. With u = 2^-24 the point at t of a ray lies within u (|o| + t |d|) (and a
//   share of 2^-20 of that) of where it should, o and d the origin and direction in the instance's space: o rounds to
//   within u |o|, d to within u |d|. A pose of a shape is turned by at most 4 u besides. There the answer is exact as
//   in soup.h. All triangles of an instance see the same ray, so nothing slips through between two of them.
// - t, shares of motions and distances mean the same in every instance, because poses are rigid.
// - Shapes are asked in double where they stand (convex.h).
// - Points and normals are in the world: from an instance's space in double, rounded once.
//
// Queries take a const scene, allocate nothing, and may run on any number of threads.

#ifndef TALUS_SCENE_H
#define TALUS_SCENE_H

#include <talus/base.h>
#include <talus/convex.h>
#include <talus/soup.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The tree over placed instances: a blob, but not one for files. Free it with `tl_blob_free`.
typedef struct tl_scene tl_scene;

/// "tlsc" in memory.
#define TL_SCENE_MAGIC   0x63736c74u
#define TL_SCENE_VERSION 1u

/// Most instances of a scene.
#define TL_MAX_SCENE_INSTANCES 0x0fffffffu

#define TL_NO_INSTANCE         UINT32_MAX

/// Something placed. Nothing is copied or owned but the pose and the mask.
typedef struct tl_scene_instance {
    const tl_soup *soup;    ///< NULL: not a soup
    const tl_convex *shape; ///< NULL: not a shape. With neither nothing is here, and nothing is found
    tl_transform pose;      ///< from the instance's space to the world; the rotation is normalized before use
    uint32_t mask;          ///< kinds of the caller's; queries choose among them. 0: nothing finds it
} tl_scene_instance;

/// Builds a scene of `count` instances, of which there may be none.
///
/// The bytes depend on nothing but the instances. O(n log n), some 0.1 us an instance. On failure `*scene_out` is NULL.
/// `host` and `report_out` may be NULL; tasks are not used. Errors, with the instance in `report_out`:
/// TL_ERR_NOT_FINITE (a pose, or a shape without a finite box), TL_ERR_DEGENERATE (a rotation of zero), TL_ERR_RANGE (a
/// position, or a box in the instance's space, beyond TL_MAX_COORDINATE), TL_ERR_ARGUMENT (both a soup and a shape; a
/// radius that is negative or NaN; a box inside out), TL_ERR_LIMIT (more than TL_MAX_SCENE_INSTANCES), TL_ERR_MEMORY.
TL_API tl_result tl_scene_bake(const tl_scene_instance *instances, uint32_t count, const tl_host *host,
                               tl_scene **scene_out, tl_report *report_out);

/// Takes the instances as they are now: other poses, masks, soups, shapes, or none. In place, O(n), no memory; an
/// instance that did not move costs next to nothing.
///
/// Every query then answers as if the scene had been built anew. The tree stays as it was, however far instances moved:
/// `growth_out` (may be NULL) is the tree's cost (tl_scene_stats) to what it was when it was built; at 1.5 or so a
/// build pays. No query may run meanwhile: refit a second scene while the first is asked. Errors as of tl_scene_bake,
/// and TL_ERR_ARGUMENT for another number of instances; the scene is then unchanged.
TL_API tl_result tl_scene_refit(tl_scene *scene, const tl_scene_instance *instances, uint32_t count, float *growth_out,
                                tl_report *report_out);

/// The box of all instances; empty when there are none. It is wider than they are by a few roundings of their
/// coordinates.
TL_API tl_aabb tl_scene_bounds(const tl_scene *scene);

/// What a scene holds.
typedef struct tl_scene_stats {
    uint64_t size; ///< bytes
    uint32_t instance_count;
    uint32_t node_count;
    uint32_t depth; ///< nodes on the longest way from the root to an instance
    double cost;    ///< nodes that a random ray through the scene's box visits, on average: >= 1
} tl_scene_stats;

TL_API tl_scene_stats tl_scene_get_stats(const tl_scene *scene);

/// Whether an instance counts. Must answer the same for the same instance during one query.
typedef bool tl_instance_filter_fn(uint32_t instance, void *user);

/// What a query passes by. A NULL filter passes by nothing.
typedef struct tl_scene_filter {
    uint32_t mask;                 ///< instances whose mask shares a bit with it count
    uint32_t without;              ///< this instance does not: the one that asks; TL_NO_INSTANCE
    tl_instance_filter_fn *accept; ///< asked last; NULL: all count
    void *accept_user;
    const tl_ray_filter *triangles; ///< what is passed by in soups; shapes do not look at it. NULL: nothing
} tl_scene_filter;

/// Every bit of the mask, TL_NO_INSTANCE and NULLs: what a NULL filter is.
TL_API tl_scene_filter tl_default_scene_filter(void);

/// Where a ray met the scene.
typedef struct tl_scene_hit {
    tl_ray_hit hit; ///< as in the soup, but the normal is in the world. Of a shape: TL_NO_TRIANGLE, u, v, material 0
    uint32_t instance;
    bool inside;             ///< the ray began inside a shape: t is 0, the normal zero
    tl_convex_status status; ///< of a shape: as in tl_convex_hit; of a soup CONVERGED
} tl_scene_hit;

/// The closest hit of a ray; of equal t the lowest instance. False and an untouched `hit_out` when there is none.
/// `filter` may be NULL.
///
/// Rays as in soup.h: a direction of zero, what is not finite, and a tmax that is negative or NaN hit nothing; neither
/// does a ray in an instance in whose space it is not finite. Shapes are solid. An origin farther than 1e15 m from
/// anything and a direction shorter than 1e-30 make it ask every instance.
TL_API bool tl_scene_cast_ray(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                              const tl_scene_filter *filter, tl_scene_hit *hit_out);

/// Whether a ray hits anything. Agrees with tl_scene_cast_ray, and is faster.
TL_API bool tl_scene_occluded(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                              const tl_scene_filter *filter);

/// Whether nothing meets the closed segment from a to b: the same as from b to a, always (but for culling). Both ends
/// are exact in each instance's space. Equal ends meet shapes only, and ends that are not finite nothing. `filter` may
/// be NULL.
TL_API bool tl_scene_line_of_sight(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 a, tl_vec3 b,
                                   const tl_scene_filter *filter);

/// What a moving shape met.
typedef struct tl_scene_shape_hit {
    tl_shape_hit hit; ///< as in the soup, but point and normals are in the world. Of a shape: TL_NO_TRIANGLE,
                      ///< face_normal is the normal
    uint32_t instance;
} tl_scene_shape_hit;

/// Moves a convex shape by `motion` without turning it, and finds what it meets first: of equal times the lowest
/// instance, of instances that it overlaps at the start the one in which it is deepest. `filter` may be NULL.
///
/// Rules of tl_soup_cast_shape. What counts as touching is measured where the shape is: where it comes no deeper into
/// an instance at the start than 2.4e-7 of the largest coordinate that it reaches in the world, it is taken as standing
/// on it, although an instance's own coordinates may be smaller. TL_NOT_FOUND: the way is free; TL_ERR_NOT_FINITE:
/// motion, pose or shape; TL_ERR_ARGUMENT: a radius is negative or NaN. `hit_out` is then untouched.
TL_API tl_result tl_scene_cast_shape(const tl_scene *scene, const tl_scene_instance *instances, const tl_convex *shape,
                                     tl_transform pose, tl_vec3 motion, const tl_scene_filter *filter,
                                     tl_scene_shape_hit *hit_out);

/// Something that a shape touches.
typedef struct tl_scene_overlap {
    uint32_t instance;
    uint32_t triangle; ///< TL_NO_TRIANGLE: the instance is a shape
} tl_scene_overlap;

/// Whether a shape, standing still, touches anything. Rules and errors as in tl_soup_overlaps. `filter` may be NULL.
TL_API tl_result tl_scene_overlaps(const tl_scene *scene, const tl_scene_instance *instances, const tl_convex *shape,
                                   tl_transform pose, const tl_scene_filter *filter, bool *overlaps_out);

/// What a shape touches, each triangle and shape once, in an order of the scene's own.
/// Writes at most `capacity` of them, and to `*count_out` how many there are: TL_INCOMPLETE when that is more.
TL_API tl_result tl_scene_find_overlaps(const tl_scene *scene, const tl_scene_instance *instances,
                                        const tl_convex *shape, tl_transform pose, const tl_scene_filter *filter,
                                        tl_scene_overlap *overlaps_out, uint32_t capacity, uint32_t *count_out);

/// A point on something.
typedef struct tl_scene_point {
    tl_soup_point point; ///< as in the soup, but point and normal are in the world. Of a shape: TL_NO_TRIANGLE; inside
                         ///< of it the distance is 0 and the normal zero
    uint32_t instance;
} tl_scene_point;

/// The nearest point that is at most `max_distance` metres away (INFINITY: anywhere); of equal distances the lowest
/// instance's. Rules and errors as in tl_soup_nearest. `filter` may be NULL.
TL_API tl_result tl_scene_nearest(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 point,
                                  float max_distance, const tl_scene_filter *filter, tl_scene_point *nearest_out);

/// Called for each instance found; false ends the search.
typedef bool tl_scene_instance_fn(uint32_t instance, void *user);

/// Calls `found` for the instances whose boxes touch `box` (closed), in an order of the scene's own, each once: where a
/// broad phase, or a question that is not here, begins. Returns false when `found` ended the search. `filter` may be
/// NULL.
TL_API bool tl_scene_instances_in_box(const tl_scene *scene, tl_aabb box, const tl_scene_filter *filter,
                                      tl_scene_instance_fn *found, void *user);

#ifdef __cplusplus
}
#endif

#endif
