// SPDX-License-Identifier: MIT
//
// Queries on a navmesh: the table of tiles, off-mesh links, filters, nearest polygons, paths, straight paths, rays.
//
//   tl_navmesh    tiles side by side, and over one another where a place is divided into layers, linked across their
//                 seams. Adding or removing a tile touches the tiles around it alone. Queries take the navmesh const
//                 and may run on any number of threads at once; a change of the navmesh runs alone. To change it
//                 while it is read there is nav_versions.h.
//   tl_nav_query  the search state of one thread. Functions that search take one; the others need none.
//
// Queries allocate nothing. Polygons are convex in the plane of x and z, and points are inside or outside there; y
// follows from the surface. All loops are bounded, and every way to end has a name. A NULL filter is the default one.
//
// Errors that functions share. TL_ERR_STALE: a reference names nothing, or nothing any more. TL_ERR_NOT_FINITE: a
// coordinate or number is infinite or NaN. TL_ERR_ARGUMENT: an object, an input or a needed output is NULL, a buffer is
// NULL with a capacity above 0, or a filter has no cookie. After an error outputs are zero.

#ifndef TALUS_NAV_QUERY_H
#define TALUS_NAV_QUERY_H

#include <talus/nav_tile.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// The table of tiles.

typedef struct tl_navmesh tl_navmesh;

/// A reference to a polygon of a navmesh: a slot of the table (20 bits), the polygon in its tile (28 bits), and the
/// slot's salt (16 bits), which changes whenever a tile leaves the slot. A slot whose salts are used up is never used
/// again: a reference to a removed tile stays stale for ever. A reference without a salt names an off-mesh link
/// (tl_nav_is_offmesh).
typedef uint64_t tl_nav_ref;

#define TL_NAV_NO_REF 0u

/// Who frees a tile's bytes.
typedef enum tl_nav_tile_ownership {
    TL_NAV_TILE_BORROWED, ///< the caller; they must outlive the tile's stay, for example a mapped file
    TL_NAV_TILE_OWNED     ///< the navmesh, with tl_blob_free
} tl_nav_tile_ownership;

/// Creates an empty navmesh. `allocator` is copied; NULL: malloc. TL_ERR_ARGUMENT, TL_ERR_MEMORY.
TL_API tl_result tl_navmesh_create(const tl_allocator *allocator, tl_navmesh **navmesh_out);

/// Reserves memory for `count` more tiles of one connected component each, so that adding them copies no table of all
/// tiles: else now and then one that is added takes time in proportion to those that are there. No query may run
/// meanwhile. TL_ERR_LIMIT (TL_NAV_MAX_TILES), TL_ERR_MEMORY.
TL_API tl_result tl_navmesh_reserve_tiles(tl_navmesh *navmesh, uint32_t count);

/// Frees the table and the tiles it owns. NULL: nothing happens.
TL_API void tl_navmesh_destroy(tl_navmesh *navmesh);

/// Adds a tile at its own (tile_x, layer, tile_z) and links it with its neighbours: all layers of the four places
/// beside it, over their common sides, and the other layers of its own place, over cuts with the same ends.
///
/// The tile must be known to be whole: fresh from tl_nav_tile_encode, or passed by tl_nav_tile_check. It must not
/// change while it is in: to change flags and areas there is nav_state.h. Two portals are linked where they overlap
/// by more than a point and their heights come within agent_max_climb, the larger of both tiles', and one cell height
/// of one another. On failure nothing is changed and the tile stays the caller's: TL_ERR_ARGUMENT (there is a tile
/// already, or origin, cell sizes or tile_size differ from the other tiles'), TL_ERR_LIMIT (TL_NAV_MAX_TILES; 2^26
/// vertices of one tile at which paths may turn), TL_ERR_MEMORY. O(corners and links of the tiles of the five places).
TL_API tl_result tl_navmesh_add_tile(tl_navmesh *navmesh, const tl_nav_tile *tile, tl_nav_tile_ownership ownership);
/// Adds `count` tiles, such as those of a tl_nav_tiles. On failure none of them is in, all stay the caller's, and
/// `report` (may be NULL) names the tile. Errors as those of tl_navmesh_add_tile.
TL_API tl_result tl_navmesh_add_tiles(tl_navmesh *navmesh, tl_nav_tile *const *tiles, uint32_t count,
                                      tl_nav_tile_ownership ownership, tl_report *report);

