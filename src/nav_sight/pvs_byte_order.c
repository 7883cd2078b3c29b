// SPDX-License-Identifier: MIT
//
// The words of a visibility table.

#include "base/byte_order.h"
#include "base/exact_floats.h"

#include <talus/nav_sight.h>

static const tl_word_run PVS_HEAD[] = { { 4, 2 }, { 8, 1 }, { 4, 4 }, { 8, 4 } };

void tl_nav_pvs_swap_words(tl_byte_swap *swap)
{
    tl_nav_pvs head;
    tl_swap_head(swap, PVS_HEAD, sizeof PVS_HEAD / sizeof PVS_HEAD[0], &head, sizeof head);
    tl_swap_words(swap, head.first, (uint64_t)head.slot_count + 1, 4);
    tl_swap_words(swap, head.rows, (uint64_t)head.polygon_count * head.words, 8);
}
