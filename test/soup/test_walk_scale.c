// SPDX-License-Identifier: MIT
//
// walk_scale.c, soup_scaled.h: every answer against a soup baked of scaled corners, in all layouts, bit by bit; bad
// scales. An argument sets the number of queries a scale.

#include "soup_models.h"

#include "math/scale.h"

#include <talus/soup_scaled.h>

static uint32_t query_count = 40;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static tl_triangle_feature feature_in_view(tl_triangle_feature feature, bool mirrored)
{
    static const tl_triangle_feature other[7] = { TL_TRIANGLE_FACE,    TL_TRIANGLE_EDGE_2,   TL_TRIANGLE_EDGE_1,
                                                  TL_TRIANGLE_EDGE_0,  TL_TRIANGLE_CORNER_0, TL_TRIANGLE_CORNER_2,
                                                  TL_TRIANGLE_CORNER_1 };
    return mirrored ? other[feature] : feature;
}

typedef struct regimes {
    uint32_t near_points, fronts, backs, overlaps, hits, deep;
} regimes;

typedef struct pair {
    tl_scaled_soup scaled;
    const tl_soup *expected;
    bool mirrored;
} pair;

static void check_nearest(const pair *p, tl_vec3 at, float reach, const tl_ray_filter *filter, regimes *r)
{
    tl_soup_point expected, found;
    tl_result result = tl_soup_nearest(p->expected, at, reach, filter, &expected);
    TEST_RESULT(tl_scaled_soup_nearest(&p->scaled, at, reach, filter, &found), result);
    expected.feature = feature_in_view(expected.feature, p->mirrored && result == TL_OK);
    TEST_CHECK(memcmp(&found, &expected, sizeof found) == 0);
    r->near_points += result == TL_OK;
    r->backs += result == TL_OK && found.back;
    r->fronts += result == TL_OK && !found.back;
}

static int by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

static void check_overlaps(const pair *p, const tl_convex *shape, tl_transform pose, const tl_ray_filter *filter,
                           regimes *r)
{
    static uint32_t expected[4000], found[4000];
    uint32_t n, m;
    TEST_RESULT(tl_soup_find_overlaps(p->expected, shape, pose, filter, expected, 4000, &n), TL_OK);
    TEST_RESULT(tl_scaled_soup_find_overlaps(&p->scaled, shape, pose, filter, found, 4000, &m), TL_OK);
    qsort(expected, n, sizeof *expected, by_number);
    qsort(found, m, sizeof *found, by_number);
    TEST_CHECK(n == m && memcmp(expected, found, n * sizeof *found) == 0);
    bool any;
    TEST_RESULT(tl_scaled_soup_overlaps(&p->scaled, shape, pose, filter, &any), TL_OK);
    TEST_CHECK(any == (n > 0));
    r->overlaps += n > 0;
}

static void check_cast(const pair *p, const tl_convex *shape, tl_transform pose, tl_vec3 motion,
                       const tl_ray_filter *filter, regimes *r)
{
    tl_shape_hit expected, found;
    tl_result result = tl_soup_cast_shape(p->expected, shape, pose, motion, filter, &expected);
    TEST_RESULT(tl_scaled_soup_cast_shape(&p->scaled, shape, pose, motion, filter, &found), result);
    TEST_CHECK(memcmp(&found, &expected, sizeof found) == 0);
    r->hits += result == TL_OK;
    r->deep += found.initial_overlap;
}

static void check_scale(const model *m, model_storage storage, tl_vec3 scale, uint64_t seed, regimes *r)
{
    tl_soup_def def = model_soup_def(storage), plain = model_soup_def(MODEL_BOXES);
    model larger = model_scaled(m, scale);
    tl_soup *soup = model_soup(m, &def), *expected = model_soup(&larger, &plain);
    const pair p = { { soup, scale }, expected, tl_scale_is_mirrored(scale) };
    tl_aabb box = tl_soup_bounds(expected);
    tl_vec3 size = tl_aabb_size(box);
    float length = tl_length(size), thin = tl_minf(size.x, tl_minf(size.y, size.z));
    thin = 0.1f * tl_maxf(thin, 0.02f * length);
    const tl_convex shapes[5] = { tl_convex_sphere(vec(0, 0, 0), 0.2f * thin),
                                  tl_convex_capsule(vec(0, -thin, 0), vec(0, thin, 0), 0.1f * thin),
                                  tl_convex_box(vec(0, 0, 0), vec(thin, 0.3f * thin, 0.2f * thin), 0),
                                  tl_convex_box(vec(0, 0, 0), vec(thin, 0.3f * thin, 0.2f * thin), 0.1f * thin),
                                  tl_convex_cylinder(vec(0, 0, 0), vec(0, thin, 0), 0.3f * thin, 0) };
    test_random random = { seed };
    for (uint32_t k = 0; k < query_count; k++) {
        tl_vec3 room = tl_scale(size, 0.2f);
        tl_vec3 at = test_random_point(&random, tl_sub(box.min, room), tl_add(box.max, room));
        tl_ray_filter filter = { 0 };
        filter.cull = k % 3 == 0 ? TL_RAY_CULL_NONE : k % 3 == 1 ? TL_RAY_CULL_BACK : TL_RAY_CULL_FRONT;
        tl_quat turn = { test_random_range(&random, -1, 1), test_random_range(&random, -1, 1),
                         test_random_range(&random, -1, 1), test_random_range(&random, -1, 1) };
        tl_transform pose = { turn, at };
        const tl_convex *shape = &shapes[k % 5];
        check_nearest(&p, at, k % 4 == 0 ? 0.1f * length : INFINITY, &filter, r);
        check_overlaps(&p, shape, pose, &filter, r);
        check_cast(&p, shape, pose, tl_scale(test_random_direction(&random), 0.5f * length), &filter, r);
    }
    tl_blob_free(soup);
    tl_blob_free(expected);
    model_free(&larger);
}