/// Removes the tile at a place, all its layers where it is divided, and the links to them. TL_NOT_FOUND: there is none.
/// O(corners of the neighbours). Islands cost what lies between the neighbours, some tiles as a rule; where the tile
/// was all that connected two parts of an island, the smaller part's tiles.
TL_API tl_result tl_navmesh_remove_tile(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z);
/// Removes one layer. TL_NOT_FOUND: there is none. TL_ERR_MEMORY: of a draft (nav_versions.h) only, as of
/// tl_navmesh_remove_tile; nothing is changed but layers removed before.
TL_API tl_result tl_navmesh_remove_layer(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z);

/// Replaces the tiles at a place by those of a stack: removes tiles that are not in the stack byte for byte, adds those
/// that are new, and leaves the others as they are, references too. An empty stack empties the place.
///
/// The navmesh takes over the tiles and their array, which come from an allocator like its own; afterwards the stack is
/// empty, on failure too. TL_ERR_ARGUMENT (a tile is of another place): nothing is changed. Other errors as those of
/// tl_navmesh_add_tile: some of the tiles may be missing.
TL_API tl_result tl_navmesh_replace_tiles(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z,
                                          tl_nav_tile_stack *stack);

/// The tile at a place, or NULL; where it is divided the lowest layer that is there.
TL_API const tl_nav_tile *tl_navmesh_find_tile(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z);
/// The tile of one layer at a place, or NULL.
TL_API const tl_nav_tile *tl_navmesh_find_layer(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer,
                                                int32_t tile_z);

/// Tiles in the navmesh, layers counted each.
TL_API uint32_t tl_navmesh_tile_count(const tl_navmesh *navmesh);
/// Slots of the table, for a loop over all tiles: each holds a tile or none.
TL_API uint32_t tl_navmesh_slot_count(const tl_navmesh *navmesh);
/// The tile of a slot; NULL: it is empty, or there is no such slot.
TL_API const tl_nav_tile *tl_navmesh_slot_tile(const tl_navmesh *navmesh, uint32_t slot);
/// Links from polygons to neighbours, over all tiles and anchored off-mesh links, each direction counted. A search uses
/// at most two nodes more than that.
TL_API uint64_t tl_navmesh_link_count(const tl_navmesh *navmesh);
/// Changes of the navmesh so far: of tiles, off-mesh links, flags and areas. While it stays the same, so do all
/// answers.
TL_API uint64_t tl_navmesh_edit_count(const tl_navmesh *navmesh);

/// The reference of a polygon in the tile of a slot, or TL_NAV_NO_REF when there is none.
TL_API tl_nav_ref tl_navmesh_polygon_ref(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon);
/// The tile and polygon that a reference names. Outputs may be NULL. TL_ERR_STALE.
TL_API tl_result tl_navmesh_resolve(const tl_navmesh *navmesh, tl_nav_ref ref, const tl_nav_tile **tile_out,
                                    uint32_t *polygon_out);

/// A link from a polygon to a neighbour: the portal, the stretch of edge that both share. Off-mesh links are not among
/// these.
typedef struct tl_nav_link {
    tl_nav_ref to;       ///< the neighbour
    uint32_t edge;       ///< of the polygon that is left
    tl_vec3 left, right; ///< ends of the portal, seen from inside the polygon looking out
} tl_nav_link;

/// A polygon's links in the order of its edges, and along a tile's side by ascending lattice coordinate.
/// Writes the first `capacity`; `*count_out` is the true count. TL_INCOMPLETE: that is more. TL_ERR_STALE.
TL_API tl_result tl_navmesh_links(const tl_navmesh *navmesh, tl_nav_ref ref, tl_nav_link *links_out, uint32_t capacity,
                                  uint32_t *count_out);

/// The island of a polygon: the number of its connected component over tiles and anchored off-mesh links, whatever
/// their flags, one-way links counted as if they led both ways.
///
/// Between two islands there is no path, for any filter. Within an island without one-way links there is a path between
/// any two polygons, for a filter that passes all; where links lead one way only, a search has the last word. Numbers
/// hold until a tile or a link is added or removed. TL_ERR_STALE. O(log tiles), almost always O(1).
TL_API tl_result tl_navmesh_island(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *island_out);

// ---------------------------------------------------------------------------------------------------------
// Off-mesh links: connections that cross no polygon. Jumps, drops, ladders, doors, lifts, teleporters.

