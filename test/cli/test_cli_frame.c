// SPDX-License-Identifier: MIT
//
// What every command shares: help, usage errors, version, JSON, exit codes.
#include "cli_run.h"

static const char *const commands[] = { "sample",  "bake",    "info",     "check",      "draw",   "ray",   "nearest",
                                        "overlap", "sweep",   "path",     "around",     "links",  "why",   "audit",
                                        "hull",    "support", "distance", "polygonize", "export", "import" };
enum { COMMANDS = sizeof(commands) / sizeof(commands[0]) };

static void test_global_help(void **state)
{
    (void)state;
    cli_result help = cli_expect(0, "--help");
    cli_result same = cli_expect(0, "help");
    assert_string_equal(help.out, same.out);
    for (size_t i = 0; i < COMMANDS; ++i) {
        cli_check_part(help.out, commands[i]);
    }
    cli_result none = cli_expect(2, "");
    assert_string_equal(none.err, help.out);
    assert_int_equal(none.out_size, 0);
    cli_free(&help);
    cli_free(&same);
    cli_free(&none);
    cli_result version = cli_expect(0, "--version");
    char expected[64];
    snprintf(expected, sizeof(expected), "talus %s\n", tl_version());
    assert_string_equal(version.out, expected);
    cli_free(&version);
}

static void test_help_of_each(void **state)
{
    (void)state;
    for (size_t i = 0; i < COMMANDS; ++i) {
        char line[64];
        snprintf(line, sizeof(line), "%s --help", commands[i]);
        cli_result help = cli_expect(0, line);
        cli_check_part(help.out, "Usage: talus");
        cli_check_part(help.out, "\nExamples:\n");
        cli_check_part(help.out, "--json");
        cli_check_part(help.out, "--progress");
        cli_check_part(help.out, "Exit codes:");
        assert_int_equal(strlen(help.err), 0);
        cli_free(&help);
    }
    cli_result bake = cli_expect(0, "help bake");
    cli_check_part(bake.out, "--agent-max-slope");
    cli_check_part(bake.out, "[45]");
    cli_free(&bake);
}

static void test_usage_errors(void **state)
{
    (void)state;
    cli_check_error(2, "frobnicate", "'frobnicate' is no command", "talus --help");
    cli_check_error(2, "bkae", "did you mean 'bake'", "talus");
    for (size_t i = 0; i < COMMANDS; ++i) {
        char line[64];
        snprintf(line, sizeof(line), "%s --frobnicate", commands[i]);
        cli_check_error(2, line, "--frobnicate is no option", "--help'");
        if (strcmp(commands[i], "sample") != 0) { // alone it lists the levels
            cli_check_error(2, commands[i], "something is missing", "--help'");
        }
    }
    cli_check_error(2, "bake a b -o c", "unexpected word 'b'", "--help'");
    cli_check_error(2, "bake a", "-o", "talus bake");
    cli_check_error(2, "bake a -o b --cel-size 1", "did you mean --cell-size", "talus bake");
    cli_check_error(2, "bake a -o b --cell-size", "--cell-size", "missing");
    cli_check_error(2, "bake a -o b --cell-size big", "--cell-size: 'big' is not a number", "talus bake");
    cli_check_error(2, "bake a -o b --cell-size nan", "--cell-size: 'nan' is not finite", "talus bake");
    cli_check_error(2, "bake a -o b --cell-size -1", "--cell-size: '-1' is out of range", "use");
    cli_check_error(2, "bake a -o b --cell-size 1e99", "too large", "--cell-size");
    cli_check_error(2, "bake a -o b --max-verts-per-poly 2", "--max-verts-per-poly: '2' is too small", "use 3 to 64");
    cli_check_error(2, "bake a -o b --max-verts-per-poly 6.5", "not a whole number", "--max-verts-per-poly");
    cli_check_error(2, "bake a -o b --partition fast", "watershed, monotone, layers", "'fast'");
    cli_check_error(2, "bake a -o b --threads 0", "--threads: '0' is too small", "talus bake");
    cli_check_error(2, "bake a -o b --bounds 1,2,3", "--bounds", "too few");
    cli_check_error(2, "bake a -o b --no-soup --no-nav", "nothing to bake", "--hull");
    cli_check_error(2, "bake a -o b --no-soup --no-nav", "Try 'talus bake --help'.", "--hull");
    cli_check_error(2, "ray a 1,2,3", "--rays", "talus ray");
    cli_check_error(2, "ray a 1,2,3 4,5", "direction '4,5'", "X,Y,Z");
    cli_check_error(2, "ray a 1,2,nan 4,5,6", "origin '1,2,nan' is not finite", "X,Y,Z");
    cli_check_error(2, "ray a 1,2,3 0,0,0", "has no length", "talus ray");
    cli_check_error(2, "path a 1,2,3 4,5,6,7", "goal '4,5,6,7' has too many numbers", "X,Y,Z");
    cli_check_error(2, "path a 1,2,3 4,5,6 --extents -1,2,3", "--extents: '-1,2,3' is negative", "X,Y,Z");
    cli_check_error(2, "distance a b --pose 1,2,3,4", "--pose: '1,2,3,4'", "quaternion");
}

