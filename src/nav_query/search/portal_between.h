// SPDX-License-Identifier: MIT
//
// The portal between two neighbours.

#ifndef TALUS_SRC_NAV_QUERY_PORTAL_BETWEEN_H
#define TALUS_SRC_NAV_QUERY_PORTAL_BETWEEN_H

#include "nav_query/navmesh/navmesh.h"

/// Two neighbours.
typedef struct tl_nav_portal_ends {
    uint32_t slot, polygon;
    uint32_t to_slot, to_polygon;
} tl_nav_portal_ends;

/// Both ends of the portal, seen looking out of the first polygon. False when the two are not neighbours.
bool tl_nav_find_portal(const tl_navmesh *navmesh, const tl_nav_portal_ends *ends, tl_vec3 *left_out,
                        tl_vec3 *right_out);

/// The same of a polygon by its reference; false also when `from` is stale.
bool tl_nav_portal_between(const tl_navmesh *navmesh, tl_nav_ref from, uint32_t to_slot, uint32_t to_polygon,
                           tl_vec3 *left_out, tl_vec3 *right_out);

#endif
