// SPDX-License-Identifier: MIT
//
// crowd_grid.c and crowd_neighbors.c against a scan of all agents: dense, sparse, far from the origin, on several
// floors, of very different sizes, and where the grid goes round.

#include "nav_crowd/crowd_neighbors.h"
#include "talus_test.h"

static tl_nav_crowd *make_crowd(uint32_t count, float distance)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = count;
    def.neighbor_distance = distance;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    return crowd;
}

static uint32_t scan_all(const tl_nav_crowd *crowd, uint32_t k, crowd_neighbor *out)
{
    const crowd_snapshot *seen = &crowd->seen;
    uint32_t count = 0;
    for (uint32_t n = 0; n < seen->count; n++) {
        float dx = seen->agents[n].x - seen->agents[k].x, dz = seen->agents[n].z - seen->agents[k].z,
              rims = seen->agents[n].radius + seen->agents[k].radius;
        float far = crowd->def.neighbor_distance + rims;
        bool floor = seen->agents[n].bottom < seen->agents[k].top && seen->agents[k].bottom < seen->agents[n].top;
        if (n == k || !floor || !(dx * dx + dz * dz < far * far)) {
            continue;
        }
        crowd_neighbor neighbor = { sqrtf(dx * dx + dz * dz) - rims, seen->agents[n].agent, n };
        uint32_t at = count < crowd->def.max_neighbors ? count++ : count;
        while (at > 0 && (neighbor.gap < out[at - 1].gap ||
                          (neighbor.gap == out[at - 1].gap && neighbor.agent < out[at - 1].agent))) {
            if (at < count) {
                out[at] = out[at - 1];
            }
            at--;
        }
        if (at < count) {
            out[at] = neighbor;
        }
    }
    return count;
}

static void test_against_scan(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint64_t found = 0, full = 0, alone = 0;
    for (uint32_t round = 0; round < 60; round++) {
        const uint32_t count = 1 + test_random_below(&random, 300);
        const float spread = round % 4 == 0 ? 3.0f : round % 4 == 1 ? 12.0f : round % 4 == 2 ? 60.0f : 5000.0f;
        const float far = round % 5 == 0 ? 100000.0f : round % 5 == 1 ? -3.0e8f : 0.0f;
        tl_nav_crowd *crowd = make_crowd(count, 1.0f + 5.0f * test_random_unit(&random));
        for (uint32_t i = 0; i < count; i++) {
            tl_nav_agent_def def = tl_default_nav_agent_def();
            tl_nav_agent agent;
            def.is_fixed = true;
            def.radius = round % 3 == 0 ? test_random_range(&random, 0.1f, 3.0f) : 0.3f;
            def.position = tl_vec3_make(far + test_random_range(&random, -spread, spread),
                                        3.0f * (float)test_random_below(&random, 1 + round % 3),
                                        test_random_range(&random, -spread, spread));
            if (i % 9 == 8) { // in one place with another
                def.position = tl_vec3_make(far, 0.0f, 0.0f);
            }
            tl_navmesh *unused = (tl_navmesh *)(void *)crowd; // a fixed agent needs none
            TEST_RESULT(tl_nav_crowd_add(crowd, unused, &def, &agent, NULL), TL_OK);
        }
        const crowd_step step = { crowd, NULL, 0.05f, 0, 0, 0, { 1.0f, 0.0f } };
        tl_crowd_fill_grid(&step);
        TEST_CHECK(crowd->seen.count == count);
        for (uint32_t k = 0; k < count; k++) {
            crowd_neighbor a[CROWD_MAX_NEIGHBORS], b[CROWD_MAX_NEIGHBORS];
            uint32_t n = tl_crowd_find_neighbors(crowd, k, a);
            TEST_CHECK(n == scan_all(crowd, k, b));
            for (uint32_t i = 0; i < n; i++) {
                TEST_CHECK(a[i].gap == b[i].gap && a[i].agent == b[i].agent && a[i].snapshot == b[i].snapshot);
            }
            found += n;
            full += n == crowd->def.max_neighbors;
            alone += n == 0;
        }
        tl_nav_crowd_destroy(crowd);
    }
    TEST_CHECK(found > 10000 && full > 500 && alone > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_against_scan) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
