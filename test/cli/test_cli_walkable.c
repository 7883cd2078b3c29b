// SPDX-License-Identifier: MIT
//
// A level of which nothing is walkable: every command that needs a navmesh ends with the same exit code and names the
// cause. And levels that bake something odd are told so, while good ones are not.
#include "cli_run.h"

#include "cli/sample/sample_level.h"

enum { EMPTY = 6 };

static void write_quad(const char *path, const char *corners, bool turned)
{
    char text[256];
    snprintf(text, sizeof(text), "%s\nf %s\n", corners, turned ? "4 3 2 1" : "1 2 3 4");
    cli_write_text(path, text);
}

// Vertices of the sample moved as `axes` says: "yz" swaps, "-" turns triangles round; scaled.
static void write_changed_sample(const char *name, const char *path, bool z_up, bool inside_out, double scale)
{
    const tl_sample_level *level = tl_sample_find_level(name);
    tl_sample_mesh mesh;
    assert_int_equal(tl_sample_build_level(level, level->default_triangles, 1, &mesh), TL_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const double x = scale * (double)mesh.vertices[i].x, y = scale * (double)mesh.vertices[i].y,
                     z = scale * (double)mesh.vertices[i].z;
        fprintf(file, "v %.9g %.9g %.9g\n", x, z_up ? -z : y, z_up ? y : z);
    }
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const uint32_t *t = &mesh.indices[3 * i];
        fprintf(file, "f %u %u %u\n", t[0] + 1, t[inside_out ? 2 : 1] + 1, t[inside_out ? 1 : 2] + 1);
    }
    fclose(file);
    tl_sample_mesh_free(&mesh);
}

static void check_cause(const char *line, const char *cause, const char *advice)
{
    char shown[64], command[256];
    snprintf(shown, sizeof(shown), "nothing is walkable (%s)", cause);
    snprintf(command, sizeof(command), "bake %s -o out.talus", line);
    cli_check_error(EMPTY, command, shown, advice);
    snprintf(command, sizeof(command), "path %s 0,0,0 1,0,1", line);
    cli_check_error(EMPTY, command, shown, advice);
    snprintf(command, sizeof(command), "bake %s -o out.talus --json", line);
    json_t *object = cli_json(EMPTY, command);
    assert_string_equal(json_string_value(json_object_get(json_object_get(object, "navmesh"), "cause")), cause);
    json_decref(object);
}

static void test_causes(void **state)
{
    (void)state;
    const char *floor = "v -10 0 -10\nv -10 0 10\nv 10 0 10\nv 10 0 -10";
    write_quad("floor.obj", floor, false);
    write_quad("turned.obj", floor, true);
    write_quad("upright.obj", "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0", false);
    write_quad("steep.obj", "v -10 0 -10\nv -10 30 10\nv 10 30 10\nv 10 0 -10", false);
    cli_do(0, "bake floor.obj -o floor.talus");
    write_changed_sample("courtyard", "small.obj", false, false, 0.01);
    check_cause("small.obj", "units", "--scale 100");
    check_cause("floor.obj --scale 0.001", "units", "--scale 1");
    check_cause("turned.obj", "winding", "400 m2 of triangles face down and 0 m2 up");
    check_cause("upright.obj", "up axis", "give --up z");
    check_cause("floor.obj --up z", "up axis", "leave out --up z");
    check_cause("steep.obj", "slope", "slopes 56.3 degrees, --agent-max-slope is 45");
    check_cause("floor.obj --agent-radius 12", "agent", "with --agent-radius 6 and --agent-height 2");
    check_cause("floor.obj --area *=0", "areas", "--area");
    check_cause("floor.obj --bounds 50,0,50,60,1,60", "bounds", "beside the level");
    check_cause("floor.obj --region-min-size 100", "region_min_size", "--region-min-size");
    check_cause("floor.obj --island-min-area 1000", "pruning", "smaller than --island-min-area");
}

