// SPDX-License-Identifier: MIT
//
// talus path.
#include "cli_run.h"

#include <math.h>

static void test_straight(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_do(0, "bake floor.obj -o floor.talus");
    cli_result baked = cli_expect(0, "path floor.talus -8,0,-8 8,0,4");
    cli_result level = cli_expect(0, "path floor.obj -8,0,-8 8,0,4");
    assert_string_equal(baked.out, level.out);
    float length, a[3], b[3];
    int end = 0;
    assert_int_equal(
        sscanf(baked.out, "%f %f,%f,%f %f,%f,%f%n", &length, &a[0], &a[1], &a[2], &b[0], &b[1], &b[2], &end), 7);
    assert_string_equal(baked.out + end, "\n"); // two corners: nothing is in the way
    TEST_CHECK(fabs((double)length - 20.0) < 0.01);
    TEST_CHECK(a[0] == -8.0f && a[2] == -8.0f && b[0] == 8.0f && b[2] == 4.0f);
    cli_free(&baked);
    cli_free(&level);
}

static void test_no_way(void **state)
{
    (void)state;
    cli_write_floor("wall.obj", 20, true);
    cli_do(0, "bake wall.obj -o wall.talus");
    cli_result none = cli_expect(1, "path wall.talus -5,0,0 5,0,0");
    cli_check_part(none.out, "none: unreachable");
    cli_check_part(none.out, "m short");
    cli_free(&none);
    none = cli_expect(1, "path wall.talus -5,0,0 5,0,0 --partial");
    cli_check_part(none.out, "partial ");
    cli_free(&none);
    none = cli_expect(1, "path wall.talus -50,0,0 5,0,0");
    assert_string_equal(none.out, "none: no navmesh at the start\n");
    cli_free(&none);
    none = cli_expect(1, "path wall.talus -5,0,0 5,30,0");
    assert_string_equal(none.out, "none: no navmesh at the goal\n");
    cli_free(&none);
    json_t *object = cli_json(1, "path wall.talus -5,0,0 5,0,0 --json");
    assert_string_equal(json_string_value(json_object_get(object, "status")), "unreachable");
    json_decref(object);
    object = cli_json(0, "path wall.talus -5,0,0 -5,0,6 --json");
    assert_string_equal(json_string_value(json_object_get(object, "status")), "complete");
    TEST_CHECK(fabs(cli_number(object, "length") - 6.0) < 0.01);
    json_decref(object);
    cli_do(0, "path wall.talus -5,0,0 -5,30,6 --extents 1,40,1");
}

// The sum of the corners' distances is the length, no path is shorter than the crow flies, and there and back agree.
static void check_line(const char *line, const float n[6], double *length_out)
{
    int used = 0;
    double length;
    assert_int_equal(sscanf(line, "%lf%n", &length, &used), 1);
    double sum = 0.0, last[3] = { 0 };
    int corners = 0;
    for (double p[3]; sscanf(line + used, " %lf,%lf,%lf", &p[0], &p[1], &p[2]) == 3; ++corners) {
        if (corners > 0) {
            sum += sqrt((p[0] - last[0]) * (p[0] - last[0]) + (p[1] - last[1]) * (p[1] - last[1]) +
                        (p[2] - last[2]) * (p[2] - last[2]));
        }
        memcpy(last, p, sizeof(last));
        used += 1 + (int)strcspn(line + used + 1, " \n");
    }
    TEST_CHECK(corners >= 2);
    TEST_CHECK(fabs(sum - length) < 1e-3 * (1.0 + length));
    double dx = (double)n[3] - (double)n[0], dz = (double)n[5] - (double)n[2];
    TEST_CHECK(length > sqrt(dx * dx + dz * dz) - 6.0); // ends may move by the extents
    *length_out = length;
}

static void test_many(void **state)
{
    (void)state;
    enum { PAIRS = 400 };
    static float pairs[PAIRS][6];
    test_random random = { 3 };
    cli_do(0, "sample courtyard -o level.obj");
    cli_do(0, "bake level.obj -o level.talus");
    FILE *there = fopen("there.txt", "w"), *back = fopen("back.txt", "w");
    for (int i = 0; i < PAIRS; ++i) {
        tl_vec3 a = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(39, 1, 39));
        tl_vec3 b = test_random_point(&random, tl_vec3_make(1, 0, 1), tl_vec3_make(39, 1, 39));
        float n[6] = { a.x, a.y, a.z, b.x, b.y, b.z };
        memcpy(pairs[i], n, sizeof(n));
        fprintf(there, "%.9g %.9g %.9g %.9g %.9g %.9g\n", (double)a.x, (double)a.y, (double)a.z, (double)b.x,
                (double)b.y, (double)b.z);
        fprintf(back, "%.9g %.9g %.9g %.9g %.9g %.9g\n", (double)b.x, (double)b.y, (double)b.z, (double)a.x,
                (double)a.y, (double)a.z);
    }
    fclose(there);
    fclose(back);
    cli_result one = cli_expect(0, "path level.talus --pairs there.txt --threads 1");
    cli_result two = cli_expect(0, "path level.talus --pairs there.txt --threads 2");
    cli_result reverse = cli_expect(0, "path level.talus --pairs back.txt --prepared");
    cli_result plain = cli_expect(0, "path level.talus --pairs back.txt");
    TEST_CHECK(strlen(plain.out) > 1000 && strncmp(plain.out, reverse.out, 4) == 0);
    cli_free(&plain);
    assert_string_equal(one.out, two.out);
    char *rest = NULL, *reverse_rest = NULL;
    char *line = strtok_r(one.out, "\n", &rest);
    char *reverse_line = strtok_r(reverse.out, "\n", &reverse_rest);
    int complete = 0;
    for (int i = 0; i < PAIRS; ++i) {
        assert_non_null(line);
        assert_non_null(reverse_line);
        bool reached = strncmp(line, "none", 4) != 0;
        assert_int_equal(reached, strncmp(reverse_line, "none", 4) != 0);
        if (reached) {
            double length, reverse_length;
            check_line(line, pairs[i], &length);
            check_line(reverse_line, pairs[i], &reverse_length);
            TEST_CHECK(reverse_length < 2.0 * length + 1.0 && length < 2.0 * reverse_length + 1.0);
            complete++;
        }
        line = strtok_r(NULL, "\n", &rest);
        reverse_line = strtok_r(NULL, "\n", &reverse_rest);
    }
    TEST_CHECK(complete > PAIRS / 3);
    cli_free(&one);
    cli_free(&two);
    cli_free(&reverse);
}

