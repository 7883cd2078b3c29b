// SPDX-License-Identifier: MIT
//
// Convex polygon generation: from contours on an integer lattice to one mesh of convex polygons with neighbours.
//
// Works alone, on any contours. x and z span the plane, y is height. All decisions are exact, in integers.
// Source: "Convex Polygon Generation", Critterai Navigation Mesh Generation documentation, stage four.

#ifndef TALUS_POLYGON_H
#define TALUS_POLYGON_H

#include <talus/base.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_NO_POLYGON UINT32_MAX

/// Across a tile's border edge: TL_PORTAL | side, side 0 x-, 1 z+, 2 x+, 3 z-.
#define TL_PORTAL 0xfffffff0u

/// Contour coordinates must lie within +-TL_MAX_CONTOUR_COORDINATE, so that doubled areas and comparisons of
/// squared lengths fit 64 bits.
#define TL_MAX_CONTOUR_COORDINATE (1 << 29)

/// A contour with more crossings of its edges than this is a scribble, and refused: TL_CONTOUR_FAULT_REFUSED. Crossings
/// of those below it take some 4 us and 700 bytes each.
#define TL_MAX_CONTOUR_CROSSINGS (1 << 20)

/// Flags of a contour vertex, beside the neighbour region in the low 16 bits.
#define TL_CONTOUR_REGION_MASK   0xffffu
#define TL_CONTOUR_BORDER_VERTEX 0x10000u ///< on a tile's border, where two regions meet; removed after merging
#define TL_CONTOUR_AREA_BORDER   0x20000u ///< the edge that starts here separates two areas

typedef struct tl_contour_vertex {
    int32_t x, y, z; ///< lattice units: cells on x and z, cell heights on y
    uint32_t flags;
} tl_contour_vertex;

/// One closed outline: a range of the set's vertices. An outer contour runs so that every convex corner has
/// (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z) < 0. Holes are already bridged into their outer contour.
typedef struct tl_contour {
    uint32_t first_vertex;
    uint32_t vertex_count;
    uint32_t region;
    uint32_t area;
} tl_contour;

/// A set of contours on one lattice. A view: it owns nothing.
typedef struct tl_contour_set {
    const tl_contour_vertex *vertices;
    uint32_t vertex_count;
    const tl_contour *contours;
    uint32_t contour_count;
    tl_aabb bounds;    ///< metres; bounds.min is the lattice's origin
    float cell_size;   ///< metres a lattice unit on x and z, > 0
    float cell_height; ///< metres a lattice unit on y, > 0
    int32_t width;     ///< lattice cells along x, without the border
    int32_t height;    ///< lattice cells along z, without the border
    int32_t
        border_size; ///< cells of border that were cut off on each side of a tile; > 0 makes portals on the outer edges
    float max_error; ///< bound of the simplification, lattice units; for information only
} tl_contour_set;

/// Why a contour was not divided as given. Bits; several may be set.
#define TL_CONTOUR_FAULT_EMPTY     0x01u ///< no area: nothing to divide
#define TL_CONTOUR_FAULT_DUPLICATE 0x02u ///< consecutive vertices of equal x and z; one was dropped
#define TL_CONTOUR_FAULT_SPIKE     0x04u ///< runs there and back and encloses nothing; that run was dropped
#define TL_CONTOUR_FAULT_TOUCH     0x08u ///< a vertex lies inside another edge; the edge was split there
#define TL_CONTOUR_FAULT_CROSSING  0x10u ///< two edges cross; both were split at the nearest lattice point
#define TL_CONTOUR_FAULT_WINDING                                                                                       \
    0x20u ///< winds around floor more than once (which is covered once) or backwards (which is not)
#define TL_CONTOUR_FAULT_PINCH                                                                                         \
    0x40u ///< meets itself in a vertex, so that its interior is not connected; divided part by part
#define TL_CONTOUR_FAULT_REFUSED 0x80u ///< over TL_MAX_CONTOUR_CROSSINGS crossings; nothing of it is in the mesh

