// SPDX-License-Identifier: MIT
//
// Rays along the surface against the union of the stretches that polygons cover on them.

#include "nav_fixture.h"
#include "nav_path_checks.h"

#include <math.h>

typedef struct stretch {
    double low, high;
} stretch;

static int compare_stretches(const void *a, const void *b)
{
    double x = ((const stretch *)a)->low, y = ((const stretch *)b)->low;
    return (x > y) - (x < y);
}

// The part [low, high] of the segment inside a convex polygon; false when there is none.
static bool clip(const tl_vec3 *corners, uint32_t count, tl_vec3 start, tl_vec3 end, stretch *out)
{
    stretch s = { 0.0, 1.0 };
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = corners[i], b = corners[(i + 1) % count];
        double ex = (double)b.x - (double)a.x, ez = (double)b.z - (double)a.z;
        double at_start = ex * ((double)start.z - (double)a.z) - ez * ((double)start.x - (double)a.x);
        double at_end = ex * ((double)end.z - (double)a.z) - ez * ((double)end.x - (double)a.x);
        if (at_start > 0.0 && at_end > 0.0) {
            return false;
        }
        if (at_start > 0.0 || at_end > 0.0) {
            double t = at_start / (at_start - at_end);
            if (at_start > 0.0) {
                s.low = t > s.low ? t : s.low;
            } else {
                s.high = t < s.high ? t : s.high;
            }
        }
    }
    *out = s;
    return s.low <= s.high;
}

// How far the segment stays on a level of one floor.
static double reach(const tl_navmesh *navmesh, const fixture_refs *all, tl_vec3 start, tl_vec3 end)
{
    stretch *stretches = malloc(all->count * sizeof *stretches);
    uint32_t stretch_count = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const tl_nav_tile *tile = NULL;
        uint32_t polygon = 0, count = 0;
        TEST_RESULT(tl_navmesh_resolve(navmesh, all->refs[i], &tile, &polygon), TL_OK);
        const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
        stretch_count += clip(corners, count, start, end, &stretches[stretch_count]) ? 1 : 0;
    }
    qsort(stretches, stretch_count, sizeof *stretches, compare_stretches);
    double t = 0.0;
    for (uint32_t i = 0; i < stretch_count; i++) {
        if (stretches[i].low <= t + 1e-6) {
            t = stretches[i].high > t ? stretches[i].high : t;
        }
    }
    free(stretches);
    return t;
}

static void check_crossed(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t count)
{
    for (uint32_t i = 0; i + 1 < count; i++) {
        TEST_CHECK(test_are_linked(navmesh, polygons[i], polygons[i + 1]));
    }
}

static void test_random_rays(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t hits = 0, passes = 0, far = 0;
    for (uint32_t round = 0; round < 40; round++) {
        fixture_level level = fixture_random(&random, round % 5, 10);
        level.tile_cells = round % 2 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 100; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_vec3 end = fixture_random_location(navmesh, &all, &random).point;
            end = i % 4 == 0 ? tl_mul_add(start.point, tl_sub(end, start.point), 3.0f) : end;
            tl_nav_ref polygons[256];
            tl_nav_ray_hit hit;
            TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, end, polygons, 256, &hit), TL_OK);
            double expected = reach(navmesh, &all, start.point, end);
            TEST_CHECK(hit.hit == (expected < 1.0 - 1e-6));
            TEST_CHECK(fabs((double)hit.t - expected) < 2e-6);
            check_crossed(navmesh, polygons, hit.polygon_count);
            TEST_CHECK(polygons[0] == start.polygon && polygons[hit.polygon_count - 1] == hit.polygon);
            tl_vec3 along = tl_sub(end, start.point);
            TEST_CHECK(!hit.hit || hit.normal.x * along.x + hit.normal.z * along.z <= 0.0f);
            TEST_CHECK(fabsf(tl_length(hit.normal) - (hit.hit ? 1.0f : 0.0f)) < 1e-5f);
            hits += hit.hit;
            passes += !hit.hit;
            far += hit.polygon_count > 8;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(hits > 1000 && passes > 500 && far > 300);
}

// On floors over one another the ray stays on its own.
static void test_two_floors(void **state)
{
    (void)state;
    test_random random = { 62 };
    uint32_t climbed = 0, crossed = 0;
    for (uint32_t round = 0; round < 12; round++) {
        fixture_level level = fixture_random(&random, 5, 10);
        level.tile_cells = round % 2 == 0 ? 0 : 3;
        level.slope = 0;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 200; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_vec3 end = fixture_random_location(navmesh, &all, &random).point;
            tl_nav_ref polygons[256];
            tl_nav_ray_hit hit;
            TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, end, polygons, 256, &hit), TL_OK);
            check_crossed(navmesh, polygons, hit.polygon_count);
            float height;
            TEST_RESULT(tl_navmesh_height(navmesh, hit.polygon, hit.point.x, hit.point.z, &height), TL_OK);
            TEST_CHECK(fabsf(hit.point.y - (start.point.y + (end.y - start.point.y) * hit.t)) <= 1e-4f);
            climbed += fabsf(height - start.point.y) > 2.0f;
            crossed += hit.polygon_count > 3;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(climbed > 20 && crossed > 100);
}

