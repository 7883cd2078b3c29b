// SPDX-License-Identifier: MIT
//
// A random point that can be reached: flood the circle, and pick from the polygons' parts in it by rejection sampling.
//
// Detour picks among whole polygons, so its points may lie far outside the circle, and it ignores the length of the
// path. Here a point is drawn from the polygons, or where one is larger than that from its box within the circle's,
// whose areas are known; it counts when it lies in both polygon and circle, about every second time. More numbers than
// the caller's two are those of a generator that begins with them. A point that is refused too often is picked from the
// parts themselves, cut out: that is as uniform, needs no rejection, and takes as long as all else together. The circle
// is a polygon of 32 sides inscribed in it, so that the parts are polygons. Clipping walks once around the polygon
// (Weiler and Atherton 1977, for two convex ones); cutting by one side after the other (Sutherland and Hodgman 1974)
// takes five times as long. Source: von Neumann, Various Techniques Used in Connection With Random Digits, 1951.

#include "base/assert.h"
#include "base/min_max.h"
#include "base/random.h"
#include "nav_query/around/flood.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/area_table.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/plane/circle_corners.h"
#include "nav_query/plane/point_of_random.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// An edge of the polygon adds three points at most: where it begins, comes in, goes out.
enum { CIRCLE_SIDES = TL_NAV_CIRCLE_CORNERS, MAX_CLIPPED = 3 * TL_NAV_MAX_CORNERS + 2 * CIRCLE_SIDES };

// Points no farther from the centre than this share of the radius lie within all sides: cos(180 / 32 degrees) = 0.9951.
#define SAFE_SHARE 0.995
// Crossings that lie nearer to one another than this share of the radius are in one place: some thousand times what
// rounding moves them.
#define SAME_PLACE 1e-12

typedef struct clip_polygon {
    tl_nav_spot points[MAX_CLIPPED]; // from the centre
    uint32_t count;
} clip_polygon;

// The circle as a polygon around its centre.
typedef struct circle {
    double within_sq; // points no farther from the centre than this lie within all sides
    tl_nav_spot corners[CIRCLE_SIDES + 1];
} circle;

static circle make_circle(double radius)
{
    circle c;
    double within = radius * SAFE_SHARE;
    c.within_sq = within * within;
    for (uint32_t i = 0; i <= CIRCLE_SIDES; i++) {
        c.corners[i] = tl_nav_circle_corner(tl_nav_spot_make(0.0, 0.0), radius, i);
    }
    return c;
}

// How far a point lies within the side from a to b of the circle's polygon, times the side's length.
static double inside_of(tl_nav_spot a, tl_nav_spot b, tl_nav_spot p)
{
    return (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x);
}

// The side that a ray from the centre through a point crosses: by its quarter, then by bisection.
static uint32_t side_towards(const circle *c, tl_nav_spot p)
{
    uint32_t quarter = p.z >= 0.0 ? (p.x > 0.0 ? 0 : 1) : (p.x < 0.0 ? 2 : 3);
    uint32_t side = quarter * (CIRCLE_SIDES / 4);
    for (uint32_t step = CIRCLE_SIDES / 8; step > 0; step /= 2) {
        const tl_nav_spot *corner = &c->corners[side + step];
        side += corner->x * p.z - corner->z * p.x >= 0.0 ? step : 0;
    }
    return side;
}

static bool is_in_circle(const circle *c, tl_nav_spot p)
{
    if (p.x * p.x + p.z * p.z <= c->within_sq) {
        return true;
    }
    uint32_t side = side_towards(c, p);
    return inside_of(c->corners[side], c->corners[side + 1], p) >= 0.0;
}

// Where a line goes over the circle's outline.
typedef struct circle_crossing {
    tl_nav_spot at;
    uint32_t side;
    double t; // along the line
} circle_crossing;

static tl_nav_spot spot_along(tl_nav_spot a, tl_nav_spot along, double t)
{
    return tl_nav_spot_make(a.x + t * along.x, a.z + t * along.z);
}

