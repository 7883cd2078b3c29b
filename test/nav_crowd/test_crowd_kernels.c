// SPDX-License-Identifier: MIT
//
// The crowd's kernels against plain loops, and bit for bit against their twin in plain C: who is found, in which order,
// and half-planes that lead to the border of what is forbidden.

#include "nav_crowd/crowd_kernels.h"

#include "talus_test.h"

#include <math.h>
#include <string.h>

enum { AGENTS = 200, DISC_ROUNDS = 20000 };

static const crowd_kernels *kernels[] = {
    &tl_crowd_kernels_scalar,
#if TL_CPU_LEVELS >= 1
    &tl_crowd_kernels_vec128,
#endif
};

static uint32_t kernel_count(void)
{
    return TL_CPU_LEVELS >= 1 && tl_cpu_has_level(1) ? 2 : 1;
}

static float numbers[8][AGENTS + CROWD_LANES];

static crowd_snapshot random_snapshot(test_random *random)
{
    crowd_snapshot seen;
    memset(&seen, 0, sizeof seen);
    seen.x = numbers[0];
    seen.y = numbers[1];
    seen.z = numbers[2];
    seen.radius = numbers[3];
    seen.height = numbers[4];
    seen.count = AGENTS;
    for (uint32_t i = 0; i < AGENTS; i++) {
        seen.x[i] = test_random_range(random, -5.0f, 5.0f);
        seen.y[i] = test_random_below(random, 8) == 0 ? 2.5f : 0.0f;
        seen.z[i] = test_random_range(random, -5.0f, 5.0f);
        seen.radius[i] = test_random_range(random, 0.1f, 0.6f);
        seen.height[i] = test_random_range(random, 1.0f, 3.0f);
    }
    return seen;
}

static crowd_scan random_scan(test_random *random, const crowd_snapshot *seen)
{
    crowd_scan scan;
    memset(&scan, 0, sizeof scan);
    scan.seen = seen;
    scan.self = test_random_below(random, AGENTS);
    scan.reach = test_random_range(random, 0.2f, 4.0f);
    scan.full = 1 + test_random_below(random, CROWD_MAX_FOUND - CROWD_LANES);
    scan.span_count = test_random_below(random, CROWD_MAX_SPANS + 1);
    for (uint32_t i = 0; i < scan.span_count; i++) {
        const uint32_t begin = test_random_below(random, AGENTS);
        const crowd_span span = { begin, begin + test_random_below(random, AGENTS - begin + 1) };
        scan.spans[i] = span;
    }
    return scan;
}

static bool is_near(const crowd_scan *scan, uint32_t k, float *gap)
{
    const crowd_snapshot *seen = scan->seen;
    const uint32_t self = scan->self;
    const float dx = seen->x[k] - seen->x[self], dz = seen->z[k] - seen->z[self];
    const float rims = seen->radius[k] + seen->radius[self], far = scan->reach + rims;
    *gap = sqrtf(dx * dx + dz * dz) - rims;
    return k != self && dx * dx + dz * dz < far * far && seen->y[k] < seen->y[self] + seen->height[self] &&
           seen->y[self] < seen->y[k] + seen->height[k];
}

// Each time a scan is full it is emptied, and goes on where it stopped.
static void check_scan(const crowd_kernels *with, crowd_scan scan, uint64_t *found, uint64_t *stops)
{
    const crowd_scan all = scan;
    uint32_t at = 0;
    bool is_done = with->scan(&scan);
    for (uint32_t s = 0; s < all.span_count; s++) {
        for (uint32_t k = all.spans[s].begin; k < all.spans[s].end; k++) {
            float gap;
            if (!is_near(&all, k, &gap)) {
                continue;
            }
            if (at == scan.count) {
                TEST_CHECK(!is_done && scan.count > all.full);
                scan.count = at = 0;
                is_done = with->scan(&scan);
                ++*stops;
            }
            TEST_CHECK(at < scan.count && scan.at[at] == k && scan.gap[at] == gap);
            at++;
            ++*found;
        }
    }
    while (!is_done) { // it was full with the last one
        TEST_CHECK(at == scan.count);
        scan.count = at = 0;
        is_done = with->scan(&scan);
    }
    TEST_CHECK(at == scan.count && scan.span_count == 0 && scan.next_span == 0);
}

static void test_scan(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint64_t found = 0, stops = 0;
    for (uint32_t round = 0; round < 400; round++) {
        const crowd_snapshot seen = random_snapshot(&random);
        const crowd_scan scan = random_scan(&random, &seen);
        for (uint32_t i = 0; i < kernel_count(); i++) {
            check_scan(kernels[i], scan, &found, &stops);
        }
    }
    TEST_CHECK(found > 10000 && stops > 100);
}

