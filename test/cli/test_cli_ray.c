// SPDX-License-Identifier: MIT
//
// talus ray: answers in its exact form, against a brute-force search over all triangles.
#include "cli_run.h"

#include "cli/sample/sample_level.h"

#include <math.h>

enum { RAYS = 3000 };

// Moller and Trumbore in double: an oracle, not a rival.
static double hit_triangle(const tl_vec3 *c, const double o[3], const double d[3], double *u_out, double *v_out)
{
    double e1[3] = { (double)c[1].x - (double)c[0].x, (double)c[1].y - (double)c[0].y,
                     (double)c[1].z - (double)c[0].z };
    double e2[3] = { (double)c[2].x - (double)c[0].x, (double)c[2].y - (double)c[0].y,
                     (double)c[2].z - (double)c[0].z };
    double p[3] = { d[1] * e2[2] - d[2] * e2[1], d[2] * e2[0] - d[0] * e2[2], d[0] * e2[1] - d[1] * e2[0] };
    double det = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
    if (fabs(det) < 1e-12) {
        return -1.0;
    }
    double s[3] = { o[0] - (double)c[0].x, o[1] - (double)c[0].y, o[2] - (double)c[0].z };
    double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det;
    double q[3] = { s[1] * e1[2] - s[2] * e1[1], s[2] * e1[0] - s[0] * e1[2], s[0] * e1[1] - s[1] * e1[0] };
    double v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det;
    *u_out = u;
    *v_out = v;
    return u < 0.0 || v < 0.0 || u + v > 1.0 ? -1.0 : (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / det;
}

static double brute_force(const tl_sample_mesh *mesh, const float n[6])
{
    double best = (double)INFINITY;
    double o[3] = { (double)n[0], (double)n[1], (double)n[2] };
    double d[3] = { (double)n[3], (double)n[4], (double)n[5] };
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        tl_vec3 c[3];
        for (unsigned k = 0; k < 3; ++k) {
            c[k] = mesh->vertices[mesh->indices[3 * i + k]];
        }
        double u, v;
        double t = hit_triangle(c, o, d, &u, &v);
        if (t >= 0.0 && t < best) {
            best = t;
        }
    }
    return best;
}

// The rays of the test, and the same as a text file.
static void make_rays(float rays[RAYS][6])
{
    test_random random = { 11 };
    FILE *file = fopen("rays.txt", "w");
    assert_non_null(file);
    fputs("# a comment, and an empty line\n\n", file);
    for (int i = 0; i < RAYS; ++i) {
        tl_vec3 from = test_random_point(&random, tl_vec3_make(0, 0.5f, 0), tl_vec3_make(40, 9, 40));
        tl_vec3 to = test_random_direction(&random);
        float n[6] = { from.x, from.y, from.z, to.x, to.y, to.z };
        memcpy(rays[i], n, sizeof(n));
        fprintf(file, i % 2 ? "%.9g %.9g %.9g %.9g %.9g %.9g\n" : "  %.9g,%.9g\t%.9g %.9g %.9g, %.9g \r\n",
                (double)n[0], (double)n[1], (double)n[2], (double)n[3], (double)n[4], (double)n[5]);
    }
    fclose(file);
}

static void test_rays_against_brute_force(void **state)
{
    (void)state;
    static float rays[RAYS][6];
    tl_sample_mesh mesh;
    TEST_RESULT(tl_sample_build_level(tl_sample_find_level("courtyard"), 6000, 1, &mesh), TL_OK);
    cli_do(0, "sample courtyard -n 6000 -o level.obj");
    cli_do(0, "bake level.obj -o level.talus --no-nav");
    make_rays(rays);
    cli_result from_baked = cli_expect(0, "ray level.talus --rays rays.txt --threads 2");
    cli_result from_level = cli_expect(0, "ray level.obj --rays rays.txt --threads 1");
    assert_string_equal(from_baked.out, from_level.out);
    cli_result any = cli_expect(0, "ray level.talus --rays rays.txt --any");
    char *rest = NULL, *any_rest = NULL;
    char *line = strtok_r(from_baked.out, "\n", &rest);
    char *any_line = strtok_r(any.out, "\n", &any_rest);
    int hits = 0, misses = 0;
    for (int i = 0; i < RAYS; ++i) {
        assert_non_null(line);
        double t = brute_force(&mesh, rays[i]);
        if (isinf(t)) {
            assert_string_equal(line, "miss");
            assert_string_equal(any_line, "miss");
            misses++;
        } else {
            double found, u, v;
            unsigned triangle;
            assert_int_equal(sscanf(line, "%lf %u %lf %lf", &found, &triangle, &u, &v), 4);
            TEST_CHECK(fabs(found - t) <= 1e-5 * (1.0 + t));
            TEST_CHECK(triangle < mesh.triangle_count);
            // u and v name the same point as t.
            tl_vec3 *c[3];
            for (unsigned k = 0; k < 3; ++k) {
                c[k] = &mesh.vertices[mesh.indices[3 * triangle + k]];
            }
            double x = (double)c[0]->x * (1 - u - v) + (double)c[1]->x * u + (double)c[2]->x * v;
            TEST_CHECK(fabs(x - ((double)rays[i][0] + t * (double)rays[i][3])) < 1e-4);
            assert_string_equal(any_line, "hit");
            hits++;
        }
        line = strtok_r(NULL, "\n", &rest);
        any_line = strtok_r(NULL, "\n", &any_rest);
    }
    assert_null(line);
    TEST_CHECK(hits > RAYS / 4 && misses > RAYS / 20);
    cli_free(&from_baked);
    cli_free(&from_level);
    cli_free(&any);
    tl_sample_mesh_free(&mesh);
}

