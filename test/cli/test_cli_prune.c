// SPDX-License-Identifier: MIT
//
// talus bake with --drop-inside-solids, --reachable-from and --island-min-area: what is left out is counted, in words
// and in JSON, and nothing else goes.

#include "cli_run.h"

static double left_out(const json_t *bake, const char *what)
{
    char path[96];
    snprintf(path, sizeof path, "navmesh.left_out.%s.square_metres", what);
    return cli_number(bake, path);
}

static json_t *bake(const char *options)
{
    char line[256];
    snprintf(line, sizeof line, "bake yard.obj -o %s --json", options);
    json_t *object = cli_json(0, line);
    cli_do(0, "check out.talus");
    const double sum =
        left_out(object, "inside_solids") + left_out(object, "unreachable") + left_out(object, "small_islands");
    json_t *whole = cli_json(0, "bake yard.obj -o whole.talus --json");
    // The courtyard is baked with and without tiles; the sum of what is there and what is not hardly differs.
    TEST_CHECK(fabs(cli_number(object, "navmesh.area") + sum - cli_number(whole, "navmesh.area")) < 40.0);
    json_decref(whole);
    return object;
}

static void test_pruning(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o yard.obj");
    json_t *plain = bake("out.talus");
    TEST_CHECK(left_out(plain, "inside_solids") == 0.0 && left_out(plain, "small_regions") > 0.0);
    json_decref(plain);
    for (int tiles = 0; tiles < 2; tiles++) {
        const char *const size = tiles ? "--tile-size 40" : "";
        char options[192];
        snprintf(options, sizeof options, "out.talus --drop-inside-solids %s", size);
        json_t *inside = bake(options); // the walls are hollow
        TEST_CHECK(left_out(inside, "inside_solids") > 150.0 && left_out(inside, "unreachable") == 0.0);
        TEST_CHECK(cli_number(inside, "navmesh.left_out.inside_solids.islands") == 4.0);
        snprintf(options, sizeof options, "out.talus --reachable-from 20,0,30 --reachable-from 20,5,20 %s", size);
        json_t *reachable = bake(options);
        TEST_CHECK(left_out(reachable, "unreachable") > left_out(inside, "inside_solids"));
        TEST_CHECK(cli_number(reachable, "navmesh.area") > 800.0);
        snprintf(options, sizeof options, "out.talus --island-min-area 60 %s", size);
        json_t *large = bake(options);
        TEST_CHECK(left_out(large, "small_islands") > 100.0);
        json_decref(inside);
        json_decref(reachable);
        json_decref(large);
    }
    cli_result words = cli_expect(0, "bake yard.obj -o out.talus --drop-inside-solids --reachable-from 20,0,30");
    cli_check_part(words.out, "m2: inside solids");
    cli_check_part(words.out, "m2: fewer cells than --region-min-size squared");
    cli_free(&words);
    // Pruning does not depend on threads.
    cli_do(0, "bake yard.obj -o one.talus --drop-inside-solids --tile-size 40 --threads 1");
    cli_do(0, "bake yard.obj -o two.talus --drop-inside-solids --tile-size 40 --threads 2");
    size_t one_size, two_size;
    char *one = cli_read_file("one.talus", &one_size), *two = cli_read_file("two.talus", &two_size);
    TEST_CHECK(one_size == two_size && memcmp(one, two, one_size) == 0);
    free(one);
    free(two);
}

static void test_refusals(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o yard.obj");
    cli_check_error(3, "bake yard.obj -o none.talus --reachable-from 20,0,30 --reachable-from 20,90,20",
                    "--reachable-from 20,90,20", "no navmesh within 2 m");
    cli_check_error(2, "bake yard.obj -o none.talus --reachable-from 20,0", "--reachable-from", "x,y,z");
    cli_check_error(2, "bake yard.obj -o none.talus --island-min-area -1", "--island-min-area", "out of range");
    TEST_CHECK(!cli_exists("none.talus"));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_pruning), cmocka_unit_test(test_refusals) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