static void test_against_scaled_corners(void **state)
{
    (void)state;
    const tl_vec3 scales[11] = {
        { 2, 2, 2 },          { 1.3f, 1.3f, 1.3f },    { 1, 2.7f, 0.4f }, { -1, 1, 1 },
        { -1.1f, -1, -0.9f }, { -2, -2, 1 },           { 100, 1, 0.01f }, { 1e-6f, 1e-6f, 1e-6f },
        { 1e6f, 1e6f, 1e6f }, { 3e-5f, -0.3f, 0.07f }, { 1e6f, 1, 1e-6f }
    };
    model models[4] = { model_ball(2, 3, 0.2f, vec(1, 0, 0), 1), model_random(250, 4, 2, 2),
                        model_terrain(14, 1.5f, vec(-7, 0, 30), 3), model_random(60, 1, 0.9f, 4) };
    model_repeat_triangles(&models[3]);
    regimes r = { 0 };
    for (uint32_t i = 0; i < 4; i++) {
        for (uint32_t storage = 0; storage < MODEL_STORAGES; storage++) {
            for (uint32_t k = 0; k < 11; k++) {
                check_scale(&models[i], (model_storage)storage, scales[k], 100 * i + k, &r);
            }
        }
        model_free(&models[i]);
    }
    print_message("nearest %u (fronts %u, backs %u), overlaps %u, hits %u (deep %u)\n", r.near_points, r.fronts,
                  r.backs, r.overlaps, r.hits, r.deep);
    TEST_CHECK(r.near_points > 100 * query_count && r.fronts > 40 * query_count && r.backs > 40 * query_count);
    TEST_CHECK(r.overlaps > 20 * query_count && r.hits - r.deep > 30 * query_count && r.deep > 10 * query_count);
}

// A scale of 1, written either way, is none.
static void test_no_scale(void **state)
{
    (void)state;
    model m = model_ball(1, 1, 0, vec(0, 0, 0), 1);
    tl_soup *soup = model_soup(&m, NULL);
    const tl_vec3 same[2] = { { 0, 0, 0 }, { 1, 1, 1 } };
    for (uint32_t i = 0; i < 2; i++) {
        const tl_scaled_soup scaled = { soup, same[i] };
        tl_soup_point expected, found;
        TEST_RESULT(tl_soup_nearest(soup, vec(3, 1, 2), 9, NULL, &expected), TL_OK);
        TEST_RESULT(tl_scaled_soup_nearest(&scaled, vec(3, 1, 2), 9, NULL, &found), TL_OK);
        TEST_CHECK(memcmp(&found, &expected, sizeof found) == 0);
    }
    tl_blob_free(soup);
    model_free(&m);
}

static void check_refused(const tl_soup *soup, tl_vec3 scale, tl_result why)
{
    const tl_scaled_soup scaled = { soup, scale };
    const tl_convex ball = tl_convex_sphere(vec(0, 0, 0), 1);
    tl_transform here = tl_transform_identity();
    tl_soup_point point;
    tl_shape_hit hit;
    bool any = true;
    uint32_t count = 7;
    TEST_RESULT(tl_scaled_soup_nearest(&scaled, vec(0, 0, 0), 1, NULL, &point), why);
    TEST_RESULT(tl_scaled_soup_cast_shape(&scaled, &ball, here, vec(0, 1, 0), NULL, &hit), why);
    TEST_RESULT(tl_scaled_soup_overlaps(&scaled, &ball, here, NULL, &any), why);
    TEST_RESULT(tl_scaled_soup_find_overlaps(&scaled, &ball, here, NULL, NULL, 0, &count), why);
    TEST_CHECK(point.distance == 0 && hit.t == 0 && !any && count == 0);
}

static void test_refused(void **state)
{
    (void)state;
    model m = model_ball(1, 1, 0, vec(0, 0, 0), 1);
    tl_soup *soup = model_soup(&m, NULL);
    check_refused(soup, vec(0, 1, 1), TL_ERR_RANGE);
    check_refused(soup, vec(1, 1, -0.0f), TL_ERR_RANGE);
    check_refused(soup, vec(1, 1.1e6f, 1), TL_ERR_RANGE);
    check_refused(soup, vec(-0.9e-6f, 1, 1), TL_ERR_RANGE);
    check_refused(soup, vec(1, 1e-42f, 1), TL_ERR_RANGE);
    check_refused(soup, vec(NAN, 1, 1), TL_ERR_NOT_FINITE);
    check_refused(soup, vec(1, 1, -INFINITY), TL_ERR_NOT_FINITE);
    check_refused(NULL, vec(1, 1, 1), TL_ERR_ARGUMENT);
    tl_blob_free(soup);
    model_free(&m);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        query_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_scaled_corners),
        cmocka_unit_test(test_no_scale),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
