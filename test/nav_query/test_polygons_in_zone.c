// SPDX-License-Identifier: MIT
//
// Polygons in zones, against clipping and distances that look at every polygon.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_around.h>

typedef struct plane_point {
    double x, z;
} plane_point;

// How far two convex outlines overlap along the direction in which they do least: < 0 apart, and by how much at least.
static double overlap_of(const plane_point *a, uint32_t a_count, const plane_point *b, uint32_t b_count)
{
    double least = (double)INFINITY;
    for (uint32_t pass = 0; pass < 2; pass++) {
        const plane_point *edges = pass == 0 ? a : b;
        uint32_t count = pass == 0 ? a_count : b_count;
        for (uint32_t i = 0; i < count; i++) {
            double nx = edges[(i + 1) % count].z - edges[i].z, nz = edges[i].x - edges[(i + 1) % count].x;
            double length = hypot(nx, nz), low[2] = { 1e30, 1e30 }, high[2] = { -1e30, -1e30 };
            for (uint32_t k = 0; k < a_count + b_count; k++) {
                const plane_point *p = k < a_count ? &a[k] : &b[k - a_count];
                double along = (p->x * nx + p->z * nz) / length;
                uint32_t which = k < a_count ? 0 : 1;
                low[which] = fmin(low[which], along);
                high[which] = fmax(high[which], along);
            }
            least = fmin(least, fmin(high[0], high[1]) - fmax(low[0], low[1]));
        }
    }
    return least;
}

static uint32_t corners_of(const tl_navmesh *navmesh, tl_nav_ref ref, plane_point *out, tl_aabb *box_out)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0, count = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    *box_out = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        out[i].x = (double)corners[i].x;
        out[i].z = (double)corners[i].z;
    }
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        *box_out = tl_aabb_add_point(*box_out, surface.vertices[i]);
    }
    return count;
}

// A convex outline around a place: points on an ellipse, in either winding.
static uint32_t random_outline(test_random *random, tl_vec3 center, tl_vec3 *points)
{
    uint32_t count = 3 + test_random_below(random, 6);
    float a = test_random_range(random, 0.3f, 6.0f), b = test_random_range(random, 0.3f, 6.0f);
    double turn = (double)test_random_range(random, 0.0f, 6.28f);
    double sign = test_random_below(random, 2) == 0 ? 1.0 : -1.0;
    for (uint32_t i = 0; i < count; i++) {
        double angle = turn + sign * 6.283185307179586 * (double)i / (double)count;
        points[i] = tl_vec3_make(center.x + a * (float)cos(angle), 0.0f, center.z + b * (float)sin(angle));
    }
    return count;
}

static void test_zones(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t found = 0, left_out = 0, by_height = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 3 == 0 ? 0 : 2;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 12; i++) {
            tl_nav_location at = fixture_random_location(navmesh, &all, &random);
            tl_vec3 points[8];
            uint32_t count = 0;
            tl_nav_zone zone = tl_nav_zone_circle(at.point, test_random_range(&random, 0.0f, 7.0f));
            if (i % 2 == 0) {
                count = random_outline(&random, at.point, points);
                zone = tl_nav_zone_polygon(points, count);
            }
            float low = i % 3 == 0 ? at.point.y - 0.3f : -INFINITY, high = i % 3 == 0 ? at.point.y + 0.3f : INFINITY;
            tl_nav_ref refs[1024];
            uint32_t ref_count = 0;
            TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ low, high }, refs, 1024,
                                                 &ref_count),
                        TL_OK);
            plane_point outline[128];
            for (uint32_t k = 0; k < count; k++) {
                outline[k].x = (double)points[k].x;
                outline[k].z = (double)points[k].z;
            }
            // A circle is a polygon of many corners: its distance errs by a thousandth of the radius.
            for (uint32_t k = 0; i % 2 == 1 && k < 128; k++) {
                double angle = 6.283185307179586 * k / 128.0;
                outline[k].x = (double)at.point.x + (double)zone.radius * cos(angle);
                outline[k].z = (double)at.point.z + (double)zone.radius * sin(angle);
                count = 128;
            }
            double slack = i % 2 == 1 ? 1e-3 * (double)zone.radius + 1e-5 : 1e-5;
            for (uint32_t k = 0; k < all.count; k++) {
                plane_point corners[64];
                tl_aabb box;
                uint32_t corner_count = corners_of(navmesh, all.refs[k], corners, &box);
                double overlap = zone.points == NULL && zone.radius < 1e-3f
                                     ? 0.0
                                     : overlap_of(corners, corner_count, outline, count);
                bool level_fits = box.min.y <= high && box.max.y >= low;
                bool is_found = false;
                for (uint32_t n = 0; n < ref_count; n++) {
                    is_found = is_found || refs[n] == all.refs[k];
                }
                if (fabs(overlap) > slack) {
                    TEST_CHECK(is_found == (overlap > 0.0 && level_fits));
                    found += is_found;
                    left_out += !is_found;
                    by_height += overlap > 0.0 && !level_fits;
                }
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(found > 1000 && left_out > 5000 && by_height > 50);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "00", "00" };
    fixture_level level = fixture_make(rows, 2);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_ref refs[4];
    uint32_t count = 0;
    // An outline that touches the middle, where four polygons meet, has all four.
    const tl_vec3 square[4] = { { 4, 0, 4 }, { 4, 0, 4.5f }, { 4.5f, 0, 4.5f }, { 4.5f, 0, 4 } };
    const tl_vec3 bow[4] = { { 0, 0, 0 }, { 1, 0, 1 }, { 1, 0, 0 }, { 0, 0, 1 } };
    const tl_vec3 line[3] = { { 0, 0, 0 }, { 1, 0, 1 }, { 2, 0, 2 } };
    const tl_vec3 nan[3] = { { 0, 0, 0 }, { NAN, 0, 1 }, { 2, 0, 0 } };
    tl_nav_zone zone = tl_nav_zone_polygon(square, 4);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, NULL, refs, 4, &count), TL_OK);
    TEST_CHECK(count == 4);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, NULL, refs, 1, &count), TL_INCOMPLETE);
    TEST_CHECK(count == 4);
    TEST_RESULT(
        tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ NAN, INFINITY }, refs, 4, &count),
        TL_ERR_NOT_FINITE);
    zone = tl_nav_zone_polygon(bow, 4);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ 0, 1 }, refs, 4, &count),
                TL_ERR_ARGUMENT);
    zone = tl_nav_zone_polygon(line, 3);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ 0, 1 }, refs, 4, &count),
                TL_ERR_ARGUMENT);
    zone = tl_nav_zone_polygon(square, 2);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ 0, 1 }, refs, 4, &count),
                TL_ERR_ARGUMENT);
    zone = tl_nav_zone_polygon(nan, 3);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ 0, 1 }, refs, 4, &count),
                TL_ERR_NOT_FINITE);
    zone = tl_nav_zone_circle(square[0], -1.0f);
    TEST_RESULT(tl_navmesh_find_polygons(navmesh, NULL, &zone, &(tl_nav_height_range){ 0, 1 }, refs, 4, &count),
                TL_ERR_ARGUMENT);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_zones), cmocka_unit_test(test_arguments) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
