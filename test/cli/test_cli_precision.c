// SPDX-License-Identifier: MIT
//
// Levels far from the origin: told where floats are too coarse, kept whole by --origin; and triangles that the navmesh
// is baked without are counted.
#include "cli_run.h"

#include "cli/sample/sample_level.h"

#include <math.h>

static void write_far_courtyard(const char *path, double east, double up, double north)
{
    const tl_sample_level *level = tl_sample_find_level("courtyard");
    tl_sample_mesh mesh;
    assert_int_equal(tl_sample_build_level(level, level->default_triangles, 1, &mesh), TL_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const tl_vec3 v = mesh.vertices[i];
        fprintf(file, "v %.6f %.6f %.6f\n", east + (double)v.x, up + (double)v.y, north + (double)v.z);
    }
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const uint32_t *t = &mesh.indices[3 * i];
        fprintf(file, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    fclose(file);
    tl_sample_mesh_free(&mesh);
}

static void test_far_level_is_told(void **state)
{
    (void)state;
    write_far_courtyard("far.obj", 500000.0, 200.0, 3000000.0);
    cli_result bake = cli_run_with(NULL, "bake far.obj -o far.talus");
    cli_check_part(bake.err, "floats step by 0.25 m there");
    cli_check_part(bake.err, "give --origin auto");
    cli_check_part(bake.out, "dropped  ");
    cli_check_part(bake.out, " without area in floats, ");
    cli_free(&bake);
}

// Farther out floats are no finer than the cells.
static void test_farther_level_is_refused(void **state)
{
    (void)state;
    write_far_courtyard("farther.obj", 500000.0, 200.0, 4649000.0);
    cli_result bake = cli_expect(3, "bake farther.obj -o farther.talus");
    cli_check_part(bake.err, "floats step by 0.5 m there");
    cli_check_part(bake.err, "give --origin auto");
    cli_check_part(bake.err, "--cell-size");
    cli_free(&bake);
}

// The level at its origin and the level far out with that subtracted are the same, but for the file's decimals.
static void test_origin_keeps_the_level(void **state)
{
    (void)state;
    write_far_courtyard("near.obj", 0.0, 0.0, 0.0);
    write_far_courtyard("far.obj", 500000.0, 200.0, 4649000.0);
    json_t *near = cli_json(0, "bake near.obj -o near.talus --json");
    json_t *far = cli_json(0, "bake far.obj -o far.talus --json --origin 500000,200,4649000");
    TEST_CHECK(cli_number(far, "cleaned.degenerate_triangles") == cli_number(near, "cleaned.degenerate_triangles"));
    TEST_CHECK(fabs(cli_number(far, "navmesh.area") - cli_number(near, "navmesh.area")) < 1.0);
    TEST_CHECK(json_number_value(json_array_get(json_object_get(far, "origin"), 2)) == 4649000.0);
    json_decref(near);
    json_decref(far);
    cli_do(0, "path far.talus 500002,200,4649020 500038,200,4649020"); // in the level's coordinates
    // Chosen: 40 m square, so its middle; 200 m up is near enough.
    cli_result chosen = cli_expect(0, "bake far.obj -o far.talus --origin auto");
    cli_check_part(chosen.out, "y up, 0,0,0 inside is 500020,0,4649020");
    TEST_CHECK(strstr(chosen.err, "floats step") == NULL && strstr(chosen.out, "dropped") == NULL);
    cli_free(&chosen);
    cli_do(0, "path far.talus 500002,200,4649020 500038,200,4649020");
    cli_result far_path = cli_expect(0, "path far.talus 500002.5,200,4649020.25 500038,200,4649020");
    cli_check_part(far_path.out, " 500002.5,"); // in double: floats step by half a metre there
    cli_check_part(far_path.out, ",4649020.25 ");
    cli_free(&far_path);
    // In the file's units and axes: (x, y, z) of a z-up file in millimetres.
    cli_write_text("mm.obj",
                   "v 5000000000 -3000000000 1000\nv 5000020000 -3000000000 1000\nv 5000000000 -2999980000 1000\n"
                   "f 1 2 3\n");
    json_t *turned =
        cli_json(0, "bake mm.obj -o mm.talus --up z --scale 0.001 --origin 5000000000,-3000000000,0 --no-nav --json");
    const json_t *bounds = json_object_get(turned, "bounds");
    char *text = json_dumps(bounds, JSON_COMPACT);
    TEST_CHECK(strstr(text, "5000020.0") != NULL && strstr(text, "-3000000.0") != NULL && strstr(text, "e") == NULL);
    free(text);
    json_decref(turned);
}

static void test_near_levels_are_read_as_ever(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 8, false);
    cli_do(0, "bake floor.obj -o one.talus");
    cli_result same = cli_expect(0, "bake floor.obj -o two.talus --origin auto");
    assert_string_equal(same.err, "");
    cli_free(&same);
    size_t one_size, two_size;
    char *one = cli_read_file("one.talus", &one_size), *two = cli_read_file("two.talus", &two_size);
    TEST_CHECK(one_size == two_size && memcmp(one, two, one_size) == 0);
    free(one);
    free(two);
    cli_check_error(2, "bake floor.obj -o one.talus --origin here", "--origin: 'here'", "auto");
    cli_check_error(2, "bake floor.obj -o one.talus --origin 1,2", "--origin: '1,2'", "too few");
}

// Repeated and degenerate triangles are in the text of bake.
static void test_dropped_triangles(void **state)
{
    (void)state;
    cli_write_text("odd.obj", "v -4 0 -4\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nf 1 2 3\nf 1 3 4\nf 1 3 4\nf 1 1 2\nf 2 2 2\n");
    cli_result bake = cli_expect(0, "bake odd.obj -o odd.talus");
    cli_check_part(bake.out, "dropped  3 of 5 triangles: 2 without area in floats, 1 that repeat another");
    cli_free(&bake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_far_level_is_told),      cmocka_unit_test(test_farther_level_is_refused),
        cmocka_unit_test(test_origin_keeps_the_level), cmocka_unit_test(test_near_levels_are_read_as_ever),
        cmocka_unit_test(test_dropped_triangles),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
