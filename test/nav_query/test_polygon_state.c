// SPDX-License-Identifier: MIT
//
// Flags and areas that change at run time: every query answers as on a navmesh whose tiles were so from the start, a
// prepared one too; what a change leaves alone; how long it lasts.

#include "nav_fixture.h"

#include "nav_query/navmesh/navmesh.h"

#include <talus/nav_detour.h>
#include <talus/nav_prepare.h>
#include <talus/nav_state.h>

enum { MAX_POLYGONS = 1024 };

// A copy of the tiles as they are now, whose polygons keep their order; references differ.
typedef struct twin {
    tl_navmesh *navmesh;
    void *tiles[64];
    uint32_t count;
} twin;

static twin make_twin(const tl_navmesh *navmesh)
{
    twin t;
    memset(&t, 0, sizeof t);
    TEST_RESULT(tl_navmesh_create(NULL, &t.navmesh), TL_OK);
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile != NULL) {
            void *copy = test_blob_alloc(tile->blob.size);
            memcpy(copy, tile, tile->blob.size);
            TEST_RESULT(tl_nav_tile_check(copy, tile->blob.size, NULL), TL_OK);
            TEST_RESULT(tl_navmesh_add_tile(t.navmesh, copy, TL_NAV_TILE_BORROWED), TL_OK);
            TEST_CHECK(t.count < 64);
            t.tiles[t.count++] = copy;
        }
    }
    return t;
}

static void free_twin(twin *t)
{
    tl_navmesh_destroy(t->navmesh);
    for (uint32_t i = 0; i < t->count; i++) {
        test_blob_free(t->tiles[i]);
    }
}

// The same polygon of the twin.
static tl_nav_location across(const tl_navmesh *navmesh, const twin *t, tl_nav_location location)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, location.polygon, &tile, &polygon), TL_OK);
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(t->navmesh); slot++) {
        const tl_nav_tile *other = tl_navmesh_slot_tile(t->navmesh, slot);
        if (other != NULL && other->tile_x == tile->tile_x && other->tile_z == tile->tile_z) {
            location.polygon = tl_navmesh_polygon_ref(t->navmesh, slot, polygon);
        }
    }
    return location;
}

typedef struct counts {
    uint32_t reached, refused, dear, hits, walls;
} counts;

static void compare_paths(tl_nav_query *query, const tl_navmesh *navmesh, const twin *t, const tl_nav_filter *filter,
                          const tl_nav_location ends[2], counts *n)
{
    static tl_nav_ref polygons[2][MAX_POLYGONS];
    const tl_nav_location far[2] = { across(navmesh, t, ends[0]), across(navmesh, t, ends[1]) };
    tl_nav_path a, b;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ filter, ends[0], ends[1] }, polygons[0],
                                       MAX_POLYGONS, &a),
                TL_OK);
    TEST_RESULT(tl_nav_query_find_path(query, t->navmesh, &(tl_nav_path_request){ filter, far[0], far[1] }, polygons[1],
                                       MAX_POLYGONS, &b),
                TL_OK);
    TEST_CHECK(a.status == b.status);
    TEST_CHECK(fabsf(a.cost - b.cost) <= 1e-4f * (1.0f + b.cost));
    n->reached += a.status == TL_NAV_PATH_COMPLETE;
    n->refused += a.status == TL_NAV_PATH_UNREACHABLE;
    tl_nav_shortest_path s, u;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ filter, ends[0], ends[1] }, NULL, &s),
        TL_OK);
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, t->navmesh, &(tl_nav_path_request){ filter, far[0], far[1] }, NULL, &u),
        TL_OK);
    TEST_CHECK(s.status == u.status && fabs(s.length - u.length) <= 1e-5 * (1.0 + u.length));
    n->dear += a.status == TL_NAV_PATH_COMPLETE && (double)a.cost > 1.01 * s.length;
}

