// SPDX-License-Identifier: MIT
//
// ray_decide.c against rational arithmetic (GMP): hit or miss without a difference, t within the promised bound, in the
// regimes where rounding decides: aimed at edges and corners, grazing, needles, far origins, denormals, huge numbers.

#include "soup_models.h"

#include <float.h>
#include <gmp.h>

typedef struct qvec {
    mpq_t v[3];
} qvec;

enum { QVECS = 12, QNUMBERS = 8 };

// All rationals of the test, initialized once.
static struct {
    qvec vec[QVECS];
    mpq_t number[QNUMBERS];
} q;

static void q_init(void)
{
    for (int i = 0; i < QVECS; i++) {
        for (int k = 0; k < 3; k++) {
            mpq_init(q.vec[i].v[k]);
        }
    }
    for (int i = 0; i < QNUMBERS; i++) {
        mpq_init(q.number[i]);
    }
}

static void q_clear(void)
{
    for (int i = 0; i < QVECS; i++) {
        for (int k = 0; k < 3; k++) {
            mpq_clear(q.vec[i].v[k]);
        }
    }
    for (int i = 0; i < QNUMBERS; i++) {
        mpq_clear(q.number[i]);
    }
}

static void q_set(qvec *r, tl_vec3 v)
{
    mpq_set_d(r->v[0], (double)v.x);
    mpq_set_d(r->v[1], (double)v.y);
    mpq_set_d(r->v[2], (double)v.z);
}

static void q_sub(qvec *r, const qvec *a, const qvec *b)
{
    for (int k = 0; k < 3; k++) {
        mpq_sub(r->v[k], a->v[k], b->v[k]);
    }
}

static void q_cross(qvec *r, const qvec *a, const qvec *b)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mpq_mul(q.number[6], a->v[i], b->v[j]);
        mpq_mul(q.number[7], a->v[j], b->v[i]);
        mpq_sub(r->v[k], q.number[6], q.number[7]);
    }
}

static void q_dot(mpq_t r, const qvec *a, const qvec *b)
{
    mpq_mul(q.number[6], a->v[0], b->v[0]);
    for (int k = 1; k < 3; k++) {
        mpq_mul(q.number[7], a->v[k], b->v[k]);
        mpq_add(q.number[6], q.number[6], q.number[7]);
    }
    mpq_set(r, q.number[6]);
}

typedef struct exact_answer {
    bool hit;
    int zeros; // edges that the line meets exactly
    bool coplanar;
    double t; // rounded to double
} exact_answer;

// The definition of soup.h, in rationals. `target` is a direction, or an end when is_segment.
static exact_answer exact_hit(tl_vec3 origin, tl_vec3 target, bool is_segment, const tl_vec3 corner[3])
{
    exact_answer answer = { false, 0, false, 0 };
    qvec *o = &q.vec[0], *d = &q.vec[1], *v = &q.vec[2], *w = &q.vec[5], *n = &q.vec[8], *tmp = &q.vec[9];
    q_set(o, origin);
    q_set(d, target);
    if (is_segment) {
        q_sub(d, d, o);
    }
    for (int k = 0; k < 3; k++) {
        q_set(&v[k], corner[k]);
        q_sub(&w[k], &v[k], o);
    }
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        q_cross(tmp, &w[(k + 1) % 3], &w[(k + 2) % 3]);
        q_dot(q.number[0], d, tmp);
        int sign = mpq_sgn(q.number[0]);
        answer.zeros += sign == 0;
        positive += sign > 0;
        negative += sign < 0;
    }
    answer.coplanar = answer.zeros == 3;
    if (answer.coplanar || (positive && negative)) {
        return answer;
    }
    q_sub(&q.vec[9], &v[1], &v[0]);
    q_sub(&q.vec[10], &v[2], &v[0]);
    q_cross(n, &q.vec[9], &q.vec[10]);
    q_dot(q.number[1], n, &w[0]);
    q_dot(q.number[2], n, d);
    mpq_div(q.number[3], q.number[1], q.number[2]);
    answer.t = mpq_get_d(q.number[3]);
    answer.hit = mpq_sgn(q.number[3]) >= 0 && (!is_segment || mpq_cmp_ui(q.number[3], 1, 1) <= 0);
    return answer;
}

typedef struct regimes {
    uint32_t hit, miss, on_edge, on_corner, coplanar, behind, beyond, exact_t;
} regimes;

