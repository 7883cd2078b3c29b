// SPDX-License-Identifier: MIT
//
// The portal between two neighbours.

#ifndef TALUS_SRC_NAV_QUERY_PORTAL_BETWEEN_H
#define TALUS_SRC_NAV_QUERY_PORTAL_BETWEEN_H

#include "nav_query/navmesh/navmesh.h"

/// Both ends of the portal, seen looking out of `from`. False when the two are not neighbours, or `from` is stale.
bool tl_nav_portal_between(const tl_navmesh *navmesh, tl_nav_ref from, uint32_t to_slot, uint32_t to_polygon,
                           tl_vec3 *left_out, tl_vec3 *right_out);

#endif
