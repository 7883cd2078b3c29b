// SPDX-License-Identifier: MIT
//
// Freeing a heightfield.

#include "base/arena.h"

#include <talus/nav_bake.h>

#include <string.h>

void tl_nav_heightfield_free(tl_nav_heightfield *heightfield)
{
    if (heightfield == NULL) {
        return;
    }
    uint64_t columns = (uint64_t)heightfield->width * heightfield->height;
    tl_release_array(&heightfield->allocator, heightfield->first_span, columns + 1, sizeof *heightfield->first_span);
    tl_release_array(&heightfield->allocator, heightfield->spans, heightfield->span_count, sizeof *heightfield->spans);
    memset(heightfield, 0, sizeof *heightfield);
}