static void compare(tl_vec3 origin, tl_vec3 target, bool is_segment, const tl_vec3 corner[3], regimes *seen)
{
    static const uint32_t indices[3] = { 0, 1, 2 };
    tl_mesh_view view = { corner, 3, indices, 1, NULL };
    tl_soup *soup;
    tl_result result = tl_soup_bake(&view, NULL, &soup, NULL);
    if (result == TL_ERR_DEGENERATE) {
        return;
    }
    TEST_RESULT(result, TL_OK);
    exact_answer truth = exact_hit(origin, target, is_segment, corner);
    tl_ray ray = { origin, target, INFINITY };
    tl_ray_hit hit;
    bool found =
        is_segment ? tl_soup_cast_segment(soup, origin, target, NULL, &hit) : tl_soup_cast_ray(soup, &ray, NULL, &hit);
    if (found != truth.hit) {
        fail_msg("%s o %a %a %a d %a %a %a, corners %a %a %a, %a %a %a, %a %a %a: %d, exactly %d, t %g",
                 is_segment ? "segment" : "ray", (double)origin.x, (double)origin.y, (double)origin.z, (double)target.x,
                 (double)target.y, (double)target.z, (double)corner[0].x, (double)corner[0].y, (double)corner[0].z,
                 (double)corner[1].x, (double)corner[1].y, (double)corner[1].z, (double)corner[2].x,
                 (double)corner[2].y, (double)corner[2].z, found, truth.hit, truth.t);
    }
    if (found) {
        double t = truth.t < (double)FLT_MAX ? truth.t : (double)FLT_MAX;
        double ulp = (double)nextafterf((float)t, INFINITY) - (double)(float)t;
        ulp = ulp < 1e38 ? ulp : 2.1e31; // of FLT_MAX
        TEST_CHECK(fabs((double)hit.t - t) <= 0.625 * ulp);
        TEST_CHECK(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1.000001f);
        seen->exact_t += (double)hit.t == (double)(float)t;
    }
    seen->hit += found;
    seen->miss += !found;
    seen->on_edge += truth.zeros == 1;
    seen->on_corner += truth.zeros == 2;
    seen->coplanar += truth.coplanar;
    seen->behind += !truth.hit && truth.t < 0;
    seen->beyond += is_segment && !truth.hit && truth.t > 1;
    tl_blob_free(soup);
}

static tl_vec3 random_vec(test_random *random, float size)
{
    return test_random_point(random, tl_vec3_make(-size, -size, -size), tl_vec3_make(size, size, size));
}

// A float of any exponent from 2^low to 2^high.
static float random_scale(test_random *random, int low, int high)
{
    return ldexpf(1.0f + test_random_unit(random), low + (int)test_random_below(random, (uint32_t)(high - low)));
}

static tl_vec3 lattice_point(test_random *random)
{
    float x = (float)test_random_below(random, 9) - 4.0f;
    float y = (float)test_random_below(random, 9) - 4.0f;
    float z = (float)test_random_below(random, 9) - 4.0f;
    return tl_vec3_make(x, y, z);
}

static void run_regime(uint64_t seed, uint32_t rounds, int low, int high, float spread, regimes *seen)
{
    test_random random = { seed };
    for (uint32_t i = 0; i < rounds; i++) {
        float size = random_scale(&random, low, high);
        tl_vec3 base = random_vec(&random, size * spread);
        tl_vec3 corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = tl_add(base, random_vec(&random, size));
        }
        if (i % 7 == 0) { // a needle
            corner[2] =
                tl_add(tl_lerp(corner[0], corner[1], test_random_unit(&random)), random_vec(&random, size * 1e-6f));
        }
        float u = test_random_range(&random, -0.2f, 1.2f), v = test_random_range(&random, -0.2f, 1.2f);
        if (i % 3 == 0) {
            v = 0; // on an edge, as far as rounding goes
        }
        if (i % 12 == 0) {
            u = (float)test_random_below(&random, 2); // on a corner
        }
        if (i % 10 == 0) { // few bits, so that middles of edges are floats, and now and then all lies in one plane
            float step = ldexpf(1.0f, ilogbf(size) - 4);
            for (int k = 0; k < 3; k++) {
                corner[k] = tl_scale(lattice_point(&random), step);
            }
            base = tl_scale(lattice_point(&random), step);
            u = 0.5f;
            v = 0;
        }
        tl_vec3 at = tl_lerp(tl_lerp(corner[0], corner[1], u), corner[2], v);
        tl_vec3 from = tl_add(base, random_vec(&random, size * (i % 5 == 0 ? 300.0f : 3.0f)));
        if (i % 10 == 0) {
            from = base;
        } else if (i % 11 == 0) { // grazing: from a point near the plane
            from = tl_lerp(tl_lerp(corner[0], corner[1], test_random_range(&random, -9, 9)), corner[2],
                           test_random_range(&random, -9, 9));
        }
        if (i % 13 == 0 && i % 10 != 0) {
            from = at; // on the surface, as far as rounding goes
            at = tl_add(base, random_vec(&random, size));
        }
        tl_vec3 direction = tl_sub(at, from);
        if (i % 17 == 0) {
            direction = tl_scale(direction, random_scale(&random, -20, 20));
        }
        if (i % 19 == 0) {
            direction.x = 0;
            from.x = at.x;
        }
        if (tl_length(tl_abs(direction)) == 0 && direction.x == 0 && direction.y == 0 && direction.z == 0) {
            continue;
        }
        compare(from, direction, false, corner, seen);
        compare(from, at, true, corner, seen);
        compare(at, from, true, corner, seen);
        compare(from, tl_lerp(from, at, 0.9f), true, corner, seen);
    }
}

