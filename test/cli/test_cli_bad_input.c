// SPDX-License-Identifier: MIT
//
// Input as it should not be: every case has its exit code, and a message that names the file, the place and what to do.
// Nothing is left behind.
#include "cli_run.h"

#include <dirent.h>

// The only file of the folder's that may be there besides the test's own is the answer to a run that succeeded.
static void check_nothing_left(void)
{
    DIR *folder = opendir(".");
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (strstr(entry->d_name, "tmp") != NULL || strcmp(entry->d_name, "out.talus") == 0) {
            fail_msg("%s is left behind", entry->d_name);
        }
    }
    closedir(folder);
}

typedef struct bad_level {
    const char *text;
    int code; // of bake
    const char *part, *other_part;
} bad_level;

static const bad_level bad_levels[] = {
    { "", 3, "bad.obj", ";" },
    { "# nothing but a comment\n", 3, "bad.obj", ";" },
    { "v 0 0 0\nv 1 0 0\nv 0 0 1\n", 3, "no faces", ";" },
    { "v 0 0 0\nv 1 nan 0\nv 0 0 1\nf 1 2 3\n", 3, "bad.obj:2:", "nan" },
    { "v 0 0 0\nv 1 inf 0\nv 0 0 1\nf 1 2 3\n", 3, "bad.obj:2:", "inf" },
    { "v 0 0 0\nv 1 1e99 0\nv 0 0 1\nf 1 2 3\n", 3, "bad.obj:2:", "" },
    { "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 4\n", 3, "bad.obj:4:", "" },
    { "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 -4\n", 3, "bad.obj:4:", "" },
    { "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 0\n", 3, "bad.obj:4:", "" },
    { "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2\n", 3, "bad.obj:4:", "" },
    { "v 0 0 zero\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", 3, "bad.obj:1:", "" },
    { "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", 3, "has area", ";" }, // all degenerate
    { "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n", 3, "has area", ";" },          // all in one point
    { "v 1e13 0 0\nv 0 0 0\nv 0 0 1e13\nf 1 2 3\n", 3, "bad.obj", ";" },     // beyond every computation
    { "v -1e9 0 -1e9\nv -1e9 0 1e9\nv 1e9 0 1e9\nv 1e9 0 -1e9\nf 1 2 3 4\n", 3, "bad.obj", ";" }, // 1e19 voxels
};

static void test_bad_levels(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(bad_levels) / sizeof(bad_levels[0]); ++i) {
        const bad_level *bad = &bad_levels[i];
        cli_write_text("bad.obj", bad->text);
        cli_check_error(bad->code, "bake bad.obj -o out.talus", bad->part, bad->other_part);
        check_nothing_left();
    }
}

// Odd but legal: baked, with what there is.
static void test_odd_levels(void **state)
{
    (void)state;
    static const char *const odd[] = {
        "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n",                                              // one triangle
        "v 0 0 0\nv 0 9 0\nv 9 9 0\nv 9 0 0\nf 1 2 3 4\n",                                   // all in one upright plane
        "v 0 0 0\nv 0 0 1e-6\nv 1e-6 0 0\nv 0 1e-6 0\nf 1 2 3\nf 1 3 4\nf 2 4 3\nf 1 4 2\n", // a micrometre large
    };
    for (size_t i = 0; i < 3; ++i) {
        cli_write_text("odd.obj", odd[i]);
        cli_result bake = cli_expect(6, "bake odd.obj -o odd.talus");
        cli_check_part(bake.out, "nothing is walkable");
        cli_free(&bake);
        json_t *object = cli_json(6, "bake odd.obj -o odd.talus --json");
        assert_true(json_is_false(json_object_get(json_object_get(object, "navmesh"), "walkable")));
        TEST_CHECK(cli_number(object, "soup.triangles") >= 1);
        json_decref(object);
        cli_do(6, "check odd.talus");
        cli_do(0, "info odd.talus");
        cli_check_error(6, "path odd.talus 0,0,0 1,0,0", "nothing is walkable", ";");
    }
    cli_do(0, "ray odd.talus 2e-7,1,2e-7 0,-1,0"); // the small one is hit all the same
    cli_do(1, "ray odd.talus 2e-6,1,2e-7 0,-1,0");
}