// One triangle in the plane y = 2: corner 0 (0,2,0), 1 (4,2,0), 2 (0,2,4).
static void write_triangle(void)
{
    cli_write_text("one.obj", "v 0 2 0\nv 4 2 0\nv 0 2 4\nf 1 2 3\n");
}

static void check_answer(int code, const char *line, const char *expected)
{
    cli_result result = cli_expect(code, line);
    assert_string_equal(result.out, expected);
    cli_free(&result);
}

static void test_forms(void **state)
{
    (void)state;
    write_triangle();
    check_answer(0, "ray one.obj 1,5,1 0,-1,0", "3 0 0.25 0.25\n");
    check_answer(0, "ray one.obj 1,5,1 0,-2,0", "1.5 0 0.25 0.25\n");
    check_answer(0, "ray one.obj -0,5,1 0,-1,0", "3 0 0 0.25\n");
    check_answer(1, "ray one.obj -1,5,1 0,-1,0", "miss\n");
    check_answer(1, "ray one.obj 1,5,1 0,-1,0 --tmax 2.5", "miss\n");
    check_answer(0, "ray one.obj 1,5,1 0,-1,0 --any", "hit\n");
    check_answer(1, "ray one.obj 1,5,1 0,1,0 --any", "miss\n");
    check_answer(0, "ray one.obj 1,4,1 1,0,1 --segment", "0.5 0 0.25 0.25\n");
    check_answer(1, "ray one.obj 1,4,1 1,3,1 --segment", "miss\n");
    check_answer(0, "ray one.obj 1,4,1 1,0,1 --segment --any", "hit\n");
    // The triangle faces down: up is its back.
    check_answer(1, "ray one.obj 1,5,1 0,-1,0 --cull back", "miss\n");
    check_answer(0, "ray one.obj 1,0,1 0,1,0 --cull back", "2 0 0.25 0.25\n");
    check_answer(0, "ray one.obj 100,500,100 0,-100,0 --scale 100", "3 0 0.25 0.25\n");
    check_answer(0, "ray one.obj 1,5,1 0,-1,0 --up z", "3 0 0.25 0.25\n"); // in the level's axes
    json_t *hit = cli_json(0, "ray one.obj 1,5,1 0,-1,0 --json");
    assert_true(json_is_true(json_object_get(hit, "hit")));
    TEST_CHECK(cli_number(hit, "t") == 3.0 && cli_number(hit, "triangle") == 0.0);
    json_decref(hit);
}

static void test_streamed(void **state)
{
    (void)state;
    write_triangle();
    cli_result result =
        cli_expect_with(0, "1 5 1 0 -1 0\n1 5 1 0 -1 0 2\n\n# no ray\n9 9 9 1 0 0", "ray one.obj --rays -");
    assert_string_equal(result.out, "3 0 0.25 0.25\nmiss\nmiss\n");
    cli_free(&result);
    result = cli_expect_with(0, "1 5 1 0 -1 0\n9 9 9 1 0 0\n", "ray one.obj --rays - --json");
    cli_check_part(result.out, "{\"hit\":true,\"t\":3,\"triangle\":0,");
    cli_check_part(result.out, "}\n{\"hit\":false}\n");
    cli_free(&result);
    result = cli_expect_with(0, "", "ray one.obj --rays -");
    assert_int_equal(result.out_size, 0);
    cli_free(&result);
}

// Answers up to the bad line are printed, then its number, content and form are named.
static void check_bad_line(const char *input, const char *part, const char *other_part)
{
    write_triangle();
    cli_result result = cli_expect_with(3, input, "ray one.obj --rays -");
    assert_string_equal(result.out, "3 0 0.25 0.25\n");
    cli_check_part(result.err, part);
    cli_check_part(result.err, other_part);
    cli_check_part(result.err, "-:2:");
    cli_free(&result);
}

static void test_bad_lines(void **state)
{
    (void)state;
    check_bad_line("1 5 1 0 -1 0\n1 2 3 4 5\n", "5 numbers", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 3 4 5 6 7 8\n", "8 numbers", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 nan 4 5 6\n", "'nan' is not finite", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 -inf 4 5 6\n", "'-inf' is not finite", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 1e99 4 5 6\n", "'1e99' is too large", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 x3 4 5 6\n", "'x3' is not a number", "ox oy oz dx dy dz");
    check_bad_line("1 5 1 0 -1 0\n1 2 3x 4 5 6\n", "'3x' is not a number", "ox oy oz dx dy dz");
    cli_check_error(4, "ray one.obj --rays nothing.txt", "nothing.txt", ";");
}

// A caller that waits for each answer before it asks on must get it.
static void test_answers_at_once(void **state)
{
    (void)state;
    write_triangle();
    assert_int_equal(mkfifo("questions", 0600), 0);
    assert_int_equal(mkfifo("answers", 0600), 0);
    pid_t child = cli_start("ray one.obj --rays -", "questions", "answers", "stderr.txt");
    FILE *questions = fopen("questions", "w");
    FILE *answers = fopen("answers", "r");
    assert_non_null(questions);
    assert_non_null(answers);
    for (int i = 0; i < 3; ++i) {
        char line[64];
        fputs("1 5 1 0 -1 0\n", questions);
        fflush(questions);
        assert_non_null(fgets(line, sizeof(line), answers));
        assert_string_equal(line, "3 0 0.25 0.25\n");
    }
    fclose(questions);
    assert_int_equal(cli_wait(child), 0);
    fclose(answers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_against_brute_force),
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_streamed),
        cmocka_unit_test(test_bad_lines),
        cmocka_unit_test(test_answers_at_once),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
