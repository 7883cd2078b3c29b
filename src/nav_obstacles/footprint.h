// SPDX-License-Identifier: MIT
//
// The floors that an obstacle marks: a shape in the plane, grown by the agent's radius, and a range of heights.

#ifndef TALUS_SRC_NAV_OBSTACLES_FOOTPRINT_H
#define TALUS_SRC_NAV_OBSTACLES_FOOTPRINT_H

#include <talus/nav_obstacles.h>

/// Checks a caller's obstacle, names of fields in the report (may be NULL).
tl_result tl_obstacle_check(const tl_nav_obstacle *obstacle, tl_report *report);

/// Metres, rounded outward: where floors can be marked. On y it is the body's own stretch, as floors are tested.
tl_aabb tl_obstacle_box(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height);

/// Marks the walkable floors of a field that the obstacle reaches. Columns are tested at their centre, in the level's
/// lattice, so that tiles agree on the columns that they share.
void tl_obstacle_mark(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height, tl_nav_compact *compact);

#endif
