// SPDX-License-Identifier: MIT
//
// Paths, nearest points and rays in a world of which a part is in memory, held against the same world in memory whole;
// and a world far from the origin against the same one at it.

#include "nav_world_file.h"

static const double HERE[3] = { 0, 0, 0 };
static const tl_vec3 EXTENTS = { 3, 60, 3 };

typedef struct counts {
    uint32_t proven, open, unreachable, unfinished, near_open, near_ok, none;
} counts;

static double edge_of(const fixture_level *level)
{
    return (double)level->width * (double)FIXTURE_STEP * (double)level->cell_size;
}

static void random_place(test_random *random, const fixture_level *level, const double origin[3], double out[3])
{
    const double edge = edge_of(level);
    out[0] = origin[0] + (double)test_random_unit(random) * edge;
    out[1] = origin[1] + (double)test_random_range(random, -1.0f, 4.0f);
    out[2] = origin[2] + (double)test_random_unit(random) * edge;
}

static double distance_of(const double a[3], const double b[3])
{
    const double d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

// The nearest point in the part and in the whole.
static bool compare_nearest(const tl_nav_world *part, const tl_nav_world *whole, const double at[3],
                            tl_nav_location found[2], counts *n)
{
    double a[3], b[3];
    const tl_result in_part = tl_nav_world_find_nearest(part, NULL, at, EXTENTS, &found[0]);
    const tl_result in_whole = tl_nav_world_find_nearest(whole, NULL, at, EXTENTS, &found[1]);
    TEST_CHECK(in_whole == TL_OK || in_whole == TL_NOT_FOUND);
    if (in_part == TL_NOT_LOADED) {
        n->near_open++;
        return false;
    }
    TEST_RESULT(in_part, in_whole);
    n->none += in_part == TL_NOT_FOUND;
    if (in_part == TL_NOT_FOUND) {
        return false;
    }
    tl_nav_world_place_out(part, found[0].point, a);
    tl_nav_world_place_out(whole, found[1].point, b);
    TEST_CHECK(distance_of(a, at) < distance_of(b, at) + 1e-4 && distance_of(b, at) < distance_of(a, at) + 1e-4);
    n->near_ok++;
    return true;
}

static void compare_paths(const tl_nav_world *part, const tl_nav_world *whole, tl_nav_query *query,
                          tl_nav_location start[2], tl_nav_location goal[2], counts *n)
{
    tl_nav_corner corners[256];
    const tl_nav_path_buffers buffers = { NULL, 0, corners, 256 };
    const tl_nav_path_request in_part = { NULL, start[0], goal[0] }, in_whole = { NULL, start[1], goal[1] };
    tl_nav_shortest_path path, truth;
    TEST_RESULT(tl_nav_world_find_path(whole, query, &in_whole, NULL, &truth), TL_OK);
    const tl_result result = tl_nav_world_find_path(part, query, &in_part, &buffers, &path);
    const bool is_way = truth.status == TL_NAV_PATH_COMPLETE;
    if (result == TL_OK) {
        TEST_CHECK(path.status == truth.status);
        TEST_CHECK(!is_way || fabs(path.length - truth.length) <= 1e-5 * (1.0 + truth.length));
        n->proven += is_way;
        n->unreachable += !is_way;
        return;
    }
    TEST_RESULT(result, TL_NOT_LOADED);
    TEST_CHECK(!is_way || path.lower_bound <= truth.length * (1.0 + 1e-6) + 1e-5);
    if (path.status == TL_NAV_PATH_COMPLETE) {
        TEST_CHECK(is_way && path.length >= truth.length * (1.0 - 1e-6) - 1e-5 && path.corner_count >= 2);
        n->open++;
    } else {
        TEST_CHECK(path.status == TL_NAV_PATH_UNFINISHED && path.corner_count == 0);
        n->unfinished++;
    }
}

static void test_part_against_whole(void **state)
{
    (void)state;
    test_random random = { 11 };
    counts n = { 0 };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t kind = 0; kind < 18; kind++) {
        fixture_level level = fixture_random(&random, kind % 6, 40);
        level.tile_cells = 5;
        level.detail = kind % 2 == 1;
        world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
        tl_nav_world *part = world_open(&file, (uint64_t)64 << 20, 4096.0);
        tl_nav_world *whole = world_open(&file, (uint64_t)64 << 20, 4096.0);
        const double edge = edge_of(&level);
        const tl_nav_world_interest all = world_interest(HERE, 0.5 * edge, 0.5 * edge, 10.0 * edge);
        world_settle(whole, &all, 1);
        TEST_CHECK(world_state(whole).loaded == world_state(whole).places && world_state(whole).missing == 0);
        for (uint32_t round = 0; round < 6; round++) {
            double centers[4];
            for (int i = 0; i < 4; i++) {
                centers[i] = (double)test_random_unit(&random) * edge;
            }
            const tl_nav_world_interest some[2] = { world_interest(HERE, centers[0], centers[1], 0.3 * edge),
                                                    world_interest(HERE, centers[2], centers[3], 0.2 * edge) };
            // Tiles of rounds before are still there: a new world sees few tiles.
            tl_nav_world_destroy(part);
            part = world_open(&file, (uint64_t)64 << 20, round % 2 == 0 ? 4096.0 : 16.0);
            world_settle(part, some, 2);
            for (uint32_t pair = 0; pair < 40; pair++) {
                double from[3], to[3];
                tl_nav_location start[2], goal[2];
                random_place(&random, &level, HERE, from);
                random_place(&random, &level, HERE, to);
                if (compare_nearest(part, whole, from, start, &n) && compare_nearest(part, whole, to, goal, &n)) {
                    compare_paths(part, whole, query, start, goal, &n);
                }
            }
        }
        tl_nav_world_destroy(part);
        tl_nav_world_destroy(whole);
        world_file_free(&file);
    }
    tl_nav_query_destroy(query);
    print_message(
        "paths: %u proven, %u open, %u proven unreachable, %u unfinished; nearest: %u proven, %u open, %u none\n",
        n.proven, n.open, n.unreachable, n.unfinished, n.near_ok, n.near_open, n.none);
    TEST_CHECK(n.proven > 100 && n.open > 20 && n.unreachable > 5 && n.unfinished > 20);
    TEST_CHECK(n.near_ok > 500 && n.near_open > 500 && n.none > 20);
}

