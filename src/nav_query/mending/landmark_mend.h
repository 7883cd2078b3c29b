// SPDX-License-Identifier: MIT
//
// Landmark distances after an edit (landmark_mend.c).

#ifndef TALUS_SRC_NAV_QUERY_LANDMARK_MEND_H
#define TALUS_SRC_NAV_QUERY_LANDMARK_MEND_H

#include "nav_query/mending/graph_changes.h"

/// Mends the graph's distances from landmarks; or chooses landmarks, and measures them. `seen`: all edges that are new,
/// sorted. TL_ERR_MEMORY, TL_ERR_CANCELLED.
tl_result tl_nav_mend_landmarks(const tl_nav_graph_changes *changes, const tl_nav_pair_list *seen, const tl_host *host);

#endif
