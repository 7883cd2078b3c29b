// SPDX-License-Identifier: MIT
//
// Hulls: proven by exact predicates, at all scales, of all kinds of clouds; degenerate input by name; memory that runs
// out; the same bytes twice.

#include "talus_test.h"

#include "base/hash.h"
#include "hull_shapes.h"

#include <talus/convex.h>
#include <talus/hull.h>

#include <string.h>

static tl_hull *build(const tl_vec3 *points, uint32_t count)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, &def, &hull, NULL), TL_OK);
    return hull;
}

static void prove(const tl_hull *hull, const tl_vec3 *points, uint32_t count)
{
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_hull_validate(hull, points, count, NULL), TL_OK);
    // Each vertex is the input point it names, and the first of those at its place.
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_vec3 p = tl_hull_vertices(hull)[v];
        uint32_t source = tl_hull_source(hull, v);
        TEST_CHECK(source < count && tl_distance_sq(points[source], p) == 0.0f);
        TEST_CHECK(v == 0 || tl_hull_source(hull, v - 1) < source);
    }
}

static void test_hulls_are_proven_at_all_scales(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 4, 5, 8, 20, 60, 200, 700 };
    static const int exponents[] = { -50, -20, 17, 50, 85 };
    tl_vec3 *points = malloc(700 * sizeof *points);
    tl_vec3 *scaled = malloc(700 * sizeof *points);
    uint32_t hulls = 0, merged = 0;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            test_random random = { (uint64_t)kind * 100 + c };
            uint32_t count = shape_make((shape_kind)kind, &random, points, counts[c]);
            tl_hull_def def = tl_default_hull_def();
            tl_hull *hull;
            def.flatness = 0.0f;
            if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK) {
                // Lattices of few points and small prisms may be flat.
                TEST_CHECK(count <= 8);
                continue;
            }
            prove(hull, points, count);
            hulls++;
            merged += hull->face_count < 2 * hull->vertex_count - 4;
            for (size_t e = 0; e < sizeof exponents / sizeof *exponents; e++) {
                for (uint32_t i = 0; i < count; i++) {
                    scaled[i] = tl_vec3_make(ldexpf(points[i].x, exponents[e]), ldexpf(points[i].y, exponents[e]),
                                             ldexpf(points[i].z, exponents[e]));
                }
                tl_hull *other = build(scaled, count);
                TEST_CHECK(shape_is_same_topology(hull, other));
                TEST_RESULT(tl_hull_check(other, other->blob.size, NULL), TL_OK);
                tl_blob_free(other);
            }
            tl_blob_free(hull);
        }
    }
    TEST_CHECK(hulls > 70 && merged > 15);
    free(points);
    free(scaled);
}

// Far from the origin floats are a coarse lattice: coincident, collinear and coplanar points everywhere.
static void test_hulls_far_from_the_origin(void **state)
{
    (void)state;
    tl_vec3 points[500], moved[500];
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (int k = 0; k < 4; k++) {
            test_random random = { (uint64_t)(kind * 4 + k) };
            shape_make((shape_kind)kind, &random, points, 500);
            tl_vec3 offset = tl_scale(tl_vec3_make(1e6f, -0.7e6f, 0.3e6f), k == 3 ? 100.0f : (float)k);
            for (int i = 0; i < 500; i++) {
                moved[i] = tl_add(points[i], offset);
            }
            tl_hull_def def = tl_default_hull_def();
            def.flatness = 0.0f;
            tl_hull *hull;
            if (tl_hull_bake(moved, 500, &def, &hull, NULL) == TL_OK) {
                prove(hull, moved, 500);
                // The same lattice points near the origin give the same hull.
                tl_vec3 back[500];
                for (int i = 0; i < 500; i++) {
                    back[i] = tl_sub(moved[i], offset);
                }
                tl_hull *near = build(back, 500);
                TEST_CHECK(shape_is_same_topology(hull, near));
                TEST_CHECK(fabs(near->mass.volume - hull->mass.volume) <= 1e-6 * near->mass.volume);
                tl_blob_free(near);
                tl_blob_free(hull);
            } else {
                TEST_CHECK(k == 3);
            }
        }
    }
}

