// SPDX-License-Identifier: MIT
//
// The chunky triangle soup: a triangle list, baked into pairs of triangles that share an edge, in the leaves of a
// 16-wide BVH or of a k-d tree. Rays, points and shapes query it.
//
//   tl_mesh_view --tl_soup_bake (weld, pair, BVH)--> tl_soup --tl_soup_cast_ray, tl_soup_occluded ...--> tl_ray_hit
//
// Geometry alone defines what a ray hits: the tree, the pairing and the instruction set do not change it.
//
// - A triangle is closed: its edges and corners belong to it. Whether the ray's line meets it is decided exactly, so a
//   line through a shared edge meets both triangles, and no line slips between two of them (watertight).
// - A ray in the plane of a triangle does not hit that triangle. On a closed surface it hits a neighbour.
// - A ray holds the points origin + t * direction with t in [0, tmax]. The direction need not have length 1. Whether
//   t >= 0 is decided exactly; t is compared with tmax after rounding.
// - t is computed in double from the triangle's own three corners and rounded to float once. Of equal t the lowest
//   triangle index wins.
// - A ray hits nothing when its direction is zero, a coordinate is NaN or infinite, or tmax is negative or NaN. tmax
//   may be INFINITY. A t beyond FLT_MAX (denormal directions) is reported as FLT_MAX.
//
// Queries take a const soup, allocate nothing, and may run on any number of threads at once. Bytes from an untrusted
// source must pass tl_soup_check first: then every query on them is safe and ends, whatever floats they hold.
//
// Functions that return a tl_result refuse NULL pointers (TL_ERR_ARGUMENT) and zero their outputs when they fail or
// find nothing. Other functions take no NULL but where it is allowed. A pose with a zero quaternion is not rotated.
//
// Sources: Christer Ericson, "Chunky triangle soup", 2009, and Real-Time Collision Detection, 2005, section 5.3.5;
// Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2013.

#ifndef TALUS_SOUP_H
#define TALUS_SOUP_H

#include <talus/base.h>
#include <talus/convex.h>
#include <talus/mesh.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A baked soup. It begins with a tl_blob: `tl_blob_free` frees it.
typedef struct tl_soup tl_soup;

/// "tlsp" in memory.
#define TL_SOUP_MAGIC   0x70736c74u
#define TL_SOUP_VERSION 4u
/// The version of soups in which no triangles coincide: older readers open these too.
#define TL_SOUP_VERSION_ALONE 3u

/// The largest number of triangles of one view: an index shares a 32-bit word with four bits of its pair.
#define TL_MAX_SOUP_TRIANGLES 0x0fffffffu

/// How the tree divides the triangles. Answers are the same, bit for bit.
typedef enum tl_soup_partition {
    TL_SOUP_BVH, ///< a BVH divides the pairs: each lies in one leaf, or in several with split_budget. The faster tree.
    /// A k-d tree divides space: pairs that a plane cuts are stored on both sides, at most 16 times each on average. It
    /// takes 1 to 4 times the memory (7 on one of 22 levels). It is the tree of Ericson's article, here to reproduce
    /// its comparison.
    TL_SOUP_KD_TREE
} tl_soup_partition;

/// How a soup is stored. Answers are the same, bit for bit.
typedef enum tl_soup_layout {
    TL_SOUP_FAST,   ///< 35 to 41 bytes a triangle, on 22 levels
    TL_SOUP_COMPACT ///< 15 to 19 bytes: shared vertices, quantized boxes. It cannot be refitted
} tl_soup_layout;

