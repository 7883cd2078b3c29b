// SPDX-License-Identifier: MIT
//
// The trajectories of links. A jump is a parabola given by its two ends and its highest point: gravity decides how long
// it takes, not its shape. Drops and climbs have two legs, whose corner lies over the lower end at the upper one's
// height.

#include "nav_links/trajectory.h"

#include "base/exact_floats.h"

#include <math.h>

tl_nav_parabola tl_nav_parabola_of(float up, float apex)
{
    // rise - fall = up, and rise^2 / (4 fall) = apex; of the two solutions the one that ends past its highest point.
    double twice = 2.0 * (double)apex - (double)up;
    double square = twice * twice - (double)up * (double)up;
    double fall = twice + sqrt(square > 0.0 ? square : 0.0);
    tl_nav_parabola parabola = { (float)(fall + (double)up), (float)fall };
    return parabola;
}

static tl_vec3 jump_point(const tl_nav_jump_link *link, float t)
{
    tl_nav_parabola parabola = tl_nav_parabola_of(link->end.y - link->start.y, link->apex);
    tl_vec3 point = tl_lerp(link->start, link->end, t);
    point.y = link->start.y + (parabola.rise - parabola.fall * t) * t;
    return point;
}

tl_vec3 tl_nav_jump_link_point(const tl_nav_jump_link *link, float t)
{
    if (t <= 0.0f || t >= 1.0f) {
        return t <= 0.0f ? link->start : link->end;
    }
    if (link->kind == TL_NAV_LINK_JUMP) {
        return jump_point(link, t);
    }
    tl_vec3 corner = tl_vec3_make(link->end.x, link->start.y, link->end.z);
    float out = tl_distance(link->start, corner);
    float down = tl_distance(corner, link->end);
    float at = t * (out + down);
    return at <= out ? tl_lerp(link->start, corner, out > 0.0f ? at / out : 0.0f)
                     : tl_lerp(corner, link->end, (at - out) / down);
}
