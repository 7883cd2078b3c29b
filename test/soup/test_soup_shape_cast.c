// SPDX-License-Identifier: MIT
//
// soup_shape_cast.c: moving shapes by example, and against an oracle that steps. The distance of two convex sets is
// convex in their motion; the oracle looks at it at 48 steps for every triangle on the way, then between the steps
// around the minimum, with plain distances of corners, edges and faces (convex_oracle.h). An argument sets the number
// of casts.

#include "convex_oracle.h"
#include "soup_models.h"

#include <float.h>

static uint32_t cast_count = 540;

enum { STEPS = 48 };

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

typedef enum test_kind { SPHERE, CAPSULE, ROUND_BOX, ROUND_TRIANGLE, ROUND_HULL, KIND_COUNT } test_kind;

static const char *const kind_names[] = { "sphere", "capsule", "rounded box", "rounded triangle", "rounded hull" };

typedef struct moving {
    tl_convex shape;
    oracle_body body; // the core
    double radius;
    tl_vec3d step;
    tl_vec3 corners[3]; // of the triangle
} moving;

// Gap at a time. The triangle moves the other way, as it has the fewer vertices.
static double gap_at(const moving *m, double t)
{
    static oracle_body moved;
    oracle_from_points(&moved, m->corners, 3, tl_transform_identity());
    for (uint32_t i = 0; i < moved.vertex_count; i++) {
        moved.vertices[i] = tl_vec3d_mul_add(moved.vertices[i], m->step, -t);
    }
    return oracle_distance(&m->body, &moved) - m->radius;
}

// The first time at which the gap is at most `depth`, to within 2^-40; 2 when it never is. `least` is a time at which
// it is smallest, and on the way there it only shrinks.
static double first_time(const moving *m, double least, double depth)
{
    if (gap_at(m, least) > depth) {
        return 2.0;
    }
    if (!(gap_at(m, 0.0) > depth)) {
        return 0.0;
    }
    double low = 0.0, high = least;
    for (int i = 0; i < 40; i++) {
        double middle = 0.5 * (low + high);
        *(gap_at(m, middle) > depth ? &low : &high) = middle;
    }
    return high;
}

static double min_time(const moving *m)
{
    int best = 0;
    double best_gap = gap_at(m, 0.0);
    for (int i = 1; i <= STEPS; i++) {
        double gap = gap_at(m, (double)i / STEPS);
        if (gap < best_gap) {
            best_gap = gap;
            best = i;
        }
    }
    double low = (double)(best > 0 ? best - 1 : 0) / STEPS, high = (double)(best < STEPS ? best + 1 : STEPS) / STEPS;
    for (int i = 0; i < 60; i++) {
        double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (gap_at(m, a) <= gap_at(m, b)) {
            high = b;
        } else {
            low = a;
        }
    }
    return low;
}

// When the whole soup is surely touched, and before when surely not.
typedef struct oracle_times {
    double early, late;
} oracle_times;

static oracle_times oracle_cast(const model *m, moving *moving_shape, tl_aabb swept, double doubt)
{
    oracle_times times = { 2.0, 2.0 };
    const double way = tl_vec3d_length(moving_shape->step);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *corner = m->indices + 3 * (size_t)i;
        tl_vec3 *c = moving_shape->corners;
        for (uint32_t k = 0; k < 3; k++) {
            c[k] = m->vertices[corner[k]];
        }
        tl_aabb own = { tl_min(tl_min(c[0], c[1]), c[2]), tl_max(tl_max(c[0], c[1]), c[2]) };
        // The gap changes by no more than the way.
        if (!tl_aabb_overlaps(own, swept) || gap_at(moving_shape, 0.5) > 0.5 * way + doubt) {
            continue;
        }
        double least = min_time(moving_shape);
        double early = first_time(moving_shape, least, doubt);
        double late = early <= 1.0 ? first_time(moving_shape, least, -doubt) : 2.0;
        times.early = early < times.early ? early : times.early;
        times.late = late < times.late ? late : times.late;
    }
    return times;
}

