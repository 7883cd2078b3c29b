// SPDX-License-Identifier: MIT
//
// Convex hulls: baked from points into one block; queries for support points, rays, mass and topology.
//
// The bake decides every side of every plane exactly, so the hull is the true convex hull of the float points at any
// scale and at any distance from the origin. Faces are polygons: triangles that lie in exactly one plane are merged,
// and only strict corners stay vertices. With tl_hull_def.merge_distance those in nearly one plane are merged too: the
// vertices are still the corners of an exact hull, no face's plane cuts it, and a bound says what lies outside.
// Source: Barber, Dobkin, Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM TOMS 22, 1996.

#ifndef TALUS_HULL_H
#define TALUS_HULL_H

#include <talus/base.h>
#include <talus/halfedge.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_HULL_MAGIC   0x4c554854u ///< "THUL"
#define TL_HULL_VERSION 3u          ///< of the layout

/// Largest absolute coordinate of a hull's points: edges and their dot products stay finite floats.
#define TL_MAX_HULL_COORDINATE 1e30f

/// A bake takes fewer points than this, so that its half-edges fit 32 bits.
#define TL_MAX_HULL_POINTS 0x10000000u

/// No vertex, and no face, where an index of one is expected.
#define TL_NO_VERTEX UINT32_MAX

/// How a hull is baked.
typedef struct tl_hull_def {
    /// 0: no limit; else >= 4. The points are added farthest first, so a hull that reaches the limit is the hull of
    /// those that matter most; the report says how far outside the others lie.
    uint32_t max_vertices;
    /// Metres, >= 0. 0: input without volume is refused (TL_ERR_COPLANAR, ...). Else it is made this thick, half to
    /// each side, along every direction in which it has no extent.
    float thickness;
    /// >= 0. Input counts as flat when its thickness is at most this many roundings (half ulps) of its largest
    /// coordinate: 8 covers a plane whose points were rounded to floats. 0: only what is exactly flat.
    float flatness;
    /// Metres, >= 0. Corners that lie within this of an earlier one are left out. 0: only equal points are one.
    float weld_distance;
    /// Metres, >= 0. 0: faces are exactly flat, so a turned box, whose corners were rounded, has twelve. Else nearly
    /// coplanar faces are one: those whose corners all lie within this behind the plane of one of them, the largest
    /// first, and that face no more than 45 degrees away from it; and corners inside such a face, or in the middle of a
    /// nearly straight edge, are left out. 1e-5 of the size undoes rounding; a scanned body takes its noise.
    float merge_distance;
    tl_host host;    ///< allocator and progress
    uint32_t cookie; ///< private: set by tl_default_hull_def
} tl_hull_def;

/// What tl_hull_bake did.
typedef struct tl_hull_report {
    tl_report base;           ///< what failed, and where
    uint32_t triangle_count;  ///< of the hull before coplanar ones were merged
    bool thickened;           ///< the input had no volume, and was given the def's thickness
    uint32_t points_left_out; ///< points outside, because max_vertices was reached
    /// Metres, to double rounding: no point of the input lies farther outside of the hull. 0 where none was left out;
    /// at most weld_distance + merge_distance, if max_vertices is 0.
    double max_outside;
    uint32_t corners_left_out; ///< of the exact hull, by weld_distance and merge_distance
} tl_hull_report;

/// One directed edge of a face. The face lies to its left, seen from outside; the half-edges of a face are consecutive.
typedef struct tl_hull_half_edge {
    uint32_t origin; ///< vertex it starts at
    uint32_t twin;   ///< the same edge in the other direction
    uint32_t next;   ///< in the face's loop, counter-clockwise
    uint32_t face;   ///< to its left
} tl_hull_half_edge;

/// A convex polygon, a run of consecutive half-edges.
typedef struct tl_hull_face {
    uint32_t first; ///< its first half-edge; the one of its lowest vertex
    uint32_t count; ///< >= 3
} tl_hull_face;