static void test_huge_level(void **state)
{
    (void)state;
    cli_write_text("huge.obj", bad_levels[sizeof(bad_levels) / sizeof(bad_levels[0]) - 1].text);
    cli_do(0, "bake huge.obj -o huge.talus --no-nav");
    cli_do(0, "ray huge.talus 123456789,5,1 0,-1,0");
    cli_do(0, "bake huge.obj -o huge.talus --cell-size 1e6 --cell-height 1e3 --agent-radius 0");
    cli_do(0, "path huge.talus -4e8,0,0 4e8,0,1e8 --extents 1e6,1e6,1e6");
}

static void test_far_from_the_origin(void **state)
{
    (void)state;
    cli_write_text("far.obj", "v 4990 200 4990\nv 4990 200 5010\nv 5010 200 5010\nv 5010 200 4990\nf 1 2 3 4\n");
    cli_do(0, "bake far.obj -o far.talus");
    cli_do(0, "check far.talus");
    json_t *path = cli_json(0, "path far.talus 4992,200,4992 5008,200,5004 --json");
    double length = cli_number(path, "length");
    TEST_CHECK(length > 19.99 && length < 20.01);
    json_decref(path);
    cli_result ray = cli_expect(0, "ray far.talus 5001.25,203,4999.5 0,-1,0");
    cli_check_part(ray.out, "3 ");
    cli_free(&ray);
}

static const char *const readers[] = { "info cut.talus", "ray cut.talus 0,9,0 0,-1,0", "path cut.talus 0,0,0 1,0,1",
                                       "support cut.talus 0,1,0", "hull cut.talus" };

static void check_refused(void)
{
    for (size_t i = 0; i < sizeof(readers) / sizeof(readers[0]); ++i) {
        cli_check_error(3, readers[i], "cut.talus", ";");
    }
    cli_result check = cli_expect(1, "check cut.talus");
    cli_check_part(check.out, "fault  file");
    cli_check_part(check.out, "is damaged");
    cli_free(&check);
}