static void test_missing_files(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "bake no.obj -o out.talus",
        "info no.obj",
        "check no.talus",
        "ray no.talus 0,0,0 1,0,0",
        "path no.obj 0,0,0 1,0,0",
        "hull no.obj",
        "support no.obj 0,1,0",
        "distance no.obj no.obj",
        "info no.talus",
        "check no.obj",
    };
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
        cli_check_error(4, lines[i], "no.", ";");
    }
    TEST_CHECK(!cli_exists("out.talus"));
}

static void test_progress_as_json(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o level.obj");
    cli_result bake = cli_expect(0, "bake level.obj -o level.talus --progress=json");
    size_t lines = 0;
    char *rest = NULL;
    for (char *line = strtok_r(bake.err, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        json_t *object = json_loads(line, 0, NULL);
        TEST_CHECK(json_is_string(json_object_get(object, "stage")));
        TEST_CHECK(cli_number(object, "done") <= cli_number(object, "total"));
        json_decref(object);
        lines++;
    }
    TEST_CHECK(lines > 5);
    cli_free(&bake);
    bake = cli_expect(0, "bake level.obj -o level.talus --progress=line");
    assert_null(strchr(bake.err, '\n')); // one line, if it took long enough to be shown at all
    cli_free(&bake);
    bake = cli_expect(0, "bake level.obj -o level.talus");
    assert_string_equal(bake.err, ""); // no terminal, no progress
    cli_free(&bake);
}

static void test_full_standard_output(void **state)
{
    (void)state;
    if (!cli_exists("/dev/full")) {
        skip();
    }
    int code = cli_wait(cli_start("sample --list", "/dev/null", "/dev/full", "stderr.txt"));
    assert_int_equal(code, 4);
    char *err = cli_read_file("stderr.txt", NULL);
    cli_check_part(err, "standard output");
    free(err);
}

static void test_samples(void **state)
{
    (void)state;
    static const char *const names[] = { "courtyard", "dungeon", "terrain", "city" };
    for (size_t i = 0; i < 4; ++i) {
        char line[96];
        snprintf(line, sizeof(line), "sample %s -o s.obj -n 5000 --seed 9 --json", names[i]);
        json_t *object = cli_json(0, line);
        TEST_CHECK(cli_number(object, "triangles") > 4992 && cli_number(object, "triangles") <= 5000);
        json_decref(object);
        object = cli_json(0, "info s.obj --json");
        TEST_CHECK(cli_number(object, "triangles") > 4992 && cli_number(object, "triangles") <= 5000);
        json_decref(object);
    }
    cli_result piped = cli_expect(0, "sample city -o - -n 5000 --seed 9");
    size_t size;
    char *file = cli_read_file("s.obj", &size);
    assert_int_equal(piped.out_size, size);
    assert_memory_equal(piped.out, file, size);
    free(file);
    cli_free(&piped);
    json_t *list = cli_json(0, "sample --list --json");
    assert_int_equal(json_array_size(json_object_get(list, "levels")), 5); // and the world
    json_decref(list);
    cli_check_error(2, "sample castle", "no level 'castle'", "--list");
    cli_check_error(2, "sample city --triangles 9999999999", "--triangles", "too large");
}

// Names come back as they are, whatever they look like.
static void test_odd_names(void **state)
{
    (void)state;
    static const char *const names[] = { "a[1,2].obj", "quo\"te\\.obj", "\xc3\xa4[.obj", "{.obj" };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); ++i) {
        char line[64];
        cli_write_floor(names[i], 4, false);
        snprintf(line, sizeof(line), "info %s --json", names[i]);
        json_t *info = cli_json(0, line);
        assert_string_equal(json_string_value(json_object_get(info, "file")), names[i]);
        json_decref(info);
    }
    cli_write_floor("\xff.obj", 4, false); // no UTF-8: JSON cannot say it
    json_t *info = cli_json(0, "info \xff.obj --json");
    assert_string_equal(json_string_value(json_object_get(info, "file")), "?.obj");
    json_decref(info);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_global_help),      cmocka_unit_test(test_help_of_each),
        cmocka_unit_test(test_usage_errors),     cmocka_unit_test(test_missing_files),
        cmocka_unit_test(test_progress_as_json), cmocka_unit_test(test_full_standard_output),
        cmocka_unit_test(test_samples),          cmocka_unit_test(test_odd_names),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
