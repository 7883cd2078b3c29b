// SPDX-License-Identifier: MIT
//
// soup_overlap.c: every kind of shape against every triangle, by an oracle in plain double (convex_oracle.h). An
// argument sets the number of queries: 100000 take a minute.

#include "convex_oracle.h"
#include "soup_models.h"

#include "soup/query/query_shape.h"

#include <float.h>

static uint32_t query_count = 4000;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

typedef enum test_kind { SPHERE, CAPSULE, BOX, ROUND_BOX, TRIANGLE, HULL, KIND_COUNT } test_kind;

static const char *const kind_names[] = { "sphere", "capsule", "box", "rounded box", "triangle", "hull" };

typedef struct test_shape {
    tl_convex shape;
    float radius;
    oracle_body body; // the core
} test_shape;

static void box_oracle(oracle_body *body, tl_vec3 half, tl_transform pose)
{
    static const uint8_t edges[12][2] = { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 }, { 0, 2 }, { 1, 3 },
                                          { 4, 6 }, { 5, 7 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } };
    static const uint8_t triangles[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 },
                                              { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 }, { 3, 6, 7 },
                                              { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
    body->vertex_count = 8;
    body->edge_count = body->triangle_count = 12;
    body->solid = true;
    for (uint32_t k = 0; k < 8; k++) {
        tl_vec3 v = vec(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z);
        body->vertices[k] = oracle_transform(pose, v);
    }
    for (uint32_t k = 0; k < 12; k++) {
        body->edges[2 * k] = edges[k][0];
        body->edges[2 * k + 1] = edges[k][1];
        for (uint32_t c = 0; c < 3; c++) {
            body->triangles[3 * k + c] = triangles[k][c];
        }
    }
}

static void make_shape(test_random *random, test_kind kind, float size, tl_transform pose, tl_hull *hull,
                       test_shape *shape)
{
    tl_vec3 half = test_random_point(random, vec(0.02f, 0.02f, 0.02f), vec(1, 1, 1));
    half = tl_scale(half, size);
    tl_vec3 points[3] = { tl_scale(test_random_direction(random), size), tl_scale(test_random_direction(random), size),
                          tl_scale(test_random_direction(random), size) };
    shape->radius = kind == BOX || kind == TRIANGLE ? 0.0f : test_random_unit(random) * size;
    switch (kind) {
    case SPHERE:
        shape->shape = tl_convex_sphere(points[0], shape->radius);
        oracle_from_points(&shape->body, points, 1, pose);
        break;
    case CAPSULE:
        shape->shape = tl_convex_capsule(points[0], points[1], shape->radius);
        oracle_from_points(&shape->body, points, 2, pose);
        break;
    case TRIANGLE:
        shape->shape = tl_convex_triangle(points[0], points[1], points[2], shape->radius);
        oracle_from_points(&shape->body, points, 3, pose);
        break;
    case HULL:
        shape->shape = tl_convex_from_hull(hull, shape->radius);
        oracle_from_hull(&shape->body, hull, pose);
        break;
    default:
        shape->shape = tl_convex_box(vec(0, 0, 0), half, shape->radius);
        box_oracle(&shape->body, half, pose);
        break;
    }
}

typedef struct regimes {
    uint32_t hit[KIND_COUNT], miss[KIND_COUNT], full, crowded, decided, close;
} regimes;

// Metres; shapes and triangles are some metres large. A surface closer than this may go either way.
#define DOUBT 1e-6

