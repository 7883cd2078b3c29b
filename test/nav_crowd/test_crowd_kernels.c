// SPDX-License-Identifier: MIT
//
// The crowd's kernels against plain loops, and bit for bit against their twin in plain C: who is found, in which order,
// what is seen of them, and half-planes that lead to the border of what is forbidden.

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

static crowd_seen_agent agents[AGENTS + CROWD_LANES];

static crowd_snapshot random_snapshot(test_random *random)
{
    crowd_snapshot seen;
    memset(&seen, 0, sizeof seen);
    seen.agents = agents;
    seen.count = AGENTS;
    for (uint32_t i = 0; i < AGENTS; i++) {
        agents[i].x = test_random_range(random, -5.0f, 5.0f);
        agents[i].bottom = test_random_below(random, 8) == 0 ? 2.5f : 0.0f;
        agents[i].z = test_random_range(random, -5.0f, 5.0f);
        agents[i].radius = test_random_range(random, 0.1f, 0.6f);
        agents[i].top = agents[i].bottom + test_random_range(random, 1.0f, 3.0f);
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
    const crowd_seen_agent *own = &scan->seen->agents[scan->self], *other = &scan->seen->agents[k];
    const float dx = other->x - own->x, dz = other->z - own->z;
    const float rims = other->radius + own->radius, far = scan->reach + rims;
    *gap = sqrtf(dx * dx + dz * dz) - rims;
    return other != own && dx * dx + dz * dz < far * far && other->bottom < own->top && own->bottom < other->top;
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

static uint32_t random_neighbors(test_random *random, crowd_neighbor *neighbors)
{
    static const uint32_t kinds[] = { 0, 0, 0, CROWD_SEEN_FIXED, CROWD_SEEN_STILL, CROWD_SEEN_YIELDS };
    for (uint32_t i = 0; i < AGENTS; i++) {
        agents[i].vx = test_random_range(random, -2.0f, 2.0f);
        agents[i].vz = test_random_range(random, -2.0f, 2.0f);
        const float speed = test_random_below(random, 3) == 0 ? 0.2f : 2.0f;
        agents[i].wanted_x = test_random_range(random, -speed, speed);
        agents[i].wanted_z = test_random_range(random, -speed, speed);
        agents[i].priority = test_random_unit(random);
        agents[i].kind = kinds[test_random_below(random, 6)] | test_random_below(random, 65536) << CROWD_TRAVEL_SHIFT;
    }
    const uint32_t count = test_random_below(random, CROWD_MAX_NEIGHBORS + 1);
    for (uint32_t i = 0; i < count; i++) {
        neighbors[i].snapshot = test_random_below(random, AGENTS);
    }
    return count;
}

// What a neighbour wants, and where it goes; of one that is fixed, how it moves.
static void check_way(const crowd_view *view, uint32_t n, const crowd_seen_agent *one)
{
    const bool is_fixed = (one->kind & CROWD_SEEN_FIXED) != 0;
    const int32_t x = (int32_t)(one->kind >> 16 & 255), z = (int32_t)(one->kind >> 24);
    TEST_CHECK(view->wanted_x[n] == (is_fixed ? one->vx : one->wanted_x));
    TEST_CHECK(view->wanted_z[n] == (is_fixed ? one->vz : one->wanted_z));
    TEST_CHECK(view->way_x[n] == (is_fixed ? one->vx : (float)(x < 128 ? x : x - 256)));
    TEST_CHECK(view->way_z[n] == (is_fixed ? one->vz : (float)(z < 128 ? z : z - 256)));
    TEST_CHECK((view->fixed >> n & 1) == (uint32_t)is_fixed);
    TEST_CHECK((view->still >> n & 1) == (uint32_t)((one->kind & CROWD_SEEN_STILL) != 0));
    TEST_CHECK((view->yields >> n & 1) == (uint32_t)((one->kind & CROWD_SEEN_YIELDS) != 0));
}

static void check_view(const crowd_view *view, const crowd_seen_agent *own, const crowd_neighbor *neighbors)
{
    const crowd_discs *discs = &view->discs;
    TEST_CHECK(discs->own_vx == own->vx && discs->own_vz == own->vz);
    for (uint32_t n = 0; n < discs->count; n++) {
        const crowd_seen_agent *one = &agents[neighbors[n].snapshot];
        TEST_CHECK(discs->x[n] == one->x - own->x && discs->z[n] == one->z - own->z);
        TEST_CHECK(discs->vx[n] == own->vx - one->vx && discs->vz[n] == own->vz - one->vz);
        TEST_CHECK(discs->radius[n] == 1.5f * (own->radius + one->radius) && view->priority[n] == one->priority);
        check_way(view, n, one);
    }
}

static void check_traffic(const crowd_view *view, const crowd_outlook *look, const crowd_traffic_bits *bits)
{
    for (uint32_t n = 0; n < view->discs.count; n++) {
        const float x = look->late ? view->wanted_x[n] : view->way_x[n];
        const float z = look->late ? view->wanted_z[n] : view->way_z[n];
        const float ahead = view->discs.x[n] * look->ahead[0] + view->discs.z[n] * look->ahead[1];
        const float speed_sq = view->wanted_x[n] * view->wanted_x[n] + view->wanted_z[n] * view->wanted_z[n];
        TEST_CHECK((bits->ahead >> n & 1) == (uint32_t)(ahead > 0.0f));
        TEST_CHECK((bits->against >> n & 1) == (uint32_t)(x * look->travel[0] + z * look->travel[1] < 0.0f));
        TEST_CHECK((bits->quick >> n & 1) == (uint32_t)(speed_sq >= CROWD_STANDING_SPEED * CROWD_STANDING_SPEED));
    }
}

static void test_view(void **state)
{
    (void)state;
    test_random random = { 8 };
    for (uint32_t round = 0; round < 2000; round++) {
        const crowd_snapshot seen = random_snapshot(&random);
        crowd_neighbor neighbors[CROWD_MAX_NEIGHBORS];
        const uint32_t count = random_neighbors(&random, neighbors), self = test_random_below(&random, AGENTS);
        const float ahead = test_random_range(&random, -1.0f, 1.0f), travel = test_random_range(&random, -1.0f, 1.0f);
        const crowd_outlook look = { { ahead, 1.0f - ahead }, { travel, 1.0f - travel }, false, round % 2 != 0 };
        for (uint32_t i = 0; i < kernel_count(); i++) {
            crowd_view view;
            kernels[i]->view(&seen, self, neighbors, count, 1.5f, &view);
            const crowd_traffic_bits bits = kernels[i]->traffic(&view, &look);
            TEST_CHECK(view.discs.count == count);
            check_view(&view, &agents[self], neighbors);
            check_traffic(&view, &look, &bits);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scan),
        cmocka_unit_test(test_rank),
        cmocka_unit_test(test_view),
        cmocka_unit_test(test_avoid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
