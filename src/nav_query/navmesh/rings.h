// SPDX-License-Identifier: MIT
//
// What path searches run on: a tile's polygons as rings of edges, with the ways over its seams among them.
//
// A polygon's ring is its edges, each with what lies across it and where that knows of it, and the points where they
// start. Edges on the tile's border are cut where links begin and end, so that a step over a seam looks like any other.
// Where nothing is cut the points are the tile's own corners. Tiles are immutable and know nothing of their neighbours;
// the rings belong to the navmesh and are made as tiles come.

#ifndef TALUS_SRC_NAV_QUERY_RINGS_H
#define TALUS_SRC_NAV_QUERY_RINGS_H

#include <talus/nav_query.h>

// Values of tl_nav_ring_edge.to beside polygons of the tile: below zero as integers, so that those of 16 bits become
// these by their sign.
#define TL_NAV_RING_SEAM 0x80000000u       ///< set in all of them; by itself: tl_nav_ring_seam_number
#define TL_NAV_RING_BACK (UINT32_MAX - 1u) ///< runs back where links of two floors lie over one another: no way
#define TL_NAV_RING_WALL UINT32_MAX

enum {
    TL_NAV_RING_TWIN_BITS = 3,                               ///< of tl_nav_ring_edge.mark
    TL_NAV_RING_FAR_TWIN = (1 << TL_NAV_RING_TWIN_BITS) - 1, ///< no less: the twin is looked for from here on
    TL_NAV_SEAM_TWIN_BITS = TL_NAV_RING_TWIN_BITS + 12,      ///< over a seam; 12 are left above TL_NAV_MAX_TILES
};
/// Instead of a place, of a wall over which other tiles' polygons may come to lie.
#define TL_NAV_RING_ON_PORTAL 1u
/// The same where a way led over it when the rings were made, until the tile across left (tl_nav_rings_close).
#define TL_NAV_RING_CLOSED    2u
#define TL_NAV_RING_MAX_WALLS (UINT32_MAX >> TL_NAV_RING_TWIN_BITS) ///< of one tile

/// An edge of a polygon, from its point to the next one's. Seen from inside looking out, it starts at its right end.
typedef struct tl_nav_ring_edge {
    uint32_t to; ///< across: a polygon of the tile, or TL_NAV_RING_...
    /// In the low bits the same edge's place in the ring across, or TL_NAV_RING_FAR_TWIN; over a seam the low bits of
    /// near which it stands there, if anywhere (tl_nav_seam_twin_hint). Above them which walls this vertex has.
    uint32_t mark;
} tl_nav_ring_edge;

/// The same where both fit 16 bits, as in most tiles.
typedef struct tl_nav_short_edge {
    int16_t to;
    uint16_t mark;
} tl_nav_short_edge;

typedef union tl_nav_ring_edges {
    tl_nav_short_edge *narrow;
    tl_nav_ring_edge *wide;
} tl_nav_ring_edges;

enum {
    TL_NAV_SHORT_SEAMS = 0x7ffe, ///< so many fit a short edge
    TL_NAV_SHORT_WALLS = 1 << (16 - TL_NAV_RING_TWIN_BITS)
};

/// What lies across a seam. In tl_nav_rings.seams the twin's high bits stand above the slot: tl_nav_ring_seam_of.
typedef struct tl_nav_ring_seam {
    uint32_t slot, polygon;
} tl_nav_ring_seam;

/// The walls on both sides of the free way around a vertex, as directions from it: the way goes left from the first to
/// the last. All 0: they do not tell, as where floors lie over one another at a seam (fans.c).
typedef struct tl_nav_ring_walls {
    float first_x, first_z;
    float last_x, last_z;
} tl_nav_ring_walls;

// Walls that all vertices share at which no path turns, whatever tiles come and go.
#define TL_NAV_WALLS_NONE   0u ///< of vertices without
#define TL_NAV_WALLS_CONVEX 1u ///< of others: that there are some is all that they tell
#define TL_NAV_WALLS_FIRST  2u ///< of those that belong to one way around a vertex, as far as it leads through the tile

/// Set in what tl_nav_node_component gives: several components, with a bit for each number modulo 31, or 15.
#define TL_NAV_MIXED_COMPONENTS 0x80000000u

