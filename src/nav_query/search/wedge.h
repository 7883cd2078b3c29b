// SPDX-License-Identifier: MIT
//
// The node of an exact search (exact/shortest_search.c): what can be seen from a root through the edge by which a
// polygon is entered.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_H
#define TALUS_SRC_NAV_QUERY_WEDGE_H

#include "nav_query/search/query.h"

/// A direction in the plane, from a root. Both 0: open, nothing lies beyond it.
typedef struct tl_nav_direction {
    double x, z;
} tl_nav_direction;

struct tl_nav_wedge {
    tl_nav_direction left, right; ///< from the root, the ends of what is seen
    double cost;                  ///< metres from the start to the root
    float root_x, root_z;
    uint32_t slot, polygon; ///< that is entered
    uint32_t edge;          ///< by which, of its ring; or TL_NAV_WEDGE_...: it holds its root
    uint32_t parent;
};

// Values of tl_nav_wedge.edge beside edges. From such a wedge all is open.
#define TL_NAV_WEDGE_LANDS 0x80000000u ///< | the end by which an off-mesh link was left; the root is its other end
#define TL_NAV_WEDGE_HOLDS UINT32_MAX  ///< the start is here, or the root of the wedge's parent

static inline bool tl_nav_wedge_lands(const tl_nav_wedge *wedge)
{
    return wedge->edge >= TL_NAV_WEDGE_LANDS && wedge->edge != TL_NAV_WEDGE_HOLDS;
}

#endif
