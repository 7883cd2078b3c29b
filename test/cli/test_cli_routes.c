// SPDX-License-Identifier: MIT
//
// talus world routes and route: the same bytes, and answers that the path over the whole navmesh lies within.
#include "cli_run.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_routes),
        cmocka_unit_test(test_no_answers),
        cmocka_unit_test(test_picture),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
