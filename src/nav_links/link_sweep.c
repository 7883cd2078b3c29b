// SPDX-License-Identifier: MIT
//
// The proof of a link: the agent's capsule is swept through the triangles, piece by piece.
//
// Between the ends of a chord that spans dt, fall * t * t departs from the chord by fall * dt * dt / 4 at most, in the
// middle. There are so many chords that this is no more than half the margin by which the capsule is thicker than the
// agent; the other half covers the rounding of positions. So the swept volume contains the agent's capsule at every
// moment.

#include "nav_links/trajectory.h"

#include "base/exact_floats.h"

#include <math.h>

// More chords than a jump of a kilometre needs with a margin of a centimetre.
enum { MAX_CHORDS = 256 };

tl_nav_walker tl_nav_walker_make(const tl_soup *soup, float radius, float height, float lift, float margin)
{
    // What is lower than `lift` is left out, as far as the rest is still a whole capsule.
    float bottom = lift < height - 2.0f * radius ? lift : height - 2.0f * radius;
    bottom = bottom > 0.0f ? bottom : 0.0f;
    float low = bottom + radius;
    float high = height - radius > low ? height - radius : low;
    tl_nav_walker walker = {
        soup, tl_convex_capsule(tl_vec3_make(0.0f, low, 0.0f), tl_vec3_make(0.0f, high, 0.0f), radius + margin), margin
    };
    return walker;
}

static bool piece_is_free(const tl_nav_walker *walker, tl_vec3 from, tl_vec3 to)
{
    tl_transform pose = tl_transform_identity();
    pose.position = from;
    tl_shape_hit hit;
    return tl_soup_cast_shape(walker->soup, &walker->body, pose, tl_sub(to, from), NULL, &hit) == TL_NOT_FOUND;
}

static uint32_t count_chords(const tl_nav_walker *walker, const tl_nav_jump_link *link)
{
    tl_nav_parabola parabola = tl_nav_parabola_of(link->end.y - link->start.y, link->apex);
    double chords = ceil(sqrt((double)parabola.fall / (2.0 * (double)walker->margin)));
    return chords < 1.0 ? 1 : chords < (double)MAX_CHORDS ? (uint32_t)chords : MAX_CHORDS + 1;
}

bool tl_nav_link_is_free(const tl_nav_walker *walker, const tl_nav_jump_link *link)
{
    if (link->kind != TL_NAV_LINK_JUMP) {
        tl_vec3 corner = tl_vec3_make(link->end.x, link->start.y, link->end.z);
        return piece_is_free(walker, link->start, corner) && piece_is_free(walker, corner, link->end);
    }
    uint32_t chords = count_chords(walker, link);
    tl_vec3 from = link->start;
    for (uint32_t i = 1; i <= chords && chords <= MAX_CHORDS; i++) {
        tl_vec3 to = tl_nav_jump_link_point(link, (float)i / (float)chords);
        if (!piece_is_free(walker, from, to)) {
            return false;
        }
        from = to;
    }
    return chords <= MAX_CHORDS;
}
