// SPDX-License-Identifier: MIT
//
// The support query against an exhaustive scan with exact comparisons: all kinds of hulls, sizes from 1e-15 to 1e15,
// far offsets, level faces, wild directions, right and wrong hints.

#include "talus_test.h"

#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/hull.h>

// The double-precision scan: products of floats are exact in double, so only two sums are rounded; what they leave open
// is compared exactly.
static uint32_t oracle(const tl_hull *hull, tl_vec3 d)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t best = 0;
    for (uint32_t v = 1; v < hull->vertex_count; v++) {
        if (tl_compare_along(d, vertices[v], vertices[best]) > 0) {
            best = v;
        }
    }
    return best;
}

// Ties are counted in every 16th query.
typedef struct coverage {
    uint64_t queries, ties, good_hints, scans, climbs, extreme;
} coverage;

// Directions: random, along edges' normals and faces' normals (ties), axes, small turns, extreme lengths.
static tl_vec3 make_direction(const tl_hull *hull, test_random *random, tl_vec3 last, coverage *seen)
{
    tl_vec3 d = test_random_direction(random);
    switch (test_random_below(random, 7)) {
    case 0: {
        tl_hull_plane plane = tl_hull_face_plane(hull, test_random_below(random, hull->face_count));
        const double *n = plane.normal;
        return tl_vec3_make((float)n[0], (float)n[1], (float)n[2]);
    }
    case 1: {
        int axis = (int)test_random_below(random, 3);
        float sign = test_random_below(random, 2) ? 1.0f : -1.0f;
        return tl_vec3_make(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
    }
    case 2:
    case 3:
        return tl_add(last, tl_scale(d, 0.02f));
    case 4: {
        const tl_hull_half_edge *h = tl_hull_half_edges(hull);
        uint32_t e = test_random_below(random, hull->half_edge_count);
        tl_vec3 a = tl_hull_vertices(hull)[h[e].origin], b = tl_hull_vertices(hull)[h[h[e].next].origin];
        tl_vec3 n = tl_cross(tl_normalize(tl_sub(b, a)), d);
        return tl_dot(n, n) > 0.0f ? n : d;
    }
    case 5: {
        seen->extreme++;
        float length = ldexpf(1.0f, (int)test_random_below(random, 250) - 125);
        float squeeze = ldexpf(1.0f, -(int)test_random_below(random, 200));
        return tl_vec3_make(d.x * length, d.y * length * squeeze, d.z * length);
    }
    default:
        return d;
    }
}

static void query(const tl_hull *hull, test_random *random, uint32_t count, coverage *seen)
{
    tl_vec3 last = tl_vec3_make(0, 1, 0);
    uint32_t answer = TL_NO_VERTEX;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 d = make_direction(hull, random, last, seen);
        uint32_t hint = i % 3 == 0 ? TL_NO_VERTEX : i % 3 == 1 ? answer : (uint32_t)test_random_u64(random);
        uint32_t expected = oracle(hull, d);
        seen->good_hints += hint == expected;
        answer = tl_hull_support(hull, d, hint);
        TEST_CHECK(answer == expected);
        seen->queries++;
        seen->scans += hull->vertex_count <= 48;
        seen->climbs += hull->vertex_count > 48;
        for (uint32_t v = expected + 1; v < hull->vertex_count && i % 16 == 0; v++) {
            if (tl_compare_along(d, tl_hull_vertices(hull)[v], tl_hull_vertices(hull)[expected]) == 0) {
                seen->ties++;
                break;
            }
        }
        last = d;
    }
}

static void test_support_is_exact_on_all_shapes(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 4, 9, 30, 48, 49, 90, 300, 1000 };
    static const float sizes[] = { 1.0f, 1e-15f, 1e15f, 1e-3f, 37.0f };
    tl_vec3 *points = malloc(1000 * sizeof *points);
    coverage seen = { 0, 0, 0, 0, 0, 0 };
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            test_random random = { (uint64_t)kind * 31 + c };
            uint32_t count = shape_make((shape_kind)kind, &random, points, counts[c]);
            float size = sizes[(c + (size_t)kind) % 5];
            // A million sizes away every edge is a few quanta long.
            tl_vec3 offset = tl_scale(tl_vec3_make(1e6f, -1e5f, 4e5f), c % 3 == 2 ? size : 0.0f);
            for (uint32_t i = 0; i < count; i++) {
                points[i] = tl_add(tl_scale(points[i], size), offset);
            }
            tl_hull_def def = tl_default_hull_def();
            def.flatness = 0.0f;
            tl_hull *hull;
            if (tl_hull_build(points, count, &def, &hull, NULL) != TL_OK) {
                continue;
            }
            query(hull, &random, hull->vertex_count > 200 ? 5000 : 14000, &seen);
            tl_blob_free(hull, NULL);
        }
    }
    free(points);
    print_message("%u queries, %u ties, %u right hints\n", (unsigned)seen.queries, (unsigned)seen.ties,
                  (unsigned)seen.good_hints);
    TEST_CHECK(seen.queries > 1000000 && seen.ties > 5000 && seen.good_hints > 50000);
    TEST_CHECK(seen.scans > 200000 && seen.climbs > 100000 && seen.extreme > 50000);
}

static void test_directions_without_a_size(void **state)
{
    (void)state;
    tl_vec3 points[200];
    for (uint32_t count = 20; count <= 200; count += 180) {
        test_random random = { 3 };
        shape_make(SHAPE_SPHERE, &random, points, count);
        tl_hull_def def = tl_default_hull_def();
        tl_hull *hull;
        TEST_RESULT(tl_hull_build(points, count, &def, &hull, NULL), TL_OK);
        TEST_CHECK(tl_hull_support(hull, tl_vec3_make(0, 0, 0), 5) == 0);
        TEST_CHECK(tl_hull_support(hull, tl_vec3_make(-0.0f, 0, 0), TL_NO_VERTEX) == 0);
        const float bad[] = { NAN, INFINITY, -INFINITY };
        for (int i = 0; i < 9; i++) {
            tl_vec3 d =
                tl_vec3_make(i / 3 == 0 ? bad[i % 3] : 1, i / 3 == 1 ? bad[i % 3] : 1, i / 3 == 2 ? bad[i % 3] : 1);
            TEST_CHECK(tl_hull_support(hull, d, TL_NO_VERTEX) < hull->vertex_count);
        }
        // Denormal and largest directions.
        for (int i = 0; i < 1000; i++) {
            tl_vec3 d = tl_scale(test_random_direction(&random), i % 2 ? 1e-44f : 3.4e38f);
            TEST_CHECK(tl_hull_support(hull, d, (uint32_t)i % 7) == oracle(hull, d));
        }
        tl_blob_free(hull, NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_support_is_exact_on_all_shapes),
        cmocka_unit_test(test_directions_without_a_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
