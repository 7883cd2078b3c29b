// SPDX-License-Identifier: MIT
//
// The tile of a navmesh: the immutable blob that nav_bake writes and nav_query reads. It has a header of its own
// because baking and querying never include each other.
//
// A tile has every polygon corner twice: as integers on the lattice, for exact decisions on seams and convexity, and as
// floats in metres, polygon by polygon, for queries. The floats are computed from the integers by one formula
// (tl_nav_tile_position), so that two tiles give a point of their common seam the same bits.
//
// What only bakes, checks and seams read is stored in as few bits as a tile needs: it is read by the functions below.

#ifndef TALUS_NAV_TILE_H
#define TALUS_NAV_TILE_H

#include <talus/base.h>
#include <talus/polygon.h>
#include <talus/vec.h>

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// Detail mesh, as tl_nav_bake_detail makes it.

/// The part of the detail mesh in one polygon.
typedef struct tl_nav_detail_patch {
    uint32_t first_vertex;
    uint32_t vertex_count; ///< the polygon's own corners first, then added ones
    uint32_t first_triangle;
    uint32_t triangle_count;
} tl_nav_detail_patch;

/// Corners are local to the patch. Bit k of edge_flags: the edge from corner k to k + 1 lies on the polygon's outline.
typedef struct tl_nav_detail_triangle {
    uint16_t corner[3];
    uint16_t edge_flags;
} tl_nav_detail_triangle;

/// Heights inside the polygons. One patch a polygon.
typedef struct tl_nav_detail {
    uint32_t patch_count;
    uint32_t vertex_count;
    uint32_t triangle_count;
    tl_nav_detail_patch *patches;
    tl_vec3 *vertices; ///< metres, in the world
    tl_nav_detail_triangle *triangles;
    float max_error;          ///< metres: largest vertical distance of an inner height sample from the surface
    uint32_t limited_patches; ///< patches with errors above the limit: they reached 65,535 vertices, or have an edge of
                              ///< more than 512 samples
    tl_allocator allocator;   ///< private, as all below: one block holds all arrays
    void *block;
    size_t block_size;
} tl_nav_detail;

TL_API void tl_nav_detail_free(tl_nav_detail *detail);

// ---------------------------------------------------------------------------------------------------------
// Limits, checked when a tile is baked and again when its bytes are.

#define TL_NAV_TILE_MAGIC        0x5456414eu ///< "NAVT"
#define TL_NAV_TILE_VERSION      4u
#define TL_NAV_MAX_CORNERS       64         ///< of one polygon
#define TL_NAV_MAX_TILE_POLYGONS (1u << 28) ///< so that a polygon's number fits a reference (nav_query.h)
#define TL_NAV_MAX_AREA          255        ///< areas are 1 to 255, 0 is not walkable
#define TL_NAV_MAX_TILES         (1u << 20) ///< of one navmesh, so that a slot fits a reference (nav_query.h)
#define TL_NAV_MAX_TILE_INDEX    (1 << 24)  ///< |tile_x| and |tile_z|
#define TL_NAV_MAX_LAYER         0xffffu    ///< of the tiles at one place
#define TL_NAV_MAX_TILE_DEPTH    40         ///< of the BVH: log2 of the polygons, with reserve
/// Metres, of cell_size and cell_height: the square of a cell's area is a normal float, and so is that of the rounding
/// of its side. Of smaller lengths squares would underflow, and distances be taken as equal.
#define TL_NAV_MIN_CELL 1e-9f

// ---------------------------------------------------------------------------------------------------------
// The layout. Offsets count 8 bytes from the start of the blob, in the order of the fields; all padding is zero. Read
// it through the functions below.

// tl_nav_tile.wide: which arrays have their wider elements. Each bit is set where a tile needs it, and only there.
#define TL_NAV_WIDE_TRIANGLES 1u ///< some patch has more than 256 vertices
#define TL_NAV_WIDE_LATTICE   2u ///< some lattice coordinate is no 16-bit number
#define TL_NAV_WIDE_CORNERS   4u ///< there are more than 65,536 lattice vertices
#define TL_NAV_WIDE_LINKS     8u ///< there are more than 32,768 polygons, or 32,767 portals
#define TL_NAV_WIDE_FLAGS     16u ///< some polygon's flags do not fit 8 bits. A tile whose flags were changed may keep it
#define TL_NAV_WIDE_FIRSTS    32u ///< more than 65,535 corners, detail vertices or detail triangles

