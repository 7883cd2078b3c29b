// SPDX-License-Identifier: MIT
//
// Queries on pairs of convex shapes: distance, overlap, penetration depth, cast, contacts. GJK and EPA on the Minkowski
// difference of the two.
//
// A shape is its support function, which gives the point farthest along a direction, and a radius by which it is
// rounded. All queries compute in double in shape A's frame, so the answer does not depend on where in the world the
// pair is.
//
// NULL shapes and outputs are the caller's bug (TL_ASSERT); a cache may be NULL. Where a pose, the fields of a shape or
// a motion are not finite there is no answer: TL_CONVEX_NOT_FINITE, no overlap, no hit, no contact, an empty box. The
// points of a shape in the caller's memory are not looked through; their coordinates must be finite.

#ifndef TALUS_CONVEX_H
#define TALUS_CONVEX_H

#include <talus/base.h>
#include <talus/hull.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The point of a convex shape that is farthest along a direction (any length; never zero). Must be deterministic.
typedef tl_vec3 tl_convex_support_fn(tl_vec3 direction, void *user);

/// What a shape is the hull of.
typedef enum tl_convex_kind {
    TL_CONVEX_HULL,     ///< a baked hull
    TL_CONVEX_POINTS,   ///< the hull of 1 .. n points in the caller's memory; flat and coincident ones are fine
    TL_CONVEX_INLINE,   ///< the hull of 1 .. 3 points held here: point, segment, triangle
    TL_CONVEX_BOX,      ///< centre in corners[0], half extents in corners[1]
    TL_CONVEX_CYLINDER, ///< middles of both discs in corners[0] and [1], their radius in corners[2].x
    TL_CONVEX_CONE,     ///< middle of the base in corners[0], apex in corners[1], the base's radius in corners[2].x
    TL_CONVEX_CUSTOM    ///< a function of the caller's
} tl_convex_kind;

/// A convex shape in its own frame. Build it with the functions below; nothing is copied or owned.
typedef struct tl_convex {
    tl_convex_kind kind;           ///< which of the fields below count
    float radius;                  ///< metres, >= 0; the shape is grown by a ball of it
    const tl_hull *hull;           ///< TL_CONVEX_HULL; borrowed
    const tl_vec3 *points;         ///< TL_CONVEX_POINTS: [point_count]; borrowed
    uint32_t point_count;          ///< of points, or of corners with TL_CONVEX_INLINE
    tl_vec3 corners[3];            ///< see tl_convex_kind
    tl_convex_support_fn *support; ///< TL_CONVEX_CUSTOM
    void *user;                    ///< handed to support
} tl_convex;

/// A baked hull, which must outlive the shape. All radii here are tl_convex.radius: metres, >= 0.
TL_API tl_convex tl_convex_from_hull(const tl_hull *hull, float radius);
/// The hull of count >= 1 points, which must outlive the shape. The support is a scan: O(count) an iteration.
TL_API tl_convex tl_convex_from_points(const tl_vec3 *points, uint32_t count, float radius);
/// A box along the axes of its frame; half extents >= 0, metres.
TL_API tl_convex tl_convex_box(tl_vec3 center, tl_vec3 half_extents, float radius);
/// A ball; with radius 0 a point.
TL_API tl_convex tl_convex_sphere(tl_vec3 center, float radius);
/// A segment grown by the radius; a and b may coincide.
TL_API tl_convex tl_convex_capsule(tl_vec3 a, tl_vec3 b, float radius);
/// A triangle, which may have no area.
TL_API tl_convex tl_convex_triangle(tl_vec3 a, tl_vec3 b, tl_vec3 c, float radius);
/// A cylinder by the middles of its two discs, which differ; disc_radius >= 0. The support is exact, to double
/// rounding.
TL_API tl_convex tl_convex_cylinder(tl_vec3 a, tl_vec3 b, float disc_radius, float radius);
/// A cone by the middle of its base disc and its apex, which differ; disc_radius >= 0.
TL_API tl_convex tl_convex_cone(tl_vec3 base, tl_vec3 apex, float disc_radius, float radius);
/// Any convex shape by its support function.
TL_API tl_convex tl_convex_custom(tl_convex_support_fn *support, void *user, float radius);

/// The box of a shape in the world: nothing of it lies outside, and each side is off by a few float roundings at most.
TL_API tl_aabb tl_convex_bounds(const tl_convex *shape, tl_transform pose);

/// How far a query's answer can be trusted.
typedef enum tl_convex_status {
    TL_CONVEX_CONVERGED,  ///< the bounds met, or overlap was proven
    TL_CONVEX_ITERATIONS, ///< the iteration limit was reached; the bounds still hold
    TL_CONVEX_DEGENERATE, ///< rounding stopped the progress; the bounds still hold
    TL_CONVEX_NOT_FINITE  ///< a pose, shape, motion or limit is NaN or infinite; all else of the answer is zero
} tl_convex_status;

