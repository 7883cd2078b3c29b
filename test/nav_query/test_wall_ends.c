// SPDX-License-Identifier: MIT
//
// Paths whose ends lie on walls, off them by the rounding of their coordinates: as long as those of ends a little
// farther in. Walls run on in line from polygon to polygon here, so that a path along one passes corners at which none
// turns.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_prepare.h>

enum { ROUNDS = 60, PAIRS = 40 };

static const float INWARDS = 1e-3f;

// A point on a random edge of a wall, and one that lies INWARDS of it.
static void pick_on_wall(const tl_navmesh *navmesh, const fixture_refs *all, test_random *random, tl_nav_location *on,
                         tl_nav_location *within)
{
    for (;;) {
        const tl_nav_tile *tile = NULL;
        uint32_t polygon = 0, count = 0;
        on->polygon = within->polygon = all->refs[test_random_below(random, all->count)];
        TEST_RESULT(tl_navmesh_resolve(navmesh, on->polygon, &tile, &polygon), TL_OK);
        const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
        const uint32_t k = test_random_below(random, count);
        if (tl_nav_tile_edge_link(tile, polygon, k) != TL_NAV_LINK_WALL) {
            continue;
        }
        tl_vec3 middle = { 0.0f, 0.0f, 0.0f };
        for (uint32_t i = 0; i < count; i++) {
            middle = tl_mul_add(middle, corners[i], 1.0f / (float)count);
        }
        on->point = tl_lerp(corners[k], corners[(k + 1) % count], 0.05f + 0.9f * test_random_unit(random));
        within->point = tl_lerp(on->point, middle, INWARDS);
        return;
    }
}

static double length_between(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_location *start,
                             const tl_nav_location *goal)
{
    const tl_nav_path_request request = { NULL, *start, *goal };
    tl_nav_shortest_path path;
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, NULL, &path), TL_OK);
    return path.status == TL_NAV_PATH_COMPLETE ? path.length : (double)INFINITY;
}

static void check_ends(tl_nav_query *query, const tl_navmesh *navmesh, uint64_t seed, uint32_t *complete)
{
    test_random random = { seed };
    fixture_refs all = fixture_all_refs(navmesh);
    for (uint32_t i = 0; i < PAIRS; i++) {
        tl_nav_location on, within;
        const tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        pick_on_wall(navmesh, &all, &random, &on, &within);
        const double there = length_between(query, navmesh, &on, &goal);
        const double back = length_between(query, navmesh, &goal, &on);
        const double expected = length_between(query, navmesh, &within, &goal);
        const double moved = (double)tl_distance(on.point, within.point) + 1e-4;
        if (expected == (double)INFINITY) {
            TEST_CHECK(there == expected && back == expected);
            continue;
        }
        TEST_CHECK(fabs(there - expected) <= moved);
        TEST_CHECK(fabs(back - expected) <= moved);
        ++*complete;
    }
    free(all.refs);
}

static void test_leaning_walls(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t complete = 0;
    tl_nav_query *query = fixture_query(16384);
    for (uint32_t round = 0; round < ROUNDS; round++) {
        fixture_level level = fixture_random(&random, 1 + round % 4, 10);
        level.tile_cells = 0;
        level.shake = 0;
        level.lean = 1 + (int32_t)test_random_below(&random, 7);
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t kind = TL_NAV_PREPARED_NONE; kind <= TL_NAV_PREPARED_TABLE; kind++) {
            const tl_nav_prepare_def def = { .table_bytes = kind == TL_NAV_PREPARED_TABLE ? UINT64_MAX - 1 : 0,
                                             .cookie = TL_DEF_COOKIE };
            if (kind != TL_NAV_PREPARED_NONE) {
                TEST_RESULT(tl_navmesh_prepare(navmesh, &def, NULL), TL_OK);
            }
            check_ends(query, navmesh, round, &complete);
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(complete > 4000);
    tl_nav_query_destroy(query);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_leaning_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
