// SPDX-License-Identifier: MIT
//
// The funnel against the shortest line through the same portals, found by trying all pairs of portal ends.

#include "nav_fixture.h"

#include <math.h>

enum { MAX_CORRIDOR = 256 };

typedef struct corridor {
    tl_nav_ref polygons[MAX_CORRIDOR];
    uint32_t count;
    tl_vec3 left[MAX_CORRIDOR], right[MAX_CORRIDOR]; // portal i leads from polygon i to i + 1
} corridor;

static double distance(tl_vec3 a, tl_vec3 b)
{
    return hypot((double)a.x - (double)b.x, (double)a.z - (double)b.z);
}

// Whether the inside of the segment from a to b crosses the portal, within rounding, no earlier than at *t; moves *t
// on.
static bool crosses_inside(tl_vec3 a, tl_vec3 b, tl_vec3 left, tl_vec3 right, double *t)
{
    double ax = (double)a.x, az = (double)a.z, dx = (double)b.x - ax, dz = (double)b.z - az;
    double length_sq = dx * dx + dz * dz;
    double side_left = dx * ((double)left.z - az) - dz * ((double)left.x - ax);
    double side_right = dx * ((double)right.z - az) - dz * ((double)right.x - ax);
    double slack = 1e-5 * (fabs(dx) + fabs(dz));
    if (length_sq == 0.0 || side_left > slack || side_right < -slack) {
        return false;
    }
    // Where the portal meets the line: in a point, or all along when it lies in it.
    double span = side_right - side_left;
    double at_left = (((double)left.x - ax) * dx + ((double)left.z - az) * dz) / length_sq;
    double at_right = (((double)right.x - ax) * dx + ((double)right.z - az) * dz) / length_sq;
    double w = span > 0.0 ? side_right / span : 0.0;
    bool in_line = span <= 2.0 * slack;
    double low = in_line ? fmin(at_left, at_right) : at_right + w * (at_left - at_right);
    double high = in_line ? fmax(at_left, at_right) : low;
    double loose = 1e-4 / sqrt(length_sq);
    if (high < *t - loose || low > 1.0 + loose) {
        return false;
    }
    *t = low > *t ? low : *t;
    return true;
}

static bool is_on(tl_vec3 point, tl_vec3 left, tl_vec3 right)
{
    return distance(point, left) + distance(point, right) <= distance(left, right) + 1e-6;
}

// The same, or it begins or ends in the portal, or touches an end of it, from whatever side.
static bool crosses(tl_vec3 a, tl_vec3 b, tl_vec3 left, tl_vec3 right, double *t)
{
    if (crosses_inside(a, b, left, right, t) || (*t <= 0.0 && is_on(a, left, right))) {
        return true;
    }
    for (int i = 0; i < 3; i++) {
        tl_vec3 touch = i == 0 ? left : i == 1 ? right : b;
        double at = distance(a, touch) / distance(a, b);
        if (is_on(touch, a, b) && is_on(touch, left, right) && at >= *t - 1e-4) {
            *t = at > *t ? at : *t;
            return true;
        }
    }
    return false;
}

// Shortest way from start to end through all portals in the plane: a shortest line bends at portal ends only, so the
// best of all chains of portal ends whose links cross the portals between them.
static double shortest(const corridor *c, tl_vec3 start, tl_vec3 end)
{
    uint32_t portals = c->count - 1;
    double best[MAX_CORRIDOR][2];
    double result = (double)INFINITY;
    for (uint32_t target = 0; target <= portals; target++) {
        for (int side = 0; side < 2; side++) {
            tl_vec3 to = target == portals ? end : side == 0 ? c->left[target] : c->right[target];
            double shortest_here = (double)INFINITY;
            for (uint32_t from = 0; from <= target; from++) { // from 0: the start, else portal from - 1
                for (int from_side = 0; from_side < 2; from_side++) {
                    tl_vec3 at = from == 0 ? start : from_side == 0 ? c->left[from - 1] : c->right[from - 1];
                    double length = (from == 0 ? 0.0 : best[from - 1][from_side]) + distance(at, to);
                    if (length >= shortest_here) {
                        continue;
                    }
                    bool visible = true;
                    double t = 0.0;
                    for (uint32_t k = from; k < target && visible; k++) {
                        visible = crosses(at, to, c->left[k], c->right[k], &t);
                    }
                    shortest_here = visible ? length : shortest_here;
                }
            }
            if (target == portals) {
                result = shortest_here;
            } else {
                best[target][side] = shortest_here;
            }
        }
    }
    return result;
}

