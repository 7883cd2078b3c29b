// SPDX-License-Identifier: MIT
//
// The nearest wall and slides, against plain searches over tl_navmesh_links that look at everything.

#include "nav_fixture.h"

#include <math.h>

// What an edge's stretches lead to: links, and walls between them.
typedef struct stretch {
    tl_vec3 a, b;
    uint32_t to; // UINT32_MAX: wall
} stretch;

static uint32_t stretches_of(const tl_navmesh *navmesh, const fixture_refs *all, uint32_t polygon, stretch *out)
{
    tl_nav_link links[64];
    uint32_t link_count = 0, count = 0, corner_count = 0, local = 0;
    const tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_navmesh_links(navmesh, all->refs[polygon], links, 64, &link_count), TL_OK);
    TEST_RESULT(tl_navmesh_resolve(navmesh, all->refs[polygon], &tile, &local), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, local, &corner_count);
    for (uint32_t e = 0; e < corner_count; e++) {
        tl_vec3 at = corners[e], end = corners[(e + 1) % corner_count], start = at;
        while (at.x != end.x || at.z != end.z) {
            const tl_nav_link *next = NULL;
            for (uint32_t k = 0; k < link_count; k++) {
                bool ahead = links[k].edge == e && tl_distance(start, links[k].left) > tl_distance(start, at);
                bool nearer = next == NULL || tl_distance(start, links[k].right) < tl_distance(start, next->right);
                next = ahead && nearer ? &links[k] : next;
            }
            if (next == NULL || next->right.x != at.x || next->right.z != at.z) {
                stretch wall = { at, next == NULL ? end : next->right, UINT32_MAX };
                out[count++] = wall;
            }
            if (next != NULL) {
                stretch way = { next->right, next->left, fixture_index_of(all, next->to) };
                out[count++] = way;
            }
            at = next == NULL ? end : next->left;
        }
    }
    return count;
}

static double distance_to(tl_vec3 p, const stretch *s, tl_vec3 *point_out)
{
    double ex = (double)s->b.x - (double)s->a.x, ez = (double)s->b.z - (double)s->a.z;
    double px = (double)p.x - (double)s->a.x, pz = (double)p.z - (double)s->a.z;
    double t = fmin(fmax((px * ex + pz * ez) / (ex * ex + ez * ez), 0.0), 1.0);
    *point_out = tl_lerp(s->a, s->b, (float)t);
    return hypot(px - t * ex, pz - t * ez);
}

// Whether a place on the surface can be walked to straight.
static bool is_straight(const tl_navmesh *navmesh, const tl_nav_location *start, tl_vec3 point)
{
    tl_nav_ray_hit hit;
    float height = 0.0f;
    tl_vec3 away = tl_sub(point, start->point);
    TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, start, point, NULL, 0, &hit), TL_OK);
    TEST_RESULT(tl_navmesh_height(navmesh, hit.polygon, point.x, point.z, &height), TL_OK);
    return (1.0f - hit.t) * hypotf(away.x, away.z) < 1e-4f && fabsf(height - point.y) < 1.0f;
}

// All walls, however far.
static double nearest_wall(const tl_navmesh *navmesh, const fixture_refs *all, const tl_nav_location *start,
                           double radius)
{
    double best = radius;
    for (uint32_t i = 0; i < all->count; i++) {
        stretch s[64];
        uint32_t count = stretches_of(navmesh, all, i, s);
        for (uint32_t k = 0; k < count; k++) {
            tl_vec3 point;
            double d = distance_to(start->point, &s[k], &point);
            if (s[k].to == UINT32_MAX && d < best && is_straight(navmesh, start, point)) {
                best = d;
            }
        }
    }
    return best;
}

static bool is_over(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 p)
{
    bool inside = false;
    tl_vec3 closest;
    TEST_RESULT(tl_navmesh_closest_point(navmesh, ref, p, &closest, &inside), TL_OK);
    return inside;
}

// The least distance from the target that a slide may reach.
static double best_slide(const tl_navmesh *navmesh, const fixture_refs *all, uint32_t start, tl_vec3 from,
                         tl_vec3 target)
{
    bool *reached = calloc(all->count, sizeof *reached);
    uint32_t *queue = calloc(all->count, sizeof *queue), count = 0;
    double best = (double)INFINITY;
    tl_vec3 middle = tl_lerp(from, target, 0.5f), point;
    double reach = 0.5 * hypot((double)target.x - (double)from.x, (double)target.z - (double)from.z) + 1e-5;
    reached[start] = true;
    queue[count++] = start;
    for (uint32_t at = 0; at < count; at++) {
        stretch s[64];
        uint32_t n = stretches_of(navmesh, all, queue[at], s);
        best = is_over(navmesh, all->refs[queue[at]], target) ? 0.0 : best;
        for (uint32_t k = 0; k < n; k++) {
            if (s[k].to == UINT32_MAX) {
                best = fmin(best, distance_to(target, &s[k], &point));
            } else if (!reached[s[k].to] && distance_to(middle, &s[k], &point) <= reach) {
                reached[s[k].to] = true;
                queue[count++] = s[k].to;
            }
        }
    }
    free(reached);
    free(queue);
    return best;
}