/// How much a bake does for faster rays, by spatial splits (SBVH): a pair that straddles a split plane is stored on
/// both sides, so that large triangles do not widen the boxes around small ones. Rays gain up to 40 % on arena maps,
/// and nothing on terrain or where triangles are all alike. So the tree is built with and without them, and kept with
/// them only where the surface area heuristic expects rays to cost less. Answers are the same, bit for bit.
typedef enum tl_soup_quality {
    TL_SOUP_QUALITY_DEFAULT, ///< a fifth more references at most: 35 to 46 bytes a triangle, on 18 levels
    TL_SOUP_QUALITY_FAST,    ///< no splits: bakes in 0.5 to 0.9 of the time. For soups that are refitted, too
    TL_SOUP_QUALITY_HIGH     ///< half as many references more at most: 35 to 52 bytes a triangle
} tl_soup_quality;

/// How to bake a soup. Begin with tl_default_soup_def().
typedef struct tl_soup_def {
    bool pair_triangles; ///< false keeps every triangle single, to measure what pairs are worth
    tl_soup_partition partition;
    tl_soup_layout layout;
    tl_soup_quality quality; ///< of TL_SOUP_BVH
    /// The share of extra references, (0, 1], that spatial splits may add, whether they pay or not. 0: as `quality`
    /// says. TL_SOUP_KD_TREE ignores it.
    float split_budget;
    tl_host host;
    uint32_t cookie; ///< TL_DEF_COOKIE, set by tl_default_soup_def
} tl_soup_def;

/// What tl_soup_bake did.
typedef struct tl_soup_report {
    tl_report base;
    uint32_t triangle_count;       ///< stored
    uint32_t degenerate_triangles; ///< dropped: their area is exactly zero, so no ray can hit them
    uint32_t pair_count;           ///< distinct: copies by spatial splits count once
    uint32_t single_count;         ///< distinct triangles without a partner
    uint32_t coincident_count;     ///< of the same three corners as one in a pair or a single, which stands for them
} tl_soup_report;

/// Pairs in a BVH, the fast layout, default quality.
TL_API tl_soup_def tl_default_soup_def(void);

/// Bakes a triangle list. Triangles keep their index in the view: queries report it.
///
/// The triangles may intersect, repeat, be loose, or share an edge by the dozen. Corners at equal positions count as
/// shared, so the view need not be welded. Triangles of the same three corners, whichever way they run, are all there
/// for every query, but up to eight lie in the tree once: both sides of a wall take the time of one. The bytes depend
/// only on the view and on the def's fields before `host`. A NULL `def` means the defaults. `report_out` may be NULL.
/// Free the soup with `tl_blob_free(soup)`. O(n log n). Errors, each with its element or field in `report_out->base`:
/// TL_ERR_EMPTY (no triangles), TL_ERR_INDEX (triangle), TL_ERR_NOT_FINITE (vertex), TL_ERR_RANGE (vertex beyond
/// TL_MAX_COORDINATE), TL_ERR_DEGENERATE (no triangle has area), TL_ERR_LIMIT (more than TL_MAX_SOUP_TRIANGLES),
/// TL_ERR_ARGUMENT, TL_ERR_MEMORY, TL_ERR_CANCELLED. Vertices that no triangle uses may hold anything.
TL_API tl_result tl_soup_bake(const tl_mesh_view *view, const tl_soup_def *def, tl_soup **soup_out,
                              tl_soup_report *report_out);

/// Moves a soup's triangles to where their vertices are now: the same triangles and indices at other positions, with
/// any number of vertices. In place, O(n), no memory.
///
/// Every query then answers as if the soup had been baked anew, bit for bit. Queries slow down as triangles move apart
/// from their neighbours in the tree: bake anew when they have mixed. Triangles that lost their area are kept, and no
/// ray hits them; those that had none when the soup was baked stay dropped. Vertices that had equal positions must
/// still have equal positions. The soup must be writable (not a mapped file), and no query may run meanwhile: refit a
/// second soup while the first one is queried.
/// TL_ERR_ARGUMENT (another number of triangles, or a triangle that came apart from its pair, or from one that it
/// coincided with), TL_ERR_UNSUPPORTED (the compact layout: triangles that may come apart share its vertices),
/// TL_ERR_INDEX (triangle), TL_ERR_NOT_FINITE, TL_ERR_RANGE (vertex), with the element in `report_out`, which may be
/// NULL; the soup is then unchanged.
TL_API tl_result tl_soup_refit(tl_soup *soup, const tl_mesh_view *moved, tl_report *report_out);

