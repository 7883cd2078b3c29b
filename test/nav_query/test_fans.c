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
                        TEST_CHECK(tl_nav_ring_twin_hint(&ring[k]) == twin.edge);
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
    uint64_t seams_in_all = 0, edges_in_all = 0, walls_in_all = 0;
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
                const uint32_t walls = rings->edges[k].mark >> TL_NAV_RING_TWIN_BITS;
                TEST_CHECK(walls < rings->walls_count && (rings->edges[k].turn == 0 || walls >= TL_NAV_WALLS_FIRST));
            }
            seams_in_all += seams;
            edges_in_all += edges;
            walls_in_all += rings->walls_count - TL_NAV_WALLS_FIRST;
            TEST_CHECK(rings->block_size ==
                       edges * sizeof *rings->edges + seams * sizeof *rings->seams +
                           (polygons + 1) * sizeof *rings->cells +
                           (3 * polygons + navmesh->slots[slot].tile->node_count) * sizeof(uint32_t));
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seams_in_all > 200);
    TEST_CHECK(3 * walls_in_all < 2 * edges_in_all); // all edges of a fan have theirs in common
}

// More edges than a mark has room for: what lies across is looked for from the last place that one can name.
static void far_twins_are_found(void **state)
{
    (void)state;
    enum { CORNERS = 150 };
    tl_nav_ring_edge edges[3 + CORNERS];
    memset(edges, 0, sizeof edges);
    for (uint32_t k = 0; k < 3 + CORNERS; k++) {
        edges[k].x = (float)k;
        edges[k].to = TL_NAV_RING_WALL;
    }
    tl_nav_ring_cell cells[3] = { { 0, 0 }, { 3, 0 }, { 3 + CORNERS, 0 } };
    tl_nav_slot slot;
    memset(&slot, 0, sizeof slot);
    slot.rings.cells = cells;
    slot.rings.edges = edges;
    slot.rings.polygon_count = 2;
    tl_navmesh navmesh;
    memset(&navmesh, 0, sizeof navmesh);
    navmesh.slots = &slot;
    for (uint32_t twin = 0; twin < CORNERS; twin++) {
        edges[1].to = 1;
        tl_nav_set_ring_twin(&edges[1], twin);
        edges[3 + twin].to = 0;
        edges[3 + twin].x = edges[2].x; // where the edge ends
        TEST_CHECK(tl_nav_ring_twin(&navmesh, 0, 0, edges, 3, 1).edge == twin);
        TEST_CHECK(tl_nav_inner_twin(&slot.rings, 0, 1) == twin);
        edges[3 + twin].to = TL_NAV_RING_WALL;
        edges[3 + twin].x = (float)(3 + twin);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(seams_know_their_twins),
                                        cmocka_unit_test(rings_have_no_room_to_spare),
                                        cmocka_unit_test(far_twins_are_found) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
