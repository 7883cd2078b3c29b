// SPDX-License-Identifier: MIT
//
// Which of the proven candidates are worth keeping.

#ifndef TALUS_SRC_NAV_LINKS_SELECTION_H
#define TALUS_SRC_NAV_LINKS_SELECTION_H

#include "nav_links/ledges.h"

/// Takes proven candidates in the order of their rank, and keeps those without which the path between their ends is
/// long (tl_nav_links_def.min_gain): they are moved to the front, `*kept_out` of them. Counts go into the report.
tl_result tl_nav_select_links(const tl_nav_links_def *def, const tl_navmesh *navmesh, tl_nav_link_candidate *candidates,
                              uint32_t count, uint32_t *kept_out, tl_nav_links_report *report);

#endif
