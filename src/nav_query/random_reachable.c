// SPDX-License-Identifier: MIT
//
// A random point that can be reached: flood the circle, clip each polygon to it, pick among what is left by area.
//
// Detour picks among whole polygons, so its points may lie far outside the circle, and asks no length of the path. The
// circle here is a polygon of 32 sides within it, so that clipping makes polygons, whose areas and points need no
// rejection: two random numbers always suffice.
// Source: Sutherland and Hodgman, Reentrant Polygon Clipping, 1974.

#include "base/assert.h"
#include "nav_query/circle_corners.h"
#include "nav_query/filter.h"
#include "nav_query/flood.h"
#include "nav_query/navmesh.h"
#include "nav_query/point_of_random.h"
#include "nav_query/surface.h"

#include <string.h>

enum { SIDES = TL_NAV_CIRCLE_CORNERS, MOST_CLIPPED = TL_NAV_MAX_CORNERS + SIDES };

// Points no farther from the centre than this share of the radius lie within all sides: cos(180 / 32 degrees) = 0.9951.
#define SAFE_SHARE 0.995

typedef struct clip_polygon {
    tl_nav_spot points[MOST_CLIPPED]; // from the centre
    uint32_t count;
} clip_polygon;

// How far a point lies within the side from a to b of the circle's polygon, times the side's length.
static double inside_of(tl_nav_spot a, tl_nav_spot b, tl_nav_spot p)
{
    return (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x);
}

static bool comes_outside(const clip_polygon *polygon, tl_nav_spot a, tl_nav_spot b)
{
    uint32_t i = 0;
    while (i < polygon->count && inside_of(a, b, polygon->points[i]) >= 0.0) {
        i++;
    }
    return i < polygon->count;
}

static void clip_to_side(const clip_polygon *in, tl_nav_spot a, tl_nav_spot b, clip_polygon *out)
{
    out->count = 0;
    for (uint32_t i = 0; i < in->count; i++) {
        tl_nav_spot from = in->points[i];
        tl_nav_spot to = in->points[i + 1 < in->count ? i + 1 : 0];
        double from_inside = inside_of(a, b, from);
        double to_inside = inside_of(a, b, to);
        if (from_inside >= 0.0) {
            out->points[out->count++] = from;
        }
        if ((from_inside > 0.0 && to_inside < 0.0) || (from_inside < 0.0 && to_inside > 0.0)) {
            double t = from_inside / (from_inside - to_inside);
            tl_nav_spot crossing = { from.x + t * (to.x - from.x), from.z + t * (to.z - from.z) };
            out->points[out->count++] = crossing;
        }
    }
}

// The part of a polygon within the circle; `count` 0 when there is none. Each side cuts a convex polygon at most twice,
// so it adds one corner at most.
static void clip(const tl_nav_flood *flood, const tl_nav_node *node, double radius, clip_polygon *out)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(flood->navmesh->slots[node->slot].tile, node->polygon, &count);
    bool is_within = true;
    double middle = radius * SAFE_SHARE;
    out->count = count;
    for (uint32_t i = 0; i < count; i++) {
        out->points[i].x = (double)corners[i].x - (double)flood->zone->center.x;
        out->points[i].z = (double)corners[i].z - (double)flood->zone->center.z;
        double x = out->points[i].x;
        double z = out->points[i].z;
        is_within = is_within && x * x + z * z <= middle * middle;
    }
    const tl_nav_spot center = { 0.0, 0.0 };
    tl_nav_spot from = tl_nav_circle_corner(center, radius, 0);
    for (uint32_t side = 0; side < SIDES && !is_within && out->count > 0; side++) {
        tl_nav_spot to = tl_nav_circle_corner(center, radius, side + 1);
        if (comes_outside(out, from, to)) {
            clip_polygon cut;
            clip_to_side(out, from, to, &cut);
            out->count = cut.count;
            memcpy(out->points, cut.points, cut.count * sizeof *cut.points);
        }
        from = to;
    }
}

