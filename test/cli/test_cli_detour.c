// SPDX-License-Identifier: MIT
//
// talus export and talus import: Detour tiles out and in again, and what they refuse.
#include "cli_run.h"

static void make_files(void)
{
    cli_do(0, "sample courtyard --triangles 2000 -o yard.obj");
    cli_do(0, "bake yard.obj -o yard.talus --tile-size 48");
}

static double number(const json_t *object, const char *name)
{
    return json_number_value(json_object_get(object, name));
}

static void test_out_and_in_again(void **state)
{
    (void)state;
    make_files();
    static const char *const lines[] = { "export yard.talus -o yard.bin --json",
                                         "export yard.talus -o yard.bin --json --refs 64",
                                         "export yard.obj -o yard.bin --json --tile-size 48" };
    for (size_t i = 0; i < 3; ++i) {
        json_t *out = cli_json(0, lines[i]);
        json_t *in = cli_json(0, "import yard.bin -o back.talus --json");
        TEST_CHECK(number(out, "tiles") > 3 && number(out, "tiles") == number(in, "tiles"));
        TEST_CHECK(number(out, "polygons") > 20 && number(out, "polygons") == number(in, "polygons"));
        TEST_CHECK(number(in, "dropped_polygons") == 0 && number(in, "one_way_links") == 0);
        json_decref(out);
        json_decref(in);
        cli_do(0, "check back.talus");
        json_t *path = cli_json(0, "path yard.talus 2,0,20 38,0,20 --json");
        json_t *same = cli_json(0, "path back.talus 2,0,20 38,0,20 --json");
        double length = number(path, "length");
        TEST_CHECK(length > 10.0 && number(same, "length") > length - 0.01 && number(same, "length") < length + 0.01);
        json_decref(path);
        json_decref(same);
    }
    // A file without triangles: its navmesh and paths can be drawn.
    json_t *drawn = cli_json(0, "draw back.talus -o back.png --stage all --size 240 --json");
    assert_int_equal(json_array_size(json_object_get(drawn, "pictures")), 3);
    json_decref(drawn);
    TEST_CHECK(cli_exists("back-polygons.png") && cli_exists("back-navmesh.png") && cli_exists("back-path.png"));
}

// Links that the bake found are Detour's off-mesh connections, and come back as such.
static void test_off_mesh_links(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o whole.obj");
    json_t *baked = cli_json(0, "bake whole.obj -o links.talus --links --json");
    json_t *found = json_object_get(json_object_get(baked, "links"), "links");
    json_t *out = cli_json(0, "export links.talus -o links.bin --json");
    TEST_CHECK(number(out, "off_mesh_links") > 3 && number(out, "off_mesh_outside") == 0);
    TEST_CHECK(found == NULL || json_number_value(found) == number(out, "off_mesh_links"));
    json_t *in = cli_json(0, "import links.bin -o back.talus --json");
    TEST_CHECK(number(in, "off_mesh_links") == number(out, "off_mesh_links"));
    TEST_CHECK(number(in, "polygons") == number(out, "polygons"));
    json_decref(baked);
    json_decref(out);
    json_decref(in);
}

static void test_refusals(void **state)
{
    (void)state;
    make_files();
    cli_do(0, "bake yard.obj -o bare.talus --no-nav");
    cli_do(0, "export yard.talus -o yard.bin");
    cli_write_text("cut.bin", "TESM");
    cli_write_text("empty.bin", "");
    static const struct {
        int code;
        const char *line;
        const char *part;
    } table[] = {
        { 2, "export yard.talus", "-o FILE.bin" },
        { 2, "export yard.talus -o x.bin --refs 16", "--refs" },
        { 3, "export bare.talus -o x.bin", "holds no navmesh" },
        { 4, "export none.talus -o x.bin", "none.talus" },
        { 4, "export yard.talus -o none/x.bin", "none/x.bin" },
        { 2, "import yard.bin", "-o FILE.talus" },
        { 2, "import yard.bin -o x.bin --cell-height 0", "--cell-height" },
        { 3, "import yard.obj -o x.bin", "no data of a Detour tile" },
        { 3, "import cut.bin -o x.bin", "ends too early" },
        { 3, "import empty.bin -o x.bin", "ends too early" },
        { 4, "import none.bin -o x.bin", "none.bin" },
        { 4, "import yard.bin -o none/x.bin", "none/x.bin" },
    };
    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i) {
        cli_result refused = cli_run_with(NULL, table[i].line);
        assert_int_equal(refused.code, table[i].code);
        cli_check_part(refused.err, table[i].part);
        TEST_CHECK(!cli_exists("x.bin"));
        cli_free(&refused);
    }
    cli_do(0, "import yard.bin -o back.talus");
    cli_result refused = cli_run_with(NULL, "draw back.talus -o x.png --stage spans");
    assert_int_equal(refused.code, 2);
    cli_check_part(refused.err, "a navmesh and no triangles");
    cli_free(&refused);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_out_and_in_again), cmocka_unit_test(test_off_mesh_links),
                                        cmocka_unit_test(test_refusals) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
