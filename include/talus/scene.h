// SPDX-License-Identifier: MIT
//
// A scene: instances of soups and convex shapes (doors, props, vehicles, other agents), each at a pose and a scale, in
// a two-level BVH: a top-level tree (TLAS) over the boxes of the instances, and the BVH of each instance's soup below
// it.
//
//   tl_scene_instance [count] --tl_scene_bake--> tl_scene --tl_scene_cast_ray, tl_scene_cast_shape ...--> instance,
//          moved              --tl_scene_refit------^                                                     triangle
//
// The caller keeps the instances. A scene holds the tree over their boxes, with their poses, scales and masks as they
// were when it was last baked or refitted. It holds no pointer: every query takes the instances again and finds soups
// and shapes there. Queries answer for the last bake or refit: moving an instance has no effect before the next refit,
// and soups and shapes must stay as they were.
//
// What the answers promise:
//
// - The instances alone define them: querying each in turn and taking the first, the nearest or the lowest gives the
//   same, bit for bit. The tree only skips instances whose boxes are proven to be out of the question.
// - A soup whose pose is the identity answers with the bits that it has alone.
// - A soup elsewhere is queried in its own space: points are brought there in double, R^T (p - position), and each
//   coordinate is rounded to float once. With u = 2^-24 the point at t of a ray lies within u (|o| + t |d|) (and a
//   share of 2^-20 of that) of where it should, o and d the origin and direction in the instance's space: o rounds to
//   within u |o|, d to within u |d|. The rotation of a shape is off by 4 u besides. There the answer is exact as in
//   soup.h. All triangles of an instance see the same ray, so nothing slips through between two of them.
// - Shapes are queried in double where they are (convex.h); rays and lines of sight query a scaled one in its own
// space.
// - t, shares of motions and distances mean the same in every instance: t and shares are those of the world's ray and
//   motion, and distances and depths are the world's metres.
// - Points and normals are in the world: computed from the instance's space in double, rounded once.
//
// Scales: p becomes R (s p) + position, with a factor s along each of the instance's own axes.
//
// - A ray is divided by the factors on its way into the instance's space, and rounded there. A factor changes no
//   coordinate's relative error; so, o and d taken before the division, the bound above holds in the world.
// - Shapes against soups, and the nearest point, answer as for a soup whose corners were multiplied by the factors,
//   each coordinate rounded once (soup_scaled.h): bit for bit. Shapes against shapes as convex_scaled.h says.
// - Fronts of triangles stay fronts, also where an odd number of factors is negative; a ray's `normal` is the inverse
//   transpose's, off by 3 u times the ratio of the largest factor to the smallest.
//
// Queries take a const scene, allocate nothing, and may run on any number of threads at once.
//
// Functions that return a tl_result refuse NULL pointers (TL_ERR_ARGUMENT) and zero their outputs when they fail or
// find nothing. Other functions take no NULL but where it is allowed. `instances` may be NULL for a scene of none.
// A pose with a zero quaternion is not rotated.

#ifndef TALUS_SCENE_H
#define TALUS_SCENE_H

#include <talus/base.h>
#include <talus/convex.h>
#include <talus/convex_scaled.h>
#include <talus/soup.h>
#include <talus/soup_scaled.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The tree over the instances: a blob, but not one to store in files. Free it with `tl_blob_free`.
typedef struct tl_scene tl_scene;

/// "tlsc" in memory.
#define TL_SCENE_MAGIC   0x63736c74u
#define TL_SCENE_VERSION 3u

/// The largest number of instances of a scene.
#define TL_MAX_SCENE_INSTANCES 0x0fffffffu

#define TL_NO_INSTANCE         UINT32_MAX

/// A soup or a convex shape at a pose and a scale. The scene copies these and the mask, and owns nothing.
typedef struct tl_scene_instance {
    const tl_soup *soup;    ///< NULL: not a soup
    const tl_convex *shape; ///< NULL: not a shape. With neither, nothing is here, and nothing is found
    tl_transform pose;      ///< from the instance's space to the world; the rotation is normalized before use
    uint32_t mask;          ///< the caller's own bits, by which queries ignore instances. 0: every query ignores it
    /// Factors along the instance's own axes, before the pose; mirrored where negative. All zero: 1. Sizes are within
    /// TL_MAX_SCALE and its inverse. A rounded shape takes one size for all axes: see tl_scaled_convex_make.
    tl_vec3 scale;
} tl_scene_instance;

