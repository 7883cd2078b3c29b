// SPDX-License-Identifier: MIT
//
// A tile's file that changes between the two passes of a merge: nothing is written, and the tile is named. And checks
// of merged files: every prefix and every altered byte is refused.
#include "talus_test.h"

#include "io/files/file_map.h"
#include "world/bytes/folder.h"
#include "world/job/merge_tiles.h"
#include "world/job/plan_world.h"
#include "world/job/tile_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILES = 16 };

static void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

// A floor of 60 m in 4 x 4 tiles.
static int make_job(void **state)
{
    (void)state;
    static const char floor_text[] = "v 0 0 0\nv 60 0 0\nv 60 0 60\nv 0 0 60\nf 1 4 3 2\n";
    assert_int_equal(system("rm -rf merge_tiles_job"), 0); // of a run that failed
    write_bytes("merge_tiles.obj", floor_text, sizeof floor_text - 1);
    tl_world_plan_def plan = {
        .input = "merge_tiles.obj", .job = "merge_tiles_job", .nav = tl_default_nav_def(), .memory = 1 << 24
    };
    tl_world_bake_def bake = { .job = "merge_tiles_job", .shard = { 0, 1, NULL } };
    tl_world_plan_report planned;
    tl_world_bake_report baked;
    tl_io_error error;
    plan.nav.tile_size = 50;
    plan.reading.scale = 1.0f;
    assert_int_equal(tl_world_plan_make(&plan, &planned, &error), TL_OK);
    assert_int_equal(tl_world_bake(&bake, &baked, &error), TL_OK);
    TEST_CHECK(planned.tiles == TILES && baked.tiles == TILES);
    return 0;
}

static char *path_of_tile(uint64_t index)
{
    tl_world_plan plan;
    tl_io_error error;
    assert_int_equal(tl_world_plan_of_job("merge_tiles_job", &plan, &error), TL_OK);
    assert_true(index < plan.tile_count);
    char *path = tl_world_tile_path("merge_tiles_job", plan.tiles[index].key);
    tl_world_plan_free(&plan);
    assert_non_null(path);
    return path;
}

// What a hook does to a tile's file when the second pass begins.
typedef struct meddler {
    const char *path;
    const void *bytes; // NULL: it is taken away
    size_t size;
    bool done, cancels;
} meddler;

static bool meddle(const char *stage, uint64_t done, uint64_t total, void *user)
{
    meddler *m = user;
    TEST_CHECK(done <= total);
    if (!m->done && strcmp(stage, "write tiles") == 0) {
        m->done = true;
        if (m->path != NULL && m->bytes == NULL) {
            tl_file_remove(m->path);
        } else if (m->path != NULL) {
            write_bytes(m->path, m->bytes, m->size);
        }
        return !m->cancels;
    }
    return true;
}

static tl_result merge_floor(meddler *m, tl_io_error *error)
{
    const tl_progress progress = { meddle, m };
    tl_world_merge_def def = { .job = "merge_tiles_job", .output = "merge_tiles.talus" };
    tl_world_merge_report report;
    memset(error, 0, sizeof *error);
    def.host.progress = m != NULL ? &progress : NULL;
    return tl_world_merge(&def, &report, error);
}

static void check_untouched(meddler *m, tl_result expected, const char *part)
{
    tl_io_error error;
    remove("merge_tiles.talus");
    assert_int_equal(merge_floor(m, &error), expected);
    TEST_CHECK(m->done && error.result == expected);
    TEST_CHECK(strstr(error.message, part) != NULL);
    TEST_CHECK(!tl_file_look("merge_tiles.talus", NULL));
}

