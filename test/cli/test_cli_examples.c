// SPDX-License-Identifier: MIT
//
// Every example of every --help runs as it is typed: in order, in an empty folder, by a shell that knows the command.
#include "cli_run.h"

enum { MAX_COMMANDS = 64, NAME_BYTES = 32 };

// The command's names, out of its own help: words of small letters at the beginning of lines under a topic.
static uint32_t list_commands(char names[MAX_COMMANDS][NAME_BYTES])
{
    cli_result help = cli_expect(0, "--help");
    uint32_t count = 0;
    char *rest = NULL;
    for (char *line = strtok_r(help.out, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        const size_t length = strspn(line + (line[0] != '\0'), " ") == 1 ? strcspn(line + 2, " ") : 0;
        if (line[0] == ' ' && length > 0 && length < NAME_BYTES && strncmp(line + 2, "talus ", 6) != 0) {
            assert_true(count < MAX_COMMANDS);
            memcpy(names[count], line + 2, length);
            names[count++][length] = '\0';
        }
    }
    cli_free(&help);
    return count;
}

// Runs a line by the shell and compares its exit code with what the line itself says.
static void run_example(const char *line)
{
    const int expected = strstr(line, "# exits with 1") != NULL ? 1 : 0;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (freopen("/dev/null", "rb", stdin) == NULL || freopen("../example.out", "wb", stdout) == NULL ||
            freopen("../example.err", "wb", stderr) == NULL) {
            _exit(126);
        }
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(127);
    }
    const int code = cli_wait(child);
    if (code != expected) {
        char *err = cli_read_file("../example.err", NULL);
        print_error("%s\nexit code %d, expected %d\n%.2000s\n", line, code, expected, err);
        free(err);
        fail();
    }
}

static uint32_t run_examples_of(const char *name)
{
    char line[64];
    snprintf(line, sizeof(line), "%.31s --help", name);
    cli_result help = cli_expect(0, line);
    char *examples = strstr(help.out, "\nExamples:\n");
    assert_non_null(examples);
    examples += strlen("\nExamples:\n");
    char *end = strstr(examples, "\n\n");
    assert_non_null(end);
    *end = '\0';
    assert_int_equal(mkdir(name, 0700), 0);
    assert_int_equal(chdir(name), 0);
    uint32_t count = 0, own = 0;
    char part[64];
    snprintf(part, sizeof(part), "talus %.31s ", name);
    char *rest = NULL;
    for (char *example = strtok_r(examples, "\n", &rest); example != NULL; example = strtok_r(NULL, "\n", &rest)) {
        run_example(example + 2);
        own += strstr(example, part) != NULL;
        count++;
    }
    TEST_CHECK(own >= 2); // the command itself, not only what prepares its input
    assert_int_equal(chdir(".."), 0);
    cli_free(&help);
    return count;
}

static void test_examples_run(void **state)
{
    (void)state;
    // The built command may have another name than talus, and its folder other programs: the shell sees a link.
    char path[4096], folder[2048];
    assert_non_null(getcwd(folder, sizeof(folder)));
    assert_int_equal(mkdir("bin", 0700), 0);
    assert_int_equal(symlink(TALUS_COMMAND, "bin/talus"), 0);
    const char *old = getenv("PATH");
    snprintf(path, sizeof(path), "%s/bin:%s", folder, old != NULL ? old : "/usr/bin:/bin");
    assert_int_equal(setenv("PATH", path, 1), 0);
    // talus view needs the viewer's page, which is built by npm; any page with the mark does.
    cli_write_text("viewer.html", "<html><!--talus-level--></html>");
    snprintf(path, sizeof(path), "%s/viewer.html", folder);
    assert_int_equal(setenv("TALUS_VIEWER", path, 1), 0);
    char names[MAX_COMMANDS][NAME_BYTES];
    const uint32_t commands = list_commands(names);
    uint32_t examples = 0;
    for (uint32_t i = 0; i < commands; ++i) {
        examples += run_examples_of(names[i]);
    }
    TEST_CHECK(commands == 24 && examples >= 3 * commands);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_examples_run) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
