// SPDX-License-Identifier: MIT
//
// The open items of a search, wedges, local nodes or stops: a heap with four children a node that holds their totals,
// so that a comparison touches no item and is one of integers. Ties go to the older item.

#ifndef TALUS_SRC_NAV_QUERY_OPEN_ITEMS_H
#define TALUS_SRC_NAV_QUERY_OPEN_ITEMS_H

#include "nav_query/search/query.h"

#include <string.h>

#define TL_HEAP(name)                 tl_nav_open_key_##name
#define TL_HEAP_ITEM                  uint64_t
#define TL_HEAP_BEFORE(context, a, b) ((a) < (b))
#define TL_HEAP_ARITY                 4u
#include "base/heap.inl"

typedef struct tl_nav_open_item {
    float total; ///< metres from the start to the goal by way of it, at least
    uint32_t index;
} tl_nav_open_item;

/// An item as one number: the bits of a float >= 0 are in the order of its value.
static inline uint64_t tl_nav_open_key(float total, uint32_t index)
{
    uint32_t bits;
    memcpy(&bits, &total, sizeof bits);
    return (uint64_t)bits << 32 | index;
}

static inline tl_nav_open_item tl_nav_open_item_of(uint64_t key)
{
    uint32_t bits = (uint32_t)(key >> 32);
    tl_nav_open_item item = { 0.0f, (uint32_t)key };
    memcpy(&item.total, &bits, sizeof bits);
    return item;
}

static inline void tl_nav_open_push(tl_nav_query *query, float total, uint32_t index)
{
    tl_nav_open_key_push(query->open, &query->open_count, tl_nav_open_key(total, index), NULL);
}

/// The heap must not be empty.
static inline tl_nav_open_item tl_nav_open_pop(tl_nav_query *query)
{
    return tl_nav_open_item_of(tl_nav_open_key_pop(query->open, &query->open_count, NULL));
}

/// Takes the top, and puts another item in: in one pass.
static inline tl_nav_open_item tl_nav_open_swap_top(tl_nav_query *query, float total, uint32_t index)
{
    tl_nav_open_item top = tl_nav_open_item_of(query->open[0]);
    tl_nav_open_key_sift_down(query->open, query->open_count, 0, tl_nav_open_key(total, index), NULL);
    return top;
}

#endif
