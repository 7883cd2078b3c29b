// SPDX-License-Identifier: MIT
//
// Cover against a search through all places of the grid.

#include "nav_audit_level.h"

#include <math.h>
#include <string.h>
#include <talus/nav_sight.h>

typedef struct yard {
    test_level level;
    tl_navmesh *navmesh;
    tl_soup *soup;
    tl_nav_query *query;
} yard;

static void set_up(yard *y, test_random *random, uint32_t tile_size)
{
    memset(y, 0, sizeof *y);
    audit_floor(&y->level, 0, 0, 30, 30, 0);
    audit_block(&y->level, 20, 2.6f, 4, 28, 2.9f, 12);   // a roof to walk on and under, on which nobody comes
    test_level_box(&y->level, 12, 0, 5, 20, 0, 9, 2.9f); // but up this ramp
    for (int i = 0; i < 8; i++) {
        const float x = test_random_range(random, 1, 26), z = test_random_range(random, 13, 26);
        const float wide = test_random_range(random, 0.5f, 4), deep = test_random_range(random, 0.5f, 4);
        audit_block(&y->level, x, 0, z, x + wide, i % 3 == 0 ? 1.2f : 3.0f, z + deep);
    }
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    const tl_nav_input input = { y->level.mesh, NULL, NULL, 0 };
    y->navmesh = test_nav_bake(&def, &input);
    y->soup = audit_soup(&y->level);
    const tl_nav_query_def query_def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&query_def, &y->query, NULL), TL_OK);
}

static void tear_down(yard *y)
{
    tl_nav_query_destroy(y->query);
    tl_navmesh_destroy(y->navmesh);
    tl_blob_free(y->soup);
}

static bool is_hidden(const yard *y, tl_vec3 threat, const tl_nav_cover_def *def, tl_vec3 place)
{
    bool hidden = true;
    for (uint32_t i = 0; i < def->height_count; i++) {
        const tl_vec3 part = { place.x, place.y + def->heights[i], place.z };
        hidden = hidden && !tl_soup_line_of_sight(y->soup, threat, part, NULL);
    }
    return hidden;
}

// The length of the path to a place if it is hidden and near enough, else INFINITY.
static float rate(const yard *y, const tl_nav_cover_request *request, const tl_nav_cover_def *def,
                  const tl_nav_location *place)
{
    tl_nav_shortest_path path;
    if (!is_hidden(y, request->threat, def, place->point)) {
        return INFINITY;
    }
    TEST_RESULT(tl_nav_query_find_shortest_path(y->query, y->navmesh,
                                                &(tl_nav_path_request){ NULL, request->agent, *place }, NULL, &path),
                TL_OK);
    const bool near = path.status == TL_NAV_PATH_COMPLETE && (float)path.length <= def->max_length;
    return near ? (float)path.length : INFINITY;
}

static void insert(float *lengths, uint32_t capacity, float length)
{
    for (uint32_t i = 0; i < capacity; i++) {
        if (length < lengths[i]) {
            const float moved = lengths[i];
            lengths[i] = length;
            length = moved;
        }
    }
}

enum { MAX_COVERS = 5 };

// The lengths of the nearest places, by looking at every place of the grid, low and high.
static uint32_t search_all(const yard *y, const tl_nav_cover_request *request, const tl_nav_cover_def *def,
                           float *lengths, uint32_t *upstairs)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i < MAX_COVERS; i++) {
        lengths[i] = INFINITY;
    }
    insert(lengths, MAX_COVERS, rate(y, request, def, &request->agent));
    for (int x = 0; x <= (int)(30.0f / def->spacing); x++) {
        for (int z = 0; z <= (int)(30.0f / def->spacing); z++) {
            for (int floor = 0; floor < 2; floor++) {
                const tl_vec3 at = { (float)x * def->spacing, floor == 0 ? 0.2f : 3.0f, (float)z * def->spacing };
                tl_nav_location place;
                // The ramp's surface lies in between: half of the height belongs to either.
                const tl_vec3 half = { 0.0f, 1.4f, 0.0f };
                if (tl_navmesh_find_nearest(y->navmesh, NULL, at, half, &place) == TL_OK &&
                    (floor == 0) == (place.point.y < 1.6f)) {
                    const float length = rate(y, request, def, &place);
                    insert(lengths, MAX_COVERS, length);
                    *upstairs += floor == 1 && length < INFINITY;
                }
            }
        }
    }
    while (found < MAX_COVERS && lengths[found] < INFINITY) {
        found++;
    }
    return found;
}