static void check_query(const model *m, const tl_soup *soup, const test_shape *shape, tl_transform pose, test_kind kind,
                        regimes *r)
{
    static uint32_t found[4096];
    static uint8_t is_found[1 << 16];
    uint32_t count;
    TEST_RESULT(tl_soup_find_overlaps(soup, &shape->shape, pose, NULL, found, 4096, &count), TL_OK);
    bool any = false;
    TEST_RESULT(tl_soup_overlaps(soup, &shape->shape, pose, NULL, &any), TL_OK);
    TEST_CHECK(any == (count > 0));
    memset(is_found, 0, m->triangle_count);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(!is_found[found[i]]);
        is_found[found[i]] = 1;
    }
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *corner = m->indices + 3 * (size_t)i;
        tl_vec3 c[3] = { m->vertices[corner[0]], m->vertices[corner[1]], m->vertices[corner[2]] };
        tl_aabb own = { tl_min(tl_min(c[0], c[1]), c[2]), tl_max(tl_max(c[0], c[1]), c[2]) };
        if (!tl_aabb_overlaps(own, tl_convex_bounds(&shape->shape, pose))) {
            TEST_CHECK(!is_found[i]);
            continue;
        }
        static oracle_body triangle;
        oracle_from_points(&triangle, c, 3, tl_transform_identity());
        double core_distance = oracle_distance(&shape->body, &triangle);
        double distance = core_distance > 0.0 ? core_distance - (double)shape->radius : -1.0;
        if (fabs(distance) <= DOUBT) {
            r->close++;
            continue;
        }
        r->decided++;
        if ((distance < 0) != (is_found[i] != 0)) {
            print_error("%s, triangle %u: distance %.9g, found %d\n", kind_names[kind], i, distance, is_found[i]);
            fail();
        }
    }
    r->hit[kind] += count > 0;
    r->miss[kind] += count == 0;
    r->crowded += count > 8;
    if (count > 1) {
        uint32_t again, few[2] = { 0, UINT32_MAX };
        TEST_RESULT(tl_soup_find_overlaps(soup, &shape->shape, pose, NULL, few, 1, &again), TL_INCOMPLETE);
        TEST_CHECK(again == count && few[0] == found[0] && few[1] == UINT32_MAX);
        r->full++;
    }
}

static void check_model(model m, model_storage storage, uint32_t count, regimes *r)
{
    test_random random = { m.triangle_count + 1 };
    tl_soup_def def = model_soup_def(storage);
    tl_soup *soup = model_soup(&m, &def);
    tl_aabb bounds = tl_soup_bounds(soup);
    test_body hull;
    test_body_make(&hull, BODY_BALL, 1, 0.7f);
    for (uint32_t i = 0; i < count; i++) {
        test_kind kind = (test_kind)(i % KIND_COUNT);
        tl_transform pose = tl_transform_identity();
        pose.position = test_random_point(&random, bounds.min, bounds.max);
        if (i % 3 != 0) {
            pose.rotation = test_random_rotation(&random);
        }
        static test_shape shape;
        make_shape(&random, kind, i % 2 ? 0.3f : 1.0f, pose, hull.hull, &shape);
        check_query(&m, soup, &shape, pose, kind, r);
    }
    test_body_free(&hull);
    tl_blob_free(soup);
    model_free(&m);
}

static void test_against_all_triangles(void **state)
{
    (void)state;
    regimes r = { 0 };
    uint32_t n = query_count / 8;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        check_model(model_terrain(20, 2, vec(0, 0, 0), 1), storage, n, &r);
        check_model(model_terrain(20, 2, vec(5000, 100, -5000), 2), storage, n, &r);
        check_model(model_random(400, 5, 1, 3), storage, n, &r);
        check_model(model_ball(4, 3, 0.1f, vec(0, 0, 0), 4), storage, n, &r);
    }
    for (uint32_t k = 0; k < KIND_COUNT; k++) {
        print_message("%s: %u touch, %u do not\n", kind_names[k], r.hit[k], r.miss[k]);
        TEST_CHECK(r.hit[k] > query_count / 50 && r.miss[k] > query_count / 50);
    }
    print_message("triangles decided %u, too close to tell %u; lists of more than 8: %u, cut short: %u\n", r.decided,
                  r.close, r.crowded, r.full);
    TEST_CHECK(r.crowded > query_count / 100 && r.full > query_count / 10 && r.close < r.decided / 100);
}

static bool touches(const tl_soup *soup, tl_convex shape, tl_vec3 at, const tl_ray_filter *filter)
{
    tl_transform pose = tl_transform_identity();
    pose.position = at;
    bool overlaps;
    TEST_RESULT(tl_soup_overlaps(soup, &shape, pose, filter, &overlaps), TL_OK);
    return overlaps;
}