static void compare_surface(tl_nav_query *query, const tl_navmesh *navmesh, const twin *t, const tl_nav_filter *filter,
                            const tl_nav_location ends[2], counts *n)
{
    const tl_nav_location far = across(navmesh, t, ends[0]);
    tl_nav_ray_hit ray[2];
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, filter, &ends[0], ends[1].point, NULL, 0, &ray[0]), TL_OK);
    TEST_RESULT(tl_navmesh_cast_ray(t->navmesh, filter, &far, ends[1].point, NULL, 0, &ray[1]), TL_OK);
    TEST_CHECK(ray[0].hit == ray[1].hit && ray[0].t == ray[1].t);
    n->hits += ray[0].hit;
    tl_nav_wall wall[2];
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ filter, ends[0], 3.0f }, &wall[0]),
                TL_OK);
    TEST_RESULT(tl_nav_query_find_wall(query, t->navmesh, &(tl_nav_around_request){ filter, far, 3.0f }, &wall[1]),
                TL_OK);
    TEST_CHECK(wall[0].hit == wall[1].hit && wall[0].distance == wall[1].distance);
    n->walls += wall[0].hit;
    tl_nav_move move[2];
    TEST_RESULT(tl_nav_query_move_along_surface(
                    query, navmesh, &(tl_nav_move_request){ filter, ends[0], ends[1].point }, NULL, 0, &move[0]),
                TL_OK);
    TEST_RESULT(tl_nav_query_move_along_surface(query, t->navmesh, &(tl_nav_move_request){ filter, far, ends[1].point },
                                                NULL, 0, &move[1]),
                TL_OK);
    TEST_CHECK(memcmp(&move[0].end.point, &move[1].end.point, sizeof move[0].end.point) == 0);
    tl_nav_location nearest[2];
    const tl_vec3 half = tl_vec3_make(2, 2, 2);
    const tl_result found = tl_navmesh_find_nearest(navmesh, filter, ends[1].point, half, &nearest[0]);
    TEST_RESULT(tl_navmesh_find_nearest(t->navmesh, filter, ends[1].point, half, &nearest[1]), found);
    TEST_CHECK(memcmp(&nearest[0].point, &nearest[1].point, sizeof nearest[0].point) == 0);
}

static tl_nav_filter filter_of(uint32_t kind)
{
    tl_nav_filter filter = tl_default_nav_filter();
    for (int area = 0; kind == 1 && area <= TL_NAV_MAX_AREA; area++) {
        filter.area_cost[area] = 1.0f + (float)(area % 5);
    }
    filter.exclude_flags = kind == 2 ? 4 : 0;
    return filter;
}

static void change_some(tl_navmesh *navmesh, const fixture_refs *all, test_random *random)
{
    static const uint64_t flags[] = { 1, 3, 5, 0, UINT64_MAX, (uint64_t)1 << 63 | 1 };
    for (uint32_t i = 0; i < 1 + all->count / 6; i++) {
        const tl_nav_ref ref = all->refs[test_random_below(random, all->count)];
        const uint64_t f = flags[test_random_below(random, 6)];
        const uint8_t area = (uint8_t)(1 + test_random_below(random, TL_NAV_MAX_AREA));
        uint64_t got_flags = 0;
        uint8_t got_area = 0;
        TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, ref, f), TL_OK);
        TEST_RESULT(tl_navmesh_set_polygon_area(navmesh, ref, area), TL_OK);
        TEST_RESULT(tl_navmesh_polygon_flags(navmesh, ref, &got_flags), TL_OK);
        TEST_RESULT(tl_navmesh_polygon_area(navmesh, ref, &got_area), TL_OK);
        TEST_CHECK(got_flags == f && got_area == area);
    }
}

static void check_counts(const tl_navmesh *navmesh, const fixture_refs *all)
{
    uint64_t every = UINT64_MAX, any = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        uint64_t flags = 0;
        TEST_RESULT(tl_navmesh_polygon_flags(navmesh, all->refs[i], &flags), TL_OK);
        every &= flags;
        any |= flags;
    }
    TEST_CHECK(navmesh->flags.all_flags == every && navmesh->flags.any_flags == any);
}

