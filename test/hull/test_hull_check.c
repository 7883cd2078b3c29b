// SPDX-License-Identifier: MIT
//
// Untrusted hulls: every truncated prefix is refused by name, and of all altered ones those that pass are safe to use.

#include "talus_test.h"

#include "hull/bake/hull_polygons.h"
#include "hull/support/hull_support.h"
#include "hull_shapes.h"

#include <talus/hull.h>

#include <string.h>

static void test_prefixes_are_refused(void **state)
{
    (void)state;
    tl_vec3 points[120];
    for (uint32_t count = 12; count <= 120; count += 108) {
        test_random random = { count };
        shape_make(SHAPE_SPHERE, &random, points, count);
        tl_hull_def def = tl_default_hull_def();
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, count, &def, &hull, NULL), TL_OK);
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
        for (uint64_t size = 0; size < hull->blob.size; size += 4) {
            // A copy of just that size, so that a sanitizer sees any read beyond it.
            void *copy = test_blob_alloc(size);
            memcpy(copy, hull, size);
            TEST_RESULT(tl_hull_check(copy, size, NULL), TL_ERR_TRUNCATED);
            test_blob_free(copy);
        }
        tl_blob_free(hull);
    }
}

static void test_altered_hulls_are_refused_or_harmless(void **state)
{
    (void)state;
    tl_vec3 points[100];
    uint32_t refused = 0, passed = 0, named[3] = { 0 };
    for (uint32_t count = 10; count <= 100; count += 90) {
        test_random random = { count };
        shape_make(SHAPE_SPHERE, &random, points, count);
        tl_hull_def def = tl_default_hull_def();
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, count, &def, &hull, NULL), TL_OK);
        uint64_t size = hull->blob.size;
        uint8_t *copy = test_blob_alloc(size);
        for (uint32_t i = 0; i < 60000; i++) {
            memcpy(copy, hull, size);
            // Small numbers find plausible wrong indices, random bytes find the rest.
            uint64_t range = i % 3 == 0 ? sizeof(tl_hull) : size;
            uint64_t at = test_random_u64(&random) % range;
            if (i % 2 == 0) {
                copy[at] = (uint8_t)(copy[at] ^ 1u << test_random_below(&random, 8));
            } else {
                uint32_t value = test_random_below(&random, 32);
                memcpy(copy + at / 4 * 4, &value, 4);
            }
            if (memcmp(copy, hull, size) == 0) {
                continue;
            }
            tl_result result = tl_hull_check(copy, size, NULL);
            refused += result != TL_OK;
            named[0] += result == TL_ERR_MAGIC;
            named[1] += result == TL_ERR_VERSION;
            named[2] += result == TL_ERR_CORRUPT;
            if (result == TL_OK) {
                passed++;
                const tl_hull *altered = (const tl_hull *)(const void *)copy;
                for (int k = 0; k < 4; k++) {
                    tl_vec3 d = test_random_direction(&random);
                    TEST_CHECK(tl_hull_support(altered, d, (uint32_t)k) < altered->vertex_count);
                    tl_hull_cast_ray(altered, points[k], d, 10.0f, NULL);
                    tl_hull_contains(altered, points[k]);
                }
            }
        }
        test_blob_free(copy);
        tl_blob_free(hull);
    }
    // What passes differs in what no answer depends on: sources, the table's choice of a start.
    TEST_CHECK(refused > 60000 && passed > 1000);
    TEST_CHECK(named[0] > 100 && named[1] > 100 && named[2] > 50000);
}

// Whatever bit of it is flipped.
static void test_altered_planes_and_mass_are_refused(void **state)
{
    (void)state;
    tl_vec3 points[40];
    test_random random = { 7 };
    shape_make(SHAPE_SPHERE, &random, points, 40);
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, 40, NULL, &hull, NULL), TL_OK);
    const uint64_t planes = (uint64_t)((const char *)tl_hull_plane_block(hull, 0) - (const char *)hull),
                   plane_bytes = tl_hull_plane_bytes(hull);
    uint8_t *bytes = (uint8_t *)hull;
    for (uint64_t bit = 0; bit < 8 * (sizeof hull->mass + plane_bytes); bit++) {
        bool in_mass = bit / 8 < sizeof hull->mass;
        uint64_t at = in_mass ? offsetof(tl_hull, mass) + bit / 8 : planes + bit / 8 - sizeof hull->mass;
        bytes[at] ^= (uint8_t)(1u << bit % 8);
        tl_report report;
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, &report), TL_ERR_CORRUPT);
        TEST_CHECK(!in_mass || strcmp(report.field, "mass") == 0);
        bytes[at] ^= (uint8_t)(1u << bit % 8);
    }
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    tl_blob_free(hull);
}

// The faces of a cube with a pyramid on top, baked with the tip at some height: below the top, consistent bytes of a
// body with a dent.
static tl_hull *bake_pyramid(const tl_hull *right, float height, float bottom, tl_arena *arena)
{
    tl_vec3 corners[9];
    uint32_t numbers[9];
    for (uint32_t v = 0; v < 9; v++) {
        corners[v] = tl_hull_vertices(right)[v];
        numbers[v] = v;
    }
    corners[8].y = height;
    corners[0].y = bottom;
    tl_hull_half_edge half_edges[64];
    tl_hull_face faces[32];
    for (uint32_t h = 0; h < right->half_edge_count; h++) {
        half_edges[h] = tl_hull_edge_at(right, h);
    }
    for (uint32_t f = 0; f < right->face_count; f++) {
        faces[f] = tl_hull_face_at(right, f);
    }
    tl_hull_polygons polygons = {
        9, right->face_count, right->half_edge_count, numbers, half_edges, faces, NULL, NULL, 0.0f
    };
    tl_hull *hull;
    TEST_RESULT(tl_hull_encode(&polygons, corners, NULL, 1, arena, NULL, &hull), TL_OK);
    return hull;
}

static void test_dented_hulls_are_refused(void **state)
{
    (void)state;
    tl_vec3 points[9];
    for (int i = 0; i < 8; i++) {
        points[i] = tl_vec3_make(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
    }
    points[8] = tl_vec3_make(0.25f, 1.5f, 0.25f);
    tl_hull *right;
    TEST_RESULT(tl_hull_bake(points, 9, NULL, &right, NULL), TL_OK);
    TEST_CHECK(right->vertex_count == 9 && right->face_count == 9);
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    const float above = nextafterf(1.0f, 2.0f), below = nextafterf(1.0f, 0.0f);
    const float heights[] = { 1.5f, 1.1f, above, 1.0f, below, 0.9f, 0.0f };
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++) {
        tl_hull *hull = bake_pyramid(right, heights[i], -1.0f, &arena);
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), heights[i] > 1.0f ? TL_OK : TL_ERR_CORRUPT);
        tl_blob_free(hull);
    }
    tl_hull *bent = bake_pyramid(right, 1.5f, nextafterf(-1.0f, -2.0f), &arena);
    TEST_RESULT(tl_hull_check(bent, bent->blob.size, NULL), TL_ERR_CORRUPT);
    tl_blob_free(bent);
    tl_arena_free(&arena);
    tl_blob_free(right);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_prefixes_are_refused),
        cmocka_unit_test(test_altered_hulls_are_refused_or_harmless),
        cmocka_unit_test(test_altered_planes_and_mass_are_refused),
        cmocka_unit_test(test_dented_hulls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