// Values of links beside polygons: below zero as integers, so that those of 16 bits become these by their sign.
#define TL_NAV_LINK_WALL      UINT32_MAX ///< nothing lies across this edge
#define TL_NAV_LINK_PORTAL    0x80000000u ///< set beside it where other tiles' polygons may lie across: tl_nav_link_portal
#define TL_NAV_MAX_SHORT_LINK 0x7fffu     ///< the last polygon of 16 bits; portals end one before

/// The fifth side of a tile, after those towards x-, z+, x+ and z-: edges that were cut when a place was divided into
/// layers. Across them lies a polygon of another layer of the same place, with the same two vertices.
#define TL_NAV_SIDE_CUT   4u
#define TL_NAV_SIDE_COUNT 5u

/// An edge across which other tiles' polygons may lie: on the tile's border, or cut.
typedef struct tl_nav_portal {
    uint32_t polygon;
    uint32_t corner;        ///< index in the corner arrays where the edge starts
    int32_t low, high;      ///< lattice, low < high: its stretch along the side (z on sides 0 and 2, x on 1 and 3). Of
                            ///< a cut: the layer across, and what tells cuts with the same ends apart, 0 for the first
    uint32_t first_profile; ///< its heights between the ends, from low to high; they end where the next portal's begin.
                            ///< A cut has none: the two tiles have one edge
} tl_nav_portal;

/// A height of the surface along a portal, between its ends; straight from one to the next.
typedef struct tl_nav_profile_point {
    float along;  ///< lattice units along the side, in the tile
    float height; ///< metres
} tl_nav_profile_point;

#define TL_NAV_NODE_LEAF 0x80000000u ///< | polygon, in tl_nav_tile_node.link

/// A node of the BVH over polygons and their detail, depth first. An inner node's first child is the next node, its
/// second child is the node behind the first child's subtree (tl_nav_tile_node_skip). The box counts in steps from
/// bounds.min, outward (tl_nav_tile_node_box).
typedef struct tl_nav_tile_node {
    uint16_t min[3], max[3]; ///< x, y, z
    uint32_t link;           ///< of a leaf TL_NAV_NODE_LEAF | polygon, of others the node behind this subtree
} tl_nav_tile_node;

typedef struct tl_nav_tile {
    tl_blob blob;
    int32_t tile_x, tile_z; ///< place in the grid of tiles
    uint32_t tile_size;     ///< cells; 0: the only place is the whole navmesh
    uint32_t polygon_count;
    uint32_t vertex_count; ///< lattice vertices, shared
    uint32_t corner_count; ///< of all polygons
    uint32_t detail_vertex_count;
    uint32_t detail_triangle_count;
    uint32_t node_count;
    uint32_t portal_count;
    uint32_t profile_count;
    uint32_t layer;       ///< tells the tiles at one place apart; 0 where they are not divided
    uint32_t side_end[4]; ///< portals stand by side, and along it by low, then corner; cuts, behind side 3, by
                          ///< the layer across, then tl_nav_cut_compare. Read them through tl_nav_tile_side_first
    double area;          ///< square metres in the plane, of all polygons
    tl_vec3 origin;       ///< metres: lattice point (0, 0, 0) of tile (0, 0); the same in all tiles of a navmesh
    float cell_size;      ///< metres, >= TL_NAV_MIN_CELL
    float cell_height;    ///< metres, >= TL_NAV_MIN_CELL
    float agent_height, agent_radius, agent_max_climb; ///< metres
    tl_aabb bounds;                                    ///< metres, of the surface
    uint32_t wide;                                     ///< TL_NAV_WIDE_... bits
    uint32_t node_steps;                               ///< of the nodes' boxes: tl_nav_tile_node_steps
    uint32_t nodes;                                    ///< tl_nav_tile_node [node_count]
    uint32_t first_corner;                             ///< uint16_t or uint32_t [polygon_count + 1]
    uint32_t links;                                    ///< int16_t or int32_t [corner_count]: tl_nav_tile_link
    uint32_t corner_vertices;                          ///< uint16_t or uint32_t [corner_count]
    uint32_t vertices;                                 ///< uint16_t or int32_t [3 * vertex_count], lattice
    uint32_t flags;                                    ///< uint8_t or uint64_t [polygon_count]
    uint32_t areas;                                    ///< uint8_t [polygon_count]
    uint32_t detail_first_vertex;                      ///< uint16_t or uint32_t [polygon_count + 1]
    uint32_t detail_first_triangle;                    ///< uint16_t or uint32_t [polygon_count + 1]
    uint32_t detail_vertices;  ///< tl_vec3 [detail_vertex_count], metres: of each polygon its corners, then added ones
    uint32_t detail_triangles; ///< uint8_t or uint16_t [4 * detail_triangle_count]: corners, then edge_flags
    uint32_t portals;          ///< tl_nav_portal [portal_count]
    uint32_t profile;          ///< tl_nav_profile_point [profile_count]
    uint32_t zero;             ///< 0
} tl_nav_tile;