/// Bakes a scene of `count` instances, of which there may be none.
///
/// The bytes depend only on the instances. O(n log n), about 0.1 us an instance. `host` and `report_out` may be NULL;
/// of the host only the allocator is used.
/// Errors, with the instance in `report_out`: TL_ERR_NOT_FINITE (a pose, a scale, or a shape without a finite box),
/// TL_ERR_RANGE (a position, or a box in the instance's space or scaled, beyond TL_MAX_COORDINATE; a factor of the
/// scale that is 0, unless all are, or beyond TL_MAX_SCALE), TL_ERR_ARGUMENT (both a soup and a shape; a radius that is
/// negative or NaN; an inverted box; a scale that a rounded shape does not take), TL_ERR_LIMIT (more than
/// TL_MAX_SCENE_INSTANCES), TL_ERR_MEMORY.
TL_API tl_result tl_scene_bake(const tl_scene_instance *instances, uint32_t count, const tl_host *host,
                               tl_scene **scene_out, tl_report *report_out);

/// Takes the instances as they are now: other poses, scales, masks, soups, shapes, or none. In place, O(n), no memory;
/// an instance that did not move costs next to nothing.
///
/// Every query then answers as if the scene had been baked anew. The tree keeps its form, however far instances moved:
/// `growth_out` (may be NULL) is the ratio of its cost (tl_scene_stats) to the cost when it was baked; from 1.5 or so
/// it pays to bake anew. No query may run meanwhile: refit a second scene while the first one is queried. Errors as of
/// tl_scene_bake, and TL_ERR_ARGUMENT for another number of instances; the scene is then unchanged.
TL_API tl_result tl_scene_refit(tl_scene *scene, const tl_scene_instance *instances, uint32_t count, float *growth_out,
                                tl_report *report_out);

/// The box of all instances, wider than they are by a few roundings of their coordinates; empty when there are none.
TL_API tl_aabb tl_scene_bounds(const tl_scene *scene);

/// What a scene holds.
typedef struct tl_scene_stats {
    uint64_t size; ///< bytes
    uint32_t instance_count;
    uint32_t node_count;
    uint32_t depth; ///< nodes on the longest path from the root to an instance
    double cost;    ///< nodes that a random ray through the scene's box visits, on average: >= 1
} tl_scene_stats;

TL_API tl_scene_stats tl_scene_get_stats(const tl_scene *scene);

/// Whether an instance counts: false ignores it. Must answer the same for the same instance during one query.
typedef bool tl_instance_filter_fn(uint32_t instance, void *user);

/// What a query ignores. A zeroed filter, or NULL, ignores nothing.
typedef struct tl_scene_filter {
    uint32_t ignored_mask; ///< an instance counts when its mask has a bit that is not set here
    /// Instances [first_ignored, first_ignored + ignored_count) are ignored: say, those of the agent that queries.
    uint32_t first_ignored;
    uint32_t ignored_count;
    tl_instance_filter_fn *accept; ///< called last; NULL: all count
    void *accept_user;
    const tl_ray_filter *triangles; ///< what is ignored in soups; shapes have no triangles. NULL: nothing
} tl_scene_filter;

/// Where a ray hit something.
typedef struct tl_scene_hit {
    tl_ray_hit hit; ///< as in the soup, but the normal is in the world. Of a shape: t and normal; TL_NO_TRIANGLE
    uint32_t instance;
    bool inside;             ///< the ray began inside a shape: t is 0, the normal zero
    tl_convex_status status; ///< of a shape: as in tl_convex_hit; of a soup CONVERGED
} tl_scene_hit;

/// The closest hit of a ray, of equal t the lowest instance's; false, with `hit_out` untouched, when there is none.
/// `filter` may be NULL.
///
/// Rays as in soup.h: a zero direction, a coordinate that is not finite, and a tmax that is negative or NaN hit
/// nothing; nor does a ray in an instance in whose space it is not finite, or its direction underflows. Shapes are
/// solid. An origin farther than 1e15 m from anything, or a direction shorter than 1e-30, makes it query every
/// instance.
TL_API bool tl_scene_cast_ray(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                              const tl_scene_filter *filter, tl_scene_hit *hit_out);