static void test_damaged_files(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -n 500 -o level.obj");
    cli_do(0, "bake level.obj -o whole.talus --hull");
    size_t size;
    char *bytes = cli_read_file("whole.talus", &size);
    const size_t lengths[] = { 0, 1, 7, 8, 63, 64, 200, size / 2, size - 64, size - 1 };
    for (size_t i = 0; i < sizeof(lengths) / sizeof(lengths[0]); ++i) {
        cli_write_file("cut.talus", bytes, lengths[i]);
        check_refused();
    }
    test_random random = { 77 };
    for (size_t i = 0; i < 24; ++i) {
        size_t at = i < 8 ? i * 8 : (size_t)test_random_below(&random, (uint32_t)size);
        char bit = (char)(1 << test_random_below(&random, 8));
        bytes[at] = (char)(bytes[at] ^ bit);
        cli_write_file("cut.talus", bytes, size);
        check_refused();
        bytes[at] = (char)(bytes[at] ^ bit);
    }
    cli_write_text("cut.talus", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"); // a mesh under a wrong name
    check_refused();
    free(bytes);
}

static void test_unwritable(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_check_error(4, "bake floor.obj -o no/such/folder/out.talus", "no/such/folder", ";");
    assert_int_equal(mkdir("folder", 0777), 0);
    cli_check_error(4, "bake floor.obj -o folder", "folder", ";");
    cli_check_error(4, "sample city -o no/such/folder/city.obj", "no/such/folder", ";");
    cli_check_error(4, "hull level.obj -o no/such/folder/h.obj", "no/such/folder", ";");
    cli_check_error(4, "info folder", "folder", ";");
    if (cli_exists("/dev/full")) {
        cli_check_error(4, "bake floor.obj -o /dev/full", "/dev/full", "space");
        cli_check_error(4, "sample city -o /dev/full", "/dev/full", "space");
    }
    check_nothing_left();
    // An output that cannot be finished leaves the file that was there.
    cli_write_text("out.talus.keep", "precious");
    cli_write_text("bad.obj", "v 0 0 0\n");
    cli_do(3, "bake bad.obj -o out.talus.keep");
    size_t size;
    char *kept = cli_read_file("out.talus.keep", &size);
    assert_string_equal(kept, "precious");
    free(kept);
}

static void test_other_formats(void **state)
{
    (void)state;
    cli_write_text("noise.bin", "\x01\x02\xff\xfe noise that is no mesh");
    cli_check_error(3, "bake noise.bin -o out.talus", "noise.bin", ";");
    cli_write_text("bad.gltf", "{\"asset\":{\"version\":\"2.0\"}");
    cli_check_error(3, "bake bad.gltf -o out.talus", "bad.gltf", ";");
    cli_write_text("bad.stl", "solid x\nfacet normal 0 0 1\n");
    cli_check_error(3, "bake bad.stl -o out.talus", "bad.stl", ";");
    check_nothing_left();
}

// Ctrl-C in the middle of a bake, once it has said that it works.
static void test_cancelled(void **state)
{
    (void)state;
    cli_do(0, "sample city -n 400000 -o big.obj");
    static const char *const stages[] = { "read mesh", "weld", "rasterize" };
    for (size_t i = 0; i < 3; ++i) {
        unlink("progress");
        assert_int_equal(mkfifo("progress", 0600), 0);
        pid_t child = cli_start("bake big.obj -o out.talus --cell-size 0.1 --progress=json", "/dev/null", "stdout.txt",
                                "progress");
        FILE *progress = fopen("progress", "r");
        assert_non_null(progress);
        char line[512];
        bool sent = false;
        while (fgets(line, sizeof(line), progress) != NULL) {
            if (!sent && strstr(line, stages[i]) != NULL) {
                assert_int_equal(kill(child, SIGINT), 0);
                sent = true;
            }
        }
        fclose(progress);
        TEST_CHECK(sent);
        assert_int_equal(cli_wait(child), 130);
        check_nothing_left();
        size_t size;
        char *out = cli_read_file("stdout.txt", &size);
        assert_int_equal(size, 0);
        free(out);
    }
}

// Ctrl-C while a batch waits for its next line.
static void test_cancelled_batch(void **state)
{
    (void)state;
    cli_write_text("one.obj", "v 0 2 0\nv 4 2 0\nv 0 2 4\nf 1 2 3\n");
    assert_int_equal(mkfifo("questions", 0600), 0);
    assert_int_equal(mkfifo("answers", 0600), 0);
    pid_t child = cli_start("ray one.obj --rays -", "questions", "answers", "stderr.txt");
    FILE *questions = fopen("questions", "w");
    FILE *answers = fopen("answers", "r");
    char line[64];
    fputs("1 5 1 0 -1 0\n", questions);
    fflush(questions);
    assert_non_null(fgets(line, sizeof(line), answers)); // now it waits, or is about to
    struct timespec pause = { 0, 100 * 1000 * 1000 };
    nanosleep(&pause, NULL);
    assert_int_equal(kill(child, SIGINT), 0);
    assert_int_equal(cli_wait(child), 130);
    fclose(questions);
    fclose(answers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_levels),      cmocka_unit_test(test_odd_levels),
        cmocka_unit_test(test_huge_level),      cmocka_unit_test(test_far_from_the_origin),
        cmocka_unit_test(test_damaged_files),   cmocka_unit_test(test_unwritable),
        cmocka_unit_test(test_other_formats),   cmocka_unit_test(test_cancelled),
        cmocka_unit_test(test_cancelled_batch),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
