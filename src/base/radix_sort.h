// SPDX-License-Identifier: MIT
//
// Stable least-significant-digit radix sort of 64-bit keys with 32-bit values: the one sort of the builds, so that
// equal keys keep their order everywhere. Passes over digits that all keys share are skipped.

#ifndef TALUS_SRC_BASE_RADIX_SORT_H
#define TALUS_SRC_BASE_RADIX_SORT_H

#include "base/stage.h"

#include <stdint.h>

typedef struct tl_sort_item {
    uint64_t key;
    uint32_t value;
    uint32_t extra; ///< carried along
} tl_sort_item;

/// Below this count the histograms of a radix sort cost more than an insertion sort.
enum { TL_FEW_SORT_ITEMS = 48 };

/// Sorts few `items` ascending by key, stably.
static inline void tl_insertion_sort(tl_sort_item *items, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const tl_sort_item item = items[i];
        uint32_t j = i;
        for (; j > 0 && items[j - 1].key > item.key; j--) {
            items[j] = items[j - 1];
        }
        items[j] = item;
    }
}

/// Sorts `items` ascending by key, stably. `scratch` holds `count` items too. O(count) for a fixed key width.
void tl_radix_sort(tl_sort_item *items, tl_sort_item *scratch, uint32_t count);

/// The same, with calls of progress. TL_ERR_CANCELLED: the items are in no order, and some are there twice.
tl_result tl_radix_sort_in_stage(tl_sort_item *items, tl_sort_item *scratch, uint32_t count, tl_stage *stage);

/// A float's bits as an unsigned integer of the same order (-0 before +0, NaN at the ends).
uint32_t tl_float_sort_key(float value);

#endif