static void test_changes_between_passes(void **state)
{
    (void)state;
    tl_file_map tile, other;
    tl_io_error error;
    char *path = path_of_tile(9), *other_path = path_of_tile(3);
    assert_int_equal(tl_file_read(path, 0, &tile, &error), TL_OK);
    assert_int_equal(tl_file_read(other_path, 0, &other, &error), TL_OK);
    unsigned char *bytes = malloc(tile.size);
    assert_non_null(bytes);
    memcpy(bytes, tile.bytes, tile.size);
    bytes[tile.size - 40] ^= 1;
    meddler altered = { .path = path, .bytes = bytes, .size = tile.size };
    check_untouched(&altered, TL_ERR_HASH, "tile 1,2 changed while it was merged");
    write_bytes(path, tile.bytes, tile.size);
    // Another tile's sound file in its place.
    meddler exchanged = { .path = path, .bytes = other.bytes, .size = other.size };
    check_untouched(&exchanged, TL_ERR_CORRUPT, "tile 1,2 is another tile than its name says");
    write_bytes(path, tile.bytes, tile.size);
    // A sound file of that tile with other content, no layers: its header and its checksums are right.
    const tl_nav_tile_stack empty = { 0 };
    tl_world_plan plan;
    tl_file_map none;
    assert_int_equal(tl_world_plan_of_job("merge_tiles_job", &plan, &error), TL_OK);
    assert_int_equal(tl_world_tile_write("merge_tiles_none.tile", &plan.tiles[9], &empty, &error), TL_OK);
    tl_world_plan_free(&plan);
    assert_int_equal(tl_file_read("merge_tiles_none.tile", 0, &none, &error), TL_OK);
    meddler emptied = { .path = path, .bytes = none.bytes, .size = none.size };
    check_untouched(&emptied, TL_ERR_HASH, "tile 1,2 changed while it was merged");
    tl_file_map_close(&none);
    write_bytes(path, tile.bytes, tile.size);
    meddler removed = { .path = path };
    check_untouched(&removed, TL_ERR_IO, "cannot open");
    write_bytes(path, tile.bytes, tile.size);
    meddler cancels = { .cancels = true };
    check_untouched(&cancels, TL_ERR_CANCELLED, "cancelled");
    assert_int_equal(merge_floor(NULL, &error), TL_OK);
    tl_file_map_close(&tile);
    tl_file_map_close(&other);
    free(bytes);
    free(path);
    free(other_path);
}

static tl_result check_bytes(const unsigned char *bytes, size_t size, tl_io_error *error)
{
    tl_world_check_report report;
    write_bytes("merge_tiles_changed.talus", bytes, size);
    return tl_world_check("merge_tiles_changed.talus", &report, error);
}

static void test_damaged_files(void **state)
{
    (void)state;
    tl_file_map map;
    tl_io_error error;
    tl_world_check_report report;
    assert_int_equal(merge_floor(NULL, &error), TL_OK);
    assert_int_equal(tl_world_check("merge_tiles.talus", &report, &error), TL_OK);
    TEST_CHECK(report.tiles == TILES && report.polygons >= TILES && report.tiles_x == 4 && report.tiles_z == 4);
    assert_int_equal(tl_file_read("merge_tiles.talus", 0, &map, &error), TL_OK);
    unsigned char *bytes = malloc(map.size + 1);
    assert_non_null(bytes);
    memcpy(bytes, map.bytes, map.size);
    bytes[map.size] = 0;
    TEST_CHECK(check_bytes(bytes, map.size, &error) == TL_OK);
    TEST_CHECK(check_bytes(bytes, map.size + 1, &error) == TL_ERR_CORRUPT);
    uint32_t refused = 0, tried = 0;
    for (size_t i = 0; i < map.size; i += i < 256 ? 1 : 61) {
        memset(&error, 0, sizeof error);
        bytes[i] ^= 1;
        refused += check_bytes(bytes, map.size, &error) != TL_OK && error.message[0] != '\0';
        bytes[i] ^= 1;
        refused += check_bytes(bytes, i, &error) != TL_OK;
        tried++;
    }
    TEST_CHECK(tried > 400 && refused == 2 * tried);
    free(bytes);
    tl_file_map_close(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_changes_between_passes),
        cmocka_unit_test(test_damaged_files),
    };
    return cmocka_run_group_tests(tests, make_job, NULL);
}