static void the_nearest_places_are_found(void **state)
{
    (void)state;
    test_random random = { 31 };
    uint32_t found = 0, none = 0, at_once = 0, upstairs = 0;
    for (int round = 0; round < 30; round++) {
        yard y;
        set_up(&y, &random, round % 2 == 0 ? 0 : 24);
        for (int k = 0; k < 6; k++) {
            const tl_vec3 wish = { test_random_range(&random, 1, 29), 0.2f, test_random_range(&random, 1, 29) };
            tl_nav_location agent;
            if (tl_navmesh_find_nearest(y.navmesh, NULL, wish, tl_vec3_make(2, 1, 2), &agent) != TL_OK) {
                continue;
            }
            const tl_vec3 threat =
                test_random_point(&random, tl_vec3_make(0, 1.5f, 0), tl_vec3_make(30, k % 3 == 0 ? 8.0f : 2.0f, 30));
            const tl_nav_cover_request request = { y.navmesh, y.soup, NULL, agent, threat };
            tl_nav_cover_def def = tl_default_nav_cover_def();
            def.spacing = test_random_range(&random, 1.1f, 2.5f);
            def.max_length = k == 5 ? 3.0f : 25.0f;
            float lengths[MAX_COVERS];
            tl_nav_cover covers[MAX_COVERS];
            uint32_t count;
            const uint32_t expected = search_all(&y, &request, &def, lengths, &upstairs);
            TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, covers, MAX_COVERS, &count), TL_OK);
            assert_int_equal(count, expected);
            for (uint32_t i = 0; i < count; i++) {
                TEST_CHECK(covers[i].length == lengths[i]);
                TEST_CHECK(rate(&y, &request, &def, &covers[i].location) == covers[i].length);
            }
            found += count;
            none += count == 0;
            at_once += count > 0 && covers[0].length == 0.0f;
        }
        tear_down(&y);
    }
    TEST_CHECK(found > 200 && none > 0 && at_once > 5 && upstairs > 50);
}

// A request around the middle of a yard.
static tl_nav_cover_request request_in(const yard *y)
{
    tl_nav_cover_request request = { y->navmesh, y->soup, NULL, { 0, { 0, 0, 0 } }, tl_vec3_make(15, 2, 15) };
    TEST_RESULT(tl_navmesh_find_nearest(y->navmesh, NULL, tl_vec3_make(3, 0, 3), tl_vec3_make(2, 1, 2), &request.agent),
                TL_OK);
    return request;
}

static void an_agent_far_from_the_navmesh_finds_no_cover(void **state)
{
    (void)state;
    test_random random = { 6 };
    yard y;
    set_up(&y, &random, 0);
    tl_nav_cover_request request = request_in(&y);
    tl_nav_cover covers[MAX_COVERS];
    const tl_nav_location on_floor = request.agent;
    const float lifts[] = { 1000.0f, -1000.0f, 1e7f, -1e7f, 3e38f, -3e38f };
    for (int i = 0; i < 6; i++) {
        for (int axis = 0; axis < 3; axis++) {
            uint32_t count = 77;
            request.agent = on_floor;
            (axis == 0   ? &request.agent.point.x
             : axis == 1 ? &request.agent.point.y
                         : &request.agent.point.z)[0] += lifts[i];
            // Its own place is one, where the threat does not see it.
            TEST_RESULT(tl_nav_query_find_cover(y.query, &request, NULL, covers, MAX_COVERS, &count), TL_OK);
            assert_true(count <= 1 && (count == 0 || covers[0].length == 0.0f));
        }
    }
    tear_down(&y);
}

