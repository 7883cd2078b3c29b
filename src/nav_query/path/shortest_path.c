// SPDX-License-Identifier: MIT
//
// The shortest path from point to point: by the visibility graph of a prepared navmesh, else by an exact search.

#include "base/assert.h"
#include "nav_query/exact/shortest_search.h"
#include "nav_query/path/path_run.h"
#include "nav_query/prepared/graph_query.h"
#include "nav_query/search/query_memory.h"

#include <math.h>
#include <string.h>

// A buffer that is left out has capacity 0.
static tl_result fits(const tl_nav_shortest_path *path, const tl_nav_path_buffers *buffers)
{
    bool all = (buffers->corner_capacity == 0 || path->corner_count <= buffers->corner_capacity) &&
               (buffers->polygon_capacity == 0 || path->polygon_count <= buffers->polygon_capacity);
    return all ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_nav_query_find_shortest_path(tl_nav_query *query, const tl_navmesh *navmesh,
                                          const tl_nav_path_request *request, const tl_nav_path_buffers *buffers,
                                          tl_nav_shortest_path *path_out)
{
    static const tl_nav_path_buffers none = { NULL, 0, NULL, 0 };
    const tl_nav_path_buffers *wanted = buffers != NULL ? buffers : &none;
    if (query == NULL || navmesh == NULL || request == NULL || path_out == NULL || !tl_nav_are_buffers(wanted)) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    tl_nav_shortest_search search;
    TL_TRY(tl_nav_prepare_shortest(query, navmesh, request, &search));
    path_out->status = TL_NAV_PATH_UNREACHABLE;
    if (tl_nav_is_cut_off(&search)) {
        return TL_OK;
    }
    const tl_nav_visibility_graph *graph = tl_nav_visibility_graph_for(&search);
    if (graph != NULL && tl_nav_find_over_graph(&search, graph, wanted, path_out)) {
        return fits(path_out, wanted);
    }
    memset(path_out, 0, sizeof *path_out);
    path_out->status = TL_NAV_PATH_UNREACHABLE;
    tl_nav_search_end end;
    do {
        end = tl_nav_search_shortest(&search);
    } while (end == TL_NAV_SEARCH_OUT_OF_NODES && tl_nav_query_grow(query));
    path_out->node_count = query->wedge_count;
    if (end != TL_NAV_SEARCH_FOUND) {
        path_out->status = end == TL_NAV_SEARCH_EXHAUSTED ? TL_NAV_PATH_UNREACHABLE : TL_NAV_PATH_OUT_OF_NODES;
        return TL_OK;
    }
    path_out->status = TL_NAV_PATH_COMPLETE;
    tl_nav_write_wedge_corners(&search, wanted->corners, wanted->corner_capacity, path_out);
    path_out->polygon_count = tl_nav_write_wedge_polygons(&search, wanted->polygons, wanted->polygon_capacity);
    path_out->lower_bound = fmin(search.lower_bound, path_out->length);
    return fits(path_out, wanted);
}
