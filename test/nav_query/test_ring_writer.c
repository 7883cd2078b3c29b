// SPDX-License-Identifier: MIT
//
// Rings around a place whose tile is replaced: where its border stays the same, ways in them close and open again, else
// they are made anew; either way they are the rings of a navmesh that was built afresh. A number makes that many times
// as many edits.

#include "nav_fixture.h"

#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/ring_step.h"

#include <stdlib.h>

enum { TILES = 3, PLACES = TILES * TILES, TILE_CELLS = 4, EDITS = 60 };

static uint32_t times = 1;

// A level of which each tile has its own variant.
typedef struct patchwork {
    fixture_level variants[PLACES];
    tl_navmesh *navmesh; // slots in order of places
} patchwork;

static tl_nav_tile *build_tile(const patchwork *work, uint32_t place)
{
    return fixture_build_tile(&work->variants[place], (int32_t)(place % TILES), (int32_t)(place / TILES), NULL);
}

static tl_navmesh *build_all(const patchwork *work)
{
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t place = 0; place < PLACES; place++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, build_tile(work, place), TL_NAV_TILE_OWNED), TL_OK);
    }
    return navmesh;
}

static void check_same_edge(const tl_nav_rings *a, const tl_nav_rings *b, tl_nav_ring_edge edge_a,
                            tl_nav_ring_edge edge_b)
{
    TEST_CHECK(edge_a.to == edge_b.to && tl_nav_walls_number(edge_a) == tl_nav_walls_number(edge_b));
    if (tl_nav_ring_is_seam(edge_a.to)) {
        const tl_nav_ring_seam seam_a = tl_nav_ring_seam_of(a, edge_a.to), seam_b = tl_nav_ring_seam_of(b, edge_b.to);
        TEST_CHECK(seam_a.slot == seam_b.slot && seam_a.polygon == seam_b.polygon);
    } else {
        TEST_CHECK(tl_nav_ring_twin_hint(edge_a) == tl_nav_ring_twin_hint(edge_b));
    }
    const bool turns = tl_nav_turn_of(a, edge_a) != 0; // else its walls need not be known
    TEST_CHECK(turns == (tl_nav_turn_of(b, edge_b) != 0));
    TEST_CHECK(!turns ||
               memcmp(tl_nav_walls_of(a, edge_a), tl_nav_walls_of(b, edge_b), sizeof(tl_nav_ring_walls)) == 0);
}

static void check_same_rings(const tl_navmesh *navmesh, const tl_navmesh *fresh)
{
    for (uint32_t slot = 0; slot < PLACES; slot++) {
        const tl_nav_rings *a = &navmesh->slots[slot].rings, *b = &fresh->slots[slot].rings;
        TEST_CHECK(a->polygon_count == b->polygon_count && a->edge_count == b->edge_count);
        TEST_CHECK(a->seam_count == b->seam_count && a->walls_count == b->walls_count);
        TEST_CHECK(a->component_count == b->component_count && a->branch_count == b->branch_count);
        TEST_CHECK(a->has_back == b->has_back && a->has_wide_edges == b->has_wide_edges);
        for (uint32_t p = 0; p < a->polygon_count; p++) {
            const tl_nav_ring ring_a = tl_nav_ring_of(a, p), ring_b = tl_nav_ring_of(b, p);
            TEST_CHECK(ring_a.count == ring_b.count);
            TEST_CHECK(memcmp(ring_a.points, ring_b.points, ring_a.count * sizeof *ring_a.points) == 0);
            TEST_CHECK(tl_nav_branch_of(a, p) == tl_nav_branch_of(b, p));
            TEST_CHECK(tl_nav_component_of(a, p) == tl_nav_component_of(b, p));
            for (uint32_t k = 0; k < ring_a.count; k++) {
                check_same_edge(a, b, tl_nav_ring_edge_at(&ring_a, k), tl_nav_ring_edge_at(&ring_b, k));
            }
        }
        for (uint32_t i = 0; i < a->branch_count; i++) {
            TEST_CHECK(a->branch_end[i] == b->branch_end[i]);
        }
    }
}

// No tile is empty.
static void open_first_cell(fixture_level *variant, uint32_t place)
{
    variant->cells[place / TILES * TILE_CELLS][place % TILES * TILE_CELLS] = '0';
}

// Polygons of another kind inside, another border, or a cell that opens or closes.
static void change_variant(fixture_level *variant, uint32_t place, test_random *random)
{
    const uint32_t kind = test_random_below(random, 4);
    if (kind < 2) {
        variant->triangles = !variant->triangles;
    } else if (kind == 2) {
        variant->seed = test_random_u64(random);
    } else {
        const uint32_t x = place % TILES * TILE_CELLS + test_random_below(random, TILE_CELLS);
        const uint32_t z = place / TILES * TILE_CELLS + test_random_below(random, TILE_CELLS);
        variant->cells[z][x] = variant->cells[z][x] == '#' ? '0' : '#';
    }
}

typedef struct edit_counts {
    uint32_t reopened, remade;
} edit_counts;

