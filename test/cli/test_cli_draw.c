// SPDX-License-Identifier: MIT
//
// talus draw: every stage of a level and of a baked file, PNG and SVG, and what it refuses.
#include "cli_run.h"

#include <talus/vec.h>

static uint32_t big_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

// The picture's size from a PNG's head; fails when the file is none.
static void check_png(const char *path, uint32_t *width_out, uint32_t *height_out)
{
    size_t size;
    char *file = cli_read_file(path, &size);
    TEST_CHECK(size > 1000 && memcmp(file, "\x89PNG\r\n\x1a\n", 8) == 0 && memcmp(file + 12, "IHDR", 4) == 0);
    *width_out = big_endian((const unsigned char *)file + 16);
    *height_out = big_endian((const unsigned char *)file + 20);
    TEST_CHECK(memcmp(file + size - 8, "IEND", 4) == 0);
    free(file);
}

static void make_files(void)
{
    cli_do(0, "sample courtyard --triangles 2000 -o yard.obj");
    cli_do(0, "bake yard.obj -o yard.talus --cell-size 0.4");
}

// The list of pictures.
static json_t *draw_json(int code, const char *line)
{
    json_t *object = cli_json(code, line);
    TEST_CHECK(json_is_string(json_object_get(object, "file")));
    json_t *pictures = json_incref(json_object_get(object, "pictures"));
    json_decref(object);
    return pictures;
}

static void test_every_stage(void **state)
{
    (void)state;
    static const char *const stages[] = { "soup",     "spans",         "areas",   "distance",  "regions",
                                          "contours", "triangulation", "merging", "triangles", "polygons",
                                          "detail",   "navmesh",       "path" };
    enum { STAGES = sizeof(stages) / sizeof(stages[0]) };
    make_files();
    static const char *const inputs[] = { "yard.obj", "yard.talus" };
    for (size_t input = 0; input < 2; ++input) {
        char line[128];
        snprintf(line, sizeof(line), "draw %s -o p%zu.png --stage all --size 240 --json", inputs[input], input);
        json_t *list = draw_json(0, line);
        assert_int_equal(json_array_size(list), STAGES);
        for (size_t i = 0; i < STAGES; ++i) {
            const json_t *entry = json_array_get(list, i);
            assert_string_equal(json_string_value(json_object_get(entry, "stage")), stages[i]);
            char path[64];
            snprintf(path, sizeof(path), "p%zu-%s.png", input, stages[i]);
            assert_string_equal(json_string_value(json_object_get(entry, "output")), path);
            uint32_t width;
            uint32_t height;
            check_png(path, &width, &height);
            if (strstr(path, "triangulation") == NULL && strstr(path, "merging") == NULL) {
                TEST_CHECK(width >= 2 * 200 && width <= 2 * 240 + 40 && height >= 200 && height <= 240 + 140 + 3 * 22);
            } else {
                TEST_CHECK(width >= 3 * 80 && height >= 80); // panels of a third of the size, at least three
            }
        }
        json_decref(list);
    }
}

// All stages in one picture, of a level, a baked file and contours; and only those that are asked for.
static void test_overview(void **state)
{
    (void)state;
    make_files();
    static const char *const lines[] = { "draw yard.obj -o all.png --overview --size 1000 --json",
                                         "draw yard.talus -o all.png --overview --size 1000 --view oblique --json",
                                         "draw yard.obj -o some.png --overview --size 1000 --stage soup,path --json" };
    for (int i = 0; i < 3; i++) {
        json_t *list = draw_json(0, lines[i]);
        assert_int_equal(json_array_size(list), 1);
        TEST_CHECK(cli_number(json_array_get(list, 0), "stages") == (i < 2 ? 11.0 : 2.0));
        json_decref(list);
    }
    uint32_t width, height;
    check_png("all.png", &width, &height);
    TEST_CHECK(width > 4 * 420 && width < 4 * 620 && height > 3 * 300);
    check_png("some.png", &width, &height);
    TEST_CHECK(width > 2 * 420 && width < 2 * 620 && height < 620 + 150);
    cli_check_error(2, "draw yard.obj -o none.png --overview --stage merging", "--overview", "none");
}

// The same picture from the same level, with one thread or more; and not the same of another stage.
static void test_same_bytes(void **state)
{
    (void)state;
    make_files();
    static const char *const lines[] = { "draw yard.obj -o a.png --stage regions --size 300 --threads 1",
                                         "draw yard.obj -o b.png --stage regions --size 300 --threads 3",
                                         "draw yard.obj -o c.png --stage distance --size 300 --threads 3" };
    for (size_t i = 0; i < 3; ++i) {
        cli_do(0, lines[i]);
    }
    size_t size_a;
    size_t size_b;
    size_t size_c;
    char *a = cli_read_file("a.png", &size_a);
    char *b = cli_read_file("b.png", &size_b);
    char *c = cli_read_file("c.png", &size_c);
    TEST_CHECK(size_a == size_b && memcmp(a, b, size_a) == 0);
    TEST_CHECK(size_a != size_c || memcmp(a, c, size_a) != 0);
    free(a);
    free(b);
    free(c);
}

