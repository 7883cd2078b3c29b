// SPDX-License-Identifier: MIT
//
// talus bake, info and check on levels as they should be.
#include "cli_run.h"

#include <dirent.h>

static void test_courtyard(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o level.obj");
    cli_result table = cli_expect(0, "bake level.obj -o level.talus --hull");
    static const char *const rows[] = {
        "stage",    "read mesh", "weld", "clean", "rasterize", "regions", "contours",
        "polygons", "write",     "all",  "soup",  "hull",      "navmesh", "wrote    level.talus"
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); ++i) {
        cli_check_part(table.out, rows[i]);
    }
    cli_free(&table);
    json_t *bake = cli_json(0, "bake level.obj -o level.talus --hull --json");
    json_t *info = cli_json(0, "info level.talus --json");
    struct stat status;
    assert_int_equal(stat("level.talus", &status), 0);
    TEST_CHECK(cli_number(bake, "bytes") == (double)status.st_size &&
               cli_number(info, "bytes") == (double)status.st_size);
    TEST_CHECK(cli_number(bake, "soup.triangles") > 5000 && cli_number(info, "soup.triangles") > 5000);
    TEST_CHECK(cli_number(info, "soup.paired_share") > 0.8);
    TEST_CHECK(cli_number(bake, "navmesh.polygons") == cli_number(info, "navmesh.polygons"));
    TEST_CHECK(cli_number(info, "navmesh.polygons") > 40 && cli_number(info, "navmesh.area") > 500);
    TEST_CHECK(cli_number(info, "hull.vertices") >= 8);
    TEST_CHECK(cli_number(info, "navmesh.settings.agent_radius") == 0.6);
    TEST_CHECK(json_array_size(json_object_get(bake, "stages")) >= 8);
    assert_string_equal(json_string_value(json_object_get(json_object_get(info, "source"), "name")), "level.obj");
    json_decref(bake);
    json_decref(info);
    json_t *check = cli_json(0, "check level.talus --json");
    assert_true(json_is_true(json_object_get(check, "ok")));
    json_decref(check);
    cli_result text = cli_expect(0, "check level.talus");
    cli_check_part(text.out, "level.talus is whole");
    cli_free(&text);
    text = cli_expect(0, "info level.talus");
    cli_check_part(text.out, "bytes a triangle");
    cli_check_part(text.out, "agent      height 2 m, radius 0.6 m");
    cli_free(&text);
}

static void test_same_bytes(void **state)
{
    (void)state;
    cli_do(0, "sample dungeon -n 12000 -o level.obj");
    cli_do(0, "bake level.obj -o one.talus --threads 1");
    cli_do(0, "bake ./level.obj -o two.talus --threads 2");
    cli_check_same_files("one.talus", "two.talus");
    cli_do(0, "bake level.obj -o one.talus --threads 1 --tile-size 48");
    cli_do(0, "bake level.obj -o two.talus --threads 3 --tile-size 48");
    cli_check_same_files("one.talus", "two.talus");
    cli_do(0, "check one.talus");
    json_t *info = cli_json(0, "info one.talus --json");
    TEST_CHECK(cli_number(info, "navmesh.tiles") > 20);
    json_decref(info);
}

static void test_all_levels_and_partitions(void **state)
{
    (void)state;
    static const char *const names[] = { "courtyard", "dungeon", "terrain", "city" };
    static const char *const partitions[] = { "watershed", "monotone", "layers" };
    for (size_t i = 0; i < 4; ++i) {
        char line[128];
        snprintf(line, sizeof(line), "sample %s -n 15000 --seed 3 -o level.obj", names[i]);
        cli_do(0, line);
        double area[3];
        for (size_t k = 0; k < 3; ++k) {
            snprintf(line, sizeof(line), "bake level.obj -o level.talus --partition %s --json", partitions[k]);
            json_t *bake = cli_json(0, line);
            area[k] = cli_number(bake, "navmesh.area");
            json_decref(bake);
            cli_do(0, "check level.talus");
        }
        // The same floor, divided otherwise; small islands fall differently.
        TEST_CHECK(area[0] > 300);
        TEST_CHECK(area[1] > 0.9 * area[0] && area[1] < 1.1 * area[0]);
        TEST_CHECK(area[2] > 0.9 * area[0] && area[2] < 1.1 * area[0]);
    }
}