static void test_queries_see_changes(void **state)
{
    (void)state;
    test_random random = { 1409 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    counts n = { 0 };
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        if (round % 2 == 0) {
            TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
        }
        const bool was_prepared = tl_navmesh_is_prepared(navmesh);
        for (uint32_t change = 0; change < 3; change++) {
            change_some(navmesh, &all, &random);
            check_counts(navmesh, &all);
            TEST_CHECK(tl_navmesh_is_prepared(navmesh) == was_prepared);
            twin t = make_twin(navmesh);
            for (uint32_t i = 0; i < 24; i++) {
                const tl_nav_filter filter = filter_of(i % 3);
                const tl_nav_filter *used = i % 4 == 3 ? NULL : &filter;
                const tl_nav_location ends[2] = { fixture_random_location(navmesh, &all, &random),
                                                  fixture_random_location(navmesh, &all, &random) };
                compare_paths(query, navmesh, &t, used, ends, &n);
                compare_surface(query, navmesh, &t, used, ends, &n);
            }
            free_twin(&t);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(n.reached > 300 && n.refused > 100 && n.dear > 30 && n.hits > 300 && n.walls > 300);
}

// After a door was shut and opened, a prepared navmesh answers by its graph again.
static void test_graph_comes_back(void **state)
{
    (void)state;
    test_random random = { 77 };
    fixture_level level = fixture_random(&random, 0, 8);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh) && tl_nav_all_pass(navmesh, NULL));
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, all.refs[0], 0), TL_OK);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh) && !tl_nav_all_pass(navmesh, NULL));
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, all.refs[0], 1), TL_OK);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh) && tl_nav_all_pass(navmesh, NULL));
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

static void test_sliced_search_is_stale(void **state)
{
    (void)state;
    test_random random = { 78 };
    fixture_level level = fixture_random(&random, 0, 8);
    level.tile_cells = 3;
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    const tl_nav_location start = fixture_random_location(navmesh, &all, &random);
    const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
    tl_nav_path_progress progress;
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }), TL_OK);
    TEST_RESULT(tl_navmesh_set_polygon_area(navmesh, start.polygon, 9), TL_OK);
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_OK);
    TEST_CHECK(progress.status == TL_NAV_PATH_STALE);
    // The same value again is no change.
    TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }), TL_OK);
    TEST_RESULT(tl_navmesh_set_polygon_area(navmesh, start.polygon, 9), TL_OK);
    TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_OK);
    TEST_CHECK(progress.status != TL_NAV_PATH_STALE);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
    tl_nav_query_destroy(query);
}

// Anchors depend on the tiles alone: a link to a polygon that nobody may enter stays there, and is of use again later.
static void test_anchors_stay(void **state)
{
    (void)state;
    tl_nav_ref link = TL_NAV_NO_REF, second = TL_NAV_NO_REF;
    tl_navmesh *navmesh = fixture_gap(&link);
    tl_nav_offmesh_state before, after;
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, link, &before), TL_OK);
    TEST_CHECK(before.anchored);
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, before.ends[1].polygon, 0), TL_OK);
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, link, &after), TL_OK);
    TEST_CHECK(after.anchored && after.ends[1].polygon == before.ends[1].polygon);
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &before.offmesh, &second, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_offmesh_state(navmesh, second, &after), TL_OK);
    TEST_CHECK(after.ends[1].polygon == before.ends[1].polygon);
    tl_nav_query *query = NULL;
    tl_nav_path path;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    const tl_nav_path_request request = { NULL, before.ends[0], before.ends[1] };
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &path), TL_INCOMPLETE);
    TEST_CHECK(path.status == TL_NAV_PATH_UNREACHABLE);
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, before.ends[1].polygon, 1), TL_OK);
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, NULL, 0, &path), TL_INCOMPLETE);
    TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

static tl_nav_tile_stack stack_of(const tl_nav_tile *tile)
{
    tl_nav_tile_stack stack;
    uint32_t *layers = calloc(tile->polygon_count, sizeof *layers);
    TEST_RESULT(tl_nav_tile_divide(tile, layers, NULL, &stack, NULL), TL_OK);
    free(layers);
    return stack;
}

