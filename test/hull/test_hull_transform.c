// SPDX-License-Identifier: MIT
//
// Hulls that were scaled, turned, moved and mirrored: valid, of the right size, refused by name when nothing is left.

#include "talus_test.h"

#include "hull_shapes.h"

#include <talus/hull.h>

#include <string.h>

static tl_hull *build(shape_kind kind, uint32_t count, uint64_t seed)
{
    tl_vec3 points[300];
    test_random random = { seed };
    shape_make(kind, &random, points, count);
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    return hull;
}

static tl_hull *map(const tl_hull *hull, tl_vec3 scale, tl_transform pose)
{
    tl_hull *out;
    TEST_RESULT(tl_hull_transform(hull, scale, pose, NULL, &out, NULL), TL_OK);
    TEST_RESULT(tl_hull_check(out, out->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_hull_validate(out, NULL, 0, NULL), TL_OK);
    return out;
}

static tl_transform random_pose(test_random *random, float far)
{
    tl_transform pose = tl_transform_identity();
    tl_vec3 axis = test_random_direction(random);
    tl_quat turn = { axis.x, axis.y, axis.z, test_random_range(random, -1.0f, 1.0f) };
    pose.rotation = tl_quat_normalize(turn);
    pose.position = tl_scale(test_random_direction(random), far);
    return pose;
}

static void test_exact_maps_keep_every_face(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        tl_hull *hull = build((shape_kind)kind, 200, 1);
        static const float scales[] = { 4.0f, 0x1p-40f, 0x1p60f };
        for (int i = 0; i < 3; i++) {
            float s = scales[i];
            tl_hull *out = map(hull, tl_vec3_make(s, s, s), tl_transform_identity());
            TEST_CHECK(out->vertex_count == hull->vertex_count && out->half_edge_count == hull->half_edge_count);
            TEST_CHECK(shape_is_same_topology(out, hull));
            double cube = (double)s * (double)s * (double)s;
            TEST_CHECK(fabs(out->mass.volume / cube - hull->mass.volume) <= 1e-12 * hull->mass.volume);
            tl_blob_free(out);
        }
        tl_blob_free(hull);
    }
}

static void test_mirrors_keep_the_outside_outside(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        tl_hull *hull = build((shape_kind)kind, 100, 2);
        for (int mask = 1; mask < 8; mask++) {
            tl_vec3 scale = tl_vec3_make(mask & 1 ? -1.0f : 1.0f, mask & 2 ? -1.0f : 1.0f, mask & 4 ? -1.0f : 1.0f);
            tl_hull *out = map(hull, scale, tl_transform_identity());
            TEST_CHECK(out->vertex_count == hull->vertex_count && out->face_count == hull->face_count);
            TEST_CHECK(fabs(out->mass.volume - hull->mass.volume) <= 1e-12 * hull->mass.volume);
            // Twice is not at all.
            tl_hull *back = map(out, scale, tl_transform_identity());
            TEST_CHECK(back->blob.size == hull->blob.size && memcmp(back, hull, hull->blob.size) == 0);
            tl_blob_free(back);
            tl_blob_free(out);
        }
        tl_blob_free(hull);
    }
}

