// SPDX-License-Identifier: MIT
//
// What the processor says of itself, against the compiler's runtime library where there is one.

#include "base/cpu.h"
#include "talus_test.h"

static void it_agrees_with_the_compilers_library(void **state)
{
    (void)state;
#if TL_CPU_LEVELS == 3 && defined(__GNUC__)
    assert_int_equal(tl_cpu_has_vec128(), __builtin_cpu_supports("sse4.2") != 0);
    assert_int_equal(tl_cpu_has_avx2(), __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                                            __builtin_cpu_supports("bmi") != 0);
    assert_int_equal(tl_cpu_has_avx512(), tl_cpu_has_avx2() && __builtin_cpu_supports("avx512f") != 0 &&
                                              __builtin_cpu_supports("avx512vl") != 0 &&
                                              __builtin_cpu_supports("avx512bw") != 0 &&
                                              __builtin_cpu_supports("avx512dq") != 0);
    assert_int_equal(tl_cpu_is_amd(), __builtin_cpu_is("amd") != 0);
    TEST_CHECK(tl_cpu_found != 0 && tl_cpu_look() == tl_cpu_found);
#endif
    // A level needs all below it, and the first is always there.
    TEST_CHECK(tl_cpu_has_level(0) && !tl_cpu_has_level(-1) && !tl_cpu_has_level(TL_CPU_LEVELS + 1));
    for (int level = 1; level <= TL_CPU_LEVELS; level++) {
        TEST_CHECK(!tl_cpu_has_level(level) || tl_cpu_has_level(level - 1));
    }
    TEST_CHECK(tl_cpu_has_level(TL_CPU_BASE_LEVEL));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(it_agrees_with_the_compilers_library) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
