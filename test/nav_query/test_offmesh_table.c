// SPDX-License-Identifier: MIT
//
// Off-mesh links under edits: tiles and links come and go at random, and after each edit every end stands where it
// would on a navmesh that was built afresh, islands are those of a flood over polygons and links, and counts are true.

#include "nav_fixture.h"

#include <math.h>

enum { TILES = 4, MAX_LINKS = 24, EDITS = 1000 };

typedef struct edited {
    fixture_level level;
    tl_navmesh *navmesh;
    bool present[TILES][TILES];
    tl_nav_ref links[MAX_LINKS];
    tl_nav_offmesh offmesh[MAX_LINKS];
    uint32_t link_count;
} edited;

typedef struct coverage {
    uint64_t anchored, waiting, joined, apart;
} coverage;

static tl_nav_offmesh random_link(const edited *e, test_random *random)
{
    float side = (float)(TILES * e->level.tile_cells * FIXTURE_STEP) * e->level.cell_size;
    tl_vec3 low = tl_sub(e->level.origin, tl_vec3_make(1, 2, 1));
    tl_vec3 high = tl_add(e->level.origin, tl_vec3_make(side + 1, 4, side + 1));
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = test_random_point(random, low, high);
    link.end = test_random_point(random, low, high);
    link.radius = test_random_range(random, 0.5f, 4.0f);
    link.both_ways = test_random_below(random, 2) == 0;
    link.cost_factor = test_random_below(random, 4) == 0 ? 0.5f : 1.0f;
    return link;
}

static void edit_links(edited *e, test_random *random)
{
    if (e->link_count < MAX_LINKS && (e->link_count < 6 || test_random_below(random, 2) == 0)) {
        e->offmesh[e->link_count] = random_link(e, random);
        TEST_RESULT(tl_navmesh_add_offmesh(e->navmesh, &e->offmesh[e->link_count], &e->links[e->link_count], NULL),
                    TL_OK);
        e->link_count++;
        return;
    }
    uint32_t i = test_random_below(random, e->link_count);
    tl_nav_ref gone = e->links[i];
    TEST_RESULT(tl_navmesh_remove_offmesh(e->navmesh, gone), TL_OK);
    TEST_RESULT(tl_navmesh_remove_offmesh(e->navmesh, gone), TL_ERR_STALE);
    e->links[i] = e->links[--e->link_count];
    e->offmesh[i] = e->offmesh[e->link_count];
}

// Tiles in row order, links afterwards.
static tl_navmesh *build_afresh(const edited *e, tl_nav_ref links_out[MAX_LINKS])
{
    tl_navmesh *navmesh = fixture_build_present(&e->level, TILES, e->present[0]);
    for (uint32_t i = 0; i < e->link_count; i++) {
        TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &e->offmesh[i], &links_out[i], NULL), TL_OK);
    }
    return navmesh;
}

static void check_links(const edited *e, coverage *seen)
{
    tl_nav_ref links[MAX_LINKS];
    tl_navmesh *fresh = build_afresh(e, links);
    TEST_CHECK(tl_navmesh_offmesh_count(e->navmesh) == e->link_count);
    TEST_CHECK(tl_navmesh_link_count(e->navmesh) == tl_navmesh_link_count(fresh));
    for (uint32_t i = 0; i < e->link_count; i++) {
        tl_nav_offmesh_state own, expected;
        TEST_RESULT(tl_navmesh_offmesh_state(e->navmesh, e->links[i], &own), TL_OK);
        TEST_RESULT(tl_navmesh_offmesh_state(fresh, links[i], &expected), TL_OK);
        TEST_CHECK(own.anchored == expected.anchored && own.length == expected.length && own.cost == expected.cost);
        for (int end = 0; end < 2; end++) {
            TEST_CHECK((own.ends[end].polygon == TL_NAV_NO_REF) == (expected.ends[end].polygon == TL_NAV_NO_REF));
            TEST_CHECK(tl_distance(own.ends[end].point, expected.ends[end].point) == 0.0f);
        }
        seen->anchored += own.anchored;
        seen->waiting += !own.anchored;
    }
    uint32_t cursor = 0, count = 0;
    tl_nav_ref link;
    while (tl_navmesh_next_offmesh(e->navmesh, &cursor, &link)) {
        count++;
    }
    TEST_CHECK(count == e->link_count && link == TL_NAV_NO_REF);
    tl_navmesh_destroy(fresh);
}

static void lower(uint32_t *label, uint32_t i, uint32_t j, bool *changed)
{
    uint32_t least = label[i] < label[j] ? label[i] : label[j];
    *changed = *changed || label[i] != label[j];
    label[i] = label[j] = least;
}

