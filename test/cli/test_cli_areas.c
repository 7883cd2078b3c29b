// SPDX-License-Identifier: MIT
//
// talus bake --area and --areas: from a file's materials and marks to polygons, tables and pictures.

#include "cli_run.h"

// Four floors of 10 by 10 m in a row, the first without material.
static void write_park(const char *path)
{
    static const char *const names[] = { NULL, "grass", "water_deep", "water_shallow" };
    char text[4096] = "";
    for (int i = 0; i < 4; i++) {
        const size_t used = strlen(text);
        const int x = 10 * i, v = 4 * i;
        snprintf(text + used, sizeof text - used, "%s%s%sv %d 0 0\nv %d 0 10\nv %d 0 10\nv %d 0 0\nf %d %d %d %d\n",
                 names[i] != NULL ? "usemtl " : "", names[i] != NULL ? names[i] : "", names[i] != NULL ? "\n" : "", x,
                 x, x + 10, x + 10, v + 1, v + 2, v + 3, v + 4);
    }
    cli_write_text(path, text);
}

static double area_of(const json_t *list, int area)
{
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *entry = json_array_get(list, i);
        if (json_integer_value(json_object_get(entry, "area")) == area) {
            TEST_CHECK(cli_number(entry, "polygons") > 0.0);
            return cli_number(entry, "square_metres");
        }
    }
    return 0.0;
}

// Bakes with the options, and takes the areas from both what bake and what info say.
static void expect_areas(const char *options, const int areas[4], const double square_metres[4])
{
    char line[512];
    snprintf(line, sizeof line, "bake park.obj -o park.talus --cell-size 0.25 --agent-radius 0 %s --json", options);
    json_t *bake = cli_json(0, line), *info = cli_json(0, "info park.talus --json");
    const json_t *told = json_object_get(json_object_get(bake, "navmesh"), "areas");
    assert_true(json_equal(told, json_object_get(json_object_get(info, "navmesh"), "areas")));
    for (int i = 0; i < 4; i++) {
        const double found = area_of(told, areas[i]);
        if (!(found <= square_metres[i] && found >= 0.89 * square_metres[i])) { // rims are ledges
            fail_msg("%s: area %d has %g m2, not %g", options, areas[i], found, square_metres[i]);
        }
    }
    json_decref(bake);
    json_decref(info);
    cli_do(0, "check park.talus");
}

static void test_materials(void **state)
{
    (void)state;
    write_park("park.obj");
    expect_areas("", (const int[4]){ 63, 5, 0, 7 }, (const double[4]){ 400, 0, 0, 0 });
    expect_areas("--area grass=5", (const int[4]){ 63, 5, 0, 7 }, (const double[4]){ 300, 100, 0, 0 });
    expect_areas("--area grass=255 --area water*=0", (const int[4]){ 63, 255, 0, 7 },
                 (const double[4]){ 100, 100, 0, 0 });
    // The last that fits counts; an empty name is what has no material.
    expect_areas("--area *=7 --area wa?er_d*p=5 --area =200", (const int[4]){ 63, 5, 7, 200 },
                 (const double[4]){ 0, 100, 200, 100 });
}

static void test_marks(void **state)
{
    (void)state;
    write_park("park.obj");
    cli_write_text("marks.txt", "material 5 grass\nbox 9 0 -1 0 5 1 10\nprism 0 -1 1 20 0 20 10 30 10 30 0\n");
    expect_areas("--areas marks.txt", (const int[4]){ 63, 5, 9, 0 }, (const double[4]){ 150, 100, 50, 0 });
    expect_areas("--areas marks.txt --tile-size 16", (const int[4]){ 63, 5, 9, 0 },
                 (const double[4]){ 150, 100, 50, 0 });
    cli_write_text("cylinder.txt", "cylinder 9 20 -1 5 4 2\n");
    expect_areas("--areas cylinder.txt", (const int[4]){ 63, 9, 5, 0 }, (const double[4]){ 350, 50, 0, 0 });
    cli_result drawn = cli_expect(0, "draw park.obj -o park.png --areas marks.txt --stage areas,navmesh --size 240");
    cli_check_part(drawn.out, "park-areas.png");
    cli_check_part(drawn.out, "park-navmesh.png");
    cli_free(&drawn);
    // Volumes are kept in the file, and so are areas of materials.
    drawn = cli_expect(0, "draw park.talus -o baked.png --stage areas,navmesh --size 240");
    TEST_CHECK(drawn.err[0] == '\0');
    cli_free(&drawn);
    cli_do(0, "bake park.obj -o grass.talus --area grass=5");
    drawn = cli_expect(0, "draw grass.talus -o baked.png --stage areas,navmesh --size 240");
    TEST_CHECK(drawn.err[0] == '\0');
    cli_free(&drawn);
    drawn = cli_expect(0, "draw park.talus -o baked.png --stage navmesh --size 240");
    TEST_CHECK(drawn.err[0] == '\0');
    cli_free(&drawn);
    cli_result info = cli_expect(0, "info park.talus");
    cli_check_part(info.out, "area 9 ");
    cli_check_part(info.out, "area 63 ");
    cli_free(&info);
}