static void test_bad_points_and_defs_are_refused(void **state)
{
    (void)state;
    tl_vec3 points[8];
    test_random random = { 6 };
    shape_make(SHAPE_SPHERE, &random, points, 8);
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    tl_hull_report report;
    const float bad[] = { NAN, INFINITY, -INFINITY, 2e30f };
    for (int i = 0; i < 4; i++) {
        tl_vec3 kept = points[5];
        points[5].y = bad[i];
        TEST_RESULT(tl_hull_bake(points, 8, &def, &hull, &report), i < 3 ? TL_ERR_NOT_FINITE : TL_ERR_RANGE);
        TEST_CHECK(report.base.element_index == 5 && strcmp(report.base.element, "point") == 0);
        points[5] = kept;
    }
    def.max_vertices = 3;
    TEST_RESULT(tl_hull_bake(points, 8, &def, &hull, &report), TL_ERR_ARGUMENT);
    def = tl_default_hull_def();
    def.thickness = -1.0f;
    TEST_RESULT(tl_hull_bake(points, 8, &def, &hull, &report), TL_ERR_ARGUMENT);
    def.thickness = NAN;
    TEST_RESULT(tl_hull_bake(points, 8, &def, &hull, &report), TL_ERR_ARGUMENT);
}

static void test_a_cube_is_a_cube(void **state)
{
    (void)state;
    tl_vec3 points[500];
    test_random random = { 7 };
    shape_make(SHAPE_CUBE_SURFACE, &random, points, 500);
    tl_hull *hull = build(points, 500);
    TEST_CHECK(hull->vertex_count == 8 && hull->face_count == 6 && hull->half_edge_count == 24);
    TEST_CHECK(fabs(hull->mass.volume - 8.0) < 1e-14 && fabs(hull->mass.area - 24.0) < 1e-13);
    for (int i = 0; i < 3; i++) {
        TEST_CHECK(fabs(hull->mass.center[i]) < 1e-15);
        TEST_CHECK(fabs(hull->mass.inertia[i] - 8.0 / 12.0 * 8.0) < 1e-13);
        TEST_CHECK(fabs(hull->mass.inertia[i + 3]) < 1e-14);
    }
    tl_blob_free(hull);
    // A lattice: its corners only.
    for (int i = 0; i < 343; i++) {
        points[i] = tl_vec3_make((float)(i % 7), (float)(i / 7 % 7), (float)(i / 49));
    }
    hull = build(points, 343);
    TEST_CHECK(hull->vertex_count == 8 && hull->face_count == 6);
    prove(hull, points, 343);
    tl_blob_free(hull);
}

static double farthest_outside(const tl_hull *hull, const tl_vec3 *points, uint32_t count)
{
    tl_convex body = tl_convex_from_hull(hull, 0.0f);
    double farthest = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        tl_convex point = tl_convex_sphere(points[i], 0.0f);
        tl_separation s;
        tl_convex_distance(&body, tl_transform_identity(), &point, tl_transform_identity(), NULL, &s);
        farthest = fmax(farthest, (double)s.distance);
    }
    return farthest;
}

static void test_reduction_is_graceful(void **state)
{
    (void)state;
    enum { N = 3000 };
    tl_vec3 *points = malloc(N * sizeof *points);
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { (uint64_t)kind };
        shape_make((shape_kind)kind, &random, points, N);
        double outside = 0.0, volume = 0.0;
        static const uint32_t limits[] = { 4, 8, 32, 128, 500, 0 };
        for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
            tl_hull_def def = tl_default_hull_def();
            def.max_vertices = limits[i];
            tl_hull *hull;
            tl_hull_report report;
            TEST_RESULT(tl_hull_bake(points, N, &def, &hull, &report), TL_OK);
            TEST_CHECK(limits[i] == 0 || hull->vertex_count <= limits[i]);
            TEST_RESULT(tl_hull_validate(hull, NULL, 0, NULL), TL_OK);
            TEST_CHECK((report.points_left_out == 0) == (report.max_outside == 0.0));
            tl_hull_validation found;
            tl_result inside = tl_hull_validate(hull, points, N, &found);
            TEST_CHECK((inside == TL_OK) == (report.points_left_out == 0));
            // A face's plane is no farther than the face; the distance is that of GJK.
            TEST_CHECK(found.max_outside <= report.max_outside * 1.000001);
            double farthest = farthest_outside(hull, points, N);
            TEST_CHECK(fabs(report.max_outside - farthest) <= 2e-6 * farthest);
            // The hulls are nested.
            TEST_CHECK(hull->mass.volume >= volume);
            outside = found.max_outside;
            volume = hull->mass.volume;
            tl_blob_free(hull);
        }
        TEST_CHECK(outside == 0.0);
    }
    free(points);
}

