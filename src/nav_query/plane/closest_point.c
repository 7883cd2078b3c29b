// SPDX-License-Identifier: MIT
//
// The point of a polygon closest to a point, in the plane: the point itself when it is inside, else the closest one of
// the edges. Inside is decided exactly; distances are compared in double, ties to the lower edge.

#include "nav_query/plane/side.h"
#include "nav_query/plane/surface.h"

// A corner seen from a point.
typedef struct seen_corner {
    double x, z;
} seen_corner;

static inline seen_corner see_corner(tl_vec3 corner, tl_vec3 point)
{
    seen_corner seen = { (double)corner.x - (double)point.x, (double)corner.z - (double)point.z };
    return seen;
}

// Whether a point lies beyond the edge from a to b of a polygon, exactly: tl_nav_side_of > 0, with what is common to
// two edges that follow one another computed once.
static inline bool is_beyond_edge(tl_vec3 a, tl_vec3 b, tl_vec3 point, seen_corner seen_a, seen_corner seen_b)
{
    double left = seen_a.x * seen_b.z;
    double right = seen_a.z * seen_b.x;
    double bound = TL_CROSS_ERROR * (fabs(left) + fabs(right));
    return left - right > bound || (!(right - left > bound) && tl_nav_side_of(a, b, point) > 0);
}

// Whether a point lies inside all edges by more than rounding can tell, as most points do: then no edge need be looked
// at by itself.
static inline bool is_clearly_inside(const tl_vec3 *corners, uint32_t count, tl_vec3 point)
{
    bool inside = true;
    seen_corner a = see_corner(corners[count - 1], point);
    for (uint32_t i = 0; i < count; i++) {
        const seen_corner b = see_corner(corners[i], point);
        const double left = a.x * b.z, right = a.z * b.x;
        inside &= right - left > TL_CROSS_ERROR * (fabs(left) + fabs(right));
        a = b;
    }
    return inside;
}

bool tl_nav_is_over(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    seen_corner seen_a = see_corner(corners[0], point);
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 *b = &corners[i + 1 < count ? i + 1 : 0];
        seen_corner seen_b = see_corner(*b, point);
        if (is_beyond_edge(corners[i], *b, point, seen_a, seen_b)) {
            return false;
        }
        seen_a = seen_b;
    }
    return true;
}

tl_vec3 tl_nav_closest_on_edge(tl_vec3 a, tl_vec3 b, tl_vec3 point)
{
    double dx = (double)b.x - (double)a.x;
    double dz = (double)b.z - (double)a.z;
    double along = dx * ((double)point.x - (double)a.x) + dz * ((double)point.z - (double)a.z);
    double length_sq = dx * dx + dz * dz;
    if (!(along > 0.0)) {
        return a;
    }
    if (along >= length_sq) {
        return b;
    }
    tl_vec3 on_edge = tl_lerp(a, b, (float)(along / length_sq));
    return tl_min(tl_max(on_edge, tl_min(a, b)), tl_max(a, b));
}

// The closest point lies on an edge that the point is beyond: others are not looked at.
tl_vec3 tl_nav_clamp_to_polygon(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point, bool *inside_out)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    if (is_clearly_inside(corners, count, point)) {
        *inside_out = true;
        return point;
    }
    tl_vec3 closest = point;
    double closest_sq = (double)INFINITY;
    seen_corner seen_a = see_corner(corners[0], point);
    *inside_out = true;
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 *b = &corners[i + 1 < count ? i + 1 : 0];
        seen_corner seen_b = see_corner(*b, point);
        bool beyond = is_beyond_edge(corners[i], *b, point, seen_a, seen_b);
        seen_a = seen_b;
        if (beyond) {
            tl_vec3 candidate = tl_nav_closest_on_edge(corners[i], *b, point);
            double dx = (double)candidate.x - (double)point.x;
            double dz = (double)candidate.z - (double)point.z;
            *inside_out = false;
            if (dx * dx + dz * dz < closest_sq) {
                closest_sq = dx * dx + dz * dz;
                closest = candidate;
            }
        }
    }
    return closest;
}

tl_vec3 tl_nav_closest_on_surface(const tl_nav_tile *tile, uint32_t polygon, tl_vec3 point, bool *inside_out)
{
    tl_vec3 closest = tl_nav_clamp_to_polygon(tile, polygon, point, inside_out);
    closest.y = tl_nav_surface_height(tile, polygon, closest.x, closest.z);
    return closest;
}