/// A link from a point to a point, of any length, over any number of tiles. Begin with tl_default_nav_offmesh.
typedef struct tl_nav_offmesh {
    tl_vec3 start, end; ///< metres
    /// Metres, >= 0: an end is anchored to the polygon's point that is nearest to it in the box of this half size
    /// around it (tl_navmesh_find_nearest), whatever its flags.
    float radius;
    /// The link costs as much as fixed_cost + cost_factor * its length in metres, both >= 0. A link that costs less
    /// than its length is a short cut through space, near which searches look at more polygons: prefer factors of 1 or
    /// more.
    float cost_factor, fixed_cost;
    uint64_t flags;  ///< for filters, as a polygon's; not 0
    uint64_t user;   ///< the caller's own
    uint8_t area;    ///< its cost is multiplied by this area's cost
    bool both_ways;  ///< false: from start to end only
    uint32_t cookie; ///< set by tl_default_nav_offmesh
} tl_nav_offmesh;

/// Radius 0.5, cost its length, flags 1, area 63 (TL_NAV_WALKABLE_AREA), one way.
TL_API tl_nav_offmesh tl_default_nav_offmesh(void);

#define TL_NAV_MAX_OFFMESH (1u << 24) ///< off-mesh links of one navmesh

/// Adds an off-mesh link, and anchors its ends where there are polygons near them now.
///
/// Ends follow the tiles: whenever a tile is added or removed, ends near it are anchored anew to the polygon that is
/// nearest then. So anchors depend on the tiles that are there, not on their history. A link of which an end has no
/// polygon is kept, and no path uses it until there is one. `*link_out` is its reference, which is not used again.
/// No query may run meanwhile. O(1), but for the two nearest-polygon searches and the growth of the table. From then on
/// each change of a tile looks at each link's box once.
/// TL_ERR_NOT_FINITE or TL_ERR_ARGUMENT (`report`, which may be NULL, names the field), TL_ERR_LIMIT
/// (TL_NAV_MAX_OFFMESH), TL_ERR_MEMORY.
TL_API tl_result tl_navmesh_add_offmesh(tl_navmesh *navmesh, const tl_nav_offmesh *offmesh, tl_nav_ref *link_out,
                                        tl_report *report);

/// Reserves memory for `count` more links, so that adding them takes none. TL_ERR_LIMIT, TL_ERR_MEMORY.
TL_API tl_result tl_navmesh_reserve_offmesh(tl_navmesh *navmesh, uint32_t count);

/// Removes an off-mesh link. TL_ERR_STALE: no such link. O(1); where its ends are not connected over polygons, islands
/// are split as by removing a tile.
TL_API tl_result tl_navmesh_remove_offmesh(tl_navmesh *navmesh, tl_nav_ref link);

/// Paths and corners set this bit in a link's reference where they take it from its end to its start.
#define TL_NAV_OFFMESH_BACKWARD ((tl_nav_ref)1 << 47)

/// Whether a reference names an off-mesh link, which may have been removed, and not a polygon.
static inline bool tl_nav_is_offmesh(tl_nav_ref ref)
{
    return ref != TL_NAV_NO_REF && ref >> 48 == 0;
}

/// A point on the surface of a polygon.
typedef struct tl_nav_location {
    tl_nav_ref polygon;
    tl_vec3 point;
} tl_nav_location;

/// An off-mesh link and its anchors.
typedef struct tl_nav_offmesh_state {
    tl_nav_offmesh offmesh;  ///< as it was added
    tl_nav_location ends[2]; ///< where its start and its end are anchored; polygon TL_NAV_NO_REF: nowhere now
    bool anchored;           ///< both ends are: paths may use it
    float length;            ///< metres from anchor to anchor, straight in space; 0 unless anchored
    float cost;              ///< metres, before its area's cost; 0 unless anchored
} tl_nav_offmesh_state;

/// TL_ERR_STALE: no such link.
TL_API tl_result tl_navmesh_offmesh_state(const tl_navmesh *navmesh, tl_nav_ref link, tl_nav_offmesh_state *state_out);

/// Off-mesh links in the navmesh, anchored or not.
TL_API uint32_t tl_navmesh_offmesh_count(const tl_navmesh *navmesh);
/// Iterates over all off-mesh links. Start with `*cursor` 0; false at the end.
TL_API bool tl_navmesh_next_offmesh(const tl_navmesh *navmesh, uint32_t *cursor, tl_nav_ref *link_out);

