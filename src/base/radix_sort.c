// SPDX-License-Identifier: MIT
//
// Least-significant-digit radix sort: eight histograms in one read, then one stable scatter a digit that varies.
// It wins over comparison sorts from some hundred items up, and its stability makes every tie go to the lower index.

#include "base/radix_sort.h"

#include <string.h>

enum { DIGIT_BITS = 8, DIGIT_VALUES = 1 << DIGIT_BITS, DIGITS = 64 / DIGIT_BITS };

// Below this count the histograms cost more than an insertion sort, which is stable too.
enum { INSERTION_SORT_COUNT = 48 };

static void insertion_sort(tl_sort_item *items, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        tl_sort_item item = items[i];
        uint32_t j = i;
        for (; j > 0 && items[j - 1].key > item.key; j--) {
            items[j] = items[j - 1];
        }
        items[j] = item;
    }
}

void tl_radix_sort(tl_sort_item *items, tl_sort_item *scratch, uint32_t count)
{
    if (count <= INSERTION_SORT_COUNT) {
        insertion_sort(items, count);
        return;
    }
    uint32_t histogram[DIGITS][DIGIT_VALUES];
    memset(histogram, 0, sizeof histogram);
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t digit = 0; digit < DIGITS; digit++) {
            histogram[digit][(items[i].key >> (digit * DIGIT_BITS)) & (DIGIT_VALUES - 1)]++;
        }
    }
    tl_sort_item *from = items;
    tl_sort_item *to = scratch;
    for (uint32_t digit = 0; digit < DIGITS; digit++) {
        uint32_t shift = digit * DIGIT_BITS;
        uint32_t *offsets = histogram[digit];
        if (offsets[(from[0].key >> shift) & (DIGIT_VALUES - 1)] == count) {
            continue;
        }
        uint32_t sum = 0;
        for (uint32_t value = 0; value < DIGIT_VALUES; value++) {
            uint32_t n = offsets[value];
            offsets[value] = sum;
            sum += n;
        }
        for (uint32_t i = 0; i < count; i++) {
            to[offsets[(from[i].key >> shift) & (DIGIT_VALUES - 1)]++] = from[i];
        }
        tl_sort_item *swap = from;
        from = to;
        to = swap;
    }
    if (from != items) {
        memcpy(items, from, (size_t)count * sizeof *items);
    }
}

uint32_t tl_float_sort_key(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    // Negative numbers: all bits flipped, so that more negative is smaller. Others: above all negative ones.
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
