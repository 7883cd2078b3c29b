// SPDX-License-Identifier: MIT
//
// Corridors: whole after whatever happens to them, never longer by what shortens them, and agents that follow them
// arrive, by a way about as long as the shortest.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_corridor.h>

enum { ROOM = 256 };

static tl_nav_query *make_query(void)
{
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    return query;
}

static bool is_on(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 p)
{
    tl_vec3 closest;
    TEST_RESULT(tl_navmesh_closest_point(navmesh, ref, p, &closest, NULL), TL_OK);
    return hypot((double)closest.x - (double)p.x, (double)closest.z - (double)p.z) < 1e-3;
}

static void check_corridor(const tl_nav_corridor *c, const tl_navmesh *navmesh, const tl_nav_filter *filter)
{
    TEST_CHECK(c->count >= 1 && c->count <= c->capacity);
    TEST_CHECK(tl_nav_corridor_check(c, navmesh, filter, UINT32_MAX) == c->count);
    TEST_CHECK(tl_nav_corridor_check(c, navmesh, filter, 1) == 1);
    TEST_CHECK(is_on(navmesh, c->path[0], c->position) && is_on(navmesh, c->path[c->count - 1], c->target));
}

static float straight_length(const tl_nav_corridor *c, const tl_navmesh *navmesh)
{
    tl_nav_corner corners[ROOM];
    uint32_t count = 0;
    float length = 0.0f;
    TEST_RESULT(tl_navmesh_straight_path(navmesh, &(tl_nav_polygon_path){ c->path, c->count, c->position, c->target },
                                         corners, ROOM, &count, &length),
                TL_OK);
    // The first corners are those of the whole path.
    tl_nav_corner first[3];
    uint32_t first_count = 0;
    tl_result expected = count > 3 ? TL_INCOMPLETE : TL_OK;
    TEST_RESULT(tl_nav_corridor_corners(c, navmesh, first, 3, &first_count), expected);
    TEST_CHECK(first_count == (count < 3 ? count : 3));
    for (uint32_t i = 0; i < first_count; i++) {
        TEST_CHECK(tl_distance(first[i].point, corners[i].point) == 0.0f && first[i].flags == corners[i].flags &&
                   first[i].polygon == corners[i].polygon && first[i].link == corners[i].link);
    }
    return length;
}

// A step of at most `reach` towards the next corner.
static void step(tl_nav_corridor *c, tl_nav_query *query, const tl_navmesh *navmesh, float reach)
{
    tl_nav_corner corners[2];
    uint32_t count = 0;
    tl_result result = tl_nav_corridor_corners(c, navmesh, corners, 2, &count);
    TEST_CHECK((result == TL_OK || result == TL_INCOMPLETE) && count == 2);
    tl_vec3 way = tl_sub(corners[1].point, c->position);
    way.y = 0.0f;
    float length = tl_length(way);
    tl_vec3 to = length <= reach ? corners[1].point : tl_mul_add(c->position, way, reach / length);
    TEST_RESULT(tl_nav_corridor_move(c, query, navmesh, NULL, to), TL_OK);
}