/// GJK takes as many iterations as the simplex must change; more than this means that rounding prevents convergence.
#define TL_MAX_GJK_ITERATIONS 128u

/// The simplex that a query ended with, to start the next one of the same pair from. All zero starts cold.
/// It changes the time only. Keep one for each pair and thread.
typedef struct tl_simplex_cache {
    uint32_t count;       ///< 0 .. 4
    uint32_t vertex_a[4]; ///< vertices of A; of curved and custom shapes nothing is cached
    uint32_t vertex_b[4]; ///< vertices of B
} tl_simplex_cache;

/// The separation of two shapes: distance, nearest points and direction.
typedef struct tl_separation {
    /// Metres between the witness points, so never less than the true distance but for rounding; 0 on overlap.
    float distance;
    float lower_bound;       ///< metres; the true distance is not less
    bool overlap;            ///< the rounded shapes share a point, or their distance is below double rounding
    tl_vec3 point_a;         ///< witness on A's surface, world
    tl_vec3 point_b;         ///< witness on B's surface, world
    tl_vec3 normal;          ///< unit, from A to B, world; zero on overlap
    tl_convex_status status; ///< how far the answer can be trusted
    uint32_t iterations;     ///< steps taken
} tl_separation;

/// Distance and nearest points of two convex shapes.
///
/// Poses are rigid; a rotation is normalized before use. `cache` may be NULL. Thread safe, no allocation. When the
/// cores (the shapes without their radii) are apart but the rounded shapes overlap, the witness points are those of the
/// rounded surfaces and `overlap` is set; when the cores overlap, the witness points are one common point.
/// Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects, 1988.
TL_API void tl_convex_distance(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                               tl_simplex_cache *cache, tl_separation *separation_out);

/// Whether two convex shapes share a point. Stops at the first separating direction, so it is cheaper than the
/// distance.
TL_API bool tl_convex_overlap(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                              tl_simplex_cache *cache);

/// Iterations of EPA in a penetration query. A hull converges in some ten, a curved shape in some fifty.
#define TL_MAX_EPA_ITERATIONS 124u

/// Support points of the search over directions that follows where EPA did not converge, which is rare: concentric
/// balls of many facets, round shapes on one axis. Each takes some 0.2 us.
#define TL_MAX_DIRECTION_STEPS 131072u

/// The penetration of two shapes: depth, direction and deepest points.
typedef struct tl_penetration {
    bool overlap;            ///< false: the shapes are apart, all else but status and iterations is zero
    float depth;             ///< metres, >= 0: moving B this far along the normal separates the shapes
    float lower_bound;       ///< metres; no shorter motion in any direction separates them
    float upper_bound;       ///< metres; the depth, with the rounding of directions added
    tl_vec3 normal;          ///< unit, from A to B, world. Of several that are equally short, any
    tl_vec3 point_a;         ///< A's point deepest in B, world; point_b + depth * normal, to rounding
    tl_vec3 point_b;         ///< B's point deepest in A, world
    tl_convex_status status; ///< how far the answer can be trusted
    uint32_t iterations;     ///< steps taken
} tl_penetration;

/// The penetration depth: the shortest translation that separates two shapes. Returns `overlap`.
///
/// Cheap while only the radii overlap (the distance of the cores is enough), else EPA. Flat shapes, segments and points
/// have depths too: two segments that cross are 0 deep, along the normal of both. Poses, cache, threads as in
/// tl_convex_distance; 32 KB of stack suffice.
/// Source: van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001.
TL_API bool tl_convex_penetration(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                                  tl_simplex_cache *cache, tl_penetration *penetration_out);

/// tl_convex_penetration with a budget, for a game's frame: at most `max_steps` steps of EPA and of the search over
/// directions together, each a support point of both shapes; 0: no budget but TL_MAX_EPA_ITERATIONS and
/// TL_MAX_DIRECTION_STEPS.
///
/// Whether the shapes overlap is always decided: that takes TL_MAX_GJK_ITERATIONS steps at most, which are not counted
/// here, and so may the search for the deepest points. Where the budget ends it, the status is TL_CONVEX_ITERATIONS and
/// the bounds hold: moving B by upper_bound along the normal separates the shapes, no motion shorter than lower_bound
/// does.
TL_API bool tl_convex_penetration_within(const tl_convex *a, tl_transform pose_a, const tl_convex *b,
                                         tl_transform pose_b, tl_simplex_cache *cache, uint32_t max_steps,
                                         tl_penetration *penetration_out);