/// A contour that was not divided as given. Bridges to holes are no fault.
typedef struct tl_contour_note {
    uint32_t contour;      ///< index in the set
    uint32_t faults;       ///< TL_CONTOUR_FAULT_ bits
    uint32_t vertex;       ///< in the contour: where the first fault was found
    uint32_t reserved;     ///< 0
    int64_t contour_area2; ///< doubled area that it encloses, signed: > 0 for an outer contour. Modulo 2^64, which only
                           ///< outlines reach that wind around the largest lattice four times
    int64_t covered_area2; ///< doubled area of its polygons
} tl_contour_note;

/// A mesh of convex polygons on the contours' lattice. Vertices are shared; an edge is shared by at most two polygons.
/// Polygon p has the corners indices[first[p]] .. indices[first[p + 1] - 1], in the contours' winding;
/// neighbours[k] lies across the edge from corner k to the polygon's next corner.
typedef struct tl_polygon_mesh {
    uint32_t vertex_count;
    uint32_t polygon_count;
    uint32_t index_count;
    int32_t *vertices;    ///< [3 * vertex_count] x, y, z in lattice units
    uint32_t *first;      ///< [polygon_count + 1]
    uint32_t *indices;    ///< [index_count]
    uint32_t *neighbours; ///< [index_count] a polygon, TL_NO_POLYGON or TL_PORTAL | side
    uint32_t *regions;    ///< [polygon_count] of the contour it came from
    uint32_t *areas;      ///< [polygon_count] of the contour it came from
    uint32_t *contours;   ///< [polygon_count] the contour it came from
    tl_aabb bounds;       ///< as in the contour set
    float cell_size, cell_height;
    uint32_t max_verts_per_poly;
    uint32_t note_count;
    tl_contour_note *notes; ///< [note_count] contours that were not divided as given, by rising index
    tl_allocator allocator; ///< private, as all below: one block holds all arrays
    void *block;
    size_t block_size;
} tl_polygon_mesh;

/// regions[p] and contours[p] of a polygon that covers parts of several contours. It exists only where a border vertex
/// between two contours was removed, and with merge_contours, where regions[p] is kept.
#define TL_SEVERAL_REGIONS  0u
#define TL_SEVERAL_CONTOURS UINT32_MAX

/// How a contour is divided.
typedef enum tl_partition_method {
    TL_PARTITION_CLASSIC,  ///< shortest partition edge first, then merging across the longest shared edge first
    TL_PARTITION_OPTIMAL,  ///< the fewest polygons (Keil, Snoeyink). Exact for every contour of up to 128 vertices
                           ///< without holes, and for most larger ones; else the best of several methods
    TL_PARTITION_DELAUNAY, ///< constrained Delaunay triangulation, then merged as by the classic method: well-shaped
                           ///< polygons
} tl_partition_method;

/// What a step of dividing a contour does.
typedef enum tl_polygon_step_kind {
    TL_POLYGON_STEP_CUT,   ///< the shortest potential partition cuts a triangle off what is left of the outline
    TL_POLYGON_STEP_MERGE, ///< two polygons become one across the longest shared edge
} tl_polygon_step_kind;

/// One step, as the figures of Critterai's documentation show it. Points are pairs of x and z, in lattice units.
typedef struct tl_polygon_step {
    tl_polygon_step_kind kind;
    uint32_t contour; ///< in the set
    uint32_t partition_count;
    const int32_t *partitions; ///< [4 * partition_count] both ends of each, the chosen one first. Of a cut: all
                               ///< potential partitions, none for the last triangle. Of a merge: all edges across
                               ///< which two polygons could be merged, each once
    uint32_t outline_count;
    const int32_t *outline; ///< [2 * outline_count] of a cut: what was left of the outline before it; else none
    uint32_t corner_count;
    const int32_t *corners; ///< [2 * corner_count] the triangle that was cut off, or the merged polygon
} tl_polygon_step;

/// Is called with every step, on the caller's thread. The step's arrays are valid during the call only.
typedef struct tl_polygon_trace {
    void (*step)(const tl_polygon_step *step, void *user);
    void *user;
} tl_polygon_trace;

