// SPDX-License-Identifier: MIT
//
// Wide paths against a fine grid: a place of the grid is free when tl_nav_query_find_wall says that no wall is nearer
// than the reach, neighbours are joined by rays. A way on the grid with room to spare must be found, and where one is
// found the grid has a way with a little less room. Every path is walked along and measured.

#include "nav_fixture.h"

#include <talus/nav_wide.h>

#include <math.h>
#include <stdlib.h>

// Grid lines lie off the lattice, so that no place is on an edge.
static const float STEP = 0.2f, OFF = 0.0371f;

typedef struct grid_place {
    tl_nav_location at;
    float room[2];   // metres to the nearest wall, at least and at most
    uint32_t set[2]; // union-find, for more and for less room
} grid_place;

typedef struct grid {
    grid_place *places;
    uint32_t count;
    uint32_t *first; // by polygon
} grid;

static uint32_t set_of(grid *g, uint32_t i, int which)
{
    while (g->places[i].set[which] != i) {
        i = g->places[i].set[which] = g->places[g->places[i].set[which]].set[which];
    }
    return i;
}

static bool is_over(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 point, tl_vec3 *on_out)
{
    bool inside = false;
    TEST_RESULT(tl_navmesh_closest_point(navmesh, ref, point, on_out, &inside), TL_OK);
    return inside;
}

// Metres to the nearest wall. Where a stair winds around the end of a wall, tl_nav_query_find_wall may go on to the
// floor above, as that end is as near as the wall: then it is not known, and `*max_out` is infinite.
static float room_at(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                     const tl_nav_location *at, float limit, float *max_out)
{
    tl_nav_wall wall;
    tl_nav_ray_hit hit;
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ filter, *at, limit }, &wall), TL_OK);
    *max_out = wall.distance;
    if (wall.hit) {
        tl_vec3 to = tl_lerp(at->point, wall.point, 0.999f);
        TEST_RESULT(tl_navmesh_cast_ray(navmesh, filter, at, to, NULL, 0, &hit), TL_OK);
        *max_out = fabsf(hit.point.y - wall.point.y) > 1.0f ? INFINITY : wall.distance;
    }
    return wall.distance;
}

static grid make_grid(tl_nav_query *query, const tl_navmesh *navmesh, const fixture_refs *all,
                      const tl_nav_filter *filter, float most)
{
    grid g = { NULL, 0, calloc(all->count + 1u, sizeof(uint32_t)) };
    uint32_t capacity = 0;
    for (uint32_t p = 0; p < all->count; p++) {
        const tl_nav_tile *tile = NULL;
        uint32_t polygon = 0, corners = 0;
        TEST_RESULT(tl_navmesh_resolve(navmesh, all->refs[p], &tile, &polygon), TL_OK);
        const tl_vec3 *corner = tl_nav_tile_corners(tile, polygon, &corners);
        tl_aabb box = tl_aabb_empty();
        for (uint32_t i = 0; i < corners; i++) {
            box = tl_aabb_add_point(box, corner[i]);
        }
        g.first[p] = g.count;
        bool passes = filter == NULL || tl_nav_filter_passes(filter, tile, polygon);
        for (int32_t z = (int32_t)ceilf(box.min.z / STEP) - 1; passes && (float)z * STEP <= box.max.z; z++) {
            for (int32_t x = (int32_t)ceilf(box.min.x / STEP) - 1; (float)x * STEP <= box.max.x; x++) {
                grid_place place = { { all->refs[p], { 0.0f, 0.0f, 0.0f } }, { 0.0f, 0.0f }, { 0, 0 } };
                tl_vec3 point = { (float)x * STEP + OFF, 0.0f, (float)z * STEP + OFF };
                if (!is_over(navmesh, all->refs[p], point, &place.at.point)) {
                    continue;
                }
                place.room[0] = room_at(query, navmesh, filter, &place.at, most, &place.room[1]);
                if (g.count == capacity) {
                    capacity = 2 * capacity + 1024;
                    g.places = realloc(g.places, capacity * sizeof *g.places);
                }
                g.places[g.count++] = place;
            }
        }
    }
    g.first[all->count] = g.count;
    return g;
}

static const grid_place *place_at(const grid *g, uint32_t polygon, float x, float z)
{
    for (uint32_t i = g->first[polygon]; i < g->first[polygon + 1]; i++) {
        if (fabsf(g->places[i].at.point.x - x) < 0.1f * STEP && fabsf(g->places[i].at.point.z - z) < 0.1f * STEP) {
            return &g->places[i];
        }
    }
    return NULL;
}