static void check_regimes(const regimes *seen, uint32_t at_least)
{
    print_message("hits %u, misses %u, on an edge %u, on a corner %u, in plane %u, behind %u, beyond %u, t exact %u\n",
                  seen->hit, seen->miss, seen->on_edge, seen->on_corner, seen->coplanar, seen->behind, seen->beyond,
                  seen->exact_t);
    TEST_CHECK(seen->hit > 10 * at_least && seen->miss > 10 * at_least && seen->behind > at_least);
    TEST_CHECK(seen->on_edge > at_least && seen->on_corner > at_least && seen->beyond > at_least);
    TEST_CHECK(seen->coplanar > at_least / 10);
    // t is rounded correctly all but always.
    TEST_CHECK(seen->exact_t > seen->hit / 100 * 99);
}

static void test_ordinary_sizes(void **state)
{
    (void)state;
    regimes seen = { 0 };
    run_regime(1, 12000, -8, 8, 1.0f, &seen);
    check_regimes(&seen, 300);
}

static void test_far_from_the_origin(void **state)
{
    (void)state;
    regimes seen = { 0 };
    run_regime(2, 8000, -3, 8, 5000.0f, &seen);
    check_regimes(&seen, 200);
}

static void test_tiny_and_denormal(void **state)
{
    (void)state;
    regimes seen = { 0 };
    run_regime(3, 4000, -40, -20, 2.0f, &seen);
    check_regimes(&seen, 100);
    regimes denormal = { 0 };
    run_regime(4, 4000, -145, -100, 2.0f, &denormal);
    TEST_CHECK(denormal.hit > 1000 && denormal.miss > 1000 && denormal.on_edge > 20);
}

static void test_huge(void **state)
{
    (void)state;
    regimes seen = { 0 };
    run_regime(5, 4000, 10, 36, 3.0f, &seen);
    check_regimes(&seen, 100);
}

// Corners whose coordinates differ by many powers of two: differences are not exact in double.
static void test_mixed_exponents(void **state)
{
    (void)state;
    test_random random = { 6 };
    regimes seen = { 0 };
    for (uint32_t i = 0; i < 8000; i++) {
        tl_vec3 point[5];
        for (int k = 0; k < 5; k++) {
            float c[3];
            for (int axis = 0; axis < 3; axis++) {
                c[axis] =
                    random_scale(&random, i % 2 ? -60 : -140, 38) * (test_random_below(&random, 2) ? 1.0f : -1.0f);
                c[axis] = test_random_below(&random, 6) == 0 ? 0.0f : c[axis];
            }
            point[k] = tl_vec3_make(c[0], c[1], c[2]);
        }
        tl_vec3 direction = i % 3 ? tl_sub(tl_lerp(point[0], point[1], test_random_unit(&random)), point[3]) : point[4];
        if (direction.x != 0 || direction.y != 0 || direction.z != 0) {
            compare(point[3], direction, false, point, &seen);
        }
        compare(point[3], i % 2 ? tl_lerp(point[1], point[2], 0.5f) : point[4], true, point, &seen);
    }
    TEST_CHECK(seen.hit > 100 && seen.miss > 1000);
}

int main(void)
{
    q_init();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ordinary_sizes),    cmocka_unit_test(test_far_from_the_origin),
        cmocka_unit_test(test_tiny_and_denormal), cmocka_unit_test(test_huge),
        cmocka_unit_test(test_mixed_exponents),
    };
    int failures = cmocka_run_group_tests(tests, NULL, NULL);
    q_clear();
    return failures;
}