/// How to divide contours. Begin with tl_default_polygon_def().
typedef struct tl_polygon_def {
    uint32_t max_verts_per_poly; ///< [3, 64], or 0: unlimited. Default 6
    tl_partition_method method;  ///< Default TL_PARTITION_CLASSIC
    uint32_t merge_height;     ///< lattice units: vertices of equal x and z at most this far apart on y become one, the
                               ///< nearest one. 0: equal vertices only, which is enough where both regions take a
                               ///< corner's height from the same floors. Default 2, as Recast
    bool keep_border_vertices; ///< true: vertices flagged TL_CONTOUR_BORDER_VERTEX stay. Default false
    bool drop_straight_vertices; ///< true: vertices in straight runs go where no other vertex is at the same x and z,
                                 ///< before the contour is divided, unless it needs a repair. Fewer polygons; default
                                 ///< false
    bool merge_contours; ///< true: polygons of different contours of one region and area are merged as well. Default
                         ///< false
    const tl_polygon_trace *trace; ///< NULL: none, and no cost. Follows the classic method, cuts and then merges of
                                   ///< each outline, O(n^2); of the other methods what they share with it: the cuts,
                                   ///< and Delaunay's merges
    tl_host host;
    uint32_t cookie; ///< TL_DEF_COOKIE, by tl_default_polygon_def
} tl_polygon_def;

/// The counts of one bake.
typedef struct tl_polygon_report {
    tl_report base;
    uint32_t contour_count;             ///< contours given
    uint32_t empty_contours;            ///< without area: fewer than three vertices, or all on one line
    uint32_t repaired_contours;         ///< divided after a repair; named in the mesh's notes
    uint32_t refused_contours;          ///< left out; named in the mesh's notes
    uint32_t triangle_count;            ///< before merging
    uint32_t lower_bound;               ///< fewest polygons that the contours, each by itself and divided along chords
                                        ///< between its corners, could take: exact where TL_PARTITION_OPTIMAL is
    uint32_t polygon_count;             ///< in the end
    uint32_t vertex_count;              ///< in the end
    uint32_t removed_straight_vertices; ///< by drop_straight_vertices
    uint32_t contour_merges;            ///< by merge_contours: so many polygons fewer
    uint32_t removed_border_vertices;   ///< border vertices removed
    uint32_t kept_border_vertices;      ///< border vertices whose removal would have changed the floor's outline
    uint32_t link_count;                ///< edges between two polygons
    uint32_t portal_count;              ///< edges on a tile's border
    uint32_t non_manifold_edges; ///< edges along which more than one polygon runs in one direction; of both directions
                                 ///< the first are linked, then the second, as far as there are
    int64_t uncovered_area2;     ///< doubled area of all contours, less that of the polygons; 0 without repairs
} tl_polygon_report;

TL_API tl_polygon_def tl_default_polygon_def(void);

/// Divides contours into convex polygons and links them.
///
/// By TL_PARTITION_CLASSIC each contour is triangulated on its xz projection by repeatedly cutting off the valid corner
/// whose new edge is shortest (ties: the lowest vertex before the corner), then triangles and polygons of one contour
/// are merged across the longest shared edge while they stay strictly convex and within max_verts_per_poly. Ties in
/// merging: the lowest pair of places, where triangles take places in the order they were cut, a merged polygon keeps
/// the lower place of its two parts and the last polygon moves into the free one. Border vertices are removed after
/// that.
///
/// Guaranteed for every result: polygons strictly convex, wound as the contours, without doubled corners, disjoint
/// within their contour and without T-junctions there, together exactly the contour's floor; neighbours symmetric.
/// A contour that touches or crosses itself is cut into the parts that it winds around at least once; where it crosses
/// itself between lattice points the crossing is rounded to the lattice. Each such contour has a note in the mesh.
///
/// `contours` has valid ranges and coordinates within +-TL_MAX_CONTOUR_COORDINATE; else TL_ERR_INDEX or TL_ERR_RANGE,
/// with the contour named. Contours without area are legal and counted. On failure `mesh_out` is
/// zeroed; free it with tl_polygon_mesh_free. `def` NULL: defaults. `report_out` may be NULL. Thread safe. Near-linear
/// for outlines that do not cross themselves: O(n log n) with n vertices, for all but contrived ones. Errors:
/// TL_ERR_ARGUMENT, TL_ERR_INDEX, TL_ERR_RANGE, TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_polygon_mesh_bake(const tl_contour_set *contours, const tl_polygon_def *def,
                                      tl_polygon_mesh *mesh_out, tl_polygon_report *report_out);

