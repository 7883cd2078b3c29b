// SPDX-License-Identifier: MIT
//
// Standard input as FILE, Ctrl-C while there is nothing to clean up, and the form of help and numbers.
#include "cli_run.h"

// Runs a line of the shell in which $T is the command.
static int shell(const char *line)
{
    char command[1024];
    snprintf(command, sizeof(command), "T='%s'; %s", TALUS_COMMAND, line);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 256;
}

static void test_baked_and_level_by_pipe(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, true);
    cli_do(0, "bake level.obj -o level.talus");
    assert_int_equal(shell("$T ray level.talus -3,1,0 1,0,0 > expected.txt"), 0);
    assert_int_equal(shell("$T bake level.obj -o - | $T ray - -3,1,0 1,0,0 > got.txt"), 0);
    cli_check_same_files("expected.txt", "got.txt");
    assert_int_equal(shell("cat level.obj | $T ray - -3,1,0 1,0,0 > got.txt"), 0);
    cli_check_same_files("expected.txt", "got.txt");
    assert_int_equal(shell("$T ray - -3,1,0 1,0,0 < level.talus > got.txt"), 0);
    cli_check_same_files("expected.txt", "got.txt");
    assert_int_equal(shell("cat level.talus | $T path - -3,0,-1 -3,0,2"), 0);
    assert_int_equal(shell("cat level.talus | $T check -"), 0);
    assert_int_equal(shell("cat level.talus | $T info - > got.txt"), 0);
    assert_int_equal(shell("cat level.talus | $T draw - -o p.png --size 200"), 0);
    assert_int_equal(shell("cat level.talus | $T path - -3,0,-1 -3,0,2 --agent-radius 1 2> err.txt"), 2);
    char *text = cli_read_file("err.txt", NULL);
    cli_check_part(text, "is baked already");
    free(text);
    cli_check_error(2, "path - --pairs -", "2 inputs are '-'", "name files");
    cli_check_error(2, "bake - -o x.talus --areas -", "2 inputs are '-'", "name files");
}

static void sleep_ms(long ms)
{
    const struct timespec time = { ms / 1000, ms % 1000 * 1000000 };
    nanosleep(&time, NULL);
}

// One signal, sent while the command waits for `in`, a pipe that nobody writes to.
static void check_first_signal_ends(const char *line, const char *in)
{
    const int keep_open = in != NULL ? open(in, O_RDWR) : -1;
    TEST_CHECK(in == NULL || keep_open >= 0);
    const pid_t child = cli_start(line, in != NULL ? in : "/dev/null", "stdout.txt", "stderr.txt");
    sleep_ms(200);
    kill(child, SIGINT);
    int status = 0;
    pid_t ended = 0;
    for (int i = 0; i < 100 && ended == 0; ++i) {
        sleep_ms(30);
        ended = waitpid(child, &status, WNOHANG);
    }
    if (ended == 0) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        fail_msg("one Ctrl-C did not end: %s", line);
    }
    assert_int_equal(WIFEXITED(status) ? WEXITSTATUS(status) : 256, 130);
    char *err = cli_read_file("stderr.txt", NULL);
    cli_check_part(err, "cancelled");
    free(err);
    if (keep_open >= 0) {
        close(keep_open);
    }
}

static void test_first_signal_ends(void **state)
{
    (void)state;
    assert_int_equal(mkfifo("pipe", 0600), 0);
    check_first_signal_ends("bake - -o out.talus", "pipe");
    check_first_signal_ends("path - 0,0,0 1,0,1", "pipe");
    check_first_signal_ends("hull -", "pipe");
    check_first_signal_ends("polygonize - -o out.txt", "pipe");
    check_first_signal_ends("sample terrain --triangles 4000000 -o large.obj", NULL);
    TEST_CHECK(!cli_exists("out.talus") && !cli_exists("out.txt") && !cli_exists("large.obj"));
}

static void test_help_fits_a_terminal(void **state)
{
    (void)state;
    static const char *const commands[] = { "sample",  "bake",     "info",       "check",  "draw",
                                            "ray",     "nearest",  "overlap",    "sweep",  "path",
                                            "around",  "links",    "why",        "audit",  "hull",
                                            "support", "distance", "polygonize", "export", "import" };
    for (size_t i = 0; i < sizeof(commands) / sizeof(commands[0]); ++i) {
        char line[64];
        snprintf(line, sizeof(line), "%s --help", commands[i]);
        cli_result help = cli_expect(0, line);
        TEST_CHECK(strstr(help.out, "4294967295") == NULL && strstr(help.out, "99999") == NULL);
        // Examples are typed as they are.
        const char *examples = strstr(help.out, "\nExamples:\n");
        assert_non_null(examples);
        const char *head = help.out;
        while (head < examples) {
            const size_t length = strcspn(head, "\n");
            if (length > 80) {
                fail_msg("%s: %zu columns: %.*s", commands[i], length, (int)length, head);
            }
            head += length + 1;
        }
        cli_free(&help);
    }
    cli_check_error(2, "bake a -o b --cell-size 0", "use 1e-06 to 1000000", "--cell-size");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_baked_and_level_by_pipe),
        cmocka_unit_test(test_first_signal_ends),
        cmocka_unit_test(test_help_fits_a_terminal),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
