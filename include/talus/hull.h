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
#define TL_HULL_VERSION 5u          ///< of the layout

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
    /// Metres, >= 0. 0: no point lies outside. Else the points are added farthest first, and the hull is done when none
    /// of the others lies farther outside than this: fewer corners, and sooner. Jolt's mHullTolerance, 1e-3 there by
    /// default.
    float tolerance;
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
    uint32_t points_left_out; ///< points outside, because max_vertices was reached or for the tolerance
    /// Metres, to double rounding: no point of the input lies farther outside of the hull. 0 where none was left out;
    /// at most tolerance + weld_distance + merge_distance, if max_vertices is 0.
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

/// For density 1. Computed in double about a point inside, so it is as good far from the origin. A body thinner than
/// double rounding of its length has volume and inertia 0, and the mean of its vertices as centre.
typedef struct tl_hull_mass {
    double volume;     ///< cubic metres, >= 0
    double area;       ///< of the surface, square metres
    double center[3];  ///< centre of mass, metres
    double inertia[6]; ///< about the centre of mass: xx, yy, zz, xy, xz, yz of the tensor (products carry their minus)
} tl_hull_mass;

/// The baked hull: a blob. Read it through the functions below: the layout of its parts is private. Vertices are in the
/// order of their points in the input, so "lowest vertex" is "earliest point". A box takes 640 bytes.
typedef struct tl_hull {
    tl_blob blob;             ///< the head; free the hull with tl_blob_free
    uint32_t vertex_count;    ///< V >= 4
    uint32_t face_count;      ///< F
    uint32_t half_edge_count; ///< 2 E; V - E + F = 2
    float scan_error;         ///< private: of a scan's dot products for a direction with |x| + |y| + |z| = 1
    uint8_t index_bytes;      ///< private: 1, 2 or 4, of a word of the topology
    uint8_t flags;            ///< private: bytes of a source, and TL_HULL_HAS_SIDES
    uint16_t vertices;        ///< private: bytes from the beginning to the vertices, a multiple of 4
    float merge_distance;     ///< metres; a face's corners lie within this of its plane. 0: exactly in it
    tl_aabb bounds;           ///< of the vertices, exact
    tl_hull_mass mass;        ///< for density 1
} tl_hull;

/// Private: the bytes of a source, 1, 2 or 4; 0: every vertex is the point of the same index.
#define TL_HULL_SOURCE_BYTES 7u
/// Two neighbouring faces lie in one plane, to the rounding of coordinates: a side may have several faces.
#define TL_HULL_HAS_SIDES 8u
/// Where corners lie in the plane of a face: no more below it than this share of the largest coordinate. A coordinate
/// is off by half an ulp in each component, and so are the three that the plane goes through; eight roundings cover a
/// plane whose points were rounded to floats, as in tl_hull_def.flatness.
#define TL_HULL_SIDE_GAP 4.76837158203125e-7

/// Private: hulls of more vertices than this have a tl_hull_climb.
#define TL_HULL_FEW 16u

/// Private: what the support query of a larger hull needs of its head, one cache line. `planes` and on are in units of
/// TL_BLOB_ALIGNMENT.
typedef struct tl_hull_climb {
    uint32_t table_side;  ///< cells along a side of the direction table's two squares, 0 when the hull is scanned
    tl_vec3 table_scale;  ///< what a direction is multiplied by before it is looked up
    uint32_t planes;      ///< of the faces
    uint32_t blocks;      ///< edge vectors and neighbours
    uint32_t table;       ///< [2 table_side^2 + ring_cells] a vertex to start from, or a ring to look in
    uint32_t rings;       ///< maps of large faces, then of caps
    uint32_t cell_bytes;  ///< 2 or 4, of a cell of the table
    uint32_t block_count; ///< V, and one for every seven neighbours of a vertex beyond eight
    uint32_t ring_count;  ///< large faces with a ring, and caps
    uint32_t ring_cells;  ///< of all rings
    uint32_t cap_count;   ///< caps: many small faces that lie nearly in one plane
    uint32_t unused[3];   ///< zero
} tl_hull_climb;

/// Private: where it lies.
#define TL_HULL_CLIMB_OFFSET 192u

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

/// Private: word `at` of the topology, which stands behind the vertices: of each half-edge origin, twin and face; the
/// first half-edge of each face, and 2 E; of each vertex a half-edge; from a multiple of four bytes on the sources.
static inline uint32_t tl_hull_word(const tl_hull *hull, size_t at)
{
    const char *words = (const char *)(tl_hull_vertices(hull) + hull->vertex_count);
    return hull->index_bytes == 1   ? ((const uint8_t *)words)[at]
           : hull->index_bytes == 2 ? ((const uint16_t *)(const void *)words)[at]
                                    : ((const uint32_t *)(const void *)words)[at];
}

/// Private: how many words.
static inline uint64_t tl_hull_word_count(const tl_hull *hull)
{
    return 3 * (uint64_t)hull->half_edge_count + hull->face_count + 1 + hull->vertex_count;
}

