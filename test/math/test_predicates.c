// SPDX-License-Identifier: MIT
//
// The predicates against GMP integers: every finite float times 2^149 is an integer.

#include "talus_test.h"

#include "math/predicates.h"

#include <gmp.h>
#include <math.h>
#include <string.h>

typedef struct oracle {
    mpz_t u[3], v[3], w[3], t, s, sum;
} oracle;

static oracle gmp;

static int setup(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        mpz_inits(gmp.u[i], gmp.v[i], gmp.w[i], NULL);
    }
    mpz_inits(gmp.t, gmp.s, gmp.sum, NULL);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        mpz_clears(gmp.u[i], gmp.v[i], gmp.w[i], NULL);
    }
    mpz_clears(gmp.t, gmp.s, gmp.sum, NULL);
    return 0;
}

static void set_difference(mpz_t out, float a, float b)
{
    mpz_set_d(out, ldexp((double)a, 149));
    mpz_set_d(gmp.t, ldexp((double)b, 149));
    mpz_sub(out, out, gmp.t);
}

static void set_row(mpz_t row[3], tl_vec3 a, tl_vec3 b)
{
    set_difference(row[0], a.x, b.x);
    set_difference(row[1], a.y, b.y);
    set_difference(row[2], a.z, b.z);
}

static int oracle_determinant(void)
{
    mpz_set_ui(gmp.sum, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_mul(gmp.s, gmp.u[j], gmp.v[k]);
        mpz_submul(gmp.s, gmp.u[k], gmp.v[j]);
        mpz_addmul(gmp.sum, gmp.s, gmp.w[i]);
    }
    return mpz_sgn(gmp.sum);
}

static int oracle_orient3d(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
{
    set_row(gmp.u, b, a);
    set_row(gmp.v, c, a);
    set_row(gmp.w, d, a);
    return oracle_determinant();
}

static int oracle_line_side(tl_vec3 origin, tl_vec3 direction, tl_vec3 a, tl_vec3 b)
{
    set_row(gmp.u, direction, tl_vec3_make(0, 0, 0));
    set_row(gmp.v, a, origin);
    set_row(gmp.w, b, origin);
    return oracle_determinant();
}

static int oracle_compare_along(tl_vec3 direction, tl_vec3 p, tl_vec3 q)
{
    set_row(gmp.u, direction, tl_vec3_make(0, 0, 0));
    set_row(gmp.v, p, q);
    mpz_mul(gmp.sum, gmp.u[0], gmp.v[0]);
    mpz_addmul(gmp.sum, gmp.u[1], gmp.v[1]);
    mpz_addmul(gmp.sum, gmp.u[2], gmp.v[2]);
    return mpz_sgn(gmp.sum);
}

static int oracle_orient2d(const float p[6])
{
    set_difference(gmp.u[0], p[2], p[0]);
    set_difference(gmp.u[1], p[3], p[1]);
    set_difference(gmp.v[0], p[4], p[0]);
    set_difference(gmp.v[1], p[5], p[1]);
    mpz_mul(gmp.s, gmp.u[0], gmp.v[1]);
    mpz_submul(gmp.s, gmp.u[1], gmp.v[0]);
    return mpz_sgn(gmp.s);
}

// Any finite float: all exponents are as likely, denormals included.
static float any_float(test_random *random)
{
    for (;;) {
        uint32_t bits = (uint32_t)test_random_u64(random);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) {
            return value;
        }
    }
}

static tl_vec3 any_point(test_random *random)
{
    float x = any_float(random);
    float y = any_float(random);
    return tl_vec3_make(x, y, any_float(random));
}

// A small step in units of the last place.
static float nudge(test_random *random, float value)
{
    uint32_t steps = test_random_below(random, 3);
    for (uint32_t i = 0; i < steps; i++) {
        value = nextafterf(value, test_random_below(random, 2) ? INFINITY : -INFINITY);
    }
    return isfinite(value) ? value : 1.0f;
}

static tl_vec3 nudge_point(test_random *random, tl_vec3 p)
{
    float x = nudge(random, p.x);
    float y = nudge(random, p.y);
    return tl_vec3_make(x, y, nudge(random, p.z));
}

