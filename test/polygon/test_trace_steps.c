// SPDX-License-Identifier: MIT
//
// What the trace hands out, followed step by step with the plain form: at each step the potential partitions are those
// that the plain tests allow, the chosen one is their shortest (of merges: longest), and what it makes is the mesh.

#include "polygon/outline/trace_steps.h"

#include "polygon_shapes.h"

enum { MAX_POINTS = 64 };

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];

typedef struct follower {
    uint32_t point_count, max_corners;
    uint32_t left[MAX_POINTS], left_count; // of the outline
    uint32_t triangles[3 * MAX_POINTS], cuts, merges;
    oracle_polygons polygons;
    uint64_t offered; // partitions
} follower;

static uint32_t number_at(const follower *f, const int32_t *coordinates)
{
    uint32_t i = 0;
    while (i < f->point_count && (points[i].x != coordinates[0] || points[i].z != coordinates[1])) {
        i++;
    }
    TEST_CHECK(i < f->point_count);
    return i;
}

static bool offers(const follower *f, const tl_polygon_step *step, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < step->partition_count; k++) {
        uint32_t from = number_at(f, step->partitions + 4 * k), to = number_at(f, step->partitions + 4 * k + 2);
        if ((from == a && to == b) || (from == b && to == a)) {
            return true;
        }
    }
    return false;
}

static int64_t length2(const int32_t *partition)
{
    int64_t dx = (int64_t)partition[2] - partition[0], dz = (int64_t)partition[3] - partition[1];
    return dx * dx + dz * dz;
}

static void follow_cut(follower *f, const tl_polygon_step *step)
{
    TEST_CHECK(step->corner_count == 3 && step->outline_count == f->left_count && f->merges == 0);
    uint32_t n = f->left_count, start = 0;
    while (f->left[start] != number_at(f, step->outline)) {
        start++;
    }
    for (uint32_t i = 0; i < n; i++) {
        TEST_CHECK(number_at(f, step->outline + 2 * i) == f->left[(start + i) % n]);
    }
    uint32_t valid = 0;
    for (uint32_t i = 0; i < n && n > 3; i++) {
        bool is_valid = oracle_is_valid_cut(points, f->left, n, i);
        // With four corners left both diagonals of a pair of cuts are one edge.
        TEST_CHECK(!is_valid || offers(f, step, f->left[i], f->left[(i + 2) % n]));
        valid += is_valid;
    }
    TEST_CHECK(valid == step->partition_count && (valid > 0) == (n > 3));
    for (uint32_t k = 1; k < valid; k++) {
        TEST_CHECK(length2(step->partitions) <= length2(step->partitions + 4 * k));
    }
    for (uint32_t k = 0; k < 3; k++) {
        f->triangles[3 * f->cuts + k] = number_at(f, step->corners + 2 * k);
    }
    TEST_CHECK(n == 3 || (number_at(f, step->partitions) == f->triangles[3 * f->cuts] &&
                          number_at(f, step->partitions + 2) == f->triangles[3 * f->cuts + 2]));
    uint32_t kept = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (f->left[i] != f->triangles[3 * f->cuts + 1]) {
            f->left[kept++] = f->left[i];
        }
    }
    TEST_CHECK(kept == n - 1);
    f->left_count = kept;
    f->cuts++;
}

static void begin_merging(follower *f)
{
    f->polygons.count = f->cuts;
    f->polygons.sizes = malloc(f->cuts * sizeof *f->polygons.sizes);
    f->polygons.corners = malloc(f->cuts * sizeof *f->polygons.corners);
    for (uint32_t t = 0; t < f->cuts; t++) {
        f->polygons.sizes[t] = 3;
        f->polygons.corners[t] = malloc(MAX_POINTS * sizeof(uint32_t));
        memcpy(f->polygons.corners[t], f->triangles + 3 * t, 3 * sizeof(uint32_t));
    }
}

static void follow_merge(follower *f, const tl_polygon_step *step)
{
    if (f->merges++ == 0) {
        TEST_CHECK(f->cuts == f->point_count - 2);
        begin_merging(f);
    }
    TEST_CHECK(step->outline_count == 0);
    uint32_t possible = 0, first = UINT32_MAX, second = UINT32_MAX;
    const uint32_t from = number_at(f, step->partitions), to = number_at(f, step->partitions + 2);
    for (uint32_t a = 0; a < f->polygons.count; a++) {
        for (uint32_t b = a + 1; b < f->polygons.count; b++) {
            uint32_t edge_a, edge_b;
            int64_t value = oracle_merge_value(points, &f->polygons, a, b, f->max_corners, &edge_a, &edge_b);
            if (value < 0) {
                continue;
            }
            uint32_t u = f->polygons.corners[a][edge_a], v = f->polygons.corners[b][edge_b];
            TEST_CHECK(value <= length2(step->partitions) && offers(f, step, u, v));
            possible++;
            if ((u == from && v == to) || (u == to && v == from)) {
                first = a;
                second = b;
            }
        }
    }
    TEST_CHECK(first != UINT32_MAX && possible == step->partition_count);
    TEST_CHECK(step->corner_count == f->polygons.sizes[first] + f->polygons.sizes[second] - 2);
    for (uint32_t k = 0; k < step->corner_count; k++) {
        f->polygons.corners[first][k] = number_at(f, step->corners + 2 * k);
    }
    f->polygons.sizes[first] = step->corner_count;
    f->polygons.count--;
    uint32_t *freed = f->polygons.corners[second];
    f->polygons.corners[second] = f->polygons.corners[f->polygons.count];
    f->polygons.sizes[second] = f->polygons.sizes[f->polygons.count];
    f->polygons.corners[f->polygons.count] = freed;
}

