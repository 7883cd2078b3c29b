// SPDX-License-Identifier: MIT
//
// A face of a hull with its neighbours that lie in the same plane, to rounding: what a body really rests on.

#ifndef TALUS_SRC_CONVEX_FACET_H
#define TALUS_SRC_CONVEX_FACET_H

#include <talus/hull.h>

typedef struct tl_facet {
    const tl_hull *hull;
    uint32_t face;       // the one that the others lie in a plane with
    uint32_t first;      // a half-edge of the outline
    bool alone;          // no neighbour lies in its plane
    tl_hull_plane plane; // of one that may have such neighbours
    double gap;          // metres that a corner may lie below it
} tl_facet;

void tl_facet_around(const tl_hull *hull, uint32_t face, tl_facet *facet_out);

// The half-edge of the outline that follows, counter-clockwise seen from outside.
uint32_t tl_facet_next(const tl_facet *facet, uint32_t half_edge);
uint32_t tl_facet_previous(const tl_facet *facet, uint32_t half_edge);

#endif