// The edge by which a polygon was entered.
static uint32_t entry_edge(const tl_navmesh *navmesh, const corridor *c)
{
    tl_nav_link links[64];
    uint32_t count = 0;
    TEST_RESULT(tl_navmesh_links(navmesh, c->polygons[c->count - 1], links, 64, &count), TL_OK);
    for (uint32_t k = 0; k < count; k++) {
        if (c->count > 1 && links[k].to == c->polygons[c->count - 2]) {
            return links[k].edge;
        }
    }
    return UINT32_MAX;
}

// A random walk that never enters a polygon twice, nor leaves one by the edge by which it came.
static void walk(const tl_navmesh *navmesh, tl_nav_ref start, test_random *random, uint32_t length, corridor *out)
{
    out->polygons[0] = start;
    out->count = 1;
    while (out->count < length) {
        tl_nav_link links[64];
        uint32_t count = 0, choices = 0, entry = entry_edge(navmesh, out);
        TEST_RESULT(tl_navmesh_links(navmesh, out->polygons[out->count - 1], links, 64, &count), TL_OK);
        for (uint32_t k = 0; k < count; k++) {
            bool fresh = links[k].edge != entry;
            for (uint32_t i = 0; i < out->count; i++) {
                fresh = fresh && out->polygons[i] != links[k].to;
            }
            if (fresh) {
                links[choices++] = links[k];
            }
        }
        if (choices == 0) {
            return;
        }
        out->polygons[out->count++] = links[test_random_below(random, choices)].to;
    }
}

static void find_portals(const tl_navmesh *navmesh, corridor *c)
{
    for (uint32_t i = 0; i + 1 < c->count; i++) {
        tl_nav_link links[64];
        uint32_t count = 0, found = 0;
        TEST_RESULT(tl_navmesh_links(navmesh, c->polygons[i], links, 64, &count), TL_OK);
        for (uint32_t k = 0; k < count; k++) {
            if (links[k].to == c->polygons[i + 1]) {
                c->left[i] = links[k].left;
                c->right[i] = links[k].right;
                found++;
            }
        }
        TEST_CHECK(found == 1);
    }
}

typedef struct funnel_counts {
    uint32_t bends, straight, at_corners;
} funnel_counts;

static void check_corridor(const tl_navmesh *navmesh, const corridor *c, tl_vec3 start, tl_vec3 end,
                           funnel_counts *counts)
{
    tl_nav_corner corners[MAX_CORRIDOR + 1];
    uint32_t count = 0;
    float length = 0.0f;
    TEST_RESULT(tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ c->polygons, c->count, start, end }, corners,
                                         MAX_CORRIDOR + 1, &count, &length),
                TL_OK);
    TEST_CHECK(count >= 2 && corners[0].flags == TL_NAV_CORNER_START && corners[count - 1].flags == TL_NAV_CORNER_END);
    TEST_CHECK(corners[0].polygon == c->polygons[0] && corners[count - 1].polygon == c->polygons[c->count - 1]);
    double plane = 0.0, space = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        plane += distance(corners[i - 1].point, corners[i].point);
        space += (double)tl_distance(corners[i - 1].point, corners[i].point);
    }
    TEST_CHECK(fabs(space - (double)length) <= 1e-6 * space);
    double expected = shortest(c, corners[0].point, corners[count - 1].point);
    TEST_CHECK(fabs(plane - expected) <= 1e-5 * (1.0 + expected));

    // Inside: every portal is crossed by the segment between the corners around it, in order.
    uint32_t at = 0;
    for (uint32_t i = 1; i < count; i++) {
        uint32_t next = at;
        while (c->polygons[next] != corners[i].polygon) {
            next++;
            TEST_CHECK(next < c->count);
        }
        double t = 0.0;
        for (uint32_t k = at; k < next; k++) {
            TEST_CHECK(crosses(corners[i - 1].point, corners[i].point, c->left[k], c->right[k], &t));
        }
        // A corner is that end of the portal before its polygon which it says.
        if (i + 1 < count) {
            tl_vec3 own = corners[i].flags == TL_NAV_CORNER_LEFT ? c->left[next - 1] : c->right[next - 1];
            TEST_CHECK(corners[i].point.x == own.x && corners[i].point.z == own.z);
        }
        at = next;
    }
    counts->bends += count - 2;
    counts->straight += count == 2 && c->count > 2;
}

