// SPDX-License-Identifier: MIT
//
// talus hull, support and distance.
#include "cli_run.h"

#include <math.h>

static void write_cube(const char *path, double size)
{
    char text[512];
    int used = 0;
    for (int i = 0; i < 8; ++i) {
        used += snprintf(text + used, sizeof(text) - (size_t)used, "%g %g %g\n", i & 1 ? size : 0.0, i & 2 ? size : 0.0,
                         i & 4 ? size : 0.0);
    }
    snprintf(text + used, sizeof(text) - (size_t)used, "%g %g %g\n", size / 2, size / 2, size / 2);
    cli_write_text(path, text);
}

static void test_measures(void **state)
{
    (void)state;
    write_cube("cube.txt", 2.0);
    json_t *cube = cli_json(0, "hull cube.txt --json");
    TEST_CHECK(cli_number(cube, "points") == 9 && cli_number(cube, "vertices") == 8);
    TEST_CHECK(cli_number(cube, "edges") == 12 && cli_number(cube, "faces") == 6);
    TEST_CHECK(fabs(cli_number(cube, "volume") - 8.0) < 1e-12 && fabs(cli_number(cube, "area") - 24.0) < 1e-12);
    TEST_CHECK(fabs(json_number_value(json_array_get(json_object_get(cube, "centroid"), 1)) - 1.0) < 1e-12);
    json_decref(cube);
    cli_result text = cli_expect(0, "hull cube.txt");
    cli_check_part(text.out, "vertices  8\nedges     12\nfaces     6\nvolume    8\narea      24\ncentroid  1,1,1\n");
    cli_free(&text);
}

// Written as OBJ or baked, a hull comes back the same.
static void test_round_trip(void **state)
{
    (void)state;
    cli_do(0, "sample terrain -n 3000 -o level.obj");
    json_t *first = cli_json(0, "hull level.obj -o hull.obj --json");
    json_t *again = cli_json(0, "hull hull.obj --json");
    cli_do(0, "hull level.obj -o hull.talus");
    json_t *baked = cli_json(0, "hull hull.talus --json");
    static const char *const keys[] = { "vertices", "edges", "faces", "volume", "area" };
    for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); ++i) {
        double value = cli_number(first, keys[i]);
        TEST_CHECK(fabs(cli_number(again, keys[i]) - value) <= 1e-9 * fabs(value));
        TEST_CHECK(cli_number(baked, keys[i]) == value);
    }
    json_t *mesh = cli_json(0, "info hull.obj --json");
    TEST_CHECK(cli_number(mesh, "faces") == cli_number(first, "faces"));
    TEST_CHECK(cli_number(mesh, "open_edges") == 0); // closed
    json_decref(first);
    json_decref(again);
    json_decref(baked);
    json_decref(mesh);
    cli_do(0, "check hull.talus");
}

// A turned box, rounded to centimetres, with a second corner beside one of its own.
static void test_nearly_flat_faces(void **state)
{
    (void)state;
    cli_write_text("turned.txt",
                   "-1.87 -0.05 -1.33\n-0.13 0.29 -2.27\n-1.87 0.89 -0.99\n-0.13 1.23 -1.93\n"
                   "0.13 -1.23 1.93\n1.87 -0.89 0.99\n0.13 -0.29 2.27\n1.87 0.05 1.33\n1.872 0.05 1.329\n");
    json_t *exact = cli_json(0, "hull turned.txt --json");
    TEST_CHECK(cli_number(exact, "vertices") == 9 && cli_number(exact, "faces") > 6);
    TEST_CHECK(json_object_get(exact, "corners_left_out") == NULL && json_object_get(exact, "max_outside") == NULL);
    json_t *welded = cli_json(0, "hull turned.txt --weld-distance 0.01 --json");
    TEST_CHECK(cli_number(welded, "vertices") == 8 && cli_number(welded, "faces") > 6);
    TEST_CHECK(cli_number(welded, "corners_left_out") == 1);
    double outside = cli_number(welded, "max_outside");
    TEST_CHECK(outside > 0.0 && outside < 0.01);
    json_t *merged = cli_json(0, "hull turned.txt --weld-distance 0.01 --merge-distance 0.02 --json");
    TEST_CHECK(cli_number(merged, "vertices") == 8 && cli_number(merged, "faces") == 6);
    TEST_CHECK(cli_number(merged, "max_outside") <= 0.03);
    json_decref(exact);
    json_decref(welded);
    json_decref(merged);
    cli_result text = cli_expect(0, "hull turned.txt --weld-distance 0.01 --merge-distance 0.02");
    cli_check_part(text.out, "1 corners were left out; no point lies more than ");
    cli_free(&text);
    cli_result wrong = cli_expect(2, "hull turned.txt --merge-distance=-1");
    cli_check_part(wrong.err, "merge-distance");
    cli_free(&wrong);
}

