// SPDX-License-Identifier: MIT

#include "polygon/outline/sweep.h"

#include "polygon_oracle.h"

enum { MAX_POINTS = 200, MAX_SEGMENTS = 200 };

static bool brute_apart(const tl_lattice_point *points, const tl_lattice_segment *segments, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            oracle_point p[4];
            const uint32_t ends[4] = { segments[i].a, segments[i].b, segments[j].a, segments[j].b };
            for (uint32_t k = 0; k < 4; k++) {
                p[k].x = points[ends[k]].x;
                p[k].z = points[ends[k]].z;
            }
            bool shares = ends[0] == ends[2] || ends[0] == ends[3] || ends[1] == ends[2] || ends[1] == ends[3];
            if (!shares && oracle_segments_meet(p[0], p[1], p[2], p[3])) {
                return false;
            }
            for (uint32_t k = 0; shares && k < 4; k++) {
                uint32_t other = k < 2 ? 2 : 0;
                if (ends[k] != ends[other] && ends[k] != ends[other + 1] &&
                    oracle_between(p[other], p[other + 1], p[k])) {
                    return false;
                }
            }
        }
    }
    return true;
}

// Different points and different segments, few enough that a good part of the sets has no contact.
static uint32_t random_segments(test_random *random, uint32_t side, tl_lattice_point *points, uint32_t *point_count,
                                tl_lattice_segment *segments, uint32_t wanted, uint32_t reach)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < *point_count; i++) {
        points[i].x = (int32_t)test_random_below(random, side) - (int32_t)(side / 2);
        points[i].z = (int32_t)test_random_below(random, side) - (int32_t)(side / 2);
        for (uint32_t j = 0; j < i; j++) {
            if (tl_same_point(points[i], points[j])) {
                i--;
                *point_count -= 1;
                break;
            }
        }
    }
    for (uint32_t i = 0; i < 20 * wanted && count<wanted && * point_count> 1; i++) {
        uint32_t a = test_random_below(random, *point_count), b = test_random_below(random, *point_count);
        bool is_new = a != b && (reach == 0 || tl_distance2(points[a], points[b]) <= (int64_t)reach * reach);
        for (uint32_t k = 0; k < count; k++) {
            is_new =
                is_new && !(segments[k].a == a && segments[k].b == b) && !(segments[k].a == b && segments[k].b == a);
        }
        if (is_new) {
            segments[count].a = a;
            segments[count++].b = b;
        }
    }
    return count;
}

static void finds_any_contact(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t apart = 0, touching = 0, large = 0;
    for (uint32_t round = 0; round < 20000; round++) {
        tl_lattice_point points[MAX_POINTS];
        tl_lattice_segment segments[MAX_SEGMENTS];
        bool is_large = round % 40 == 0;
        uint32_t side = is_large ? 200 : 3u << test_random_below(&random, 6);
        uint32_t point_count = 2 + test_random_below(&random, is_large ? 100 : 9);
        uint32_t count = random_segments(&random, side, points, &point_count, segments,
                                         1 + test_random_below(&random, is_large ? 60 : 8), is_large ? 20 : 0);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        bool result = false;
        TEST_RESULT(tl_sweep_segments(&arena, points, point_count, segments, count, &result), TL_OK);
        TEST_CHECK(result == brute_apart(points, segments, count));
        apart += result && count > 2;
        touching += !result;
        large += result && count > 15;
        tl_arena_free(&arena);
    }
    TEST_CHECK(apart > 2000 && touching > 5000 && large > 30);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(finds_any_contact) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
