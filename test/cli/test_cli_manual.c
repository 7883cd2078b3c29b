// SPDX-License-Identifier: MIT
//
// Manual pages and completion know each command and each option that the help knows, and shells and groff take them.
#include "cli_run.h"

enum { MAX_NAMES = 128, NAME_BYTES = 48 };

typedef struct name_list {
    char names[MAX_NAMES][NAME_BYTES];
    uint32_t count;
} name_list;

// The words of small letters and dashes that follow `mark` at the beginning of a line, after blanks and letters ("-r,
// ").
static name_list names_after(const char *text, const char *mark, const char *line_begin)
{
    name_list list = { .count = 0 };
    for (const char *line = text; line != NULL; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, line_begin, strlen(line_begin)) != 0) {
            line += *line != '\n' && *line != '\0';
            continue;
        }
        const char *end = line + strcspn(line, "\n");
        const char *at = strstr(line, mark);
        if (at != NULL && at < end && at - line <= 8) {
            at += strlen(mark);
            const size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789-");
            assert_true(length > 0 && length < NAME_BYTES && list.count < MAX_NAMES);
            memcpy(list.names[list.count], at, length);
            list.names[list.count++][length] = '\0';
        }
    }
    return list;
}

static name_list list_commands(void)
{
    cli_result page = cli_expect(0, "help --man");
    name_list list = names_after(page.out, "talus\\-", ".BR ");
    cli_free(&page);
    return list;
}

// "cell-size" as groff writes it.
static void escape_dashes(const char *name, char *out)
{
    for (; *name != '\0'; ++name) {
        if (*name == '-') {
            *out++ = '\\';
        }
        *out++ = *name;
    }
    *out = '\0';
}

static bool shell_is_there(const char *shell)
{
    char line[64];
    snprintf(line, sizeof(line), "command -v %s >/dev/null 2>&1", shell);
    return system(line) == 0;
}

// A line of a shell; `false` when it says no.
static bool runs(const char *line)
{
    fflush(NULL);
    return system(line) == 0;
}

static void test_every_option_is_there(void **state)
{
    (void)state;
    const name_list commands = list_commands();
    cli_result bash = cli_expect(0, "help --completion bash");
    cli_result zsh = cli_expect(0, "help --completion zsh");
    cli_result fish = cli_expect(0, "help --completion fish");
    uint32_t options = 0;
    for (uint32_t c = 0; c < commands.count; ++c) {
        const char *command = commands.names[c];
        char line[NAME_BYTES + 32], word[2 * NAME_BYTES], part[4 * NAME_BYTES];
        snprintf(line, sizeof(line), "%s --help", command);
        cli_result help = cli_expect(0, line);
        snprintf(line, sizeof(line), "help --man %s", command);
        cli_result page = cli_expect(0, line);
        const name_list names = names_after(help.out, "--", "  ");
        TEST_CHECK(names.count >= 5);
        snprintf(part, sizeof(part), "\n    %s) options='", command);
        const char *in_bash = strstr(bash.out, part);
        snprintf(part, sizeof(part), "\n    %s)\n", command);
        const char *in_zsh = strstr(zsh.out, part);
        assert_non_null(in_bash);
        assert_non_null(in_zsh);
        for (uint32_t i = 0; i < names.count; ++i) {
            escape_dashes(names.names[i], word);
            snprintf(part, sizeof(part), "\\fB\\-\\-%s\\fR", word);
            cli_check_part(page.out, part);
            snprintf(part, sizeof(part), "--%s", names.names[i]);
            const char *found = strstr(in_bash, part);
            TEST_CHECK(found != NULL && found < strstr(in_bash, ";;"));
            found = strstr(in_zsh, part);
            TEST_CHECK(found != NULL && found < strstr(in_zsh, ";;"));
            snprintf(part, sizeof(part), "'__fish_seen_subcommand_from %s' -l %s ", command, names.names[i]);
            cli_check_part(fish.out, part);
            options++;
        }
        cli_free(&help);
        cli_free(&page);
    }
    TEST_CHECK(commands.count == 24 && options > 300);
    cli_free(&bash);
    cli_free(&zsh);
    cli_free(&fish);
}

// What bash offers for a line that ends in the word to complete.
static void check_offer(const char *words, uint32_t at, const char *offered)
{
    char line[512];
    snprintf(line, sizeof(line),
             "bash -c '. ./talus.bash; COMP_WORDS=(%s); COMP_CWORD=%u; _talus; "
             "printf \"%%s \" \"${COMPREPLY[@]}\"' >offered.txt",
             words, at);
    assert_true(runs(line));
    char *text = cli_read_file("offered.txt", NULL);
    if (strcmp(text, offered) != 0) {
        print_error("%s: bash offers '%s', not '%s'\n", words, text, offered);
        fail();
    }
    free(text);
}

static void test_shells_take_them(void **state)
{
    (void)state;
    static const char *const shells[] = { "bash", "zsh", "fish" };
    for (uint32_t i = 0; i < 3; ++i) {
        char line[128];
        snprintf(line, sizeof(line), "help --completion %s", shells[i]);
        cli_result script = cli_expect(0, line);
        snprintf(line, sizeof(line), "talus.%s", shells[i]);
        cli_write_text(line, script.out);
        cli_free(&script);
        snprintf(line, sizeof(line), "%s -n talus.%s", shells[i], shells[i]);
        assert_true(!shell_is_there(shells[i]) || runs(line));
    }
    if (shell_is_there("bash")) {
        cli_write_text("level.obj", "");
        check_offer("talus pol", 1, "polygonize ");
        check_offer("talus help wh", 2, "why ");
        check_offer("talus ray --cul", 2, "--cull ");
        check_offer("talus ray --cull b", 3, "back ");
        check_offer("talus ray le", 2, "level.obj ");
        check_offer("talus bake --cell-size l", 3, " ");
    }
    cli_result page = cli_expect(0, "help --man path");
    cli_write_text("talus-path.1", page.out);
    cli_free(&page);
    assert_true(!shell_is_there("groff") ||
                runs("groff -man -Tutf8 -ww -z talus-path.1 2>groff.err && ! test -s groff.err"));
    assert_true(!shell_is_there("mandoc") || runs("mandoc -Tlint -Werror talus-path.1 >mandoc.out"));
}

static void test_wrong_words_are_refused(void **state)
{
    (void)state;
    cli_check_error(2, "help --completion tcsh", "wants a shell", "bash, zsh or fish");
    cli_check_error(2, "help --completion", "wants a shell", "bash, zsh or fish");
    cli_check_error(2, "help --man rya", "is no command", "ray");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_option_is_there),
        cmocka_unit_test(test_shells_take_them),
        cmocka_unit_test(test_wrong_words_are_refused),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
