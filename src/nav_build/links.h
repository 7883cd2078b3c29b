// SPDX-License-Identifier: MIT
//
// All four links of a floor at once.

#ifndef TALUS_SRC_NAV_BUILD_LINKS_H
#define TALUS_SRC_NAV_BUILD_LINKS_H

#include <talus/nav_build.h>

typedef struct tl_links {
    uint32_t to[4]; ///< by direction; TL_NAV_NO_SPAN: none
} tl_links;

static inline tl_links tl_nav_links(const tl_nav_compact *compact, uint32_t span)
{
    tl_links links;
    for (uint32_t d = 0; d < 4; d++) {
        links.to[d] = tl_nav_beside(compact, span, d);
    }
    return links;
}

#endif
