// SPDX-License-Identifier: MIT
//
// soup_all_hits.c: against all triangles one by one, and parity of lines that are aimed at edges and corners.

#include "soup_models.h"

#include "soup/ray/ray_job.h"

#include <float.h>

enum { MAX_HITS = 512 };

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static uint32_t all_hits(const tl_soup *soup, tl_vec3 origin, tl_vec3 direction, float tmax, tl_hit_rule rule,
                         const tl_ray_filter *filter, tl_ray_hit *hits)
{
    tl_ray ray = { origin, direction, tmax };
    uint32_t count;
    TEST_RESULT(tl_soup_cast_ray_all(soup, &ray, rule, filter, hits, MAX_HITS, &count), TL_OK);
    for (uint32_t i = 1; i < count; i++) {
        TEST_CHECK(hits[i - 1].t < hits[i].t ||
                   (hits[i - 1].t == hits[i].t && hits[i - 1].triangle < hits[i].triangle));
    }
    return count;
}

static bool only_one(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    return triangle == *(uint32_t *)user;
}

static bool same_hit(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return a->t == b->t && a->triangle == b->triangle && a->u == b->u && a->v == b->v && a->back == b->back &&
           a->normal.x == b->normal.x && a->normal.y == b->normal.y && a->normal.z == b->normal.z;
}

// Every triangle queried alone by the closest-hit query.
static void check_against_each(const model *m, const tl_soup *soup, tl_vec3 origin, tl_vec3 direction, float tmax,
                               uint32_t *total)
{
    static tl_ray_hit hits[MAX_HITS];
    uint32_t count = all_hits(soup, origin, direction, tmax, TL_HITS_TOUCHED, NULL, hits);
    uint32_t expected = 0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        tl_ray_filter filter = { 0 };
        filter.accept = only_one;
        filter.accept_user = &i;
        tl_ray ray = { origin, direction, tmax };
        tl_ray_hit hit;
        if (!tl_soup_cast_ray(soup, &ray, &filter, &hit)) {
            continue;
        }
        uint32_t k = 0;
        while (k < count && hits[k].triangle != i) {
            k++;
        }
        TEST_CHECK(k < count && same_hit(&hits[k], &hit));
        expected++;
    }
    TEST_CHECK(count == expected);
    *total += count;
    if (count > 0) {
        tl_ray ray = { origin, direction, tmax };
        tl_ray_hit closest, nearest[2];
        TEST_CHECK(tl_soup_cast_ray(soup, &ray, NULL, &closest) && same_hit(&closest, &hits[0]));
        uint32_t again;
        TEST_RESULT(tl_soup_cast_ray_all(soup, &ray, TL_HITS_TOUCHED, NULL, nearest, 2, &again),
                    count > 2 ? TL_INCOMPLETE : TL_OK);
        TEST_CHECK(again == count && same_hit(&nearest[0], &hits[0]) && (count < 2 || same_hit(&nearest[1], &hits[1])));
        TEST_RESULT(tl_soup_cast_ray_all(soup, &ray, TL_HITS_TOUCHED, NULL, NULL, 0, &again), TL_INCOMPLETE);
        TEST_CHECK(again == count);
    }
}

static void check_model(model m, model_storage storage, uint32_t *total)
{
    test_random random = { m.triangle_count };
    tl_soup_def def = model_soup_def(storage);
    tl_soup *soup = model_soup(&m, &def);
    tl_aabb bounds = tl_soup_bounds(soup);
    for (uint32_t i = 0; i < 150; i++) {
        tl_vec3 origin = test_random_point(&random, bounds.min, bounds.max);
        tl_vec3 direction = test_random_direction(&random);
        if (i % 3 == 0) { // at a corner
            tl_vec3 corner = m.vertices[m.indices[test_random_below(&random, 3 * m.triangle_count)]];
            direction = tl_sub(corner, origin);
        }
        if (i % 5 == 0) {
            direction = i % 10 == 0 ? vec(0, 0, -1) : vec(0, 1, 0);
        }
        float tmax = i % 4 == 0 ? test_random_unit(&random) * tl_length(tl_aabb_size(bounds)) : INFINITY;
        check_against_each(&m, soup, origin, direction, tmax, total);
    }
    tl_blob_free(soup);
    model_free(&m);
}

