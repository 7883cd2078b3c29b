// SPDX-License-Identifier: MIT
//
// The words of a set of links.

#include "base/byte_order.h"
#include "base/exact_floats.h"
#include "nav_links/links_layout.h"

static const tl_word_run LINKS_HEAD[] = { { 4, 2 }, { 8, 1 }, { 4, 8 }, { 8, 1 } };
static const tl_word_run LINK[] = { { 4, 7 }, { 1, 2 }, { 2, 1 } };

void tl_nav_links_swap_words(tl_byte_swap *swap)
{
    tl_nav_links head;
    tl_swap_head(swap, LINKS_HEAD, sizeof LINKS_HEAD / sizeof LINKS_HEAD[0], &head, sizeof head);
    tl_swap_elements(swap, head.links, head.link_count, LINK, sizeof LINK / sizeof LINK[0]);
}