// Joins neighbours that both have at least this much room.
static void join(grid *g, const tl_navmesh *navmesh, const fixture_refs *all, const tl_nav_filter *filter, float room,
                 int which)
{
    static const float DX[3] = { 1.0f, 0.0f, 0.0f }, DZ[3] = { 0.0f, 1.0f, 0.0f };
    for (uint32_t i = 0; i < g->count; i++) {
        g->places[i].set[which] = i;
    }
    for (uint32_t i = 0; i < g->count; i++) {
        for (int k = 0; k < 2 && g->places[i].room[which] >= room; k++) {
            tl_vec3 to = tl_add(g->places[i].at.point, tl_vec3_make(DX[k] * STEP, 0.0f, DZ[k] * STEP));
            tl_nav_ray_hit hit;
            TEST_RESULT(tl_navmesh_cast_ray(navmesh, filter, &g->places[i].at, to, NULL, 0, &hit), TL_OK);
            if (hit.hit) {
                continue;
            }
            const grid_place *other = place_at(g, fixture_index_of(all, hit.polygon), to.x, to.z);
            if (other != NULL && other->room[which] >= room) {
                uint32_t a = set_of(g, i, which), b = set_of(g, (uint32_t)(other - g->places), which);
                g->places[a > b ? a : b].set[which] = a < b ? a : b;
            }
        }
    }
}

// Whether a polygon is linked to two floors over one stretch of a seam: rays take one of them, paths
// either, and walls of both count. Such levels are left out.
static bool forks(const tl_navmesh *navmesh, const fixture_refs *all)
{
    bool found = false;
    for (uint32_t p = 0; p < all->count; p++) {
        tl_nav_link links[64];
        uint32_t count = 0;
        TEST_RESULT(tl_navmesh_links(navmesh, all->refs[p], links, 64, &count), TL_OK);
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t k = 0; k < i; k++) {
                double ex = (double)links[i].left.x - (double)links[i].right.x,
                       ez = (double)links[i].left.z - (double)links[i].right.z;
                double left = ex * (double)links[k].left.x + ez * (double)links[k].left.z;
                double right = ex * (double)links[k].right.x + ez * (double)links[k].right.z;
                double own_left = ex * (double)links[i].left.x + ez * (double)links[i].left.z;
                double own_right = ex * (double)links[i].right.x + ez * (double)links[i].right.z;
                found = found || (links[i].edge == links[k].edge &&
                                  fmin(left, own_left) > fmax(right, own_right) + 1e-3 * fabs(own_left - own_right));
            }
        }
    }
    return found;
}

typedef struct coverage {
    uint32_t reached, refused, blocked, bends, tight, refused_near, stacked;
} coverage;

// Walks along a path in small steps, by rays, and measures the room at each.
static void walk(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                 const tl_nav_corner *corners, uint32_t count, const tl_nav_wide_path *path)
{
    float clearance = 0.0f, least = 1e9f;
    TEST_RESULT(tl_nav_query_path_clearance(query, navmesh, filter, corners, count, 4.0f, &clearance), TL_OK);
    TEST_CHECK((double)clearance >= path->wall_distance * (1.0 - 1e-6));
    double length = 0.0;
    for (uint32_t i = 0; i + 1 < count; i++) {
        tl_nav_location at = { corners[i].polygon, corners[i].point };
        tl_vec3 to = corners[i + 1].point;
        TEST_CHECK(is_over(navmesh, at.polygon, at.point, &at.point));
        length += hypot((double)to.x - (double)at.point.x, (double)to.z - (double)at.point.z);
        uint32_t steps = 1 + (uint32_t)(tl_distance(at.point, to) / 0.05f);
        for (uint32_t k = 1; k <= steps; k++) {
            tl_nav_ray_hit hit;
            float room = 0.0f;
            tl_vec3 next = tl_lerp(corners[i].point, to, (float)k / (float)steps);
            TEST_RESULT(tl_navmesh_cast_ray(navmesh, filter, &at, next, NULL, 0, &hit), TL_OK);
            TEST_CHECK(!hit.hit);
            at.polygon = hit.polygon;
            at.point = hit.point;
            room_at(query, navmesh, filter, &at, 4.0f, &room);
            TEST_CHECK((double)room >= path->wall_distance - 1e-5);
            least = tl_minf(least, room);
        }
    }
    TEST_CHECK(count < 2 || least >= clearance - 1e-5f);
    TEST_CHECK(fabs(length - path->length) <= 1e-4 * (1.0 + length));
}

