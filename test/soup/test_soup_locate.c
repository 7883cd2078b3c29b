// SPDX-License-Identifier: MIT
//
// soup_locate.c and soup_check_closed.c: whole numbers, where every ray grazes something; solid angles as an oracle;
// surfaces that are not closed.

#include "soup_models.h"

#include "math/vec3d.h"

#include <float.h>

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

// A box of whole numbers, fronts outward.
static void add_box(model *m, tl_vec3 low, tl_vec3 high)
{
    uint32_t v[8];
    for (uint32_t k = 0; k < 8; k++) {
        v[k] = model_vertex(m, k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    }
    static const uint8_t quads[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    for (uint32_t q = 0; q < 6; q++) {
        model_triangle(m, v[quads[q][0]], v[quads[q][1]], v[quads[q][2]]);
        model_triangle(m, v[quads[q][0]], v[quads[q][2]], v[quads[q][3]]);
    }
}

static bool in_open(tl_vec3 p, float low, float high)
{
    return p.x > low && p.x < high && p.y > low && p.y < high && p.z > low && p.z < high;
}

static bool in_closed(tl_vec3 p, float low, float high)
{
    return p.x >= low && p.x <= high && p.y >= low && p.y <= high && p.z >= low && p.z <= high;
}

// Two boxes that overlap, and points on half steps: many of them on planes and lines of the boxes.
static void test_boxes(void **state)
{
    (void)state;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        model m = { 0 };
        add_box(&m, vec(0, 0, 0), vec(4, 4, 4));
        add_box(&m, vec(2, 2, 2), vec(6, 6, 6));
        tl_soup_def def = model_soup_def(storage);
        tl_soup *soup = model_soup(&m, &def);
        TEST_RESULT(tl_soup_check_closed(soup, NULL, NULL), TL_OK);
        uint32_t windings[3] = { 0, 0, 0 }, on_surface = 0;
        for (int i = 0; i < 17 * 17 * 17; i++) {
            tl_vec3 p = tl_scale(vec((float)(i % 17) - 2, (float)(i / 17 % 17) - 2, (float)(i / 289) - 2), 0.5f);
            bool first = in_open(p, 0, 4), second = in_open(p, 2, 6);
            bool surface = (in_closed(p, 0, 4) && !first) || (in_closed(p, 2, 6) && !second);
            tl_soup_location place;
            TEST_RESULT(tl_soup_locate(soup, p, &place), TL_OK);
            TEST_CHECK((place.side == TL_SOUP_ON_SURFACE) == surface);
            TEST_CHECK((place.triangle != TL_NO_TRIANGLE) == surface);
            if (surface) {
                on_surface++;
                continue;
            }
            TEST_CHECK(place.winding == (int)first + (int)second);
            TEST_CHECK((place.side == TL_SOUP_INSIDE) == (first || second));
            windings[place.winding]++;
        }
        TEST_CHECK(windings[0] > 100 && windings[1] > 100 && windings[2] > 20 && on_surface > 100);
        tl_blob_free(soup);
        model_free(&m);
    }
}

// Van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983.
static double winding_by_angles(const model *m, tl_vec3 at)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        tl_vec3d v[3];
        double length[3];
        for (uint32_t k = 0; k < 3; k++) {
            v[k] = tl_vec3d_sub(tl_vec3d_from(m->vertices[m->indices[3 * (size_t)i + k]]), tl_vec3d_from(at));
            length[k] = tl_vec3d_length(v[k]);
        }
        double volume = tl_vec3d_dot(v[0], tl_vec3d_cross(v[1], v[2]));
        double scale = length[0] * length[1] * length[2] + tl_vec3d_dot(v[0], v[1]) * length[2] +
                       tl_vec3d_dot(v[1], v[2]) * length[0] + tl_vec3d_dot(v[2], v[0]) * length[1];
        sum += 2.0 * atan2(volume, scale);
    }
    return sum / (4.0 * 3.14159265358979323846);
}