/// Frees the mesh and zeroes it. NULL or zeroed: nothing happens.
TL_API void tl_polygon_mesh_free(tl_polygon_mesh *mesh);

/// A vertex in the world, metres.
static inline tl_vec3 tl_polygon_mesh_vertex(const tl_polygon_mesh *mesh, uint32_t vertex)
{
    const int32_t *v = mesh->vertices + 3 * (size_t)vertex;
    return tl_vec3_make(mesh->bounds.min.x + (float)v[0] * mesh->cell_size,
                        mesh->bounds.min.y + (float)v[1] * mesh->cell_height,
                        mesh->bounds.min.z + (float)v[2] * mesh->cell_size);
}

/// The shapes of a mesh's polygons on the xz plane.
typedef struct tl_polygon_quality {
    uint32_t polygon_count;
    uint32_t max_corners;
    double mean_corners;          ///< corners a polygon
    double smallest_angle_cosine; ///< of the sharpest corner: its cosine; -1 without polygons
    double mean_sharpest_cosine;  ///< of each polygon's sharpest corner, the mean of the cosines
    double mean_aspect;           ///< a polygon's extent along its longest edge by its extent across it, or the inverse
                                  ///< where that is larger; the mean
    double worst_aspect;          ///< the largest
} tl_polygon_quality;

/// Measures the polygons of a valid mesh (tl_polygon_mesh_check). O(corners).
TL_API tl_polygon_quality tl_polygon_mesh_measure(const tl_polygon_mesh *mesh);

/// What can be wrong with a polygon mesh.
typedef enum tl_polygon_fault {
    TL_POLYGON_FAULT_RANGE,      ///< first[], an index or a neighbour points outside its array
    TL_POLYGON_FAULT_CORNERS,    ///< fewer than three corners, or more than max_verts_per_poly
    TL_POLYGON_FAULT_REPEATED,   ///< a corner twice in one polygon
    TL_POLYGON_FAULT_INVERTED,   ///< wound against the contours, or without area
    TL_POLYGON_FAULT_NOT_CONVEX, ///< a corner of 180 degrees or more, or winding around more than once
    TL_POLYGON_FAULT_OVERLAP,    ///< two polygons overlap, of one contour; of several contours: also in height
    TL_POLYGON_FAULT_T_JUNCTION, ///< a vertex of the contour inside an edge of one of its polygons
    TL_POLYGON_FAULT_LINK,       ///< a neighbour without the edge or without a link back, or a missing link
    TL_POLYGON_FAULT_PORTAL,     ///< a portal whose edge is not on that side of the tile (needs the contours)
    TL_POLYGON_FAULT_AREA,       ///< area differs from the contour's and from what its note says (needs the contours)
    TL_POLYGON_FAULT_OUTLINE,    ///< the polygons' common outline is not the contour's (needs the contours)
    TL_POLYGON_FAULT_COUNT
} tl_polygon_fault;

/// A phrase for a fault, lower case. Never NULL.
TL_API const char *tl_polygon_fault_text(tl_polygon_fault fault);

typedef struct tl_polygon_check_report {
    tl_report base;                          ///< element "polygon" or "contour" of the first fault
    tl_polygon_fault first_fault;            ///< meaningful when the result is not TL_OK
    uint64_t counts[TL_POLYGON_FAULT_COUNT]; ///< how many of each kind
} tl_polygon_check_report;

/// Proves a mesh valid, or names what is wrong: TL_OK, TL_ERR_CORRUPT for any fault, or TL_ERR_MEMORY.
/// With the contours it was built from (may be NULL) it also proves that they are covered exactly. Safe on any content
/// of the arrays; the arrays must be as long as the counts say. All in exact integers, by other ways than the build's.
/// O(n log n) for a valid mesh; overlaps of others are counted pair by pair, at worst all pairs of one contour's
/// polygons.
TL_API tl_result tl_polygon_mesh_check(const tl_polygon_mesh *mesh, const tl_contour_set *contours,
                                       const tl_allocator *allocator, tl_polygon_check_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