static void compare(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter, grid *g, float reach,
                    float agent_radius, test_random *random, coverage *seen)
{
    enum { CAPACITY = 4096 };
    static tl_nav_corner corners[CAPACITY];
    for (uint32_t i = 0; i < 40; i++) {
        uint32_t a = test_random_below(random, g->count), b = test_random_below(random, g->count);
        tl_nav_wide_path path;
        TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh,
                                                &(tl_nav_path_request){ filter, g->places[a].at, g->places[b].at },
                                                agent_radius + reach, corners, CAPACITY, &path),
                    TL_OK);
        bool has_more = set_of(g, a, 0) == set_of(g, b, 0) && g->places[a].room[0] >= reach + 1.5f * STEP &&
                        g->places[b].room[0] >= reach + 1.5f * STEP;
        bool has_less = set_of(g, a, 1) == set_of(g, b, 1);
        bool stands = g->places[a].room[1] >= reach - 1e-4f && g->places[b].room[1] >= reach - 1e-4f;
        TEST_CHECK(path.status != TL_NAV_WIDE_OUT_OF_NODES);
        TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE || !has_more);
        if (path.status == TL_NAV_WIDE_COMPLETE) {
            TEST_CHECK(stands);
            TEST_CHECK(has_less);
            seen->reached++;
            seen->bends += path.corner_count > 2 ? 1u : 0u;
            seen->tight += has_more ? 0u : 1u;
            walk(query, navmesh, filter, corners, path.corner_count, &path);
        } else {
            seen->refused += path.status == TL_NAV_WIDE_UNREACHABLE ? 1u : 0u;
            seen->refused_near += path.status == TL_NAV_WIDE_UNREACHABLE && has_less ? 1u : 0u;
            seen->blocked += path.status > TL_NAV_WIDE_OUT_OF_NODES ? 1u : 0u;
            TEST_CHECK(path.corner_count == 0);
        }
    }
}

static void test_against_grid(void **state)
{
    (void)state;
    test_random random = { 7 };
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    coverage seen = { 0 };
    const char *asked = getenv("TALUS_ROUNDS");
    uint32_t rounds = asked != NULL ? (uint32_t)atoi(asked) : 24;
    for (uint32_t round = 0; round < rounds; round++) {
        fixture_level level = fixture_random(&random, round % 6, 6);
        level.tile_cells = round % 4 < 2 ? 0 : 2 + round % 2;
        // Shaken floors lie over one another where a ramp has just left the ground, as no agent's height allows.
        level.shake = round % 6 == 5 ? 0 : level.shake;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        if (forks(navmesh, &all)) {
            free(all.refs);
            tl_navmesh_destroy(navmesh);
            continue;
        }
        grid g = make_grid(query, navmesh, &all, NULL, 4.0f);
        for (uint32_t k = 0; k < 3; k++) {
            float reach = test_random_range(&random, 0.3f, 2.2f);
            join(&g, navmesh, &all, NULL, reach + 1.5f * STEP, 0);
            join(&g, navmesh, &all, NULL, reach - 1.5f * STEP, 1);
            compare(query, navmesh, NULL, &g, reach, 0.5f, &random, &seen);
        }
        seen.stacked += round % 6 == 5 ? 1u : 0u;
        free(g.places);
        free(g.first);
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seen.stacked > 0);
    TEST_CHECK(seen.reached > 400 && seen.bends > 100 && seen.tight > 100 && seen.refused > 200 && seen.blocked > 400);
    print_message("stacked %u reached %u (bent %u, tight %u), unreachable %u (near %u), blocked %u\n", seen.stacked,
                  seen.reached, seen.bends, seen.tight, seen.refused, seen.refused_near, seen.blocked);
    tl_nav_query_destroy(query);
}

