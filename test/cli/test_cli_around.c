// SPDX-License-Identifier: MIT
//
// talus around.
#include "cli_run.h"

#include <math.h>

static uint32_t lines_of(const char *text)
{
    uint32_t count = 0;
    for (; *text != '\0'; ++text) {
        count += *text == '\n';
    }
    return count;
}

static void test_walls(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_do(0, "bake floor.obj -o floor.talus");
    cli_result all = cli_expect(0, "around floor.talus 0,0,0 --radius 20");
    uint32_t count = 0;
    float nearest = 0.0f;
    TEST_CHECK(sscanf(all.out, "%u\n%f", &count, &nearest) == 2);
    // The floor is 20 m wide; its walls stand in by the agent's radius.
    TEST_CHECK(count >= 4 && lines_of(all.out) == count + 1 && nearest > 8.5f && nearest < 10.0f);
    cli_free(&all);
    cli_result none = cli_expect(0, "around floor.talus 0,0,0 --radius 2");
    assert_string_equal(none.out, "0\n");
    cli_free(&none);
    json_t *object = cli_json(0, "around floor.talus 0,0,0 --radius 20 --json");
    json_t *walls = json_object_get(object, "walls");
    TEST_CHECK(json_array_size(walls) == count);
    TEST_CHECK(fabs(cli_number(json_array_get(walls, 0), "distance") - (double)nearest) < 1e-4);
    json_decref(object);
    none = cli_expect(1, "around floor.talus 500,0,0");
    assert_string_equal(none.out, "none: no navmesh there\n");
    cli_free(&none);
}

static void test_reach(void **state)
{
    (void)state;
    cli_write_floor("wall.obj", 20, true);
    cli_do(0, "bake wall.obj -o wall.talus --tile-size 32");
    json_t *near_by = cli_json(0, "around wall.talus -5,0,0 --list polygons --radius 0 --json");
    json_t *far_off = cli_json(0, "around wall.talus -5,0,0 --list polygons --radius 100 --json");
    json_t *far_polygons = json_object_get(far_off, "polygons");
    TEST_CHECK(json_array_size(json_object_get(near_by, "polygons")) >= 1 && json_array_size(far_polygons) >= 2);
    TEST_CHECK(cli_number(json_array_get(far_polygons, 0), "cost") == 0.0);
    json_decref(near_by);
    json_decref(far_off);
}

static void test_random_points(void **state)
{
    (void)state;
    cli_write_floor("wall.obj", 20, true);
    cli_do(0, "bake wall.obj -o wall.talus");
    cli_result first = cli_expect(0, "around wall.talus --random 500 --seed 7");
    cli_result again = cli_expect(0, "around wall.talus --random 500 --seed 7");
    cli_result other = cli_expect(0, "around wall.talus --random 500 --seed 8");
    assert_string_equal(first.out, again.out);
    TEST_CHECK(strcmp(first.out, other.out) != 0 && lines_of(first.out) == 501);
    uint32_t left = 0;
    for (const char *line = strchr(first.out, '\n') + 1; *line != '\0'; line = strchr(line, '\n') + 1) {
        left += line[0] == '-';
    }
    TEST_CHECK(left > 180 && left < 320); // both sides of the wall alike
    cli_free(&first);
    cli_free(&again);
    cli_free(&other);
    cli_write_text("places.txt", "-5 0 0\n5 0 0\n");
    cli_result reached = cli_expect(0, "around wall.talus --places places.txt --random 20 --radius 3");
    TEST_CHECK(lines_of(reached.out) == 42);
    uint32_t line_number = 0;
    for (const char *line = reached.out; *line != '\0'; line = strchr(line, '\n') + 1, ++line_number) {
        float x = 0.0f, y = 0.0f, z = 0.0f;
        if (line_number % 21 != 0) {
            TEST_CHECK(sscanf(line, "%f,%f,%f", &x, &y, &z) == 3);
            TEST_CHECK(hypotf(x - (line_number < 21 ? -5.0f : 5.0f), z) <= 3.001f);
        }
    }
    cli_free(&reached);
}

static void test_words(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_do(2, "around floor.obj");
    cli_do(2, "around floor.obj 0,0,0 --places x.txt");
    cli_do(2, "around floor.obj 0,0");
    cli_do(2, "around floor.obj 0,0,0 --extents 1,-1,1");
    cli_do(2, "around floor.obj 0,0,0 --list doors");
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_walls), cmocka_unit_test(test_reach),
                                        cmocka_unit_test(test_random_points), cmocka_unit_test(test_words) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
