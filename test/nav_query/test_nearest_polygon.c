// SPDX-License-Identifier: MIT
//
// Nearest polygon, closest point and height, against trying everything.

#include "nav_fixture.h"

#include <math.h>

static double turn(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return ((double)b.x - (double)a.x) * ((double)c.z - (double)a.z) -
           ((double)b.z - (double)a.z) * ((double)c.x - (double)a.x);
}

// Distance in the plane from a point to a polygon, by its edges; 0 inside.
static double plane_distance(const tl_vec3 *corners, uint32_t count, tl_vec3 p)
{
    bool inside = true;
    double best = (double)INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = corners[i], b = corners[(i + 1) % count];
        inside = inside && turn(a, b, p) <= 0.0;
        double dx = (double)b.x - (double)a.x, dz = (double)b.z - (double)a.z;
        double t = (((double)p.x - (double)a.x) * dx + ((double)p.z - (double)a.z) * dz) / (dx * dx + dz * dz);
        t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
        double distance = hypot((double)a.x + t * dx - (double)p.x, (double)a.z + t * dz - (double)p.z);
        best = distance < best ? distance : best;
    }
    return inside ? 0.0 : best;
}

static void test_closest_point(void **state)
{
    (void)state;
    test_random random = { 31 };
    uint32_t insides = 0, outsides = 0;
    for (uint32_t round = 0; round < 12; round++) {
        fixture_level level = fixture_random(&random, round % 6, 6);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 400; i++) {
            tl_nav_ref ref = all.refs[test_random_below(&random, all.count)];
            tl_vec3 p = test_random_point(&random, tl_vec3_make(-10, -5, 8), tl_vec3_make(20, 10, 40));
            if (i % 2 == 0) {
                p = fixture_random_location(navmesh, &all, &random).point;
            }
            const tl_nav_tile *tile = NULL;
            uint32_t polygon = 0, count = 0;
            TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
            const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
            tl_vec3 closest;
            bool inside = false;
            TEST_RESULT(tl_navmesh_closest_point(navmesh, ref, p, &closest, &inside), TL_OK);
            double expected = plane_distance(corners, count, p);
            double found = hypot((double)closest.x - (double)p.x, (double)closest.z - (double)p.z);
            TEST_CHECK(fabs(found - expected) < 1e-5);
            TEST_CHECK(plane_distance(corners, count, closest) < 1e-5);
            TEST_CHECK(inside == (closest.x == p.x && closest.z == p.z));
            float height = 0.0f;
            TEST_RESULT(tl_navmesh_height(navmesh, ref, p.x, p.z, &height), TL_OK);
            TEST_CHECK(height == closest.y);
            insides += inside;
            outsides += !inside;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(insides > 100 && outsides > 1000);
}

// At detail vertices the height is theirs; between, it is that of a triangle's plane.
static void test_height(void **state)
{
    (void)state;
    test_random random = { 32 };
    fixture_level level = fixture_random(&random, 5, 8);
    level.detail = true;
    level.slope = 2;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, 0);
    uint32_t checked = 0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        tl_nav_surface surface = tl_nav_tile_surface(tile, p);
        tl_nav_ref ref = tl_navmesh_polygon_ref(navmesh, 0, p);
        for (uint32_t i = 0; i < surface.triangle_count; i++) {
            const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i);
            const uint16_t *corner = triangle.corner;
            tl_vec3 a = surface.vertices[corner[0]], b = surface.vertices[corner[1]], c = surface.vertices[corner[2]];
            float u = test_random_unit(&random), v = test_random_unit(&random) * (1.0f - u);
            tl_vec3 point = tl_mul_add(tl_mul_add(a, tl_sub(b, a), u), tl_sub(c, a), v);
            float height = 0.0f;
            TEST_RESULT(tl_navmesh_height(navmesh, ref, point.x, point.z, &height), TL_OK);
            TEST_CHECK(fabsf(height - point.y) < 1e-4f);
            TEST_RESULT(tl_navmesh_height(navmesh, ref, c.x, c.z, &height), TL_OK);
            TEST_CHECK(fabsf(height - c.y) < 1e-5f);
            checked++;
        }
    }
    TEST_CHECK(checked > 200);
    tl_navmesh_destroy(navmesh);
}

// The documented measure, squared.
static float measure(const tl_nav_tile *tile, tl_vec3 center, tl_vec3 p)
{
    float dx = p.x - center.x, dz = p.z - center.z, dy = p.y - center.y;
    dy = dy > tile->agent_max_climb ? dy + tile->agent_height : dy;
    return dx * dx + dz * dz + dy * dy;
}