static void test_against_each_triangle(void **state)
{
    (void)state;
    uint32_t total = 0;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        check_model(model_random(300, 5, 3, 2), storage, &total);
        check_model(model_terrain(12, 2, vec(0, 0, 0), 3), storage, &total);
        check_model(model_terrain(12, 2, vec(5000, 100, -5000), 4), storage, &total);
        check_model(model_ball(3, 1e-3f, 0.2f, vec(0, 0, 0), 5), storage, &total);
        check_model(model_random(100, 1e11f, 1e11f, 6), storage, &total);
    }
    print_message("%u hits\n", total);
    TEST_CHECK(total > 2000);
}

// A cube of n * n squares a side on integer coordinates: lines through it pass edges and corners exactly.
static model grid_cube(int n)
{
    model m = { 0 };
    for (int side = 0; side < 6; side++) {
        int axis = side / 2, up = side % 2;
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) {
                uint32_t v[4];
                for (int k = 0; k < 4; k++) {
                    float p[3];
                    p[axis] = up ? (float)n : 0.0f;
                    p[(axis + 1) % 3] = (float)(i + (k == 1 || k == 2));
                    p[(axis + 2) % 3] = (float)(j + (k >= 2));
                    v[k] = model_vertex(&m, p[0], p[1], p[2]);
                }
                uint32_t a = v[0], b = up ? v[1] : v[3], c = v[2], d = up ? v[3] : v[1];
                if ((i + j) % 2) {
                    model_triangle(&m, a, b, c);
                    model_triangle(&m, a, c, d);
                } else {
                    model_triangle(&m, b, c, d);
                    model_triangle(&m, b, d, a);
                }
            }
        }
    }
    return m;
}

typedef struct parity {
    uint32_t lines, through_edges, touching, crossing, inside, outside;
} parity;

static void check_line(const tl_soup *soup, tl_vec3 origin, tl_vec3 direction, int inside, parity *p)
{
    static tl_ray_hit hits[MAX_HITS];
    uint32_t touched = all_hits(soup, origin, direction, INFINITY, TL_HITS_TOUCHED, NULL, hits);
    uint32_t crossed = all_hits(soup, origin, direction, INFINITY, TL_HITS_CROSSED, NULL, hits);
    TEST_CHECK(crossed <= touched);
    TEST_CHECK(crossed % 2 == (inside ? 1u : 0u));
    // From inside out, from outside in, and so on.
    int depth = inside;
    for (uint32_t i = 0; i < crossed; i++) {
        depth += hits[i].back ? -1 : 1;
    }
    TEST_CHECK(depth == 0);
    p->lines++;
    p->through_edges += touched > crossed;
    p->touching += touched > 0 && crossed == 0;
    p->crossing += crossed > 0;
    *(inside ? &p->inside : &p->outside) += 1;
}

static void test_parity(void **state)
{
    (void)state;
    test_random random = { 12 };
    parity p = { 0 };
    // Whole numbers: every line passes edges and corners.
    model m = grid_cube(4);
    tl_soup *soup = model_soup(&m, NULL);
    for (int i = 0; i < 60000; i++) {
        int o[3], d[3], inside = 1;
        for (int k = 0; k < 3; k++) {
            o[k] = (int)test_random_below(&random, 13) - 4;
            d[k] = (int)test_random_below(&random, 7) - 3;
            inside &= o[k] > 0 && o[k] < 4;
        }
        bool on_surface = !inside && o[0] >= 0 && o[0] <= 4 && o[1] >= 0 && o[1] <= 4 && o[2] >= 0 && o[2] <= 4;
        if ((d[0] == 0 && d[1] == 0 && d[2] == 0) || on_surface) {
            continue;
        }
        check_line(soup, vec((float)o[0], (float)o[1], (float)o[2]), vec((float)d[0], (float)d[1], (float)d[2]), inside,
                   &p);
    }
    tl_blob_free(soup);
    model_free(&m);
    print_message("%u lines: %u through edges or corners, %u only touch, %u cross; from inside %u\n", p.lines,
                  p.through_edges, p.touching, p.crossing, p.inside);
    TEST_CHECK(p.through_edges > 3000 && p.touching > 100 && p.inside > 100 && p.outside > 3000);
}