// The same rays in the part and in the whole: they end at the same place, or the part says that it may go on.
static void test_rays(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t same = 0, open = 0, hits = 0;
    counts n = { 0 };
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 40);
        level.tile_cells = 5;
        world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
        tl_nav_world *part = world_open(&file, (uint64_t)64 << 20, 4096.0);
        tl_nav_world *whole = world_open(&file, (uint64_t)64 << 20, 4096.0);
        const double edge = edge_of(&level);
        const tl_nav_world_interest all = world_interest(HERE, 0.4 * edge, 0.4 * edge, 10.0 * edge);
        const tl_nav_world_interest some = world_interest(HERE, 0.4 * edge, 0.4 * edge, 0.3 * edge);
        world_settle(whole, &all, 1);
        world_settle(part, &some, 1);
        for (uint32_t ray = 0; ray < 300; ray++) {
            double from[3], to[3], a[3], b[3];
            tl_nav_location start[2];
            tl_nav_ray_hit hit, truth;
            random_place(&random, &level, HERE, from);
            random_place(&random, &level, HERE, to);
            if (!compare_nearest(part, whole, from, start, &n)) {
                continue;
            }
            TEST_RESULT(tl_nav_world_cast_ray(whole, NULL, &start[1], to, &truth), TL_OK);
            const tl_result result = tl_nav_world_cast_ray(part, NULL, &start[0], to, &hit);
            if (result == TL_NOT_LOADED) {
                TEST_CHECK(hit.hit && hit.t <= truth.t + 1e-4f);
                open++;
                continue;
            }
            TEST_RESULT(result, TL_OK);
            tl_nav_world_place_out(part, hit.point, a);
            tl_nav_world_place_out(whole, truth.point, b);
            // Rays that graze a corner may stop or not by a rounding of the start.
            same += hit.hit == truth.hit && fabs(a[0] - b[0]) + fabs(a[2] - b[2]) < 1e-3;
            hits += hit.hit;
        }
        tl_nav_world_destroy(part);
        tl_nav_world_destroy(whole);
        world_file_free(&file);
    }
    print_message("rays: %u the same, %u of %u hits, %u open\n", same, hits, n.near_ok, open);
    TEST_CHECK(same + open == n.near_ok && hits > 50 && open > 50);
}

// Asks a world at an origin, and gives all answers less the origin.
static uint64_t answers_at(const fixture_level *shape, const double origin[3], uint32_t kind, counts *n)
{
    fixture_level level = *shape;
    test_random random = { 99 + kind };
    world_file file = world_file_make(&level, origin, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 32.0);
    const double edge = edge_of(&level);
    uint64_t hash = 0;
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t step = 0; step < 12; step++) {
        const double at = edge * (double)step / 12.0;
        const tl_nav_world_interest interest = world_interest(origin, at, at, 0.4 * edge);
        world_settle(world, &interest, 1);
        for (uint32_t pair = 0; pair < 20; pair++) {
            double ends[2][3];
            tl_nav_location found[2];
            tl_result result = TL_OK;
            for (int e = 0; e < 2 && !tl_is_error(result); e++) {
                // Sixteenths: the same number at any origin of up to 2^48.
                ends[e][0] = origin[0] + floor((double)test_random_unit(&random) * edge * 16.0) / 16.0;
                ends[e][1] = origin[1] + (double)test_random_below(&random, 64) / 16.0;
                ends[e][2] = origin[2] + floor((double)test_random_unit(&random) * edge * 16.0) / 16.0;
                result = tl_nav_world_find_nearest(world, NULL, ends[e], EXTENTS, &found[e]);
                hash = fixture_hash(hash, (uint64_t)result);
                uint32_t bits[3];
                memcpy(bits, &found[e].point, sizeof bits);
                hash = fixture_hash(fixture_hash(hash, bits[0]), (uint64_t)bits[1] << 32 | bits[2]);
            }
            if (found[0].polygon == TL_NAV_NO_REF || found[1].polygon == TL_NAV_NO_REF) {
                continue;
            }
            const tl_nav_path_request request = { NULL, found[0], found[1] };
            tl_nav_shortest_path path;
            hash = fixture_hash(hash, (uint64_t)tl_nav_world_find_path(world, query, &request, NULL, &path));
            uint64_t length;
            memcpy(&length, &path.length, sizeof length);
            hash = fixture_hash(fixture_hash(hash, length), (uint64_t)path.status);
            n->proven += path.status == TL_NAV_PATH_COMPLETE;
        }
    }
    TEST_CHECK(world_state(world).frames > 3);
    tl_nav_query_destroy(query);
    tl_nav_world_destroy(world);
    world_file_free(&file);
    return hash;
}

