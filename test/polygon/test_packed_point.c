// SPDX-License-Identifier: MIT

#include "polygon/outline/packed_point.h"

#include "talus_test.h"

#include <talus/polygon.h>

// Small numbers, so that many are equal, or the whole range with its ends.
static tl_lattice_point random_point(test_random *random, bool is_small)
{
    const uint32_t limit = is_small ? 3 : TL_MAX_CONTOUR_COORDINATE;
    tl_lattice_point p = { (int32_t)test_random_below(random, 2 * limit + 1) - (int32_t)limit,
                           (int32_t)test_random_below(random, 2 * limit + 1) - (int32_t)limit };
    if (!is_small && test_random_below(random, 4) == 0) {
        p.x = test_random_below(random, 2) == 0 ? -TL_MAX_CONTOUR_COORDINATE : TL_MAX_CONTOUR_COORDINATE;
    }
    return p;
}

static bool is_between(int32_t p, int32_t a, int32_t b, int32_t c)
{
    const bool is_low = p < a && p < b && p<c, is_high = p> a && p > b && p > c;
    return !is_low && !is_high;
}

static void a_range_holds_what_lies_between_on_both_axes(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t inside = 0, outside = 0;
    for (uint32_t round = 0; round < 200000; round++) {
        tl_lattice_point p[4];
        for (uint32_t k = 0; k < 4; k++) {
            p[k] = random_point(&random, round % 2 == 0);
        }
        const bool expected = is_between(p[3].x, p[0].x, p[1].x, p[2].x) && is_between(p[3].z, p[0].z, p[1].z, p[2].z);
        const tl_packed_range range = tl_packed_range_of(p[0], p[1], p[2]);
        TEST_CHECK(tl_in_packed_range(&range, tl_pack_point(p[3])) == expected);
        inside += expected;
        outside += !expected;
    }
    TEST_CHECK(inside > 20000 && outside > 20000);
}

static bool spans_meet(int32_t a, int32_t b, int32_t c, int32_t d)
{
    return (a <= b ? a : b) <= (c <= d ? d : c) && (c <= d ? c : d) <= (a <= b ? b : a);
}

static void ranges_meet_where_both_spans_do(void **state)
{
    (void)state;
    test_random random = { 2 };
    uint32_t meeting = 0, apart = 0;
    for (uint32_t round = 0; round < 200000; round++) {
        tl_lattice_point p[4];
        for (uint32_t k = 0; k < 4; k++) {
            p[k] = random_point(&random, round % 2 == 0);
        }
        const bool expected = spans_meet(p[0].x, p[1].x, p[2].x, p[3].x) && spans_meet(p[0].z, p[1].z, p[2].z, p[3].z);
        const tl_packed_range a = tl_packed_range_of(p[0], p[1], p[1]), b = tl_packed_range_of(p[2], p[3], p[3]);
        TEST_CHECK(tl_packed_ranges_meet(&a, &b) == expected && tl_packed_ranges_meet(&b, &a) == expected);
        meeting += expected;
        apart += !expected;
    }
    TEST_CHECK(meeting > 20000 && apart > 20000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_range_holds_what_lies_between_on_both_axes),
        cmocka_unit_test(ranges_meet_where_both_spans_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