// What is looked at is bounded by the yard of 30 m, whatever the reach is.
static void a_long_reach_costs_no_more_than_the_level(void **state)
{
    (void)state;
    test_random random = { 7 };
    yard y;
    set_up(&y, &random, 0);
    tl_nav_cover_request request = request_in(&y);
    tl_nav_cover_def def = tl_default_nav_cover_def();
    tl_nav_cover expected[MAX_COVERS], covers[MAX_COVERS];
    uint32_t expected_count, count;
    def.max_length = 100.0f;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, expected, MAX_COVERS, &expected_count), TL_OK);
    assert_true(expected_count > 0);
    for (float reach = 1000.0f; reach < 1e38f; reach *= 10.0f) {
        def.max_length = reach;
        TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, covers, MAX_COVERS, &count), TL_OK);
        assert_int_equal(count, expected_count);
        for (uint32_t i = 0; i < count; i++) {
            assert_true(covers[i].length == expected[i].length);
            assert_true(covers[i].location.polygon == expected[i].location.polygon);
        }
        // Hardly any place is hidden from the sky: all are tried.
        tl_nav_cover_request in_view = request;
        in_view.threat = tl_vec3_make(15, 1e4f, 15);
        TEST_RESULT(tl_nav_query_find_cover(y.query, &in_view, &def, covers, MAX_COVERS, &count), TL_OK);
    }
    tear_down(&y);
}

static void more_places_than_the_budget_are_refused(void **state)
{
    (void)state;
    test_random random = { 8 };
    yard y;
    set_up(&y, &random, 0);
    const tl_nav_cover_request request = request_in(&y);
    tl_nav_cover_request in_view = request;
    in_view.threat = tl_vec3_make(15, 1e4f, 15);
    tl_nav_cover_def def = tl_default_nav_cover_def();
    tl_nav_cover covers[MAX_COVERS];
    uint32_t count = 77;
    const float spacings[] = { 0.01f, 1e-6f, 1e-12f, 1e-30f, 1e-45f };
    def.max_length = 1e7f;
    def.height_count = 1;
    def.heights[0] = 50.0f; // in view of the sky, everywhere
    for (int i = 0; i < 5; i++) {
        def.spacing = spacings[i];
        TEST_RESULT(tl_nav_query_find_cover(y.query, &in_view, &def, covers, MAX_COVERS, &count), TL_ERR_LIMIT);
        assert_int_equal(count, 0);
    }
    // A search that ends before is not refused.
    def = tl_default_nav_cover_def();
    def.spacing = 0.03f;
    def.max_length = 1e7f;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, covers, 1, &count), TL_OK);
    assert_int_equal(count, 1);
    tear_down(&y);
}

static void bad_arguments(void **state)
{
    (void)state;
    test_random random = { 5 };
    yard y;
    set_up(&y, &random, 0);
    tl_nav_location agent;
    TEST_RESULT(tl_navmesh_find_nearest(y.navmesh, NULL, tl_vec3_make(3, 0, 3), tl_vec3_make(2, 1, 2), &agent), TL_OK);
    tl_nav_cover cover;
    uint32_t count;
    tl_nav_cover_request request = { y.navmesh, y.soup, NULL, agent, tl_vec3_make(15, 2, 15) };
    tl_nav_cover_def def = tl_default_nav_cover_def();
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, NULL, 0, &count), TL_OK);
    def.spacing = 0.0f;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, &cover, 1, &count), TL_ERR_ARGUMENT);
    def.spacing = 1.0f;
    def.height_count = TL_NAV_MAX_COVER_HEIGHTS + 1;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, &cover, 1, &count), TL_ERR_ARGUMENT);
    def.height_count = 1;
    request.threat.x = NAN;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, &cover, 1, &count), TL_ERR_NOT_FINITE);
    request.threat.x = 0.0f;
    request.agent.polygon = 77;
    TEST_RESULT(tl_nav_query_find_cover(y.query, &request, &def, &cover, 1, &count), TL_ERR_STALE);
    tear_down(&y);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_places_are_found),
        cmocka_unit_test(an_agent_far_from_the_navmesh_finds_no_cover),
        cmocka_unit_test(a_long_reach_costs_no_more_than_the_level),
        cmocka_unit_test(more_places_than_the_budget_are_refused),
        cmocka_unit_test(bad_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