// The hull within a tolerance: proven, and no point farther outside by GJK than the tolerance and the report say.
static uint32_t check_tolerance(const tl_vec3 *points, uint32_t count, float tolerance)
{
    tl_hull_def def = tl_default_hull_def();
    def.tolerance = tolerance;
    tl_hull *hull, *again;
    tl_hull_report report;
    TEST_RESULT(tl_hull_bake(points, count, &def, &hull, &report), TL_OK);
    TEST_RESULT(tl_hull_bake(points, count, &def, &again, NULL), TL_OK);
    TEST_CHECK(hull->blob.size == again->blob.size && memcmp(hull, again, hull->blob.size) == 0);
    TEST_RESULT(tl_hull_validate(hull, NULL, 0, NULL), TL_OK);
    const double farthest = farthest_outside(hull, points, count);
    TEST_CHECK(report.max_outside <= (double)tolerance * 1.000001);
    TEST_CHECK(fabs(report.max_outside - farthest) <= 2e-6 * farthest);
    const uint32_t vertex_count = hull->vertex_count;
    tl_blob_free(hull);
    tl_blob_free(again);
    return vertex_count;
}

static void test_tolerance_is_kept(void **state)
{
    (void)state;
    enum { N = 1200 };
    static const float tolerances[] = { 1e-6f, 1e-3f, 0.02f, 0.3f, 1e3f };
    tl_vec3 *points = malloc(N * sizeof *points);
    uint32_t fewer = 0;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { (uint64_t)kind };
        shape_make((shape_kind)kind, &random, points, N);
        tl_hull *exact = build(points, N);
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
            const uint32_t count = check_tolerance(points, N, tolerances[i]);
            TEST_CHECK(count <= exact->vertex_count);
            fewer += count < exact->vertex_count;
        }
        tl_blob_free(exact);
    }
    TEST_CHECK(fewer > SHAPE_COUNT);
    free(points);
}

// Points that are near to the plane of a large face and far from the hull: round a thin plate, and on needles. Of a
// plate's rim as many corners are left as of a polygon's: within 1e-3 of a circle some hundred.
static void test_thin_bodies_keep_the_tolerance(void **state)
{
    (void)state;
    enum { N = 2000 };
    tl_vec3 *points = malloc(N * sizeof *points);
    for (int power = 2; power <= 5; power++) {
        const float half = powf(10.0f, -(float)power);
        test_random random = { (uint64_t)power };
        for (uint32_t i = 0; i < N; i++) {
            const double angle = 6.283185307179586 * (double)test_random_unit(&random);
            points[i] =
                tl_vec3_make((float)cos(angle), half * test_random_range(&random, -1.0f, 1.0f), (float)sin(angle));
        }
        TEST_CHECK(check_tolerance(points, N, 1e-3f) < 300);
        TEST_CHECK(check_tolerance(points, N, 1e-2f) < 100);
        for (uint32_t i = 0; i < N; i++) { // needles out of one point, each with two points near its tip
            const tl_vec3 tip = test_random_direction(&random);
            points[i] = tl_add(tl_scale(tip, i % 2 == 0 ? 1.0f : 0.9f), tl_scale(test_random_direction(&random), half));
        }
        check_tolerance(points, N, half);
        check_tolerance(points, N, 0.1f * half);
    }
    free(points);
}

// Faces whose normal has no length in double are no reason to leave a point out.
static void test_tiny_faces_leave_no_point_out(void **state)
{
    (void)state;
    const tl_vec3 points[] = {
        { -2.159042e-27f, 1.15000361e-40f, 1.68523662e+22f },  { 1.68523662e+22f, 1.68523662e+22f, 1.68523662e+22f },
        { 1.68523662e+22f, 1.68523662e+22f, 1.20562128e+22f }, { 1.68523662e+22f, 1.68523662e+22f, -0.670211792f },
        { -1.49779499f, 1.12103877e-44f, 5.60519386e-45f },    { 1.22568622e-13f, 3.51725915e-43f, 2.38814189e-39f },
        { 2.13462853e-30f, 2.40616175e-38f, 2.5238478e-11f }
    };
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    for (def.tolerance = 0.5f; def.tolerance >= 1e-9f; def.tolerance *= 0.01f) {
        tl_hull *hull;
        tl_hull_report report;
        TEST_RESULT(tl_hull_bake(points, sizeof points / sizeof *points, &def, &hull, &report), TL_OK);
        TEST_CHECK(report.max_outside <= (double)def.tolerance && hull->vertex_count == 5);
        tl_blob_free(hull);
    }
}

