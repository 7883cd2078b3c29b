// SPDX-License-Identifier: MIT
//
// Traced paths: points follow the corners' line, crossings lie on portals in the order of the polygons, and the cost is
// what an integral over many small steps says.

#include "nav_fixture.h"

#include <math.h>

enum { CAPACITY = 512 };

static float area_cost(uint32_t area)
{
    return 1.0f + (float)(area % 3);
}

static uint8_t area_of(const tl_navmesh *navmesh, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    return tl_nav_tile_area(tile, polygon);
}

static double distance_to_leg(tl_vec3 p, tl_vec3 a, tl_vec3 b)
{
    double ex = (double)b.x - (double)a.x, ez = (double)b.z - (double)a.z, length_sq = ex * ex + ez * ez;
    double px = (double)p.x - (double)a.x, pz = (double)p.z - (double)a.z;
    double t = length_sq > 0.0 ? fmin(fmax((px * ex + pz * ez) / length_sq, 0.0), 1.0) : 0.0;
    return hypot(px - t * ex, pz - t * ez);
}

static bool is_in(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 p)
{
    tl_vec3 closest;
    TEST_RESULT(tl_navmesh_closest_point(navmesh, ref, p, &closest, NULL), TL_OK);
    return hypot((double)closest.x - (double)p.x, (double)closest.z - (double)p.z) < 1e-3;
}

// Each piece between two points lies in the polygon that the first one names.
static void check_points(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t polygon_count,
                         const tl_nav_corner *corners, uint32_t corner_count, const tl_nav_trace_point *points,
                         uint32_t count, float cost)
{
    double sum = 0.0;
    uint32_t corner = 0, at = 0, crossings = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (corner + 1 < corner_count && points[i].point.x == corners[corner + 1].point.x &&
            points[i].point.z == corners[corner + 1].point.z) {
            corner++;
        }
        TEST_CHECK(distance_to_leg(points[i].point, corners[corner].point,
                                   corners[corner + 1 < corner_count ? corner + 1 : corner].point) < 1e-3);
        while (at < polygon_count && polygons[at] != points[i].polygon) {
            at++;
        }
        TEST_CHECK(at < polygon_count);
        crossings += (points[i].flags & TL_NAV_CORNER_CROSSING) != 0;
        if (i + 1 < count) {
            tl_vec3 middle = tl_lerp(points[i].point, points[i + 1].point, 0.5f);
            TEST_CHECK(is_in(navmesh, points[i].polygon, middle));
            sum += (double)tl_distance(points[i].point, points[i + 1].point) *
                   (double)area_cost(area_of(navmesh, points[i].polygon));
            TEST_CHECK(points[i + 1].cost >= points[i].cost && points[i + 1].length >= points[i].length);
        }
    }
    TEST_CHECK(corner + 1 == corner_count && at + 1 == polygon_count && crossings < polygon_count);
    TEST_CHECK(fabs(sum - (double)cost) < 1e-3 && points[count - 1].cost == cost);
}

static void test_paths(void **state)
{
    (void)state;
    test_random random = { 401 };
    tl_nav_query_def def = { 8192, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_filter filter = tl_default_nav_filter();
    for (uint32_t area = 0; area <= TL_NAV_MAX_AREA; area++) {
        filter.area_cost[area] = area_cost(area);
    }
    uint32_t paths = 0, exact = 0, rays = 0, bends = 0, crossings = 0, areas = 0;
    for (uint32_t round = 0; round < 48; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        level.area_count = 5;
        level.slope = round % 2 == 0 ? 0 : level.slope;
        level.detail = false;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 12; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
            tl_nav_ref polygons[CAPACITY];
            tl_nav_corner corners[CAPACITY];
            tl_nav_trace_point points[CAPACITY], few[CAPACITY];
            uint32_t polygon_count = 0, corner_count = 0, count = 0, few_count = 0;
            float cost = 0.0f, length = 0.0f;
            if (i % 3 == 0) {
                tl_nav_path path;
                TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ &filter, start, goal },
                                                   polygons, CAPACITY, &path),
                            TL_OK);
                if (path.status != TL_NAV_PATH_COMPLETE) {
                    continue;
                }
                polygon_count = path.polygon_count;
                TEST_RESULT(tl_navmesh_straight_path(
                                navmesh, &(tl_nav_polygon_path){ polygons, polygon_count, start.point, goal.point },
                                corners, CAPACITY, &corner_count, &length),
                            TL_OK);
                paths++;
            } else if (i % 3 == 1) {
                tl_nav_shortest_path path;
                TEST_RESULT(tl_nav_query_find_shortest_path(
                                query, navmesh, &(tl_nav_path_request){ NULL, start, goal },
                                &(tl_nav_path_buffers){ polygons, CAPACITY, corners, CAPACITY }, &path),
                            TL_OK);
                if (path.status != TL_NAV_PATH_COMPLETE) {
                    continue;
                }
                polygon_count = path.polygon_count;
                corner_count = path.corner_count;
                exact++;
            } else {
                tl_nav_ray_hit hit;
                TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, goal.point, polygons, CAPACITY, &hit), TL_OK);
                polygon_count = hit.polygon_count;
                tl_nav_corner ends[2] = { { start.point, start.polygon, TL_NAV_CORNER_START, TL_NAV_NO_REF },
                                          { hit.point, hit.polygon, TL_NAV_CORNER_END, TL_NAV_NO_REF } };
                memcpy(corners, ends, sizeof ends);
                corner_count = 2;
                rays++;
            }
            TEST_RESULT(tl_navmesh_trace_path(navmesh,
                                              &(tl_nav_trace_request){ &filter, polygons, polygon_count, corners,
                                                                       corner_count, TL_NAV_CORNER_CROSSING },
                                              points, CAPACITY, &count, &cost),
                        TL_OK);
            check_points(navmesh, polygons, polygon_count, corners, corner_count, points, count, cost);
            // Area crossings alone are those among all; corners alone are the corners.
            TEST_RESULT(tl_navmesh_trace_path(navmesh,
                                              &(tl_nav_trace_request){ &filter, polygons, polygon_count, corners,
                                                                       corner_count, TL_NAV_CORNER_AREA },
                                              few, CAPACITY, &few_count, NULL),
                        TL_OK);
            uint32_t area_points = 0;
            for (uint32_t k = 0; k < count; k++) {
                bool is_corner = (points[k].flags & ~(TL_NAV_CORNER_CROSSING | TL_NAV_CORNER_AREA)) != 0;
                area_points += is_corner || (points[k].flags & TL_NAV_CORNER_AREA) != 0;
                crossings += (points[k].flags & TL_NAV_CORNER_CROSSING) != 0;
                areas += (points[k].flags & TL_NAV_CORNER_AREA) != 0;
            }
            TEST_CHECK(few_count >= corner_count && few_count <= count && few_count >= area_points);
            TEST_RESULT(tl_navmesh_trace_path(
                            navmesh,
                            &(tl_nav_trace_request){ &filter, polygons, polygon_count, corners, corner_count, 0 }, few,
                            CAPACITY, &few_count, NULL),
                        TL_OK);
            TEST_CHECK(few_count <= corner_count);
            tl_result expected = few_count > 1 ? TL_INCOMPLETE : TL_OK;
            TEST_RESULT(tl_navmesh_trace_path(
                            navmesh,
                            &(tl_nav_trace_request){ &filter, polygons, polygon_count, corners, corner_count, 0 }, few,
                            1, &few_count, &length),
                        expected);
            TEST_CHECK(length == cost);
            bends += corner_count > 2;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(paths > 80 && exact > 80 && rays > 150 && bends > 60 && crossings > 1000 && areas > 300);
}