static void test_random_corridors(void **state)
{
    (void)state;
    test_random random = { 51 };
    funnel_counts counts = { 0, 0, 0 };
    for (uint32_t round = 0; round < 36; round++) {
        fixture_level level = fixture_random(&random, round % 6, 10);
        level.tile_cells = round % 2 == 0 ? 0 : 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 30; i++) {
            corridor c;
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            walk(navmesh, start.polygon, &random, 2 + test_random_below(&random, 40), &c);
            find_portals(navmesh, &c);
            fixture_refs last = { &c.polygons[c.count - 1], 1 };
            tl_nav_location end = fixture_random_location(navmesh, &last, &random);
            if (i % 3 == 0) { // start and end on corners, where portals begin at the apex
                const tl_nav_tile *tile = NULL;
                uint32_t polygon = 0, count = 0;
                TEST_RESULT(tl_navmesh_resolve(navmesh, start.polygon, &tile, &polygon), TL_OK);
                start.point = tl_nav_tile_corners(tile, polygon, &count)[test_random_below(&random, 3)];
                TEST_RESULT(tl_navmesh_resolve(navmesh, end.polygon, &tile, &polygon), TL_OK);
                end.point = tl_nav_tile_corners(tile, polygon, &count)[test_random_below(&random, 3)];
                counts.at_corners++;
            }
            check_corridor(navmesh, &c, start.point, end.point, &counts);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(counts.bends > 1000 && counts.straight > 50 && counts.at_corners > 200);
}

// Around a block: the corners are the block's own.
static void test_example(void **state)
{
    (void)state;
    const char *const rows[] = { "0000", "0##0", "0000" };
    fixture_level level = fixture_make(rows, 3);
    level.cell_size = 1.0f / FIXTURE_STEP; // cells of a metre
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_ref polygons[16];
    tl_nav_corner corners[16];
    tl_nav_path_buffers buffers = { polygons, 16, corners, 16 };
    tl_nav_route route;
    tl_vec3 extents = { 0.1f, 1, 0.1f };
    TEST_RESULT(tl_nav_query_find_route(query, navmesh,
                                        &(tl_nav_route_request){ NULL, tl_vec3_make(0.5f, 0, 1.25f),
                                                                 tl_vec3_make(3.5f, 0, 1.25f), extents },
                                        &buffers, &route),
                TL_OK);
    TEST_CHECK(route.corner_count == 4);
    TEST_CHECK(corners[1].point.x == 1.0f && corners[1].point.z == 1.0f && corners[2].point.x == 3.0f);
    // From x to x, with z down the page and y up, the block lies on the right hand.
    TEST_CHECK(corners[1].flags == TL_NAV_CORNER_RIGHT && corners[2].flags == TL_NAV_CORNER_RIGHT);
    TEST_CHECK(fabsf(route.length - (2.0f + 2.0f * hypotf(0.5f, 0.25f))) < 1e-6f);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "000" };
    fixture_level level = fixture_make(rows, 1);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_ref polygons[3];
    for (uint32_t i = 0; i < 3; i++) {
        polygons[i] = tl_navmesh_polygon_ref(navmesh, 0, i);
    }
    tl_nav_ref gap[2] = { polygons[0], polygons[2] }, stale[2] = { polygons[0], 99 };
    tl_nav_corner corners[4];
    uint32_t count = 0;
    float length = 0.0f;
    tl_vec3 a = { 1, 0, 1 }, b = { 11, 0, 1 }, nan = { NAN, 0, 0 };
    TEST_RESULT(
        tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ polygons, 0, a, b }, corners, 4, &count, &length),
        TL_ERR_ARGUMENT);
    TEST_RESULT(tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ gap, 2, a, b }, corners, 4, &count, &length),
                TL_ERR_ARGUMENT);
    TEST_RESULT(
        tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ stale, 2, a, b }, corners, 4, &count, &length),
        TL_ERR_STALE);
    TEST_RESULT(
        tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ polygons, 3, nan, b }, corners, 4, &count, &length),
        TL_ERR_NOT_FINITE);
    TEST_RESULT(
        tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ polygons, 3, a, b }, corners, 1, &count, &length),
        TL_INCOMPLETE);
    TEST_CHECK(count == 2 && length == 10.0f);
    // Start and end in the same place are still two corners; points outside are moved in.
    TEST_RESULT(
        tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ polygons, 1, a, a }, corners, 4, &count, NULL),
        TL_OK);
    TEST_CHECK(count == 2);
    tl_vec3 outside = { -5, 0, 1 };
    TEST_RESULT(tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ polygons, 3, outside, b }, corners, 4, &count,
                                         &length),
                TL_OK);
    TEST_CHECK(corners[0].point.x == 0.0f && length == 11.0f);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_example),
        cmocka_unit_test(test_random_corridors),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