static void test_against_solid_angles(void **state)
{
    (void)state;
    test_random random = { 4 };
    uint32_t inside = 0, outside = 0;
    for (uint32_t place = 0; place < 4; place++) {
        tl_vec3 center = place == 1 ? vec(5000, -20, 300) : vec(0, 0, 0);
        float radius = place == 2 ? 1e-4f : 5.0f;
        model m = model_ball(4, radius, 0.3f, center, place + 1);
        if (place == 3) { // inside out
            for (uint32_t i = 0; i < m.triangle_count; i++) {
                uint32_t corner = m.indices[3 * i];
                m.indices[3 * i] = m.indices[3 * i + 1];
                m.indices[3 * i + 1] = corner;
            }
        }
        tl_soup *soup = model_soup(&m, NULL);
        TEST_RESULT(tl_soup_check_closed(soup, NULL, NULL), TL_OK);
        for (uint32_t i = 0; i < 500; i++) {
            float reach = radius * test_random_range(&random, 0.5f, 1.4f);
            tl_vec3 p = tl_mul_add(center, test_random_direction(&random), reach);
            tl_soup_location found;
            TEST_RESULT(tl_soup_locate(soup, p, &found), TL_OK);
            double angles = winding_by_angles(&m, p);
            TEST_CHECK(found.side != TL_SOUP_ON_SURFACE && fabs(angles - found.winding) < 1e-6);
            TEST_CHECK(found.winding == 0 || found.winding == (place == 3 ? -1 : 1));
            inside += found.winding != 0;
            outside += found.winding == 0;
        }
        // Its own corners.
        for (uint32_t i = 0; i < m.triangle_count; i += 7) {
            tl_soup_location found;
            TEST_RESULT(tl_soup_locate(soup, m.vertices[m.indices[3 * i]], &found), TL_OK);
            TEST_CHECK(found.side == TL_SOUP_ON_SURFACE && found.triangle <= i);
        }
        tl_blob_free(soup);
        model_free(&m);
    }
    TEST_CHECK(inside > 500 && outside > 500);
}

static void test_not_closed_is_named(void **state)
{
    (void)state;
    test_random random = { 6 };
    model m = model_ball(3, 5, 0.1f, vec(0, 0, 0), 1);
    uint32_t lost = 123;
    uint32_t corners[3] = { m.indices[3 * lost], m.indices[3 * lost + 1], m.indices[3 * lost + 2] };
    // A hole: the last triangle takes the place of the lost one.
    memcpy(&m.indices[3 * lost], &m.indices[3 * (m.triangle_count - 1)], 3 * sizeof *m.indices);
    m.triangle_count--;
    tl_soup *soup = model_soup(&m, NULL);
    tl_report report;
    TEST_RESULT(tl_soup_check_closed(soup, NULL, &report), TL_ERR_NOT_CLOSED);
    assert_string_equal(report.element, "triangle");
    const uint32_t *named = &m.indices[3 * report.element_index];
    uint32_t shared = 0;
    for (uint32_t k = 0; k < 9; k++) {
        shared += named[k / 3] == corners[k % 3];
    }
    TEST_CHECK(shared == 2);
    uint32_t told = 0, right = 0;
    for (uint32_t i = 0; i < 2000; i++) {
        tl_vec3 p = test_random_point(&random, vec(-5, -5, -5), vec(5, 5, 5));
        tl_soup_location place;
        tl_result result = tl_soup_locate(soup, p, &place);
        told += result == TL_ERR_NOT_CLOSED;
        right += result == TL_OK;
        TEST_CHECK(result == TL_OK || result == TL_ERR_NOT_CLOSED);
    }
    TEST_CHECK(told > 0 && right > 1000);
    tl_blob_free(soup);
    // The hole filled, but wound the wrong way.
    model_triangle(&m, corners[1], corners[0], corners[2]);
    soup = model_soup(&m, NULL);
    TEST_RESULT(tl_soup_check_closed(soup, NULL, &report), TL_ERR_WINDING);
    told = 0;
    for (uint32_t i = 0; i < 2000; i++) {
        tl_vec3 p = test_random_point(&random, vec(-5, -5, -5), vec(5, 5, 5));
        tl_soup_location place;
        tl_result result = tl_soup_locate(soup, p, &place);
        told += result == TL_ERR_WINDING;
        TEST_CHECK(result == TL_OK || result == TL_ERR_WINDING);
    }
    TEST_CHECK(told > 0);
    tl_soup_location place;
    TEST_RESULT(tl_soup_locate(soup, vec(0, NAN, 0), &place), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_soup_locate(soup, vec(0, 3e38f, 0), &place), TL_OK);
    TEST_CHECK(place.side == TL_SOUP_OUTSIDE);
    tl_blob_free(soup);
    model_free(&m);
    m = model_terrain(8, 2, vec(0, 0, 0), 1);
    soup = model_soup(&m, NULL);
    TEST_RESULT(tl_soup_check_closed(soup, NULL, NULL), TL_ERR_NOT_CLOSED);
    tl_blob_free(soup);
    model_free(&m);
}

static void test_failing_memory(void **state)
{
    (void)state;
    model m = model_ball(3, 5, 0.1f, vec(0, 0, 0), 1);
    tl_soup *soup = model_soup(&m, NULL);
    for (uint64_t k = 1;; k++) {
        test_allocator allocator;
        test_allocator_init(&allocator, k);
        tl_host host = { &allocator.allocator, NULL, NULL };
        tl_result result = tl_soup_check_closed(soup, &host, NULL);
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 3);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    tl_blob_free(soup);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_against_solid_angles),
        cmocka_unit_test(test_not_closed_is_named),
        cmocka_unit_test(test_failing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
