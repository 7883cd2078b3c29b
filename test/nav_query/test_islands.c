// SPDX-License-Identifier: MIT
//
// Islands, and the rings that searches run on, under edits: tiles and off-mesh links come and go at random, and after
// each the islands are those of a flood over the links, and paths those of a navmesh that was built afresh. A number
// makes that many times as many edits.

#include "nav_fixture.h"

#include "nav_query/navmesh/navmesh.h"

#include <math.h>
#include <stdlib.h>

enum { TILES = 5, MAX_LINKS = 12 };

static uint32_t times = 1;

typedef struct edited {
    fixture_level level;
    tl_navmesh *navmesh;
    bool present[TILES][TILES];
    tl_nav_ref links[MAX_LINKS];
    uint32_t link_count;
} edited;

// Tiles in row order.
static tl_navmesh *build_afresh(const edited *e)
{
    return fixture_build_present(&e->level, TILES, e->present[0]);
}

static bool sink(uint32_t *label, uint32_t i, uint32_t j)
{
    bool changes = label[i] != label[j];
    label[i] = label[j] = label[i] < label[j] ? label[i] : label[j];
    return changes;
}

static bool sink_over_links(const tl_navmesh *navmesh, const fixture_refs *all, uint32_t *label)
{
    bool changed = false;
    tl_nav_ref link;
    for (uint32_t cursor = 0; tl_navmesh_next_offmesh(navmesh, &cursor, &link);) {
        tl_nav_offmesh_state state;
        TEST_RESULT(tl_navmesh_offmesh_state(navmesh, link, &state), TL_OK);
        if (state.anchored) {
            bool sinks =
                sink(label, fixture_index_of(all, state.ends[0].polygon), fixture_index_of(all, state.ends[1].polygon));
            changed = changed || sinks;
        }
    }
    return changed;
}

// Labels of what hangs together, by sinking until neighbours agree.
static uint32_t *flood(const tl_navmesh *navmesh, const fixture_refs *all)
{
    uint32_t *label = calloc(all->count + 1u, sizeof *label);
    for (uint32_t i = 0; i < all->count; i++) {
        label[i] = i;
    }
    for (bool changed = true; changed;) {
        changed = sink_over_links(navmesh, all, label);
        for (uint32_t i = 0; i < all->count; i++) {
            tl_nav_link links[64];
            uint32_t count = 0;
            TEST_RESULT(tl_navmesh_links(navmesh, all->refs[i], links, 64, &count), TL_OK);
            for (uint32_t k = 0; k < count; k++) {
                bool sinks = sink(label, i, fixture_index_of(all, links[k].to));
                changed = changed || sinks;
            }
        }
    }
    return label;
}

static void check_islands(const tl_navmesh *navmesh, uint64_t *same_out, uint64_t *apart_out)
{
    fixture_refs all = fixture_all_refs(navmesh);
    uint32_t *label = flood(navmesh, &all);
    uint32_t *island = calloc(all.count + 1u, sizeof *island);
    for (uint32_t i = 0; i < all.count; i++) {
        TEST_RESULT(tl_navmesh_island(navmesh, all.refs[i], &island[i]), TL_OK);
        for (uint32_t j = 0; j < i; j++) {
            TEST_CHECK((label[i] == label[j]) == (island[i] == island[j]));
            *same_out += label[i] == label[j];
            *apart_out += label[i] != label[j];
        }
    }
    free(all.refs);
    free(label);
    free(island);
}

