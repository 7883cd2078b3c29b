// SPDX-License-Identifier: MIT
//
// The ROUT chunk as untrusted bytes: it is refused, or every route over it ends; and what it is of is held to its file.

#include "nav_route_file.h"

#include "pack/pack_format.h"

static const double HERE[3] = { 0, 0, 0 };

static fixture_level some_level(uint32_t kind, uint32_t size, uint64_t seed)
{
    test_random random = { seed };
    fixture_level level = fixture_random(&random, kind, size);
    level.tile_cells = 3;
    return level;
}

static tl_result try_world(world_file *file, tl_nav_world **world_out, tl_report *report)
{
    tl_nav_world_def def = tl_default_nav_world_def();
    def.read = world_file_read;
    def.user = file;
    const tl_result result = tl_nav_world_create(&def, world_out, report);
    TEST_CHECK((result == TL_OK) == (*world_out != NULL));
    return result;
}

static void test_same_bytes(void **state)
{
    (void)state;
    const fixture_level level = some_level(5, 24, 3);
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    static const double far_away[3] = { 1e7, 0, -3e6 };
    world_file far_file = world_file_make(&level, far_away, TL_PACK_AXES_Z_UP);
    tl_nav_routes *one = route_file_bake(&file, 4), *two = route_file_bake(&file, 4);
    tl_nav_routes *far_one = route_file_bake(&far_file, 4), *other = route_file_bake(&file, 2);
    TEST_CHECK(one->gate_count > 20 && one->length_count > 100);
    TEST_CHECK(one->blob.size == two->blob.size && memcmp(one, two, (size_t)one->blob.size) == 0);
    TEST_CHECK(one->blob.size == far_one->blob.size && memcmp(one, far_one, (size_t)one->blob.size) == 0);
    TEST_CHECK(other->gate_count == one->gate_count && other->length_count != one->length_count);
    // A file that has routes gives the same ones.
    world_file with = route_file_with(&file, one, one->blob.size);
    tl_nav_routes *again = route_file_bake(&with, 4);
    TEST_CHECK(memcmp(one, again, (size_t)one->blob.size) == 0);
    // To the other byte order and back.
    unsigned char *copy = test_blob_alloc((size_t)one->blob.size);
    memcpy(copy, one, (size_t)one->blob.size);
    TEST_RESULT(tl_blob_swap(copy, one->blob.size, false, NULL), TL_OK);
    TEST_CHECK(memcmp(copy, one, (size_t)one->blob.size) != 0);
    TEST_RESULT(tl_blob_swap(copy, one->blob.size, true, NULL), TL_OK);
    TEST_CHECK(memcmp(copy, one, (size_t)one->blob.size) == 0);
    test_blob_free(copy);
    tl_nav_routes *const all[] = { one, two, far_one, other, again };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        tl_blob_free(all[i]);
    }
    world_file_free(&with);
    world_file_free(&file);
    world_file_free(&far_file);
}

