// SPDX-License-Identifier: MIT
//
// The polygons of each edge of the visibility graph, kept (kept_legs.c).

#ifndef TALUS_SRC_NAV_QUERY_KEPT_LEGS_H
#define TALUS_SRC_NAV_QUERY_KEPT_LEGS_H

#include <talus/nav_query.h>

typedef struct tl_nav_visibility_graph tl_nav_visibility_graph;

/// No place in a fan: the edge's polygons are not kept.
#define TL_NAV_NO_PLACE UINT8_MAX

/// Of a leg from a corner vertex to another.
typedef struct tl_nav_kept_leg {
    uint32_t first;   ///< of its polygons; they end where the next leg's begin
    uint8_t enters;   ///< the place, in the fan of the vertex that it leaves, of its first polygon, or TL_NAV_NO_PLACE
    uint8_t arrives;  ///< the place, in the fan of the vertex that it comes to, of its last one
    uint16_t padding; ///< 0
} tl_nav_kept_leg;

typedef struct tl_nav_kept_legs {
    tl_nav_kept_leg *legs; ///< [edge_count + 1], of the edges of one corner vertex after another; NULL: none are kept
    uint32_t *leg_first;   ///< [vertex_room], by corner vertex
    tl_nav_ref *polygons;  ///< [polygon_count] of legs
    uint32_t *fan_first;   ///< [vertex_room + 1]
    tl_nav_ref *fans;      ///< [fan_count]: the polygons around each corner vertex, from wall to wall, turning left
    uint64_t polygon_count, fan_count;
} tl_nav_kept_legs;

/// Walks along every edge of the graph. TL_ERR_MEMORY; then nothing is kept.
tl_result tl_nav_keep_legs(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph);
void tl_nav_free_legs(const tl_allocator *allocator, tl_nav_visibility_graph *graph);
uint64_t tl_nav_kept_legs_size(const tl_nav_visibility_graph *graph);

#endif
