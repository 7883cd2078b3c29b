// SPDX-License-Identifier: MIT
//
// The nodes of a search: a fixed pool with a hash table from keys, and the heap of open ones.

#ifndef TALUS_SRC_NAV_QUERY_NODE_POOL_H
#define TALUS_SRC_NAV_QUERY_NODE_POOL_H

#include <talus/nav_query.h>

#define TL_NAV_NO_NODE UINT32_MAX

// Values of tl_nav_node.heap_at beside places in the heap.
#define TL_NAV_NODE_NEW    UINT32_MAX
#define TL_NAV_NODE_CLOSED (UINT32_MAX - 1u)

/// A way into a polygon.
typedef struct tl_nav_node {
    uint64_t key;
    tl_vec3 point; ///< where the polygon is entered
    float cost;    ///< from the start to point
    float total;   ///< cost and estimate to the goal: what the heap is ordered by
    uint32_t parent;
    uint32_t slot, polygon; ///< that is entered
    uint32_t heap_at;
    uint32_t next; ///< in the chain of its bucket
} tl_nav_node;

typedef struct tl_nav_wedge tl_nav_wedge;       // shortest_search.h
typedef struct tl_nav_path_run tl_nav_path_run; // path_run.h

typedef struct tl_nav_heap_entry {
    float total;
    uint32_t wedge;
} tl_nav_heap_entry;

/// A corner vertex that a search over the visibility graph has reached (graph_search.c).
typedef struct tl_nav_stop {
    double cost;    ///< metres from the start
    double to_goal; ///< metres straight to the goal, where that may be seen; < 0: it is not
    float total;    ///< cost and guess
    float guess;    ///< metres to the goal, at least; < 0: not asked for yet
    uint32_t vertex;
    uint32_t parent; ///< stop; TL_NAV_NO_NODE: the start
    bool is_start;   ///< not the corner vertex's own: whether the start sees it is not known yet
    bool is_guessed; ///< landmarks were asked
} tl_nav_stop;

/// A vertex where an exact search has turned (root_table.h).
typedef struct tl_nav_root {
    uint64_t number;
    uint32_t generation; ///< of the search that wrote the entry
    union {
        float cost;    ///< metres from the start
        uint32_t stop; ///< of a corner vertex
    };
    // Of a corner that is turned at: what `cost` lost when it was rounded, and the root from which that way came.
    float cost_rest, from_x, from_z;
} tl_nav_root;

struct tl_nav_query {
    tl_allocator allocator;
    tl_nav_wedge *wedges; ///< [max_nodes]
    uint64_t *wedge_heap; ///< [max_nodes] (wedge_heap.h)
    tl_nav_stop *stops;   ///< [max_nodes]
    tl_nav_root *roots;   ///< [root_mask + 1], more than wedges
    uint32_t root_mask;
    uint32_t repeat_count; ///< entries of this generation that are corners turned at, at most half as many as nodes
    uint32_t stop_count;
    uint32_t wedge_count, open_count; ///< of wedges, and of entries of wedge_heap
    uint32_t generation;
    tl_nav_node *nodes;
    uint32_t *buckets; ///< bucket_count is a power of two
    uint32_t *heap;    ///< node indices; children of i at 4i + 1 .. 4i + 4
    uint32_t max_nodes, node_count;
    uint32_t bucket_count;
    uint32_t heap_count;
    uint64_t pool_generation; ///< counts resets
    tl_nav_path_run *run;     ///< in slices
};

/// Forgets all nodes. O(nodes used by the search before).
void tl_nav_pool_reset(tl_nav_query *query);
/// The node of a key, a fresh one if need be, or TL_NAV_NO_NODE when the pool is used up.
uint32_t tl_nav_pool_get(tl_nav_query *query, uint64_t key);

/// Puts a node into the heap, or moves it up after its total has fallen.
void tl_nav_heap_improve(tl_nav_query *query, uint32_t node);
/// Takes out the node of least total, ties to the lower index, and marks it closed. TL_NAV_NO_NODE when
/// empty.
uint32_t tl_nav_heap_pop(tl_nav_query *query);

#endif
