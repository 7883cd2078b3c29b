// SPDX-License-Identifier: MIT
//
// Edges over a seam know where they stand in the ring across: a tile of many strips beside one large polygon is added
// without a search through that polygon's ring for each of them.

#include "nav_fixture.h"

#include "nav_query/navmesh/ring_step.h"

static void seams_know_their_twins(void **state)
{
    (void)state;
    static const char *const ROWS[4] = { "00000000", "00000000", "00000000", "00000000" };
    uint32_t seams = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fixture_level level = fixture_make(ROWS, 4);
        level.tile_cells = 4;
        level.shake = (int32_t)(seed % 4);
        level.seed = seed;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t slot = 0; slot < 2; slot++) {
            const tl_nav_rings *rings = &navmesh->slots[slot].rings;
            for (uint32_t p = 0; p < rings->polygon_count; p++) {
                uint32_t count = 0;
                const tl_nav_ring_edge *ring = tl_nav_ring_of(rings, p, &count);
                for (uint32_t k = 0; k < count; k++) {
                    if (tl_nav_ring_is_open(&ring[k]) && (ring[k].to & TL_NAV_RING_SEAM) != 0) {
                        const tl_nav_ring_place twin = tl_nav_ring_twin(navmesh, slot, p, ring, count, k);
                        TEST_CHECK(ring[k].twin == twin.edge);
                        seams += twin.edge > 0;
                    }
                }
            }
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seams > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(seams_know_their_twins) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
