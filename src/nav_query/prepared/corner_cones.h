// SPDX-License-Identifier: MIT
//
// Visibility cones of corner vertices, by polygon (corner_cones.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_CONES_H
#define TALUS_SRC_NAV_QUERY_CORNER_CONES_H

#include "base/stage.h"
#include "nav_query/prepared/path_ends.h"
#include "nav_query/search/wedge.h"

typedef struct tl_nav_graph_reuse tl_nav_graph_reuse; // graph_reuse.h

/// So many cones are tested at once.
enum { TL_NAV_CONES_AT_ONCE = 8 };

/// The cones from which a path may go straight to a corner vertex and turn there, by polygon. Point (x, z) is in cone i
/// when left_x * z - left_z * x >= left_min, and the same on the right. The arrays have TL_NAV_CONES_AT_ONCE more
/// entries than cones, so that a whole batch can be read.
typedef struct tl_nav_corner_cones {
    uint32_t *first; ///< [polygon_count + 1]
    float *left_x, *left_z, *left_min;
    float *right_x, *right_z, *right_min;
    uint32_t *vertex;
    uint32_t count;
    uint64_t size; ///< of the block, in floats
    float *block;  ///< that all arrays but the first stand in
} tl_nav_corner_cones;

/// A cone as it is found: between two directions from a corner vertex, in one polygon.
typedef struct tl_nav_corner_cone {
    uint32_t slot, polygon;
    uint32_t vertex;
    int side; ///< to which a path turns there: 1 left, -1 right
    float right_x, right_z, left_x, left_z;
} tl_nav_corner_cone;

typedef struct tl_nav_cone_list {
    const tl_allocator *allocator;
    tl_nav_corner_cone *cones;
    uint64_t count, capacity;
} tl_nav_cone_list;

/// Adds the cones of a wedge that is seen from a corner vertex. TL_ERR_MEMORY.
tl_result tl_nav_add_cones(tl_nav_cone_list *list, const tl_nav_visibility_graph *graph, uint32_t vertex,
                           const tl_nav_wedge *wedge);
/// Puts the cones into the graph, by polygon, behind those that are reused. TL_ERR_MEMORY, TL_ERR_LIMIT; the graph
/// keeps what tl_nav_free_cones frees.
tl_result tl_nav_group_cones(tl_nav_cone_list *list, const tl_navmesh *navmesh, tl_nav_visibility_graph *graph,
                             const tl_nav_graph_reuse *reuse, tl_stage *stage);
void tl_nav_free_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// The corner vertices whose cones hold the start, and those whose cones hold the goal. False: the query is too small.
bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                      tl_nav_ends *ends_out);

#endif