static void make_shape(test_random *random, test_kind kind, tl_transform pose, const tl_hull *hull, moving *shape)
{
    tl_vec3 points[3] = { test_random_direction(random), test_random_direction(random), test_random_direction(random) };
    float radius = test_random_range(random, 0.1f, 0.6f);
    for (uint32_t k = 0; k < 3; k++) {
        points[k] = tl_scale(points[k], test_random_range(random, 0.1f, 0.8f));
    }
    switch (kind) {
    case SPHERE:
        shape->shape = tl_convex_sphere(points[0], radius);
        oracle_from_points(&shape->body, points, 1, pose);
        break;
    case CAPSULE:
        shape->shape = tl_convex_capsule(points[0], points[1], radius);
        oracle_from_points(&shape->body, points, 2, pose);
        break;
    case ROUND_TRIANGLE:
        shape->shape = tl_convex_triangle(points[0], points[1], points[2], radius);
        oracle_from_points(&shape->body, points, 3, pose);
        break;
    case ROUND_BOX: {
        // As a hull of its corners too: the oracle has no boxes.
        shape->shape = tl_convex_box(vec(0, 0, 0), vec(0.3f, 0.2f, 0.4f), radius);
        tl_vec3 corners[8];
        for (uint32_t k = 0; k < 8; k++) {
            corners[k] = vec(k & 1 ? 0.3f : -0.3f, k & 2 ? 0.2f : -0.2f, k & 4 ? 0.4f : -0.4f);
        }
        tl_hull *box;
        TEST_RESULT(tl_hull_bake(corners, 8, NULL, &box, NULL), TL_OK);
        oracle_from_hull(&shape->body, box, pose);
        tl_blob_free(box);
        break;
    }
    default:
        shape->shape = tl_convex_from_hull(hull, radius);
        oracle_from_hull(&shape->body, hull, pose);
        break;
    }
    shape->radius = (double)radius;
}

typedef struct regimes {
    uint32_t hit[KIND_COUNT], free_way[KIND_COUNT], overlap, exact;
} regimes;

static void check_normal(const tl_shape_hit *hit)
{
    TEST_CHECK(fabsf(tl_length(hit->normal) - 1.0f) < 1e-5f);
    TEST_CHECK(fabsf(tl_length(hit->face_normal) - 1.0f) < 1e-5f);
    TEST_CHECK(hit->status == TL_CONVEX_CONVERGED);
}

static void check_cast(const model *m, const tl_soup *soup, moving *shape, tl_transform pose, tl_vec3 step,
                       test_kind kind, regimes *r)
{
    shape->step = tl_vec3d_from(step);
    tl_aabb swept = tl_convex_bounds(&shape->shape, pose);
    tl_aabb moved = { tl_add(swept.min, step), tl_add(swept.max, step) };
    swept = tl_aabb_union(swept, moved);
    tl_vec3 reach = tl_max(tl_abs(swept.min), tl_abs(swept.max));
    double doubt = 2e-6 * (double)tl_maxf(reach.x, tl_maxf(reach.y, reach.z));
    tl_vec3 wide = tl_scale(vec(1, 1, 1), 2 * (float)doubt);
    swept.min = tl_sub(swept.min, wide);
    swept.max = tl_add(swept.max, wide);
    oracle_times times = oracle_cast(m, shape, swept, doubt);
    tl_shape_hit hit;
    tl_result result = tl_soup_cast_shape(soup, &shape->shape, pose, step, NULL, &hit);
    if (result == TL_NOT_FOUND) {
        if (!(times.late > 1.0)) {
            print_error("%s: lost, surely touched at %.9g\n", kind_names[kind], times.late);
            fail();
        }
        r->free_way[kind]++;
        return;
    }
    TEST_RESULT(result, TL_OK);
    check_normal(&hit);
    if (!((double)hit.t >= times.early - 1e-6 && (double)hit.t <= times.late + 1e-6)) {
        print_error("%s: t %.9g, not within %.9g and %.9g\n", kind_names[kind], (double)hit.t, times.early, times.late);
        fail();
    }
    r->exact += times.late - times.early < 1e-3;
    r->overlap += hit.initial_overlap;
    r->hit[kind]++;
    if (hit.initial_overlap) {
        TEST_CHECK(hit.t == 0 && hit.depth > 0);
        return;
    }
    TEST_CHECK(hit.depth == 0 && tl_dot(hit.normal, step) <= 0);
    // At that time the shape touches, and the point lies on its triangle.
    static oracle_body triangle, point;
    const uint32_t *corner = m->indices + 3 * (size_t)hit.triangle;
    for (uint32_t k = 0; k < 3; k++) {
        shape->corners[k] = m->vertices[corner[k]];
    }
    oracle_from_points(&triangle, shape->corners, 3, tl_transform_identity());
    oracle_from_points(&point, &hit.point, 1, tl_transform_identity());
    TEST_CHECK(fabs(gap_at(shape, (double)hit.t)) <= doubt);
    TEST_CHECK(oracle_distance(&point, &triangle) <= doubt);
}