/// Tiles of more polygons have numbers of 32 bits.
enum { TL_NAV_MAX_SHORT_NUMBER = 0x7fff };

/// Numbers of polygons or components, of 16 bits in most tiles.
typedef union tl_nav_ring_numbers {
    uint16_t *narrow;
    uint32_t *wide;
} tl_nav_ring_numbers;

/// In tl_nav_rings.first_point: the ring has points of its own.
#define TL_NAV_RING_OWN_POINTS 0x80000000u

typedef struct tl_nav_rings {
    tl_nav_ring_edges edges;
    /// By polygon, polygon_count + 1, of 16 bits where the tile's are: its first edge, and where its points begin in
    /// points[0], or TL_NAV_RING_OWN_POINTS | where in points[1]. The tile's own arrays where no ring has points of its
    /// own.
    const void *first, *first_point;
    /// The detail vertices of the tile as it was added; and the points of the rings that are not all corners of their
    /// polygon.
    const tl_vec3 *points[2];
    tl_nav_ring_walls *walls; ///< [walls_count]
    uint32_t *turns;          ///< by walls: names the free way around their vertex when a shortest path may turn there
    tl_nav_ring_seam *seams;
    uint32_t *branch_end;          ///< by branch: those on it, and on those, are numbered from it up to here
    tl_nav_ring_numbers branch;    ///< by polygon: of the tile, to which it belongs (branches.c)
    tl_nav_ring_numbers component; ///< by polygon: its connected component within the tile, from 0; tl_nav_next_member
    /// By node of the tile's box tree: the component of all polygons below it, or the highest bit and those of theirs.
    tl_nav_ring_numbers node_component;
    uint32_t polygon_count, component_count, branch_count, walls_count, node_count, edge_count, seam_count;
    uint32_t point_count; ///< of rings with points of their own
    bool has_back;        ///< some edge is a TL_NAV_RING_BACK
    bool is_wide;         ///< its numbers have 32 bits
    bool has_wide_edges;
    bool has_wide_firsts;
} tl_nav_rings;

/// Bytes of the block that begins with `edges` and holds all arrays but walls, turns, islands and ends of branches.
uint64_t tl_nav_rings_size(const tl_nav_rings *rings);

/// By component: a node of the navmesh's islands (islands.c).
static inline uint32_t *tl_nav_ring_islands(const tl_nav_rings *rings)
{
    return rings->turns + rings->walls_count;
}

typedef struct tl_nav_side_links tl_nav_side_links;

/// Rings of a tile, as it was added, with these links on its sides; they point into it. `old`: its rings from before
/// the links of one side changed, from which all but the polygons on that side are copied, or NULL. TL_ERR_MEMORY.
tl_result tl_nav_rings_make(const tl_allocator *allocator, const tl_nav_tile *tile,
                            const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], const tl_nav_rings *old,
                            uint32_t changed_side, tl_nav_rings *rings_out);
void tl_nav_rings_free(const tl_allocator *allocator, tl_nav_rings *rings);
/// The same rings in memory of their own; those before are released. TL_ERR_MEMORY: nothing is changed.
tl_result tl_nav_rings_copy(const tl_allocator *allocator, tl_nav_rings *rings);

/// Makes walls of all ways to a slot. The cuts in the edges stay.
void tl_nav_rings_close(tl_nav_rings *rings, uint32_t slot);

/// Whether rings of a tile, as it was added, are those that tl_nav_rings_make would make of them with these links on
/// its sides, but for ways over one side that are closed: as when a tile is replaced by one whose border is the same.
bool tl_nav_rings_can_reopen(const tl_nav_rings *rings, const tl_nav_tile *tile,
                             const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t changed_side);
/// Opens those ways.
void tl_nav_rings_reopen(tl_nav_rings *rings, const tl_nav_tile *tile,
                         const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t changed_side);

/// A polygon's first edge. `polygon` <= polygon_count.
uint32_t tl_nav_ring_first(const tl_nav_rings *rings, uint32_t polygon);

uint32_t tl_nav_ring_first_point(const tl_nav_rings *rings, uint32_t polygon);

/// The edge at a place. `is_wide`: of which kind they are.
static inline tl_nav_ring_edge tl_nav_edge_at(tl_nav_ring_edges edges, bool is_wide, uint64_t place)
{
    if (is_wide) {
        return edges.wide[place];
    }
    const tl_nav_ring_edge edge = { (uint32_t)(int32_t)edges.narrow[place].to, edges.narrow[place].mark };
    return edge;
}