/// Whether `size` bytes at `bytes` are a sound soup: TL_OK, or TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION,
/// TL_ERR_ARGUMENT (NULL, or not aligned to TL_BLOB_ALIGNMENT), TL_ERR_CORRUPT, with the offending part in
/// `report_out`, which may be NULL. Safe on any bytes. O(size).
/// On success the bytes may be used in place as a tl_soup. This proves that queries are safe and end, not that the
/// tree's boxes hold their triangles: a content hash is left to the container.
TL_API tl_result tl_soup_check(const void *bytes, uint64_t size, tl_report *report_out);

/// The blob's size in bytes.
TL_API uint64_t tl_soup_size(const tl_soup *soup);

/// The box of all stored triangles.
TL_API tl_aabb tl_soup_bounds(const tl_soup *soup);

/// What a soup holds. Bytes a triangle: size / triangle_count.
typedef struct tl_soup_stats {
    uint64_t size;                  ///< bytes in all, vertices, ids, materials and nodes included
    uint32_t source_triangle_count; ///< triangles of the view it was baked from
    uint32_t triangle_count;        ///< distinct triangles stored
    uint32_t pair_count;            ///< distinct pairs
    uint32_t single_count;          ///< distinct triangles without a partner
    uint32_t coincident_count;      ///< of the same three corners as one in a pair or a single: triangle_count is
                                    ///< 2 * pair_count + single_count + coincident_count
    uint32_t reference_count;       ///< pairs and singles in leaves; more than distinct ones where splits copied them
    uint32_t leaf_count;
    uint32_t node_count;
    tl_soup_layout layout;
    uint32_t depth;          ///< nodes on the longest path from the root to a leaf
    uint64_t node_bytes;     ///< of size: nodes
    uint64_t leaf_bytes;     ///< of size: corners and triangle indices
    uint64_t vertex_bytes;   ///< of size: shared vertices of the compact layout
    uint64_t material_bytes; ///< of size: 0 when all materials are the same
} tl_soup_stats;

TL_API tl_soup_stats tl_soup_get_stats(const tl_soup *soup);

/// A ray: origin + t * direction for t in [0, tmax].
typedef struct tl_ray {
    tl_vec3 origin;    ///< metres
    tl_vec3 direction; ///< of any length but 0
    float tmax;        ///< >= 0, or INFINITY
} tl_ray;

/// Which side of a triangle a query ignores. The front is the side from which the corners run counter-clockwise.
typedef enum tl_ray_cull {
    TL_RAY_CULL_NONE = 0, ///< neither: both sides stop a ray
    TL_RAY_CULL_BACK,     ///< only fronts stop it
    TL_RAY_CULL_FRONT     ///< only backs stop it
} tl_ray_cull;

/// Whether a triangle counts: false ignores it. Must answer the same for the same triangle during one query. It may be
/// called for triangles that are not the closest, in any order and more than once.
typedef bool tl_triangle_filter_fn(uint32_t triangle, uint16_t material, void *user);

/// What a query ignores. A zeroed filter, or NULL, ignores nothing.
typedef struct tl_ray_filter {
    tl_ray_cull cull;
    uint64_t ignored_materials;    ///< bit m ignores triangles of material m; bit 63 all materials >= 63
    tl_triangle_filter_fn *accept; ///< called last; NULL: all count
    void *accept_user;
} tl_ray_filter;

/// Where a ray hit the soup. The point is origin + t * direction, and nearly corner 0 * (1 - u - v) + corner 1 * u +
/// corner 2 * v of the triangle, its corners numbered as in the view.
typedef struct tl_ray_hit {
    float t;
    uint32_t triangle; ///< its index in the view
    float u, v;        ///< >= 0, u + v <= 1 but for rounding
    tl_vec3 normal;    ///< unit length, of the triangle's front; zero for a needle too thin for doubles
    uint16_t material;
    bool back; ///< the ray came from behind
} tl_ray_hit;