/// Iterations of a cast, each of which advances to a separating plane; more mean that it grazes within rounding.
#define TL_MAX_CAST_ITERATIONS 128u

/// Where a moving shape or a ray meets a shape.
typedef struct tl_convex_hit {
    bool hit;             ///< false: all else but status and iterations is zero
    bool initial_overlap; ///< they overlap at the start: t is 0, the normal zero; tl_convex_penetration has the depth
    float t;        ///< fraction of the motion, or ray parameter; never later than the true one but for double rounding
    float gap;      ///< metres still between the shapes at t; at most some 2.4e-7 of their size when converged
    tl_vec3 point;  ///< on A's surface, world
    tl_vec3 normal; ///< unit, from A to B, world
    tl_convex_status status; ///< ITERATIONS and DEGENERATE: free until t, unknown beyond; reported as a hit
    uint32_t iterations;     ///< steps taken
} tl_convex_hit;

/// Linear cast: moves B by `motion` without turning it, and finds when it first touches A. Returns `hit`.
///
/// Shapes that touch at the start and move apart or slide along each other do not hit. Shapes that pass one another
/// closer than `gap` may be reported as hits. Poses and threads as in tl_convex_distance; no allocation.
/// Source: van den Bergen, Ray Casting against General Convex Objects, 2004.
TL_API bool tl_convex_cast(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                           tl_vec3 motion, tl_convex_hit *hit_out);

/// Cast with rotation: moves B from pose `from` to pose `to`, and finds when it first comes as near to A as `gap`,
/// metres, > 0. Returns `hit`.
///
/// The position moves evenly, the rotation the shorter way by the normalized mean of both quaternions, t of the second
/// and 1 - t of the first: at most 1.28 times as fast at half time as on average. t is never later than the
/// true time of that gap but for float rounding of the poses, and then the shapes are at most `gap` apart, or
/// touch: conservative advancement, each step as long as no point of B can close the distance along the separating
/// plane. A step is a distance query; five are common for a gap of a hundredth of the size. A gap below a millionth of
/// the coordinates counts as that. `point` and `normal` as in
/// tl_convex_cast; after TL_MAX_CAST_ITERATIONS the way is free until t, unknown beyond, reported as a hit with
/// TL_CONVEX_ITERATIONS. A `gap` that is not > 0, or NaN: TL_CONVEX_NOT_FINITE.
/// Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996.
TL_API bool tl_convex_cast_turning(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform from,
                                   tl_transform to, float gap, tl_convex_hit *hit_out);

/// Casts a ray at any shape. The direction has any length but zero; t is in units of it, up to t_max, which may be
/// INFINITY. An origin inside is an initial overlap. Returns `hit`.
TL_API bool tl_convex_cast_ray(const tl_convex *shape, tl_transform pose, tl_vec3 origin, tl_vec3 direction,
                               float t_max, tl_convex_hit *hit_out);

/// Contacts of one pair: four that span the common patch, and the deepest point where it is none of these.
#define TL_MAX_CONTACTS 5u

/// Which contacts are wanted. A hundredth of the size of the smaller shape serves well for both lengths. All zero, or a
/// NULL: only shapes that touch or overlap have contacts, and only the corners as deep as the deepest point.
typedef struct tl_contact_limits {
    float margin;    ///< metres, >= 0: shapes that are farther apart have no contacts
    float tolerance; ///< metres, >= 0: a corner of the common patch may be so much less deep than the deepest point
    /// Budget of the depth, as in tl_convex_penetration_within; 0: none. Where it ends the search, the status is
    /// TL_CONVEX_ITERATIONS, and the contacts are those along the best normal found.
    uint32_t max_steps;
} tl_contact_limits;

/// The kind of a contact's feature, in its upper two bits. The others are the index: a vertex or face of a hull, or an
/// edge by the lower of its two half-edges; of shapes without a hull numbers that stay the same from call to call.
/// Zero: a point that no feature is known of.
#define TL_FEATURE_VERTEX 0x40000000u
#define TL_FEATURE_EDGE   0x80000000u ///< see TL_FEATURE_VERTEX
#define TL_FEATURE_FACE   0xc0000000u ///< see TL_FEATURE_VERTEX

/// In tl_contact.previous: a new contact.
#define TL_NO_CONTACT UINT32_MAX

/// A pair of points where two shapes rest on each other.
typedef struct tl_contact {
    tl_vec3 point_a;    ///< on A's surface, world
    tl_vec3 point_b;    ///< on B's surface, world; point_a + separation * normal
    float separation;   ///< metres; negative: this deep
    uint32_t feature_a; ///< of A: a vertex on a face, two edges that cross, ...
    uint32_t feature_b; ///< of B
    /// Which contact of the last call with the same cache this one continues, to start a solver with its impulse;
    /// TL_NO_CONTACT when there is none. Of the same two features, or, where corners coincide and features change from
    /// call to call, at the same place on A.
    uint32_t previous;
} tl_contact;