static void follow(const tl_polygon_step *step, void *user)
{
    follower *f = user;
    TEST_CHECK(step->contour == 0);
    f->offered += step->partition_count;
    if (step->kind == TL_POLYGON_STEP_CUT) {
        follow_cut(f, step);
    } else {
        follow_merge(f, step);
    }
}

static void begin(follower *f, uint32_t n, uint32_t max_corners)
{
    memset(f, 0, sizeof *f);
    f->point_count = f->left_count = n;
    f->max_corners = max_corners;
    for (uint32_t i = 0; i < n; i++) {
        f->left[i] = i;
    }
}

static void end(follower *f, const tl_polygon_mesh *mesh)
{
    TEST_CHECK(f->cuts == f->point_count - 2 && mesh->polygon_count == f->cuts - f->merges);
    if (f->merges > 0) {
        oracle_polygons_free(&f->polygons, f->cuts);
    }
}

static void steps_are_those_of_the_plain_method(void **state)
{
    (void)state;
    static const uint32_t caps[4] = { 6, 0, 4, 3 };
    test_random random = { 5 };
    uint32_t followed = 0, merges = 0;
    uint64_t offered = 0;
    for (uint32_t round = 0; round < 1500; round++) {
        uint32_t n = 3 + test_random_below(&random, 22);
        if (!shape_untangled(&random, points, n, 8u << test_random_below(&random, 8))) {
            continue;
        }
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, n, vertices, &contour);
        follower f;
        begin(&f, n, caps[round % 4]);
        const tl_polygon_trace trace = { follow, &f };
        tl_polygon_def def = tl_default_polygon_def();
        def.max_verts_per_poly = caps[round % 4];
        def.trace = &trace;
        tl_polygon_mesh traced, mesh;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &traced, NULL), TL_OK);
        end(&f, &traced);
        def.trace = NULL;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
        TEST_CHECK(mesh.block_size == traced.block_size && memcmp(mesh.block, traced.block, mesh.block_size) == 0);
        tl_polygon_mesh_free(&traced);
        tl_polygon_mesh_free(&mesh);
        followed++;
        merges += f.merges;
        offered += f.offered;
    }
    TEST_CHECK(followed > 800 && merges > 2000 && offered > 20000);
}

typedef struct step_counts {
    uint32_t cuts, merges, last_contour;
} step_counts;

static void count_step(const tl_polygon_step *step, void *user)
{
    step_counts *counts = user;
    TEST_CHECK(step->contour >= counts->last_contour);
    counts->last_contour = step->contour;
    counts->cuts += step->kind == TL_POLYGON_STEP_CUT;
    counts->merges += step->kind == TL_POLYGON_STEP_MERGE;
}

// Every method begins with the cuts; only the optimal one does not end with merges.
static void each_method_hands_out_its_steps(void **state)
{
    (void)state;
    uint32_t n = shape_holes(points, 4, 2);
    tl_contour contours[2];
    tl_contour_set set = shape_as_set(points, n, vertices, contours);
    contours[1] = contours[0];
    set.contours = contours;
    set.contour_count = 2;
    for (int method = TL_PARTITION_CLASSIC; method <= TL_PARTITION_DELAUNAY; method++) {
        step_counts counts = { 0, 0, 0 };
        const tl_polygon_trace trace = { count_step, &counts };
        tl_polygon_def def = tl_default_polygon_def();
        def.method = (tl_partition_method)method;
        def.trace = &trace;
        tl_polygon_mesh mesh;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
        TEST_CHECK(counts.cuts == 2 * (n - 2) && counts.last_contour == 1);
        TEST_CHECK(counts.merges == (method == TL_PARTITION_OPTIMAL ? 0 : counts.cuts - mesh.polygon_count));
        tl_polygon_mesh_free(&mesh);
    }
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    uint32_t n = shape_holes(points, 4, 2);
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    step_counts counts = { 0, 0, 0 };
    const tl_polygon_trace trace = { count_step, &counts };
    tl_polygon_def def = tl_default_polygon_def();
    def.trace = &trace;
    TEST_CHECK(shape_check_failing_memory(&set, def) > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_those_of_the_plain_method),
        cmocka_unit_test(each_method_hands_out_its_steps),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