/// The off-mesh links by which a polygon can be left: anchored ones that begin there, or end there and lead both ways
/// (TL_NAV_OFFMESH_BACKWARD is then set). In no order.
/// Writes the first `capacity`; `*count_out` is the true count. TL_INCOMPLETE: that is more. TL_ERR_STALE.
TL_API tl_result tl_navmesh_offmesh_from(const tl_navmesh *navmesh, tl_nav_ref polygon, tl_nav_ref *links_out,
                                         uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Filters: which polygons may be entered, and what they cost.

/// Whether a polygon passes whose flags do. The answer must stay the same while a search runs.
typedef bool tl_nav_pass_fn(const tl_nav_tile *tile, uint32_t polygon, void *user);

/// What it costs to go straight through a polygon from one point to another; `cost` is the cost without this function:
/// metres times area cost. Negative, infinite or NaN: it cannot be done. Searches estimate with the lowest area cost
/// for each metre: where this function returns less than that, the path found may not be the cheapest.
typedef float tl_nav_cost_fn(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 from, tl_vec3 to, float cost,
                             void *user);

#define TL_NAV_MAX_SLACK 1.0f ///< of a filter: a path may be twice as long as the shortest

/// A polygon passes when (flags & include_flags) != 0 and (flags & exclude_flags) == 0, and `pass` returns true. A
/// metre in it costs area_cost[its area], or what `cost` makes of it. Functions are called by the querying thread.
typedef struct tl_nav_filter {
    uint64_t include_flags;               ///< default all
    uint64_t exclude_flags;               ///< default none
    float area_cost[TL_NAV_MAX_AREA + 1]; ///< finite, > 0
    tl_nav_pass_fn *pass;                 ///< NULL: flags decide
    tl_nav_cost_fn *cost;                 ///< NULL: metres times area cost
    void *user;                           ///< for both functions
    /// A path may be longer than the shortest one by this share of it at most, for which searches look at fewer
    /// polygons; 0 (default) to TL_NAV_MAX_SLACK. tl_nav_query_find_path and what is made of it take it (routes,
    /// slices, corridors, crowds); wide paths, paths out of fields, floods and all that is no path do not look at it.
    float slack;
    uint32_t cookie; ///< set by tl_default_nav_filter
} tl_nav_filter;

/// All polygons with a flag pass, each metre costs 1, no functions.
TL_API tl_nav_filter tl_default_nav_filter(void);

/// Whether a polygon passes a filter (NULL: the default one). The tile must hold the polygon.
TL_API bool tl_nav_filter_passes(const tl_nav_filter *filter, const tl_nav_tile *tile, uint32_t polygon);

// ---------------------------------------------------------------------------------------------------------
// Points and polygons.

/// The polygon nearest to `center` among those that overlap the box center +- half_extents, and its point.
///
/// A polygon's point is its closest one in the plane, lifted to the surface; it must lie in the box. Points are
/// compared by their distance in space, but a point more than agent_max_climb above `center` counts as agent_height
/// farther. So any point of an agent's body, from its soles to its crown, finds the floor that the agent stands on,
/// even where the floor overhead is nearer; unless it lies within agent_max_climb under that floor. Ties go to the
/// lower slot, then polygon. half_extents: metres, >= 0. TL_NOT_FOUND: none is in the box. TL_ERR_NOT_FINITE,
/// TL_ERR_ARGUMENT (negative extents).
TL_API tl_result tl_navmesh_find_nearest(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_vec3 center,
                                         tl_vec3 half_extents, tl_nav_location *location_out);

/// The point nearest to `point` in space on the island of polygon `from`, on polygons that pass: where to go when the
/// goal itself lies on another island. O(polygons). TL_NOT_FOUND: no polygon passes. TL_ERR_STALE, TL_ERR_NOT_FINITE.
TL_API tl_result tl_navmesh_find_nearest_reachable(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                                   tl_nav_ref from, tl_vec3 point, tl_nav_location *location_out);

/// The polygon's point closest to `point` in the plane, lifted to the surface. A point over the polygon keeps its x
/// and z bit by bit; `*inside_out` (may be NULL) says whether it was so. TL_ERR_STALE, TL_ERR_NOT_FINITE.
TL_API tl_result tl_navmesh_closest_point(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 point,
                                          tl_vec3 *closest_out, bool *inside_out);

/// The surface's height at x and z, from the detail mesh; outside the polygon, that of the closest point in the plane.
/// TL_ERR_STALE, TL_ERR_NOT_FINITE.
TL_API tl_result tl_navmesh_height(const tl_navmesh *navmesh, tl_nav_ref ref, float x, float z, float *height_out);

// ---------------------------------------------------------------------------------------------------------
// Paths.

/// The memory of one search at a time.
typedef struct tl_nav_query tl_nav_query;

typedef struct tl_nav_query_def {
    /// Nodes that one search may use, 2 to 2^30. tl_navmesh_link_count + 2 is always enough to find a path where there
    /// is one. A query begins with memory for 512 of them, 120 KB, and doubles it when a search needs more: 236 bytes a
    /// node. Default 65536.
    uint32_t max_nodes;
    /// Copied; NULL: malloc. A search may ask it for memory; where it gets none it ends as one that is out of nodes.
    const tl_allocator *allocator;
    uint32_t cookie; ///< set by tl_default_nav_query_def
} tl_nav_query_def;

TL_API tl_nav_query_def tl_default_nav_query_def(void);

/// Creates a query, for one thread at a time and any navmesh. NULL def: the default one. TL_ERR_ARGUMENT (`report`,
/// which may be NULL, names the field), TL_ERR_MEMORY.
TL_API tl_result tl_nav_query_create(const tl_nav_query_def *def, tl_nav_query **query_out, tl_report *report);
/// Frees a query. NULL: nothing happens.
TL_API void tl_nav_query_destroy(tl_nav_query *query);

/// Makes the memory for so many nodes now: searches that need no more do not allocate. With def.max_nodes none ever do.
/// Ends a search in slices that is under way. TL_ERR_ARGUMENT (NULL), TL_ERR_LIMIT (more than def.max_nodes),
/// TL_ERR_MEMORY: it is as before.
TL_API tl_result tl_nav_query_reserve(tl_nav_query *query, uint32_t nodes);

// Results of searches, besides the errors that all functions share (above). How a search for a path went is a status of
// the path, not a result: TL_OK for an unreachable goal too, and where the query ran out of nodes. Other searches that
// run out of nodes return TL_ERR_NODES, with the best that was seen. A buffer may be NULL where its capacity is 0;
// TL_INCOMPLETE: it holds the first part, and counts are true.

/// How a path search ended.
typedef enum tl_nav_path_status {
    TL_NAV_PATH_NONE,         ///< nothing was searched: the call failed, and its result says why
    TL_NAV_PATH_COMPLETE,     ///< the path leads to the goal
    TL_NAV_PATH_UNREACHABLE,  ///< proven: no path leads to the goal; this one leads as near to it as any
    TL_NAV_PATH_OUT_OF_NODES, ///< gave up at max_nodes; this one leads as near to the goal as was seen
    TL_NAV_PATH_UNFINISHED,   ///< sliced, and there is more to do; this one leads as near as was seen so far
    TL_NAV_PATH_STALE         ///< sliced, and a tile that was searched has changed: begin again
} tl_nav_path_status;

/// "none", "complete", "unreachable", "out of nodes", "unfinished", "stale"; "unknown" for other numbers.
TL_API const char *tl_nav_path_status_name(tl_nav_path_status status);

#define TL_NAV_CORNER_START 1u  ///< the path's start
#define TL_NAV_CORNER_END   2u  ///< the path's end
#define TL_NAV_CORNER_LEFT  4u  ///< the path turns left around it
#define TL_NAV_CORNER_RIGHT 8u  ///< the path turns right around it
#define TL_NAV_CORNER_LINK  16u ///< the path takes an off-mesh link from here to the next corner

/// A corner of a straight path.
typedef struct tl_nav_corner {
    tl_vec3 point;      ///< on the surface, metres
    tl_nav_ref polygon; ///< that the path enters here and continues in
    uint32_t flags;     ///< TL_NAV_CORNER_...
    tl_nav_ref link;    ///< TL_NAV_CORNER_LINK: which; else TL_NAV_NO_REF
} tl_nav_corner;

/// The input of a path search.
typedef struct tl_nav_path_request {
    const tl_nav_filter *filter; ///< NULL: the default filter
    tl_nav_location start;       ///< on its polygon (tl_navmesh_find_nearest), which need not pass the filter
    tl_nav_location goal;        ///< on its polygon
} tl_nav_path_request;

/// Where a path is written: the caller's memory.
typedef struct tl_nav_path_buffers {
    tl_nav_ref *polygons; ///< as tl_nav_query_find_path writes them; NULL with capacity 0
    uint32_t polygon_capacity;
    tl_nav_corner *corners; ///< as tl_navmesh_straight_path writes them; NULL with capacity 0
    uint32_t corner_capacity;
} tl_nav_path_buffers;

/// A path as its search has found it.
typedef struct tl_nav_path {
    tl_nav_path_status status; ///< how the search ended
    uint32_t polygon_count;    ///< of the whole path, though the buffer may hold fewer
    tl_nav_location end;       ///< the goal, or for a partial path the point of its last polygon nearest to the goal
    float cost;                ///< as searched: metres times area costs
    uint32_t node_count;       ///< nodes that the search used
} tl_nav_path;

/// Finds the polygons of a path, the start's first; each shares an edge with the one before, or an off-mesh link stands
/// between the two (tl_nav_is_offmesh) that leads from one to the other.
///
/// Where every metre costs the same the path is the shortest one in the plane (tl_nav_query_find_shortest_path), or
/// longer by the filter's slack at most, and the straight path through its polygons is no longer. Where costs differ,
/// or that search runs out of nodes, A* finds the path: its nodes are ways into polygons, and each polygon is entered
/// where the path from the point before over that edge to the goal is shortest. Such a path is near the cheapest, but
/// not proven to be it; with slack it may cost some more, and by how much is not proven either. Whether there is a path
/// at all is proven.
///
/// A goal in another connected component (tl_navmesh_island) is TL_NAV_PATH_UNREACHABLE at once, without a search, and
/// the path is the start's polygon alone; tl_nav_query_find_route leads as near to such a goal as any path does.
/// TL_ERR_ARGUMENT: an area cost, or the filter's slack. Source: Hart, Nilsson, Raphael, A Formal Basis for the
/// Heuristic Determination of Minimum Cost Paths, 1968 (A*).
TL_API tl_result tl_nav_query_find_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                        const tl_nav_path_request *request, tl_nav_ref *polygons_out, uint32_t capacity,
                                        tl_nav_path *path_out);