// ---------------------------------------------------------------------------------------------------------
// Encoding and checking.

/// An edge of a polygon that was cut: across it lies a polygon of another layer.
typedef struct tl_nav_cut {
    uint32_t corner;  ///< index in the mesh's corner arrays where the edge starts; a wall there (TL_NO_POLYGON)
    uint32_t layer;   ///< across
    uint32_t ordinal; ///< among cuts with the same two ends, which only floors that lie upon each other have: 0, 1, ...
} tl_nav_cut;

/// What a tile is encoded from. Nothing is kept or owned.
typedef struct tl_nav_tile_source {
    /// Convex polygons with area, in the contours' winding, 3 to 64 corners each, areas 1 to 255. Its bounds, cell_size
    /// and cell_height place the lattice. A portal edge that does not lie on its side of the tile (x or z = 0 or
    /// tile_size) is a wall.
    const tl_polygon_mesh *polygons;
    /// One patch a polygon, or NULL: the polygons are their own surface. The first vertices of a patch are the
    /// polygon's corners, whatever the detail says of them, as in Detour: so no gap opens between the two.
    const tl_nav_detail *detail;
    int32_t tile_x, tile_z; ///< |.| <= TL_NAV_MAX_TILE_INDEX
    uint32_t tile_size;     ///< cells of a whole tile without its border; 0: the only tile, at (0, 0)
    /// Metres: where lattice point (0, 0, 0) of tile (0, 0) lies. The same bits for all tiles of a navmesh. It must
    /// agree with polygons->bounds.min to a quarter of a cell; with one tile it is polygons->bounds.min.
    tl_vec3 origin;
    float agent_height;     ///< metres, > 0
    float agent_radius;     ///< metres, >= 0
    float agent_max_climb;  ///< metres, >= 0: tiles are linked where their seams differ by no more
    const uint64_t *flags;  ///< one a polygon, or NULL: all 1
    uint32_t layer;         ///< <= TL_NAV_MAX_LAYER; 0 where the place is not divided
    const tl_nav_cut *cuts; ///< by rising corner
    uint32_t cut_count;
} tl_nav_tile_source;

/// Lays out one tile. The same source gives the same bytes on every machine.
///
/// `*tile_out` is freed with tl_blob_free(tile). On failure it is NULL, and the report (which may be NULL)
/// names the element. Errors: TL_ERR_EMPTY (no polygon), TL_ERR_ARGUMENT (a setting, an area, a cut), TL_ERR_INDEX,
/// TL_ERR_RANGE (a vertex), TL_ERR_NOT_FINITE, TL_ERR_DEGENERATE and TL_ERR_WINDING (a polygon without area, or not
/// convex, or wound the wrong way), TL_ERR_NON_MANIFOLD (a neighbour that does not point back), TL_ERR_LIMIT,
/// TL_ERR_MEMORY. O(n log n).
TL_API tl_result tl_nav_tile_encode(const tl_nav_tile_source *source, const tl_allocator *allocator,
                                    tl_nav_tile **tile_out, tl_report *report_out);

/// Encodes a tile of some polygons of another: those with keep[p] != 0, in the same order. Links to the others become
/// walls; cuts stay. All of them give the same bytes again. TL_ERR_EMPTY: none is kept; else as tl_nav_tile_encode.
/// `tile` must be valid (tl_nav_tile_check).
TL_API tl_result tl_nav_tile_subset(const tl_nav_tile *tile, const uint8_t *keep, const tl_allocator *allocator,
                                    tl_nav_tile **tile_out, tl_report *report_out);