static void test_nearest_by_brute_force(void **state)
{
    (void)state;
    test_random random = { 33 };
    uint32_t found = 0, none = 0, outside = 0, ties = 0;
    for (uint32_t round = 0; round < 36; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 3 == 0 ? 0 : 3;
        level.shake = round % 4 == 0 ? 0 : level.shake;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 200; i++) {
            tl_vec3 center = test_random_point(&random, tl_vec3_make(-12, -3, 6), tl_vec3_make(30, 8, 48));
            if (i % 4 == 0) {
                center = fixture_random_location(navmesh, &all, &random).point;
                center.y += test_random_range(&random, -0.6f, 2.2f);
            }
            if (i % 8 == 1) { // on lattice lines, where polygons tie
                center.x = level.origin.x + 4.0f * (float)test_random_below(&random, 8);
                center.z = level.origin.z + 4.0f * (float)test_random_below(&random, 8);
            }
            tl_vec3 extents = test_random_point(&random, tl_vec3_make(0, 0, 0), tl_vec3_make(5, 5, 5));
            tl_aabb box = { tl_sub(center, extents), tl_add(center, extents) };
            tl_nav_ref best = TL_NAV_NO_REF;
            float best_measure = INFINITY;
            for (uint32_t k = 0; k < all.count; k++) {
                const tl_nav_tile *tile = NULL;
                tl_vec3 closest;
                TEST_RESULT(tl_navmesh_resolve(navmesh, all.refs[k], &tile, NULL), TL_OK);
                TEST_RESULT(tl_navmesh_closest_point(navmesh, all.refs[k], center, &closest, NULL), TL_OK);
                float m = measure(tile, center, closest);
                ties += tl_aabb_contains(box, closest) && m == best_measure;
                if (tl_aabb_contains(box, closest) && m < best_measure) {
                    best = all.refs[k];
                    best_measure = m;
                }
            }
            tl_nav_location nearest;
            tl_result result = tl_navmesh_find_nearest(navmesh, NULL, center, extents, &nearest);
            TEST_RESULT(result, best != TL_NAV_NO_REF ? TL_OK : TL_NOT_FOUND);
            TEST_CHECK(nearest.polygon == best);
            found += result == TL_OK;
            none += result != TL_OK;
            outside += result == TL_OK && (nearest.point.x != center.x || nearest.point.z != center.z);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(found > 2000 && none > 500 && outside > 500 && ties > 100);
}

// Floors 2.5 m apart, an agent of 2 m: every point of its body belongs to the floor it stands on.
static void test_never_the_floor_overhead(void **state)
{
    (void)state;
    const char *const rows[] = { "....", "....", "....", "...." };
    fixture_level level = fixture_make(rows, 4);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_vec3 extents = { 1, 4, 1 };
    uint32_t nearer_overhead = 0;
    for (int height = -4; height <= 19; height++) {
        tl_vec3 center = { 5.0f, (float)height * 0.1f, 6.0f };
        tl_nav_location nearest;
        TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, center, extents, &nearest), TL_OK);
        TEST_CHECK(nearest.point.y == 0.0f && nearest.point.x == 5.0f);
        nearer_overhead += 2.5f - center.y < center.y;
    }
    TEST_CHECK(nearer_overhead >= 6);
    // From the climb under the upper floor on, that one is meant.
    tl_nav_location nearest;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(5, 2.1f, 6), extents, &nearest), TL_OK);
    TEST_CHECK(nearest.point.y == 2.5f);
    // Alone in the box, the floor overhead is found too.
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(5, 1.5f, 6), tl_vec3_make(1, 1.2f, 1), &nearest),
                TL_OK);
    TEST_CHECK(nearest.point.y == 2.5f);
    tl_navmesh_destroy(navmesh);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "00" };
    fixture_level level = fixture_make(rows, 1);
    tl_navmesh *navmesh = NULL;
    tl_nav_location nearest;
    tl_vec3 p = { 1, 0, 1 }, extents = { 1, 1, 1 }, nan = { NAN, 0, 0 };
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, p, extents, &nearest), TL_NOT_FOUND);
    tl_navmesh_destroy(navmesh);
    navmesh = fixture_build(&level, NULL);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, nan, extents, &nearest), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, p, nan, &nearest), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, p, tl_vec3_make(-1, 1, 1), &nearest), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, p, tl_vec3_make(1e30f, 1e30f, 1e30f), &nearest), TL_OK);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.exclude_flags = 1;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, &filter, p, extents, &nearest), TL_NOT_FOUND);
    TEST_CHECK(nearest.polygon == TL_NAV_NO_REF);
    filter.exclude_flags = 0;
    filter.include_flags = 2;
    TEST_CHECK(!tl_nav_filter_passes(&filter, tl_navmesh_slot_tile(navmesh, 0), 0));
    filter.include_flags = 3;
    TEST_CHECK(tl_nav_filter_passes(&filter, tl_navmesh_slot_tile(navmesh, 0), 0));
    float height = 1.0f;
    TEST_RESULT(tl_navmesh_height(navmesh, 12345, 0, 0, &height), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_height(navmesh, tl_navmesh_polygon_ref(navmesh, 0, 0), NAN, 0, &height), TL_ERR_NOT_FINITE);
    tl_navmesh_destroy(navmesh);
}

// 100 million metres from the origin a float's step is 8 metres: nothing may break, everything stays finite.
static void test_far_from_the_origin(void **state)
{
    (void)state;
    test_random random = { 34 };
    for (uint32_t round = 0; round < 6; round++) {
        fixture_level level = fixture_random(&random, 0, 6);
        level.origin = tl_vec3_make(1e8f, 0, -1e8f);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 50; i++) {
            tl_nav_location a = fixture_random_location(navmesh, &all, &random), nearest;
            TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, a.point, tl_vec3_make(32, 4, 32), &nearest), TL_OK);
            TEST_CHECK(isfinite(nearest.point.y) && tl_distance(nearest.point, a.point) <= 64.0f);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closest_point),
        cmocka_unit_test(test_height),
        cmocka_unit_test(test_nearest_by_brute_force),
        cmocka_unit_test(test_never_the_floor_overhead),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_far_from_the_origin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
