// SPDX-License-Identifier: MIT
//
// Edges over a seam know where they stand in the ring across: a tile of many strips beside one large polygon is added
// without a search through that polygon's ring for each of them. Rings take no more memory than their edges.

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

static void rings_have_no_room_to_spare(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint64_t seams_in_all = 0;
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 16);
        level.tile_cells = 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
            const tl_nav_rings *rings = &navmesh->slots[slot].rings;
            const uint64_t edges = rings->cells[rings->polygon_count].first, polygons = rings->polygon_count;
            uint64_t seams = 0;
            for (uint64_t k = 0; k < edges; k++) {
                seams += tl_nav_ring_is_open(&rings->edges[k]) && (rings->edges[k].to & TL_NAV_RING_SEAM) != 0;
            }
            seams_in_all += seams;
            TEST_CHECK(rings->block_size ==
                       edges * (sizeof *rings->edges + sizeof *rings->walls) + seams * sizeof *rings->seams +
                           (polygons + 1) * sizeof *rings->cells +
                           (3 * polygons + navmesh->slots[slot].tile->node_count) * sizeof(uint32_t));
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seams_in_all > 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(seams_know_their_twins),
                                        cmocka_unit_test(rings_have_no_room_to_spare) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