/// The closest hit of a ray; false, with `hit_out` untouched, when there is none. `filter` may be NULL.
///
/// t is within 5/8 ulp of the exact value, however the ray grazes the triangle.
TL_API bool tl_soup_cast_ray(const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter, tl_ray_hit *hit_out);

/// Whether a ray hits anything. Agrees with tl_soup_cast_ray, and is faster. `filter` may be NULL.
TL_API bool tl_soup_occluded(const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter);

/// The hit of the segment from a to b that is closest to a, t in [0, 1]; false, with `hit_out` untouched, when there is
/// none. Both ends are exact: b is not rounded by way of a direction, and a triangle that touches it is hit. Equal ends
/// hit nothing. `filter` may be NULL.
TL_API bool tl_soup_cast_segment(const tl_soup *soup, tl_vec3 a, tl_vec3 b, const tl_ray_filter *filter,
                                 tl_ray_hit *hit_out);

/// Whether no triangle meets the closed segment from a to b. From b to a the answer is the same (but for culling).
/// `filter` may be NULL.
TL_API bool tl_soup_line_of_sight(const tl_soup *soup, tl_vec3 a, tl_vec3 b, const tl_ray_filter *filter);

/// A segment: the points from a to b, both included.
typedef struct tl_segment {
    tl_vec3 a; ///< metres
    tl_vec3 b;
} tl_segment;

/// The closest hits of many rays: for each what tl_soup_cast_ray gives, bit for bit; triangle TL_NO_TRIANGLE and t
/// INFINITY for a ray that hits nothing. `filter` and `host` may be NULL.
///
/// Runs on the host's tasks, 512 rays each. Rays that follow each other in the array and run nearly alike, as those
/// of a camera's row or tile, a lidar's fan, or shadow rays of neighbouring points do, are found and traced sixteen at
/// once, for 1 / 3 to 1 / 5 of the time of single calls. Of others a thread has several under way, so that one
/// continues while another waits for memory or a missed branch: 1 to 1 / 1.6, and where any hit will do 1 / 1.2
/// to 1 / 1.6. With a filter none are sought that run alike; in the compact layout rays are traced one by one.
TL_API void tl_soup_cast_rays(const tl_soup *soup, const tl_ray *rays, uint32_t count, const tl_ray_filter *filter,
                              const tl_host *host, tl_ray_hit *hits_out);

/// The closest hits of many segments: for each what tl_soup_cast_segment gives, as in tl_soup_cast_rays.
TL_API void tl_soup_cast_segments(const tl_soup *soup, const tl_segment *segments, uint32_t count,
                                  const tl_ray_filter *filter, const tl_host *host, tl_ray_hit *hits_out);

/// Whether each of many rays hits anything: what tl_soup_occluded gives, as in tl_soup_cast_rays.
TL_API void tl_soup_occluded_rays(const tl_soup *soup, const tl_ray *rays, uint32_t count, const tl_ray_filter *filter,
                                  const tl_host *host, bool *occluded_out);

/// Whether nothing meets each of many segments: what tl_soup_line_of_sight gives, as in tl_soup_cast_rays.
TL_API void tl_soup_lines_of_sight(const tl_soup *soup, const tl_segment *segments, uint32_t count,
                                   const tl_ray_filter *filter, const tl_host *host, bool *clear_out);

/// What counts as a hit where a ray passes through an edge or a corner.
typedef enum tl_hit_rule {
    /// Every triangle that the ray touches, as in tl_soup_cast_ray: at an edge both of its triangles, at a corner the
    /// whole fan.
    TL_HITS_TOUCHED,
    /// Every passage through a surface once: of the triangles around an edge or corner those count that the ray still
    /// meets when it is moved aside by an infinitesimal step. So a line crosses a closed surface an even number of
    /// times, always, and a ray from the inside an odd number. The rim of an open surface counts on one side only.
    TL_HITS_CROSSED
} tl_hit_rule;