/// Index of a vertex among the points that the hull was baked from. A thickened hull names a point more than once.
static inline uint32_t tl_hull_source(const tl_hull *hull, uint32_t vertex)
{
    const size_t words = (size_t)(tl_hull_word_count(hull) * hull->index_bytes + 3) / 4 * 4;
    const char *sources = (const char *)(tl_hull_vertices(hull) + hull->vertex_count) + words;
    const uint32_t bytes = hull->flags & TL_HULL_SOURCE_BYTES;
    return bytes == 0   ? vertex
           : bytes == 1 ? ((const uint8_t *)sources)[vertex]
           : bytes == 2 ? ((const uint16_t *)(const void *)sources)[vertex]
                        : ((const uint32_t *)(const void *)sources)[vertex];
}

/// A half-edge that starts at a vertex. The others follow by tl_hull_edge_next of the twin.
static inline uint32_t tl_hull_vertex_edge(const tl_hull *hull, uint32_t vertex)
{
    return tl_hull_word(hull, 3 * (size_t)hull->half_edge_count + hull->face_count + 1 + vertex);
}

/// A face's first half-edge; that of face F would be 2 E.
static inline uint32_t tl_hull_face_first(const tl_hull *hull, uint32_t face)
{
    return tl_hull_word(hull, 3 * (size_t)hull->half_edge_count + face);
}

/// A face's half-edges.
static inline tl_hull_face tl_hull_face_at(const tl_hull *hull, uint32_t face)
{
    const uint32_t first = tl_hull_face_first(hull, face);
    const tl_hull_face result = { first, tl_hull_face_first(hull, face + 1) - first };
    return result;
}

/// The vertex that a half-edge starts at.
static inline uint32_t tl_hull_edge_origin(const tl_hull *hull, uint32_t half_edge)
{
    return tl_hull_word(hull, 3 * (size_t)half_edge);
}

/// The same edge in the other direction.
static inline uint32_t tl_hull_edge_twin(const tl_hull *hull, uint32_t half_edge)
{
    return tl_hull_word(hull, 3 * (size_t)half_edge + 1);
}

/// The face to a half-edge's left.
static inline uint32_t tl_hull_edge_face(const tl_hull *hull, uint32_t half_edge)
{
    return tl_hull_word(hull, 3 * (size_t)half_edge + 2);
}

/// The half-edge that follows in the loop of `face`, which it belongs to.
static inline uint32_t tl_hull_edge_next_in(const tl_hull *hull, uint32_t half_edge, uint32_t face)
{
    return half_edge + 1 < tl_hull_face_first(hull, face + 1) ? half_edge + 1 : tl_hull_face_first(hull, face);
}

/// The half-edge that follows in the face's loop, counter-clockwise.
static inline uint32_t tl_hull_edge_next(const tl_hull *hull, uint32_t half_edge)
{
    return tl_hull_edge_next_in(hull, half_edge, tl_hull_edge_face(hull, half_edge));
}

/// All of a half-edge.
static inline tl_hull_half_edge tl_hull_edge_at(const tl_hull *hull, uint32_t half_edge)
{
    const tl_hull_half_edge result = { tl_hull_edge_origin(hull, half_edge), tl_hull_edge_twin(hull, half_edge),
                                       tl_hull_edge_next(hull, half_edge), tl_hull_edge_face(hull, half_edge) };
    return result;
}

/// Lanes of a block of planes: 8, of a hull of up to six faces 4 or 6.
static inline uint32_t tl_hull_plane_lanes(const tl_hull *hull)
{
    return hull->face_count > 6 ? 8 : (hull->face_count + 1) / 2 * 2;
}

/// The planes of eight faces as queries read them, block f / 8 of face f: rows x, y, z and offset of so many lanes one
/// behind the other. Lanes beyond the last face are zero, planes that everything is on. From any row eight lanes can be
/// read; behind short rows those of the offsets are infinite, so that what is read too much is out of reach.
static inline const double *tl_hull_plane_block(const tl_hull *hull, uint32_t block)
{
    const char *bytes = (const char *)hull;
    const uint32_t climbed = TL_HULL_CLIMB_OFFSET;
    const size_t planes =
        hull->vertex_count <= 8 ? sizeof(tl_hull) + 3 * 8 * sizeof(float)
        : hull->vertex_count <= TL_HULL_FEW
            ? sizeof(tl_hull) + 3 * 16 * sizeof(float)
            : (size_t)((const tl_hull_climb *)(const void *)(bytes + climbed))->planes * TL_BLOB_ALIGNMENT;
    return (const double *)(const void *)(bytes + planes) + 32 * (size_t)block;
}

/// Blocks of planes.
static inline uint32_t tl_hull_plane_block_count(const tl_hull *hull)
{
    return hull->face_count / 8 + (hull->face_count % 8 != 0);
}

/// The outward plane of a face.
static inline tl_hull_plane tl_hull_face_plane(const tl_hull *hull, uint32_t face)
{
    const uint32_t lanes = tl_hull_plane_lanes(hull);
    const double *at = tl_hull_plane_block(hull, face / 8) + face % 8;
    const tl_hull_plane plane = { { at[0], at[lanes], at[2 * lanes] }, at[3 * lanes] };
    return plane;
}

#ifdef __cplusplus
}
#endif

#endif