/// The tiles of one place, by rising layer.
typedef struct tl_nav_tile_stack {
    tl_nav_tile **tiles;
    uint32_t count;
    tl_allocator allocator; ///< private: what gives the memory back
} tl_nav_tile_stack;

TL_API void tl_nav_tile_stack_free(tl_nav_tile_stack *stack);

/// Divides a tile into layers, which are tiles: polygon p goes into layer layers[p], and the order of polygons stays.
/// An edge between two layers becomes a cut in both, so that in a navmesh the links are the same. When all polygons go
/// into layer 0, its tile has the bytes of the whole.
///
/// Errors: TL_ERR_ARGUMENT (the tile is a layer already: it has cuts, or a number of its own; a number above
/// TL_NAV_MAX_LAYER), TL_ERR_LIMIT, TL_ERR_MEMORY; then `*stack_out` is zeroed. `tile` must be valid, and does not
/// change. O(polygons * layers).
TL_API tl_result tl_nav_tile_divide(const tl_nav_tile *tile, const uint32_t *layers, const tl_allocator *allocator,
                                    tl_nav_tile_stack *stack_out, tl_report *report_out);

/// Whether bytes are a valid tile, on which every query is safe. Safe on any bytes.
///
/// `bytes` must be 8-byte aligned (TL_ERR_ARGUMENT). TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION; TL_ERR_CORRUPT for
/// all else, with the element in the report (which may be NULL). O(n).
TL_API tl_result tl_nav_tile_check(const void *bytes, uint64_t size, tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// Reading a tile. `polygon` < polygon_count and `edge` < its corner count; nothing is checked here.

static inline const void *tl_nav_tile_at(const tl_nav_tile *tile, uint32_t offset)
{
    return (const char *)tile + 8 * (uint64_t)offset;
}

/// The same of a tile that its owner writes to.
static inline void *tl_nav_tile_to_write(tl_nav_tile *tile, uint32_t offset)
{
    return (char *)tile + 8 * (uint64_t)offset;
}

/// Metres of a lattice coordinate: the one formula by which all tiles place their corners.
/// `tile_index` * `tile_size` is the tile's own offset in the lattice; 0 for y.
static inline float tl_nav_tile_position(float origin, int32_t tile_index, uint32_t tile_size, int32_t lattice,
                                         float cell)
{
    // The sum is below 2^57 and usually below 2^53, where it is exact; the product and sum are rounded once each.
    int64_t steps = (int64_t)tile_index * (int64_t)tile_size + lattice;
    return (float)((double)origin + (double)steps * (double)cell);
}

/// A number of first_corner, detail_first_vertex or detail_first_triangle. `polygon` <= polygon_count.
static inline uint32_t tl_nav_tile_first(const tl_nav_tile *tile, uint32_t array, uint32_t polygon)
{
    const void *first = tl_nav_tile_at(tile, array);
    return (tile->wide & TL_NAV_WIDE_FIRSTS) != 0 ? ((const uint32_t *)first)[polygon]
                                                  : ((const uint16_t *)first)[polygon];
}

/// Where a polygon's corners begin, in the arrays of corners.
static inline uint32_t tl_nav_tile_first_corner(const tl_nav_tile *tile, uint32_t polygon)
{
    return tl_nav_tile_first(tile, tile->first_corner, polygon);
}

/// The corner behind another one of a polygon.
static inline uint32_t tl_nav_tile_next_corner(const tl_nav_tile *tile, uint32_t polygon, uint32_t corner)
{
    return corner + 1 < tl_nav_tile_first_corner(tile, polygon + 1) ? corner + 1
                                                                    : tl_nav_tile_first_corner(tile, polygon);
}

/// A polygon's part of an array: from `begin` up to `end`.
typedef struct tl_nav_tile_part {
    uint32_t begin, end;
} tl_nav_tile_part;

/// The part that a number of first_corner, detail_first_vertex or detail_first_triangle begins.
static inline tl_nav_tile_part tl_nav_tile_part_of(const tl_nav_tile *tile, uint32_t array, uint32_t polygon)
{
    const void *first = tl_nav_tile_at(tile, array);
    tl_nav_tile_part part;
    if ((tile->wide & TL_NAV_WIDE_FIRSTS) != 0) {
        part.begin = ((const uint32_t *)first)[polygon];
        part.end = ((const uint32_t *)first)[polygon + 1];
    } else {
        part.begin = ((const uint16_t *)first)[polygon];
        part.end = ((const uint16_t *)first)[polygon + 1];
    }
    return part;
}

/// The polygon's corners in metres, in the contours' winding (counter-clockwise seen from above, y up).
static inline const tl_vec3 *tl_nav_tile_corners(const tl_nav_tile *tile, uint32_t polygon, uint32_t *count_out)
{
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, polygon);
    *count_out = corners.end - corners.begin;
    return (const tl_vec3 *)tl_nav_tile_at(tile, tile->detail_vertices) +
           tl_nav_tile_first(tile, tile->detail_first_vertex, polygon);
}