// A bumpy ball: lines through its corners and edge midpoints, near and far, from outside and from the middle.
static void test_parity_of_ball(void **state)
{
    (void)state;
    test_random random = { 13 };
    for (uint32_t place = 0; place < 3; place++) {
        tl_vec3 center = place == 0 ? vec(0, 0, 0) : place == 1 ? vec(5000, -300, 2500) : vec(1, 2, 3);
        float radius = place == 2 ? 0.1f : 3.0f;
        model m = model_ball(4, radius, 0.05f, center, 3);
        for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
            tl_soup_def def = model_soup_def(storage);
            tl_soup *soup = model_soup(&m, &def);
            parity p = { 0 };
            for (uint32_t i = 0; i < 3 * m.triangle_count; i += 2) {
                tl_vec3 a = m.vertices[m.indices[i]], b = m.vertices[m.indices[i / 3 * 3 + (i + 1) % 3]];
                tl_vec3 target = i % 4 ? a : tl_lerp(a, b, 0.5f);
                float away = i % 8 < 4 ? 2.0f : 50.0f;
                tl_vec3 outside = tl_mul_add(center, test_random_direction(&random), away * radius);
                check_line(soup, outside, tl_sub(target, outside), 0, &p);
                check_line(soup, center, tl_sub(target, center), 1, &p);
            }
            TEST_CHECK(p.through_edges > 500 || place == 1); // far away, differences round off the corners
            tl_blob_free(soup);
        }
        model_free(&m);
    }
}

// Thousands of hits on triangles as large as the level, of which splits store many copies: more than any table of what
// was reported holds.
static void test_long_answers(void **state)
{
    (void)state;
    enum { TRIANGLES = 12000 };
    static tl_ray_hit expected[TRIANGLES], hits[TRIANGLES];
    test_random random = { 41 };
    model m = { 0 };
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        uint32_t corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            tl_vec3 p = test_random_point(&random, vec(-100, -5, -100), vec(100, 5, 100));
            corners[k] = model_vertex(&m, p.x, p.y, p.z);
        }
        model_triangle(&m, corners[0], corners[1], corners[2]);
    }
    tl_ray ray = { { 3, 50, 2 }, { 0.01f, -1, 0.02f }, INFINITY };
    uint32_t count, split = 0;
    tl_result inside = TL_OK;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        tl_soup_def def = model_soup_def(storage);
        tl_soup *soup = model_soup(&m, &def);
        tl_soup_stats stats = tl_soup_get_stats(soup);
        split += stats.reference_count > 2 * TRIANGLES;
        tl_soup_location location;
        const bool is_first = storage == MODEL_BOXES;
        const uint32_t before = is_first ? 0 : count;
        TEST_RESULT(
            tl_soup_cast_ray_all(soup, &ray, TL_HITS_TOUCHED, NULL, is_first ? expected : hits, TRIANGLES, &count),
            TL_OK);
        const tl_result located = tl_soup_locate(soup, vec(3, 0, 2), &location);
        TEST_CHECK(is_first || (count == before && located == inside));
        for (uint32_t i = 0; !is_first && i < count; i++) {
            TEST_CHECK(same_hit(&hits[i], &expected[i]));
        }
        inside = located;
        tl_blob_free(soup);
    }
    TEST_CHECK(count > 2000 && split > 0);
    model_free(&m);
}

static void test_refused_by_name(void **state)
{
    (void)state;
    model m = model_random(10, 1, 1, 1);
    tl_soup *soup = model_soup(&m, NULL);
    uint32_t count;
    const struct {
        tl_ray ray;
        tl_result result;
    } cases[] = { { { { NAN, 0, 0 }, { 0, 1, 0 }, 1 }, TL_ERR_NOT_FINITE },
                  { { { 0, 0, 0 }, { 0, INFINITY, 0 }, 1 }, TL_ERR_NOT_FINITE },
                  { { { 0, 0, 0 }, { 0, 0, 0 }, 1 }, TL_ERR_ARGUMENT },
                  { { { 0, 0, 0 }, { 0, 1, 0 }, -1 }, TL_ERR_ARGUMENT },
                  { { { 0, 0, 0 }, { 0, 1, 0 }, NAN }, TL_ERR_ARGUMENT } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        TEST_RESULT(tl_soup_cast_ray_all(soup, &cases[i].ray, TL_HITS_TOUCHED, NULL, NULL, 0, &count), cases[i].result);
    }
    tl_blob_free(soup);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_each_triangle), cmocka_unit_test(test_parity),
        cmocka_unit_test(test_parity_of_ball),        cmocka_unit_test(test_long_answers),
        cmocka_unit_test(test_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