// From where the line crosses the round circle to the side that lies there, or to one beside it. False: between two
// sides the line passes by a corner.
static bool find_crossing(const circle *c, tl_nav_spot a, tl_nav_spot along, double t, circle_crossing *out)
{
    out->t = t;
    out->at = spot_along(a, along, t);
    out->side = side_towards(c, out->at);
    for (int tries = 0; tries < 3; tries++) {
        tl_nav_spot from = c->corners[out->side];
        tl_nav_spot to = c->corners[out->side + 1];
        double inward = (to.x - from.x) * along.z - (to.z - from.z) * along.x;
        if (inward == 0.0) {
            return false;
        }
        out->t = -inside_of(from, to, a) / inward;
        out->at = spot_along(a, along, out->t);
        uint32_t side = side_towards(c, out->at);
        if (side == out->side) {
            return true;
        }
        out->side = side;
    }
    return false;
}

static void add_clip_point(clip_polygon *polygon, tl_nav_spot p)
{
    TL_ASSERT(polygon->count < MAX_CLIPPED);
    polygon->points[polygon->count] = p;
    polygon->count += polygon->count + 1 < MAX_CLIPPED ? 1 : 0;
}

// The circle's corners between where the polygon's outline left it and where it comes in again. Two crossings in one
// place may be in either order.
static void add_corners(const circle *c, const circle_crossing *out, const circle_crossing *in, clip_polygon *polygon)
{
    double dx = in->at.x - out->at.x;
    double dz = in->at.z - out->at.z;
    if (dx * dx + dz * dz > SAME_PLACE * SAME_PLACE * c->within_sq) {
        for (uint32_t side = out->side; side != in->side; side = side > 0 ? side - 1 : CIRCLE_SIDES - 1) {
            add_clip_point(polygon, c->corners[side]);
        }
    }
}

// An outline on its way through the circle.
typedef struct clip_walk {
    const circle *c;
    clip_polygon *polygon;       // what is written
    circle_crossing first, last; // in, before any out; out
    bool has_first, is_out;
} clip_walk;

static void go_in(clip_walk *walk, const circle_crossing *in)
{
    if (walk->is_out) {
        add_corners(walk->c, &walk->last, in, walk->polygon);
    } else {
        walk->first = *in;
        walk->has_first = true;
    }
    add_clip_point(walk->polygon, in->at);
}

static void go_out(clip_walk *walk, const circle_crossing *out)
{
    add_clip_point(walk->polygon, out->at);
    walk->last = *out;
    walk->is_out = true;
}

// The edge from a to b, one of which is outside at least.
static void clip_edge(clip_walk *walk, tl_nav_spot a, bool a_inside, tl_nav_spot b, bool b_inside)
{
    const double radius_sq = walk->c->corners[0].x * walk->c->corners[0].x;
    tl_nav_spot along = { b.x - a.x, b.z - a.z };
    double length_sq = along.x * along.x + along.z * along.z;
    double middle = -(a.x * along.x + a.z * along.z);
    double half_sq = middle * middle - length_sq * (a.x * a.x + a.z * a.z - radius_sq);
    double half = half_sq > 0.0 ? sqrt(half_sq) : 0.0;
    circle_crossing in, out;
    // Outside on both ends: over the round circle twice, or not at all.
    bool passes = half > 0.0 && middle + half > 0.0 && middle - half < length_sq;
    if (!a_inside && !b_inside && !passes) {
        return;
    }
    bool has_in = !a_inside && find_crossing(walk->c, a, along, (middle - half) / length_sq, &in);
    bool has_out = !b_inside && find_crossing(walk->c, a, along, (middle + half) / length_sq, &out);
    if (!a_inside && !b_inside && !(has_in && has_out && in.t < out.t && in.t < 1.0 && out.t > 0.0)) {
        return;
    }
    if (!a_inside) {
        go_in(walk, &in);
    }
    if (!b_inside) {
        go_out(walk, &out);
    }
}

