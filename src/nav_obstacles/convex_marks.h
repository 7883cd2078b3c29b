// SPDX-License-Identifier: MIT
//
// The floors that a convex shape at any pose marks.

#ifndef TALUS_SRC_NAV_OBSTACLES_CONVEX_MARKS_H
#define TALUS_SRC_NAV_OBSTACLES_CONVEX_MARKS_H

#include <talus/nav_obstacles.h>

// tl_obstacle_check, tl_obstacle_box and tl_obstacle_mark for TL_NAV_OBSTACLE_CONVEX.
tl_result tl_convex_obstacle_check(const tl_nav_obstacle *obstacle, tl_report *report);
tl_aabb tl_convex_obstacle_box(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height);
void tl_convex_obstacle_mark(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height,
                             tl_nav_compact *compact);

#endif
