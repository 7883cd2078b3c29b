// SPDX-License-Identifier: MIT
//
// slot_deal.c: the smallest sum of squares, against all permutations; and how near to it sorting comes.

#include "talus_test.h"

#include "nav_crowd/slot_deal.h"

#include <math.h>
#include <string.h>

enum { MOST = 2000 };

static float from[2 * MOST], to[2 * MOST];
static uint32_t taker[MOST];
static tl_sort_item followers[MOST], slots[MOST], scratch[MOST];

static tl_slot_deal make_deal(uint32_t count)
{
    const tl_slot_deal deal = { from, to, taker, followers, slots, scratch, count };
    return deal;
}

static double squared(uint32_t follower, uint32_t slot)
{
    return pow((double)to[2 * slot] - (double)from[2 * follower], 2.0) +
           pow((double)to[2 * slot + 1] - (double)from[2 * follower + 1], 2.0);
}

// Everybody has one slot.
static double sum_of(uint32_t count)
{
    static bool is_taken[MOST];
    double sum = 0.0;
    memset(is_taken, 0, sizeof is_taken);
    for (uint32_t k = 0; k < count; k++) {
        TEST_CHECK(taker[k] < count && !is_taken[taker[k]]);
        is_taken[taker[k]] = true;
        sum += squared(taker[k], k);
    }
    return sum;
}

static double smallest_sum(uint32_t count, uint32_t slot, uint32_t used)
{
    double least = slot == count ? 0.0 : (double)INFINITY;
    for (uint32_t f = 0; slot < count && f < count; f++) {
        if ((used >> f & 1) == 0) {
            least = fmin(least, squared(f, slot) + smallest_sum(count, slot + 1, used | 1u << f));
        }
    }
    return least;
}

static void test_exact(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t moved = 0;
    for (uint32_t round = 0; round < 400; round++) {
        const uint32_t count = 1 + round % 7;
        for (uint32_t i = 0; i < 2 * count; i++) {
            // Every third round on a coarse grid: equal ways, slots in one place.
            const bool is_coarse = round % 3 == 0;
            from[i] = is_coarse ? (float)test_random_below(&random, 3) : test_random_range(&random, -5.0f, 5.0f);
            to[i] = is_coarse ? (float)test_random_below(&random, 3) : test_random_range(&random, -5.0f, 5.0f);
        }
        const tl_slot_deal deal = make_deal(count);
        tl_slot_deal_out(&deal);
        const double sum = sum_of(count), least = smallest_sum(count, 0, 0);
        TEST_CHECK(fabs(sum - least) <= 1e-9 * (1.0 + least));
        moved += taker[0] != 0;
    }
    TEST_CHECK(moved > 100);
}

// Numbers as large as a crowd takes: the sums are exact enough to end.
static void test_far(void **state)
{
    (void)state;
    test_random random = { 6 };
    for (uint32_t round = 0; round < 50; round++) {
        const float size = round % 2 == 0 ? 2e9f : 1e-30f;
        for (uint32_t i = 0; i < 2 * TL_SLOT_DEAL_EXACT; i++) {
            from[i] = test_random_range(&random, -size, size);
            to[i] = test_random_range(&random, -size, size);
        }
        const tl_slot_deal deal = make_deal(TL_SLOT_DEAL_EXACT);
        tl_slot_deal_out(&deal);
        TEST_CHECK(isfinite(sum_of(TL_SLOT_DEAL_EXACT)));
    }
}

// The strips, where the exact method can be asked too: as many slots, in a subset of which each follows the other.
static void test_strips(void **state)
{
    (void)state;
    test_random random = { 7 };
    double ratio_sum = 0.0, worst = 0.0;
    for (uint32_t round = 0; round < 100; round++) {
        for (uint32_t i = 0; i < 2 * TL_SLOT_DEAL_EXACT; i++) {
            from[i] = test_random_range(&random, 0.0f, 10.0f);
            to[i] = test_random_range(&random, 0.0f, 10.0f) + 20.0f;
        }
        const tl_slot_deal deal = make_deal(TL_SLOT_DEAL_EXACT);
        tl_slot_deal_out(&deal);
        // About the mean way, which no dealing changes.
        double mean[2] = { 0.0, 0.0 }, apart;
        for (uint32_t i = 0; i < TL_SLOT_DEAL_EXACT; i++) {
            mean[0] += ((double)to[2 * i] - (double)from[2 * i]) / TL_SLOT_DEAL_EXACT;
            mean[1] += ((double)to[2 * i + 1] - (double)from[2 * i + 1]) / TL_SLOT_DEAL_EXACT;
        }
        apart = TL_SLOT_DEAL_EXACT * (mean[0] * mean[0] + mean[1] * mean[1]);
        const double least = sum_of(TL_SLOT_DEAL_EXACT) - apart;
        tl_slot_deal_by_strips(&deal);
        const double ratio = (sum_of(TL_SLOT_DEAL_EXACT) - apart) / least;
        TEST_CHECK(ratio >= 1.0 - 1e-9);
        ratio_sum += ratio;
        worst = fmax(worst, ratio);
    }
    print_message("strips: %.2f times the smallest sum on average, %.2f at worst\n", ratio_sum / 100.0, worst);
    TEST_CHECK(ratio_sum < 300.0);
    // A line that faces whichever way keeps its order, and so does a block.
    for (uint32_t turn = 0; turn < 16; turn++) {
        const double angle = 0.4 * (double)turn;
        for (uint32_t i = 0; i < MOST; i++) {
            const bool is_line = turn % 2 == 0;
            const double x = is_line ? (double)i : (double)(i % 40), z = is_line ? 0.0 : (double)(i / 40) * 1.4;
            from[2 * i] = to[2 * i] = (float)(x * cos(angle) - z * sin(angle));
            from[2 * i + 1] = to[2 * i + 1] = (float)(x * sin(angle) + z * cos(angle));
        }
        for (uint32_t i = MOST - 1; i > 0; i--) {
            const uint32_t k = test_random_below(&random, i + 1);
            for (uint32_t c = 0; c < 2; c++) {
                const float swap = from[2 * i + c];
                from[2 * i + c] = from[2 * k + c];
                from[2 * k + c] = swap;
            }
        }
        const tl_slot_deal deal = make_deal(MOST);
        tl_slot_deal_out(&deal);
        TEST_CHECK(sum_of(MOST) == 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_exact), cmocka_unit_test(test_far),
                                        cmocka_unit_test(test_strips) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
