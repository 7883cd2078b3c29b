// SPDX-License-Identifier: MIT
//
// Convex polygon generation: contours on an integer lattice in, one mesh of convex polygons with neighbours out.
//
// Usable alone, on any contours. x and z span the plane, y is height. All decisions are exact in integers.
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

/// Flags of a contour vertex, beside the neighbour region in the low 16 bits.
#define TL_CONTOUR_REGION_MASK   0xffffu
#define TL_CONTOUR_BORDER_VERTEX 0x10000u ///< lies on a tile's border between regions; removed after merging
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

/// A set of contours on one lattice. A plain view; builds that make one say who owns the arrays.
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
    float max_error; ///< the simplification's bound, lattice units; information only
} tl_contour_set;

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
    void *block; ///< one block holds all arrays
    size_t block_size;
} tl_polygon_mesh;

#ifdef __cplusplus
}
#endif

#endif
