// SPDX-License-Identifier: MIT
//
// A level in other axes, far out: each command takes points and gives answers in the level's own coordinates, also of a
// baked file of it. The same level in talus's own axes, at the origin, is what they are compared with.
#include "cli_run.h"

#include "cli/sample/sample_level.h"

#include <math.h>
#include <talus/pack.h>

static const char *const ups[] = { "y", "z", "y-left", "z-left" };
static const double origin[3] = { 500000.0, 4649000.0, -250.0 };

// A baked point in the level's coordinates.
static void place_out(tl_pack_axes axes, tl_vec3 point, double out[3])
{
    const tl_pack_frame frame = { .axes = (uint32_t)axes, .origin = { origin[0], origin[1], origin[2] } };
    tl_pack_place_out(&frame, point, out);
}

static void write_courtyard(const char *path, const tl_pack_axes *axes)
{
    const tl_sample_level *level = tl_sample_find_level("courtyard");
    tl_sample_mesh mesh;
    assert_int_equal(tl_sample_build_level(level, level->default_triangles, 1, &mesh), TL_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const tl_vec3 v = mesh.vertices[i];
        double at[3] = { (double)v.x, (double)v.y, (double)v.z };
        if (axes != NULL) {
            place_out(*axes, v, at);
        }
        fprintf(file, "v %.9f %.9f %.9f\n", at[0], at[1], at[2]);
    }
    const bool left = axes != NULL && *axes >= TL_PACK_AXES_Y_UP_LEFT;
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const uint32_t *t = &mesh.indices[3 * i];
        fprintf(file, "f %u %u %u\n", t[0] + 1, t[left ? 2 : 1] + 1, t[left ? 1 : 2] + 1);
    }
    fclose(file);
    tl_sample_mesh_free(&mesh);
}

// Numbers of a text answer: those of the frame, against those of the level at the origin. `kinds` has a letter a
// number or triple: s one number, p a place, d a direction, * any words to the end.
static void compare_answers(tl_pack_axes axes, const char *near, const char *far, const char *kinds, const char *line)
{
    for (; *kinds != '\0'; ++kinds) {
        const int count = *kinds == 's' ? 1 : 3;
        double a[3] = { 0 }, b[3] = { 0 }, wanted[3];
        for (int i = 0; i < count; ++i) {
            char *end;
            near += strspn(near, " ,\n");
            far += strspn(far, " ,\n");
            a[i] = strtod(near, &end);
            TEST_CHECK(end != near);
            near = end;
            b[i] = strtod(far, &end);
            TEST_CHECK(end != far);
            far = end;
        }
        const tl_vec3 v = tl_vec3_make((float)a[0], (float)a[1], (float)a[2]);
        if (*kinds == 'p') {
            place_out(axes, v, wanted);
        } else {
            const tl_vec3 turned = *kinds == 'd' ? tl_pack_turn_out(axes, v) : v;
            wanted[0] = (double)turned.x;
            wanted[1] = (double)turned.y;
            wanted[2] = (double)turned.z;
        }
        for (int i = 0; i < count; ++i) {
            if (!(fabs(b[i] - wanted[i]) < 2e-3)) {
                fail_msg("--up %s: %s: %.9g instead of %.9g", ups[axes], line, b[i], wanted[i]);
            }
        }
    }
}

typedef struct axes_question {
    const char *command;
    tl_vec3 first;
    tl_vec3 second; // of questions with two triples
    int triples;
    bool moves; // the second triple is a direction
    const char *rest;
    const char *kinds;
} axes_question;

static const axes_question questions[] = {
    { "path", { 2, 0, 20 }, { 20, 5, 20 }, 2, false, "", "sppp" },
    { "ray", { 20, 10, 20 }, { 0.25f, -1, 0.5f }, 2, true, "", "s" },
    { "sweep", { 20, 10, 20 }, { 0.5f, -20, 1 }, 2, true, "--radius 0.4", "sspd" },
    { "nearest", { 3, 1.5f, 7.25f }, { 0, 0, 0 }, 1, false, "", "ssp" },
    { "around", { 2, 0, 20 }, { 0, 0, 0 }, 1, false, "--list walls --radius 6", "sspp" },
};

static void write_question(const axes_question *q, const tl_pack_axes *axes, const char *file, char line[256])
{
    double at[6] = { (double)q->first.x,  (double)q->first.y,  (double)q->first.z,
                     (double)q->second.x, (double)q->second.y, (double)q->second.z };
    if (axes != NULL) {
        place_out(*axes, q->first, at);
        const tl_vec3 turned = tl_pack_turn_out(*axes, q->second);
        at[3] = (double)turned.x;
        at[4] = (double)turned.y;
        at[5] = (double)turned.z;
        if (!q->moves) {
            place_out(*axes, q->second, at + 3);
        }
    }
    int length = snprintf(line, 256, "%s %s %.9g,%.9g,%.9g", q->command, file, at[0], at[1], at[2]);
    if (q->triples == 2) {
        length += snprintf(line + length, 256 - (size_t)length, " %.9g,%.9g,%.9g", at[3], at[4], at[5]);
    }
    snprintf(line + length, 256 - (size_t)length, " %s", q->rest);
}

