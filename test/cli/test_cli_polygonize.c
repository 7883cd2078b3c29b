// SPDX-License-Identifier: MIT
//
// talus polygonize.
#include "cli_run.h"

#include <math.h>

static const char square[] = "navcontours 1\nname square\ncs 0.5\nch 0.25\nbmin 0 0 0\nbmax 4 1 4\nwidth 8\nheight 8\n"
                             "border 1\nmaxerror 1.3\nnvp 6\ncontours 1\nc 0 7 63 4\n"
                             "0 3 0 0\n0 3 4 0\n4 3 4 0\n4 3 0 0\nend\n";
static const char eight[] = "navcontours 1\nname eight\ncs 1\nch 1\ncontours 2\nc 0 1 63 4\n"
                            "0 0 0 0\n0 0 4 0\n8 0 0 0\n8 0 4 0\nc 1 2 63 0\nend\n";

static void test_one_set_in_one_set_out(void **state)
{
    (void)state;
    cli_result result = cli_expect_with(0, square, "polygonize -");
    cli_check_part(result.out, "navpolys 1\nname square\nproducer talus-");
    cli_check_part(result.out, "nvp 6\nverts 4\npolys 1\nv 0 3 0\nv 0 3 4\nv 4 3 4\nv 4 3 0\np 7 63 4 ");
    TEST_CHECK(result.err[0] == '\0');
    cli_free(&result);
    char two[2048];
    snprintf(two, sizeof two, "%s\n%s", square, eight);
    cli_write_text("two.txt", two);
    result = cli_expect(0, "polygonize two.txt -o mesh.txt --check");
    cli_check_part(result.out, "mesh.txt: 2 sets, 3 contours, 2 polygons");
    cli_check_part(result.out, "1 contours repaired, 0 refused");
    cli_check_part(result.err, "set 'eight', contour 0");
    cli_free(&result);
    char *mesh = cli_read_file("mesh.txt", NULL);
    const char *first = strstr(mesh, "name square"), *second = strstr(mesh, "name eight");
    TEST_CHECK(first != NULL && second != NULL && first < second);
    free(mesh);
}

static void test_reports(void **state)
{
    (void)state;
    cli_write_text("eight.txt", eight);
    json_t *report = cli_json(0, "polygonize eight.txt --json --check --max-verts 3");
    const json_t *set = json_array_get(json_object_get(report, "sets"), 0);
    TEST_CHECK(cli_number(set, "contours") == 2 && cli_number(set, "empty_contours") == 1);
    TEST_CHECK(cli_number(set, "polygons") == 1 && cli_number(set, "repaired_contours") == 1);
    TEST_CHECK(strcmp(json_string_value(json_object_get(set, "check")), "ok") == 0);
    const json_t *notes = json_object_get(set, "notes");
    TEST_CHECK(json_array_size(notes) == 2 && cli_number(json_array_get(notes, 0), "covered_cells") == 8.0);
    TEST_CHECK(json_array_size(json_object_get(json_array_get(notes, 0), "faults")) == 2);
    json_decref(report);
}

static void test_compares_methods(void **state)
{
    (void)state;
    cli_write_text("square.txt", square);
    cli_result result = cli_expect(0, "polygonize square.txt --compare --check");
    cli_check_part(result.out, "square: 1 contours, 4 vertices");
    cli_check_part(result.out, "classic");
    cli_check_part(result.out, "optimal");
    cli_check_part(result.out, "delaunay");
    TEST_CHECK(strstr(result.out, "navpolys") == NULL);
    cli_free(&result);
    json_t *report = cli_json(0, "polygonize square.txt --compare --json --check");
    const json_t *methods = json_object_get(json_array_get(json_object_get(report, "sets"), 0), "methods");
    TEST_CHECK(json_array_size(methods) == 3);
    for (size_t i = 0; i < 3; i++) {
        const json_t *method = json_array_get(methods, i);
        TEST_CHECK(cli_number(method, "polygons") == 1 && cli_number(method, "lower_bound") == 1);
        TEST_CHECK(fabs(cli_number(method, "smallest_angle_degrees") - 90.0) < 1e-9);
        TEST_CHECK(cli_number(method, "mean_aspect") == 1.0);
        TEST_CHECK(strcmp(json_string_value(json_object_get(method, "check")), "ok") == 0);
    }
    json_decref(report);
    report = cli_json(0, "polygonize square.txt --json --check --drop-straight --merge-contours");
    const json_t *set = json_array_get(json_object_get(report, "sets"), 0);
    TEST_CHECK(cli_number(set, "straight_vertices_removed") == 0 && cli_number(set, "contour_merges") == 0);
    json_decref(report);
    cli_check_error(2, "polygonize square.txt --compare -o mesh.txt", "--compare", "-o");
}

static void test_errors(void **state)
{
    (void)state;
    cli_write_text("square.txt", square);
    cli_check_error(4, "polygonize nowhere.txt", "nowhere.txt", "check the path");
    cli_check_error(2, "polygonize square.txt --max-verts 2", "--max-verts", "3 to 64");
    cli_check_error(2, "polygonize square.txt --method best", "--method", "classic");
    cli_result optimal = cli_expect(0, "polygonize square.txt --method optimal --check");
    cli_check_part(optimal.out, "polys 1");
    cli_free(&optimal);
    cli_check_error(2, "polygonize square.txt --json -o -", "standard output", "-o");
    cli_check_error(4, "polygonize square.txt -o no/where.txt", "no/where.txt", "check the path");
    cli_write_text("bad.txt", "navcontours 1\nname x\ncs 1\nch 0\n");
    cli_check_error(3, "polygonize bad.txt -o bad_mesh.txt", "bad.txt:4:", "docs/guide/polygons.md");
    TEST_CHECK(!cli_exists("bad_mesh.txt"));
    cli_write_text("cut.txt", "navcontours 1\ncs 1\nch 1\ncontours 1\nc 0 1 63 4\n0 0 0 0\n");
    cli_check_error(3, "polygonize cut.txt", "cut.txt:6:", "the text ends");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_set_in_one_set_out),
        cmocka_unit_test(test_reports),
        cmocka_unit_test(test_compares_methods),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