// Replaces a tile. False: one around is linked with it no more. Its rings keep their cuts then, and are not those of a
// fresh navmesh.
static bool edit(patchwork *work, uint32_t place, edit_counts *counts)
{
    static const uint32_t FACING[TL_NAV_SIDE_CUT] = { 2, 3, 0, 1 }; // the sides of those around
    static const int32_t STEP[TL_NAV_SIDE_CUT][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 } };
    const int32_t x = (int32_t)place % TILES, z = (int32_t)place / TILES;
    const void *before[PLACES];
    bool is_linked[PLACES][TL_NAV_SIDE_CUT];
    tl_nav_slot *slots = work->navmesh->slots;
    for (uint32_t slot = 0; slot < PLACES; slot++) {
        before[slot] = slots[slot].rings.edges.wide;
        for (uint32_t side = 0; side < TL_NAV_SIDE_CUT; side++) {
            is_linked[slot][side] = slots[slot].sides[side].link_count > 0;
        }
    }
    TEST_RESULT(tl_navmesh_remove_tile(work->navmesh, x, z), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(work->navmesh, build_tile(work, place), TL_NAV_TILE_OWNED), TL_OK);
    bool stays_linked = true;
    for (uint32_t side = 0; side < TL_NAV_SIDE_CUT; side++) {
        const int32_t to_x = x + STEP[side][0], to_z = z + STEP[side][1];
        if (to_x < 0 || to_x >= TILES || to_z < 0 || to_z >= TILES) {
            continue;
        }
        const uint32_t at = (uint32_t)(to_z * TILES + to_x);
        if (slots[at].sides[FACING[side]].link_count > 0) {
            const bool reopens = slots[at].rings.edges.wide == before[at];
            counts->reopened += reopens ? 1 : 0;
            counts->remade += reopens ? 0 : 1;
        } else {
            stays_linked = stays_linked && !is_linked[at][FACING[side]];
        }
    }
    return stays_linked;
}

static void rings_are_those_of_a_fresh_navmesh(void **state)
{
    (void)state;
    static const uint32_t KINDS[] = { 0, 1, 4, 5 };
    edit_counts counts = { 0, 0 };
    test_random random = { 7 };
    for (uint32_t i = 0; i < 4 * times; i++) {
        patchwork work;
        const fixture_level level = fixture_random(&random, KINDS[i % 4], TILES * TILE_CELLS);
        for (uint32_t place = 0; place < PLACES; place++) {
            work.variants[place] = level;
            work.variants[place].tile_cells = TILE_CELLS;
            work.variants[place].cells[place / TILES * TILE_CELLS][place % TILES * TILE_CELLS] =
                '0'; // no tile is empty
        }
        work.navmesh = build_all(&work);
        bool stays_linked = true;
        for (uint32_t k = 0; k < EDITS && stays_linked; k++) {
            const uint32_t place = test_random_below(&random, PLACES);
            change_variant(&work.variants[place], place, &random);
            open_first_cell(&work.variants[place], place);
            stays_linked = edit(&work, place, &counts);
            if (stays_linked) {
                tl_navmesh *fresh = build_all(&work);
                check_same_rings(work.navmesh, fresh);
                tl_navmesh_destroy(fresh);
            }
        }
        tl_navmesh_destroy(work.navmesh);
    }
    TEST_CHECK(counts.reopened > 100 && counts.remade > 100);
}

static uint32_t count_closed(const tl_nav_rings *rings)
{
    uint32_t count = 0;
    for (uint32_t k = 0; k < rings->edge_count; k++) {
        const tl_nav_ring_edge edge = tl_nav_edge_of(rings, k);
        count += edge.to == TL_NAV_RING_WALL && tl_nav_ring_twin_hint(edge) == TL_NAV_RING_CLOSED ? 1 : 0;
    }
    return count;
}

// The tiles on both sides of one leave. Where one comes back with the same border, what the other has left is closed
// still; where it comes back with another border, the rings are made anew and know no ways but those that are there.
static void new_rings_have_no_closed_ways(void **state)
{
    (void)state;
    static const char *const OPEN[] = { "000000", "000000" };
    for (uint32_t changes = 0; changes < 2; changes++) {
        fixture_level level = fixture_make(OPEN, 2);
        level.tile_cells = 2;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        tl_nav_slot *middle = &navmesh->slots[1];
        TEST_CHECK(middle->rings.seam_count == 4 && count_closed(&middle->rings) == 0);
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, 2, 0), TL_OK);
        TEST_CHECK(count_closed(&middle->rings) == 4);
        fixture_level other = level;
        other.shake = changes == 0 ? 0 : FIXTURE_STEP / 4;
        TEST_RESULT(tl_navmesh_add_tile(navmesh, fixture_build_tile(&other, 0, 0, NULL), TL_NAV_TILE_OWNED), TL_OK);
        TEST_CHECK(count_closed(&middle->rings) == (changes == 0 ? 2 : 0));
        TEST_RESULT(tl_navmesh_add_tile(navmesh, fixture_build_tile(&level, 2, 0, NULL), TL_NAV_TILE_OWNED), TL_OK);
        TEST_CHECK(count_closed(&middle->rings) == 0);
        uint32_t links = 0;
        for (uint32_t k = 0; k < middle->rings.edge_count; k++) {
            const uint32_t to = tl_nav_edge_of(&middle->rings, k).to;
            if (tl_nav_ring_is_seam(to)) {
                TEST_CHECK(tl_nav_ring_seam_of(&middle->rings, to).slot != 1);
                links++;
            }
        }
        TEST_CHECK(links == middle->rings.seam_count);
        TEST_CHECK(links == middle->sides[0].link_count + middle->sides[2].link_count);
        tl_navmesh_destroy(navmesh);
    }
}

int main(int argc, char **argv)
{
    times = argc > 1 ? (uint32_t)atoi(argv[1]) : 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_are_those_of_a_fresh_navmesh),
        cmocka_unit_test(new_rings_have_no_closed_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
