// SPDX-License-Identifier: MIT
//
// talus nearest, overlap, sweep and ray --all: the form of their answers, streams, exit codes and errors.
#include "cli_run.h"

// One triangle in the plane y = 2, its front down: corner 0 (0,2,0), 1 (4,2,0), 2 (0,2,4).
static void write_triangle(void)
{
    cli_write_text("one.obj", "v 0 2 0\nv 4 2 0\nv 0 2 4\nf 1 2 3\n");
}

// A closed cube from 0 to 2, fronts outward.
static void write_cube(void)
{
    cli_write_text("cube.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\n"
                               "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n");
}

static void check_answer(int code, const char *line, const char *expected)
{
    cli_result result = cli_expect(code, line);
    assert_string_equal(result.out, expected);
    cli_free(&result);
}

static void check_stream(const char *input, const char *line, const char *expected)
{
    cli_result result = cli_expect_with(0, input, line);
    assert_string_equal(result.out, expected);
    cli_free(&result);
}

static void test_nearest(void **state)
{
    (void)state;
    write_triangle();
    check_answer(0, "nearest one.obj 1,5,1", "3 0 1 2 1 face\n");
    check_answer(0, "nearest one.obj 2,2,-3", "3 0 2 2 0 edge\n");
    check_answer(0, "nearest one.obj -3,6,-0", "5 0 0 2 0 corner\n");
    check_answer(1, "nearest one.obj 1,5,1 --max-distance 2.5", "none\n");
    check_stream("1 5 1\n# here\n2,2,-3\n", "nearest one.obj --points -", "3 0 1 2 1 face\n3 0 2 2 0 edge\n");
    json_t *found = cli_json(0, "nearest one.obj 1,5,1 --json");
    TEST_CHECK(cli_number(found, "distance") == 3.0 && cli_number(found, "triangle") == 0.0);
    assert_string_equal(json_string_value(json_object_get(found, "feature")), "face");
    assert_true(json_is_true(json_object_get(found, "back")));
    json_decref(found);
    check_answer(1, "nearest one.obj 1,5,1 --max-distance 1 --json", "{\"found\":false}\n");
    cli_check_error(2, "nearest one.obj 1,5", "point '1,5'", "X,Y,Z");
    cli_check_error(2, "nearest one.obj 1,nan,2", "point '1,nan,2'", "finite");
    cli_check_error(2, "nearest one.obj", "--points", "point");
    cli_check_error(4, "nearest nothing.obj 1,2,3", "nothing.obj", "");
}

static void test_inside(void **state)
{
    (void)state;
    write_cube();
    write_triangle();
    check_answer(0, "nearest cube.obj 1,1,1 --inside", "inside\n");
    check_answer(0, "nearest cube.obj 1,2,1 --inside", "surface\n");
    check_answer(1, "nearest cube.obj 1,2.5,1 --inside", "outside\n");
    check_stream("1 1 1\n0 0 0\n3 1 1\n", "nearest cube.obj --points - --inside --json",
                 "{\"place\":\"inside\"}\n{\"place\":\"surface\"}\n{\"place\":\"outside\"}\n");
    cli_result result = cli_expect(1, "nearest one.obj 1,5,1 --inside");
    assert_string_equal(result.out, "outside\n");
    cli_check_part(result.err, "the surface is not closed");
    cli_check_part(result.err, "triangle 0");
    cli_free(&result);
}

static void test_overlap(void **state)
{
    (void)state;
    write_cube();
    write_triangle();
    check_answer(0, "overlap one.obj 1,2.5,1 --radius 0.5", "1 0\n");
    check_answer(1, "overlap one.obj 1,2.5,1 --radius 0.4", "0\n");
    check_answer(0, "overlap one.obj 1,1,1 --radius 0.3 --height 1.8 --any", "touches\n");
    check_answer(1, "overlap one.obj 1,0,1 --radius 0.3 --height 1.8 --any", "free\n");
    check_answer(0, "overlap one.obj 4.5,2,0 --half 0.5,1,1 --json", "{\"count\":1,\"triangles\":[0]}\n");
    check_answer(1, "overlap one.obj 4.6,2,0 --half 0.5,1,1 --any --json", "{\"overlaps\":false}\n");
    cli_result all = cli_expect(0, "overlap cube.obj 1,1,1 --radius 9");
    cli_check_part(all.out, "12 ");
    cli_free(&all);
    check_stream("1 2.5 1\n1 9 1\n", "overlap one.obj --points - --radius 0.5", "1 0\n0\n");
    cli_check_error(2, "overlap one.obj 1,2,3 --half 1,-1,1", "--half '1,-1,1' is negative", "X,Y,Z");
    cli_check_error(2, "overlap one.obj 1,2,3 --half 1,1,1 --height 2", "--half", "--height");
    cli_check_error(2, "overlap one.obj 1,2,3 --radius 1 --height 1.5", "at least 2 high", "1.5");
}

