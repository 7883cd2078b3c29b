// SPDX-License-Identifier: MIT
//
// The cosine of degrees against libm's, and where it must be exact.

#include "math/cos_degrees.h"

#include "talus_test.h"

#include <math.h>

static void exact_values(void **state)
{
    (void)state;
    TEST_CHECK(tl_cos_degrees(0.0f) == 1.0f);
    TEST_CHECK(tl_cos_degrees(60.0f) == 0.5f);
    TEST_CHECK(tl_cos_degrees(90.0f) == 0.0f);
    TEST_CHECK(tl_cos_degrees(45.0f) == 0.70710678118654752f);
    TEST_CHECK(tl_cos_degrees(1e-30f) == 1.0f);
}

static void close_to_libm(void **state)
{
    (void)state;
    float before = 1.0f;
    for (uint32_t i = 0; i <= 900000; i++) {
        float degrees = (float)i * 1e-4f;
        degrees = degrees > 90.0f ? 90.0f : degrees;
        float cosine = tl_cos_degrees(degrees);
        double exact = cos((double)degrees * 0.017453292519943295);
        double ulp = (double)(nextafterf(cosine, 2.0f) - cosine);
        // pi / 2 is not a double, so near 90 degrees libm's own argument is off by 6e-17.
        TEST_CHECK(fabs((double)cosine - exact) <= 0.51 * ulp + 1e-16);
        TEST_CHECK(cosine <= before);
        before = cosine;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(exact_values), cmocka_unit_test(close_to_libm) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
