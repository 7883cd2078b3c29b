// SPDX-License-Identifier: MIT
//
// A scapegoat tree: when a new item lies too deep, the smallest subtree around it that is out of balance is balanced as
// a whole. It wins here because the tree is nearly always empty: it keeps nothing in an item but its links, draws no
// priorities, which an outline could be made for, and what it costs is paid by those that use it.
// Sources: Galperin, Rivest, "Scapegoat trees", 1993; Stout, Warren, "Tree rebalancing in optimal time and space",
// 1986.

#include "polygon/outline/sweep_index.h"

#include "base/lowest_bit.h"

static void replace_child(tl_sweep_index *index, uint32_t parent, uint32_t old, uint32_t item)
{
    if (parent == TL_NO_SEGMENT) {
        index->root = item;
    } else {
        index->items[parent].child[index->items[parent].child[1] == old] = item;
    }
    if (item != TL_NO_SEGMENT) {
        index->items[item].parent = parent;
    }
}

// Rotates an item above its parent.
static void rotate_up(tl_sweep_index *index, uint32_t item)
{
    tl_sweep_item *items = index->items;
    const uint32_t parent = items[item].parent;
    const int side = items[parent].child[1] == item;
    const uint32_t inner = items[item].child[!side];
    replace_child(index, items[parent].parent, parent, item);
    items[parent].child[side] = inner;
    if (inner != TL_NO_SEGMENT) {
        items[inner].parent = parent;
    }
    items[item].child[!side] = parent;
    items[parent].parent = item;
}

// The lowest of a subtree.
static uint32_t find_lowest(const tl_sweep_index *index, uint32_t item)
{
    while (index->items[item].child[0] != TL_NO_SEGMENT) {
        item = index->items[item].child[0];
    }
    return item;
}

// Counts a subtree, in order, along the parents.
static uint32_t count_items(const tl_sweep_index *index, uint32_t top)
{
    if (top == TL_NO_SEGMENT) {
        return 0;
    }
    const tl_sweep_item *items = index->items;
    uint32_t count = 1;
    for (uint32_t item = find_lowest(index, top);; count++) {
        if (items[item].child[1] != TL_NO_SEGMENT) {
            item = find_lowest(index, items[item].child[1]);
            continue;
        }
        while (item != top && items[items[item].parent].child[1] == item) {
            item = items[item].parent;
        }
        if (item == top) {
            return count;
        }
        item = items[item].parent;
    }
}

// Turns a subtree into a vine, where every item is the upper child of the one below it. Returns its lowest item.
static uint32_t make_vine(tl_sweep_index *index, uint32_t top)
{
    uint32_t lowest = TL_NO_SEGMENT;
    for (uint32_t item = top; item != TL_NO_SEGMENT;) {
        const uint32_t below = index->items[item].child[0];
        if (below != TL_NO_SEGMENT) {
            rotate_up(index, below);
            item = below;
            continue;
        }
        lowest = lowest == TL_NO_SEGMENT ? item : lowest;
        item = index->items[item].child[1];
    }
    return lowest;
}

// Rotates the 2nd, 4th, ... of a vine's items above the one before, `count` of them. Returns the vine's new top.
static uint32_t fold_vine(tl_sweep_index *index, uint32_t top, uint32_t count)
{
    uint32_t item = top;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = index->items[item].child[1];
        rotate_up(index, next);
        top = i == 0 ? next : top;
        item = index->items[next].child[1];
    }
    return top;
}

static void balance(tl_sweep_index *index, uint32_t top, uint32_t count)
{
    if (count == 0) {
        return;
    }
    top = make_vine(index, top);
    const uint32_t full = (1u << tl_highest_bit((uint64_t)count + 1)) - 1; // the largest full tree within
    top = fold_vine(index, top, count - full);
    for (uint32_t row = full / 2; row > 0; row /= 2) {
        top = fold_vine(index, top, row);
    }
}

// With more than a share of 1/sqrt(2) of a subtree below one child it is out of balance. An item deeper than 2 log2
// (count) has such a subtree around it.
static bool is_lopsided(uint32_t child_count, uint32_t count)
{
    return 2 * (uint64_t)child_count * child_count > (uint64_t)count * count;
}

static void balance_around(tl_sweep_index *index, uint32_t item)
{
    for (uint32_t count = 1; index->items[item].parent != TL_NO_SEGMENT;) {
        const uint32_t parent = index->items[item].parent;
        const uint32_t sibling = index->items[parent].child[index->items[parent].child[0] == item];
        const uint32_t parent_count = 1 + count + count_items(index, sibling);
        if (is_lopsided(count, parent_count)) {
            balance(index, parent, parent_count);
            return;
        }
        item = parent;
        count = parent_count;
    }
}

void tl_sweep_index_add(tl_sweep_index *index, uint32_t below, uint32_t item)
{
    tl_sweep_item *items = index->items;
    uint32_t parent = below;
    int side = 1;
    const uint32_t beyond = below != TL_NO_SEGMENT ? items[below].child[1] : index->root;
    if (beyond != TL_NO_SEGMENT) {
        parent = find_lowest(index, beyond);
        side = 0;
    }
    items[item].child[0] = items[item].child[1] = TL_NO_SEGMENT;
    items[item].parent = parent;
    if (parent == TL_NO_SEGMENT) {
        index->root = item;
    } else {
        items[parent].child[side] = item;
    }
    index->count++;
    index->most = index->most < index->count ? index->count : index->most;
    uint32_t depth = 0;
    for (; parent != TL_NO_SEGMENT; parent = items[parent].parent) {
        depth++;
    }
    if (depth >= 2 * (tl_highest_bit(index->most) + 1)) {
        balance_around(index, item);
    }
}

void tl_sweep_index_remove(tl_sweep_index *index, uint32_t item)
{
    tl_sweep_item *i = &index->items[item];
    if (i->child[0] != TL_NO_SEGMENT && i->child[1] != TL_NO_SEGMENT) {
        // The next one above, which has nothing below it, takes its place.
        const uint32_t next = find_lowest(index, i->child[1]);
        replace_child(index, index->items[next].parent, next, index->items[next].child[1]);
        replace_child(index, i->parent, item, next);
        for (int side = 0; side < 2; side++) {
            index->items[next].child[side] = i->child[side];
            if (i->child[side] != TL_NO_SEGMENT) {
                index->items[i->child[side]].parent = next;
            }
        }
    } else {
        replace_child(index, i->parent, item, i->child[i->child[0] == TL_NO_SEGMENT]);
    }
    i->parent = TL_NOT_INDEXED;
    if (--index->count < index->most / 2) {
        balance(index, index->root, index->count);
        index->most = index->count;
    }
}