/// All hits of a ray, sorted by t, of equal t by triangle; each triangle at most once. `filter` may be NULL.
///
/// Writes the nearest `capacity` of them, and to `*count_out` how many there are: TL_INCOMPLETE when that is more. A
/// ray without hits gives TL_OK and 0. With TL_HITS_TOUCHED the first one is the hit of tl_soup_cast_ray, bit for bit.
/// `hits_out` may be NULL when `capacity` is 0. TL_ERR_NOT_FINITE: origin or direction; TL_ERR_ARGUMENT: the direction
/// is zero, or tmax negative or NaN.
TL_API tl_result tl_soup_cast_ray_all(const tl_soup *soup, const tl_ray *ray, tl_hit_rule rule,
                                      const tl_ray_filter *filter, tl_ray_hit *hits_out, uint32_t capacity,
                                      uint32_t *count_out);

/// A part of a triangle, corners numbered as in the view.
typedef enum tl_triangle_feature {
    TL_TRIANGLE_FACE = 0, ///< the inside
    TL_TRIANGLE_EDGE_0,   ///< from corner 0 to corner 1
    TL_TRIANGLE_EDGE_1,   ///< from corner 1 to corner 2
    TL_TRIANGLE_EDGE_2,   ///< from corner 2 to corner 0
    TL_TRIANGLE_CORNER_0,
    TL_TRIANGLE_CORNER_1,
    TL_TRIANGLE_CORNER_2
} tl_triangle_feature;

/// A point on the soup.
typedef struct tl_soup_point {
    tl_vec3 point;
    float distance; ///< metres from the query's point
    tl_vec3 normal; ///< unit length, of the triangle's front; zero for a needle too thin for doubles
    uint32_t triangle;
    uint16_t material;
    bool back; ///< the query's point lies behind the triangle's plane, exactly
    tl_triangle_feature feature;
} tl_soup_point;

/// The point of the soup that is nearest to `point` and at most `max_distance` metres away (INFINITY: anywhere).
///
/// Distances are computed in double from each triangle's own corners, with a relative error of 1e-7 at most; of equal
/// ones the lowest triangle index wins. So the answer does not depend on how the triangles are stored. From a point in
/// a triangle's plane both sides are seen. `filter` may be NULL.
/// TL_NOT_FOUND: nothing is that near; TL_ERR_NOT_FINITE: the point; TL_ERR_ARGUMENT: max_distance is negative or NaN.
TL_API tl_result tl_soup_nearest(const tl_soup *soup, tl_vec3 point, float max_distance, const tl_ray_filter *filter,
                                 tl_soup_point *nearest_out);

/// Whether a shape at `pose` touches any triangle.
///
/// Spheres, capsules and boxes without a radius are decided by formulas in double, other shapes by tl_convex_overlap;
/// touching within the rounding of either counts as touching. For culling, a triangle is seen from the middle of the
/// shape's box. `filter` may be NULL.
/// TL_ERR_NOT_FINITE: the pose, or a shape without a finite box; TL_ERR_ARGUMENT: a radius is negative or NaN.
TL_API tl_result tl_soup_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose,
                                  const tl_ray_filter *filter, bool *overlaps_out);

/// The triangles that a shape touches, each once, in an order of the soup's own. Rules and errors as in
/// tl_soup_overlaps.
/// Writes at most `capacity` of them, and to `*count_out` how many there are: TL_INCOMPLETE when that is more.
/// `triangles_out` may be NULL when `capacity` is 0.
TL_API tl_result tl_soup_find_overlaps(const tl_soup *soup, const tl_convex *shape, tl_transform pose,
                                       const tl_ray_filter *filter, uint32_t *triangles_out, uint32_t capacity,
                                       uint32_t *count_out);