// Labels of what hangs together, by sinking until neighbours agree.
static void check_islands(const edited *e, coverage *seen)
{
    fixture_refs all = fixture_all_refs(e->navmesh);
    uint32_t *label = calloc(2 * all.count + 2u, sizeof *label);
    uint32_t *island = label + all.count + 1;
    for (uint32_t i = 0; i < all.count; i++) {
        label[i] = i;
        TEST_RESULT(tl_navmesh_island(e->navmesh, all.refs[i], &island[i]), TL_OK);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t i = 0; i < all.count; i++) {
            tl_nav_link links[64];
            uint32_t count = 0;
            TEST_RESULT(tl_navmesh_links(e->navmesh, all.refs[i], links, 64, &count), TL_OK);
            for (uint32_t k = 0; k < count; k++) {
                lower(label, i, fixture_index_of(&all, links[k].to), &changed);
            }
        }
        for (uint32_t k = 0; k < e->link_count; k++) {
            tl_nav_offmesh_state state;
            TEST_RESULT(tl_navmesh_offmesh_state(e->navmesh, e->links[k], &state), TL_OK);
            if (state.anchored) {
                lower(label, fixture_index_of(&all, state.ends[0].polygon),
                      fixture_index_of(&all, state.ends[1].polygon), &changed);
            }
        }
    }
    for (uint32_t i = 0; i < all.count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            TEST_CHECK((label[i] == label[j]) == (island[i] == island[j]));
            seen->joined += label[i] == label[j];
            seen->apart += label[i] != label[j];
        }
    }
    free(all.refs);
    free(label);
}

static void test_edits(void **state)
{
    (void)state;
    test_random random = { 4711 };
    coverage seen;
    memset(&seen, 0, sizeof seen);
    for (uint32_t round = 0; round < 4; round++) {
        edited e;
        memset(&e, 0, sizeof e);
        e.level = fixture_random(&random, 1 + round, TILES * 3);
        e.level.tile_cells = 3;
        TEST_RESULT(tl_navmesh_create(NULL, &e.navmesh), TL_OK);
        for (uint32_t edit = 0; edit < EDITS / 4; edit++) {
            // The first links stand before the first tile does.
            if (edit < 4 || test_random_below(&random, 2) == 0) {
                edit_links(&e, &random);
            } else {
                // Tiles go less often than they come.
                uint32_t x = test_random_below(&random, TILES), z = test_random_below(&random, TILES);
                if (!e.present[z][x] || test_random_below(&random, 3) == 0) {
                    fixture_toggle_tile(&e.level, e.navmesh, x, z, &e.present[z][x]);
                }
            }
            check_links(&e, &seen);
            check_islands(&e, &seen);
        }
        tl_navmesh_destroy(e.navmesh);
    }
    TEST_CHECK(seen.anchored > 1000 && seen.waiting > 1000 && seen.joined > 10000 && seen.apart > 10000);
}

static void test_arguments(void **state)
{
    (void)state;
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    tl_nav_ref link;
    tl_nav_offmesh offmesh = tl_default_nav_offmesh();
    offmesh.end.z = NAN;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &link, NULL), TL_ERR_NOT_FINITE);
    offmesh = tl_default_nav_offmesh();
    offmesh.cost_factor = -1.0f;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &link, NULL), TL_ERR_ARGUMENT);
    offmesh = tl_default_nav_offmesh();
    offmesh.flags = 0;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &link, NULL), TL_ERR_ARGUMENT);
    TEST_CHECK(link == TL_NAV_NO_REF && tl_navmesh_offmesh_count(navmesh) == 0);
    tl_nav_offmesh_state asked;
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, 77, &asked), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_remove_offmesh(navmesh, TL_NAV_NO_REF), TL_ERR_STALE);
    // A reference is no polygon's, and names nothing any more once its link is gone, though the place is used again.
    offmesh = tl_default_nav_offmesh();
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &link, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_resolve(navmesh, link, NULL, NULL), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_remove_offmesh(navmesh, link | TL_NAV_OFFMESH_BACKWARD), TL_OK);
    tl_nav_ref second;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &offmesh, &second, NULL), TL_OK);
    TEST_CHECK(second != link);
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, link, &asked), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, second, &asked), TL_OK);
    TEST_CHECK(!asked.anchored && asked.offmesh.radius == offmesh.radius);
    tl_navmesh_destroy(navmesh);
}

// Out of memory at each allocation in turn: nothing is changed, nothing leaks.
static void test_failing_memory(void **state)
{
    (void)state;
    const char *const rows[] = { "0000", "0000" };
    fixture_level level = fixture_make(rows, 2);
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    bool failed = true;
    uint64_t refused = 0;
    for (uint64_t fail_at = 1; failed; fail_at++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        tl_navmesh *navmesh;
        TEST_RESULT(tl_navmesh_create(&memory.allocator, &navmesh), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
        memory.calls = 0;
        memory.fail_at = fail_at;
        failed = false;
        tl_nav_offmesh offmesh = tl_default_nav_offmesh();
        offmesh.start = tl_vec3_make(1, 0, 1);
        offmesh.end = tl_vec3_make(14, 0, 6);
        for (uint32_t i = 0; i < 40 && !failed; i++) {
            tl_nav_ref link;
            tl_result result = tl_navmesh_add_offmesh(navmesh, &offmesh, &link, NULL);
            failed = result != TL_OK;
            TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
            TEST_CHECK(tl_navmesh_offmesh_count(navmesh) == i + (failed ? 0 : 1));
        }
        refused += failed;
        tl_navmesh_destroy(navmesh);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(refused > 5);
    tl_blob_free(tile);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edits), cmocka_unit_test(test_arguments),
                                        cmocka_unit_test(test_failing_memory) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
