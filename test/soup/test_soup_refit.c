// SPDX-License-Identifier: MIT
//
// soup_refit.c: a moved soup answers like one that is baked anew, and what cannot be moved is refused whole.

#include "soup_models.h"

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

// A wave through everything: neighbours stay neighbours.
static void move_all(model *m, float phase, float height)
{
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        tl_vec3 *p = &m->vertices[v];
        p->y += height * sinf(0.7f * p->x + phase);
        p->x += 0.3f * height * sinf(0.4f * p->z + 2 * phase);
        p->z -= phase;
    }
}

static uint32_t compare(const tl_soup *moved, const tl_soup *built, uint64_t seed)
{
    test_random random = { seed };
    tl_aabb a = tl_soup_bounds(moved), b = tl_soup_bounds(built);
    TEST_CHECK(memcmp(&a, &b, sizeof a) == 0);
    uint32_t hits = 0;
    for (uint32_t i = 0; i < 3000; i++) {
        tl_ray ray = { test_random_point(&random, a.min, a.max), test_random_direction(&random), INFINITY };
        tl_ray_hit h, g;
        bool hit = tl_soup_cast_ray(moved, &ray, NULL, &h);
        TEST_CHECK(hit == tl_soup_cast_ray(built, &ray, NULL, &g));
        TEST_CHECK(!hit || (h.t == g.t && h.triangle == g.triangle && h.u == g.u && h.v == g.v));
        hits += hit;
        if (i % 4 == 0) {
            tl_soup_point p, q;
            TEST_RESULT(tl_soup_nearest(moved, ray.origin, INFINITY, NULL, &p), TL_OK);
            TEST_RESULT(tl_soup_nearest(built, ray.origin, INFINITY, NULL, &q), TL_OK);
            TEST_CHECK(p.triangle == q.triangle && p.distance == q.distance);
        }
    }
    return hits;
}

static void check_model(model m, model_storage storage, uint32_t *hits)
{
    tl_soup_def def = model_soup_def(storage);
    tl_soup *moved = model_soup(&m, &def);
    for (uint32_t step = 0; step < 3; step++) {
        move_all(&m, 0.5f * (float)step + 0.1f, 0.4f);
        tl_mesh_view view = model_view(&m);
        TEST_RESULT(tl_soup_refit(moved, &view, NULL), TL_OK);
        TEST_RESULT(tl_soup_check(moved, tl_soup_size(moved), NULL), TL_OK);
        tl_soup *built = model_soup(&m, &def);
        *hits += compare(moved, built, step);
        tl_blob_free(built);
    }
    tl_blob_free(moved);
    model_free(&m);
}

static void test_like_built_anew(void **state)
{
    (void)state;
    uint32_t hits = 0;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_COMPACT; storage++) {
        check_model(model_random(301, 5, 2, 2), storage, &hits);
        check_model(model_terrain(16, 2, vec(0, 0, 0), 3), storage, &hits);
        check_model(model_terrain(16, 2, vec(5000, 100, -5000), 4), storage, &hits);
        check_model(model_ball(4, 3, 0.1f, vec(0, 0, 0), 5), storage, &hits);
    }
    TEST_CHECK(hits > 20000);
}

// To the same place: the same bytes, where splits cut nothing.
static void test_nothing_moved(void **state)
{
    (void)state;
    model m = model_terrain(16, 2, vec(0, 0, 0), 3);
    tl_soup *soup = model_soup(&m, NULL), *built = model_soup(&m, NULL);
    tl_mesh_view view = model_view(&m);
    TEST_RESULT(tl_soup_refit(soup, &view, NULL), TL_OK);
    TEST_CHECK(memcmp(soup, built, (size_t)tl_soup_size(soup)) == 0);
    tl_blob_free(soup);
    tl_blob_free(built);
    model_free(&m);
}

// A triangle that lost its area is there, and no ray hits it.
static void test_collapsed_triangle(void **state)
{
    (void)state;
    model m = { 0 };
    model_vertex(&m, 0, 0, 0);
    model_vertex(&m, 4, 0, 0);
    model_vertex(&m, 0, 0, 4);
    model_triangle(&m, 0, 1, 2);
    tl_soup *soup = model_soup(&m, NULL);
    m.vertices[2] = vec(2, 0, 0);
    tl_mesh_view view = model_view(&m);
    TEST_RESULT(tl_soup_refit(soup, &view, NULL), TL_OK);
    tl_ray ray = { vec(1, 1, 0), vec(0, -1, 0), INFINITY };
    tl_ray_hit hit;
    TEST_CHECK(!tl_soup_cast_ray(soup, &ray, NULL, &hit));
    tl_soup_point nearest;
    TEST_RESULT(tl_soup_nearest(soup, vec(1, 1, 0), INFINITY, NULL, &nearest), TL_OK);
    TEST_CHECK(nearest.distance == 1);
    tl_blob_free(soup);
    model_free(&m);
}

static void check_refused(tl_soup *soup, const tl_soup *before, const tl_mesh_view *view, tl_result result,
                          const char *element, uint64_t index)
{
    tl_report report;
    TEST_RESULT(tl_soup_refit(soup, view, &report), result);
    assert_string_equal(report.element, element);
    TEST_CHECK(report.element_index == index && report.advice != NULL);
    TEST_CHECK(memcmp(soup, before, (size_t)tl_soup_size(soup)) == 0);
}

static void test_refused_whole(void **state)
{
    (void)state;
    // Two triangles over one edge, whose ends are in the view twice.
    model m = { 0 };
    static const float at[6][3] = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 0, 4 }, { 4, 0, 0 }, { 0, 0, 4 }, { 4, 0, 4 } };
    for (uint32_t i = 0; i < 6; i++) {
        model_vertex(&m, at[i][0], at[i][1], at[i][2]);
    }
    model_triangle(&m, 0, 2, 1);
    model_triangle(&m, 3, 4, 5);
    tl_soup *soup = model_soup(&m, NULL), *before = model_soup(&m, NULL);
    TEST_CHECK(tl_soup_get_stats(soup).pair_count == 1);
    tl_mesh_view view = model_view(&m);
    m.vertices[5].y = 1;
    m.vertices[3].y = 1; // and not 1, which was there too
    check_refused(soup, before, &view, TL_ERR_ARGUMENT, "triangle", 0);
    m.vertices[1].y = 1;
    TEST_RESULT(tl_soup_refit(soup, &view, NULL), TL_OK);
    m.vertices[5].y = m.vertices[3].y = m.vertices[1].y = 0;
    TEST_RESULT(tl_soup_refit(soup, &view, NULL), TL_OK);
    m.vertices[4].z = NAN;
    check_refused(soup, before, &view, TL_ERR_NOT_FINITE, "vertex", 4);
    m.vertices[4].z = 2e12f;
    check_refused(soup, before, &view, TL_ERR_RANGE, "vertex", 4);
    m.vertices[4].z = 4;
    m.indices[4] = 6;
    check_refused(soup, before, &view, TL_ERR_INDEX, "triangle", 1);
    m.indices[4] = 4;
    view.triangle_count = 1;
    check_refused(soup, before, &view, TL_ERR_ARGUMENT, "triangle", 1);
    tl_blob_free(soup);
    tl_blob_free(before);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_like_built_anew),
        cmocka_unit_test(test_nothing_moved),
        cmocka_unit_test(test_collapsed_triangle),
        cmocka_unit_test(test_refused_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