/// Begins a sliced search, for long paths over many frames: begin, step until the status is not TL_NAV_PATH_UNFINISHED,
/// write. The path does not depend on the slices: it is that of tl_nav_query_find_path, bit by bit. (On a prepared
/// navmesh that function uses the visibility graph and may find another path of the same length.)
///
/// A query has one search under way. Another one, or any other call that takes the query, ends it. The filter is
/// copied; its functions and their `user` must outlive the search. Tiles may be added and removed between steps: where
/// one that the search has seen changes, or a neighbour of one, the search becomes TL_NAV_PATH_STALE; other changes do
/// not disturb it. Errors as those of tl_nav_query_find_path; then no search is under way.
TL_API tl_result tl_nav_query_begin_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_path_request *request);

/// How far a sliced search has come.
typedef struct tl_nav_path_progress {
    tl_nav_path_status status; ///< TL_NAV_PATH_UNFINISHED: step again
    uint32_t node_count;       ///< nodes used so far
    int32_t tile_x, tile_z;    ///< TL_NAV_PATH_STALE: the tile that was added or removed; else 0
} tl_nav_path_progress;

/// Continues for at most `max_steps` nodes; 0 only checks whether tiles have changed. TL_ERR_STALE: no search is under
/// way, or another one has ended it.
TL_API tl_result tl_nav_query_step_path(tl_nav_query *query, uint32_t max_steps, tl_nav_path_progress *progress_out);