static void test_every_command(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 20, false);
    cli_do(EMPTY, "bake level.obj -o empty.talus --agent-radius 12");
    static const char *const lines[] = { "path %s 0,0,0 1,0,1", "around %s 0,0,0", "audit %s", "links %s",
                                         "export %s -o x.bin" };
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
        char line[128];
        snprintf(line, sizeof(line), lines[i], "empty.talus");
        cli_check_error(EMPTY, line, "nothing is walkable", "bake the level again");
        snprintf(line, sizeof(line), lines[i], "level.obj");
        strcat(line, " --agent-radius 12");
        cli_check_error(EMPTY, line, "nothing is walkable (agent)", "too large");
    }
    cli_result check = cli_expect(EMPTY, "check empty.talus");
    cli_check_part(check.out, "empty, nothing is walkable");
    cli_free(&check);
    // The stages up to where the floors are lost can be drawn all the same.
    cli_result drawn = cli_expect(0, "draw level.obj -o all.png --overview --size 200 --agent-radius 12");
    cli_check_part(drawn.err, "nothing is walkable; the picture shows no path");
    cli_free(&drawn);
    drawn = cli_expect(0, "draw level.obj -o areas.png --stage areas --size 200 --agent-radius 12");
    cli_check_part(drawn.out, " open floors, 0 of them walkable after erosion");
    cli_free(&drawn);
}

static void check_doubt(const char *path, const char *part)
{
    char line[128];
    snprintf(line, sizeof(line), "bake %s -o out.talus --no-soup --cell-size 0.4", path);
    cli_result bake = cli_run_with(NULL, line);
    TEST_CHECK(bake.code == 0 || bake.code == EMPTY);
    if (part != NULL) {
        cli_check_part(bake.err, part);
    } else {
        TEST_CHECK(strstr(bake.err, "; is it") == NULL && strstr(bake.err, "face down") == NULL &&
                   strstr(bake.err, "--scale") == NULL && strstr(bake.err, "float") == NULL);
    }
    cli_free(&bake);
    snprintf(line, sizeof(line), "check %s", path);
    cli_result check = cli_expect(0, line);
    if (part != NULL) {
        cli_check_part(check.out, part);
    }
    cli_free(&check);
}

// A cube of `size` metres at a place, wound to face outwards or inwards.
static void write_cube(FILE *file, uint32_t *vertices, const double low[3], double size, bool inward)
{
    static const int faces[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                     { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    for (int k = 0; k < 8; ++k) {
        fprintf(file, "v %g %g %g\n", low[0] + size * (k & 1), low[1] + size * (k >> 1 & 1), low[2] + size * (k >> 2));
    }
    for (int f = 0; f < 6; ++f) {
        fprintf(file, "f");
        for (int k = 0; k < 4; ++k) {
            fprintf(file, " %u", *vertices + 1 + (uint32_t)faces[f][inward ? 3 - k : k]);
        }
        fprintf(file, "\n");
    }
    *vertices += 8;
}

// Closed rooms of 4 m in a row, which face inwards, and crates of 3 m, the first ones in the rooms.
static void write_rooms(const char *path, int rooms, int crates)
{
    uint32_t vertices = 0;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < rooms; ++i) {
        write_cube(file, &vertices, (const double[3]){ 5.0 * i, 0.0, 0.0 }, 4.0, true);
    }
    for (int i = 0; i < crates; ++i) {
        write_cube(file, &vertices, (const double[3]){ 5.0 * i + 0.5, 0.0, 0.5 }, 3.0, false);
    }
    fclose(file);
}

static void test_odd_levels_are_told(void **state)
{
    (void)state;
    static const char *const names[] = { "courtyard", "city", "dungeon", "terrain" };
    for (int i = 0; i < 4; ++i) {
        write_changed_sample(names[i], "good.obj", false, false, 1.0);
        check_doubt("good.obj", NULL);
        write_changed_sample(names[i], "z.obj", true, false, 1.0);
        check_doubt("z.obj", "give --up z");
        check_doubt("z.obj --up z", NULL);
        check_doubt("good.obj --up z", "leave out --up z");
    }
    for (int i = 0; i < 4; ++i) { // by areas in the open, else by the volumes of solids
        write_changed_sample(names[i], "turned.obj", false, true, 1.0);
        check_doubt("turned.obj", i == 3 ? "its floors face down" : "its solids are inside out");
    }
    write_rooms("rooms.obj", 5, 0);
    check_doubt("rooms.obj", NULL);
    write_rooms("furnished.obj", 40, 40); // many rooms, each with a crate that is large enough
    check_doubt("furnished.obj", NULL);
    write_rooms("crates.obj", 0, 12);
    check_doubt("crates.obj", NULL);
    write_changed_sample("courtyard", "large.obj", false, false, 100.0);
    cli_result bake = cli_expect(0, "bake large.obj -o out.talus --no-soup --cell-size 20 --agent-max-climb 60");
    cli_check_part(bake.err, "give --scale 0.01");
    cli_free(&bake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_causes),
        cmocka_unit_test(test_every_command),
        cmocka_unit_test(test_odd_levels_are_told),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
