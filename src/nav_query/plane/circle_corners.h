// SPDX-License-Identifier: MIT
//
// A circle as the polygon of 32 corners that is written into it: without a sine, whose last bits differ from machine to
// machine.

#ifndef TALUS_SRC_NAV_QUERY_CIRCLE_CORNERS_H
#define TALUS_SRC_NAV_QUERY_CIRCLE_CORNERS_H

#include "nav_query/plane/plan_segment.h"

#define TL_NAV_CIRCLE_CORNERS 32u

/// Corner `index`, any number: from the x axis on towards z.
static inline tl_nav_spot tl_nav_circle_corner(tl_nav_spot center, double radius, uint32_t index)
{
    // Cosines of 0, 1/32, ... 8/32 of a turn; the rest by symmetry.
    static const double cosine[TL_NAV_CIRCLE_CORNERS / 4 + 1] = { 1.0,
                                                                  0.98078528040323044913,
                                                                  0.92387953251128675613,
                                                                  0.83146961230254523708,
                                                                  0.70710678118654752440,
                                                                  0.55557023301960222474,
                                                                  0.38268343236508977173,
                                                                  0.19509032201612826785,
                                                                  0.0 };
    uint32_t quarter = TL_NAV_CIRCLE_CORNERS / 4, step = index % quarter;
    double along = radius * cosine[step], aside = radius * cosine[quarter - step];
    switch (index / quarter % 4) {
    case 0:
        return tl_nav_spot_make(center.x + along, center.z + aside);
    case 1:
        return tl_nav_spot_make(center.x - aside, center.z + along);
    case 2:
        return tl_nav_spot_make(center.x - along, center.z - aside);
    default:
        return tl_nav_spot_make(center.x + aside, center.z - along);
    }
}

#endif