/// Points p with normal . p <= offset are inside. The normal has unit length, to double rounding.
typedef struct tl_hull_plane {
    double normal[3]; ///< outward
    double offset;    ///< metres from the origin, along the normal
} tl_hull_plane;

/// The planes of eight faces, as queries read them: face f is lane f % 8 of block f / 8. Lanes beyond the last face are
/// zero, planes that everything is on.
typedef struct tl_hull_plane_block {
    double x[8], y[8], z[8]; ///< normals
    double offset[8];        ///< metres
} tl_hull_plane_block;

/// For density 1. Computed in double about a point inside, so it is as good far from the origin. A body thinner than
/// double rounding of its length has volume and inertia 0, and the mean of its vertices as centre.
typedef struct tl_hull_mass {
    double volume;     ///< cubic metres, >= 0
    double area;       ///< of the surface, square metres
    double center[3];  ///< centre of mass, metres
    double inertia[6]; ///< about the centre of mass: xx, yy, zz, xy, xz, yz of the tensor (products carry their minus)
} tl_hull_mass;

/// The baked hull: a blob. Read it through the functions below; offsets are bytes from its beginning.
/// Vertices are in the order of their points in the input, so "lowest vertex" is "earliest point".
typedef struct tl_hull {
    tl_blob blob; ///< the head; free the hull with tl_blob_free
    // All that tl_hull_support reads of the head lies in its first cache line; the layout of these parts is private.
    // Offsets here are in units of TL_BLOB_ALIGNMENT.
    uint32_t vertex_count; ///< V >= 4
    uint32_t scan_count;   ///< length of the scan's rows, 8 or a multiple of 16; 0: the hull is too large to be scanned
    float scan_error;      ///< error of the scan's dot products for a direction with |x| + |y| + |z| = 1
    uint32_t table_side;   ///< cells along a side of the direction table's two squares, 0 when the hull is scanned
    tl_vec3 table_scale;   ///< what a direction is multiplied by before it is looked up
    uint32_t blocks;       ///< edge vectors and neighbours
    uint32_t scan;         ///< float [3][scan_count]: x, y, z from the middle of the bounds
    uint32_t table;        ///< uint32_t [2 table_side^2 + ring_cells] a vertex to start from, or a ring to look in
    uint32_t rings;        ///< maps of large faces
    uint32_t block_count;  ///< V, and one for every seven neighbours of a vertex beyond eight
    uint32_t ring_count;   ///< large faces with a ring
    uint32_t ring_cells;   ///< of all rings
    uint32_t face_count;   ///< F
    uint32_t half_edge_count; ///< 2 E; V - E + F = 2
    tl_aabb bounds;           ///< of the vertices, exact
    tl_hull_mass mass;        ///< for density 1
    uint64_t vertices;        ///< tl_vec3 [V]
    uint64_t sources;         ///< uint32_t [V] index of the input point
    uint64_t vertex_edges;    ///< uint32_t [V] a half-edge that starts there
    uint64_t half_edges;      ///< tl_hull_half_edge [2 E]
    uint64_t faces;           ///< tl_hull_face [F]
    uint64_t planes;          ///< tl_hull_plane_block [(F + 7) / 8]
    double merge_distance;    ///< metres; a face's corners lie within this of its plane. 0: exactly in it
} tl_hull;

/// No limit of vertices, no thickness, flatness 8, nothing welded or merged but what is exactly equal, malloc.
TL_API tl_hull_def tl_default_hull_def(void);

