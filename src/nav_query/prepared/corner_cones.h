// SPDX-License-Identifier: MIT
//
// Visibility cones of corner vertices, by polygon (corner_cones.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_CONES_H
#define TALUS_SRC_NAV_QUERY_CORNER_CONES_H

#include "base/stage.h"
#include "nav_query/prepared/path_ends.h"
#include "nav_query/search/wedge.h"

typedef struct tl_nav_graph_reuse tl_nav_graph_reuse; // graph_reuse.h

/// So many cones are tested at once: more than loops that compilers write out, and so leave without vectors.
enum { TL_NAV_CONES_AT_ONCE = 24 };

/// Of a graph, at most: a corner vertex's number shares a word with a cone's slack.
#define TL_NAV_MAX_CORNER_VERTICES (1u << 24)

/// Steps of the larger component of a cone's direction.
#define TL_NAV_CONE_STEPS 32767.0

/// The cones from which a path may go straight to a corner vertex and turn there, by polygon: 12 bytes each. A cone is
/// two directions from its vertex in whole steps, and a slack for their rounding (corner_cones.c). The arrays have
/// TL_NAV_CONES_AT_ONCE more entries than cones, so that a whole batch can be read.
typedef struct tl_nav_corner_cones {
    uint32_t *first; ///< [polygon_count + 1]
    int16_t *left_x, *left_z, *right_x, *right_z;
    uint32_t *vertex; ///< its corner vertex, and in the high 8 bits the code of its slack
    uint32_t count;
    uint64_t places; ///< of each array
    uint32_t *block; ///< that all arrays but the first stand in
} tl_nav_corner_cones;

/// Bytes of the cones, and of where they stand.
static inline uint64_t tl_nav_cones_size(const tl_nav_corner_cones *cones, uint32_t polygon_count)
{
    return ((uint64_t)polygon_count + 1) * sizeof *cones->first + 3 * cones->places * sizeof *cones->block;
}

static inline uint32_t tl_nav_cone_vertex(const tl_nav_corner_cones *cones, uint32_t cone)
{
    return cones->vertex[cone] & (TL_NAV_MAX_CORNER_VERTICES - 1);
}

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