static void check_paths(const edited *e, tl_nav_query *query, test_random *random, uint64_t *complete_out)
{
    tl_navmesh *fresh = build_afresh(e);
    fixture_refs all = fixture_all_refs(fresh);
    for (uint32_t i = 0; i < 10 && all.count > 0; i++) {
        tl_nav_location a = fixture_random_location(fresh, &all, random), c;
        tl_nav_location b = fixture_random_location(fresh, &all, random), d;
        tl_vec3 near_by = tl_vec3_make(0.001f, 0.1f, 0.001f);
        TEST_RESULT(tl_navmesh_find_nearest(e->navmesh, NULL, a.point, near_by, &c), TL_OK);
        TEST_RESULT(tl_navmesh_find_nearest(e->navmesh, NULL, b.point, near_by, &d), TL_OK);
        tl_nav_shortest_path expected, found;
        TEST_RESULT(
            tl_nav_query_find_shortest_path(query, fresh, &(tl_nav_path_request){ NULL, a, b }, NULL, &expected),
            TL_OK);
        TEST_RESULT(
            tl_nav_query_find_shortest_path(query, e->navmesh, &(tl_nav_path_request){ NULL, c, d }, NULL, &found),
            TL_OK);
        TEST_CHECK(expected.status == found.status);
        TEST_CHECK(fabs(expected.length - found.length) <= 1e-5 * (1.0 + expected.length));
        *complete_out += found.status == TL_NAV_PATH_COMPLETE;
    }
    free(all.refs);
    tl_navmesh_destroy(fresh);
}

// A link between two random places, or away with one. Some ends stand on nothing until a tile comes.
static void toggle_link(edited *e, test_random *random)
{
    if (e->link_count == MAX_LINKS || (e->link_count > 0 && test_random_below(random, 2) == 0)) {
        uint32_t i = test_random_below(random, e->link_count);
        TEST_RESULT(tl_navmesh_remove_offmesh(e->navmesh, e->links[i]), TL_OK);
        e->links[i] = e->links[--e->link_count];
        return;
    }
    float side = (float)(TILES * e->level.tile_cells * FIXTURE_STEP) * e->level.cell_size;
    tl_vec3 low = tl_sub(e->level.origin, tl_vec3_make(0, 1, 0));
    tl_vec3 high = tl_add(e->level.origin, tl_vec3_make(side, 3, side));
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = test_random_point(random, low, high);
    link.end = test_random_point(random, low, high);
    link.radius = test_random_range(random, 0.5f, 4.0f);
    link.both_ways = test_random_below(random, 2) == 0;
    TEST_RESULT(tl_navmesh_add_offmesh(e->navmesh, &link, &e->links[e->link_count++], NULL), TL_OK);
}

static void test_edits_with_links(void **state)
{
    (void)state;
    test_random random = { 82 };
    uint64_t same = 0, apart = 0, anchored = 0;
    for (uint32_t round = 0; round < 12; round++) {
        edited e;
        memset(&e, 0, sizeof e);
        // Many small parts, so that links join what seams do not.
        e.level = fixture_random(&random, round % 2 == 0 ? 1 : 4, TILES * 2);
        e.level.tile_cells = 2;
        TEST_RESULT(tl_navmesh_create(NULL, &e.navmesh), TL_OK);
        for (uint32_t edit = 0; edit < 200 * times; edit++) {
            uint32_t x = test_random_below(&random, TILES), z = test_random_below(&random, TILES);
            if (test_random_below(&random, 2) == 0) {
                toggle_link(&e, &random);
            } else if (edit >= 40 || !e.present[z][x]) {
                fixture_toggle_tile(&e.level, e.navmesh, x, z, &e.present[z][x]);
            }
            check_islands(e.navmesh, &same, &apart);
            for (uint32_t i = 0; i < e.link_count; i++) {
                tl_nav_offmesh_state link;
                TEST_RESULT(tl_navmesh_offmesh_state(e.navmesh, e.links[i], &link), TL_OK);
                anchored += link.anchored;
            }
        }
        tl_navmesh_destroy(e.navmesh);
    }
    TEST_CHECK(same > 10000 && apart > 10000 && anchored > 1000);
}