/// Bakes the convex hull of `count` points. Duplicates and inner points are allowed and cost little.
///
/// The result depends on the points and the def only. O(n log n) for points in general position.
/// Errors: TL_ERR_EMPTY (no point), TL_ERR_NOT_FINITE and TL_ERR_RANGE (with the point's index, or field "thickness"),
/// TL_ERR_COINCIDENT,
/// TL_ERR_COLLINEAR, TL_ERR_COPLANAR (input without volume, see tl_hull_def; also when `thickness` is lost in
/// rounding), TL_ERR_ARGUMENT, TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED. On failure `*hull_out` is NULL.
/// `def` NULL: defaults. `report_out` may be NULL, and so may `points` when count is 0. Free with tl_blob_free.
TL_API tl_result tl_hull_bake(const tl_vec3 *points, uint32_t count, const tl_hull_def *def, tl_hull **hull_out,
                              tl_hull_report *report_out);

/// A copy of a hull, scaled along its own axes, then turned and moved: p becomes rotation(scale * p) + position. A
/// negative scale mirrors.
///
/// The copy is the hull of the mapped corners, each coordinate rounded once; it is a valid hull whatever the map. Faces
/// stay whole where the rounding keeps them flat (moves and scales of boxes, powers of two of anything), else they
/// become several. `sources` name the points of the first bake. To turn a body each frame, keep the hull and use
/// poses. O(V log V). Errors, `*hull_out` NULL: TL_ERR_COINCIDENT, TL_ERR_COLLINEAR, TL_ERR_COPLANAR (nothing solid is
/// left), TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_MEMORY, TL_ERR_CANCELLED. `host` and `report_out` may be NULL. Free
/// with tl_blob_free.
TL_API tl_result tl_hull_transform(const tl_hull *hull, tl_vec3 scale, tl_transform pose, const tl_host *host,
                                   tl_hull **hull_out, tl_hull_report *report_out);

/// The hull as an editable mesh: vertices and faces have the hull's indices. `mesh` is initialized; what it held is
/// removed. TL_ERR_MEMORY, TL_ERR_LIMIT: it is empty then. O(V), but for corners of many edges.
TL_API tl_result tl_hull_to_halfedge(const tl_hull *hull, tl_halfedge_mesh *mesh);

/// Whether bytes of unknown origin are a hull that every query can be trusted with: head, offsets, indices, loops,
/// twins, Euler's formula, finite values, and, exactly decided, that every face is flat and every edge convex. Safe on
/// any bytes; `bytes` must be 16-byte aligned. Planes, mass and inertia are computed again, and must be the same bits.
/// O(size). That the points of the input lie inside, and that the surface
/// does not wind around twice, which no bake does, takes tl_hull_validate.
/// Of a hull with a merge_distance, the exact hull of its vertices is built again, in memory of malloc and in the time
/// of a bake, and the rest derived from it and compared; TL_ERR_MEMORY.
/// A failure names the head's field, or the half-edge, face, vertex or cell, in `report_out`, which may be NULL.
TL_API tl_result tl_hull_check(const void *bytes, uint64_t size, tl_report *report_out);

/// What tl_hull_validate found.
typedef struct tl_hull_validation {
    tl_report base;     ///< names the first face that is not flat or not convex, else the first point outside
    bool euler;         ///< V - E + F = 2
    bool flat_faces;    ///< each face's vertices lie exactly in one plane, or within the hull's merge_distance
    bool convex;        ///< every edge of the exact hull is strictly convex, exactly decided; so the whole surface is
    bool contains;      ///< no point lies outside any face, exactly decided
    double max_outside; ///< metres; largest distance of a point in front of a face's plane, 0 when contained
} tl_hull_validation;

/// Proves a checked hull's geometry exactly, and that it contains `count` points (which may be 0).
/// TL_OK when all holds, else TL_ERR_CORRUPT (topology, convexity) or TL_ERR_RANGE (a point outside).
/// O((V + count) * F): meant for tests and tools. `validation_out` may be NULL. A hull with a merge_distance is judged
/// by the exact hull of its vertices, in memory of malloc; TL_ERR_MEMORY.
TL_API tl_result tl_hull_validate(const tl_hull *hull, const tl_vec3 *points, uint32_t count,
                                  tl_hull_validation *validation_out);

