// SPDX-License-Identifier: MIT
//
// Plans: what is written comes back; every prefix, every altered byte, and what hashes right but makes no sense is
// refused.
#include "talus_test.h"

#include "io/files/file_map.h"
#include "world/bytes/little_endian.h"
#include "world/job/plan_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void make_plan(tl_world_plan *plan, tl_world_stored *inputs, tl_world_tile *tiles)
{
    static char name[] = "town", first[] = "/data/a.obj", second[] = "/data/b.stl";
    memset(plan, 0, sizeof *plan);
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 64;
    def.agent_radius = 0.35f;
    def.filter_ledge_spans = false;
    def.bounds.min = tl_vec3_make(-10.0f, 0.0f, -20.0f);
    def.bounds.max = tl_vec3_make(100.0f, 30.0f, 80.0f);
    const double origin[3] = { 1e7, 0.0, -2048.0 };
    assert_int_equal(tl_world_grid_make(&def, origin, 16.0, &plan->grid, NULL), TL_OK);
    plan->name = name;
    plan->vertices = 11;
    plan->triangles = 22;
    plan->degenerate = 3;
    plan->bounds = def.bounds;
    memset(inputs, 0, 2 * sizeof *inputs);
    inputs[0].path = first;
    inputs[0].facts.size = 1234;
    inputs[0].name.high = 99;
    inputs[0].segments = 2;
    inputs[1].path = second;
    plan->inputs = inputs;
    plan->input_count = 2;
    for (uint32_t i = 0; i < 3; i++) {
        const tl_world_tile tile = { i % 2, i / 2 + 1, 7 + i, 100 * i, { i, 2 * i } };
        tiles[i] = tile;
    }
    plan->tiles = tiles;
    plan->tile_count = 3;
}

static void round_trip(void **state)
{
    (void)state;
    tl_world_plan plan, back;
    tl_world_stored inputs[2];
    tl_world_tile tiles[3];
    tl_io_error error;
    make_plan(&plan, inputs, tiles);
    assert_int_equal(tl_world_plan_write(&plan, "round.plan", &error), TL_OK);
    assert_int_equal(tl_world_plan_read("round.plan", &back, &error), TL_OK);
    TEST_CHECK(back.grid.tiles_x == plan.grid.tiles_x && back.grid.margin == plan.grid.margin);
    TEST_CHECK(tl_content_hash_equal(tl_world_grid_hash(&back.grid), tl_world_grid_hash(&plan.grid)));
    TEST_CHECK(back.grid.def.agent_radius == 0.35f && !back.grid.def.filter_ledge_spans);
    TEST_CHECK(back.grid.origin[0] == 1e7 && back.vertices == 11 && back.triangles == 22 && back.degenerate == 3);
    TEST_CHECK(back.input_count == 2 && strcmp(back.inputs[1].path, "/data/b.stl") == 0 &&
               back.inputs[0].facts.size == 1234 && back.inputs[0].segments == 2 && back.inputs[0].name.high == 99);
    TEST_CHECK(back.tile_count == 3 && memcmp(back.tiles, tiles, sizeof tiles) == 0);
    tl_world_plan_free(&back);
    // Each setting is part of the name that keys are made from.
    plan.grid.def.detail_sample_max_error *= 2.0f;
    const tl_content_hash one = tl_world_grid_hash(&plan.grid);
    plan.grid.origin[2] += 1.0;
    TEST_CHECK(!tl_content_hash_equal(one, tl_world_grid_hash(&plan.grid)));
    remove("round.plan");
}

static tl_result decode(const unsigned char *bytes, size_t size)
{
    tl_world_plan plan;
    tl_io_error error;
    unsigned char *copy = malloc(size + 1); // so that the sanitizer sees a read behind its end
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    const tl_result result = tl_world_plan_decode(copy, size, "plan", &plan, &error);
    tl_world_plan_free(&plan);
    free(copy);
    return result;
}

static void damaged_plans_are_refused(void **state)
{
    (void)state;
    tl_world_plan plan;
    tl_world_stored inputs[2];
    tl_world_tile tiles[3];
    tl_io_error error;
    tl_file_map map;
    make_plan(&plan, inputs, tiles);
    assert_int_equal(tl_world_plan_write(&plan, "damaged.plan", &error), TL_OK);
    assert_int_equal(tl_file_read("damaged.plan", 0, &map, &error), TL_OK);
    unsigned char *bytes = malloc(map.size);
    memcpy(bytes, map.bytes, map.size);
    assert_int_equal(decode(bytes, map.size), TL_OK);
    int refused = 0;
    for (size_t i = 0; i < map.size; i++) {
        TEST_CHECK(decode(bytes, i) != TL_OK);
        bytes[i] ^= 0xff;
        TEST_CHECK(decode(bytes, map.size) != TL_OK);
        tl_put_u64(bytes + map.size - 8, tl_content_checksum(bytes, map.size - 8)); // hashed again, and still safe
        refused += decode(bytes, map.size) != TL_OK;
        memcpy(bytes, map.bytes, map.size);
    }
    TEST_CHECK(refused > 30);
    tl_put_u32(bytes + map.size - 8 - 32, 1u << 20); // a tile outside the grid
    tl_put_u64(bytes + map.size - 8, tl_content_checksum(bytes, map.size - 8));
    assert_int_equal(decode(bytes, map.size), TL_ERR_CORRUPT);
    free(bytes);
    tl_file_map_close(&map);
    remove("damaged.plan");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),
        cmocka_unit_test(damaged_plans_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
