// SPDX-License-Identifier: MIT
//
// The exact shortest path in the plane, from point to point over rings (shortest_search.c).

#ifndef TALUS_SRC_NAV_QUERY_SHORTEST_SEARCH_H
#define TALUS_SRC_NAV_QUERY_SHORTEST_SEARCH_H

#include "nav_query/navmesh/navmesh.h"
#include "nav_query/search/query.h"
#include "nav_query/search/wedge.h"

typedef enum tl_nav_search_end {
    TL_NAV_SEARCH_FOUND,
    TL_NAV_SEARCH_EXHAUSTED,
    TL_NAV_SEARCH_OUT_OF_NODES,
    TL_NAV_SEARCH_PAUSED ///< its steps are used up; it may go on
} tl_nav_search_end;

typedef struct tl_nav_shortest_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter; ///< NULL: all polygons pass
    uint32_t start_slot, start_polygon;
    uint32_t goal_slot, goal_polygon;
    tl_vec3 start, goal; ///< on their polygons
    double weight;       ///< 1 + the filter's slack
    // Found:
    uint32_t last;      ///< wedge, in the goal's polygon
    double lower_bound; ///< no path is shorter
    // Between two steps:
    uint32_t only;                          ///< wedge to go on with, or TL_NAV_NO_NODE
    tl_nav_direction only_right, only_left; ///< ends of the edge that it looks through
    uint32_t best;                          ///< else the best wedge that is not in the heap, or TL_NAV_NO_NODE
    float best_total;
} tl_nav_shortest_search;

/// Begins the search and, when start and goal see one another at once, ends it.
tl_nav_search_end tl_nav_begin_shortest(tl_nav_shortest_search *search);
/// Goes on for at most `*steps` wedges, which are counted down. Where a search is cut into steps changes nothing but
/// the time. Once it is found the wedges, from `last` over parents to the start's, are the path.
tl_nav_search_end tl_nav_step_shortest(tl_nav_shortest_search *search, uint64_t *steps);
/// Both, to the end.
tl_nav_search_end tl_nav_search_shortest(tl_nav_shortest_search *search);

/// Who wants to know what can be seen from a point.
typedef struct tl_nav_sight {
    void (*note)(void *user, uint32_t turn); ///< a vertex is seen at which a path that comes straight to it may turn
    bool (*looks)(void *user, const tl_nav_wedge *wedge); ///< whether it looks on through a wedge; NULL: always
    void *user;
    const tl_nav_ring_walls *walls; ///< on both sides of the start, which is a vertex
} tl_nav_sight;

/// Looks from the start of `from` as far as walls let, in all directions from which a path that comes may turn there;
/// of its other members query and navmesh count, and the filter is NULL. Afterwards the query's wedges hold the
/// polygons that are seen. False: out of nodes.
bool tl_nav_see(tl_nav_shortest_search *from, const tl_nav_sight *sight);

/// Sets a search up for a request, and moves its ends onto their polygons. TL_ERR_ARGUMENT (the filter has no cookie),
/// TL_ERR_NOT_FINITE, TL_ERR_STALE.
tl_result tl_nav_prepare_shortest(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                                  tl_nav_shortest_search *search_out);
/// Whether start and goal lie on two islands.
bool tl_nav_is_cut_off(const tl_nav_shortest_search *search);

// Of a path that was found (wedge_path.c):

/// Metres in the plane.
double tl_nav_shortest_length(const tl_nav_shortest_search *search);
/// Its polygons; returns their number.
uint32_t tl_nav_write_wedge_polygons(const tl_nav_shortest_search *search, tl_nav_ref *polygons, uint32_t capacity);
/// Its corners, their number, and both lengths of `path`.
void tl_nav_write_wedge_corners(const tl_nav_shortest_search *search, tl_nav_corner *corners, uint32_t capacity,
                                tl_nav_shortest_path *path);

#endif
