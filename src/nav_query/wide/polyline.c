// SPDX-License-Identifier: MIT
//
// The vertices of a path with clearance, as a linked list in an array.

#include "nav_query/wide/polyline.h"

uint32_t tl_nav_polyline_insert(tl_nav_polyline *path, uint32_t behind, tl_nav_spot spot, uint32_t slot,
                                uint32_t polygon)
{
    if (path->count == path->capacity) {
        return TL_NAV_NO_NODE;
    }
    uint32_t next = behind == TL_NAV_NO_NODE ? TL_NAV_NO_NODE : path->vertices[behind].next;
    tl_nav_polyline_vertex vertex = { spot, { 0.0, 0.0 }, false, false, slot, polygon, 0, behind, next };
    uint32_t index = path->count++;
    path->vertices[index] = vertex;
    if (behind != TL_NAV_NO_NODE) {
        path->vertices[behind].next = index;
    }
    if (next != TL_NAV_NO_NODE) {
        path->vertices[next].before = index;
    } else {
        path->last = index;
    }
    return index;
}
