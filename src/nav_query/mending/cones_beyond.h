// SPDX-License-Identifier: MIT
//
// Cones that are seen beyond a change (cones_beyond.c).

#ifndef TALUS_SRC_NAV_QUERY_CONES_BEYOND_H
#define TALUS_SRC_NAV_QUERY_CONES_BEYOND_H

#include "nav_query/mending/change_sectors.h"

/// Adds to what is beyond, dropped and lost, by the sectors, unsorted, and notes the slots whose cones may go. Runs on
/// the host's tasks. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_nav_find_cones_beyond(tl_nav_change_sectors *sectors, const tl_host *host);

#endif
