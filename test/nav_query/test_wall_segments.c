// SPDX-License-Identifier: MIT
//
// Walls as pieces: with the ways they make up a polygon's outline; around a place they are those of all polygons that
// hang together there, and the nearest is the nearest wall.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_around.h>

enum { CAPACITY = 1024 };

static bool pass_some(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    (void)user;
    return fixture_hash((uint64_t)(uint32_t)(tile->tile_x * 64 + tile->tile_z), polygon) % 6 != 0;
}

static double plan_length(tl_vec3 a, tl_vec3 b)
{
    return hypot((double)b.x - (double)a.x, (double)b.z - (double)a.z);
}

static bool passes(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    return tl_nav_filter_passes(filter, tile, polygon);
}

// Walls and ways together are the outline, on levels where no two floors share a seam.
static void check_outline(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref ref, uint32_t *walls,
                          uint32_t *refused)
{
    tl_nav_wall_segment segments[64];
    tl_nav_link links[64];
    const tl_nav_tile *tile = NULL;
    uint32_t count = 0, link_count = 0, corner_count = 0, polygon = 0;
    double outline = 0.0, sum = 0.0;
    TEST_RESULT(tl_navmesh_polygon_walls(navmesh, filter, ref, segments, 64, &count), TL_OK);
    TEST_RESULT(tl_navmesh_links(navmesh, ref, links, 64, &link_count), TL_OK);
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &corner_count);
    for (uint32_t i = 0; i < corner_count; i++) {
        outline += plan_length(corners[i], corners[(i + 1) % corner_count]);
    }
    for (uint32_t k = 0; k < link_count; k++) {
        sum += passes(navmesh, filter, links[k].to) ? plan_length(links[k].right, links[k].left) : 0.0;
    }
    for (uint32_t k = 0; k < count; k++) {
        sum += plan_length(segments[k].start, segments[k].end);
        TEST_CHECK(segments[k].polygon == ref && segments[k].distance == 0.0f);
        TEST_CHECK(segments[k].across == TL_NAV_NO_REF || !passes(navmesh, filter, segments[k].across));
        walls[0] += segments[k].across == TL_NAV_NO_REF;
        *refused += segments[k].across != TL_NAV_NO_REF;
        // The polygon lies on its left: its corners do.
        for (uint32_t i = 0; i < corner_count; i++) {
            double turn = ((double)segments[k].end.x - (double)segments[k].start.x) *
                              ((double)corners[i].z - (double)segments[k].start.z) -
                          ((double)segments[k].end.z - (double)segments[k].start.z) *
                              ((double)corners[i].x - (double)segments[k].start.x);
            TEST_CHECK(turn < 1e-4);
        }
    }
    TEST_CHECK(fabs(sum - outline) < 1e-4);
    if (count > 0) {
        tl_nav_wall_segment one;
        uint32_t same = 0;
        tl_result expected = count == 1 ? TL_OK : TL_INCOMPLETE;
        TEST_RESULT(tl_navmesh_polygon_walls(navmesh, filter, ref, &one, 1, &same), expected);
        TEST_CHECK(same == count);
    }
}

static double distance_to(tl_vec3 p, tl_vec3 a, tl_vec3 b)
{
    double ex = (double)b.x - (double)a.x, ez = (double)b.z - (double)a.z;
    double px = (double)p.x - (double)a.x, pz = (double)p.z - (double)a.z;
    double t = fmin(fmax((px * ex + pz * ez) / (ex * ex + ez * ez), 0.0), 1.0);
    return hypot(px - t * ex, pz - t * ez);
}

// The number of walls around a place, by gathering polygons until none is new; < 0 when it hangs on rounding.
static int32_t count_walls(const tl_navmesh *navmesh, const tl_nav_filter *filter, const fixture_refs *all,
                           const tl_nav_location *center, double radius)
{
    bool *reached = calloc(all->count, sizeof *reached);
    uint32_t *queue = calloc(all->count, sizeof *queue), count = 1;
    queue[0] = fixture_index_of(all, center->polygon);
    reached[queue[0]] = true;
    int32_t walls = 0;
    bool close_call = false;
    for (uint32_t at = 0; at < count; at++) {
        tl_nav_link links[64];
        tl_nav_wall_segment segments[64];
        uint32_t n = 0;
        TEST_RESULT(tl_navmesh_polygon_walls(navmesh, filter, all->refs[queue[at]], segments, 64, &n), TL_OK);
        for (uint32_t k = 0; k < n; k++) {
            double d = distance_to(center->point, segments[k].start, segments[k].end);
            close_call = close_call || fabs(d - radius) < 1e-5;
            walls += d <= radius;
        }
        TEST_RESULT(tl_navmesh_links(navmesh, all->refs[queue[at]], links, 64, &n), TL_OK);
        for (uint32_t k = 0; k < n; k++) {
            uint32_t to = fixture_index_of(all, links[k].to);
            double d = distance_to(center->point, links[k].right, links[k].left);
            close_call = close_call || fabs(d - radius) < 1e-5;
            if (!reached[to] && d <= radius && passes(navmesh, filter, links[k].to)) {
                reached[to] = true;
                queue[count++] = to;
            }
        }
    }
    free(reached);
    free(queue);
    return close_call ? -1 : walls;
}

