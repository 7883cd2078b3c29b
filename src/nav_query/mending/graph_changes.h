// SPDX-License-Identifier: MIT
//
// What edits since a visibility graph was mended last have changed of it (graph_changes.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_CHANGES_H
#define TALUS_SRC_NAV_QUERY_GRAPH_CHANGES_H

#include "nav_query/mending/number_lists.h"
#include "nav_query/prepared/visibility_graph.h"

/// What a corner vertex is to a mend (tl_nav_visibility_graph.marks).
enum {
    TL_NAV_MARK_NONE,
    TL_NAV_MARK_LOOKS, ///< it may see something else now, in the directions of the change
    TL_NAV_MARK_WHOLE, ///< the same all around
    TL_NAV_MARK_FRESH, ///< it is new; its number may have been another's
    TL_NAV_MARK_GONE
};

/// What a slot is to a mend, as bits.
#define TL_NAV_SLOT_OTHER  1u  ///< its tile came, went, or has nothing in common with the one before
#define TL_NAV_SLOT_EDITED 2u  ///< some of its polygons are what they were
#define TL_NAV_SLOT_CONES  4u  ///< cones of its polygons go or come
#define TL_NAV_SLOT_SIGHTS 8u  ///< edges or reaches of corner vertices whose fans begin in it do
#define TL_NAV_SLOT_MAPPED 16u ///< its polygons have other numbers than before: tl_nav_new_polygon

typedef struct tl_nav_gone_spot {
    float x, z;
} tl_nav_gone_spot;

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
    tl_nav_gone_spot *gone_spots; ///< by place in `gone`: where they were
    tl_nav_pair_list gone_sights; ///< corner vertex that looks, and one in `gone`, by its place there, that it saw
    /// Slot that was edited, and polygon there that came or may have changed. The same of polygons that were there
    /// before, by their old numbers.
    tl_nav_pair_list polygons, old_polygons;
    tl_nav_number_list map; ///< of mapped slots one after another: by old polygon the new one, or TL_NO_POLYGON
    uint32_t *first_map;    ///< [graph->slot_count], by mapped slot: where its part begins
} tl_nav_graph_changes;

/// Compares the graph with the navmesh. Corner vertices whose names are no more leave it, new ones enter it without
/// edges, and marks tell which look around. TL_ERR_MEMORY, TL_ERR_LIMIT: the graph can only be freed.
/// tl_nav_free_changes frees what is returned, after an error too.
tl_result tl_nav_find_changes(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph,
                              tl_nav_graph_changes *changes_out);
/// Takes the marks away, and notes the tiles that are there. TL_ERR_MEMORY: the graph can only be freed.
tl_result tl_nav_settle_changes(const tl_nav_graph_changes *changes);
void tl_nav_free_changes(tl_nav_graph_changes *changes);

/// The number now of a polygon that a slot had, or TL_NO_POLYGON. The slot is not of another tile.
static inline uint32_t tl_nav_new_polygon(const tl_nav_graph_changes *changes, uint32_t slot, uint32_t polygon)
{
    return (changes->slot_bits[slot] & TL_NAV_SLOT_MAPPED) != 0
               ? changes->map.numbers[changes->first_map[slot] + polygon]
               : polygon;
}

/// By polygon of a slot the number that it had, or TL_NO_POLYGON; NULL: as now.
static inline const uint32_t *tl_nav_old_polygons(const tl_nav_graph_changes *changes, uint32_t slot)
{
    return (changes->slot_bits[slot] & TL_NAV_SLOT_MAPPED) != 0
               ? changes->map.numbers + changes->first_map[slot] + changes->graph->tiles[slot].rings.polygon_count
               : NULL;
}

/// The number that a polygon had, or TL_NO_POLYGON: it came.
static inline uint32_t tl_nav_old_polygon(const tl_nav_graph_changes *changes, uint32_t slot, uint32_t polygon)
{
    const uint32_t *old = tl_nav_old_polygons(changes, slot);
    return (changes->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0 ? TL_NO_POLYGON : old != NULL ? old[polygon] : polygon;
}

/// Sets bits of a slot. TL_ERR_MEMORY.
tl_result tl_nav_note_slot(tl_nav_graph_changes *changes, uint32_t slot, uint32_t bits);

#endif
