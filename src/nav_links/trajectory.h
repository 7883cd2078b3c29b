// SPDX-License-Identifier: MIT
//
// The trajectories of links, and their proof.

#ifndef TALUS_SRC_NAV_LINKS_TRAJECTORY_H
#define TALUS_SRC_NAV_LINKS_TRAJECTORY_H

#include <talus/nav_links.h>

/// A jump rises as rise * t and falls as fall * t * t, metres, t from 0 to 1.
typedef struct tl_nav_parabola {
    float rise, fall;
} tl_nav_parabola;

/// The parabola that ends `up` metres above its start (below: negative) and rises to `apex` >= max(up, 0) on the way.
tl_nav_parabola tl_nav_parabola_of(float up, float apex);

/// The capsule that is swept.
typedef struct tl_nav_walker {
    const tl_soup *soup;
    tl_convex body; ///< around the feet's place
    float margin;   ///< metres that it is thicker than the agent: chords may depart so far from arcs
} tl_nav_walker;

tl_nav_walker tl_nav_walker_make(const tl_soup *soup, float radius, float height, float lift, float margin);

/// Whether the whole trajectory of a link is free of triangles. False also where a sweep gave up.
bool tl_nav_link_is_free(const tl_nav_walker *walker, const tl_nav_jump_link *link);

#endif