static void test_rank(void **state)
{
    (void)state;
    test_random random = { 6 };
    uint32_t ties = 0;
    for (uint32_t round = 0; round < 3000; round++) {
        float gaps[CROWD_MAX_FOUND];
        const uint32_t count = test_random_below(&random, CROWD_MAX_FOUND + 1);
        for (uint32_t i = 0; i < count; i++) {
            const bool is_tie = i > 0 && test_random_below(&random, 200) == 0;
            gaps[i] = is_tie ? gaps[test_random_below(&random, i)] : test_random_range(&random, -1.0f, 4.0f);
        }
        uint32_t wanted[CROWD_MAX_FOUND] = { 0 };
        bool is_order = true;
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t k = 0; k < count; k++) {
                wanted[i] += gaps[k] < gaps[i];
                is_order = is_order && (i == k || gaps[k] != gaps[i]);
            }
        }
        ties += !is_order;
        for (uint32_t i = 0; i < kernel_count(); i++) {
            uint32_t ranks[CROWD_MAX_FOUND];
            TEST_CHECK(kernels[i]->rank(gaps, count, ranks) == is_order);
            for (uint32_t k = 0; k < count; k++) {
                TEST_CHECK(ranks[k] == wanted[k]);
            }
        }
    }
    TEST_CHECK(ties > 100 && ties < 2000);
}

// The least distance to the disc's middle within the time, of one that moves so much faster than it.
static double least_distance(double x, double z, double vx, double vz, double seconds)
{
    const double speed_sq = vx * vx + vz * vz;
    double t = speed_sq > 0.0 ? (x * vx + z * vz) / speed_sq : 0.0;
    t = t < 0.0 ? 0.0 : t > seconds ? seconds : t;
    return hypot(x - vx * t, z - vz * t);
}

// Who changes its velocity by all that is asked comes just past the disc; where they overlap, it is out in time.
static void check_plane(const crowd_discs *discs, uint32_t i, const tl_half_plane *plane, uint32_t counts[3])
{
    const double x = (double)discs->x[i], z = (double)discs->z[i], radius = (double)discs->radius[i];
    const double vx = (double)(discs->vx[i] + plane->x), vz = (double)(discs->vz[i] + plane->z);
    TEST_CHECK(fabs(hypot((double)plane->along_x, (double)plane->along_z) - 1.0) < 1e-5);
    if (x * x + z * z <= radius * radius) {
        const double seconds = 1.0 / (double)discs->overlap_rate;
        TEST_CHECK(fabs(hypot(x - vx * seconds, z - vz * seconds) - radius) < 1e-4);
        counts[0]++;
        return;
    }
    TEST_CHECK(fabs(least_distance(x, z, vx, vz, 1.0 / (double)discs->rate) - radius) < 2e-3);
    const bool collides = least_distance(x, z, (double)discs->vx[i], (double)discs->vz[i], 2.0) < radius;
    counts[collides ? 1 : 2]++;
}

static void test_avoid(void **state)
{
    (void)state;
    test_random random = { 7 };
    uint32_t counts[3] = { 0, 0, 0 }; // overlapping, on the way to a collision, not
    for (uint32_t round = 0; round < DISC_ROUNDS; round++) {
        crowd_discs discs;
        memset(&discs, 0, sizeof discs);
        discs.count = 1 + test_random_below(&random, CROWD_MAX_NEIGHBORS);
        discs.rate = 0.5f;
        discs.overlap_rate = 20.0f;
        for (uint32_t i = 0; i < discs.count; i++) {
            discs.x[i] = test_random_range(&random, -4.0f, 4.0f);
            discs.z[i] = test_random_range(&random, -4.0f, 4.0f);
            discs.vx[i] = test_random_range(&random, -3.0f, 3.0f);
            discs.vz[i] = test_random_range(&random, -3.0f, 3.0f);
            discs.radius[i] = test_random_range(&random, 0.2f, 1.2f);
            discs.evade[i] = discs.room[i] = 1.0f;
        }
        tl_half_plane planes[2][CROWD_MAX_NEIGHBORS];
        for (uint32_t i = 0; i < kernel_count(); i++) {
            kernels[i]->avoid(&discs, planes[i]);
            TEST_CHECK(memcmp(planes[i], planes[0], discs.count * sizeof *planes[0]) == 0);
        }
        for (uint32_t i = 0; i < discs.count; i++) {
            check_plane(&discs, i, &planes[0][i], counts);
        }
    }
    TEST_CHECK(counts[0] > 1000 && counts[1] > 1000 && counts[2] > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scan),
        cmocka_unit_test(test_rank),
        cmocka_unit_test(test_avoid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