/// The edge at a place among all of a tile's; and to write it.
tl_nav_ring_edge tl_nav_edge_of(const tl_nav_rings *rings, uint64_t place);
void tl_nav_set_edge(const tl_nav_rings *rings, uint64_t place, tl_nav_ring_edge edge);

/// The place of an edge in the ring of the polygon across, which is of the same tile and has more edges than fit a
/// mark.
uint32_t tl_nav_find_far_twin(const tl_nav_rings *rings, uint32_t polygon, uint32_t edge);

/// The same of any two polygons of one tile.
uint32_t tl_nav_inner_twin(const tl_nav_rings *rings, uint32_t polygon, uint32_t edge);

/// Finds the branches of a tile, their number, and that of each polygon. Returns their ends, which stand in `scratch`:
/// TL_NAV_BRANCH_SCRATCH * polygon_count + 1 numbers.
const uint32_t *tl_nav_find_branches(tl_nav_rings *rings, uint32_t *scratch);
enum { TL_NAV_BRANCH_SCRATCH = 6 };

static inline uint32_t tl_nav_ring_number(const tl_nav_rings *rings, tl_nav_ring_numbers numbers, uint32_t i)
{
    return rings->is_wide ? numbers.wide[i] : numbers.narrow[i];
}

void tl_nav_set_ring_number(const tl_nav_rings *rings, tl_nav_ring_numbers numbers, uint32_t i, uint32_t number);

static inline uint32_t tl_nav_component_of(const tl_nav_rings *rings, uint32_t polygon)
{
    return tl_nav_ring_number(rings, rings->component, polygon);
}

static inline uint32_t tl_nav_branch_of(const tl_nav_rings *rings, uint32_t polygon)
{
    return tl_nav_ring_number(rings, rings->branch, polygon);
}

/// The next polygon of the same component, around.
static inline uint32_t tl_nav_next_member(const tl_nav_rings *rings, uint32_t polygon)
{
    return tl_nav_ring_number(rings, rings->component, rings->polygon_count + polygon);
}

static inline uint32_t tl_nav_component_bit(const tl_nav_rings *rings, uint32_t component)
{
    return (uint32_t)1 << component % (rings->is_wide ? 31u : 15u);
}

/// The component of all polygons below a node of the tile's box tree, or TL_NAV_MIXED_COMPONENTS | their bits.
static inline uint32_t tl_nav_node_component(const tl_nav_rings *rings, uint32_t node)
{
    const uint32_t kept = tl_nav_ring_number(rings, rings->node_component, node);
    return rings->is_wide || kept <= TL_NAV_MAX_SHORT_NUMBER
               ? kept
               : TL_NAV_MIXED_COMPONENTS | (kept & TL_NAV_MAX_SHORT_NUMBER);
}

/// Whether a polygon lies in a branch, or in one that hangs on it.
static inline bool tl_nav_is_on_branch(const tl_nav_rings *rings, uint32_t branch, uint32_t polygon)
{
    const uint32_t of_polygon = tl_nav_branch_of(rings, polygon);
    return of_polygon >= branch && of_polygon < rings->branch_end[branch];
}

/// Whether an edge may be crossed that leads there.
static inline bool tl_nav_ring_is_open(uint32_t to)
{
    return to < TL_NAV_RING_BACK;
}

/// Whether an edge leads over a seam.
static inline bool tl_nav_ring_is_seam(uint32_t to)
{
    return (to & TL_NAV_RING_SEAM) != 0 && tl_nav_ring_is_open(to);
}

/// The number of a seam, in tl_nav_rings.seams, by the `to` of its edge; and back.
static inline uint32_t tl_nav_ring_seam_number(uint32_t to)
{
    return TL_NAV_RING_BACK - 1 - to;
}

static inline uint32_t tl_nav_ring_twin_hint(tl_nav_ring_edge edge)
{
    return edge.mark & TL_NAV_RING_FAR_TWIN;
}

static inline tl_nav_ring_edge tl_nav_with_twin(tl_nav_ring_edge edge, uint32_t twin)
{
    edge.mark = (edge.mark & ~(uint32_t)TL_NAV_RING_FAR_TWIN) |
                (twin < TL_NAV_RING_FAR_TWIN ? twin : (uint32_t)TL_NAV_RING_FAR_TWIN);
    return edge;
}