// An agent of the default size gets from the court up the stairs and over the bridge, and into every dungeon room.
static void test_sample_levels_are_walkable(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o level.obj");
    cli_do(0, "bake level.obj -o level.talus");
    cli_do(0, "path level.talus 2,0,20 20,5,20");
    cli_do(0, "sample dungeon -n 20000 --seed 1 -o level.obj");
    cli_do(0, "bake level.obj -o level.talus");
    FILE *pairs = fopen("rooms.txt", "w");
    for (int i = 0; i < 7 * 7 * 3; ++i) { // room centres at each of the three floor heights
        fprintf(pairs, "10 1.6 10 %d %g %d\n", 10 + 20 * (i % 7), 1.6 * (i / 49), 10 + 20 * (i / 7 % 7));
    }
    fclose(pairs);
    cli_result rooms = cli_expect(0, "path level.talus --pairs rooms.txt --extents 2.5,0.5,2.5");
    int reached = 0;
    char *rest = NULL;
    for (char *line = strtok_r(rooms.out, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        assert_null(strstr(line, "unreachable"));
        reached += strncmp(line, "none", 4) != 0;
    }
    TEST_CHECK(reached > 30);
    cli_free(&rooms);
}

// Paths are there as without slack, in space nearly as much longer as they may be in the plane.
static void test_slack(void **state)
{
    (void)state;
    test_random random = { 4 };
    cli_do(0, "sample dungeon -n 20000 --seed 1 -o level.obj");
    cli_do(0, "bake level.obj -o level.talus");
    FILE *pairs = fopen("pairs.txt", "w");
    for (int i = 0; i < 200; ++i) {
        const tl_vec3 a = test_random_point(&random, tl_vec3_make(0, 0, 0), tl_vec3_make(140, 3, 140));
        const tl_vec3 b = test_random_point(&random, tl_vec3_make(0, 0, 0), tl_vec3_make(140, 3, 140));
        fprintf(pairs, "%g %g %g %g %g %g\n", (double)a.x, (double)a.y, (double)a.z, (double)b.x, (double)b.y,
                (double)b.z);
    }
    fclose(pairs);
    cli_result shortest = cli_expect(0, "path level.talus --pairs pairs.txt --extents 4,4,4");
    cli_result none = cli_expect(0, "path level.talus --pairs pairs.txt --extents 4,4,4 --slack 0");
    cli_result loose = cli_expect(0, "path level.talus --pairs pairs.txt --extents 4,4,4 --slack 0.5");
    assert_string_equal(shortest.out, none.out);
    char *rest = NULL, *loose_rest = NULL;
    char *line = strtok_r(shortest.out, "\n", &rest), *loose_line = strtok_r(loose.out, "\n", &loose_rest);
    int complete = 0;
    for (int i = 0; i < 200; ++i) {
        double length = 0.0, loose_length = 0.0;
        const int found = sscanf(line, "%lf", &length), loosely = sscanf(loose_line, "%lf", &loose_length);
        TEST_CHECK(found == loosely && loose_length <= 1.6 * length);
        complete += found == 1;
        line = strtok_r(NULL, "\n", &rest);
        loose_line = strtok_r(NULL, "\n", &loose_rest);
    }
    TEST_CHECK(complete > 60 && strcmp(none.out, loose.out) != 0);
    cli_free(&shortest);
    cli_free(&none);
    cli_free(&loose);
    cli_check_error(2, "path level.talus 10,1,10 30,1,30 --slack 1.5", "--slack", "1");
    cli_check_error(2, "path level.talus 10,1,10 30,1,30 --slack=-0.1", "--slack", "0");
    cli_check_error(2, "path level.talus 10,1,10 30,1,30 --slack nan", "--slack", "nan");
    cli_check_error(2, "path level.talus 10,1,10 30,1,30 --slack 0.1 --radius 1", "--slack", "--radius");
}

static void test_bad_pairs(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_result result = cli_expect_with(3, "0 0 0 1 0 1\n0 0 0 1 0\n", "path floor.obj --pairs - --json");
    cli_check_part(result.err, "-:2: 5 numbers");
    cli_check_part(result.err, "ax ay az bx by bz");
    cli_check_part(result.out, "\"status\":\"complete\"");
    cli_free(&result);
    cli_write_text("tiny.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n");
    cli_check_error(6, "path tiny.obj 0,0,0 1,0,0", "nothing is walkable", "--scale");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight), cmocka_unit_test(test_no_way),
        cmocka_unit_test(test_many),     cmocka_unit_test(test_sample_levels_are_walkable),
        cmocka_unit_test(test_slack),    cmocka_unit_test(test_bad_pairs),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