/// The contacts of two shapes along one normal.
typedef struct tl_contact_manifold {
    uint32_t count;                       ///< 0 .. TL_MAX_CONTACTS
    tl_contact contacts[TL_MAX_CONTACTS]; ///< [count]; the others are zero
    tl_vec3 normal;                       ///< unit, from A to B, world
    float separation;                     ///< metres, of the deepest point along the normal; negative: depth
    tl_convex_status status;              ///< how far the answer can be trusted
} tl_contact_manifold;

/// Points and triangles that a depth is proven by, of tl_polytope_cache.
#define TL_KEPT_POINTS 24u
#define TL_KEPT_FACES  44u ///< see TL_KEPT_POINTS

/// The polytope that a penetration depth was proven by; its fields are private.
typedef struct tl_polytope_cache {
    uint16_t point_count, face_count;     ///< 0: nothing is kept
    uint16_t vertices[TL_KEPT_POINTS][2]; ///< of A and B
    uint8_t corners[TL_KEPT_FACES][3];    ///< counter-clockwise from outside
} tl_polytope_cache;

/// What contacts keep from call to call. All zero starts cold. Keep one for each pair and thread; its fields are
/// private.
typedef struct tl_contact_cache {
    tl_simplex_cache simplex;              ///< that the distance ended with
    uint32_t count;                        ///< contacts of the last call
    uint32_t has_axis;                     ///< the fields from axis_a on are set
    uint32_t features[TL_MAX_CONTACTS][2]; ///< of the last call's contacts
    tl_vec3 points[TL_MAX_CONTACTS];       ///< the same contacts, in A's frame when they were found
    tl_vec3 points_b[TL_MAX_CONTACTS];     ///< their points of B, in B's frame
    tl_vec3 axis_a, axis_b;                ///< the normal in each shape's frame when the depth was proven
    float b_to_a[12];                      ///< the pose of B seen from A then
    float proven_depth;                    ///< metres, of the cores; they were no less deep
    tl_polytope_cache polytope;            ///< that the depth of the cores was proven by
} tl_contact_cache;

/// With a cache a contact may be kept although another point is deeper, by up to this part of the limits' tolerance.
#define TL_CONTACT_SLACK (1.0f / 32.0f)

/// Where two shapes rest on each other: their contact manifold. Returns the number of contacts; 0 when the shapes are
/// farther apart than the limits' margin.
///
/// Where faces meet, or an edge rests on a face or along an edge, these are the corners of their common patch within
/// the limits' tolerance; of more than four, those that span the largest area. Faces and edges are those of hulls,
/// boxes and triangles, the segment of a capsule, the sides and caps of cylinders and cones (a cap as a polygon of 16
/// corners). Everything else gives one contact. The deepest point is always among them, also where it lies between the
/// corners.
///
/// With a cache, contacts stay what they were: the last ones are chosen again while they span half of what the patch
/// does and the deepest of them is within TL_CONTACT_SLACK of the tolerance; and the last normal serves while it is
/// proven that no other one is shallower by more than that: by how far the pair has moved, or by what proved the depth,
/// looked at anew. Where no corner has moved by more than about that either, the last contacts go along with A, their
/// separations are measured anew, and no face is looked for. Without a cache the deepest point is exact. Costs at most
/// a distance, a penetration depth and a search for each shape's face; linear in the corners of both faces. `limits`
/// may be NULL. Poses, threads as in tl_convex_distance; `cache` may be NULL.
TL_API uint32_t tl_convex_contacts(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                                   const tl_contact_limits *limits, tl_contact_cache *cache,
                                   tl_contact_manifold *manifold_out);

/// The contacts of two shapes along a normal that the caller knows better, as the floor's at an inner edge of it:
/// `normal` is unit, world, from A to B. Returns the number of contacts; 0 when along the normal all of B is farther
/// from A than the limits' margin, or nothing of B lies over what A rests on.
///
/// The corners of the common patch of the faces that look along the normal, as in tl_convex_contacts, or B's farthest
/// point where it has no face; `separation` is that of the deepest contact. `limits` may be NULL. Features, threads as
/// in tl_convex_contacts; there is no cache.
TL_API uint32_t tl_convex_contacts_along(const tl_convex *a, tl_transform pose_a, const tl_convex *b,
                                         tl_transform pose_b, tl_vec3 normal, const tl_contact_limits *limits,
                                         tl_contact_manifold *manifold_out);

#ifdef __cplusplus
}
#endif

#endif
