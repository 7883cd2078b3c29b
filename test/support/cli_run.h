// SPDX-License-Identifier: MIT
//
// Runs the built command in a folder of its own, and keeps what it printed.

#ifndef TALUS_TEST_CLI_RUN_H
#define TALUS_TEST_CLI_RUN_H

#define _POSIX_C_SOURCE 200809L

#include "talus_test.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { CLI_MAX_ARGUMENTS = 40 };

/// How a run ended. Free with cli_free.
typedef struct cli_result {
    int code; ///< exit code, or 256 + the signal that killed it
    char *out;
    size_t out_size;
    char *err;
} cli_result;

static inline char *cli_read_file(const char *path, size_t *size_out)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)size, file), (size_t)size);
    text[size] = '\0';
    fclose(file);
    if (size_out != NULL) {
        *size_out = (size_t)size;
    }
    return text;
}

static inline void cli_write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void cli_write_text(const char *path, const char *text)
{
    cli_write_file(path, text, strlen(text));
}

/// Fails unless the two files hold the same bytes, and some.
static inline void cli_check_same_files(const char *a, const char *b)
{
    size_t a_size, b_size;
    char *a_bytes = cli_read_file(a, &a_size);
    char *b_bytes = cli_read_file(b, &b_size);
    assert_true(a_size > 0);
    assert_int_equal(a_size, b_size);
    assert_memory_equal(a_bytes, b_bytes, a_size);
    free(a_bytes);
    free(b_bytes);
}

static inline bool cli_exists(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

/// Starts the command; `in`, `out` and `err` are paths. The words of `line` are parted by blanks.
static inline pid_t cli_start(const char *line, const char *in, const char *out, const char *err)
{
    char copy[4096];
    char *words[CLI_MAX_ARGUMENTS + 2];
    int count = 0;
    assert_true(strlen(line) < sizeof(copy));
    strcpy(copy, line);
    char name[] = "talus";
    words[count++] = name;
    char *rest = NULL;
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        assert_true(count <= CLI_MAX_ARGUMENTS);
        words[count++] = word;
    }
    words[count] = NULL;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        signal(SIGINT, SIG_DFL);
        if (freopen(in, "rb", stdin) == NULL || freopen(out, "wb", stdout) == NULL ||
            freopen(err, "wb", stderr) == NULL) {
            _exit(126);
        }
        execv(TALUS_COMMAND, words);
        _exit(127);
    }
    return child;
}

static inline int cli_wait(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        assert_int_equal(errno, EINTR);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
}

/// Runs the command to its end with `input` (NULL: nothing) on standard input.
static inline cli_result cli_run_with(const char *input, const char *line)
{
    cli_result result;
    if (input != NULL) {
        cli_write_text("stdin.txt", input);
    }
    result.code = cli_wait(cli_start(line, input != NULL ? "stdin.txt" : "/dev/null", "stdout.txt", "stderr.txt"));
    result.out = cli_read_file("stdout.txt", &result.out_size);
    result.err = cli_read_file("stderr.txt", NULL);
    return result;
}

static inline void cli_free(cli_result *result)
{
    free(result->out);
    free(result->err);
}

/// Runs, checks the exit code (printing what the command said when it is another), and gives the result.
static inline cli_result cli_expect_with(int code, const char *input, const char *line)
{
    cli_result result = cli_run_with(input, line);
    if (result.code != code) {
        print_error("talus %s\nexit code %d, expected %d\nout: %.2000s\nerr: %.2000s\n", line, result.code, code,
                    result.out, result.err);
        fail();
    }
    return result;
}

static inline cli_result cli_expect(int code, const char *line)
{
    return cli_expect_with(code, NULL, line);
}

/// Runs to the given exit code; nothing of the output is looked at.
static inline void cli_do(int code, const char *line)
{
    cli_result result = cli_expect(code, line);
    cli_free(&result);
}

/// Fails unless `text` holds `part`.
static inline void cli_check_part(const char *text, const char *part)
{
    assert_non_null(text);
    if (strstr(text, part) == NULL) {
        print_error("'%s' is not in: %.3000s\n", part, text);
        fail();
    }
}

/// Runs to the given exit code; standard error must hold both parts.
static inline void cli_check_error(int code, const char *line, const char *part, const char *other_part)
{
    cli_result result = cli_expect(code, line);
    cli_check_part(result.err, "talus");
    cli_check_part(result.err, part);
    cli_check_part(result.err, other_part);
    cli_free(&result);
}

/// Runs with --json (to be in `line`) and gives the parsed object; the caller drops it with json_decref.
static inline json_t *cli_json(int code, const char *line)
{
    cli_result result = cli_expect(code, line);
    json_error_t error;
    json_t *value = json_loads(result.out, 0, &error);
    if (value == NULL) {
        print_error("talus %s\nno JSON: %s, line %d\n%.2000s\n", line, error.text, error.line, result.out);
        fail();
    }
    cli_free(&result);
    return value;
}

/// A number by a path of keys with dots between, such as "soup.triangles".
static inline double cli_number(const json_t *value, const char *path)
{
    char copy[128];
    strcpy(copy, path);
    char *rest = NULL;
    for (char *key = strtok_r(copy, ".", &rest); key != NULL; key = strtok_r(NULL, ".", &rest)) {
        value = json_object_get(value, key);
    }
    if (!json_is_number(value)) {
        fail_msg("no number at %s", path);
    }
    return json_number_value(value);
}

/// A folder of its own for the test program, made in the current one and entered; and removed at the end.
static char cli_folder[32];

static inline int cli_enter_folder(void **state)
{
    (void)state;
    strcpy(cli_folder, "cli_XXXXXX");
    if (mkdtemp(cli_folder) == NULL || chdir(cli_folder) != 0) {
        return -1;
    }
    return 0;
}

static inline int cli_leave_folder(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof(command), "rm -rf '%s'", cli_folder);
    return chdir("..") == 0 && system(command) == 0 ? 0 : -1;
}

/// Turns a bit of a file, in its middle or 30 bytes before its end.
static inline void cli_damage(const char *path, bool at_end)
{
    size_t size;
    char *bytes = cli_read_file(path, &size);
    assert_true(size > 100);
    bytes[at_end ? size - 30 : size / 2] ^= 4;
    cli_write_file(path, bytes, size);
    free(bytes);
}

/// A square floor of `size` m at height 0 with its centre in the origin, and a wall across it at x = 0 when asked.
static inline void cli_write_floor(const char *path, float size, bool wall)
{
    char text[1024];
    double h = 0.5 * (double)size;
    int used = snprintf(text, sizeof(text), "v %g 0 %g\nv %g 0 %g\nv %g 0 %g\nv %g 0 %g\nf 1 2 3 4\n", -h, -h, -h, h, h,
                        h, h, -h);
    if (wall) {
        snprintf(text + used, sizeof(text) - (size_t)used, "v 0 0 %g\nv 0 0 %g\nv 0 5 %g\nv 0 5 %g\nf 5 6 7 8\n", -h, h,
                 h, -h);
    }
    cli_write_text(path, text);
}

#endif
