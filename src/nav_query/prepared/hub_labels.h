// SPDX-License-Identifier: MIT
//
// Hub labels: distances from each corner vertex to some hundred hubs (hub_labels.c).

#ifndef TALUS_SRC_NAV_QUERY_HUB_LABELS_H
#define TALUS_SRC_NAV_QUERY_HUB_LABELS_H

#include "nav_query/prepared/path_ends.h"

/// The rank of a hub, and above these bits; below, the first edge of a shortest path there, counted from its vertex's
/// first edge.
enum { TL_NAV_HUB_EDGE_BITS = 12 };

typedef struct tl_nav_hub {
    uint32_t rank_and_edge;
    float length; ///< metres
} tl_nav_hub;

static inline uint32_t tl_nav_hub_rank(const tl_nav_hub *hub)
{
    return hub->rank_and_edge >> TL_NAV_HUB_EDGE_BITS;
}

static inline uint32_t tl_nav_hub_edge(const tl_nav_hub *hub)
{
    return hub->rank_and_edge & ((1u << TL_NAV_HUB_EDGE_BITS) - 1);
}

/// The labels of all corner vertices.
typedef struct tl_nav_hub_labels {
    uint64_t *first;  ///< [vertex_count + 1]; NULL: there are none
    tl_nav_hub *hubs; ///< by corner vertex, ascending by rank
    uint64_t count;
    uint32_t *vertex; ///< by rank
} tl_nav_hub_labels;

/// Fills in the graph's labels. TL_ERR_LIMIT: they take more than `budget` bytes, or a corner vertex has too many
/// edges. TL_ERR_MEMORY.
tl_result tl_nav_bake_hub_labels(const tl_allocator *allocator, const tl_host *host, tl_nav_visibility_graph *graph,
                                 uint64_t budget);
/// Bytes that the labels take.
uint64_t tl_nav_hub_labels_size(const tl_nav_visibility_graph *graph);
void tl_nav_free_hub_labels(const tl_allocator *allocator, tl_nav_visibility_graph *graph);

/// The best pair of legs by the labels. Raises the legs' totals by landmarks. `to_hub`: scratch, [vertex_count].
tl_nav_meeting tl_nav_best_by_labels(const tl_nav_visibility_graph *graph, tl_nav_ends *ends, float *to_hub);
/// The corner vertices on the path of a pair, the last one first. Returns their number; UINT32_MAX: more than capacity.
uint32_t tl_nav_unpack_labels(const tl_nav_visibility_graph *graph, const tl_nav_meeting *meeting, uint64_t *vertices,
                              uint32_t capacity);

#endif
