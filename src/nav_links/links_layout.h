// SPDX-License-Identifier: MIT
//
// A set of links as a blob that is being written.

#ifndef TALUS_SRC_NAV_LINKS_LAYOUT_H
#define TALUS_SRC_NAV_LINKS_LAYOUT_H

#include <talus/nav_links.h>

/// A zeroed set with room for `count` links; NULL: out of memory.
tl_nav_links *tl_nav_links_allocate(const tl_allocator *allocator, uint32_t count);

static inline tl_nav_jump_link *tl_nav_links_writable_array(tl_nav_links *links)
{
    return (tl_nav_jump_link *)(void *)((char *)links + links->links);
}

#endif