/// Writes the path as far as it is known, at any time; the search may continue afterwards. While
/// TL_NAV_PATH_UNFINISHED the cost is only a lower bound. TL_NAV_PATH_STALE: there is no path, polygon_count is 0.
/// TL_ERR_STALE: no search is under way, or another one has ended it. O(nodes used) before the goal is reached.
TL_API tl_result tl_nav_query_write_path(tl_nav_query *query, tl_nav_ref *polygons_out, uint32_t capacity,
                                         tl_nav_path *path_out);

/// A path as its polygons, as tl_nav_query_find_path writes them: each is a neighbour of the one before, or an off-mesh
/// link stands between the two.
typedef struct tl_nav_polygon_path {
    const tl_nav_ref *polygons; ///< the start's first, the end's last
    uint32_t polygon_count;     ///< >= 1
    tl_vec3 start, end;         ///< points that are not on their polygons are moved to the closest point there
} tl_nav_polygon_path;

/// Pulls a path straight (funnel, string pulling): the shortest line in the plane from start to end through its
/// polygons.
///
/// Off-mesh links cut the line into pieces from anchor to anchor. There are at least two corners, start and end.
/// `*length_out` (may be NULL) is the sum of the straight distances in space, metres. TL_ERR_ARGUMENT: no polygon, or
/// two in succession that are not neighbours. Source: Mikko Mononen, Simple Stupid Funnel Algorithm, 2010.
TL_API tl_result tl_navmesh_straight_path(const tl_navmesh *navmesh, const tl_nav_polygon_path *path,
                                          tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out,
                                          float *length_out);

// More flags, of the points of a traced path.
#define TL_NAV_CORNER_CROSSING 32u ///< the path crosses into another polygon here
#define TL_NAV_CORNER_AREA     64u ///< which has another area