/// The first portal of a side; those of side s end where those of s + 1 begin. `side` <= TL_NAV_SIDE_COUNT.
static inline uint32_t tl_nav_tile_side_first(const tl_nav_tile *tile, uint32_t side)
{
    return side == 0 ? 0 : side <= TL_NAV_SIDE_CUT ? tile->side_end[side - 1] : tile->portal_count;
}

/// The side that a portal is on.
static inline uint32_t tl_nav_tile_side_of(const tl_nav_tile *tile, uint32_t portal)
{
    uint32_t side = 0;
    while (side < TL_NAV_SIDE_CUT && portal >= tile->side_end[side]) {
        side++;
    }
    return side;
}

/// What lies across the edge from a corner, < corner_count, to the next one: a polygon of this tile, TL_NAV_LINK_WALL,
/// or a portal.
static inline uint32_t tl_nav_tile_link(const tl_nav_tile *tile, uint32_t corner)
{
    const void *links = tl_nav_tile_at(tile, tile->links);
    return (tile->wide & TL_NAV_WIDE_LINKS) != 0 ? (uint32_t)((const int32_t *)links)[corner]
                                                 : (uint32_t)(int32_t)((const int16_t *)links)[corner];
}

/// The same across a polygon's edge.
static inline uint32_t tl_nav_tile_edge_link(const tl_nav_tile *tile, uint32_t polygon, uint32_t edge)
{
    return tl_nav_tile_link(tile, tl_nav_tile_first_corner(tile, polygon) + edge);
}

static inline bool tl_nav_is_portal(uint32_t link)
{
    return (link & TL_NAV_LINK_PORTAL) != 0 && link != TL_NAV_LINK_WALL;
}

/// The index of the portal that a link names, and the link that names a portal.
static inline uint32_t tl_nav_link_portal(uint32_t link)
{
    return TL_NAV_LINK_WALL - 1 - link;
}

static inline const tl_nav_portal *tl_nav_tile_portals(const tl_nav_tile *tile)
{
    return (const tl_nav_portal *)tl_nav_tile_at(tile, tile->portals);
}

/// The heights along a portal between its ends, from low to high.
static inline const tl_nav_profile_point *tl_nav_tile_profile(const tl_nav_tile *tile, uint32_t portal,
                                                              uint32_t *count_out)
{
    const tl_nav_portal *at = tl_nav_tile_portals(tile) + portal;
    *count_out = (portal + 1 < tile->portal_count ? at[1].first_profile : tile->profile_count) - at[0].first_profile;
    return (const tl_nav_profile_point *)tl_nav_tile_at(tile, tile->profile) + at[0].first_profile;
}

static inline uint8_t tl_nav_tile_area(const tl_nav_tile *tile, uint32_t polygon)
{
    return ((const uint8_t *)tl_nav_tile_at(tile, tile->areas))[polygon];
}

static inline uint64_t tl_nav_tile_flags(const tl_nav_tile *tile, uint32_t polygon)
{
    const void *flags = tl_nav_tile_at(tile, tile->flags);
    return (tile->wide & TL_NAV_WIDE_FLAGS) != 0 ? ((const uint64_t *)flags)[polygon]
                                                 : ((const uint8_t *)flags)[polygon];
}

static inline const tl_nav_tile_node *tl_nav_tile_nodes(const tl_nav_tile *tile)
{
    return (const tl_nav_tile_node *)tl_nav_tile_at(tile, tile->nodes);
}

/// The node behind a node's subtree. `node` < node_count.
static inline uint32_t tl_nav_tile_node_skip(const tl_nav_tile_node *nodes, uint32_t node)
{
    return (nodes[node].link & TL_NAV_NODE_LEAF) != 0 ? node + 1 : nodes[node].link;
}