// The part of a polygon within the circle; `count` 0 when there is none. The outline is walked once: what of it is
// inside is kept, and between where it leaves and where it comes back lie corners of the circle.
static void clip_to_circle(const tl_nav_flood *flood, const tl_nav_node *node, const circle *c, clip_polygon *out)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(flood->navmesh->slots[node->slot].tile, node->polygon, &count);
    const tl_vec3 center = flood->zone->center;
    clip_walk walk;
    memset(&walk, 0, sizeof walk);
    walk.c = c;
    walk.polygon = out;
    out->count = 0;
    bool holds_center = true;
    tl_nav_spot a = { (double)corners[0].x - (double)center.x, (double)corners[0].z - (double)center.z };
    bool a_inside = is_in_circle(c, a);
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 *corner = &corners[i + 1 < count ? i + 1 : 0];
        tl_nav_spot b = { (double)corner->x - (double)center.x, (double)corner->z - (double)center.z };
        bool b_inside = is_in_circle(c, b);
        holds_center = holds_center && a.x * b.z - a.z * b.x <= 0.0;
        if (a_inside) {
            add_clip_point(out, a);
        }
        if (!a_inside || !b_inside) {
            clip_edge(&walk, a, a_inside, b, b_inside);
        }
        a = b;
        a_inside = b_inside;
    }
    if (walk.is_out && walk.has_first) {
        add_corners(c, &walk.last, &walk.first, out);
    }
    for (uint32_t i = CIRCLE_SIDES; i > 0 && out->count == 0 && holds_center; i--) {
        out->points[CIRCLE_SIDES - i] = c->corners[i];
    }
    out->count = out->count == 0 && holds_center ? CIRCLE_SIDES : out->count;
}

// Twice the area of triangle i of the polygon's fan; seen from above in x and z it winds clockwise.
static double triangle_area(const clip_polygon *polygon, uint32_t i)
{
    const tl_nav_spot *p = polygon->points;
    double area = (p[i + 1].x - p[0].x) * (p[i].z - p[0].z) - (p[i + 1].z - p[0].z) * (p[i].x - p[0].x);
    return area > 0.0 ? area : 0.0;
}

static double clip_area(const clip_polygon *polygon)
{
    double area = 0.0;
    for (uint32_t i = 1; i + 1 < polygon->count; i++) {
        area += triangle_area(polygon, i);
    }
    return area;
}

// The areas of the polygons' parts, summed up; returns the sum of all.
static double sum_clip_areas(const tl_nav_flood *flood, const circle *c)
{
    tl_nav_query *query = flood->query;
    double sum = 0.0;
    for (uint32_t i = 0; i < query->node_count; i++) {
        clip_polygon part;
        clip_to_circle(flood, &query->nodes[i], c, &part);
        sum += clip_area(&part);
        query->part_sums[i] = sum;
    }
    return sum;
}

// The node in whose part area `*at`, below the sum of all, lies; it becomes that within the part.
static uint32_t find_part(const double *sums, uint32_t count, double *at)
{
    uint32_t low = 0;
    uint32_t high = count - 1;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (*at < sums[middle]) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    *at -= low > 0 ? sums[low - 1] : 0.0;
    return low;
}

static tl_vec3 point_in_clip(const tl_nav_flood *flood, const clip_polygon *part, double at, uint64_t bits)
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

// What a polygon's points are drawn from, around the centre: the polygon, or its box within the circle's.
typedef struct draw_region {
    bool is_box;
    double low_x, low_z, high_x, high_z;
    double area;
} draw_region;

