// SPDX-License-Identifier: MIT
//
// Bringing a version's arrays up to date (catch_up.c).

#ifndef TALUS_SRC_NAV_QUERY_CATCH_UP_H
#define TALUS_SRC_NAV_QUERY_CATCH_UP_H

#include "nav_query/navmesh/navmesh.h"

/// Makes `to` the same as `from`. `to` holds arrays as they were in version `version`, 0 and zeroes: none, and nobody
/// reads it. TL_ERR_MEMORY: `to` is as it was.
tl_result tl_nav_catch_up(tl_nav_history *history, const tl_navmesh *from, uint64_t version, tl_navmesh *to);

/// Frees the arrays that a version has of its own, and zeroes it.
void tl_nav_free_arrays(tl_nav_history *history, tl_navmesh *navmesh);

#endif