static void check_model(model m, model_storage storage, uint32_t count, float length, regimes *r)
{
    test_random random = { m.triangle_count + 7 };
    tl_soup_def def = model_soup_def(storage);
    tl_soup *soup = model_soup(&m, &def);
    tl_aabb bounds = tl_soup_bounds(soup);
    test_body hull;
    test_body_make(&hull, BODY_TETRAHEDRON, 1, 0.5f);
    for (uint32_t i = 0; i < count; i++) {
        test_kind kind = (test_kind)(i % KIND_COUNT);
        tl_transform pose = tl_transform_identity();
        pose.position = test_random_point(&random, bounds.min, tl_add(bounds.max, vec(0, 2, 0)));
        if (i % 3 != 0) {
            pose.rotation = test_random_rotation(&random);
        }
        tl_vec3 step = tl_scale(test_random_direction(&random), test_random_range(&random, 0, length));
        if (i % 4 == 0) { // along an axis
            step = i % 8 == 0 ? vec(0, -length, 0) : vec(length, 0, 0);
        }
        static moving shape;
        make_shape(&random, kind, pose, hull.hull, &shape);
        check_cast(&m, soup, &shape, pose, step, kind, r);
    }
    test_body_free(&hull);
    tl_blob_free(soup);
    model_free(&m);
}

static void test_against_steps(void **state)
{
    (void)state;
    regimes r = { 0 };
    uint32_t n = cast_count / 6;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        check_model(model_terrain(12, 2, vec(0, 0, 0), 1), storage, n, 6, &r);
        check_model(model_random(60, 4, 1, 3), storage, n, 6, &r);
        check_model(model_ball(3, 3, 0.1f, vec(0, 0, 0), 4), storage, n, 6, &r);
    }
    for (uint32_t k = 0; k < KIND_COUNT; k++) {
        print_message("%s: %u hit, %u free\n", kind_names[k], r.hit[k], r.free_way[k]);
        TEST_CHECK(r.hit[k] > cast_count / 20 && r.free_way[k] > cast_count / 100);
    }
    print_message("overlap at the start %u; times known to 0.001: %u\n", r.overlap, r.exact);
    TEST_CHECK(r.overlap > cast_count / 10 && r.exact > cast_count / 3);
}

// Fifty thousand triangles, near and five kilometres away.
static void test_large_level(void **state)
{
    (void)state;
    regimes r = { 0 };
    check_model(model_terrain(158, 2, vec(0, 0, 0), 1), MODEL_BOXES, cast_count / 20, 10, &r);
    check_model(model_terrain(158, 2, vec(5000, 0, -5000), 1), MODEL_BOXES, cast_count / 40, 10, &r);
    uint32_t hits = 0;
    for (uint32_t k = 0; k < KIND_COUNT; k++) {
        hits += r.hit[k];
    }
    print_message("51,824 triangles: %u casts hit, %u of them overlap at the start\n", hits, r.overlap);
    TEST_CHECK(hits > cast_count / 60);
}

static tl_result cast_at(const tl_soup *soup, tl_convex shape, tl_vec3 at, tl_vec3 step, const tl_ray_filter *filter,
                         tl_shape_hit *hit)
{
    tl_transform pose = tl_transform_identity();
    pose.position = at;
    return tl_soup_cast_shape(soup, &shape, pose, step, filter, hit);
}

// A floor of n * n cells at y = 0, its front up.
static model flat_floor(uint32_t n)
{
    model m = { 0 };
    for (uint32_t z = 0; z <= n; z++) {
        for (uint32_t x = 0; x <= n; x++) {
            model_vertex(&m, (float)x * 0.37f, 0, (float)z * 0.37f);
        }
    }
    for (uint32_t z = 0; z < n; z++) {
        for (uint32_t x = 0; x < n; x++) {
            uint32_t a = z * (n + 1) + x;
            model_triangle(&m, a, a + n + 1, a + 1);
            model_triangle(&m, a + 1, a + n + 1, a + n + 2);
        }
    }
    return m;
}