/// A point of a path: a corner, or where it crosses from a polygon into the next.
typedef struct tl_nav_trace_point {
    tl_vec3 point;      ///< metres; y is that of the corner or of the polygon's edge
    tl_nav_ref polygon; ///< the path continues in it
    uint32_t flags;     ///< TL_NAV_CORNER_...
    float cost;   ///< of the path up to here: metres in space times area costs, or what the filter's function says
    float length; ///< of the path up to here, metres in space
} tl_nav_trace_point;

/// What a straight path is followed through. Polygons and corners are those of one path: of tl_navmesh_straight_path,
/// of tl_nav_query_find_shortest_path, or of tl_navmesh_cast_ray, whose corners are its start and its end.
typedef struct tl_nav_trace_request {
    const tl_nav_filter
        *filter; ///< for costs alone: polygons that it refuses are crossed too. NULL: the default filter
    const tl_nav_ref *polygons;
    uint32_t polygon_count; ///< >= 1
    const tl_nav_corner *corners;
    uint32_t corner_count; ///< >= 2
    /// Crossings with one of these flags are written: 0, TL_NAV_CORNER_AREA or TL_NAV_CORNER_CROSSING.
    uint32_t keep;
} tl_nav_trace_request;

/// Follows a straight path through its polygons: what it costs, and where it crosses into them.
///
/// All corners are written, and the crossings that have a flag of `keep`; a crossing at the place of a corner is merged
/// with it. Crossings have the heights of the polygons' edges. `*cost_out` (may be NULL) is the whole cost, infinite
/// where the filter's function says so. TL_ERR_ARGUMENT: no path: fewer than two corners, two polygons in succession
/// that are not neighbours, or a corner that lies in none of the polygons.
TL_API tl_result tl_navmesh_trace_path(const tl_navmesh *navmesh, const tl_nav_trace_request *request,
                                       tl_nav_trace_point *points_out, uint32_t capacity, uint32_t *count_out,
                                       float *cost_out);

/// The shortest path and its certificate.
typedef struct tl_nav_shortest_path {
    tl_nav_path_status status; ///< how the search ended
    uint32_t corner_count;     ///< of the whole path, though the buffers may hold fewer
    uint32_t polygon_count;    ///< of the whole path, off-mesh links included
    double length;             ///< metres in the plane, of the corners; off-mesh links count what they cost
    /// Metres in the plane: no path is shorter. Below length by rounding only; with slack, at least length / (1 +
    /// slack) but for rounding: by how much the path may be too long at most.
    double lower_bound;
    double surface_length; ///< metres in space, straight from corner to corner
    uint32_t node_count;   ///< nodes that the search used
} tl_nav_shortest_path;

/// Finds the shortest path in the plane from point to point, over tiles, seams and floors that lie over one another,
/// with its corners, its polygons and a proof. Off-mesh links are used where that is shorter.
///
/// Lengths are measured in x and z, where "straight" means the same on every floor; heights follow from the surface.
/// The filter's flags and slack count, its area costs do not. With slack the path is taut still (no path of the same
/// homotopy class is shorter), and at most 1 + slack times as long as the shortest; a prepared navmesh yields the
/// shortest all the same (tl_navmesh_prepare). Corners are the start, the vertices where the path turns, and the
/// goal. Start and goal are first moved onto their polygons, in the plane.
/// TL_NAV_PATH_UNREACHABLE: proven, and at once for a goal in another connected component. TL_NAV_PATH_OUT_OF_NODES:
/// gave up at max_nodes; lower_bound still holds. In both cases nothing is written and the counts are 0.
/// A buffer with capacity 0 is left out, and its count alone is no TL_INCOMPLETE; NULL `buffers`: both are left out.
/// TL_ERR_ARGUMENT: the filter's slack. Source: Cui, Harabor, Grastien, Compromise-free Pathfinding on a Navigation
/// Mesh (Polyanya), IJCAI 2017.
TL_API tl_result tl_nav_query_find_shortest_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                                 const tl_nav_path_request *request, const tl_nav_path_buffers *buffers,
                                                 tl_nav_shortest_path *path_out);

/// A ray along the surface.
typedef struct tl_nav_ray_hit {
    bool hit;               ///< false: the end was reached, t is 1
    float t;                ///< [0, 1] of the way in the plane
    tl_vec3 point;          ///< where it ended; y is that of the straight line (tl_navmesh_height gives the surface's)
    tl_vec3 normal;         ///< of the wall, unit, in the plane, towards the walkable side; 0 without a hit
    tl_nav_ref polygon;     ///< where it ended
    uint32_t edge;          ///< of that polygon, that was hit
    uint32_t polygon_count; ///< crossed, the first and last included
} tl_nav_ray_hit;