// An audit of the file knows which triangles are not walkable on purpose, dropped and repeated ones between them too.
static void test_audit_knows_materials(void **state)
{
    (void)state;
    write_park("park.obj");
    char *text = cli_read_file("park.obj", NULL), more[8192];
    const char *second = strstr(text, "usemtl"); // behind the first floor; the others' numbers move
    assert_non_null(second);
    snprintf(more, sizeof more, "%.*sf 1 1 2\nf 1 2 3 4\n%s", (int)(second - text), text, second);
    free(text);
    cli_write_text("noisy.obj", more);
    static const char *const options[] = { "", "--tile-size 32" };
    for (int i = 0; i < 2; i++) {
        char line[256];
        snprintf(line, sizeof line, "bake noisy.obj -o water.talus --agent-radius 0 --area water*=0 %s", options[i]);
        cli_do(0, line);
        json_t *audit = cli_json(0, "audit water.talus --json");
        TEST_CHECK(json_array_size(json_object_get(audit, "findings")) == 0);
        json_decref(audit);
        cli_result why = cli_expect(1, "why water.talus 35,0,5");
        cli_check_part(why.out, "area");
        cli_free(&why);
    }
    // Without the marks the same navmesh lacks the water's 200 m2.
    cli_do(0, "bake noisy.obj -o dry.talus --agent-radius 0 --area water*=0 --no-soup");
    cli_result missing = cli_expect(0, "info water.talus");
    cli_check_part(missing.out, "AREA");
    cli_free(&missing);
}

// Volumes are given in the level's own coordinates.
static void test_marks_in_the_levels_axes(void **state)
{
    (void)state;
    write_park("park.obj");
    cli_write_text("up.txt", "box 9 0 -10 -1 5 0 1\n");
    // Turned to z up: (x, y, z) of the file is (x, -z, y).
    FILE *file = fopen("park_z.obj", "w");
    assert_non_null(file);
    for (int i = 0; i < 4; i++) {
        const int x = 10 * i, v = 4 * i;
        fprintf(file, "v %d 0 0\nv %d -10 0\nv %d -10 0\nv %d 0 0\nf %d %d %d %d\n", x, x, x + 10, x + 10, v + 1, v + 2,
                v + 3, v + 4);
    }
    fclose(file);
    json_t *bake = cli_json(0, "bake park_z.obj -o z.talus --up z --agent-radius 0 --areas up.txt --json");
    const double found = area_of(json_object_get(json_object_get(bake, "navmesh"), "areas"), 9);
    TEST_CHECK(found > 40.0 && found <= 50.0);
    json_decref(bake);
}

static void test_info_names_materials(void **state)
{
    (void)state;
    write_park("park.obj");
    cli_result info = cli_expect(0, "info park.obj");
    cli_check_part(info.out, "materials  3: 'grass', 'water_deep', 'water_shallow'");
    cli_free(&info);
    json_t *json = cli_json(0, "info park.obj --json");
    TEST_CHECK(cli_number(json, "materials") == 3.0);
    assert_string_equal(json_string_value(json_array_get(json_object_get(json, "material_names"), 0)), "grass");
    json_decref(json);
}

static void test_what_is_refused(void **state)
{
    (void)state;
    write_park("park.obj");
    static const struct {
        int code;
        const char *options, *part, *other_part;
    } cases[] = {
        { 2, "--area gras=5", "no material 'gras'; did you mean 'grass'?", "'water_deep', 'water_shallow'" },
        { 2, "--area lava*=5", "no material 'lava*'", "'grass', 'water_deep', 'water_shallow'" },
        { 2, "--area grass", "NAME=ID", "0 to 255" },
        { 2, "--area grass=256", "NAME=ID", "0 to 255" },
        { 2, "--area grass=-1", "NAME=ID", "0 to 255" },
        { 3, "--areas bad.txt", "bad.txt:2:", "x y z x y z" },
        { 3, "--areas unknown.txt", "unknown.txt:1:", "no material 'mud'" },
        { 4, "--areas none.txt", "none.txt", ";" },
    };
    cli_write_text("bad.txt", "material 5 grass\nbox 5 1 2 3\n");
    cli_write_text("unknown.txt", "material 5 mud\n");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char line[256];
        snprintf(line, sizeof line, "bake park.obj -o refused.talus %s", cases[i].options);
        cli_check_error(cases[i].code, line, cases[i].part, cases[i].other_part);
        TEST_CHECK(!cli_exists("refused.talus"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_materials),
                                        cmocka_unit_test(test_marks),
                                        cmocka_unit_test(test_audit_knows_materials),
                                        cmocka_unit_test(test_marks_in_the_levels_axes),
                                        cmocka_unit_test(test_info_names_materials),
                                        cmocka_unit_test(test_what_is_refused) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
