// SPDX-License-Identifier: MIT
//
// soup_nearest.c: by example, and against all triangles. An argument sets the number of queries; 100000 take ten
// seconds.

#include "soup_models.h"

#include "soup/triangle/triangle_point.h"

#include <float.h>

static uint32_t query_count = 20000;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static void check_one(const tl_soup *soup, tl_vec3 at, tl_vec3 point, float distance, tl_triangle_feature feature,
                      bool back)
{
    tl_soup_point found;
    TEST_RESULT(tl_soup_nearest(soup, at, INFINITY, NULL, &found), TL_OK);
    TEST_CHECK(found.point.x == point.x && found.point.y == point.y && found.point.z == point.z);
    TEST_CHECK(found.distance == distance && found.feature == feature && found.back == back && found.triangle == 0);
    TEST_CHECK(found.normal.x == 0 && found.normal.y == -1 && found.normal.z == 0);
    // The reach is closed.
    float reach = distance == floorf(distance) ? distance : nextafterf(distance, INFINITY);
    TEST_RESULT(tl_soup_nearest(soup, at, reach, NULL, &found), TL_OK);
    if (distance > 0) {
        TEST_RESULT(tl_soup_nearest(soup, at, nextafterf(distance, 0), NULL, &found), TL_NOT_FOUND);
    }
}

static void test_examples(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    check_one(soup, vec(1, 3, 1), vec(1, 0, 1), 3, TL_TRIANGLE_FACE, true);
    check_one(soup, vec(1, -3, 1), vec(1, 0, 1), 3, TL_TRIANGLE_FACE, false);
    check_one(soup, vec(1, 0, 1), vec(1, 0, 1), 0, TL_TRIANGLE_FACE, false);
    check_one(soup, vec(2, 0, -2), vec(2, 0, 0), 2, TL_TRIANGLE_EDGE_0, false);
    check_one(soup, vec(3, 0, 3), vec(2, 0, 2), 1.41421356f, TL_TRIANGLE_EDGE_1, false);
    check_one(soup, vec(-2, 0, 2), vec(0, 0, 2), 2, TL_TRIANGLE_EDGE_2, false);
    check_one(soup, vec(-3, 4, 0), vec(0, 0, 0), 5, TL_TRIANGLE_CORNER_0, true);
    check_one(soup, vec(7, -4, 0), vec(4, 0, 0), 5, TL_TRIANGLE_CORNER_1, false);
    check_one(soup, vec(0, 4, 7), vec(0, 0, 4), 5, TL_TRIANGLE_CORNER_2, true);
    tl_soup_point found;
    TEST_RESULT(tl_soup_nearest(soup, vec(NAN, 0, 0), 1, NULL, &found), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_soup_nearest(soup, vec(0, INFINITY, 0), 1, NULL, &found), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_soup_nearest(soup, vec(0, 0, 0), -1, NULL, &found), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_soup_nearest(soup, vec(0, 0, 0), NAN, NULL, &found), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_soup_nearest(soup, vec(3e38f, 3e38f, -3e38f), INFINITY, NULL, &found), TL_OK);
    TEST_CHECK(found.feature == TL_TRIANGLE_CORNER_1);
    tl_blob_free(soup);
    model_free(&m);
}

static bool reject_odd(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    (void)user;
    return triangle % 2 == 0;
}

// The first triangle that is nearest, from all; UINT32_MAX when none is within reach.
static uint32_t brute_force(const model *m, const uint16_t *materials, tl_vec3 at, float reach,
                            const tl_ray_filter *filter, tl_triangle_point *best)
{
    uint32_t nearest = UINT32_MAX;
    best->distance_sq = (double)reach * (double)reach;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *corner = m->indices + 3 * (size_t)i;
        tl_vec3 c[3] = { m->vertices[corner[0]], m->vertices[corner[1]], m->vertices[corner[2]] };
        tl_vec3d a = tl_vec3d_from(c[0]);
        tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(tl_vec3d_from(c[1]), a), tl_vec3d_sub(tl_vec3d_from(c[2]), a));
        if (n.x == 0 && n.y == 0 && n.z == 0) {
            continue; // as the bake does
        }
        if (filter != NULL) {
            double height = tl_vec3d_dot(n, tl_vec3d_sub(tl_vec3d_from(at), a));
            if ((filter->cull == TL_RAY_CULL_BACK && height < 0) || (filter->cull == TL_RAY_CULL_FRONT && height > 0) ||
                (filter->ignored_materials >> materials[i] & 1) != 0 ||
                (filter->accept != NULL && !filter->accept(i, materials[i], filter->accept_user))) {
                continue;
            }
        }
        tl_triangle_point found;
        tl_triangle_nearest(c, tl_vec3d_from(at), &found);
        if (found.distance_sq < best->distance_sq ||
            (found.distance_sq == best->distance_sq && nearest == UINT32_MAX)) {
            *best = found;
            nearest = i;
        }
    }
    return nearest;
}

typedef struct regimes {
    uint32_t found, none, face, edge, corner, behind, filtered;
} regimes;

