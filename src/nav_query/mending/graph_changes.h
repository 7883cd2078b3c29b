// SPDX-License-Identifier: MIT
//
// What edits since a visibility graph was mended last have changed of it (graph_changes.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_CHANGES_H
#define TALUS_SRC_NAV_QUERY_GRAPH_CHANGES_H

#include "nav_query/prepared/visibility_graph.h"

/// What a corner vertex is to a mend (tl_nav_visibility_graph.marks).
enum {
    TL_NAV_MARK_NONE,
    TL_NAV_MARK_LOOKS, ///< it may see something else now
    TL_NAV_MARK_FRESH, ///< it is new; its number may have been another's
    TL_NAV_MARK_GONE
};

/// What a slot is to a mend, as bits.
#define TL_NAV_SLOT_OTHER  1u ///< its tile came, went, or is another
#define TL_NAV_SLOT_EDITED 2u ///< its tile stayed, but polygons at its border may have changed
#define TL_NAV_SLOT_CONES  4u ///< cones of its polygons go or come
#define TL_NAV_SLOT_SIGHTS 8u ///< edges or reaches of corner vertices whose fans begin in it do

typedef struct tl_nav_number_list {
    uint32_t *numbers;
    uint64_t count, capacity;
} tl_nav_number_list;

/// TL_ERR_MEMORY.
tl_result tl_nav_add_number(const tl_allocator *allocator, tl_nav_number_list *list, uint32_t number);
void tl_nav_free_numbers(const tl_allocator *allocator, tl_nav_number_list *list);

typedef struct tl_nav_graph_changes {
    const tl_navmesh *navmesh;
    const tl_allocator *allocator;
    tl_nav_visibility_graph *graph;
    uint8_t *slot_bits;       ///< [graph->slot_count]
    tl_nav_number_list slots; ///< that have any bits
    /// Corner vertices that look around: those that were there, and, from `first_fresh` on, new ones.
    tl_nav_number_list lookers;
    uint64_t first_fresh;
    tl_nav_number_list gone;
} tl_nav_graph_changes;

/// Compares the graph with the navmesh. Corner vertices whose names are no more leave it, new ones enter it without
/// edges, and marks tell which look around. TL_ERR_MEMORY, TL_ERR_LIMIT: the graph can only be freed.
/// tl_nav_free_changes frees what is returned, after an error too.
tl_result tl_nav_find_changes(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph,
                              tl_nav_graph_changes *changes_out);
/// Takes the marks away, and notes the tiles that are there.
void tl_nav_settle_changes(const tl_nav_graph_changes *changes);
void tl_nav_free_changes(tl_nav_graph_changes *changes);

/// Sets bits of a slot. TL_ERR_MEMORY.
tl_result tl_nav_note_slot(tl_nav_graph_changes *changes, uint32_t slot, uint32_t bits);

#endif