static void test_several_clouds(void **state)
{
    (void)state;
    cli_write_text("clouds.txt", "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3\n0 0 0\n1 0 0\n0 1 0\n");
    cli_result all = cli_expect(0, "hull clouds.txt --all");
    cli_check_part(all.out, "0.166666667");
    cli_check_part(all.out, "plane");
    cli_free(&all);
    json_t *one = cli_json(0, "hull clouds.txt --index 0 --json");
    TEST_CHECK(cli_number(one, "vertices") == 4);
    json_decref(one);
    cli_check_error(2, "hull clouds.txt", "2 clouds", "--index");
    cli_check_error(2, "hull clouds.txt --index 2", "--index", "use 0 to 1");
    cli_check_error(3, "hull clouds.txt --index 1", "plane", "--thickness");
    json_t *thick = cli_json(0, "hull clouds.txt --index 1 --thickness 0.1 --json");
    TEST_CHECK(json_is_true(json_object_get(thick, "thickened")));
    TEST_CHECK(cli_number(thick, "volume") > 0.04);
    json_decref(thick);
}

static void test_support_against_scan(void **state)
{
    (void)state;
    enum { POINTS = 400, DIRECTIONS = 500 };
    static tl_vec3 points[POINTS];
    test_random random = { 5 };
    FILE *file = fopen("points.txt", "w");
    for (int i = 0; i < POINTS; ++i) {
        points[i] = test_random_point(&random, tl_vec3_make(-3, -2, -1), tl_vec3_make(3, 2, 1));
        fprintf(file, "%.9g %.9g %.9g\n", (double)points[i].x, (double)points[i].y, (double)points[i].z);
    }
    fclose(file);
    static tl_vec3 directions[DIRECTIONS];
    file = fopen("directions.txt", "w");
    for (int i = 0; i < DIRECTIONS; ++i) {
        directions[i] = test_random_direction(&random);
        fprintf(file, "%.9g %.9g %.9g\n", (double)directions[i].x, (double)directions[i].y, (double)directions[i].z);
    }
    fclose(file);
    cli_do(0, "hull points.txt -o points.talus");
    cli_result result = cli_expect(0, "support points.txt --directions directions.txt");
    cli_result baked = cli_expect(0, "support points.talus --directions directions.txt");
    assert_string_equal(result.out, baked.out);
    char *rest = NULL;
    char *line = strtok_r(result.out, "\n", &rest);
    for (int i = 0; i < DIRECTIONS; ++i) {
        int best = 0;
        double best_dot = -(double)INFINITY;
        for (int k = 0; k < POINTS; ++k) {
            double dot = (double)points[k].x * (double)directions[i].x + (double)points[k].y * (double)directions[i].y +
                         (double)points[k].z * (double)directions[i].z;
            if (dot > best_dot) {
                best = k;
                best_dot = dot;
            }
        }
        int vertex;
        float x, y, z, dot;
        assert_non_null(line);
        assert_int_equal(sscanf(line, "%d %f %f %f %f", &vertex, &x, &y, &z, &dot), 5);
        assert_int_equal(vertex, best);
        TEST_CHECK(x == points[best].x && y == points[best].y && z == points[best].z);
        TEST_CHECK(dot == (float)best_dot);
        line = strtok_r(NULL, "\n", &rest);
    }
    assert_null(line);
    cli_free(&result);
    cli_free(&baked);
    result = cli_expect(0, "support points.txt 0,0,-1");
    assert_non_null(strchr(result.out, ' '));
    cli_free(&result);
    cli_check_error(2, "support points.txt", "--directions", "talus support");
    cli_check_error(3, "support points.txt --directions points.talus", "points.talus:1", "dx dy dz");
}