/// Metres of a step of the nodes' boxes along x, y and z: powers of two, whose exponents, biased as a float has them,
/// stand in node_steps, x in the lowest 8 bits. 0: a flat side, without steps.
static inline tl_vec3 tl_nav_tile_node_steps(const tl_nav_tile *tile)
{
    tl_vec3 steps;
    const uint32_t bits[3] = { (tile->node_steps & 0xffu) << 23, (tile->node_steps >> 8 & 0xffu) << 23,
                               (tile->node_steps >> 16 & 0xffu) << 23 };
    memcpy(&steps, bits, sizeof steps);
    return steps;
}

/// A box that holds what lies below a node, metres.
static inline tl_aabb tl_nav_tile_node_box(const tl_nav_tile *tile, const tl_nav_tile_node *node)
{
    const tl_vec3 base = tile->bounds.min;
    const tl_vec3 step = tl_nav_tile_node_steps(tile);
    tl_aabb box;
    box.min = tl_vec3_make(base.x + (float)node->min[0] * step.x, base.y + (float)node->min[1] * step.y,
                           base.z + (float)node->min[2] * step.z);
    box.max = tl_vec3_make(base.x + (float)node->max[0] * step.x, base.y + (float)node->max[1] * step.y,
                           base.z + (float)node->max[2] * step.z);
    return box;
}

/// A polygon's surface: the triangles index `vertices`, whose first ones are the polygon's corners.
typedef struct tl_nav_surface {
    const tl_vec3 *vertices;
    uint32_t vertex_count;
    uint32_t triangle_count;
    const void *triangles; ///< read by tl_nav_surface_triangle: four numbers each
    bool is_wide;          ///< of 16 bits, not of 8
} tl_nav_surface;

static inline tl_nav_surface tl_nav_tile_surface(const tl_nav_tile *tile, uint32_t polygon)
{
    const tl_nav_tile_part vertices = tl_nav_tile_part_of(tile, tile->detail_first_vertex, polygon);
    const tl_nav_tile_part triangles = tl_nav_tile_part_of(tile, tile->detail_first_triangle, polygon);
    tl_nav_surface surface;
    surface.vertices = (const tl_vec3 *)tl_nav_tile_at(tile, tile->detail_vertices) + vertices.begin;
    surface.vertex_count = vertices.end - vertices.begin;
    surface.triangle_count = triangles.end - triangles.begin;
    surface.is_wide = (tile->wide & TL_NAV_WIDE_TRIANGLES) != 0;
    surface.triangles = (const char *)tl_nav_tile_at(tile, tile->detail_triangles) +
                        ((uint64_t)triangles.begin << (surface.is_wide ? 3 : 2));
    return surface;
}

/// `index` < triangle_count.
static inline tl_nav_detail_triangle tl_nav_surface_triangle(const tl_nav_surface *surface, uint32_t index)
{
    uint16_t numbers[4];
    for (size_t k = 0; k < 4; k++) {
        const size_t at = 4 * (size_t)index + k;
        numbers[k] =
            surface->is_wide ? ((const uint16_t *)surface->triangles)[at] : ((const uint8_t *)surface->triangles)[at];
    }
    tl_nav_detail_triangle triangle = { { numbers[0], numbers[1], numbers[2] }, numbers[3] };
    return triangle;
}

/// Exact coordinates in a tile: x, y, z in lattice units.
typedef struct tl_nav_lattice_point {
    int32_t at[3];
} tl_nav_lattice_point;

/// `vertex` < vertex_count.
static inline tl_nav_lattice_point tl_nav_tile_vertex(const tl_nav_tile *tile, uint32_t vertex)
{
    const void *vertices = tl_nav_tile_at(tile, tile->vertices);
    tl_nav_lattice_point point;
    for (size_t axis = 0; axis < 3; axis++) {
        point.at[axis] = (tile->wide & TL_NAV_WIDE_LATTICE) != 0
                             ? ((const int32_t *)vertices)[3 * (size_t)vertex + axis]
                             : (int32_t)((const uint16_t *)vertices)[3 * (size_t)vertex + axis];
    }
    return point;
}

/// The lattice vertex of a corner. `corner` < corner_count: an index in the corner arrays.
static inline uint32_t tl_nav_tile_corner_vertex(const tl_nav_tile *tile, uint32_t corner)
{
    const void *vertices = tl_nav_tile_at(tile, tile->corner_vertices);
    return (tile->wide & TL_NAV_WIDE_CORNERS) != 0 ? ((const uint32_t *)vertices)[corner]
                                                   : ((const uint16_t *)vertices)[corner];
}