// Agents go to their goals in steps; now and then they are pushed aside, and their corridors shortened.
static void test_walks(void **state)
{
    (void)state;
    test_random random = { 701 };
    tl_nav_query *query = make_query();
    uint32_t arrived = 0, pushed = 0, shortened = 0, improved = 0, straight = 0, shorter = 0;
    double walked_sum = 0.0, shortest_sum = 0.0;
    for (uint32_t round = 0; round < 36; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 6; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
            tl_nav_ref room[ROOM];
            tl_nav_corridor c = tl_nav_corridor_init(room, ROOM);
            tl_nav_path path;
            tl_nav_corridor_reset(&c, &start);
            TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
            if (!c.reaches) {
                continue;
            }
            check_corridor(&c, navmesh, NULL);
            double walked = 0.0, shortest = (double)straight_length(&c, navmesh);
            bool is_pushed = i % 2 == 1;
            uint32_t steps = 0;
            for (; steps < 2000 && hypot((double)c.position.x - (double)goal.point.x,
                                         (double)c.position.z - (double)goal.point.z) > 1e-3;
                 steps++) {
                tl_vec3 before = c.position;
                if (is_pushed && steps % 5 == 0 && steps < 60) {
                    tl_vec3 aside = c.position;
                    aside.x += test_random_range(&random, -4.0f, 4.0f);
                    aside.z += test_random_range(&random, -4.0f, 4.0f);
                    TEST_RESULT(tl_nav_corridor_move(&c, query, navmesh, NULL, aside), TL_OK);
                    pushed++;
                } else {
                    step(&c, query, navmesh, 0.7f);
                    walked += (double)tl_distance(before, c.position);
                }
                check_corridor(&c, navmesh, NULL);
                float length = straight_length(&c, navmesh);
                bool changed = false;
                if (steps % 3 == 0) {
                    TEST_RESULT(tl_nav_corridor_shorten(&c, navmesh, NULL, 12.0f, &changed), TL_OK);
                    shortened += changed;
                } else if (steps % 7 == 1) {
                    TEST_RESULT(tl_nav_corridor_improve(&c, query, navmesh, NULL, 16, 64, &changed), TL_OK);
                    improved += changed;
                }
                check_corridor(&c, navmesh, NULL);
                float now = straight_length(&c, navmesh);
                // Costs follow the heights of the edges on the way, which the straight line from corner to corner does
                // not.
                TEST_CHECK(changed ? now <= length * 1.000001f : now == length);
                shorter += now < length;
            }
            TEST_CHECK(steps < 2000 && c.count == 1 && c.path[0] == goal.polygon);
            arrived++;
            if (!is_pushed) {
                walked_sum += walked;
                shortest_sum += shortest;
                straight++;
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(arrived > 80 && straight > 40 && pushed > 200 && shortened > 10 && improved > 5 && shorter > 20);
    // On surfaces with bumps steps are longer than the corners' line.
    TEST_CHECK(walked_sum < 1.05 * shortest_sum);
}

// The target walks about; agents with little room get there piece by piece.
static void test_targets(void **state)
{
    (void)state;
    test_random random = { 702 };
    tl_nav_query *query = make_query();
    uint32_t cuts = 0, arrived = 0, longest = 0;
    for (uint32_t round = 0; round < 30; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = round % 3 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_location at = fixture_random_location(navmesh, &all, &random);
        tl_nav_ref room[ROOM];
        tl_nav_corridor c = tl_nav_corridor_init(room, round % 2 == 0 ? ROOM : 3);
        tl_nav_corridor_reset(&c, &at);
        for (uint32_t i = 0; i < 60; i++) {
            tl_vec3 to = c.target;
            to.x += test_random_range(&random, -5.0f, 6.0f);
            to.z += test_random_range(&random, -5.0f, 6.0f);
            TEST_RESULT(tl_nav_corridor_move_target(&c, query, navmesh, NULL, to), TL_OK);
            check_corridor(&c, navmesh, NULL);
            longest = c.count > longest ? c.count : longest;
            cuts += !c.reaches;
            if (i % 4 == 0) {
                step(&c, query, navmesh, 2.0f);
                check_corridor(&c, navmesh, NULL);
            }
        }
        // With room for three polygons: there, and on from there.
        tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        c.capacity = 3;
        tl_nav_corridor_reset(&c, &at);
        tl_nav_path path;
        TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
        bool reachable = path.status == TL_NAV_PATH_COMPLETE;
        for (uint32_t i = 0; i < 3000 && reachable; i++) {
            check_corridor(&c, navmesh, NULL);
            step(&c, query, navmesh, 1.0f);
            if (c.count == 1 && !c.reaches) {
                TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
            } else if (c.count == 1) {
                TEST_CHECK(c.path[0] == goal.polygon);
                arrived++;
                break;
            }
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(cuts > 50 && arrived > 8 && longest > 8);
}

// Tiles go and come back while an agent is under way.
static void test_repair(void **state)
{
    (void)state;
    test_random random = { 703 };
    tl_nav_query *query = make_query();
    const tl_vec3 extents = { 3.0f, 2.0f, 3.0f };
    uint32_t broken = 0, repaired = 0, stranded = 0, untouched = 0, arrived = 0;
    for (uint32_t round = 0; round < 60; round++) {
        fixture_level level = fixture_random(&random, round % 5, 12);
        level.tile_cells = 2;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_location start = fixture_random_location(navmesh, &all, &random);
        tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        tl_nav_ref room[ROOM];
        tl_nav_corridor c = tl_nav_corridor_init(room, ROOM);
        tl_nav_path path;
        tl_nav_corridor_reset(&c, &start);
        TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
        int32_t gone_x = -1, gone_z = -1;
        for (uint32_t i = 0; i < 200 && c.reaches && c.count > 1; i++) {
            if (i % 6 == 2) {
                if (gone_x >= 0) {
                    tl_nav_tile *tile = fixture_build_tile(&level, gone_x, gone_z, NULL);
                    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
                    gone_x = -1;
                } else {
                    // A tile ahead of the agent, not its own.
                    const tl_nav_tile *tile = NULL, *own = NULL;
                    uint32_t ahead = test_random_below(&random, c.count);
                    TEST_RESULT(tl_navmesh_resolve(navmesh, c.path[0], &own, NULL), TL_OK);
                    TEST_RESULT(tl_navmesh_resolve(navmesh, c.path[ahead], &tile, NULL), TL_OK);
                    if (tile != own) {
                        gone_x = tile->tile_x;
                        gone_z = tile->tile_z;
                        TEST_RESULT(tl_navmesh_remove_tile(navmesh, gone_x, gone_z), TL_OK);
                        TEST_CHECK(tl_nav_corridor_check(&c, navmesh, NULL, UINT32_MAX) <= ahead);
                        broken++;
                    }
                }
            }
            uint32_t whole = tl_nav_corridor_check(&c, navmesh, NULL, UINT32_MAX), count = c.count;
            TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_OK);
            check_corridor(&c, navmesh, NULL);
            if (whole == count) {
                TEST_CHECK(c.count == count && path.status == TL_NAV_PATH_COMPLETE);
                untouched++;
            } else {
                repaired += path.status == TL_NAV_PATH_COMPLETE;
                stranded += path.status != TL_NAV_PATH_COMPLETE;
                TEST_CHECK(tl_distance(c.goal, goal.point) == 0.0f);
            }
            if (c.reaches && c.count > 1) {
                step(&c, query, navmesh, 1.0f);
                check_corridor(&c, navmesh, NULL);
            }
        }
        arrived += c.reaches && c.count == 1;
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(broken > 60 && repaired > 25 && stranded > 10 && untouched > 500 && arrived > 10);
}

// An agent's own tile goes, and an agent whose surroundings are gone.
static void test_own_tile(void **state)
{
    (void)state;
    const char *const rows[] = { "0000", "0000", "0000", "0000" };
    fixture_level level = fixture_make(rows, 4);
    level.tile_cells = 2;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query *query = make_query();
    const tl_vec3 extents = { 3.0f, 2.0f, 3.0f };
    tl_nav_location start, goal;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(7, 0, 2), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(14, 0, 14), extents, &goal), TL_OK);
    tl_nav_ref room[16];
    tl_nav_corridor c = tl_nav_corridor_init(room, 16);
    tl_nav_path path;
    tl_nav_corner corners[4];
    uint32_t count = 0;
    TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_corridor_move(&c, query, navmesh, NULL, goal.point), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_ERR_ARGUMENT);
    TEST_CHECK(tl_nav_corridor_check(&c, navmesh, NULL, 5) == 0);
    tl_nav_corridor_reset(&c, &start);
    TEST_RESULT(tl_nav_corridor_set_path(&c, navmesh, &goal.polygon, 1, goal.point), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
    TEST_CHECK(tl_nav_corridor_check(&c, navmesh, NULL, UINT32_MAX) == 0);
    TEST_CHECK(tl_nav_corridor_corners(&c, navmesh, corners, 4, &count) != TL_OK);
    TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_OK);
    TEST_CHECK(c.reaches && c.position.x == 8.0f);
    check_corridor(&c, navmesh, NULL);
    // The goal's tile goes: the agent stays; it comes back: the goal is still known.
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 1, 1), TL_OK);
    TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_UNREACHABLE && c.count == 1 && !c.reaches);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 1, 0), TL_OK);
    TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_NOT_FOUND);
    TEST_CHECK(c.goal.x == 14.0f && c.goal.z == 14.0f);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// Up to a link, over it, and on.
