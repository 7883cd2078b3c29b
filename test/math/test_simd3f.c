// SPDX-License-Identifier: MIT
//
// Three floats in a register against three by themselves.

#include "math/simd3f.h"

#include "talus_test.h"

#include <math.h>

static float value_of(test_random *random)
{
    const float values[8] = { 0.0f, -0.0f, INFINITY, -INFINITY, 1e-42f, 3.4e38f, -1.0f, 1.0f };
    const uint32_t which = test_random_below(random, 16);
    return which < 8 ? values[which] : test_random_range(random, -1e4f, 1e4f);
}

static bool same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void test_operations(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t ordered = 0;
    for (uint32_t i = 0; i < 100000; i++) {
        float in[4][3];
        tl_f32x3 v[4];
        for (int k = 0; k < 4; k++) {
            for (int lane = 0; lane < 3; lane++) {
                in[k][lane] = value_of(&random);
            }
            v[k] = tl_f32x3_of(tl_vec3_make(in[k][0], in[k][1], in[k][2]));
        }
        const tl_vec3 results[4] = { tl_f32x3_get(tl_f32x3_add(v[0], v[1])), tl_f32x3_get(tl_f32x3_sub(v[0], v[1])),
                                     tl_f32x3_get(tl_f32x3_mul(v[0], v[1])), tl_f32x3_get(tl_f32x3_max(v[0], v[1])) };
        bool are_ordered = true;
        for (int lane = 0; lane < 3; lane++) {
            const float a = in[0][lane], b = in[1][lane];
            const float expected[4] = { a + b, a - b, a * b, a > b ? a : b };
            for (int k = 0; k < 4; k++) {
                float got[3];
                memcpy(got, &results[k], sizeof got);
                TEST_CHECK(same_bits(got[lane], expected[k]));
            }
            are_ordered = are_ordered && a <= b && in[2][lane] <= in[3][lane];
        }
        TEST_CHECK(tl_f32x3_are_ordered(v[0], v[1], v[2], v[3]) == are_ordered);
        ordered += are_ordered;
    }
    TEST_CHECK(ordered > 1000);
}

static void test_words(void **state)
{
    (void)state;
    for (uint32_t i = 0; i <= UINT16_MAX; i++) {
        const uint16_t words[4] = { (uint16_t)i, (uint16_t)(UINT16_MAX - i), (uint16_t)(3 * i), 7 };
        const tl_vec3 v = tl_f32x3_get(tl_f32x3_from_u16(words));
        TEST_CHECK(v.x == (float)words[0] && v.y == (float)words[1] && v.z == (float)words[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_operations), cmocka_unit_test(test_words) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