/// A corner's exact lattice coordinates in its tile.
static inline tl_nav_lattice_point tl_nav_tile_lattice(const tl_nav_tile *tile, uint32_t polygon, uint32_t corner)
{
    return tl_nav_tile_vertex(tile, tl_nav_tile_corner_vertex(tile, tl_nav_tile_first_corner(tile, polygon) + corner));
}

/// Whether the ends a and b of a cut stand in the order that both tiles agree on: by x, then z, then y.
static inline bool tl_nav_cut_rises(const int32_t *a, const int32_t *b)
{
    return a[0] != b[0] ? a[0] < b[0] : a[2] != b[2] ? a[2] < b[2] : a[1] <= b[1];
}

/// The ends of a cut in that order.
static inline void tl_nav_cut_ends(const tl_nav_tile *tile, const tl_nav_portal *cut, tl_nav_lattice_point ends_out[2])
{
    const uint32_t next = tl_nav_tile_next_corner(tile, cut->polygon, cut->corner);
    const tl_nav_lattice_point a = tl_nav_tile_vertex(tile, tl_nav_tile_corner_vertex(tile, cut->corner));
    const tl_nav_lattice_point b = tl_nav_tile_vertex(tile, tl_nav_tile_corner_vertex(tile, next));
    const bool rises = tl_nav_cut_rises(a.at, b.at);
    ends_out[0] = rises ? a : b;
    ends_out[1] = rises ? b : a;
}

/// Orders cuts of one place, of the same tile or two, by their ends, then by what tells those with the same ends apart:
/// < 0, 0 or > 0. The two sides of a cut compare as 0.
static inline int tl_nav_cut_compare(const tl_nav_tile *tile_a, const tl_nav_portal *a, const tl_nav_tile *tile_b,
                                     const tl_nav_portal *b)
{
    const int axes[3] = { 0, 2, 1 };
    tl_nav_lattice_point ends_a[2], ends_b[2];
    tl_nav_cut_ends(tile_a, a, ends_a);
    tl_nav_cut_ends(tile_b, b, ends_b);
    for (int i = 0; i < 6; i++) {
        const int32_t at_a = ends_a[i / 3].at[axes[i % 3]];
        const int32_t at_b = ends_b[i / 3].at[axes[i % 3]];
        if (at_a != at_b) {
            return at_a < at_b ? -1 : 1;
        }
    }
    return (a->high > b->high) - (a->high < b->high);
}

/// What lies across an edge, as in tl_polygon_mesh: a polygon of this tile, TL_NO_POLYGON or
/// TL_PORTAL | side, TL_NAV_SIDE_CUT among them.
TL_API uint32_t tl_nav_tile_neighbour(const tl_nav_tile *tile, uint32_t polygon, uint32_t edge);

/// Computes a tile's bounds and the boxes of its tree, which stays as it is, from its detail vertices: after those were
/// moved. All else of the tile must be valid. O(n).
TL_API void tl_nav_tile_fit_boxes(tl_nav_tile *tile);

/// Copies a tile, with flags of 64 bits where `has_wide_flags` or the tile has them. `*copy_out` is freed with
/// tl_blob_free. TL_ERR_ARGUMENT (NULL), TL_ERR_MEMORY; then it is NULL. `tile` must be valid. O(n).
TL_API tl_result tl_nav_tile_copy(const tl_nav_tile *tile, bool has_wide_flags, const tl_allocator *allocator,
                                  tl_nav_tile **copy_out);

/// Sets a polygon's flags: up to 255 without TL_NAV_WIDE_FLAGS.
static inline void tl_nav_tile_set_flags(tl_nav_tile *tile, uint32_t polygon, uint64_t flags)
{
    void *all = tl_nav_tile_to_write(tile, tile->flags);
    if ((tile->wide & TL_NAV_WIDE_FLAGS) != 0) {
        ((uint64_t *)all)[polygon] = flags;
    } else {
        ((uint8_t *)all)[polygon] = (uint8_t)flags;
    }
}

/// Square metres of one polygon in the plane.
TL_API double tl_nav_tile_polygon_area(const tl_nav_tile *tile, uint32_t polygon);

#ifdef __cplusplus
}
#endif

#endif