static void test_link(void **state)
{
    (void)state;
    const char *const rows[] = { "000##00", "000##00" };
    fixture_level level = fixture_make(rows, 2);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query *query = make_query();
    tl_nav_offmesh jump = tl_default_nav_offmesh();
    jump.start = tl_vec3_make(11.5f, 0, 2);
    jump.end = tl_vec3_make(20.5f, 0, 2);
    tl_nav_ref link = TL_NAV_NO_REF, passed = TL_NAV_NO_REF, room[16];
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &jump, &link, NULL), TL_OK);
    const tl_vec3 extents = { 1, 1, 1 };
    tl_nav_location start, goal, ends[2];
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 6), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(26, 0, 6), extents, &goal), TL_OK);
    tl_nav_corridor c = tl_nav_corridor_init(room, 16);
    tl_nav_path path;
    tl_nav_corner corners[8];
    uint32_t count = 0, steps = 0;
    tl_nav_corridor_reset(&c, &start);
    TEST_RESULT(tl_nav_corridor_pass_link(&c, navmesh, NULL, NULL), TL_NOT_FOUND);
    TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
    TEST_CHECK(c.reaches);
    check_corridor(&c, navmesh, NULL);
    for (; steps < 100; steps++) {
        tl_result result = tl_nav_corridor_corners(&c, navmesh, corners, 2, &count);
        TEST_CHECK(count == 2 && (result == TL_OK || result == TL_INCOMPLETE));
        if ((corners[1].flags & TL_NAV_CORNER_LINK) != 0 && tl_distance(corners[1].point, c.position) < 1e-3f) {
            break;
        }
        bool changed = false;
        step(&c, query, navmesh, 1.0f);
        check_corridor(&c, navmesh, NULL);
        TEST_RESULT(tl_nav_corridor_shorten(&c, navmesh, NULL, 10.0f, &changed), TL_OK);
        TEST_RESULT(tl_nav_corridor_improve(&c, query, navmesh, NULL, 8, 64, &changed), TL_OK);
        check_corridor(&c, navmesh, NULL);
    }
    TEST_CHECK(steps > 5 && steps < 100);
    TEST_RESULT(tl_nav_corridor_pass_link(&c, navmesh, ends, &passed), TL_OK);
    TEST_CHECK(passed == link && ends[0].point.x == 11.5f && ends[1].point.x == 20.5f && c.position.x == 20.5f);
    TEST_CHECK(c.path[0] == ends[1].polygon);
    check_corridor(&c, navmesh, NULL);
    TEST_CHECK(straight_length(&c, navmesh) < 7.0f);
    // A link that is gone breaks a corridor over it.
    tl_nav_corridor_reset(&c, &start);
    TEST_RESULT(tl_nav_corridor_find(&c, query, navmesh, NULL, &goal, &path), TL_OK);
    uint32_t whole = c.count;
    TEST_RESULT(tl_navmesh_remove_offmesh(navmesh, link), TL_OK);
    TEST_CHECK(tl_nav_corridor_check(&c, navmesh, NULL, UINT32_MAX) < whole);
    TEST_RESULT(tl_nav_corridor_pass_link(&c, navmesh, NULL, NULL), TL_ERR_STALE);
    TEST_RESULT(tl_nav_corridor_repair(&c, query, navmesh, NULL, extents, &path), TL_OK);
    TEST_CHECK(path.status == TL_NAV_PATH_UNREACHABLE && !c.reaches);
    check_corridor(&c, navmesh, NULL);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_walks), cmocka_unit_test(test_targets),
                                        cmocka_unit_test(test_repair), cmocka_unit_test(test_own_tile),
                                        cmocka_unit_test(test_link) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