/// The polygon across an edge whose `to` names a seam.
static inline tl_nav_ring_seam tl_nav_ring_seam_of(const tl_nav_rings *rings, uint32_t to)
{
    tl_nav_ring_seam seam = rings->seams[tl_nav_ring_seam_number(to)];
    seam.slot &= TL_NAV_MAX_TILES - 1;
    return seam;
}

/// By how many bits a place in a ring of so many edges is shifted to fit TL_NAV_SEAM_TWIN_BITS: 0 in all but absurd
/// ones.
static inline uint32_t tl_nav_seam_twin_shift(uint32_t count)
{
    uint32_t shift = 0;
    while (count >> TL_NAV_SEAM_TWIN_BITS >> shift != 0) {
        shift++;
    }
    return shift;
}

/// Near where an edge of a seam stands in the ring across (tl_nav_set_seam_twin), of `count` edges.
static inline uint32_t tl_nav_seam_twin_hint(const tl_nav_rings *rings, tl_nav_ring_edge edge, uint32_t count)
{
    const uint32_t high = rings->seams[tl_nav_ring_seam_number(edge.to)].slot / TL_NAV_MAX_TILES;
    return (high << TL_NAV_RING_TWIN_BITS | tl_nav_ring_twin_hint(edge)) << tl_nav_seam_twin_shift(count);
}

/// Which walls the vertex has where an edge starts.
static inline uint32_t tl_nav_walls_number(tl_nav_ring_edge edge)
{
    return edge.mark >> TL_NAV_RING_TWIN_BITS;
}

/// Those walls. They are those of its fan where its turn is not 0.
static inline const tl_nav_ring_walls *tl_nav_walls_of(const tl_nav_rings *rings, tl_nav_ring_edge edge)
{
    return &rings->walls[tl_nav_walls_number(edge)];
}

/// Names the free way around the vertex where an edge starts when a shortest path may turn here, else 0.
static inline uint32_t tl_nav_turn_of(const tl_nav_rings *rings, tl_nav_ring_edge edge)
{
    return rings->turns[tl_nav_walls_number(edge)];
}

/// A polygon's ring: edge i leads from point i to the next one, from the last one to the first.
typedef struct tl_nav_ring {
    tl_nav_ring_edges edges; ///< read by the functions below
    const tl_vec3 *points;   ///< metres
    uint32_t count;          ///< of each
    uint32_t first;          ///< the place of edge 0 among all of the tile's
    bool has_wide_edges;
} tl_nav_ring;

static inline tl_nav_ring tl_nav_ring_of(const tl_nav_rings *rings, uint32_t polygon)
{
    tl_nav_ring ring;
    if (rings->has_wide_firsts) {
        const uint32_t *first = (const uint32_t *)rings->first + polygon;
        const uint32_t point = ((const uint32_t *)rings->first_point)[polygon];
        ring.first = first[0];
        ring.count = first[1] - first[0];
        ring.points = rings->points[point / TL_NAV_RING_OWN_POINTS] + (point & (TL_NAV_RING_OWN_POINTS - 1));
    } else { // no points of its own
        const uint16_t *first = (const uint16_t *)rings->first + polygon;
        ring.first = first[0];
        ring.count = (uint32_t)first[1] - first[0];
        ring.points = rings->points[0] + ((const uint16_t *)rings->first_point)[polygon];
    }
    ring.has_wide_edges = rings->has_wide_edges;
    if (ring.has_wide_edges) {
        ring.edges.wide = rings->edges.wide + ring.first;
    } else {
        ring.edges.narrow = rings->edges.narrow + ring.first;
    }
    return ring;
}

static inline tl_nav_ring_edge tl_nav_ring_edge_at(const tl_nav_ring *ring, uint32_t i)
{
    return tl_nav_edge_at(ring->edges, ring->has_wide_edges, i);
}

/// What lies across edge i.
static inline uint32_t tl_nav_ring_to(const tl_nav_ring *ring, uint32_t i)
{
    return ring->has_wide_edges ? ring->edges.wide[i].to : (uint32_t)(int32_t)ring->edges.narrow[i].to;
}

#endif