/// The vertex farthest along a direction: no vertex of the hull has a larger dot product with it, in exact arithmetic;
/// of several farthest, the lowest index. The direction need not be normalized; zero gives vertex 0. It must be finite.
///
/// `hint` is a vertex to try first, best the answer to a nearby direction, or TL_NO_VERTEX; it changes the time only,
/// and may be any number. Thread safe. Scans a small hull; climbs on a large one from a table of directions.
/// Sources: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013; Dobkin and
/// Kirkpatrick, A Linear Algorithm for Determining the Separation of Convex Polyhedra, 1985.
TL_API uint32_t tl_hull_support(const tl_hull *hull, tl_vec3 direction, uint32_t hint);

/// Where a ray meets a hull.
typedef struct tl_hull_hit {
    float t;        ///< in units of the direction's length; 0 when the origin is inside
    uint32_t face;  ///< the face it enters by, TL_NO_VERTEX when the origin is inside
    tl_vec3 normal; ///< unit, of that face; zero when the origin is inside
} tl_hull_hit;

/// Whether the ray from `origin` along `direction` (any length, not zero) enters the solid hull at t in [0, max_t].
/// `hit_out` may be NULL. Thread safe. O(F).
TL_API bool tl_hull_cast_ray(const tl_hull *hull, tl_vec3 origin, tl_vec3 direction, float max_t, tl_hull_hit *hit_out);

/// The same in double, for a ray that was brought into the hull's frame: `t_out` and `face_out` as in tl_hull_hit, set
/// only when it hits. max_t may be INFINITY.
TL_API bool tl_hull_clip_ray(const tl_hull *hull, const double origin[3], const double direction[3], double max_t,
                             double *t_out, uint32_t *face_out);

/// Whether a point lies in the closed hull, exactly decided; where faces are merged, behind all of their planes. O(F).
TL_API bool tl_hull_contains(const tl_hull *hull, tl_vec3 point);

/// V positions.
static inline const tl_vec3 *tl_hull_vertices(const tl_hull *hull)
{
    return (const tl_vec3 *)(const void *)((const char *)hull + hull->vertices);
}

/// V indices into the points that the hull was baked from. A thickened hull names a point more than once.
static inline const uint32_t *tl_hull_sources(const tl_hull *hull)
{
    return (const uint32_t *)(const void *)((const char *)hull + hull->sources);
}

/// For each vertex one half-edge that starts there. The others follow by `half_edges[twin].next`.
static inline const uint32_t *tl_hull_vertex_edges(const tl_hull *hull)
{
    return (const uint32_t *)(const void *)((const char *)hull + hull->vertex_edges);
}

/// 2 E half-edges, those of a face one after the other.
static inline const tl_hull_half_edge *tl_hull_half_edges(const tl_hull *hull)
{
    return (const tl_hull_half_edge *)(const void *)((const char *)hull + hull->half_edges);
}

/// F faces.
static inline const tl_hull_face *tl_hull_faces(const tl_hull *hull)
{
    return (const tl_hull_face *)(const void *)((const char *)hull + hull->faces);
}

/// Blocks of eight planes for so many faces.
static inline uint32_t tl_hull_plane_block_count(uint32_t face_count)
{
    return face_count / 8 + (face_count % 8 != 0);
}

/// The planes of all faces, in blocks of eight.
static inline const tl_hull_plane_block *tl_hull_plane_blocks(const tl_hull *hull)
{
    return (const tl_hull_plane_block *)(const void *)((const char *)hull + hull->planes);
}

/// The outward plane of a face.
static inline tl_hull_plane tl_hull_face_plane(const tl_hull *hull, uint32_t face)
{
    const tl_hull_plane_block *block = &tl_hull_plane_blocks(hull)[face / 8];
    uint32_t lane = face % 8;
    tl_hull_plane plane = { { block->x[lane], block->y[lane], block->z[lane] }, block->offset[lane] };
    return plane;
}

#ifdef __cplusplus
}
#endif

#endif
