// SPDX-License-Identifier: MIT
//
// Least-significant-digit radix sort: eight histograms in one read, then one stable scatter a digit that varies.
// It wins over comparison sorts from some hundred items up, and its stability makes every tie go to the lower index.

#include "base/radix_sort.h"

#include "base/assert.h"

#include <string.h>

enum { DIGIT_BITS = 8, DIGIT_VALUES = 1 << DIGIT_BITS, DIGITS = 64 / DIGIT_BITS };

static tl_result count_digits(const tl_sort_item *items, uint32_t count, uint32_t histogram[DIGITS][DIGIT_VALUES],
                              tl_stage *stage)
{
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        end = tl_stage_step_end(begin, count);
        for (uint32_t i = begin; i < end; i++) {
            for (uint32_t digit = 0; digit < DIGITS; digit++) {
                histogram[digit][(items[i].key >> (digit * DIGIT_BITS)) & (DIGIT_VALUES - 1)]++;
            }
        }
        TL_TRY(tl_stage_add(stage, 0));
    }
    return TL_OK;
}

static tl_result scatter_by_digit(const tl_sort_item *from, tl_sort_item *to, uint32_t count, uint32_t shift,
                                  uint32_t *offsets, tl_stage *stage)
{
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        end = tl_stage_step_end(begin, count);
        for (uint32_t i = begin; i < end; i++) {
            to[offsets[(from[i].key >> shift) & (DIGIT_VALUES - 1)]++] = from[i];
        }
        TL_TRY(tl_stage_add(stage, 0));
    }
    return TL_OK;
}

tl_result tl_radix_sort_in_stage(tl_sort_item *items, tl_sort_item *scratch, uint32_t count, tl_stage *stage)
{
    if (count <= TL_FEW_SORT_ITEMS) {
        tl_insertion_sort(items, count);
        return TL_OK;
    }
    uint32_t histogram[DIGITS][DIGIT_VALUES];
    memset(histogram, 0, sizeof histogram);
    TL_TRY(count_digits(items, count, histogram, stage));
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
        TL_TRY(scatter_by_digit(from, to, count, shift, offsets, stage));
        tl_sort_item *swap = from;
        from = to;
        to = swap;
    }
    if (from != items) {
        memcpy(items, from, (size_t)count * sizeof *items);
    }
    return TL_OK;
}

void tl_radix_sort(tl_sort_item *items, tl_sort_item *scratch, uint32_t count)
{
    (void)tl_radix_sort_in_stage(items, scratch, count, NULL); // nothing else can fail
}

uint32_t tl_float_sort_key(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    // Negative numbers: all bits flipped, so that more negative is smaller. Others: above all negative ones.
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