/// What a moving shape hit.
typedef struct tl_shape_hit {
    float t;              ///< share of the motion, [0, 1]; not later than the true one
    bool initial_overlap; ///< it overlapped at the start: t is 0
    bool back;            ///< it moved with the triangle's normal: it came from behind
    uint16_t material;
    uint32_t triangle;
    float depth;         ///< metres, of an initial overlap: moving this far along the normal separates them
    tl_vec3 point;       ///< on the triangle
    tl_vec3 normal;      ///< unit length, from the triangle to the shape: the face's, or an edge's or corner's own
    tl_vec3 face_normal; ///< unit length, of the triangle's front; zero for a needle too thin for doubles
    /// ITERATIONS or DEGENERATE: the way is free until t, unknown beyond, and reported as a hit
    tl_convex_status status;
} tl_shape_hit;

/// Sweeps a convex shape by `motion`, without rotation, and finds the triangle that it hits first.
///
/// Spheres and capsules (characters) take a faster path of their own. Of triangles hit at the same time the lowest
/// index is reported, of those that overlap at the start the deepest. `filter` may be NULL. For culling, a motion
/// against a triangle's normal sees its front; a shape that does not move sees it from the middle of its box.
///
/// Touching: the shape passes a triangle that it penetrates by no more than 2.4e-7 of the largest coordinate that it
/// reaches. So it slides along the floor that it stands on, over all inner edges, and leaves a wall that it leans on.
/// Edges are not smoothed: at an inner edge of a floor that bends, `normal` is the edge's and `face_normal` the
/// floor's.
///
/// TL_NOT_FOUND: the way is free; TL_ERR_NOT_FINITE: motion, pose or shape; TL_ERR_ARGUMENT: a radius is negative or
/// NaN.
TL_API tl_result tl_soup_cast_shape(const tl_soup *soup, const tl_convex *shape, tl_transform pose, tl_vec3 motion,
                                    const tl_ray_filter *filter, tl_shape_hit *hit_out);

/// What is asked of tl_soup_find_contacts. Set shape and pose; the rest may be zero.
typedef struct tl_soup_contact_query {
    const tl_convex *shape;      ///< borrowed
    tl_transform pose;           ///< of the shape, rigid
    tl_contact_limits limits;    ///< as in tl_convex_contacts
    const tl_ray_filter *filter; ///< may be NULL; for culling, triangles are seen from the middle of the shape's box
} tl_soup_contact_query;

/// Where a shape rests on one triangle.
typedef struct tl_soup_contact {
    uint32_t triangle;            ///< index in the input
    uint16_t material;            ///< of the triangle
    bool is_face;                 ///< the normal is that of the triangle; else of an edge or corner that stands out
    tl_contact_manifold manifold; ///< A is the triangle, B the shape; the normal leads from the triangle to the shape
} tl_soup_contact;

/// Where a shape rests on the soup: the contacts with each triangle, in an order of the soup's own.
///
/// No ghost contacts: where a shape slides over a floor of many triangles, the nearest way out of the next one may lead
/// sideways, and its edge would stop the shape. A contact at an edge or corner counts as it is only when no triangle
/// that meets it there rises above the plane across the contact's normal; so the edge stands out. Else the triangle is
/// met along its own normal, or, where nothing of the shape lies over it, not at all. Triangles meet where they share
/// the point, by a millionth of the coordinates; so T-junctions and meshes that are not welded serve too.
///
/// Writes at most `capacity` and to `*count_out` how many there are: TL_INCOMPLETE when that is more. `contacts_out`
/// may be NULL when `capacity` is 0. No allocation. Features name the triangle's corners 0 to 2; match contacts from
/// step to step by triangle and features. TL_ERR_NOT_FINITE: the pose, the limits, or a shape without a finite box;
/// TL_ERR_ARGUMENT: a radius is negative or NaN.
TL_API tl_result tl_soup_find_contacts(const tl_soup *soup, const tl_soup_contact_query *query,
                                       tl_soup_contact *contacts_out, uint32_t capacity, uint32_t *count_out);