static void test_commands_speak_the_level(void **state)
{
    (void)state;
    char line[256], bake[256], file[32];
    write_courtyard("near.obj", NULL);
    cli_do(0, "bake near.obj -o near.talus");
    for (int up = 0; up < 4; ++up) {
        const tl_pack_axes axes = (tl_pack_axes)up;
        snprintf(file, sizeof(file), "far%d.talus", up);
        write_courtyard("far.obj", &axes);
        snprintf(bake, sizeof(bake), "bake far.obj -o %s --up %s --origin 500000,4649000,-250", file, ups[up]);
        cli_result baked = cli_expect(0, bake);
        assert_string_equal(baked.err, "");
        cli_check_part(baked.out, "points   are given and answered as in the level");
        cli_free(&baked);
        snprintf(line, sizeof(line), "check %s", file);
        cli_do(0, line);
        for (size_t i = 0; i < sizeof(questions) / sizeof(questions[0]); ++i) {
            write_question(&questions[i], NULL, "near.talus", line);
            cli_result near = cli_expect(0, line);
            write_question(&questions[i], &axes, file, line);
            cli_result far = cli_expect(0, line);
            assert_string_equal(far.err, "");
            compare_answers(axes, near.out, far.out, questions[i].kinds, line);
            cli_free(&near);
            cli_free(&far);
        }
        // A file of questions, JSON, and what asks the triangles too.
        double a[3], b[3];
        place_out(axes, tl_vec3_make(2, 0, 20), a);
        place_out(axes, tl_vec3_make(38, 0, 20), b);
        snprintf(line, sizeof(line), "%.9g %.9g %.9g %.9g %.9g %.9g\n", a[0], a[1], a[2], b[0], b[1], b[2]);
        cli_write_text("pairs.txt", line);
        snprintf(line, sizeof(line), "path %s --pairs pairs.txt", file);
        cli_result far = cli_expect(0, line), near = cli_expect(0, "path near.talus 2,0,20 38,0,20");
        compare_answers(axes, near.out, far.out, "spp", line);
        cli_free(&near);
        cli_free(&far);
        snprintf(line, sizeof(line), "why %s %.9g,%.9g,%.9g --json", file, a[0], a[1], a[2]);
        json_t *why = cli_json(0, line);
        for (size_t i = 0; i < 3; ++i) {
            TEST_CHECK(fabs(json_number_value(json_array_get(json_object_get(why, "floor"), i)) - a[i]) < 0.5);
        }
        json_decref(why);
        snprintf(line, sizeof(line), "info %s", file);
        far = cli_expect(0, line);
        cli_check_part(far.out, "0,0,0 inside is 500000,4649000,-250");
        cli_free(&far);
        // What does not speak them says what it speaks.
        snprintf(line, sizeof(line), "export %s -o tiles.bin", file);
        cli_check_error(0, line, "coordinates here are y-up and right-handed", "500000,4649000,-250");
    }
}

