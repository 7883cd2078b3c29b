// SPDX-License-Identifier: MIT
//
// Points and segments in the plane, in double: distances and nearest points.

#ifndef TALUS_SRC_NAV_QUERY_PLAN_SEGMENT_H
#define TALUS_SRC_NAV_QUERY_PLAN_SEGMENT_H

#include <math.h>
#include <stdbool.h>
#include <talus/vec.h>

typedef struct tl_nav_spot {
    double x, z;
} tl_nav_spot;

typedef struct tl_nav_segment {
    tl_nav_spot a, b;
} tl_nav_segment;

static inline tl_nav_spot tl_nav_spot_make(double x, double z)
{
    tl_nav_spot spot = { x, z };
    return spot;
}

static inline tl_nav_spot tl_nav_spot_of(tl_vec3 point)
{
    return tl_nav_spot_make((double)point.x, (double)point.z);
}

static inline bool tl_nav_is_same_spot(tl_nav_spot a, tl_nav_spot b)
{
    return a.x == b.x && a.z == b.z;
}

static inline tl_nav_spot tl_nav_spot_lerp(tl_nav_spot a, tl_nav_spot b, double t)
{
    return tl_nav_spot_make(a.x + t * (b.x - a.x), a.z + t * (b.z - a.z));
}

static inline double tl_nav_spot_distance_sq(tl_nav_spot a, tl_nav_spot b)
{
    double x = b.x - a.x;
    double z = b.z - a.z;
    return x * x + z * z;
}

/// Twice the signed area of abc: < 0 when c lies left of the ray from a through b, seen from above.
static inline double tl_nav_spot_turn(tl_nav_spot a, tl_nav_spot b, tl_nav_spot c)
{
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

/// The point of a segment nearest to p, and its squared distance.
static inline double tl_nav_nearest_of_segment(tl_nav_segment s, tl_nav_spot p, tl_nav_spot *nearest_out)
{
    double ex = s.b.x - s.a.x;
    double ez = s.b.z - s.a.z;
    double along = ex * (p.x - s.a.x) + ez * (p.z - s.a.z);
    double length_sq = ex * ex + ez * ez;
    *nearest_out = !(along > 0.0) ? s.a : along >= length_sq ? s.b : tl_nav_spot_lerp(s.a, s.b, along / length_sq);
    return tl_nav_spot_distance_sq(*nearest_out, p);
}

/// Whether two segments cross in a point inside of both.
static inline bool tl_nav_segments_cross(tl_nav_segment s, tl_nav_segment t)
{
    double ta = tl_nav_spot_turn(s.a, s.b, t.a);
    double tb = tl_nav_spot_turn(s.a, s.b, t.b);
    double sa = tl_nav_spot_turn(t.a, t.b, s.a);
    double sb = tl_nav_spot_turn(t.a, t.b, s.b);
    return ((ta < 0.0 && tb > 0.0) || (ta > 0.0 && tb < 0.0)) && ((sa < 0.0 && sb > 0.0) || (sa > 0.0 && sb < 0.0));
}

/// The squared distance of two segments, and the middle between the two points where they come nearest.
static inline double tl_nav_between_segments(tl_nav_segment s, tl_nav_segment t, tl_nav_spot *middle_out)
{
    if (tl_nav_segments_cross(s, t)) {
        double ta = tl_nav_spot_turn(s.a, s.b, t.a);
        double tb = tl_nav_spot_turn(s.a, s.b, t.b);
        *middle_out = tl_nav_spot_lerp(t.a, t.b, ta / (ta - tb));
        return 0.0;
    }
    const tl_nav_segment segments[4] = { s, s, t, t };
    const tl_nav_spot ends[4] = { t.a, t.b, s.a, s.b };
    double best_sq = (double)INFINITY;
    *middle_out = s.a;
    for (int i = 0; i < 4; i++) {
        tl_nav_spot nearest;
        double distance_sq = tl_nav_nearest_of_segment(segments[i], ends[i], &nearest);
        if (distance_sq < best_sq) {
            best_sq = distance_sq;
            *middle_out = tl_nav_spot_lerp(nearest, ends[i], 0.5);
        }
    }
    return best_sq;
}

static inline double tl_nav_segments_distance_sq(tl_nav_segment s, tl_nav_segment t)
{
    tl_nav_spot middle = s.a;
    return tl_nav_between_segments(s, t, &middle);
}

#endif
