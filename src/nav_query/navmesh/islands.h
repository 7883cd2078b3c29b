// SPDX-License-Identifier: MIT
//
// Islands: connected components over all tiles, as labels of each tile's own components (islands.c, island_split.c).

#ifndef TALUS_SRC_NAV_QUERY_ISLANDS_H
#define TALUS_SRC_NAV_QUERY_ISLANDS_H

#include "nav_query/history/history.h"

#include <talus/nav_query.h>

/// No node, no piece.
#define TL_NAV_NO_ISLAND UINT32_MAX

/// What connects the components.
typedef enum tl_nav_island_kind {
    TL_NAV_SEAM_ISLANDS, ///< seams alone
    TL_NAV_ISLANDS,      ///< seams and off-mesh links
    TL_NAV_ISLAND_KINDS
} tl_nav_island_kind;

/// A connected component within a tile.
typedef struct tl_nav_island_node {
    uint32_t slot, polygon; ///< one of its polygons
    uint32_t labels[TL_NAV_ISLAND_KINDS];
    uint32_t piece; ///< of the search under way: that has found it, or TL_NAV_NO_ISLAND
    uint32_t next;  ///< of that piece; of a free node: the next free one
} tl_nav_island_node;

/// A name that nodes have; names that came to be one form a tree, and its root is the name.
typedef struct tl_nav_island_label {
    uint32_t parent; ///< itself: the root
    uint32_t size;   ///< labels, of a root; TL_NAV_LABEL_SOUGHT | its first piece while a search is under way
} tl_nav_island_label;

#define TL_NAV_LABEL_SOUGHT 0x80000000u

/// What a search has found from one seed. Pieces that have met are a group, named by the first of them.
typedef struct tl_nav_island_piece {
    uint32_t parent;      ///< in the group's tree; itself: the root
    uint32_t first, last; ///< nodes found
    uint32_t head;        ///< the first of them that was not visited, or TL_NAV_NO_ISLAND
    uint32_t open;        ///< of a root: pieces with such nodes
    uint32_t new_label;   ///< of a root: for a group that is cut off, or TL_NAV_NO_ISLAND
    uint32_t label;       ///< root of the nodes' labels
    uint32_t first_piece; ///< of those with this label
    // Of the first one:
    uint32_t label_size; ///< the label's
    uint32_t groups;     ///< of pieces with this label
    uint32_t open_groups;
} tl_nav_island_piece;

typedef struct tl_nav_islands {
    tl_nav_history *history;                          ///< the navmesh's
    tl_nav_island_node *nodes;                        ///< [capacity]
    tl_nav_island_piece *pieces;                      ///< [seed_capacity]
    uint32_t *seeds;                                  ///< [seed_capacity]: nodes that have lost a way
    tl_nav_island_label *labels[TL_NAV_ISLAND_KINDS]; ///< [tl_nav_label_room]
    uint32_t capacity;
    uint32_t used;       ///< nodes below have been used once
    uint32_t free;       ///< head of the chain of free nodes
    uint32_t free_count; ///< of them
    uint32_t label_count[TL_NAV_ISLAND_KINDS];
    uint32_t most_seams; ///< links over seams that any tile has had
    uint32_t seed_capacity;
    uint32_t seed_count;
    uint32_t seam_seed_count; ///< the first ones, which have lost a way over a seam
} tl_nav_islands;

/// How many labels of each kind there is room for: no fewer than nodes, which is what nodes can have, and some that are
/// used up by edits before all are named anew.
static inline uint64_t tl_nav_label_room(const tl_nav_islands *islands)
{
    return (uint64_t)islands->capacity + islands->capacity / 4;
}

/// Room for `count` more components. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_reserve_islands(tl_navmesh *navmesh, uint32_t count);
/// Room for the seeds of one edit, before a tile has as many links over its seams, or the table of off-mesh links as
/// much room. TL_ERR_MEMORY.
tl_result tl_nav_reserve_seeds(tl_navmesh *navmesh, uint32_t seams, uint32_t offmesh_capacity);
void tl_nav_free_islands(tl_navmesh *navmesh);

/// Names a new slot's components, for which there is room, and joins them to its neighbours'.
void tl_nav_join_islands(tl_navmesh *navmesh, uint32_t slot);
/// Frees the nodes of a slot whose tile leaves, and seeds those that it is linked with over seams. Its links are still
/// there; tl_nav_split_islands is called when they are removed.
void tl_nav_leave_islands(tl_navmesh *navmesh, uint32_t slot);
/// Notes that a polygon has lost an off-mesh link. The other end is noted too, unless it has left.
void tl_nav_seed_island(tl_navmesh *navmesh, uint32_t slot, uint32_t polygon);
/// Gives new labels to components that were split, after links were removed: each of their ends has been seeded.
void tl_nav_split_islands(tl_navmesh *navmesh);

uint32_t tl_nav_island_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon);

struct tl_nav_offmesh_entry;
/// Joins the islands of a link's two anchors.
void tl_nav_join_anchors(tl_navmesh *navmesh, const struct tl_nav_offmesh_entry *entry);
/// Whether a link's anchors are connected without any off-mesh link.
bool tl_nav_is_same_component(const tl_navmesh *navmesh, const struct tl_nav_offmesh_entry *entry);

/// Makes room for `count` new labels, by naming all roots anew where there is none.
void tl_nav_reserve_labels(tl_nav_islands *islands, tl_nav_island_kind kind, uint32_t count);
/// A label of its own; there is room.
uint32_t tl_nav_new_label(tl_nav_islands *islands, tl_nav_island_kind kind);

/// The root of a label.
static inline uint32_t tl_nav_label_root(const tl_nav_island_label *labels, uint32_t label)
{
    while (labels[label].parent != label) {
        label = labels[label].parent;
    }
    return label;
}

#endif