// Hulls too: directions, poses as motions and turns, points and normals, alone and by lines.
static void test_hulls_speak_the_level(void **state)
{
    (void)state;
    char line[400], file[32];
    write_courtyard("near.obj", NULL);
    cli_do(0, "bake near.obj -o near.talus --hull --no-nav");
    const tl_vec3 direction = { 0.25f, 1, -0.5f }, motion = { 55, 3, 20 }, about = { 0.1f, 0.7f, 0.2f };
    for (int up = 0; up < 4; ++up) {
        const tl_pack_axes axes = (tl_pack_axes)up;
        snprintf(file, sizeof(file), "hull%d.talus", up);
        write_courtyard("far.obj", &axes);
        snprintf(line, sizeof(line), "bake far.obj -o %s --up %s --origin 500000,4649000,-250 --hull --no-nav", file,
                 ups[up]);
        cli_do(0, line);
        const tl_vec3 d = tl_pack_turn_out(axes, direction), m = tl_pack_turn_out(axes, motion);
        cli_result near = cli_expect(0, "support near.talus 0.25,1,-0.5");
        snprintf(line, sizeof(line), "support %s %g,%g,%g", file, (double)d.x, (double)d.y, (double)d.z);
        cli_result far = cli_expect(0, line);
        assert_string_equal(far.err, "");
        compare_answers(axes, near.out, far.out, "sp", line);
        double vertex, p[3], dot;
        assert_int_equal(sscanf(far.out, "%lf %lf %lf %lf %lf", &vertex, &p[0], &p[1], &p[2], &dot), 5);
        TEST_CHECK(fabs(dot - (p[0] * (double)d.x + p[1] * (double)d.y + p[2] * (double)d.z)) < 1.0); // of 5e6, a float
        cli_free(&near);
        cli_free(&far);
        near = cli_expect(0, "distance near.talus near.talus --pose 55,3,20,0.1,0.7,0.2,0.6");
        const float side = axes >= TL_PACK_AXES_Y_UP_LEFT ? -1.0f : 1.0f; // turns go the other way in a mirror
        const tl_vec3 a = tl_pack_turn_out(axes, tl_scale(about, side));
        char pose[160];
        snprintf(pose, sizeof(pose), "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,0.6", (double)m.x, (double)m.y, (double)m.z,
                 (double)a.x, (double)a.y, (double)a.z);
        snprintf(line, sizeof(line), "distance %s %s --pose %s", file, file, pose);
        far = cli_expect(0, line);
        assert_string_equal(far.err, "");
        compare_answers(axes, near.out, far.out, "sppd", line);
        for (char *comma = pose; (comma = strchr(comma, ',')) != NULL;) {
            *comma = ' ';
        }
        strcat(pose, "\n");
        cli_write_text("poses.txt", pose);
        snprintf(line, sizeof(line), "distance %s %s --poses poses.txt", file, file);
        cli_result lines = cli_expect(0, line);
        assert_string_equal(lines.out, far.out);
        cli_free(&lines);
        cli_free(&near);
        cli_free(&far);
        // Levels that have not the same axes and origin have no coordinates in common.
        snprintf(line, sizeof(line), "distance %s near.talus --pose 55,3,20", file);
        cli_check_error(0, line, "coordinates here are y-up and right-handed", "500000,4649000,-250");
    }
    // A mesh that is not baked: its own axes, the same answer.
    write_courtyard("z.obj", NULL);
    cli_result turned = cli_expect(0, "support z.obj 0,0,1 --up z"), plain = cli_expect(0, "support z.obj 0,0,1");
    assert_string_equal(turned.out, plain.out);
    TEST_CHECK(turned.err[0] == '\0');
    cli_free(&turned);
    cli_free(&plain);
}

// Options of the bake that are points, and a level that is not baked beforehand.
static void test_options_speak_the_level(void **state)
{
    (void)state;
    const tl_pack_axes axes = TL_PACK_AXES_Z_UP;
    double a[3], b[3], low[3], high[3];
    char line[400];
    write_courtyard("near.obj", NULL);
    write_courtyard("far.obj", &axes);
    place_out(axes, tl_vec3_make(2, 0, 20), a);
    place_out(axes, tl_vec3_make(8, 0, 20), b);
    place_out(axes, tl_vec3_make(0, -1, 30), low); // z-up: y is -z
    place_out(axes, tl_vec3_make(12, 9, 10), high);
    snprintf(line, sizeof(line),
             "path far.obj %.9g,%.9g,%.9g %.9g,%.9g,%.9g --up z --origin auto --bounds "
             "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g --reachable-from %.9g,%.9g,%.9g",
             a[0], a[1], a[2], b[0], b[1], b[2], low[0], low[1], low[2], high[0], high[1], high[2], a[0], a[1], a[2]);
    cli_result far = cli_expect(0, line);
    cli_result near = cli_expect(0, "path near.obj 2,0,20 8,0,20 --bounds 0,-1,10,12,9,30");
    compare_answers(axes, near.out, far.out, "spp", line);
    cli_free(&near);
    cli_free(&far);
}

// A z-up level at its own origin, and files of before: no more to say, but other axes.
static void test_z_up(void **state)
{
    (void)state;
    cli_write_text("z.obj", "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nf 1 2 3 4\n");
    cli_do(0, "bake z.obj -o z.talus --up z");
    cli_result hit = cli_expect(0, "ray z.talus 1,2,1 0,0,-1 --json");
    assert_string_equal(hit.err, "");
    cli_check_part(hit.out, "\"point\":[1,2,0],\"normal\":[0,0,1]");
    cli_free(&hit);
    cli_do(0, "overlap z.talus 1,2,1 --half 0.1,0.1,2 --any"); // upright in the level
    cli_do(1, "overlap z.talus 1,2,1 --half 0.1,2,0.1 --any");
    hit = cli_expect(0, "nearest z.talus 1,2,3");
    cli_check_part(hit.out, " 1 2 0 face");
    cli_free(&hit);
    cli_check_error(2, "bake z.obj -o z.talus --up x", "--up", "z-left");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_commands_speak_the_level),
        cmocka_unit_test(test_hulls_speak_the_level),
        cmocka_unit_test(test_options_speak_the_level),
        cmocka_unit_test(test_z_up),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
