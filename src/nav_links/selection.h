// SPDX-License-Identifier: MIT
//
// Which of the proven ways are worth keeping.

#ifndef TALUS_SRC_NAV_LINKS_SELECTION_H
#define TALUS_SRC_NAV_LINKS_SELECTION_H

#include "nav_links/ledges.h"

/// Goes through proven ways, in the order of their rank, and keeps those without which the way between their ends is
/// long: moves them to the front of `ways`, and returns their number in `*kept_out`. Counts go into the report.
tl_result tl_nav_select_ways(const tl_nav_links_def *def, const tl_navmesh *navmesh, tl_nav_way_try *ways,
                             uint32_t count, uint32_t *kept_out, tl_nav_links_report *report);

#endif
