// SPDX-License-Identifier: MIT
//
// The segments on a sweep line: a list in order, and a search tree over those of them that searches needed.

#ifndef TALUS_SRC_POLYGON_SWEEP_INDEX_H
#define TALUS_SRC_POLYGON_SWEEP_INDEX_H

#include "polygon/outline/lattice_point.h"
#include "polygon/outline/sweep.h"

/// Parents of segments that are not on the line, and of those that are in the list alone.
#define TL_NOT_ON_LINE (TL_NO_SEGMENT - 1)
#define TL_NOT_INDEXED (TL_NO_SEGMENT - 2)

/// Its ends are named by where they lie, for no two points lie at one place: so nothing but items is read on the way.
typedef struct tl_sweep_item {
    uint32_t child[2];           // in the tree: below, above
    uint32_t parent;             // in the tree; TL_NO_SEGMENT for its root
    uint32_t neighbour[2];       // in the list: next below, next above
    tl_lattice_point begin, end; // `begin` first on the sweep's way
} tl_sweep_item;

typedef struct tl_sweep_index {
    tl_sweep_item *items; // [segment]
    uint32_t root;
    uint32_t count; // of items in the tree
    uint32_t most;  // of items in it since it was balanced as a whole
} tl_sweep_index;

/// Adds an item of the list, TL_NOT_INDEXED until now, behind the next one below it that is in the tree, or before all
/// when that is TL_NO_SEGMENT. Amortized O(log count).
void tl_sweep_index_add(tl_sweep_index *index, uint32_t below, uint32_t item);

/// Takes out an item of the tree. Amortized O(log count).
void tl_sweep_index_remove(tl_sweep_index *index, uint32_t item);

#endif