static void check_answer(const char *line, const char *expected)
{
    cli_result result = cli_expect(0, line);
    assert_string_equal(result.out, expected);
    cli_free(&result);
}

static void test_distance(void **state)
{
    (void)state;
    write_cube("a.txt", 1.0);
    write_cube("b.txt", 2.0);
    cli_result result = cli_expect(0, "distance a.txt b.txt --pose 4,0,0");
    cli_check_part(result.out, "3 1,");
    cli_check_part(result.out, " 1,0,0\n");
    cli_free(&result);
    check_answer("distance a.txt b.txt", "overlap\n");
    check_answer("distance a.txt b.txt --pose 1,0,0", "overlap\n"); // they touch
    json_t *object = cli_json(0, "distance a.txt b.txt --pose-b -5,0,0 --pose-a 0,0,0,0,1,0,0 --json");
    TEST_CHECK(fabs(cli_number(object, "distance") - 2.0) < 1e-6); // A turned by 180 degrees about y reaches to -1
    json_decref(object);
    object = cli_json(0, "distance a.txt b.txt --pose 4,0,0 --radius-a 0.5 --radius-b 0.25 --json");
    TEST_CHECK(fabs(cli_number(object, "distance") - 2.25) < 1e-6);
    json_decref(object);
    result = cli_expect_with(0, "4 0 0\n0 0 0\n0 9 0 0 0 0 1\n", "distance a.txt b.txt --poses - --json");
    cli_check_part(result.out, "\"distance\":3,");
    cli_check_part(result.out, "{\"overlap\":true,");
    cli_check_part(result.out, "\"distance\":8,");
    cli_free(&result);
    check_answer("distance a.txt b.txt --pose 1,0,0,0,0,0,0", "overlap\n"); // the zero quaternion is the identity
    cli_write_text("poses.txt", "4 0 0\n4 0 0 1\n");
    cli_check_error(3, "distance a.txt b.txt --poses poses.txt", "poses.txt:2: 4 numbers", "[qx qy qz qw]");
}

static void test_bad_points(void **state)
{
    (void)state;
    cli_write_text("nan.txt", "0 0 0\n1 nan 0\n");
    cli_write_text("two.txt", "0 0 0\n1 0 0\n");
    cli_write_text("one.txt", "1 1 1\n1 1 1\n");
    cli_write_text("short.txt", "9\n0 0 0\n");
    cli_write_text("empty.txt", "");
    cli_check_error(3, "hull nan.txt", "nan.txt:2", "");
    cli_check_error(3, "hull two.txt", "line", "--thickness");
    cli_check_error(3, "hull one.txt", "coincide", "--thickness");
    cli_check_error(3, "hull short.txt", "short.txt", "");
    cli_check_error(3, "hull empty.txt", "empty.txt", "");
    cli_write_floor("floor.obj", 4, false);
    cli_check_error(3, "hull floor.obj", "floor.obj", "--thickness");
    cli_do(0, "bake floor.obj -o floor.talus --no-nav");
    cli_check_error(3, "support floor.talus 0,1,0", "holds no hull", "--hull");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measures),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_nearly_flat_faces),
        cmocka_unit_test(test_several_clouds),
        cmocka_unit_test(test_support_against_scan),
        cmocka_unit_test(test_distance),
        cmocka_unit_test(test_bad_points),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
