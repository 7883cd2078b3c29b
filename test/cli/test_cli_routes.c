// SPDX-License-Identifier: MIT
//
// talus world routes and route: the same bytes, and answers that the path over the whole navmesh lies within.
#include "cli_run.h"

#include "memory_file.h"

#include <talus/pack.h>

static void make_world(void)
{
    cli_do(0, "sample city -n 20000 -o city.obj");
    cli_do(0, "world plan city.obj -o job --tile-size 48");
    cli_do(0, "world bake job");
    cli_do(0, "world merge job -o city.talus");
}

static void test_routes(void **state)
{
    (void)state;
    make_world();
    cli_do(0, "world routes city.talus -o with.talus");
    cli_do(0, "world routes with.talus"); // in place of those that it has
    cli_do(0, "world routes city.talus -o again.talus --threads 1");
    cli_check_same_files("with.talus", "again.talus");
    cli_do(0, "world check with.talus");
    cli_do(0, "check with.talus");
    static const char *const ends[] = { "5,0,5 45,0,150", "10,0,10 40,0,140", "30,0,60 6,0,100", "5,0,5 6,0,6" };
    for (int i = 0; i < 4; i++) {
        char line[128];
        snprintf(line, sizeof line, "world route with.talus %s --json", ends[i]);
        json_t *route = cli_json(0, line);
        snprintf(line, sizeof line, "path with.talus %s --json", ends[i]);
        json_t *path = cli_json(0, line);
        const double length = cli_number(path, "length");
        assert_true(cli_number(route, "length") >= length * (1.0 - 1e-3) - 0.05); // of the path, in space
        assert_true(cli_number(route, "lower_bound") <= length * (1.0 + 1e-6));
        assert_true(cli_number(route, "lower_bound") > 0.5 * length);
        assert_true(json_array_size(json_object_get(route, "points")) >= 2);
        json_decref(route);
        json_decref(path);
    }
}

static void test_no_answers(void **state)
{
    (void)state;
    make_world();
    cli_do(0, "world routes city.talus -o with.talus --block 2");
    json_t *route = cli_json(1, "world route with.talus 5,0,5 5000,0,5 --json");
    assert_string_equal(json_string_value(json_object_get(route, "status")), "no navmesh at the goal");
    json_decref(route);
    cli_do(1, "world route with.talus 5,0,5 5000,0,5");
    cli_do(2, "world route with.talus 5,0,5");
    cli_do(2, "world route with.talus 5,0,5 5,0");
    cli_do(2, "world routes city.talus --block 3");
    cli_do(2, "world routes city.talus -o x.talus --shard 1/2");
    cli_do(2, "world plan city.obj 1,2,3 -o other");
    cli_check_error(4, "world routes missing.talus", "missing.talus", "");
    cli_check_error(3, "world route city.talus 5,0,5 45,0,150", "holds no routes", "talus world routes");
}

static void test_picture(void **state)
{
    (void)state;
    make_world();
    cli_do(0, "world routes city.talus -o with.talus");
    cli_do(0, "world route with.talus 5,0,5 45,0,150 -o route.png --size 300");
    cli_do(0, "world route with.talus 5,0,5 45,0,150 -o again.png --size 300");
    cli_check_same_files("route.png", "again.png");
    cli_do(0, "world route with.talus 5,0,5 45,0,150 -o route.svg");
    cli_do(0, "world route with.talus 5,0,5 5,0,5 -o point.png"); // from here to here
    assert_true(cli_exists("route.png") && cli_exists("route.svg") && cli_exists("point.png"));
    cli_do(1, "world route with.talus 5,0,5 5000,0,5 -o none.png");
    assert_false(cli_exists("none.png"));
    cli_check_error(2, "world route with.talus 5,0,5 45,0,150 -o route.talus", "route.talus", ".png or .svg");
    cli_do(2, "world routes city.talus --size 300");
}