static void test_parts(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    json_t *bake = cli_json(0, "bake floor.obj -o part.talus --no-nav --json");
    assert_null(json_object_get(bake, "navmesh"));
    json_decref(bake);
    cli_check_error(3, "path part.talus 0,0,0 1,0,1", "holds no navmesh", "--no-nav");
    bake = cli_json(0, "bake floor.obj -o part.talus --no-soup --json");
    assert_null(json_object_get(bake, "soup"));
    json_decref(bake);
    cli_check_error(3, "ray part.talus 0,1,0 0,-1,0", "holds no triangles", "--no-soup");
    cli_result flat = cli_expect(0, "bake floor.obj -o part.talus --hull");
    cli_check_part(flat.err, "no hull");
    cli_free(&flat);
    cli_result piped = cli_expect(0, "bake floor.obj -o -");
    size_t size;
    char *bytes = cli_read_file("part.talus", &size);
    assert_int_equal(piped.out_size, size);
    assert_memory_equal(piped.out, bytes, size);
    free(bytes);
    cli_free(&piped);
    cli_result from_stdin = cli_run_with("v 0 0 0\nv 0 0 9\nv 9 0 9\nv 9 0 0\nf 1 2 3 4\n", "bake - -o stdin.talus");
    assert_int_equal(from_stdin.code, 0);
    cli_free(&from_stdin);
    cli_do(0, "check stdin.talus");
}

// What users of other navmesh tools set is heard: a wider agent walks less, a flatter one too.
static void test_options_matter(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o level.obj");
    static const char *const options[] = { "",
                                           "--agent-radius 1.5",
                                           "--agent-height 4",
                                           "--agent-max-climb 0.1",
                                           "--agent-max-slope 10 --agent-max-climb 0.1",
                                           "--cell-size 0.15 --cell-height 0.1",
                                           "--bounds 0,-10,0,20,20,40",
                                           "--no-filter-ledge-spans" };
    double area[8];
    for (size_t i = 0; i < 8; ++i) {
        char line[160];
        snprintf(line, sizeof(line), "bake level.obj -o level.talus --json %s", options[i]);
        json_t *bake = cli_json(0, line);
        area[i] = cli_number(bake, "navmesh.area");
        json_decref(bake);
    }
    TEST_CHECK(area[1] < 0.8 * area[0]);
    TEST_CHECK(area[2] < area[0]);
    TEST_CHECK(area[3] < area[0]);
    TEST_CHECK(area[4] <= area[3]);
    TEST_CHECK(area[5] > 0.9 * area[0] && area[5] < 1.2 * area[0]);
    TEST_CHECK(area[6] < 0.7 * area[0] && area[6] > 0.3 * area[0]);
    TEST_CHECK(area[7] > area[0]);
}

// The same floor in fewer polygons, and the file remembers how.
static void test_polygon_methods(void **state)
{
    (void)state;
    cli_do(0, "sample dungeon --triangles 3000 -o level.obj");
    static const char *const methods[] = { "classic", "optimal", "delaunay" };
    double polygons[3], area[3];
    for (size_t i = 0; i < 3; ++i) {
        char line[160];
        snprintf(line, sizeof(line), "bake level.obj -o level.talus --json --polygons %s", methods[i]);
        json_t *bake = cli_json(0, line);
        polygons[i] = cli_number(bake, "navmesh.polygons");
        area[i] = cli_number(bake, "navmesh.area");
        json_decref(bake);
        cli_do(0, "check level.talus");
        cli_result info = cli_expect(0, "info level.talus");
        snprintf(line, sizeof(line), "%s polygons", methods[i]);
        cli_check_part(info.out, line);
        cli_free(&info);
    }
    TEST_CHECK(polygons[1] < polygons[0] && polygons[1] <= polygons[2]);
    TEST_CHECK(area[1] > 0.999 * area[0] && area[1] < 1.001 * area[0]);
    TEST_CHECK(area[2] > 0.999 * area[0] && area[2] < 1.001 * area[0]);
}

static void test_real_levels(void **state)
{
    (void)state;
    DIR *folder = opendir(TALUS_DATA_DIR "/levels");
    if (folder == NULL) {
        skip();
    }
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        size_t length = strlen(entry->d_name);
        if (length > 4 && strcmp(entry->d_name + length - 4, ".obj") == 0) {
            char line[512];
            snprintf(line, sizeof(line), "bake %s/levels/%s -o real.talus", TALUS_DATA_DIR, entry->d_name);
            // Six metres wide: one cell is left of its floors.
            const bool empty = strcmp(entry->d_name, "tower-big.obj") == 0;
            cli_result bake = cli_expect(empty ? 6 : 0, line);
            cli_check_part(bake.err, empty ? "(agent): the agent is too large: with --agent-radius 0 " : "");
            TEST_CHECK(empty || bake.err[0] == '\0'); // nothing is odd about them
            cli_free(&bake);
            cli_do(empty ? 6 : 0, "check real.talus");
            count++;
        }
    }
    closedir(folder);
    TEST_CHECK(count > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_courtyard),
        cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_all_levels_and_partitions),
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_options_matter),
        cmocka_unit_test(test_polygon_methods),
        cmocka_unit_test(test_real_levels),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
