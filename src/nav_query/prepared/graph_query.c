// SPDX-License-Identifier: MIT
//
// The shortest path on a prepared navmesh: the straight line where it arrives, else one over corner vertices.
//
// With the table of distances nothing is searched: of the corner vertices in whose visibility cones the start and the
// goal lie, the pair with the shortest path is the answer. The path is read off by walking along its legs; a first or
// last leg that rounding alone put into a cone is struck out, and the next best pair taken. No distance is too long, so
// the first path that can be walked is the shortest of all. Source: Shen, Cheema, Harabor, Stuckey, Euclidean
// Pathfinding with Compressed Path Databases, IJCAI 2020.

#include "nav_query/prepared/graph_query.h"
#include "nav_query/prepared/corner_distances.h"
#include "nav_query/prepared/graph_path.h"
#include "nav_query/prepared/graph_search.h"
#include "nav_query/search/query_memory.h"
#include "nav_query/search/root_table.h"

#include <string.h>

// By the table of all lengths. False: no pair can be walked, or there is no room.
static bool find_by_table(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph, tl_nav_ends *ends,
                          const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out)
{
    tl_nav_query *query = search->query;
    for (uint32_t tries = 0; tries < ends->start_count + ends->goal_count; tries++) {
        const tl_nav_meeting best = tl_nav_best_by_table(graph, ends);
        const uint32_t count =
            best.start != NULL ? tl_nav_unpack_table(graph, &best, query->on_path, query->max_nodes) : UINT32_MAX;
        if (count == UINT32_MAX) {
            query->is_short = query->is_short || best.start != NULL;
            return false;
        }
        // Five roundings a leg, three of what is known, three of sums.
        search->lower_bound = (double)best.length * (1.0 - (double)TL_FLOAT_GAMMA(11));
        uint32_t blocked = tl_nav_write_graph_path(search, graph, query->on_path, count, room, path_out);
        if (blocked == UINT32_MAX) {
            path_out->node_count = ends->start_count + ends->goal_count;
            return true;
        }
        if (blocked != 0 && blocked != count) {
            return false;
        }
        *(blocked == 0 ? best.start : best.goal) = (tl_nav_corner_leg){ 0, INFINITY, INFINITY };
    }
    return false;
}

// Whether the goal is seen from the start; the path is then written. `*is_unclear_out`: it cannot be told.
static bool write_straight(const tl_nav_shortest_search *search, const tl_nav_line *line,
                           const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out, bool *is_unclear_out)
{
    const tl_navmesh *navmesh = search->navmesh;
    tl_nav_trail trail = { room->polygons, room->polygon_capacity, 0, 0, 0 };
    bool is_one_polygon = search->start_slot == search->goal_slot && search->start_polygon == search->goal_polygon;
    if (is_one_polygon) {
        tl_nav_add_to_trail(&trail, navmesh, search->goal_slot, search->goal_polygon);
    } else {
        tl_nav_line_end end = tl_nav_walk_line(line, search->start_slot, search->start_polygon, &trail);
        // Two polygons may hold the same place, and no line leads from one to the other.
        *is_unclear_out = end == TL_NAV_LINE_UNCLEAR || (line->on_x == 0.0 && line->on_z == 0.0);
        if (end != TL_NAV_LINE_ARRIVES) {
            return false;
        }
    }
    const tl_nav_corner corners[2] = {
        { search->start, tl_nav_make_ref(navmesh, search->start_slot, search->start_polygon), TL_NAV_CORNER_START,
          TL_NAV_NO_REF },
        { search->goal, tl_nav_make_ref(navmesh, search->goal_slot, search->goal_polygon), TL_NAV_CORNER_END,
          TL_NAV_NO_REF },
    };
    for (uint32_t i = 0; i < 2 && i < room->corner_capacity; i++) {
        room->corners[i] = corners[i];
    }
    path_out->status = TL_NAV_PATH_COMPLETE;
    path_out->corner_count = 2;
    path_out->polygon_count = trail.count;
    path_out->length = sqrt(line->on_x * line->on_x + line->on_z * line->on_z);
    path_out->lower_bound = path_out->length;
    path_out->surface_length = (double)tl_distance(search->start, search->goal);
    return true;
}

bool tl_nav_find_over_graph(tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                            const tl_nav_path_buffers *room, tl_nav_shortest_path *path_out)
{
    double x = (double)search->start.x;
    double z = (double)search->start.z;
    tl_nav_line line = { search->navmesh,
                         x,
                         z,
                         (double)search->goal.x - x,
                         (double)search->goal.z - z,
                         0,
                         search->goal_slot,
                         search->goal_polygon,
                         tl_nav_line_rounding(search, graph) };
    bool is_unclear = false;
    if (write_straight(search, &line, room, path_out, &is_unclear)) {
        return true;
    }
    if (is_unclear) {
        return false;
    }
    // From here on the query's memory is used: a search in slices that was under way is no more.
    tl_nav_query *query = search->query;
    bool is_found;
    do {
        tl_nav_ends ends;
        tl_nav_next_generation(query);
        query->is_short = false;
        is_found =
            tl_nav_find_ends(search, graph, &ends) &&
            ((graph->table != NULL && find_by_table(search, graph, &ends, room, path_out)) ||
             (tl_nav_find_ends(search, graph, &ends) && tl_nav_search_graph(search, graph, &ends, room, path_out)));
    } while (!is_found && query->is_short && tl_nav_query_grow(query));
    return is_found;
}