static void test_any_map_gives_a_valid_hull(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t broken = 0, dropped = 0;
    for (int i = 0; i < 600; i++) {
        tl_hull *hull = build((shape_kind)(i % SHAPE_COUNT), 20u + (uint32_t)i % 80, (uint64_t)i);
        tl_vec3 scale = tl_vec3_make(test_random_range(&random, -3.0f, 3.0f), test_random_range(&random, 0.01f, 3.0f),
                                     test_random_range(&random, 0.5f, 1.5f));
        tl_transform pose = random_pose(&random, i % 3 == 0 ? 1e5f : 2.0f);
        tl_hull *out = map(hull, scale, pose);
        broken += out->face_count > hull->face_count;
        dropped += out->vertex_count < hull->vertex_count;
        double expected = hull->mass.volume * fabs((double)scale.x * (double)scale.y * (double)scale.z);
        // A rounding moves the surface by half an ulp of the largest coordinate.
        tl_vec3 largest = tl_max(tl_abs(out->bounds.min), tl_abs(out->bounds.max));
        double shift = 6e-8 * (double)tl_maxf(largest.x, tl_maxf(largest.y, largest.z));
        TEST_CHECK(fabs(out->mass.volume - expected) <= 2.0 * shift * out->mass.area + 1e-5 * expected);
        for (uint32_t v = 0; v < out->vertex_count; v++) {
            // Each corner is the image of the corner with its source.
            uint32_t w = 0;
            while (tl_hull_source(hull, w) != tl_hull_source(out, v)) {
                TEST_CHECK(++w < hull->vertex_count);
            }
            tl_vec3 image = tl_transform_point(pose, tl_mul(scale, tl_hull_vertices(hull)[w]));
            TEST_CHECK((double)tl_distance(image, tl_hull_vertices(out)[v]) <= 40.0 * shift);
        }
        tl_blob_free(out);
        tl_blob_free(hull);
    }
    print_message("%u with more faces, %u with fewer corners\n", broken, dropped);
    TEST_CHECK(broken > 30 && dropped > 5);
    // A box stays a box when it is moved and scaled.
    tl_hull *box = build(SHAPE_CUBE_SURFACE, 100, 9);
    tl_transform shift = tl_transform_identity();
    shift.position = tl_vec3_make(0.1f, -7.3f, 1e4f);
    tl_hull *out = map(box, tl_vec3_make(0.3f, 5.7f, -0.11f), shift);
    TEST_CHECK(out->vertex_count == 8 && out->face_count == 6);
    tl_blob_free(out);
    tl_blob_free(box);
}

static void test_nothing_solid_is_refused_by_name(void **state)
{
    (void)state;
    tl_hull *hull = build(SHAPE_SPHERE, 60, 4);
    const struct {
        tl_vec3 scale;
        float far;
        tl_result expected;
    } table[] = {
        { { 1.0f, 0.0f, 1.0f }, 0.0f, TL_ERR_COPLANAR },
        { { 0.0f, 2.0f, 0.0f }, 0.0f, TL_ERR_COLLINEAR },
        { { 0.0f, 0.0f, 0.0f }, 5.0f, TL_ERR_COINCIDENT },
        { { 1.0f, 1.0f, 1.0f }, 1e20f, TL_ERR_COINCIDENT }, // lost in rounding
        { { 1e33f, 1.0f, 1.0f }, 0.0f, TL_ERR_RANGE },
        { { 1.0f, 1.0f, 1.0f }, 1e31f, TL_ERR_RANGE },
        { { INFINITY, 1.0f, 1.0f }, 0.0f, TL_ERR_NOT_FINITE },
        { { NAN, 1.0f, 1.0f }, 0.0f, TL_ERR_NOT_FINITE },
        { { 1.0f, 1.0f, 1.0f }, NAN, TL_ERR_NOT_FINITE },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        tl_transform pose = tl_transform_identity();
        pose.position.x = pose.position.y = pose.position.z = table[i].far;
        tl_hull *out = hull;
        tl_hull_report report;
        TEST_RESULT(tl_hull_transform(hull, table[i].scale, pose, NULL, &out, &report), table[i].expected);
        TEST_CHECK(out == NULL && report.base.advice != NULL);
    }
    tl_blob_free(hull);
}

static void test_memory_runs_out(void **state)
{
    (void)state;
    tl_hull *hull = build(SHAPE_SPHERE, 300, 5);
    uint64_t failures = 0;
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_host host;
        memset(&host, 0, sizeof host);
        host.allocator = &memory.allocator;
        tl_hull *out;
        tl_result result =
            tl_hull_transform(hull, tl_vec3_make(1.0f, 2.0f, 3.0f), tl_transform_identity(), &host, &out, NULL);
        if (result == TL_OK) {
            tl_blob_free(out);
            TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
            break;
        }
        failures++;
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(out == NULL && memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(failures >= 3);
    tl_blob_free(hull);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_maps_keep_every_face),
        cmocka_unit_test(test_mirrors_keep_the_outside_outside),
        cmocka_unit_test(test_any_map_gives_a_valid_hull),
        cmocka_unit_test(test_nothing_solid_is_refused_by_name),
        cmocka_unit_test(test_memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
