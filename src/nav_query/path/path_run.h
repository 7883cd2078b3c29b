// SPDX-License-Identifier: MIT
//
// A path search under way: find_path.c runs it to its end, sliced_path.c in slices.

#ifndef TALUS_SRC_NAV_QUERY_PATH_RUN_H
#define TALUS_SRC_NAV_QUERY_PATH_RUN_H

#include "nav_query/exact/shortest_search.h"
#include "nav_query/search/node_pool.h"

/// Whether each buffer is there that has a capacity.
static inline bool tl_nav_are_buffers(const tl_nav_path_buffers *buffers)
{
    return (buffers->polygons != NULL || buffers->polygon_capacity == 0) &&
           (buffers->corners != NULL || buffers->corner_capacity == 0);
}

/// A* over ways into polygons.
typedef struct tl_nav_way_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    const tl_nav_filter *refuses; ///< the same, or NULL: it refuses no polygon
    float min_cost;               ///< of a metre
    float weight;                 ///< 1 + the filter's slack
    uint32_t goal_slot, goal_polygon;
    tl_vec3 goal;
    float detour; ///< metres from the goal to the nearest end of a short cut; INFINITY: there is no short cut
    bool out_of_nodes;
    uint32_t last;            ///< the goal's node, once it is found
    bool leaves_out_branches; ///< that do not hold the goal
} tl_nav_way_search;

typedef enum tl_nav_run_stage {
    TL_NAV_RUN_NONE,    ///< nothing was begun
    TL_NAV_RUN_CUT_OFF, ///< start and goal lie on two islands
    TL_NAV_RUN_EXACT,   ///< the shortest path is sought
    TL_NAV_RUN_WAYS     ///< A* runs
} tl_nav_run_stage;

struct tl_nav_path_run {
    tl_nav_run_stage stage;
    tl_nav_path_status status; ///< TL_NAV_PATH_UNFINISHED while there is more to do
    tl_nav_location start, goal;
    tl_nav_shortest_search exact;
    tl_nav_way_search ways;
    // Of a run in slices:
    tl_nav_filter filter;     ///< the caller's, copied
    int32_t stale_x, stale_z; ///< TL_NAV_PATH_STALE: the tile
    uint64_t edits;           ///< of the navmesh, up to which all nodes are known to be whole
    uint32_t generation;      ///< of the query's wedges,
    uint64_t pool_generation; ///< and of its nodes: another search since would have taken them
};

/// Begins. Errors as those of tl_nav_query_find_path; then nothing runs. The request's filter must outlive the run.
tl_result tl_nav_run_begin(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request,
                           tl_nav_path_run *run);
/// Continues for at most `*steps` nodes, which are counted down.
void tl_nav_run_step(tl_nav_path_run *run, uint64_t *steps);
/// The path as far as it is known.
tl_result tl_nav_run_write(const tl_nav_path_run *run, tl_nav_ref *polygons_out, uint32_t capacity,
                           tl_nav_path *path_out);

#endif
