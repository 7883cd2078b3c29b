// SPDX-License-Identifier: MIT
//
// Convex polygons as triangles again, so that they can be merged further: fans, whose inner edges go first.

#ifndef TALUS_SRC_POLYGON_FANS_H
#define TALUS_SRC_POLYGON_FANS_H

#include "base/arena.h"
#include "polygon/triangulate/triangulate.h"

typedef struct tl_fans {
    uint32_t count;    // triangles so far
    uint32_t *corners; // [3 * triangle + k]
    uint32_t *twins;   // inner edges have theirs; the others are left to tl_pair_edges
    uint8_t *joined;   // [edge] inner
} tl_fans;

/// False: out of memory.
static inline bool tl_fans_init(tl_fans *fans, tl_arena *arena, uint32_t triangle_count)
{
    uint64_t edges = 3 * (uint64_t)triangle_count;
    fans->count = 0;
    fans->corners = TL_PUSH(arena, uint32_t, edges);
    fans->twins = TL_PUSH(arena, uint32_t, edges);
    fans->joined = TL_PUSH(arena, uint8_t, edges);
    return fans->corners != NULL && fans->twins != NULL && fans->joined != NULL;
}

/// Adds a polygon whose corners are names[corners[k]] (NULL: corners[k]).
static inline void tl_fans_add(tl_fans *fans, const uint32_t *corners, uint32_t count, const uint32_t *names)
{
    uint32_t triangles = count - 2;
    for (uint32_t t = 0; t < triangles; t++) {
        uint32_t edge = 3 * fans->count++;
        const uint32_t at[3] = { corners[0], corners[t + 1], corners[t + 2] };
        for (uint32_t k = 0; k < 3; k++) {
            fans->corners[edge + k] = names != NULL ? names[at[k]] : at[k];
        }
        fans->joined[edge] = t > 0;
        fans->joined[edge + 1] = 0;
        fans->joined[edge + 2] = t + 1 < triangles;
        fans->twins[edge] = t > 0 ? edge - 1 : TL_NO_EDGE;
        fans->twins[edge + 1] = TL_NO_EDGE;
        fans->twins[edge + 2] = t + 1 < triangles ? edge + 3 : TL_NO_EDGE;
    }
}

#endif
