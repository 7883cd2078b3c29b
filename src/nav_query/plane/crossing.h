// SPDX-License-Identifier: MIT
//
// Where the shortest way over a portal crosses it: Heron's, reflect the goal in the portal's line and go straight.

#ifndef TALUS_SRC_NAV_QUERY_CROSSING_H
#define TALUS_SRC_NAV_QUERY_CROSSING_H

#include "nav_query/plane/plan_segment.h"

/// The share, [0, 1], of the way from `portal.a` to `portal.b` at which the shortest way from `from` over the portal to
/// `goal` crosses it. With both on the line of the portal that is the point of it nearest to the goal.
static inline double tl_nav_crossing_share(tl_nav_spot from, tl_nav_spot goal, tl_nav_segment portal)
{
    double ux = portal.b.x - portal.a.x;
    double uz = portal.b.z - portal.a.z;
    double from_x = from.x - portal.a.x;
    double from_z = from.z - portal.a.z;
    double goal_x = goal.x - portal.a.x;
    double goal_z = goal.z - portal.a.z;
    // Places along the portal and distances from its line, all times its length.
    double from_along = from_x * ux + from_z * uz;
    double goal_along = goal_x * ux + goal_z * uz;
    double from_off = fabs(from_x * uz - from_z * ux);
    double goal_off = fabs(goal_x * uz - goal_z * ux);
    double off = from_off + goal_off;
    // As one fraction: a division takes longer than all else here.
    double along = off > 0.0 ? from_along * off + (goal_along - from_along) * from_off : goal_along;
    double whole = (off > 0.0 ? off : 1.0) * (ux * ux + uz * uz);
    return !(along > 0.0) ? 0.0 : along >= whole ? 1.0 : along / whole;
}

#endif