// Twice the area of triangle i of the polygon's fan; seen from above in x and z it winds clockwise.
static double triangle_area(const clip_polygon *polygon, uint32_t i)
{
    const tl_nav_spot *p = polygon->points;
    double area = (p[i + 1].x - p[0].x) * (p[i].z - p[0].z) - (p[i + 1].z - p[0].z) * (p[i].x - p[0].x);
    return area > 0.0 ? area : 0.0;
}

static double area_of(const clip_polygon *polygon)
{
    double area = 0.0;
    for (uint32_t i = 1; i + 1 < polygon->count; i++) {
        area += triangle_area(polygon, i);
    }
    return area;
}

// The area of the part of each polygon, kept among the wedges, which a flood does not use; returns the sum.
static double sum_areas(const tl_nav_flood *flood, double radius)
{
    tl_nav_query *query = flood->query;
    double sum = 0.0;
    for (uint32_t i = 0; i < query->node_count; i++) {
        clip_polygon part;
        clip(flood, &query->nodes[i], radius, &part);
        query->wedges[i].cost = area_of(&part);
        sum += query->wedges[i].cost;
    }
    return sum;
}

// The node in whose part area `*at` lies, which becomes that within the part. Where rounding has led past all parts it
// is the last one.
static uint32_t find_part(const tl_nav_query *query, double *at)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < query->node_count; i++) {
        double area = query->wedges[i].cost;
        found = area > 0.0 ? i : found;
        if (*at < area) {
            break;
        }
        *at -= area;
    }
    return found;
}

static tl_vec3 point_in(const tl_nav_flood *flood, const clip_polygon *part, double at, uint64_t bits)
{
    uint32_t i = 1;
    for (; i + 2 < part->count && at >= triangle_area(part, i); i++) {
        at -= triangle_area(part, i);
    }
    double second = 0.0;
    double third = 0.0;
    tl_nav_random_in_triangle(bits, &second, &third);
    const tl_nav_spot *p = part->points;
    double x = p[0].x + second * (p[i].x - p[0].x) + third * (p[i + 1].x - p[0].x);
    double z = p[0].z + second * (p[i].z - p[0].z) + third * (p[i + 1].z - p[0].z);
    return tl_vec3_make((float)((double)flood->zone->center.x + x), 0.0f, (float)((double)flood->zone->center.z + z));
}

tl_result tl_nav_query_random_reachable(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                        const tl_nav_location *center, float radius, const uint64_t random[2],
                                        tl_nav_location *location_out)
{
    tl_nav_location none = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    *location_out = none;
    tl_nav_zone zone = tl_nav_circle(center->point, radius);
    tl_nav_zone_test test;
    TL_TRY(tl_nav_zone_begin(&zone, &test));
    if (!tl_nav_is_finite(center->point)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_nav_flood flood = { query, navmesh, filter, true, radius, &test, false, false };
    if (!tl_nav_flood_run(&flood, center)) {
        return TL_ERR_NOT_FOUND;
    }
    location_out->polygon = center->polygon;
    double sum = radius > 0.0f ? sum_areas(&flood, (double)radius) : 0.0;
    if (!(sum > 0.0)) {
        return tl_navmesh_closest_point(navmesh, location_out->polygon, center->point, &location_out->point, NULL);
    }
    double at = (double)(random[0] >> 11) * (1.0 / 9007199254740992.0) * sum;
    const tl_nav_node *node = &query->nodes[find_part(query, &at)];
    clip_polygon part;
    clip(&flood, node, (double)radius, &part);
    bool inside = false;
    location_out->polygon = node->key;
    location_out->point = tl_nav_closest_on_surface(navmesh->slots[node->slot].tile, node->polygon,
                                                    point_in(&flood, &part, at, random[1]), &inside);
    return flood.out_of_nodes ? TL_ERR_LIMIT : TL_OK;
}