// The nearest place with room: no place of the grid with a little more room is nearer, and one may stand there.
static void test_places(void **state)
{
    (void)state;
    test_random random = { 23 };
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t moved = 0, none = 0;
    for (uint32_t round = 0; round < 5; round++) {
        fixture_level level = fixture_random(&random, round, 6);
        level.tile_cells = round % 2 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        grid g = make_grid(query, navmesh, &all, NULL, 4.0f);
        for (uint32_t i = 0; i < 100; i++) {
            float reach = test_random_range(&random, 0.3f, 2.2f), most = 6.0f, room = 0.0f;
            tl_nav_location near = g.places[test_random_below(&random, g.count)].at, place;
            tl_nav_wide_path path;
            tl_result result = tl_nav_query_find_wide_place(
                query, navmesh, &(tl_nav_around_request){ NULL, near, most }, 0.5f + reach, &place);
            double distance = (double)INFINITY;
            if (result == TL_OK) {
                distance =
                    hypot((double)place.point.x - (double)near.point.x, (double)place.point.z - (double)near.point.z);
                TEST_CHECK(distance <= (double)most + 1e-4);
                TEST_CHECK(room_at(query, navmesh, NULL, &place, 4.0f, &room) >= reach - 1e-4f);
                TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, place, place },
                                                        0.5f + reach, NULL, 0, &path),
                            TL_INCOMPLETE);
                TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE && path.length == 0.0);
                moved += distance > 0.0 ? 1u : 0u;
            } else {
                TEST_RESULT(result, TL_NOT_FOUND);
                none++;
            }
            for (uint32_t k = 0; k < g.count && level.tile_cells == 0; k++) {
                // In the same tile, and on open ground: nearest in the plane is nearest over polygons near by.
                double other = hypot((double)g.places[k].at.point.x - (double)near.point.x,
                                     (double)g.places[k].at.point.z - (double)near.point.z);
                TEST_CHECK(round != 0 || g.places[k].room[0] < reach + 0.01f || other > (double)most - 1e-3 ||
                           distance <= other + 1e-4);
            }
        }
        free(g.places);
        free(g.first);
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    print_message("moved %u, none %u\n", moved, none);
    TEST_CHECK(moved > 100 && none > 0);
    tl_nav_query_destroy(query);
}