// The chunks of a file without its routes, and the routes of another.
static void put_routes(const char *tiles, const char *routes, const char *out)
{
    const char *const paths[] = { tiles, routes };
    tl_pack_item items[4096];
    uint32_t count = 0;
    void *blocks[2];
    memory_file file = { NULL, 0, 0 };
    for (int i = 0; i < 2; i++) {
        size_t size;
        tl_pack pack;
        char *bytes = cli_read_file(paths[i], &size);
        blocks[i] = test_blob_alloc(size);
        memcpy(blocks[i], bytes, size);
        free(bytes);
        TEST_RESULT(tl_pack_open(blocks[i], size, &pack, NULL), TL_OK);
        for (uint32_t k = 0; k < pack.chunk_count; k++) {
            const tl_pack_chunk chunk = tl_pack_chunk_at(&pack, k);
            if ((chunk.type == TL_PACK_ROUT) == (i == 1)) {
                const tl_pack_item item = { chunk.type, chunk.id, chunk.bytes, chunk.size };
                assert_true(count < 4096);
                items[count++] = item;
            }
        }
    }
    TEST_RESULT(tl_pack_write(items, count, NULL, memory_file_write, &file, NULL), TL_OK);
    cli_write_file(out, file.bytes, file.size);
    test_blob_free(blocks[0]);
    test_blob_free(blocks[1]);
    free(file.bytes);
}

// Routes of other tiles are refused by whoever reads them, and links leave them out.
static void test_routes_of_other_tiles(void **state)
{
    (void)state;
    make_world();
    cli_do(0, "world routes city.talus -o with.talus");
    put_routes("with.talus", "with.talus", "same.talus");
    cli_check_same_files("with.talus", "same.talus");
    cli_do(0, "sample city -n 20000 --seed 2 -o other.obj");
    cli_do(0, "bake other.obj -o other.talus --tile-size 48");
    put_routes("other.talus", "with.talus", "mixed.talus");
    cli_result check = cli_expect(1, "check mixed.talus");
    cli_check_part(check.out, "routes: of other tiles");
    cli_free(&check);
    cli_check_error(3, "world check mixed.talus", "of other tiles", "bake the routes again");
    cli_check_error(3, "world route mixed.talus 5,0,5 45,0,150", "other tiles", "");
    cli_do(0, "world routes mixed.talus"); // new ones
    cli_do(0, "world check mixed.talus");
    cli_result links = cli_expect(0, "links mixed.talus -o linked.talus");
    cli_check_part(links.err, "its routes know nothing of links");
    cli_free(&links);
    cli_do(0, "check linked.talus");
    json_t *info = cli_json(0, "info linked.talus --json");
    char *text = json_dumps(info, 0);
    assert_null(strstr(text, "ROUT"));
    free(text);
    json_decref(info);
}

// Of more than 2048 tiles a picture is painted tile by tile; what it counts is what the whole navmesh has.
static void test_large_ground(void **state)
{
    (void)state;
    cli_do(0, "sample city -n 5000 -o city.obj");
    cli_do(0, "world plan city.obj -o job --tile-size 8");
    cli_do(0, "world bake job");
    cli_do(0, "world merge job -o city.talus");
    static const char *const views[] = { "top", "oblique" }; // streamed; in memory
    char polygons[2][64];
    for (int i = 0; i < 2; i++) {
        char line[128];
        snprintf(line, sizeof line, "draw city.talus -o %s.png --stage navmesh --size 300 --view %s --json", views[i],
                 views[i]);
        json_t *answer = cli_json(0, line);
        json_t *picture = json_array_get(json_object_get(answer, "pictures"), 0);
        const char *summary = json_string_value(json_object_get(picture, "summary"));
        unsigned tiles = 0, count = 0;
        assert_int_equal(sscanf(summary, i == 0 ? "%u tiles, %u polygons" : "%u polygons in %u tiles",
                                i == 0 ? &tiles : &count, i == 0 ? &count : &tiles),
                         2);
        assert_true(tiles > 2048 && count > tiles);
        snprintf(polygons[i], sizeof polygons[i], "%u of %u", count, tiles);
        json_decref(answer);
    }
    assert_string_equal(polygons[0], polygons[1]);
    cli_do(0, "draw city.talus -o again.png --stage navmesh --size 300");
    cli_check_same_files("top.png", "again.png");
    cli_do(0, "draw city.talus -o ground.svg");
    assert_true(cli_exists("ground.svg"));
    cli_damage("city.talus", false);
    cli_check_error(3, "draw city.talus -o damaged.png", "city.talus", "its content was altered");
    assert_false(cli_exists("damaged.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_routes),       cmocka_unit_test(test_no_answers),
        cmocka_unit_test(test_picture),      cmocka_unit_test(test_routes_of_other_tiles),
        cmocka_unit_test(test_large_ground),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