// On a hill a flat polygon lies deep in the ground; what is drawn is the surface, of which nothing is hidden from
// above.
static void test_navmesh_on_a_hill(void **state)
{
    (void)state;
    enum { SIDE = 21 };
    FILE *file = fopen("hill.obj", "w");
    TEST_CHECK(file != NULL);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = i % SIDE - 10, z = i / SIDE - 10, r = hypot(x, z) / 10;
        fprintf(file, "v %g %g %g\n", 2 * x, r < 1 ? 8 * (1 - r * r) : 0, 2 * z);
    }
    for (int i = 0; i < SIDE * (SIDE - 1); i++) {
        if (i % SIDE < SIDE - 1) {
            fprintf(file, "f %d %d %d %d\n", i + 1, i + SIDE + 1, i + SIDE + 2, i + 2);
        }
    }
    TEST_CHECK(fclose(file) == 0);
    // The seam of two tiles crosses the hill.
    cli_do(0, "draw hill.obj -o hill.svg --stage navmesh --view top --tile-size 68 --size 300");
    char *svg = cli_read_file("hill.svg", NULL);
    uint32_t lines = 0, faint = 0;
    for (const char *at = strstr(svg, "stroke-opacity:0."); at != NULL; at = strstr(at + 1, "stroke-opacity:0.")) {
        lines++;
        faint += at[strlen("stroke-opacity:0.")] < '8';
    }
    TEST_CHECK(lines > 20 && faint == 0);
    free(svg);
}

static void test_path_svg_and_views(void **state)
{
    (void)state;
    make_files();
    cli_result drawn = cli_expect(0, "draw yard.talus -o way.svg --from 2,0,20 --to 38,0,20 --view top --size 300");
    cli_check_part(drawn.out, "path complete");
    cli_free(&drawn);
    char *svg = cli_read_file("way.svg", NULL);
    cli_check_part(svg, "<svg");
    cli_check_part(svg, "</svg>");
    free(svg);
    uint32_t width[2];
    uint32_t height[2];
    cli_do(0, "draw yard.obj -o top.png --view top --size 500");
    cli_do(0, "draw yard.obj -o both.png --size 500");
    check_png("top.png", &width[0], &height[0]);
    check_png("both.png", &width[1], &height[1]);
    TEST_CHECK(width[0] < 540 && width[1] > 800);
    // Words need room beside a narrow view too.
    cli_do(0, "draw yard.obj -o small.png --view top --stage spans --size 200");
    check_png("small.png", &width[0], &height[0]);
    TEST_CHECK(width[0] == 420 && height[0] > 200);
    // No navmesh near an end: said, and the picture is made all the same.
    drawn = cli_expect(0, "draw yard.talus -o far.png --from 500,0,500 --to 38,0,20 --size 200");
    cli_check_part(drawn.err, "no navmesh near the start");
    cli_free(&drawn);
    TEST_CHECK(cli_exists("far.png"));
}

// A hexagon with a notch: five cuts and what they merge to; a set of several; a contour without area.
static const char notched[] =
    "navcontours 1\nname notched\ncs 1\nch 1\ncontours 2\nc 0 1 63 7\n0 0 0 0\n0 0 9 0\n5 0 12 0\n"
    "10 0 9 0\n10 0 0 0\n6 0 0 0\n5 0 7 0\nc 1 2 63 2\n0 0 0 0\n1 0 0 0\nend\n"
    "navcontours 1\nname triangle\ncs 1\nch 1\ncontours 1\nc 0 1 63 3\n0 0 0 0\n0 0 9 0\n9 0 0 0\n"
    "end\n";

static void test_steps_of_a_contour(void **state)
{
    (void)state;
    cli_write_text("notched.txt", notched);
    json_t *list = draw_json(0, "draw notched.txt -o s.svg --stage triangulation,merging --json");
    assert_int_equal(json_array_size(list), 2);
    const char *summary = json_string_value(json_object_get(json_array_get(list, 0), "summary"));
    cli_check_part(summary, "7 vertices: 5 cuts, then ");
    json_decref(list);
    static const char *const files[] = { "s-triangulation.svg", "s-merging.svg" };
    for (size_t i = 0; i < 2; ++i) {
        char *svg = cli_read_file(files[i], NULL);
        cli_check_part(svg, "<svg");
        cli_check_part(svg, "</svg>");
        free(svg);
    }
    // All that contours can show, and nothing else.
    list = draw_json(0, "draw notched.txt -o n.png --stage all --size 240 --json");
    assert_int_equal(json_array_size(list), 5);
    json_decref(list);
    // The second set is one triangle: one cut, no merge.
    cli_result drawn = cli_expect(0, "draw notched.txt -o t.png --stage merging --set 1");
    cli_check_part(drawn.out, "3 vertices: 1 cuts, then 0 merges to 1 convex polygons");
    cli_free(&drawn);
}