// Along walls, through vertices, from corner to corner: a ray that only touches passes.
static void test_grazing(void **state)
{
    (void)state;
    const char *const rows[] = { "00000", "00#00", "00000", "0#000", "00000" };
    fixture_level level = fixture_make(rows, 5);
    level.cell_size = 0.3f;
    level.origin = tl_vec3_make(812.77f, 0, -333.33f);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    // Lattice lines: the level's outline, and those that touch the blocks on one side.
    const float lines[][4] = { { 0, 0, 5, 0 }, { 5, 0, 5, 5 }, { 0, 0, 0, 5 }, { 0, 5, 5, 5 }, { 0, 1, 5, 1 },
                               { 0, 2, 5, 2 }, { 2, 0, 2, 3 }, { 3, 0, 3, 5 }, { 0, 0, 2, 2 }, { 2, 2, 5, 5 },
                               { 1, 0, 3, 4 }, { 0, 3, 3, 0 }, { 3, 3, 5, 1 }, { 0, 3, 5, 3 }, { 0, 2, 2, 3 } };
    uint32_t cast = 0;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        for (int way = 0; way < 2; way++) {
            const float *line = lines[i];
            float step = FIXTURE_STEP * level.cell_size;
            tl_vec3 ends[2] = { { level.origin.x + line[0] * step, 0, level.origin.z + line[1] * step },
                                { level.origin.x + line[2] * step, 0, level.origin.z + line[3] * step } };
            tl_nav_location start;
            tl_nav_ray_hit hit;
            TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, ends[way], tl_vec3_make(1, 1, 1), &start), TL_OK);
            TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, ends[1 - way], NULL, 0, &hit), TL_OK);
            TEST_CHECK(!hit.hit && hit.t == 1.0f);
            cast++;
        }
    }
    TEST_CHECK(cast == 30);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

// Each leg of a straight path is free for a ray, though it touches the corners that it bends around.
static void test_legs_of_paths(void **state)
{
    (void)state;
    test_random random = { 63 };
    tl_nav_query *query = NULL;
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t legs = 0;
    for (uint32_t round = 0; round < 20; round++) {
        fixture_level level = fixture_random(&random, round % 5, 12);
        level.tile_cells = round % 2 == 0 ? 0 : 5;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 40; i++) {
            tl_vec3 start = fixture_random_location(navmesh, &all, &random).point;
            tl_vec3 goal = fixture_random_location(navmesh, &all, &random).point;
            tl_nav_ref polygons[256];
            tl_nav_corner corners[256];
            tl_nav_path_buffers buffers = { polygons, 256, corners, 256 };
            tl_nav_route route;
            TEST_RESULT(tl_nav_query_find_route(query, navmesh,
                                                &(tl_nav_route_request){ NULL, start, goal, tl_vec3_make(1, 2, 1) },
                                                &buffers, &route),
                        TL_OK);
            for (uint32_t k = 0; k + 1 < route.corner_count; k++) {
                tl_nav_location from = { corners[k].polygon, corners[k].point };
                tl_nav_ray_hit hit;
                TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &from, corners[k + 1].point, NULL, 0, &hit), TL_OK);
                TEST_CHECK(!hit.hit);
                legs++;
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(legs > 1500);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "000" };
    fixture_level level = fixture_make(rows, 1);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_location start = { tl_navmesh_polygon_ref(navmesh, 0, 0), { 1, 0, 2 } };
    tl_nav_location stale = { 99, { 1, 0, 2 } };
    tl_nav_ref polygons[4] = { 0 };
    tl_nav_ray_hit hit;
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &stale, start.point, NULL, 0, &hit), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, tl_vec3_make(NAN, 0, 0), NULL, 0, &hit), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, tl_vec3_make(21, 0, 2), polygons, 2, &hit), TL_INCOMPLETE);
    TEST_CHECK(hit.hit && hit.polygon_count == 3 && polygons[2] == 0 && hit.edge == 2);
    TEST_CHECK(fabsf(hit.t - 0.55f) < 1e-6f && hit.normal.x == -1.0f && fabsf(hit.point.x - 12.0f) < 1e-5f);
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &start, start.point, polygons, 1, &hit), TL_OK);
    TEST_CHECK(!hit.hit && hit.polygon_count == 1 && polygons[0] == start.polygon);
    // A filter is a wall.
    tl_nav_filter filter = tl_default_nav_filter();
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    tl_nav_tile_set_flags(tile, 1, 4);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    start.polygon = tl_navmesh_polygon_ref(navmesh, 0, 0);
    filter.exclude_flags = 4;
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, &filter, &start, tl_vec3_make(11, 0, 2), NULL, 0, &hit), TL_OK);
    TEST_CHECK(hit.hit && hit.polygon_count == 1 && fabsf(hit.point.x - 4.0f) < 1e-5f);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_rays),   cmocka_unit_test(test_two_floors), cmocka_unit_test(test_grazing),
        cmocka_unit_test(test_legs_of_paths), cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