static draw_region region_of(const tl_nav_flood *flood, const tl_nav_node *node, double radius)
{
    const tl_nav_slot *slot = &flood->navmesh->slots[node->slot];
    const double square = (double)slot->tile->cell_size * (double)slot->tile->cell_size;
    draw_region r = { false,  -radius, -radius,
                      radius, radius,  0.5 * square * (double)tl_nav_area_of(slot, node->polygon) };
    if (r.area > radius * radius) {
        const tl_vec3 center = flood->zone->center;
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(slot->tile, node->polygon, &count);
        tl_aabb box = { corners[0], corners[0] };
        for (uint32_t i = 1; i < count; i++) {
            box = tl_aabb_add_point(box, corners[i]);
        }
        r.low_x = tl_max_f64(r.low_x, (double)box.min.x - (double)center.x);
        r.low_z = tl_max_f64(r.low_z, (double)box.min.z - (double)center.z);
        r.high_x = tl_min_f64(r.high_x, (double)box.max.x - (double)center.x);
        r.high_z = tl_min_f64(r.high_z, (double)box.max.z - (double)center.z);
        const double area = tl_max_f64(r.high_x - r.low_x, 0.0) * tl_max_f64(r.high_z - r.low_z, 0.0);
        r.is_box = area < r.area;
        r.area = r.is_box ? area : r.area;
    }
    return r;
}

static double sum_regions(const tl_nav_flood *flood, double radius)
{
    tl_nav_query *query = flood->query;
    double sum = 0.0;
    for (uint32_t i = 0; i < query->node_count; i++) {
        sum += region_of(flood, &query->nodes[i], radius).area;
        query->area_sums[i] = sum;
    }
    return sum;
}

// A point of the polygon itself: of the triangle of its fan in which `at` lies, below the polygon's area.
static tl_nav_spot spot_in_polygon(const tl_nav_flood *flood, const tl_nav_node *node, double at, uint64_t bits)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(flood->navmesh->slots[node->slot].tile, node->polygon, &count);
    const double x = (double)corners[0].x;
    const double z = (double)corners[0].z;
    uint32_t i = 1;
    for (; i + 2 < count; i++) {
        const double area = 0.5 * (((double)corners[i + 1].x - x) * ((double)corners[i].z - z) -
                                   ((double)corners[i + 1].z - z) * ((double)corners[i].x - x));
        if (at < area) {
            break;
        }
        at -= area;
    }
    double second = 0.0;
    double third = 0.0;
    tl_nav_random_in_triangle(bits, &second, &third);
    return tl_nav_spot_make(x - (double)flood->zone->center.x + second * ((double)corners[i].x - x) +
                                third * ((double)corners[i + 1].x - x),
                            z - (double)flood->zone->center.z + second * ((double)corners[i].z - z) +
                                third * ((double)corners[i + 1].z - z));
}

static double unit_of_bits(uint64_t bits)
{
    return (double)(bits >> 11) * 0x1p-53;
}

// Draws a point, `sum` being the area of all regions. False: it has to be refused.
static bool draw_point(const tl_nav_flood *flood, const circle *c, double sum, const uint64_t bits[2],
                       const tl_nav_node **node_out, tl_nav_spot *spot_out)
{
    const tl_nav_query *query = flood->query;
    double at = unit_of_bits(bits[0]) * sum;
    const tl_nav_node *node = &query->nodes[find_part(query->area_sums, query->node_count, &at)];
    *node_out = node;
    // The circle's first corner is its radius away from the centre.
    const draw_region r = region_of(flood, node, c->corners[0].x);
    if (!r.is_box) {
        *spot_out = spot_in_polygon(flood, node, at, bits[1]);
        return is_in_circle(c, *spot_out);
    }
    // `at` is any number below the box's area: with it goes one axis, with the second number the other.
    *spot_out = tl_nav_spot_make(r.low_x + at / r.area * (r.high_x - r.low_x),
                                 r.low_z + unit_of_bits(bits[1]) * (r.high_z - r.low_z));
    const tl_vec3 point = tl_vec3_make((float)((double)flood->zone->center.x + spot_out->x), 0.0f,
                                       (float)((double)flood->zone->center.z + spot_out->z));
    return is_in_circle(c, *spot_out) && tl_nav_is_over(flood->navmesh->slots[node->slot].tile, node->polygon, point);
}

// Points that were refused before the parts are cut out.
enum { MAX_DRAWS = 24 };

// What points are picked from, after a flood.
typedef struct point_picker {
    const tl_nav_flood *flood;
    circle c;
    double sum;      // of the regions' areas
    double part_sum; // of the parts' areas; < 0: they are not cut out yet
} point_picker;