static void check_model(model m, model_storage storage, uint32_t count, regimes *r)
{
    test_random random = { m.triangle_count };
    uint16_t *materials = malloc(m.triangle_count * sizeof *materials);
    TEST_CHECK(materials != NULL);
    for (uint32_t i = 0; i < m.triangle_count; i++) {
        materials[i] = (uint16_t)(i % 5);
    }
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    tl_soup_def def = model_soup_def(storage);
    tl_soup *soup = NULL;
    TEST_RESULT(tl_soup_bake(&view, &def, &soup, NULL), TL_OK);
    tl_aabb bounds = tl_soup_bounds(soup);
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.2f);
    float diagonal = tl_length(tl_aabb_size(bounds));
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 at = test_random_point(&random, tl_sub(bounds.min, margin), tl_add(bounds.max, margin));
        if (i % 5 == 0) { // on a corner of the soup, exactly
            at = m.vertices[m.indices[test_random_below(&random, 3 * m.triangle_count)]];
        }
        float reach = i % 3 == 0 ? test_random_unit(&random) * 0.05f * diagonal : INFINITY;
        tl_ray_filter filter = { 0 };
        filter.cull = (tl_ray_cull)test_random_below(&random, 3);
        filter.ignored_materials = ~(test_random_u64(&random) | 1);
        filter.accept = i % 8 == 0 ? reject_odd : NULL;
        // Culling in the oracle is by float, which is right only where sides are clear.
        const tl_ray_filter *used = i % 4 == 0 && i % 5 != 0 ? &filter : NULL;
        tl_triangle_point best;
        uint32_t nearest = brute_force(&m, materials, at, reach, used, &best);
        tl_soup_point found;
        tl_result result = tl_soup_nearest(soup, at, reach, used, &found);
        if (nearest == UINT32_MAX) {
            TEST_RESULT(result, TL_NOT_FOUND);
            r->none++;
            continue;
        }
        TEST_RESULT(result, TL_OK);
        TEST_CHECK(found.triangle == nearest && found.distance == (float)sqrt(best.distance_sq));
        TEST_CHECK(found.feature == best.feature && found.material == materials[nearest]);
        TEST_CHECK(fabs((double)found.point.x - best.point.x) <= (double)FLT_EPSILON * fabs(best.point.x));
        r->found++;
        r->face += found.feature == TL_TRIANGLE_FACE;
        r->edge += found.feature >= TL_TRIANGLE_EDGE_0 && found.feature <= TL_TRIANGLE_EDGE_2;
        r->corner += found.feature >= TL_TRIANGLE_CORNER_0;
        r->behind += found.back;
        r->filtered += used != NULL;
    }
    free(materials);
    tl_blob_free(soup);
    model_free(&m);
}

static void test_against_all_triangles(void **state)
{
    (void)state;
    regimes r = { 0 };
    uint32_t n = query_count / 10;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        check_model(model_terrain(24, 2, vec(0, 0, 0), 1), storage, n, &r);
        check_model(model_terrain(24, 2, vec(5000, 100, -5000), 2), storage, n, &r);
        check_model(model_random(1000, 5, 1, 3), storage, n, &r);
        check_model(model_ball(4, 1, 0.1f, vec(0, 0, 0), 4), storage, n, &r);
        check_model(model_random(500, 1e-15f, 1e-16f, 5), storage, n, &r);
    }
    print_message("found %u, none %u; face %u, edge %u, corner %u; behind %u, filtered %u\n", r.found, r.none, r.face,
                  r.edge, r.corner, r.behind, r.filtered);
    TEST_CHECK(r.none > query_count / 50 && r.face > query_count / 20 && r.edge > query_count / 20);
    TEST_CHECK(r.corner > query_count / 20 && r.behind > query_count / 50 && r.filtered > query_count / 20);
}

static void test_levels(void **state)
{
    (void)state;
    regimes r = { 0 };
    for (uint32_t i = 0; i < sizeof model_levels / sizeof model_levels[0]; i++) {
        model m = model_load(model_levels[i]);
        if (m.triangle_count > 0) {
            check_model(m, MODEL_BOXES, query_count / 50, &r);
        }
        print_message("%s: found %u\n", model_levels[i], r.found);
    }
}

// A needle: its height is a millionth of an ulp of its length. The distance must still be right.
static void test_needles(void **state)
{
    (void)state;
    test_random random = { 5 };
    for (uint32_t i = 0; i < 2000; i++) {
        tl_vec3 a = test_random_point(&random, vec(-1, -1, -1), vec(1, 1, 1));
        tl_vec3 b = test_random_point(&random, vec(-1, -1, -1), vec(1, 1, 1));
        float share = test_random_range(&random, -0.5f, 1.5f);
        tl_vec3 c = tl_add(tl_lerp(a, b, share), tl_scale(test_random_direction(&random), i % 2 ? 1e-7f : 0.0f));
        tl_vec3 p = test_random_point(&random, vec(-2, -2, -2), vec(2, 2, 2));
        tl_vec3 corners[3] = { a, b, c };
        tl_triangle_point found;
        tl_triangle_nearest(corners, tl_vec3d_from(p), &found);
        // Against points all over it.
        double least = (double)INFINITY;
        for (uint32_t k = 0; k <= 400; k++) {
            tl_vec3d points[3] = { tl_vec3d_from(a), tl_vec3d_from(b), tl_vec3d_from(c) };
            for (uint32_t e = 0; e < 3; e++) {
                tl_vec3d edge = tl_vec3d_sub(points[(e + 1) % 3], points[e]);
                tl_vec3d q = tl_vec3d_mul_add(points[e], edge, (double)k / 400.0);
                double distance = tl_vec3d_length(tl_vec3d_sub(q, tl_vec3d_from(p)));
                least = distance < least ? distance : least;
            }
        }
        double distance = sqrt(found.distance_sq);
        TEST_CHECK(distance <= least + 3e-7 && distance >= least - 5e-3);
        // What is reported is where the point is.
        double away = tl_vec3d_length(tl_vec3d_sub(found.point, tl_vec3d_from(p)));
        TEST_CHECK(fabs(away - distance) < 1e-6);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        query_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_against_all_triangles),
        cmocka_unit_test(test_levels),
        cmocka_unit_test(test_needles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