static void test_examples(void **state)
{
    (void)state;
    model m = flat_floor(10);
    tl_soup *soup = model_soup(&m, NULL);
    tl_convex capsule = tl_convex_capsule(vec(0, 0.5f, 0), vec(0, 1.5f, 0), 0.5f);
    tl_convex box = tl_convex_box(vec(0, 0.5f, 0), vec(0.5f, 0.5f, 0.5f), 0);
    tl_shape_hit hit;
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, -6, 0), NULL, &hit), TL_OK);
    TEST_CHECK(fabsf(hit.t - 0.5f) < 1e-6f && hit.t <= 0.5f && !hit.back && !hit.initial_overlap);
    TEST_CHECK(fabsf(hit.normal.y - 1) < 1e-6f && hit.face_normal.y == 1 && fabsf(hit.point.y) < 1e-6f);
    TEST_RESULT(cast_at(soup, box, vec(2, 3, 2), vec(0, -6, 0), NULL, &hit), TL_OK);
    TEST_CHECK(fabsf(hit.t - 0.5f) < 1e-5f && hit.t <= 0.5f && fabsf(hit.normal.y - 1) < 1e-5f);
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, -2.9f, 0), NULL, &hit), TL_NOT_FOUND);
    TEST_RESULT(cast_at(soup, capsule, vec(2, -3, 2), vec(0, 6, 0), NULL, &hit), TL_OK);
    TEST_CHECK(hit.back && hit.normal.y < -0.999f && hit.face_normal.y == 1);
    // In the floor: the way out, and how far.
    TEST_RESULT(cast_at(soup, capsule, vec(2, -0.25f, 2), vec(0, -1, 0), NULL, &hit), TL_OK);
    TEST_CHECK(hit.initial_overlap && hit.t == 0 && fabsf(hit.depth - 0.25f) < 1e-6f && hit.normal.y > 0.999f);
    TEST_RESULT(cast_at(soup, capsule, vec(2, -0.25f, 2), vec(0, 0, 0), NULL, &hit), TL_OK);
    TEST_CHECK(hit.initial_overlap);
    TEST_RESULT(cast_at(soup, box, vec(2, -0.25f, 2), vec(1, 0, 0), NULL, &hit), TL_OK);
    TEST_CHECK(hit.initial_overlap && fabsf(hit.depth - 0.25f) < 1e-5f && hit.normal.y > 0.999f);
    // Filters.
    tl_ray_filter filter = { 0 };
    filter.cull = TL_RAY_CULL_BACK;
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, -6, 0), &filter, &hit), TL_OK);
    TEST_RESULT(cast_at(soup, capsule, vec(2, -3, 2), vec(0, 6, 0), &filter, &hit), TL_NOT_FOUND);
    memset(&filter, 0, sizeof filter);
    filter.ignored_materials = ~2ull;
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, -6, 0), &filter, &hit), TL_NOT_FOUND);
    // By name.
    TEST_RESULT(cast_at(soup, capsule, vec(2, NAN, 2), vec(0, -6, 0), NULL, &hit), TL_ERR_NOT_FINITE);
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, NAN, 0), NULL, &hit), TL_ERR_NOT_FINITE);
    TEST_RESULT(cast_at(soup, capsule, vec(2, 3, 2), vec(0, INFINITY, 0), NULL, &hit), TL_ERR_NOT_FINITE);
    TEST_RESULT(cast_at(soup, tl_convex_sphere(vec(0, 0, 0), -1), vec(2, 3, 2), vec(0, 1, 0), NULL, &hit),
                TL_ERR_ARGUMENT);
    tl_blob_free(soup);
    model_free(&m);
}

// What stands on a floor slides over all its inner edges, and is stopped by a step of the same floor.
static void test_slides_over_inner_edges(void **state)
{
    (void)state;
    model m = flat_floor(40);
    test_random random = { 9 };
    tl_soup *soup = model_soup(&m, NULL);
    tl_convex shapes[4] = { tl_convex_capsule(vec(0, 0.5f, 0), vec(0, 1.5f, 0), 0.5f),
                            tl_convex_sphere(vec(0, 0.5f, 0), 0.5f),
                            tl_convex_box(vec(0, 0.5f, 0), vec(0.4f, 0.5f, 0.3f), 0),
                            tl_convex_box(vec(0, 0.5f, 0), vec(0.2f, 0.3f, 0.1f), 0.2f) };
    uint32_t slid = 0;
    for (uint32_t i = 0; i < 600; i++) {
        tl_convex shape = shapes[i % 4];
        tl_vec3 at = vec(test_random_range(&random, 3, 11), 5, test_random_range(&random, 3, 11));
        tl_shape_hit hit;
        tl_vec3 down = vec(test_random_range(&random, -1, 1), -10, test_random_range(&random, -1, 1));
        TEST_RESULT(cast_at(soup, shape, at, down, NULL, &hit), TL_OK);
        TEST_CHECK(!hit.initial_overlap && hit.normal.y > 0.9999f);
        at = tl_mul_add(at, down, hit.t);
        tl_vec3 slide = vec(test_random_range(&random, -3, 3), 0, test_random_range(&random, -3, 3));
        TEST_RESULT(cast_at(soup, shape, at, slide, NULL, &hit), TL_NOT_FOUND);
        TEST_RESULT(cast_at(soup, shape, at, vec(0, 1, 0), NULL, &hit), TL_NOT_FOUND); // and up
        TEST_RESULT(cast_at(soup, shape, at, vec(0, -1, 0), NULL, &hit), TL_OK);       // not down
        TEST_CHECK(hit.t < 1e-4f);
        slid++;
    }
    TEST_CHECK(slid == 600);
    tl_blob_free(soup);
    model_free(&m);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        cast_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_slides_over_inner_edges),
        cmocka_unit_test(test_against_steps),
        cmocka_unit_test(test_large_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