enum { REGIME_GENERAL, REGIME_PLANE, REGIME_LATTICE, REGIME_WILD, REGIME_TINY, REGIME_HUGE, REGIME_FAR, REGIME_COUNT };

// Four points of a regime; in most of them d nearly lies in the plane of a, b, c.
static void make_points(test_random *random, int regime, tl_vec3 p[4])
{
    float scale = 1.0f;
    tl_vec3 offset = tl_vec3_make(0, 0, 0);
    switch (regime) {
    case REGIME_LATTICE:
        for (int i = 0; i < 4; i++) {
            p[i] = tl_vec3_make((float)test_random_below(random, 5), (float)test_random_below(random, 5),
                                (float)test_random_below(random, 3));
        }
        return;
    case REGIME_WILD:
        for (int i = 0; i < 4; i++) {
            p[i] = any_point(random);
        }
        if (test_random_below(random, 2)) {
            p[3] = nudge_point(random, p[test_random_below(random, 3)]);
        }
        return;
    case REGIME_TINY:
        scale = 1e-43f;
        break;
    case REGIME_HUGE:
        scale = 1e38f;
        break;
    case REGIME_FAR:
        offset = tl_vec3_make(1e6f, -3e6f, 7e5f);
        break;
    default:
        break;
    }
    for (int i = 0; i < 3; i++) {
        p[i] =
            tl_add(tl_scale(test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1)), scale), offset);
    }
    if (regime == REGIME_GENERAL) {
        p[3] = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
        return;
    }
    float s = test_random_unit(random);
    float t = (1.0f - s) * test_random_unit(random);
    tl_vec3 sum = tl_add(tl_scale(p[0], 1.0f - s - t), tl_add(tl_scale(p[1], s), tl_scale(p[2], t)));
    p[3] = nudge_point(random, sum);
}

static void test_orient3d_and_line_side_match_gmp(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t zero[REGIME_COUNT] = { 0 }, filtered_wrong = 0;
    for (uint32_t i = 0; i < 700000; i++) {
        int regime = (int)(i % REGIME_COUNT);
        tl_vec3 p[4];
        make_points(&random, regime, p);
        int expected = oracle_orient3d(p[0], p[1], p[2], p[3]);
        TEST_CHECK(tl_orient3d(p[0], p[1], p[2], p[3]) == expected);
        TEST_CHECK(tl_orient3d(p[1], p[0], p[2], p[3]) == -expected);
        TEST_CHECK(tl_orient3d(p[3], p[1], p[2], p[0]) == -expected);
        zero[regime] += expected == 0;
        tl_vec3 n = tl_cross(tl_sub(p[1], p[0]), tl_sub(p[2], p[0]));
        float naive = tl_dot(n, tl_sub(p[3], p[0]));
        filtered_wrong += ((naive > 0.0f) - (naive < 0.0f)) != expected;
        if (i % 2 == 0) {
            int side = oracle_line_side(p[0], p[1], p[2], p[3]);
            TEST_CHECK(tl_line_side(p[0], p[1], p[2], p[3]) == side);
            TEST_CHECK(tl_line_side(p[0], p[1], p[3], p[2]) == -side);
        }
    }
    // The hard cases were really there: exact zeros in the flat regimes, and many where plain floats are wrong.
    TEST_CHECK(zero[REGIME_GENERAL] == 0);
    TEST_CHECK(zero[REGIME_LATTICE] > 10000);
    TEST_CHECK(zero[REGIME_TINY] > 100);
    TEST_CHECK(filtered_wrong > 100000);
}