static void test_how_long_changes_last(void **state)
{
    (void)state;
    test_random random = { 79 };
    fixture_level level = fixture_random(&random, 0, 8);
    level.area_count = 5; // Detour's are 63 at most
    tl_nav_tile *drawn = fixture_build_tile(&level, 0, 0, NULL);
    TEST_CHECK(drawn != NULL);
    tl_nav_tile_stack whole = stack_of(drawn); // without the drawing's unused vertices, as rebaked bytes are
    const tl_nav_tile *tile = whole.tiles[0];
    void *bytes = malloc(tile->blob.size);
    memcpy(bytes, tile, tile->blob.size);
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
    const tl_nav_ref first = tl_navmesh_polygon_ref(navmesh, 0, 0);
    uint64_t flags = 0;
    uint8_t area = 0;
    TEST_CHECK(!tl_navmesh_is_state_changed(navmesh, 0, 0, 0));
    TEST_RESULT(tl_navmesh_set_polygon_flags(navmesh, first, 6), TL_OK);
    TEST_RESULT(tl_navmesh_set_polygon_area(navmesh, first, 7), TL_OK);
    TEST_CHECK(tl_navmesh_is_state_changed(navmesh, 0, 0, 0));
    TEST_CHECK(memcmp(bytes, tile, tile->blob.size) == 0); // a mapped file stays as it is

    // Replaced by the same bytes: reference and change stay.
    tl_nav_tile_stack same = stack_of(tile);
    TEST_RESULT(tl_navmesh_replace_tiles(navmesh, 0, 0, &same), TL_OK);
    TEST_RESULT(tl_navmesh_polygon_flags(navmesh, first, &flags), TL_OK);
    TEST_CHECK(flags == 6 && tl_navmesh_find_tile(navmesh, 0, 0) != tile);

    // Stored, taken out, put in again: as it was baked; restored: as it was.
    tl_nav_polygon_state *states = calloc(tile->polygon_count, sizeof *states);
    uint32_t count = 0;
    TEST_RESULT(tl_navmesh_store_state(navmesh, 0, 0, 0, states, tile->polygon_count, &count), TL_OK);
    TEST_CHECK(count == tile->polygon_count && states[0].flags == 6 && states[0].area == 7);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
    TEST_RESULT(tl_navmesh_polygon_flags(navmesh, first, &flags), TL_ERR_STALE);
    TEST_CHECK(flags == 0);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
    const tl_nav_ref again = tl_navmesh_polygon_ref(navmesh, 0, 0);
    TEST_RESULT(tl_navmesh_polygon_flags(navmesh, again, &flags), TL_OK);
    TEST_CHECK(flags == 1 && !tl_navmesh_is_state_changed(navmesh, 0, 0, 0));
    tl_report report;
    TEST_RESULT(tl_navmesh_restore_state(navmesh, 0, 0, 0, states, count - 1, &report), TL_ERR_STALE);
    TEST_CHECK(report.element != NULL && strcmp(report.element, "state") == 0 && report.element_index == count - 1);
    TEST_RESULT(tl_navmesh_restore_state(navmesh, 0, 0, 0, states, count, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_polygon_flags(navmesh, again, &flags), TL_OK);
    TEST_RESULT(tl_navmesh_polygon_area(navmesh, again, &area), TL_OK);
    TEST_CHECK(flags == 6 && area == 7);
    states[count - 1].area = 0;
    TEST_RESULT(tl_navmesh_restore_state(navmesh, 0, 0, 0, states, count, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.element_index == count - 1);

    // Detour's data has the flags and areas of now.
    const tl_nav_tile *now = tl_navmesh_find_tile(navmesh, 0, 0);
    TEST_RESULT(tl_navmesh_set_polygon_area(navmesh, again, 33), TL_OK);
    const uint64_t size = tl_detour_set_size(&now, 1, TL_DETOUR_REFS_32);
    void *detour = malloc(size);
    TEST_RESULT(tl_detour_set_write(&now, 1, TL_DETOUR_REFS_32, detour, size, NULL), TL_OK);
    tl_detour_tiles read;
    TEST_RESULT(tl_detour_read(detour, size, NULL, &read, NULL), TL_OK);
    TEST_CHECK(tl_nav_tile_flags(read.tiles[0], 0) == 6 && tl_nav_tile_area(read.tiles[0], 0) == 33);
    tl_detour_tiles_free(&read);
    free(detour);

    TEST_RESULT(tl_navmesh_reset_state(navmesh, 0, 0, 0), TL_OK);
    TEST_CHECK(tl_navmesh_find_tile(navmesh, 0, 0) == tile && navmesh->flags.all_flags == 1);
    free(states);
    free(bytes);
    tl_navmesh_destroy(navmesh);
    tl_nav_tile_stack_free(&whole);
    tl_blob_free(drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_queries_see_changes),    cmocka_unit_test(test_graph_comes_back),
        cmocka_unit_test(test_sliced_search_is_stale), cmocka_unit_test(test_anchors_stay),
        cmocka_unit_test(test_how_long_changes_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