static bool refuse(uint32_t triangle, uint16_t material, void *user)
{
    (void)triangle;
    (void)material;
    (void)user;
    return false;
}

static void test_examples(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    tl_convex ball = tl_convex_sphere(vec(0, 0, 0), 1), box = tl_convex_box(vec(0, 0, 0), vec(1, 1, 1), 0);
    tl_convex capsule = tl_convex_capsule(vec(0, -1, 0), vec(0, 1, 0), 0.5f);
    TEST_CHECK(touches(soup, ball, vec(1, 1, 1), NULL) && !touches(soup, ball, vec(1, 1.0001f, 1), NULL));
    TEST_CHECK(touches(soup, box, vec(-1, 0, -1), NULL) && !touches(soup, box, vec(-1.0001f, 0, 0), NULL));
    TEST_CHECK(touches(soup, box, vec(3, 0, 3), NULL) && !touches(soup, box, vec(3.001f, 0, 3.001f), NULL));
    TEST_CHECK(touches(soup, capsule, vec(1, 0, 1), NULL)); // right through
    TEST_CHECK(touches(soup, capsule, vec(1, 1.5f, 1), NULL) && !touches(soup, capsule, vec(1, 1.501f, 1), NULL));
    tl_ray_filter filter = { 0 };
    filter.cull = TL_RAY_CULL_BACK; // the triangle's front looks down
    TEST_CHECK(touches(soup, ball, vec(1, -0.5f, 1), &filter) && !touches(soup, ball, vec(1, 0.5f, 1), &filter));
    TEST_CHECK(touches(soup, ball, vec(1, 0, 1), &filter));
    filter.cull = TL_RAY_CULL_FRONT;
    TEST_CHECK(!touches(soup, ball, vec(1, -0.5f, 1), &filter) && touches(soup, ball, vec(1, 0.5f, 1), &filter));
    memset(&filter, 0, sizeof filter);
    filter.ignored_materials = ~2ull;
    TEST_CHECK(!touches(soup, ball, vec(1, 0, 1), &filter));
    filter.ignored_materials = ~1ull;
    TEST_CHECK(touches(soup, ball, vec(1, 0, 1), &filter));
    filter.accept = refuse;
    TEST_CHECK(!touches(soup, ball, vec(1, 0, 1), &filter));
    tl_blob_free(soup);
    model_free(&m);
}

static void test_refused_by_name(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    bool overlaps;
    tl_transform pose = tl_transform_identity();
    tl_convex ball = tl_convex_sphere(vec(0, NAN, 0), 1);
    TEST_RESULT(tl_soup_overlaps(soup, &ball, pose, NULL, &overlaps), TL_ERR_NOT_FINITE);
    ball = tl_convex_sphere(vec(0, 0, 0), -1);
    TEST_RESULT(tl_soup_overlaps(soup, &ball, pose, NULL, &overlaps), TL_ERR_ARGUMENT);
    ball = tl_convex_sphere(vec(0, 0, 0), NAN);
    TEST_RESULT(tl_soup_overlaps(soup, &ball, pose, NULL, &overlaps), TL_ERR_ARGUMENT);
    ball = tl_convex_sphere(vec(0, 0, 0), INFINITY);
    TEST_RESULT(tl_soup_overlaps(soup, &ball, pose, NULL, &overlaps), TL_ERR_NOT_FINITE);
    ball = tl_convex_sphere(vec(0, 0, 0), 1);
    pose.position.x = NAN;
    TEST_RESULT(tl_soup_overlaps(soup, &ball, pose, NULL, &overlaps), TL_ERR_NOT_FINITE);
    pose = tl_transform_identity();
    pose.rotation.w = NAN;
    uint32_t count;
    TEST_RESULT(tl_soup_find_overlaps(soup, &ball, pose, NULL, NULL, 0, &count), TL_ERR_NOT_FINITE);
    tl_blob_free(soup);
    model_free(&m);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        query_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_refused_by_name),
        cmocka_unit_test(test_against_all_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