static void test_wrong_tiles(void **state)
{
    (void)state;
    const fixture_level level = some_level(1, 18, 5), other = some_level(1, 18, 6);
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    world_file wrong = world_file_make(&other, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_routes *routes = route_file_bake(&file, 4);
    world_file with = route_file_with(&wrong, routes, routes->blob.size);
    tl_nav_world *world = NULL;
    tl_nav_router *router = NULL;
    tl_report report;
    TEST_RESULT(try_world(&with, &world, &report), TL_ERR_CORRUPT);
    TEST_CHECK(strcmp(report.element, "chunk") == 0 && report.advice != NULL);
    TEST_RESULT(try_world(&file, &world, &report), TL_OK);
    TEST_RESULT(tl_nav_router_create(world, NULL, &router, &report), TL_NOT_FOUND);
    TEST_CHECK(router == NULL && strcmp(report.element, "chunk") == 0);
    tl_nav_world_destroy(world);
    tl_blob_free(routes);
    world_file_free(&with);
    world_file_free(&wrong);
    world_file_free(&file);
}

// One place, or places that no gate joins: no gates, and routes within a place alone.
static void test_no_gates(void **state)
{
    (void)state;
    static const char *const ROWS[] = { "000###000", "000###000", "000###000" };
    fixture_level level = fixture_make(ROWS, 3);
    level.tile_cells = 3;
    world_file file = route_file_make(&level, HERE, 4);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    tl_nav_router *router = NULL;
    TEST_RESULT(tl_nav_router_create(world, NULL, &router, NULL), TL_OK);
    const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 1000.0);
    world_settle(world, &everywhere, 1);
    const double points[3][3] = { { 2, 0, 2 }, { 10, 0, 10 }, { 30, 0, 3 } };
    tl_nav_location at[3];
    tl_nav_world_route route;
    for (int i = 0; i < 3; i++) {
        const tl_vec3 extents = { 1, 5, 1 };
        TEST_RESULT(tl_nav_world_find_nearest(world, NULL, points[i], extents, &at[i]), TL_OK);
    }
    const tl_nav_world_route_request within = { at[0], at[1] }, over = { at[0], at[2] };
    TEST_RESULT(tl_nav_world_find_route(world, router, &within, NULL, 0, &route), TL_OK);
    TEST_CHECK(route.status == TL_NAV_PATH_COMPLETE && route.point_count == 2);
    TEST_CHECK(route.length > 11.31 && route.length < 11.32 && route.lower_bound > 11.31);
    TEST_RESULT(tl_nav_world_find_route(world, router, &over, NULL, 0, &route), TL_OK);
    TEST_CHECK(route.status == TL_NAV_PATH_UNREACHABLE && route.lower_bound == (double)INFINITY);
    tl_nav_router_destroy(router);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

// Every prefix of the chunk, and every byte of its head and gates, altered.
static void test_damaged_chunk(void **state)
{
    (void)state;
    const fixture_level level = some_level(4, 12, 9);
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_routes *routes = route_file_bake(&file, 2);
    const size_t size = (size_t)routes->blob.size;
    unsigned char *copy = test_blob_alloc(size);
    for (size_t cut = 0; cut < size; cut++) {
        unsigned char *part = malloc(cut + 1);
        memcpy(part, routes, cut);
        TEST_CHECK(tl_is_error(tl_nav_routes_check(part, cut, NULL)));
        free(part);
    }
    uint32_t refused = 0;
    for (size_t i = 0; i < size; i++) {
        memcpy(copy, routes, size);
        copy[i] ^= 0x80;
        refused += tl_nav_routes_check(copy, size, NULL) != TL_OK;
    }
    TEST_CHECK(refused > sizeof *routes - 16); // counts, places, signs; a length may be another one
    test_blob_free(copy);
    tl_blob_free(routes);
    world_file_free(&file);
}

static void ask_all(tl_nav_world *world, test_random *random)
{
    tl_nav_router *router = NULL;
    tl_nav_world_route_point points[64];
    const tl_nav_world_interest everywhere = world_interest(HERE, 0.0, 0.0, 1000.0);
    TEST_RESULT(tl_nav_router_create(world, NULL, &router, NULL), TL_OK);
    world_settle(world, &everywhere, 1);
    fixture_refs refs = fixture_all_refs(tl_nav_world_navmesh(world));
    for (uint32_t i = 0; i < 24; i++) {
        tl_nav_world_route route;
        const tl_nav_world_route_request request = {
            fixture_random_location(tl_nav_world_navmesh(world), &refs, random),
            fixture_random_location(tl_nav_world_navmesh(world), &refs, random)
        };
        const tl_result result = tl_nav_world_find_route(world, router, &request, points, 64, &route);
        TEST_CHECK(result == TL_OK || result == TL_INCOMPLETE || result == TL_ERR_CORRUPT);
    }
    free(refs.refs);
    tl_nav_router_destroy(router);
}

// Words of the chunk overwritten, its hashes made right: whatever passes the checks is safe to ask.
static void test_hostile_chunk(void **state)
{
    (void)state;
    static const uint32_t WORDS[] = { 0, 1, 2, 3, 0x3f800000u, 0x7f800000u, 0x00000001u, 0x7f7fffffu, 0x80000000u, 5 };
    test_random random = { 77 };
    uint32_t refused = 0, asked = 0;
    for (uint32_t kind = 0; kind < 6; kind++) {
        const fixture_level level = some_level(kind, 15, 40 + kind);
        world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
        tl_nav_routes *routes = route_file_bake(&file, 2);
        const uint32_t words = (uint32_t)(routes->blob.size / 4);
        uint32_t *copy = test_blob_alloc((size_t)routes->blob.size);
        for (uint32_t round = 0; round < 120; round++) {
            memcpy(copy, routes, (size_t)routes->blob.size);
            const uint32_t changes = 1 + test_random_below(&random, 4);
            for (uint32_t i = 0; i < changes; i++) {
                // Half of them among the gates, where there are few.
                const uint32_t gates = 16 + routes->gate_count * 10;
                const uint32_t at = 4 + test_random_below(&random, (round % 2 == 0 ? gates : words) - 4);
                copy[at] = round % 3 == 0 ? copy[at] ^ 1u << test_random_below(&random, 32)
                                          : WORDS[test_random_below(&random, 10)];
            }
            world_file with = route_file_with(&file, copy, routes->blob.size);
            tl_nav_world *world = NULL;
            if (try_world(&with, &world, NULL) == TL_OK) {
                ask_all(world, &random);
                tl_nav_world_destroy(world);
                asked++;
            } else {
                refused++;
            }
            world_file_free(&with);
        }
        test_blob_free(copy);
        tl_blob_free(routes);
        world_file_free(&file);
    }
    print_message("%u hostile chunks refused, %u asked\n", refused, asked);
    TEST_CHECK(refused > 100 && asked > 100);
}

static bool stop_at_once(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)done;
    (void)total;
    return --*(int *)user > 0;
}

static void test_failures(void **state)
{
    (void)state;
    const fixture_level level = some_level(0, 15, 2);
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_routes_def def = tl_default_nav_routes_def();
    tl_nav_routes *routes = NULL;
    tl_report report;
    def.read = world_file_read;
    def.user = &file;
    for (int steps = 1; steps < 30; steps += 3) {
        int left = steps;
        const tl_progress progress = { stop_at_once, &left };
        def.host.progress = &progress;
        TEST_RESULT(tl_nav_routes_bake(&def, &routes, &report), TL_ERR_CANCELLED);
        TEST_CHECK(routes == NULL);
    }
    def.host.progress = NULL;
    // Heads can be read, tiles cannot.
    file.in.bytes[file.in.size - 100] ^= 1;
    TEST_CHECK(tl_is_error(tl_nav_routes_bake(&def, &routes, &report)) && routes == NULL);
    TEST_CHECK(report.element != NULL && strcmp(report.element, "chunk") == 0);
    world_file_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bytes),    cmocka_unit_test(test_wrong_tiles),   cmocka_unit_test(test_no_gates),
        cmocka_unit_test(test_damaged_chunk), cmocka_unit_test(test_hostile_chunk), cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