static void test_refusals(void **state)
{
    (void)state;
    make_files();
    cli_write_text("notched.txt", notched);
    cli_write_text("cut.txt", "navcontours 1\ncs 1\n");
    static const struct {
        int code;
        const char *line;
        const char *part;
    } table[] = {
        { 2, "draw yard.obj", "-o FILE.png" },
        { 2, "draw yard.obj -o x.png --stage voxels", "there is no stage 'voxels'" },
        { 2, "draw yard.obj -o x.png --stage ,", "stage" },
        { 2, "draw yard.obj -o x.png --from 1,2,3", "both --from and --to" },
        { 2, "draw yard.obj -o x.png --from 1,2,3 --to 1,2", "x,y,z" },
        { 2, "draw yard.obj -o x.png --size 100", "--size" },
        { 4, "draw none.obj -o x.png", "none.obj" },
        { 4, "draw yard.obj -o none/x.png --size 200", "none/x.png" },
        { 4, "draw yard.obj -o /dev/full --size 200", "/dev/full" },
        { 3, "draw yard.obj -o x.png --cell-size 0", "cell" },
        { 2, "draw notched.txt -o x.png --stage soup", "holds contours" },
        { 2, "draw notched.txt -o x.png --stage merging --contour 2", "there are 2 contours" },
        { 3, "draw notched.txt -o x.png --stage merging --contour 1", "try another --contour" },
        { 2, "draw notched.txt -o x.png --stage contours --set 2", "holds 2 sets" },
        { 3, "draw cut.txt -o x.png --stage contours", "cut.txt" },
    };
    for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i) {
        cli_result refused = cli_run_with(NULL, table[i].line);
        if (table[i].code == 3) {
            TEST_CHECK(refused.code == 2 || refused.code == 3); // by the option's range, or by the build
        } else {
            assert_int_equal(refused.code, table[i].code);
        }
        cli_check_part(refused.err, table[i].part);
        TEST_CHECK(!cli_exists("x.png"));
        cli_free(&refused);
    }
}

static void draw_maps(const char *line, const char *part)
{
    cli_result drawn = cli_expect(0, line);
    cli_check_part(drawn.out, part);
    cli_free(&drawn);
}

// A world's job: maps of its tiles, which change as they are baked.
static void test_world_maps(void **state)
{
    (void)state;
    uint32_t width[2], height[2];
    cli_do(0, "world plan yard.obj -o yard_job --tile-size 40");
    draw_maps("draw yard_job -o planned.png --size 300", "49 tiles of a grid 7 x 7, 49 missing, 0 km2 walkable, 0 s");
    cli_do(0, "world bake yard_job --shard 1/2");
    draw_maps("draw yard_job -o half.png --size 300", "49 tiles of a grid 7 x 7, 24 missing, ");
    cli_do(0, "world bake yard_job");
    draw_maps("draw yard_job -o done.png --size 300 --stage all", "49 tiles of a grid 7 x 7, 0 missing, 0.00");
    check_png("planned.png", &width[0], &height[0]);
    check_png("done.png", &width[1], &height[1]);
    TEST_CHECK(width[0] == width[1] && height[0] == height[1] && width[0] > 600 && height[0] > 600);
    size_t sizes[3];
    char *planned = cli_read_file("planned.png", &sizes[0]), *half = cli_read_file("half.png", &sizes[1]);
    char *done = cli_read_file("done.png", &sizes[2]);
    TEST_CHECK(sizes[0] != sizes[1] || memcmp(planned, half, sizes[0]) != 0);
    TEST_CHECK(sizes[1] != sizes[2] || memcmp(half, done, sizes[1]) != 0);
    free(planned);
    free(half);
    free(done);
    json_t *one = cli_json(0, "draw yard_job -o cost.svg --stage cost --json");
    TEST_CHECK(json_array_size(json_object_get(one, "pictures")) == 1);
    json_decref(one);
    char *svg = cli_read_file("cost.svg", NULL);
    cli_check_part(svg, "<svg");
    free(svg);
    cli_check_error(2, "draw yard_job -o bad.png --stage cost,regions", "'regions' is none of them", "walkable");
    cli_check_error(2, "draw yard_job -o bad.png --from 1,2,3 --to 4,5,6", "--from says nothing of yard_job",
                    "--stage");
    cli_check_error(2, "draw yard_job -o bad.png --tile-size 3", "--tile-size says nothing of yard_job", "--size");
    TEST_CHECK(!cli_exists("bad.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_stage),        cmocka_unit_test(test_overview),
        cmocka_unit_test(test_same_bytes),         cmocka_unit_test(test_navmesh_on_a_hill),
        cmocka_unit_test(test_path_svg_and_views), cmocka_unit_test(test_steps_of_a_contour),
        cmocka_unit_test(test_refusals),           cmocka_unit_test(test_world_maps),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