typedef enum tl_soup_side { TL_SOUP_OUTSIDE, TL_SOUP_INSIDE, TL_SOUP_ON_SURFACE } tl_soup_side;

/// Where a point lies with respect to a closed surface.
typedef struct tl_soup_location {
    tl_soup_side side; ///< inside: the winding number is not 0
    int32_t winding;   ///< how often the surface winds around the point: 1 in a solid, more where solids overlap, -1 in
                       ///< one that is inside out
    uint32_t triangle; ///< on the surface: the lowest that holds the point, else TL_NO_TRIANGLE
} tl_soup_location;

/// Whether a point lies inside a closed soup: exact, whatever edges and corners its rays pass through.
///
/// TL_ERR_NOT_CLOSED, TL_ERR_WINDING: rays from the point in opposite directions contradict each other, so the surface
/// has a hole or a rim, or triangles with opposite winding side by side. Not every hole shows at every point;
/// tl_soup_check_closed proves that there is none. TL_ERR_NOT_FINITE: the point.
TL_API tl_result tl_soup_locate(const tl_soup *soup, tl_vec3 point, tl_soup_location *location_out);

/// Whether the triangles of a soup enclose a volume: along every edge as many run one way as the other. They may
/// intersect.
///
/// TL_ERR_NOT_CLOSED (a hole or rim) or TL_ERR_WINDING (all edges are shared, but some neighbours have opposite
/// winding), with a triangle in `report_out`, which may be NULL. Not a query: it allocates from the host, which may be
/// NULL too. TL_ERR_MEMORY, TL_ERR_CANCELLED. O(n).
TL_API tl_result tl_soup_check_closed(const tl_soup *soup, const tl_host *host, tl_report *report_out);

/// One stored triangle.
typedef struct tl_soup_triangle {
    tl_vec3 corners[3]; ///< as in the view, in the view's order
    uint32_t triangle;  ///< its index in the view
    uint16_t material;
} tl_soup_triangle;

/// Visits all triangles, each once, in the soup's own order. Start with `*cursor` 0; false at the end.
TL_API bool tl_soup_next_triangle(const tl_soup *soup, uint64_t *cursor, tl_soup_triangle *triangle_out);

/// One pair, or one triangle without a partner. Of triangles that coincide the lowest is named.
typedef struct tl_soup_pair {
    tl_vec3 corners[4];    ///< a, b, c, d: triangles a, b, c and a, c, d share the edge a, c; a single has d == a
    uint32_t triangles[2]; ///< indices in the view; the second is TL_NO_TRIANGLE for a single
} tl_soup_pair;

/// Visits all pairs and singles, each once. Start with `*cursor` 0; false at the end.
TL_API bool tl_soup_next_pair(const tl_soup *soup, uint64_t *cursor, tl_soup_pair *pair_out);

/// Called for each triangle found; false ends the search.
typedef bool tl_soup_triangle_fn(const tl_soup_triangle *triangle, void *user);

/// Calls `found` once for each triangle that may touch `box` (closed): for every one that does, for none whose own box
/// does not. In the soup's own order. Returns false when `found` ended the search.
TL_API bool tl_soup_triangles_in_box(const tl_soup *soup, tl_aabb box, tl_soup_triangle_fn *found, void *user);

/// Called for each box of the tree: `depth` 0 is the root's box, a `leaf` holds pairs. False ends the visit.
typedef bool tl_soup_bvh_box_fn(tl_aabb box, uint32_t depth, bool leaf, void *user);

/// Calls `visit` for every box of the tree down to `max_depth`, parents before children. Returns false when `visit`
/// ended it.
TL_API bool tl_soup_bvh_boxes(const tl_soup *soup, uint32_t max_depth, tl_soup_bvh_box_fn *visit, void *user);

#ifdef __cplusplus
}
#endif

#endif