// Polygons that the filter refuses are walls.
static void test_filter(void **state)
{
    (void)state;
    // A passage of one cell (4 m) beside one of three.
    const char *const rows[] = { "00000", "0#0##", "00000" };
    fixture_level level = fixture_make(rows, 3);
    level.area_count = 1;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_location start, goal;
    const tl_vec3 extents = { 0.1f, 1.0f, 0.1f };
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(18.0f, 0.0f, 2.0f), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(18.0f, 0.0f, 10.0f), extents, &goal), TL_OK);
    tl_nav_corner corners[256];
    tl_nav_wide_path path;
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 2.0f, corners,
                                            256, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE);
    double short_way = path.length;
    // As wide as the passage itself.
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 2.5f, corners,
                                            256, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE);
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 2.51f, corners,
                                            256, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_WIDE_START_BLOCKED);
    // Without the cell in the passage near by, around through the other one.
    tl_nav_location gate;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10.0f, 0.0f, 6.0f), extents, &gate), TL_OK);
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, gate.polygon, &tile, &polygon), TL_OK);
    tl_nav_tile_set_flags((tl_nav_tile *)(uintptr_t)tile, polygon, 2);
    // Put in anew: a navmesh notes flags as tiles come.
    tl_navmesh *flagged = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &flagged), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(flagged, tile, TL_NAV_TILE_BORROWED), TL_OK);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.exclude_flags = 2;
    TEST_RESULT(tl_navmesh_find_nearest(flagged, NULL, tl_vec3_make(18.0f, 0.0f, 2.0f), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(flagged, NULL, tl_vec3_make(18.0f, 0.0f, 10.0f), extents, &goal), TL_OK);
    TEST_RESULT(tl_nav_query_find_wide_path(query, flagged, &(tl_nav_path_request){ &filter, start, goal }, 2.0f,
                                            corners, 256, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE && path.length > short_way + 10.0);
    walk(query, flagged, &filter, corners, path.corner_count, &path);
    tl_navmesh_destroy(flagged);
    tl_nav_query_destroy(query);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL, *small = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    def.max_nodes = 4;
    TEST_RESULT(tl_nav_query_create(&def, &small, NULL), TL_OK);
    tl_nav_location start, goal, place, bad;
    const tl_vec3 extents = { 0.1f, 1.0f, 0.1f };
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2.0f, 0.0f, 2.0f), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10.0f, 0.0f, 10.0f), extents, &goal), TL_OK);
    tl_nav_corner corners[64];
    tl_nav_wide_path path, again;
    tl_nav_shortest_path shortest;
    // Without a difference: the shortest path.
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 0.25f, corners,
                                            64, &path),
                TL_OK);
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal },
                                                &(tl_nav_path_buffers){ NULL, 0, corners, 64 }, &shortest),
                TL_OK);
    TEST_CHECK(path.length == shortest.length && path.wall_distance == 0.0);
    // With one, around a circle: two tangents and an arc of 90 degrees less what they take, within the chords' share.
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 1.5f, corners,
                                            64, &path),
                TL_OK);
    // From the corner that is passed, start and goal lie at (-6, -2) and (2, 6).
    double tangent = sqrt(2.0 * 2.0 + 6.0 * 6.0 - 1.0);
    double arc = 2.0 * acos(-1.0) - acos(-24.0 / 40.0) - 2.0 * acos(1.0 / sqrt(40.0));
    TEST_CHECK(fabs(path.length - (2.0 * tangent + arc)) < 0.005);
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 1.5f, corners,
                                            1, &again),
                TL_INCOMPLETE);
    TEST_CHECK(again.corner_count == path.corner_count && again.length == path.length);
    TEST_RESULT(tl_nav_query_find_wide_path(small, navmesh, &(tl_nav_path_request){ NULL, start, goal }, 1.5f, corners,
                                            64, &path),
                TL_OK);
    TEST_CHECK(path.status == TL_NAV_WIDE_OUT_OF_NODES && path.corner_count == 0);
    TEST_RESULT(
        tl_nav_query_find_wide_place(small, navmesh, &(tl_nav_around_request){ NULL, start, 1.0f }, 1.5f, &place),
        TL_ERR_NODES);
    bad = start;
    bad.polygon = TL_NAV_NO_REF;
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, bad, goal }, 1.5f, corners,
                                            64, &path),
                TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_find_wide_place(query, navmesh, &(tl_nav_around_request){ NULL, bad, 1.0f }, 1.5f, &place),
                TL_ERR_STALE);
    bad = start;
    bad.point.x = NAN;
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, bad, goal }, 1.5f, corners,
                                            64, &path),
                TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, INFINITY,
                                            corners, 64, &path),
                TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, -1.0f, corners,
                                            64, &path),
                TL_ERR_ARGUMENT);
    TEST_RESULT(
        tl_nav_query_find_wide_place(query, navmesh, &(tl_nav_around_request){ NULL, start, -1.0f }, 1.5f, &place),
        TL_ERR_ARGUMENT);
    float clearance = 0.0f;
    TEST_RESULT(tl_nav_query_path_clearance(query, navmesh, NULL, corners, 0, 1.0f, &clearance), TL_ERR_ARGUMENT);
    for (int i = 0; i <= TL_NAV_WIDE_GOAL_BLOCKED + 1; i++) {
        TEST_CHECK(strlen(tl_nav_wide_status_name((tl_nav_wide_status)i)) > 3);
    }
    tl_nav_query_destroy(query);
    tl_nav_query_destroy(small);
    tl_navmesh_destroy(navmesh);
}

// Over thousands of small polygons lines of sight part at each vertex, 49,000 here: a look ends after as many as the
// query has nodes, and some more.
static void test_lines_of_sight_are_bounded(void **state)
{
    (void)state;
    test_random random = { 5 };
    fixture_level level = fixture_random(&random, 0, FIXTURE_MAX_CELLS);
    level.shake = FIXTURE_STEP / 4;
    level.triangles = true;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    const float side = (float)(FIXTURE_MAX_CELLS * FIXTURE_STEP) * level.cell_size;
    const tl_vec3 middle = tl_vec3_make(0.5f * side, 0.0f, 0.5f * side);
    tl_nav_location at;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, middle, tl_vec3_make(1, 99, 1), &at), TL_OK);
    const tl_nav_corner corner = { .point = at.point, .polygon = at.polygon };
    // The walls, at the level's rim, are hardly within reach.
    const float reach = 0.48f * side;
    float clearance = 0.0f;
    tl_nav_query *small = fixture_query(512), *large = fixture_query(1 << 17);
    TEST_RESULT(tl_nav_query_path_clearance(small, navmesh, NULL, &corner, 1, reach, &clearance), TL_ERR_NODES);
    TEST_RESULT(tl_nav_query_path_clearance(large, navmesh, NULL, &corner, 1, reach, &clearance), TL_OK);
    TEST_CHECK(clearance > 0.9f * reach);
    tl_nav_query_destroy(small);
    tl_nav_query_destroy(large);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_grid),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_filter),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_lines_of_sight_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
