// SPDX-License-Identifier: MIT
//
// Lists of numbers, and of pairs of them, by which a mend goes from what has changed to whom that concerns.

#include "nav_query/mending/number_lists.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

tl_result tl_nav_add_number(const tl_allocator *allocator, tl_nav_number_list *list, uint32_t number)
{
    if (list->count == list->capacity) {
        uint32_t *grown = tl_grow_array(allocator, list->numbers, &list->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        list->numbers = grown;
    }
    list->numbers[list->count++] = number;
    return TL_OK;
}

void tl_nav_free_numbers(const tl_allocator *allocator, tl_nav_number_list *list)
{
    tl_release_array(allocator, list->numbers, list->capacity, sizeof *list->numbers);
    memset(list, 0, sizeof *list);
}

tl_result tl_nav_add_item(const tl_allocator *allocator, tl_nav_pair_list *list, tl_sort_item item)
{
    if (list->count == list->capacity) {
        tl_sort_item *grown = tl_grow_array(allocator, list->items, &list->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        list->items = grown;
    }
    list->items[list->count++] = item;
    return TL_OK;
}

tl_result tl_nav_add_pair(const tl_allocator *allocator, tl_nav_pair_list *list, uint32_t first, uint32_t second)
{
    const tl_sort_item item = { (uint64_t)first << 32 | second, 0, 0 };
    return tl_nav_add_item(allocator, list, item);
}

tl_result tl_nav_gather_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_nav_pair_list *all)
{
    if (all->count == 0) {
        const tl_nav_pair_list none = *all;
        *all = *list;
        *list = none;
        return TL_OK;
    }
    for (uint64_t i = 0; i < list->count; i++) {
        TL_TRY(tl_nav_add_item(allocator, all, list->items[i]));
    }
    list->count = 0;
    return TL_OK;
}

void tl_nav_free_pairs(const tl_allocator *allocator, tl_nav_pair_list *list)
{
    tl_release_array(allocator, list->items, list->capacity, sizeof *list->items);
    memset(list, 0, sizeof *list);
}

tl_result tl_nav_sort_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_stage *stage)
{
    if (list->count > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    if (list->count <= TL_FEW_SORT_ITEMS) {
        tl_insertion_sort(list->items, (uint32_t)list->count);
        return TL_OK;
    }
    tl_sort_item *scratch = tl_allocate_array(allocator, list->count, sizeof *scratch);
    if (scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_result result = tl_radix_sort_in_stage(list->items, scratch, (uint32_t)list->count, stage);
    tl_release_array(allocator, scratch, list->count, sizeof *scratch);
    return result;
}

tl_result tl_nav_unite_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_stage *stage)
{
    TL_TRY(tl_nav_sort_pairs(allocator, list, stage));
    uint64_t kept = 0;
    for (uint64_t i = 0; i < list->count; i++) {
        if (kept == 0 || list->items[kept - 1].key != list->items[i].key) {
            list->items[kept++] = list->items[i];
        }
    }
    list->count = kept;
    return TL_OK;
}

uint64_t tl_nav_find_key(const tl_nav_pair_list *list, uint64_t key)
{
    uint64_t begin = 0, end = list->count;
    while (begin < end) {
        const uint64_t middle = begin + (end - begin) / 2;
        if (list->items[middle].key < key) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

uint64_t tl_nav_find_pair(const tl_nav_pair_list *list, uint32_t first)
{
    return tl_nav_find_key(list, (uint64_t)first << 32);
}

bool tl_nav_has_pair(const tl_nav_pair_list *list, uint32_t first, uint32_t second)
{
    const uint64_t key = (uint64_t)first << 32 | second, at = tl_nav_find_key(list, key);
    return at < list->count && list->items[at].key == key;
}