static void test_orient2d_matches_gmp(void **state)
{
    (void)state;
    test_random random = { 2 };
    uint32_t zero = 0, signs[3] = { 0 };
    for (uint32_t i = 0; i < 400000; i++) {
        float p[6];
        if (i % 3 == 0) {
            for (int k = 0; k < 6; k++) {
                p[k] = any_float(&random);
            }
        } else {
            for (int k = 0; k < 4; k++) {
                p[k] = test_random_range(&random, -1.0f, 1.0f);
            }
            float t = test_random_unit(&random);
            p[4] = nudge(&random, p[0] + (p[2] - p[0]) * t);
            p[5] = nudge(&random, p[1] + (p[3] - p[1]) * t);
        }
        if (i % 3 == 2) {
            for (int k = 0; k < 6; k++) {
                p[k] = rintf(p[k] * 4.0f);
            }
        }
        int expected = oracle_orient2d(p);
        TEST_CHECK(tl_orient2d(p[0], p[1], p[2], p[3], p[4], p[5]) == expected);
        TEST_CHECK(tl_orient2d(p[2], p[3], p[0], p[1], p[4], p[5]) == -expected);
        zero += expected == 0;
        signs[expected + 1]++;
        // The oracle's s holds the area times 2^298.
        double area = tl_area2d(p[0], p[1], p[2], p[3], p[4], p[5]), exact = ldexp(mpz_get_d(gmp.s), -298);
        TEST_CHECK(fabs(area - exact) <= fabs(exact) * 0x1p-45);
    }
    TEST_CHECK(zero > 10000 && signs[0] > 10000 && signs[2] > 10000);
}

static void test_compare_along_matches_gmp(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t zero = 0, near = 0;
    for (uint32_t i = 0; i < 300000; i++) {
        tl_vec3 d, p, q;
        if (i % 3 == 0) {
            d = any_point(&random);
            p = any_point(&random);
            q = nudge_point(&random, p);
        } else {
            // p - q nearly perpendicular to the direction.
            d = test_random_direction(&random);
            p = test_random_point(&random, tl_vec3_make(-9, -9, -9), tl_vec3_make(9, 9, 9));
            q = tl_add(p, tl_cross(d, test_random_direction(&random)));
            if (i % 3 == 2) {
                d = tl_vec3_make(rintf(d.x * 2), rintf(d.y * 2), rintf(d.z * 2));
                p = tl_vec3_make(rintf(p.x), rintf(p.y), rintf(p.z));
                q = tl_vec3_make(rintf(q.x), rintf(q.y), rintf(q.z));
            }
            near++;
        }
        int expected = oracle_compare_along(d, p, q);
        TEST_CHECK(tl_compare_along(d, p, q) == expected);
        TEST_CHECK(tl_compare_along(d, q, p) == -expected);
        zero += expected == 0;
    }
    TEST_CHECK(zero > 10000 && near > 100000);
}

static void test_extreme_values(void **state)
{
    (void)state;
    float big = 3.4028235e38f, small = 1.4e-45f;
    tl_vec3 a = tl_vec3_make(-big, -big, -big), b = tl_vec3_make(big, -big, -big), c = tl_vec3_make(-big, big, -big);
    TEST_CHECK(tl_orient3d(a, b, c, tl_vec3_make(0, 0, nextafterf(-big, 0))) == 1);
    TEST_CHECK(tl_orient3d(a, b, c, tl_vec3_make(big, big, -big)) == 0);
    tl_vec3 o = tl_vec3_make(0, 0, 0);
    tl_vec3 x = tl_vec3_make(small, 0, 0), y = tl_vec3_make(0, small, 0), z = tl_vec3_make(0, 0, small);
    TEST_CHECK(tl_orient3d(o, x, y, z) == 1);
    TEST_CHECK(tl_orient3d(o, x, y, tl_vec3_make(big, big, small)) == 1);
    TEST_CHECK(tl_orient3d(o, x, y, tl_vec3_make(big, big, -small)) == -1);
    TEST_CHECK(tl_orient2d(-big, 0, big, 0, 0, small) == 1);
    TEST_CHECK(tl_orient2d(-big, 0, big, 0, 0, -0.0f) == 0);
    TEST_CHECK(tl_line_side(o, z, x, y) == 1);
    TEST_CHECK(tl_compare_along(tl_vec3_make(big, small, 0), tl_vec3_make(1, big, 0), tl_vec3_make(1, -big, 5)) == 1);
    TEST_CHECK(tl_is_collinear(o, x, tl_vec3_make(big, 0, 0)));
    TEST_CHECK(!tl_is_collinear(o, x, tl_vec3_make(big, 0, small)));
    TEST_CHECK(tl_is_collinear(a, a, c));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_orient3d_and_line_side_match_gmp),
        cmocka_unit_test(test_orient2d_matches_gmp),
        cmocka_unit_test(test_compare_along_matches_gmp),
        cmocka_unit_test(test_extreme_values),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