static void test_edits(void **state)
{
    (void)state;
    test_random random = { 81 };
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint64_t same = 0, apart = 0, complete = 0;
    for (uint32_t round = 0; round < 6; round++) {
        edited e;
        memset(&e, 0, sizeof e);
        e.level = fixture_random(&random, round, TILES * 2);
        e.level.tile_cells = 2;
        TEST_RESULT(tl_navmesh_create(NULL, &e.navmesh), TL_OK);
        for (uint32_t edit = 0; edit < 120 * times; edit++) {
            // Grow first, then come and go.
            uint32_t x = test_random_below(&random, TILES), z = test_random_below(&random, TILES);
            if (edit >= 30 || !e.present[z][x]) {
                fixture_toggle_tile(&e.level, e.navmesh, x, z, &e.present[z][x]);
            }
            check_islands(e.navmesh, &same, &apart);
            if (edit % 8 == 7) {
                check_paths(&e, query, &random, &complete);
            }
        }
        tl_navmesh_destroy(e.navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(same > 10000 && apart > 10000 && complete > 200);
}

// An unreachable goal is known without a search.
static void test_cut_off(void **state)
{
    (void)state;
    const char *const rows[] = { "00#00", "00#00" };
    fixture_level level = fixture_make(rows, 2);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = { 2, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_location start = { all.refs[0], { 1, 0, 1 } }, goal = { all.refs[all.count - 1], { 19, 0, 7 } };
    tl_nav_ref polygons[2];
    tl_nav_path path;
    tl_nav_shortest_path shortest;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, polygons, 2, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_UNREACHABLE && path.node_count == 0 && path.polygon_count == 1);
    TEST_CHECK(polygons[0] == start.polygon && path.end.polygon == start.polygon);
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &shortest),
        TL_OK);
    TEST_CHECK(shortest.status == TL_NAV_PATH_UNREACHABLE && shortest.node_count == 0);
    uint32_t island;
    TEST_RESULT(tl_navmesh_island(navmesh, 77, &island), TL_ERR_STALE);
    free(all.refs);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// The nearest point of an island against all its polygons: in one tile of few, of some and of hundreds of components,
// and in tiles.
static void nearest_reachable_is_that_of_all_polygons(void **state)
{
    (void)state;
    test_random random = { 9 };
    uint32_t most_components = 0, elsewhere = 0;
    for (uint32_t i = 0; i < 12; i++) {
        fixture_level level = fixture_make((const char *const[]){ "0" }, 1);
        level.width = level.height = 12 + 16 * (i % 4);
        level.tile_cells = i < 6 ? 0 : 9;
        for (uint32_t k = 0; k < level.width * level.height; k++) {
            level.cells[k / level.width][k % level.width] = test_random_below(&random, 100) < 58 ? '#' : '0';
        }
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
            const uint32_t count = navmesh->slots[slot].rings.component_count;
            most_components = count > most_components ? count : most_components;
        }
        for (uint32_t k = 0; k < 40; k++) {
            const tl_nav_location from = fixture_random_location(navmesh, &all, &random);
            tl_vec3 point = fixture_random_location(navmesh, &all, &random).point;
            point.x += k % 5 == 0 ? 1000.0f : 0.0f; // outside of all tiles
            tl_nav_location found;
            TEST_RESULT(tl_navmesh_find_nearest_reachable(navmesh, NULL, from.polygon, point, &found), TL_OK);
            uint32_t island = 0;
            TEST_RESULT(tl_navmesh_island(navmesh, from.polygon, &island), TL_OK);
            float best = INFINITY;
            for (uint32_t p = 0; p < all.count; p++) {
                uint32_t of_polygon = 0;
                TEST_RESULT(tl_navmesh_island(navmesh, all.refs[p], &of_polygon), TL_OK);
                if (of_polygon == island) {
                    tl_vec3 closest;
                    TEST_RESULT(tl_navmesh_closest_point(navmesh, all.refs[p], point, &closest, NULL), TL_OK);
                    const float distance = tl_distance_sq(closest, point);
                    best = distance < best ? distance : best;
                }
            }
            uint32_t of_found = 0;
            TEST_RESULT(tl_navmesh_island(navmesh, found.polygon, &of_found), TL_OK);
            TEST_CHECK(of_found == island && tl_distance_sq(found.point, point) == best);
            elsewhere += best > 0.0f;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    print_message("up to %u components a tile, %u of 480 points elsewhere\n", most_components, elsewhere);
    TEST_CHECK(most_components > 256 && elsewhere > 240);
}

int main(int argc, char **argv)
{
    times = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 1;
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edits), cmocka_unit_test(test_edits_with_links),
                                        cmocka_unit_test(test_cut_off),
                                        cmocka_unit_test(nearest_reachable_is_that_of_all_polygons) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
