// SPDX-License-Identifier: MIT
//
// talus path with area costs and areas that are not entered.
#include "cli_run.h"

// A floor of 20 m; across its middle a strip of area 5 with a gap at z > 6.
static void write_marsh(void)
{
    cli_write_floor("floor.obj", 20, false);
    cli_write_text("marsh.txt", "box 5 -1 -1 -10 1 1 6\n");
    cli_do(0, "bake floor.obj -o marsh.talus --areas marsh.txt");
}

static double length_of(const char *line)
{
    json_t *route = cli_json(0, line);
    assert_string_equal(json_string_value(json_object_get(route, "status")), "complete");
    const double length = cli_number(route, "length");
    json_decref(route);
    return length;
}

static void test_costs_turn_the_path(void **state)
{
    (void)state;
    write_marsh();
    const double straight = length_of("path marsh.talus -8,0,0 8,0,0 --json");
    TEST_CHECK(straight < 16.01);
    TEST_CHECK(length_of("path marsh.talus -8,0,0 8,0,0 --area-cost 5=2 --json") < 16.01); // 2 m dearer: still shorter
    const double around = length_of("path marsh.talus -8,0,0 8,0,0 --area-cost 5=20 --json");
    TEST_CHECK(around > 19.5 && around < 21.0);
    TEST_CHECK(length_of("path marsh.talus -8,0,0 8,0,0 --exclude-area 5 --json") == around);
}

static void test_excluded_ends_and_levels(void **state)
{
    (void)state;
    write_marsh();
    // The end lies in the marsh: the place nearest to it that may be entered is outside, or there is none.
    cli_result none = cli_expect(1, "path marsh.talus -8,0,0 0,0,-9 --exclude-area 5 --extents 0.2,1,0.2");
    cli_check_part(none.out, "none: no navmesh at the goal");
    cli_free(&none);
    cli_do(0, "path floor.obj -8,0,0 8,0,0 --areas marsh.txt --exclude-area 5 --radius 0.8");
    cli_do(0, "path marsh.talus -8,0,0 8,0,0 --area-cost 5=20 --prepared");
    cli_result many = cli_expect_with(0, "-8 0 0 8 0 0\n8 0 0 -8 0 0\n", "path marsh.talus --pairs - --exclude-area 5");
    TEST_CHECK(strncmp(many.out, "20.", 3) == 0 || strncmp(many.out, "19.", 3) == 0);
    cli_free(&many);
}

static void test_refusals(void **state)
{
    (void)state;
    write_marsh();
    static const char *const bad[] = { "5", "5=0", "5=-1", "5=nan", "0=2", "256=2", "=2", "5=", "mud=2" };
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); ++i) {
        char line[96];
        snprintf(line, sizeof(line), "path marsh.talus 0,0,0 1,0,1 --area-cost %s", bad[i]);
        cli_check_error(2, line, "is not ID=COST", bad[i]);
    }
    cli_check_error(2, "path marsh.talus 0,0,0 1,0,1 --exclude-area 0", "'0' is no area", "1 to 255");
    cli_check_error(2, "path marsh.talus 0,0,0 1,0,1 --area-cost 5=2 --radius 1", "--area-cost", "--radius");
    cli_check_error(0, "path marsh.talus -8,0,0 8,0,0 --area-cost 7=2", "no polygon has area 7", "talus info");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_costs_turn_the_path),
        cmocka_unit_test(test_excluded_ends_and_levels),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
