// SPDX-License-Identifier: MIT
//
// The query object: the memory of searches, of which one at a time is under way.
//
// Memory stands in blocks of max_nodes items. Each search uses the blocks that it needs, under a name of its own; what
// an earlier search left there is overwritten, and told apart by a generation where tables are not cleared.
//
// A query begins with little memory. A search that is out of nodes doubles it and begins anew (tl_nav_query_grow),
// until it has the nodes that the query was made for: all searches that begin anew take less time together than the
// last one.

#ifndef TALUS_SRC_NAV_QUERY_QUERY_H
#define TALUS_SRC_NAV_QUERY_QUERY_H

#include "base/radix_sort.h"
#include "nav_query/filter/nav_filter.h"

#include <talus/nav_query.h>

#define TL_NAV_NO_NODE UINT32_MAX

typedef struct tl_nav_node tl_nav_node;             // node_pool.h
typedef struct tl_nav_wedge tl_nav_wedge;           // wedge.h
typedef struct tl_nav_local_node tl_nav_local_node; // local_search.h
typedef struct tl_nav_root tl_nav_root;             // root_table.h
typedef struct tl_nav_stop tl_nav_stop;             // prepared/graph_search.h
typedef struct tl_nav_corner_leg tl_nav_corner_leg; // prepared/path_ends.h
typedef struct tl_nav_path_run tl_nav_path_run;     // path/path_run.h

/// Bytes of items that only searches of later rooms know. 0: the query has none.
typedef struct tl_nav_query_sizes {
    size_t stop; ///< tl_nav_stop
    size_t run;  ///< tl_nav_path_run
} tl_nav_query_sizes;

struct tl_nav_query {
    tl_allocator allocator;
    tl_nav_query_sizes sizes;
    uint32_t max_nodes;  ///< that there is memory for
    uint32_t node_limit; ///< that max_nodes may grow to
    bool is_short;       ///< a search over the visibility graph was out of nodes

    // The node pool (node_pool.h): A* over ways into polygons, floods, the wide search.
    tl_nav_node *nodes;
    uint32_t *buckets; ///< bucket_count is a power of two
    uint64_t *heap;    ///< [max_nodes]: open nodes of the pool with their totals (node_heap.c)
    uint32_t node_count;
    uint32_t bucket_count;
    uint32_t heap_count;
    uint64_t at_hand;         ///< an item of the heap that is kept beside it, or TL_NAV_NONE_AT_HAND
    uint64_t pool_generation; ///< counts resets

    /// [max_nodes] items as large as a wedge.
    union {
        tl_nav_wedge *wedges;           ///< of an exact search
        tl_nav_local_node *local_nodes; ///< of a search around a place (local_search.h)
        tl_nav_corner_leg *legs;        ///< from both ends of a path to corner vertices
        tl_sort_item *sort_items;       ///< of a flood's nodes (around/field.c), and as many for scratch
        double *area_sums;              ///< by a flood's node (around/random_reachable.c)
        void *wide_memory;              ///< whatever a wide search takes (wide/clearance.h)
    };
    uint64_t item_bytes;  ///< of that block in all
    uint32_t wedge_count; ///< wedges or local nodes in use
    /// [max_nodes] numbers of 64 bits.
    union {
        uint64_t *open;      ///< a heap of open wedges, local nodes or stops (open_items.h)
        uint64_t *link_ends; ///< by a flood's node: the end of the off-mesh link by which it was entered
        double *part_sums;   ///< by a flood's node, once links are done with (around/random_reachable.c)
        uint64_t *on_path;   ///< corner vertices of a path, the last one first
    };
    uint32_t open_count; ///< of the heap

    tl_nav_stop *stops; ///< [max_nodes]: corner vertices that a search over the visibility graph has reached
    uint32_t stop_count;

    // The table of roots (root_table.h).
    tl_nav_root *roots;    ///< [root_mask + 1], more than wedges
    uint32_t root_mask;    ///< a power of two - 1
    uint32_t root_count;   ///< entries of this generation
    uint32_t repeat_count; ///< entries of this generation that are corners turned at, at most half as many as nodes
    uint32_t generation;   ///< of the search that wrote an entry

    tl_nav_path_run *run; ///< a path search in slices
    tl_nav_known_costs known_costs;
};

#endif