// A ramp beside a wall leads to a floor over the place. Its foot begins where the wall ends, as far away as the wall
// is; walls of the upper floor are nearer in the plane.
static void test_floors_over_one_another(void **state)
{
    (void)state;
    const char *const rows[] = { "1....1", "1....1", "0....r", "0....1" };
    uint32_t ties = 0;
    fixture_level level = fixture_make(rows, 4);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    fixture_refs all = fixture_all_refs(navmesh);
    const float step = FIXTURE_STEP * level.cell_size / 4.0f;
    for (uint32_t k = 0; k < 24 * 16; k++) {
        tl_vec3 at = tl_vec3_make(step * (float)(k % 24), 0.0f, step * (float)(k / 24));
        tl_nav_location start;
        for (int floor = 0; floor < 2; floor++) {
            at.y = (float)(floor * FIXTURE_FLOOR_HEIGHT) * level.cell_height;
            if (tl_navmesh_find_nearest(navmesh, NULL, at, tl_vec3_make(0.01f, 0.5f, 0.01f), &start) == TL_OK) {
                tl_nav_wall wall;
                TEST_RESULT(
                    tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, start, 30.0f }, &wall),
                    TL_OK);
                TEST_CHECK(wall.hit);
                TEST_CHECK(is_straight(navmesh, &start, wall.point));
                ties += wall.distance > 0.0f;
            }
        }
    }
    TEST_CHECK(ties > 100);
    free(all.refs);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

static void test_around(void **state)
{
    (void)state;
    test_random random = { 91 };
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t hits = 0, misses = 0, arrived = 0, stopped = 0, far_ways = 0;
    for (uint32_t round = 0; round < 18; round++) {
        fixture_level level = fixture_random(&random, round % 6, 7);
        level.tile_cells = round % 3 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 25; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            uint32_t index = fixture_index_of(&all, start.polygon);
            float radius = test_random_range(&random, 0.1f, 8.0f);
            tl_nav_wall wall;
            TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, start, radius }, &wall),
                        TL_OK);
            double expected = nearest_wall(navmesh, &all, &start, (double)radius);
            TEST_CHECK(fabs((double)wall.distance - expected) < 1e-4);
            if (wall.hit) {
                TEST_CHECK(is_straight(navmesh, &start, wall.point));
                double dx = (double)wall.point.x - (double)start.point.x,
                       dz = (double)wall.point.z - (double)start.point.z;
                TEST_CHECK(fabs(hypot(dx, dz) - expected) < 1e-4);
                TEST_CHECK(fabsf(tl_length(wall.normal) - 1.0f) < 1e-5f && wall.normal.y == 0.0f);
            }
            hits += wall.hit;
            misses += !wall.hit;

            tl_vec3 target = start.point;
            target.x += test_random_range(&random, -6.0f, 6.0f);
            target.z += test_random_range(&random, -6.0f, 6.0f);
            tl_nav_ref polygons[64];
            tl_nav_move move;
            TEST_RESULT(tl_nav_query_move_along_surface(query, navmesh, &(tl_nav_move_request){ NULL, start, target },
                                                        polygons, 64, &move),
                        TL_OK);
            const uint32_t count = move.polygon_count;
            const tl_nav_location end = move.end;
            double left = hypot((double)end.point.x - (double)target.x, (double)end.point.z - (double)target.z);
            TEST_CHECK(fabs(left - best_slide(navmesh, &all, index, start.point, target)) < 1e-4);
            TEST_CHECK(polygons[0] == start.polygon && polygons[count - 1] == end.polygon);
            for (uint32_t k = 0; k + 1 < count; k++) {
                stretch s[64];
                uint32_t n = stretches_of(navmesh, &all, fixture_index_of(&all, polygons[k]), s);
                bool linked = false;
                for (uint32_t m = 0; m < n; m++) {
                    linked = linked || (s[m].to != UINT32_MAX && all.refs[s[m].to] == polygons[k + 1]);
                }
                TEST_CHECK(linked);
            }
            arrived += left == 0.0;
            stopped += left > 0.0;
            far_ways += count > 3;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(hits > 100 && misses > 20 && arrived > 50 && stopped > 100 && far_ways > 20);
}

static void test_arguments(void **state)
{
    (void)state;
    fixture_ring ring = fixture_make_ring();
    const tl_navmesh *navmesh = ring.navmesh;
    const tl_nav_location start = ring.start, stale = ring.stale, nan = ring.nan;
    tl_nav_query *query = ring.few_nodes;
    tl_nav_move move;
    tl_nav_wall wall;
    tl_nav_ref polygons[1];
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, stale, 1.0f }, &wall),
                TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, nan, 1.0f }, &wall),
                TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, start, -1.0f }, &wall),
                TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ NULL, start, 0.5f }, &wall), TL_OK);
    TEST_CHECK(!wall.hit && wall.distance == 0.5f && wall.polygon == start.polygon);
    tl_vec3 there = { 10, 0, 2 };
    TEST_RESULT(
        tl_nav_query_move_along_surface(query, navmesh, &(tl_nav_move_request){ NULL, stale, there }, NULL, 0, &move),
        TL_ERR_STALE);
    TEST_RESULT(
        tl_nav_query_move_along_surface(query, navmesh, &(tl_nav_move_request){ NULL, nan, there }, NULL, 0, &move),
        TL_ERR_NOT_FINITE);
    // Two nodes do not suffice.
    TEST_RESULT(
        tl_nav_query_move_along_surface(query, navmesh, &(tl_nav_move_request){ NULL, start, there }, NULL, 0, &move),
        TL_ERR_NODES);
    query = ring.many_nodes;
    TEST_RESULT(tl_nav_query_move_along_surface(query, navmesh, &(tl_nav_move_request){ NULL, start, there }, polygons,
                                                1, &move),
                TL_INCOMPLETE);
    TEST_CHECK(move.polygon_count == 3 && polygons[0] == start.polygon && move.end.point.x == 10.0f);
    fixture_free_ring(&ring);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_around), cmocka_unit_test(test_floors_over_one_another),
                                        cmocka_unit_test(test_arguments) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