static void test_same_points_same_bytes(void **state)
{
    (void)state;
    tl_vec3 points[400];
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { (uint64_t)kind };
        shape_make((shape_kind)kind, &random, points, 400);
        tl_hull *a = build(points, 400), *b = build(points, 400);
        TEST_CHECK(a->blob.size == b->blob.size && memcmp(a, b, a->blob.size) == 0);
        tl_blob_free(a);
        tl_blob_free(b);
    }
}

// Bytes that all compilers, levels of optimization and the scalar twin of the SIMD code agree on. A change here means a
// change of the format or of the hulls themselves: raise TL_HULL_VERSION when old files cannot be read.
static void test_golden_hash(void **state)
{
    (void)state;
    static const shape_kind kinds[] = { SHAPE_SPHERE, SHAPE_CUBE_SURFACE, SHAPE_GRID, SHAPE_CUBE_VOLUME };
    tl_vec3 points[300];
    uint64_t hash = 0;
    for (int i = 0; i < 4; i++) {
        test_random random = { (uint64_t)i };
        shape_make(kinds[i], &random, points, 300);
        tl_hull *hull = build(points, 300);
        hash = tl_hash_bytes(hull, hull->blob.size, hash);
        tl_blob_free(hull);
    }
    TEST_CHECK(hash == 0xdce1d0c5ab30a328u);
}

static void test_memory_runs_out(void **state)
{
    (void)state;
    enum { N = 2000 };
    tl_vec3 *points = malloc(N * sizeof *points);
    for (int flat = 0; flat < 2; flat++) {
        test_random random = { 9 };
        shape_make(SHAPE_SPHERE, &random, points, N);
        for (int i = 0; flat && i < N; i++) {
            points[i].y = 0.0f;
        }
        uint64_t failures = 0;
        for (uint64_t k = 1;; k++) {
            test_allocator memory;
            test_allocator_init(&memory, k);
            tl_hull_def def = tl_default_hull_def();
            def.host.allocator = &memory.allocator;
            def.thickness = 0.1f;
            def.max_vertices = flat ? 100 : 0;
            tl_hull *hull;
            tl_result result = tl_hull_bake(points, N, &def, &hull, NULL);
            if (result == TL_OK) {
                tl_blob_free(hull);
                TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
                break;
            }
            failures++;
            TEST_RESULT(result, TL_ERR_MEMORY);
            TEST_CHECK(hull == NULL && memory.live_blocks == 0 && memory.live_bytes == 0);
        }
        TEST_CHECK(failures >= 3);
    }
    free(points);
}

static bool cancel(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)done;
    (void)total;
    (void)user;
    return false;
}

static void test_a_build_can_be_cancelled(void **state)
{
    (void)state;
    tl_vec3 points[100];
    test_random random = { 10 };
    shape_make(SHAPE_SPHERE, &random, points, 100);
    tl_progress progress = { cancel, NULL };
    tl_hull_def def = tl_default_hull_def();
    def.host.progress = &progress;
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, 100, &def, &hull, NULL), TL_ERR_CANCELLED);
    TEST_CHECK(hull == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hulls_are_proven_at_all_scales),
        cmocka_unit_test(test_hulls_far_from_the_origin),
        cmocka_unit_test(test_bad_points_and_defs_are_refused),
        cmocka_unit_test(test_a_cube_is_a_cube),
        cmocka_unit_test(test_reduction_is_graceful),
        cmocka_unit_test(test_tolerance_is_kept),
        cmocka_unit_test(test_thin_bodies_keep_the_tolerance),
        cmocka_unit_test(test_tiny_faces_leave_no_point_out),
        cmocka_unit_test(test_same_points_same_bytes),
        cmocka_unit_test(test_golden_hash),
        cmocka_unit_test(test_memory_runs_out),
        cmocka_unit_test(test_a_build_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
