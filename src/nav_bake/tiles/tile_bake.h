// SPDX-License-Identifier: MIT
//
// All stages for one tile, on input that was checked.

#ifndef TALUS_SRC_NAV_BAKE_TILE_BAKE_H
#define TALUS_SRC_NAV_BAKE_TILE_BAKE_H

#include "nav_bake/input/triangle_bins.h"

/// Clears a report that may be NULL; its base, or NULL.
tl_report *tl_nav_bake_report_begin(tl_nav_bake_report *report, const char *stage);

/// tl_nav_tile_bake for the triangles of a list. Adds its counts to those in `report`, which is not NULL, and leaves
/// the last stage, or what failed, in its base. `stages` NULL: intermediate data is freed as soon as its last reader is
/// done. Else it is zero, and holds all of it afterwards, also on failure.
tl_result tl_nav_tile_run(const tl_nav_config *config, const tl_nav_input *input, tl_triangle_list list,
                          const tl_host *host, tl_nav_stages *stages, tl_nav_tile_stack *stack_out,
                          tl_nav_bake_report *report);

/// tl_nav_tile_bake_from_compact for floors that have their distance field already, with `has_distance`.
tl_result tl_nav_tile_bake_from_distance(const tl_nav_config *config, tl_nav_compact *compact, bool has_distance,
                                         const tl_host *host, tl_nav_tile_stack *stack_out,
                                         tl_nav_bake_report *report_out);

/// The box, in the plane, of all that a bake of some tiles reads: borders, and a column more. def->bounds are given.
tl_result tl_nav_range_window(const tl_nav_def *def, const tl_nav_tile_range *range, tl_aabb *window,
                              tl_report *report);

/// The stages were built through a meter, which ends with the build; what holds an allocator gets the host's.
void tl_nav_stages_hand_over(tl_nav_stages *stages, const tl_allocator *allocator);

#endif
