// SPDX-License-Identifier: MIT
//
// Routes over a whole world (nav_world.h), in memory or not: the length of a path from any place to any other, from
// both sides, at once.
//
//   tl_nav_routes_bake(&def, &routes, &report);           once, of the file's tiles; goes into the file as chunk ROUT
//   tl_nav_router_create(world, &router, &report);        a thread's memory, for a world whose file has that chunk
//   tl_nav_world_find_route(world, router, &request, points, capacity, &route);
//
// Tiles meet at gates: stretches of a seam that can be walked along. The chunk holds exact lengths between the gates of
// each place and of each block of places, and those that follow for the halves, quarters and so on of the world. An
// answer adds up some tens of thousands of these, whatever lies between. Only the tiles of both ends are looked at.
//
// Lengths are metres in the plane, as of tl_nav_query_find_shortest_path, for the default filter: every polygon with a
// flag is walkable, and every metre costs 1. A file of which routes are known has no off-mesh links (nav_world.h).
//
// Errors that functions share: those of nav_query.h.

#ifndef TALUS_NAV_ROUTES_H
#define TALUS_NAV_ROUTES_H

#include <talus/nav_world.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// Baking.

/// The ROUT chunk: a blob, all words of which are four bytes behind its head. Gates and lengths follow it.
typedef struct tl_nav_routes {
    tl_blob blob;
    uint32_t tiles_hash[2]; ///< of the tiles that it was baked from, the low half first
    uint32_t gate_count;
    uint32_t length_count;
    uint32_t block; ///< tl_nav_routes_def.block
    uint32_t reserved[7];
} tl_nav_routes;

/// Begin with tl_default_nav_routes_def, and set `read`.
typedef struct tl_nav_routes_def {
    tl_nav_world_read_fn *read; ///< reads the file, as of tl_nav_world_def
    void *user;
    /// Places on a side of a block: 1, 2, 4, 8 or 16. Within a block lengths are exact. Larger ones make both bounds
    /// tighter and the bake longer: it holds a block's tiles in memory. Default 4.
    uint32_t block;
    tl_host host; ///< its allocator and its progress are used
    uint32_t cookie;
} tl_nav_routes_def;

TL_API tl_nav_routes_def tl_default_nav_routes_def(void);

/// Finds the gates of a file's tiles and the lengths between them. The same tiles give the same bytes. A ROUT chunk
/// that the file has is not looked at.
///
/// `*routes_out` is freed with tl_blob_free; on failure it is NULL. `report` may be NULL. TL_ERR_ARGUMENT (the report
/// names the field), the errors of tl_nav_world_create and tl_nav_world_run_load, TL_ERR_LIMIT (2^28 gates, 2^32
/// lengths), TL_ERR_CANCELLED, TL_ERR_MEMORY. O(tiles * sqrt(tiles)), for tiles side by side, with some exact searches
/// a pair of gates of a place and of a block.
TL_API tl_result tl_nav_routes_bake(const tl_nav_routes_def *def, tl_nav_routes **routes_out, tl_report *report);

/// Whether untrusted bytes are a ROUT blob. tl_nav_world_create also holds it to the tiles of its file. As
/// tl_pack_meta_check. O(size).
TL_API tl_result tl_nav_routes_check(const void *bytes, uint64_t size, tl_report *report);

/// Whether checked routes are those of the tiles of a file with that index, as they stand there. TL_ERR_CORRUPT: they
/// are of other tiles. TL_ERR_ARGUMENT. `report` may be NULL. O(chunks).
TL_API tl_result tl_nav_routes_check_tiles(const tl_nav_routes *routes, const tl_pack_index *index, tl_report *report);

// ---------------------------------------------------------------------------------------------------------
// Asking.

/// The memory of one thread for routes over one world, which must outlive it.
typedef struct tl_nav_router tl_nav_router;

/// `allocator` is copied; NULL: malloc. TL_NOT_FOUND: the world's file has no ROUT chunk. TL_ERR_ARGUMENT,
/// TL_ERR_MEMORY. `report` may be NULL.
TL_API tl_result tl_nav_router_create(const tl_nav_world *world, const tl_allocator *allocator,
                                      tl_nav_router **router_out, tl_report *report);
/// NULL: nothing happens.
TL_API void tl_nav_router_destroy(tl_nav_router *router);

/// Ends of a route: points on polygons, as tl_nav_world_find_nearest finds them.
typedef struct tl_nav_world_route_request {
    tl_nav_location start, goal;
} tl_nav_world_route_request;

/// A point of a route: its start, the middle of a gate that it goes through, or its goal.
typedef struct tl_nav_world_route_point {
    double point[3];        ///< in the level's coordinates
    double length;          ///< metres in the plane, of the route up to here, rounded up
    int32_t tile_x, tile_z; ///< place in the file's grid that the route goes on in; of the goal, its own
} tl_nav_world_route_point;

typedef struct tl_nav_world_route {
    tl_nav_path_status status; ///< TL_NAV_PATH_COMPLETE or TL_NAV_PATH_UNREACHABLE, which is proven
    uint32_t point_count;      ///< of the whole route, though the buffer may hold fewer; 0 where there is none
    double length;             ///< metres in the plane: the route's, so that no shortest path is longer. 0 where none
    double lower_bound;        ///< metres in the plane: no path is shorter; INFINITY where there is none
} tl_nav_world_route;

/// A route from point to point over the whole world, with bounds of the length of the shortest path.
///
/// From point to point the route's length is that of the shortest path within one place, or one block. What is in
/// memory beside the tiles of both ends does not matter, and neither does the frame, up to rounding. Writes the first
/// `capacity` points; TL_INCOMPLETE: there are more. TL_ERR_STALE, TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT (the router is of
/// another world), TL_ERR_NODES (a tile of an end has more links than the router has nodes).
///
/// Source: nested dissection (George, Nested Dissection of a Regular Finite Element Mesh, 1973) as of customizable
/// contraction hierarchies (Dibbelt, Strasser, Wagner, 2016).
TL_API tl_result tl_nav_world_find_route(const tl_nav_world *world, tl_nav_router *router,
                                         const tl_nav_world_route_request *request,
                                         tl_nav_world_route_point *points_out, uint32_t capacity,
                                         tl_nav_world_route *route_out);

#ifdef __cplusplus
}
#endif

#endif