static void test_walls(void **state)
{
    (void)state;
    test_random random = { 31 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t walls = 0, refused = 0, around = 0, cut = 0, equal = 0;
    for (uint32_t round = 0; round < 30; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 3 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_filter filter = tl_default_nav_filter();
        filter.pass = round % 2 == 0 ? pass_some : NULL;
        for (uint32_t i = 0; round % 6 != 5 && i < all.count; i++) {
            check_outline(navmesh, &filter, all.refs[i], &walls, &refused);
        }
        for (uint32_t i = 0; i < 20; i++) {
            tl_nav_location center = fixture_random_location(navmesh, &all, &random);
            float radius = test_random_range(&random, 0.2f, 9.0f);
            tl_nav_wall_segment segments[CAPACITY], few[3];
            uint32_t count = 0, same = 0;
            TEST_RESULT(tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ &filter, center, radius },
                                                segments, CAPACITY, &count),
                        TL_OK);
            int32_t expected = count_walls(navmesh, &filter, &all, &center, (double)radius);
            TEST_CHECK(expected < 0 || (uint32_t)expected == count);
            for (uint32_t k = 0; k < count; k++) {
                double d = distance_to(center.point, segments[k].start, segments[k].end);
                TEST_CHECK(fabs(d - (double)segments[k].distance) < 1e-4 && segments[k].distance <= radius);
                TEST_CHECK(k == 0 || segments[k - 1].distance <= segments[k].distance);
            }
            tl_nav_wall nearest;
            TEST_RESULT(
                tl_nav_query_find_wall(query, navmesh, &(tl_nav_around_request){ &filter, center, radius }, &nearest),
                TL_OK);
            TEST_CHECK(nearest.hit == (count > 0) || nearest.distance == radius);
            // That one does not look behind ways that are farther than a wall.
            TEST_CHECK(!nearest.hit || nearest.distance >= segments[0].distance);
            equal += nearest.hit && nearest.distance == segments[0].distance;
            tl_result result = tl_nav_query_find_walls(
                query, navmesh, &(tl_nav_around_request){ &filter, center, radius }, few, 3, &same);
            TEST_CHECK(result == (count > 3 ? TL_INCOMPLETE : TL_OK) && same == count);
            for (uint32_t k = 0; k < 3 && k < count; k++) {
                TEST_CHECK(few[k].distance == segments[k].distance && few[k].polygon == segments[k].polygon);
            }
            around += count;
            cut += count > 3;
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(walls > 1000 && refused > 200 && around > 2000 && cut > 200 && equal > 300);
}

static void test_arguments(void **state)
{
    (void)state;
    fixture_ring ring = fixture_make_ring();
    const tl_navmesh *navmesh = ring.navmesh;
    const tl_nav_location start = ring.start, stale = ring.stale, nan = ring.nan;
    tl_nav_query *query = ring.few_nodes;
    tl_nav_wall_segment segments[4];
    uint32_t count = 0;
    TEST_RESULT(tl_navmesh_polygon_walls(navmesh, NULL, 77, segments, 4, &count), TL_ERR_STALE);
    TEST_RESULT(
        tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ NULL, stale, 1.0f }, segments, 4, &count),
        TL_ERR_STALE);
    TEST_RESULT(
        tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ NULL, nan, 1.0f }, segments, 4, &count),
        TL_ERR_NOT_FINITE);
    TEST_RESULT(
        tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ NULL, start, -1.0f }, segments, 4, &count),
        TL_ERR_ARGUMENT);
    TEST_RESULT(
        tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ NULL, start, 20.0f }, segments, 4, &count),
        TL_ERR_NODES);
    query = ring.many_nodes;
    TEST_RESULT(tl_nav_query_find_walls(query, navmesh, &(tl_nav_around_request){ NULL, start, 2.5f }, NULL, 0, &count),
                TL_INCOMPLETE);
    TEST_CHECK(count == 2);
    fixture_free_ring(&ring);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_walls), cmocka_unit_test(test_arguments) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