/// Casts a ray from start straight towards `end` (its x and z) along the surface, until it hits a wall or a polygon
/// that the filter refuses. It takes no off-mesh links.
///
/// A ray that only touches a wall or corner continues. `polygons_out` gets the polygons crossed; left out with capacity
/// 0. TL_INCOMPLETE: the hit is whole. TL_ERR_ITERATIONS: more steps than polygons, which only a damaged tile can
/// cause. O(polygons crossed).
TL_API tl_result tl_navmesh_cast_ray(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                     const tl_nav_location *start, tl_vec3 end, tl_nav_ref *polygons_out,
                                     uint32_t capacity, tl_nav_ray_hit *hit_out);

// ---------------------------------------------------------------------------------------------------------
// Around a place.

/// The input of a move along the surface.
typedef struct tl_nav_move_request {
    const tl_nav_filter *filter; ///< NULL: the default filter. What it refuses is wall
    tl_nav_location start;       ///< on its polygon
    tl_vec3 target;              ///< its x and z count
} tl_nav_move_request;

/// Where a move ended.
typedef struct tl_nav_move {
    tl_nav_location end;    ///< exact in x and z; y is that of the target or of the wall (see tl_navmesh_height)
    uint32_t polygon_count; ///< that the move went through, the first and last included
} tl_nav_move;

/// Moves from start towards the target, sliding along walls.
///
/// The move ends at the target where polygons that touch the circle around start and target (whose distance is its
/// diameter) lead to it, else at the point of their walls that is nearest to the target. `polygons_out` gets the
/// polygons from the start's to the end's, neighbours in order; left out with capacity 0. TL_INCOMPLETE: the end is
/// whole. O(polygons that touch the circle).
TL_API tl_result tl_nav_query_move_along_surface(tl_nav_query *query, const tl_navmesh *navmesh,
                                                 const tl_nav_move_request *request, tl_nav_ref *polygons_out,
                                                 uint32_t capacity, tl_nav_move *move_out);

/// The input of queries around a place: the place and a radius.
typedef struct tl_nav_around_request {
    const tl_nav_filter *filter; ///< NULL: the default filter
    tl_nav_location center;      ///< on its polygon
    float radius;                ///< metres in the plane, >= 0
} tl_nav_around_request;

/// The wall nearest to a place, in the plane.
typedef struct tl_nav_wall {
    bool hit;           ///< false: none within the radius
    float distance;     ///< metres in the plane; the radius without a hit
    tl_vec3 point;      ///< on the wall
    tl_vec3 normal;     ///< unit, in the plane, towards the walkable side; 0 without a hit
    tl_nav_ref polygon; ///< that the wall belongs to; the center's without a hit
} tl_nav_wall;

/// Finds the wall nearest to a place within a radius, among those that a straight line along the surface reaches: walls
/// on a floor above or below do not count. What the filter refuses is wall. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_find_wall(tl_nav_query *query, const tl_navmesh *navmesh,
                                        const tl_nav_around_request *request, tl_nav_wall *wall_out);

// ---------------------------------------------------------------------------------------------------------
// All in one.

/// The input of a route.
typedef struct tl_nav_route_request {
    const tl_nav_filter *filter; ///< NULL: the default filter
    tl_vec3 start, goal;         ///< anywhere near the navmesh
    tl_vec3 half_extents;        ///< metres, >= 0: the box around both in which polygons are sought
} tl_nav_route_request;

/// A path with its corners between two places.
typedef struct tl_nav_route {
    tl_nav_location start, goal; ///< the nearest points on the navmesh
    tl_nav_path path;            ///< as tl_nav_query_find_path finds it
    uint32_t corner_count;       ///< of the whole route, though the buffer may hold fewer
    float length;                ///< metres along the corners
} tl_nav_route;

/// Finds the points of the navmesh nearest to start and goal, a path between them and its straight path. Where no path
/// leads to the goal, the corners lead to the point nearest to it that can be reached, and the status says so.
///
/// TL_NOT_FOUND: no polygon near start (route_out->start.polygon is TL_NAV_NO_REF) or near goal
/// (route_out->goal.polygon is). TL_INCOMPLETE: path.polygon_count and, when the polygons fitted, corner_count are the
/// capacities needed. Other errors as those of the functions it calls.
TL_API tl_result tl_nav_query_find_route(tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_route_request *request, const tl_nav_path_buffers *buffers,
                                         tl_nav_route *route_out);

#ifdef __cplusplus
}
#endif

#endif
