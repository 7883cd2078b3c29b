// SPDX-License-Identifier: MIT
//
// Lists of numbers, and of pairs of them, as long as they come.

#ifndef TALUS_SRC_NAV_QUERY_NUMBER_LISTS_H
#define TALUS_SRC_NAV_QUERY_NUMBER_LISTS_H

#include "base/radix_sort.h"

/// All 0: it is empty.
typedef struct tl_nav_number_list {
    uint32_t *numbers;
    uint64_t count, capacity;
} tl_nav_number_list;

/// TL_ERR_MEMORY.
tl_result tl_nav_add_number(const tl_allocator *allocator, tl_nav_number_list *list, uint32_t number);
void tl_nav_free_numbers(const tl_allocator *allocator, tl_nav_number_list *list);

/// Pairs of numbers: the first in the high half of an item's key, the second in the low one. The item's value and extra
/// are the caller's. All 0: it is empty.
typedef struct tl_nav_pair_list {
    tl_sort_item *items;
    uint64_t count, capacity;
} tl_nav_pair_list;

/// TL_ERR_MEMORY.
tl_result tl_nav_add_item(const tl_allocator *allocator, tl_nav_pair_list *list, tl_sort_item item);
tl_result tl_nav_add_pair(const tl_allocator *allocator, tl_nav_pair_list *list, uint32_t first, uint32_t second);
/// Moves all of a list to the end of another. TL_ERR_MEMORY.
tl_result tl_nav_gather_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_nav_pair_list *all);
/// Ascending, and equal ones as they came. TL_ERR_MEMORY, TL_ERR_LIMIT, TL_ERR_CANCELLED.
tl_result tl_nav_sort_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_stage *stage);
/// The same, and the first of equal ones alone.
tl_result tl_nav_unite_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_stage *stage);
/// Of a sorted list: the first item whose key is no less, the first pair whose first number is no less, and whether
/// there is a pair.
uint64_t tl_nav_find_key(const tl_nav_pair_list *list, uint64_t key);
uint64_t tl_nav_find_pair(const tl_nav_pair_list *list, uint32_t first);
bool tl_nav_has_pair(const tl_nav_pair_list *list, uint32_t first, uint32_t second);
void tl_nav_free_pairs(const tl_allocator *allocator, tl_nav_pair_list *list);

#endif