// A point by two random numbers, and others that follow from them. False: no part has any area.
static bool pick_point(point_picker *picker, const uint64_t random[2], tl_nav_location *out)
{
    const tl_nav_flood *flood = picker->flood;
    const tl_nav_query *query = flood->query;
    const tl_nav_node *node = NULL;
    tl_nav_spot spot;
    uint64_t bits[2] = { random[0], random[1] };
    uint64_t state = random[0] ^ tl_hash_mix(random[1]);
    bool is_found = false;
    for (int draws = 0; draws < MAX_DRAWS && picker->sum > 0.0 && !is_found; draws++) {
        is_found = draw_point(flood, &picker->c, picker->sum, bits, &node, &spot);
        bits[0] = tl_random_bits(&state);
        bits[1] = tl_random_bits(&state);
    }
    tl_vec3 point;
    if (is_found) {
        point = tl_vec3_make((float)((double)flood->zone->center.x + spot.x), 0.0f,
                             (float)((double)flood->zone->center.z + spot.z));
    } else {
        picker->part_sum = picker->part_sum < 0.0 ? sum_clip_areas(flood, &picker->c) : picker->part_sum;
        if (!(picker->part_sum > 0.0)) {
            return false;
        }
        double at = unit_of_bits(bits[0]) * picker->part_sum;
        clip_polygon part;
        node = &query->nodes[find_part(query->part_sums, query->node_count, &at)];
        clip_to_circle(flood, node, &picker->c, &part);
        point = point_in_clip(flood, &part, at, bits[1]);
    }
    bool inside = false;
    out->polygon = node->key;
    out->point = tl_nav_closest_on_surface(flood->navmesh->slots[node->slot].tile, node->polygon, point, &inside);
    return true;
}

tl_result tl_nav_query_random_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                        const tl_nav_around_request *request, const uint64_t random[2],
                                        tl_nav_location *location_out)
{
    return tl_nav_query_random_reachable_points(query, navmesh, request, random, 1, location_out);
}

// Within the nodes that the query has now.
static tl_result random_reachable_points_within(tl_nav_query *query, const tl_navmesh *navmesh,
                                                const tl_nav_around_request *request, const uint64_t *random,
                                                uint32_t count, tl_nav_location *locations_out)
{
    if (query == NULL || navmesh == NULL || request == NULL ||
        ((random == NULL || locations_out == NULL) && count > 0) || !tl_nav_filter_is_begun(request->filter)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_location *center = &request->center;
    const float radius = request->radius;
    const tl_nav_location none = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    for (uint32_t i = 0; i < count; i++) {
        locations_out[i] = none;
    }
    tl_nav_zone zone = tl_nav_zone_circle(center->point, radius);
    tl_nav_zone_test test;
    TL_TRY(tl_nav_zone_begin(&zone, &test));
    if (!tl_nav_is_finite(center->point)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_nav_flood flood = { query, navmesh, request->filter, true, radius, &test, false, false };
    if (!tl_nav_flood_run(&flood, center)) {
        return TL_ERR_STALE;
    }
    point_picker picker = { &flood, make_circle((double)radius), sum_regions(&flood, (double)radius), -1.0 };
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_location *out = &locations_out[i];
        if (!(radius > 0.0f) || !pick_point(&picker, random + 2 * (size_t)i, out)) {
            out->polygon = center->polygon;
            TL_TRY(tl_navmesh_closest_point(navmesh, center->polygon, center->point, &out->point, NULL));
        }
    }
    return flood.out_of_nodes ? TL_ERR_NODES : TL_OK;
}

tl_result tl_nav_query_random_reachable_points(tl_nav_query *query, const tl_navmesh *navmesh,
                                               const tl_nav_around_request *request, const uint64_t *random,
                                               uint32_t count, tl_nav_location *locations_out)
{
    tl_result result;
    do {
        result = random_reachable_points_within(query, navmesh, request, random, count, locations_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}
