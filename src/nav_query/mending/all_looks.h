// SPDX-License-Identifier: MIT
//
// The looks of all corner vertices that a mend asks for (all_looks.c).

#ifndef TALUS_SRC_NAV_QUERY_ALL_LOOKS_H
#define TALUS_SRC_NAV_QUERY_ALL_LOOKS_H

#include "nav_query/mending/corner_look.h"

/// What was seen. All 0: nothing.
typedef struct tl_nav_all_looks {
    tl_nav_seen seen;
    /// Cones grouped by slot, those of slot s at [first_cones[s], first_cones[s + 1]); of a slot in the order of looks.
    tl_nav_corner_cone *cones;
    uint32_t *first_cones; ///< [graph->slot_count + 1]
    uint64_t cone_count;
} tl_nav_all_looks;

/// All lookers of the changes look, as tasks of the stage's host. Adds to `sectors->dropped`, and to the stage as many
/// as there are lookers. What is seen does not depend on the number of workers. TL_ERR_MEMORY, TL_ERR_LIMIT,
/// TL_ERR_CANCELLED; tl_nav_free_all_looks frees what is returned, after an error too.
tl_result tl_nav_look_from_all(tl_nav_change_sectors *sectors, tl_stage *stage, tl_nav_all_looks *looks_out);
void tl_nav_free_all_looks(const tl_nav_graph_changes *changes, tl_nav_all_looks *looks);

#endif