/// Whether a ray hits anything. Agrees with tl_scene_cast_ray, and is faster. `filter` may be NULL.
TL_API bool tl_scene_occluded(const tl_scene *scene, const tl_scene_instance *instances, const tl_ray *ray,
                              const tl_scene_filter *filter);

/// Whether nothing meets the closed segment from a to b. From b to a the answer is the same (but for culling). Both
/// ends are exact in each instance's space. Equal ends meet shapes only, and ends that are not finite meet nothing.
/// `filter` may be NULL.
TL_API bool tl_scene_line_of_sight(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 a, tl_vec3 b,
                                   const tl_scene_filter *filter);

/// What a moving shape hit.
typedef struct tl_scene_shape_hit {
    tl_shape_hit hit; ///< as in the soup, but point and normals are in the world. Of a shape: TL_NO_TRIANGLE,
                      ///< face_normal is the normal
    uint32_t instance;
} tl_scene_shape_hit;

/// Sweeps a convex shape by `motion`, without rotation, and finds what it hits first: of equal times the lowest
/// instance, of instances that it overlaps at the start the one that it penetrates deepest. `filter` may be NULL.
///
/// Rules of tl_soup_cast_shape. What counts as touching is measured in the world: a shape that penetrates an instance
/// at the start by no more than 2.4e-7 of the largest coordinate that it reaches in the world stands on it, although
/// the instance's own coordinates may be smaller.
/// TL_NOT_FOUND: the way is free; TL_ERR_NOT_FINITE: motion, pose or shape; TL_ERR_ARGUMENT: a radius is negative or
/// NaN.
TL_API tl_result tl_scene_cast_shape(const tl_scene *scene, const tl_scene_instance *instances, const tl_convex *shape,
                                     tl_transform pose, tl_vec3 motion, const tl_scene_filter *filter,
                                     tl_scene_shape_hit *hit_out);

/// What tl_scene_overlaps and tl_scene_find_overlaps look for.
typedef struct tl_scene_overlap_query {
    const tl_convex *shape;        ///< needed
    tl_transform pose;             ///< of the shape, in the world
    const tl_scene_filter *filter; ///< may be NULL
} tl_scene_overlap_query;

/// Something that a shape touches.
typedef struct tl_scene_overlap {
    uint32_t instance;
    uint32_t triangle; ///< TL_NO_TRIANGLE: the instance is a shape
} tl_scene_overlap;

/// Whether a shape touches anything. Rules and errors as in tl_soup_overlaps.
TL_API tl_result tl_scene_overlaps(const tl_scene *scene, const tl_scene_instance *instances,
                                   const tl_scene_overlap_query *query, bool *overlaps_out);

/// What a shape touches, each triangle and each shape once, in an order of the scene's own. Rules and errors as in
/// tl_soup_overlaps.
/// Writes at most `capacity` of them, and to `*count_out` how many there are: TL_INCOMPLETE when that is more.
/// `overlaps_out` may be NULL when `capacity` is 0.
TL_API tl_result tl_scene_find_overlaps(const tl_scene *scene, const tl_scene_instance *instances,
                                        const tl_scene_overlap_query *query, tl_scene_overlap *overlaps_out,
                                        uint32_t capacity, uint32_t *count_out);

/// A point on something.
typedef struct tl_scene_point {
    tl_soup_point point; ///< as in the soup, but point and normal are in the world. Of a shape: TL_NO_TRIANGLE; inside
                         ///< it the distance is 0 and the normal zero
    uint32_t instance;
} tl_scene_point;

/// The nearest point that is at most `max_distance` metres away (INFINITY: anywhere); of equal distances the lowest
/// instance's. Rules and errors as in tl_soup_nearest. `filter` may be NULL.
TL_API tl_result tl_scene_nearest(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 point,
                                  float max_distance, const tl_scene_filter *filter, tl_scene_point *nearest_out);

/// Called for each instance found; false ends the search.
typedef bool tl_scene_instance_fn(uint32_t instance, void *user);

/// Calls `found` once for each instance whose box touches `box` (closed), in an order of the scene's own: the broad
/// phase of queries that are not here. Returns false when `found` ended the search. `filter` may be NULL.
TL_API bool tl_scene_instances_in_box(const tl_scene *scene, tl_aabb box, const tl_scene_filter *filter,
                                      tl_scene_instance_fn *found, void *user);

#ifdef __cplusplus
}
#endif

#endif