static void test_sweep(void **state)
{
    (void)state;
    write_triangle();
    check_answer(0, "sweep one.obj 1,6,1 0,-4,0 --radius 1", "0.75 0 1 2 1 0 1 0\n");
    check_answer(1, "sweep one.obj 1,6,1 0,-2,0 --radius 1", "free\n");
    check_answer(0, "sweep one.obj 1,0,1 0,1,0 --radius 0.5 --height 1.5", "0.5 0 1 2 1 0 -1 0\n");
    check_answer(1, "sweep one.obj 1,6,1 0,-4,0 --radius 1 --cull back", "free\n");
    check_answer(0, "sweep one.obj 1,2.25,1 0,-1,0 --radius 0.5", "0 0 1 2 1 0 1 0 0.25\n");
    check_stream(
        "1 6 1 0 -4 0\n1 6 1 0 4 0\n", "sweep one.obj --sweeps - --radius 1 --json",
        "{\"hit\":true,\"t\":0.75,\"triangle\":0,\"point\":[1,2,1],\"normal\":[0,1,0],\"face_normal\":[0,-1,0],"
        "\"back\":true,\"overlap\":false,\"depth\":0}\n{\"hit\":false}\n");
    json_t *hit = cli_json(0, "sweep one.obj 1,6,1 0,-4,0 --half 1,1,1 --json");
    TEST_CHECK(cli_number(hit, "t") <= 0.75 && cli_number(hit, "t") > 0.7499);
    json_decref(hit);
    cli_check_error(2, "sweep one.obj 1,2,3", "point", "motion");
    cli_check_error(2, "sweep one.obj 1,2,3 1,2", "motion '1,2'", "X,Y,Z");
    cli_result bad = cli_expect_with(3, "1 6 1 0 -4 0\n1 2 3\n", "sweep one.obj --sweeps - --radius 1");
    assert_string_equal(bad.out, "0.75 0 1 2 1 0 1 0\n");
    cli_check_part(bad.err, "-:2:");
    cli_check_part(bad.err, "x y z dx dy dz");
    cli_free(&bad);
}

static void test_all_hits(void **state)
{
    (void)state;
    write_cube();
    // Through the diagonals of two faces: four triangles are touched, two surfaces passed.
    cli_result touched = cli_expect(0, "ray cube.obj 1,5,1 0,-1,0 --all");
    cli_check_part(touched.out, "4\n3 ");
    cli_free(&touched);
    cli_result crossed = cli_expect(0, "ray cube.obj 1,5,1 0,-1,0 --crossings");
    cli_check_part(crossed.out, "2\n3 ");
    cli_free(&crossed);
    check_answer(1, "ray cube.obj 1,5,1 0,1,0 --all", "0\n");
    json_t *all = cli_json(0, "ray cube.obj 0.5,5,1 0,-1,0 --all --json");
    json_t *hits = json_object_get(all, "hits");
    TEST_CHECK(json_array_size(hits) == 2 && cli_number(json_array_get(hits, 1), "t") == 5.0);
    json_decref(all);
    check_stream("0.5 5 1 0 1 0\n0.5 5 1 0 0 0\n", "ray cube.obj --rays - --all", "0\n0\n");
    cli_check_error(2, "ray cube.obj 1,5,1 0,-1,0 --all --any", "--all", "--any");
    cli_check_error(2, "ray cube.obj 1,5,1 0,-1,0 --crossings --segment", "--crossings", "--segment");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearest), cmocka_unit_test(test_inside),   cmocka_unit_test(test_overlap),
        cmocka_unit_test(test_sweep),   cmocka_unit_test(test_all_hits),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