static void test_far_from_the_origin(void **state)
{
    (void)state;
    static const double FAR[4][3] = { { 0, 0, 0 }, { 1e7, 0, -1e7 }, { -3e9, 1024, 123456789 }, { 4096.5, -8, 1e12 } };
    test_random random = { 3 };
    counts n = { 0 };
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 32);
        level.tile_cells = 4;
        level.detail = kind % 2 == 0;
        const uint64_t here = answers_at(&level, FAR[0], kind, &n);
        for (int i = 1; i < 4; i++) {
            TEST_CHECK(answers_at(&level, FAR[i], kind, &n) == here);
        }
    }
    TEST_CHECK(n.proven > 1000);
}

// Far from the file's own origin too, where its floats are a metre apart, points are exact near the frame, and a point
// over a polygon stays where it is.
static void test_far_within_the_world(void **state)
{
    (void)state;
    test_random random = { 17 };
    fixture_level level = fixture_random(&random, 1, 32);
    level.tile_cells = 4;
    level.origin = tl_vec3_make(-9000000, 0, 12000000);
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
    const double center[3] = { -9000000 + 0.5 * edge_of(&level), 0, 12000000 + 0.5 * edge_of(&level) };
    const tl_nav_world_interest interest = world_interest(center, 0, 0, 1e4);
    world_settle(world, &interest, 1);
    uint32_t inside = 0;
    for (uint32_t i = 0; i < 500; i++) {
        double at[3], back[3];
        tl_nav_location location;
        for (int k = 0; k < 3; k++) {
            at[k] = center[k] + ((double)test_random_below(&random, 1024) - 512.0) / 16.0;
        }
        tl_nav_world_place_out(world, tl_nav_world_place_in(world, at), back);
        TEST_CHECK(back[0] == at[0] && back[1] == at[1] && back[2] == at[2]);
        if (tl_nav_world_find_nearest(world, NULL, at, EXTENTS, &location) == TL_OK) {
            tl_nav_world_place_out(world, location.point, back);
            inside += back[0] == at[0] && back[2] == at[2];
        }
    }
    print_message("%u of 500 points over a polygon\n", inside);
    TEST_CHECK(inside > 100);
    tl_nav_world_destroy(world);
    world_file_free(&file);
}

static void test_axes(void **state)
{
    (void)state;
    test_random random = { 3 };
    fixture_level level = fixture_random(&random, 1, 32);
    level.tile_cells = 4;
    level.origin = tl_vec3_make(-64, 0, 32);
    static const double origin[3] = { 1e6, -2e6, 77 };
    for (int axes = 0; axes < 4; axes++) {
        world_file file = world_file_make(&level, origin, (tl_pack_axes)axes);
        tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
        tl_pack_frame *frame = NULL;
        TEST_RESULT(tl_pack_frame_encode((tl_pack_axes)axes, origin, NULL, &frame, NULL), TL_OK);
        // The frame of the pack and that of the world agree where the world's frame lies at the file's 0.
        for (int i = 0; i < 100; i++) {
            double point[3], back[3];
            for (int k = 0; k < 3; k++) {
                point[k] = origin[k] + (double)test_random_below(&random, 1000) / 8.0;
            }
            const tl_vec3 in = tl_nav_world_place_in(world, point), expected = tl_pack_place_in(frame, point);
            const tl_vec3 moved = tl_sub(expected, tl_vec3_make(level.origin.x, 0, level.origin.z));
            TEST_CHECK(in.x == moved.x && in.y == moved.y && in.z == moved.z);
            tl_nav_world_place_out(world, in, back);
            TEST_CHECK(back[0] == point[0] && back[1] == point[1] && back[2] == point[2]);
        }
        tl_blob_free(frame);
        tl_nav_world_destroy(world);
        world_file_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_part_against_whole),
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_far_from_the_origin),
        cmocka_unit_test(test_far_within_the_world),
        cmocka_unit_test(test_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