static void test_link_and_arguments(void **state)
{
    (void)state;
    tl_nav_ref link = TL_NAV_NO_REF;
    tl_navmesh *navmesh = fixture_gap(&link);
    tl_nav_query_def def = { 64, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_ref polygons[8];
    tl_vec3 extents = { 1, 1, 1 };
    tl_nav_location start, goal;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 2), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(22, 0, 2), extents, &goal), TL_OK);
    tl_nav_path path;
    tl_nav_corner corners[8];
    tl_nav_trace_point points[8];
    uint32_t corner_count = 0, count = 0;
    float cost = 0.0f;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons, 8, &path),
                TL_OK);
    TEST_RESULT(tl_navmesh_straight_path(
                    navmesh, &(tl_nav_polygon_path){ polygons, path.polygon_count, start.point, goal.point }, corners,
                    8, &corner_count, NULL),
                TL_OK);
    TEST_RESULT(tl_navmesh_trace_path(navmesh,
                                      &(tl_nav_trace_request){ NULL, polygons, path.polygon_count, corners,
                                                               corner_count, TL_NAV_CORNER_CROSSING },
                                      points, 8, &count, &cost),
                TL_OK);
    // Start, an edge, the link, its landing, an edge, the end: 20 m and 3.
    TEST_CHECK(count == 6 && fabsf(cost - 23.0f) < 1e-4f && (points[2].flags & TL_NAV_CORNER_LINK) != 0);
    TEST_CHECK(points[3].point.x == 16.5f && fabsf(points[5].length - 20.0f) < 1e-4f);
    TEST_RESULT(tl_navmesh_trace_path(navmesh, &(tl_nav_trace_request){ NULL, polygons, 0, corners, corner_count, 0 },
                                      points, 8, &count, &cost),
                TL_ERR_ARGUMENT);
    TEST_RESULT(tl_navmesh_trace_path(navmesh, &(tl_nav_trace_request){ NULL, polygons, 5, corners, 1, 0 }, points, 8,
                                      &count, &cost),
                TL_ERR_ARGUMENT);
    TEST_RESULT(tl_navmesh_remove_offmesh(navmesh, link), TL_OK);
    TEST_RESULT(tl_navmesh_trace_path(navmesh, &(tl_nav_trace_request){ NULL, polygons, 5, corners, corner_count, 0 },
                                      points, 8, &count, &cost),
                TL_ERR_STALE);
    polygons[1] = polygons[4];
    TEST_RESULT(tl_navmesh_trace_path(navmesh, &(tl_nav_trace_request){ NULL, polygons, 2, corners, 2, 0 }, points, 8,
                                      &count, &cost),
                TL_ERR_ARGUMENT);
    polygons[0] = 77;
    TEST_CHECK(tl_navmesh_trace_path(navmesh, &(tl_nav_trace_request){ NULL, polygons, 2, corners, 2, 0 }, points, 8,
                                     &count, &cost) != TL_OK);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_paths), cmocka_unit_test(test_link_and_arguments) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
