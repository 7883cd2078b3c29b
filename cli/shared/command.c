// SPDX-License-Identifier: MIT
//
// One frame round all commands, so that they parse, fail, report and end in the same way.

#include "cli/shared/command.h"

#include "cli/options/output_check.h"
#include "cli/options/parse_value.h"
#include "cli/shared/interrupt.h"
#include "cli/shared/standard_input.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_THREADS = 1024 };

static void print_usage_lines(const tl_command *command)
{
    const char *line = command->usage;
    for (const char *head = "Usage:"; line != NULL; head = "      ") {
        const char *end = strchr(line, '\n');
        int length = end != NULL ? (int)(end - line) : (int)strlen(line);
        char text[512];
        const int indent = printf("%s talus %s ", head, command->name);
        snprintf(text, sizeof(text), "%.*s", length, line);
        tl_options_print_wrapped(text, indent, indent);
        line = end != NULL ? end + 1 : NULL;
    }
}

const char tl_exit_codes_text[] =
    "Exit codes: 0 done; 1 the answer is no; 2 wrong usage; 3 bad input; 4 file cannot be read or "
    "written; 5 out of memory; 6 nothing is walkable; 130 cancelled.";

static void print_help(const tl_command *command, const tl_option_group *groups)
{
    print_usage_lines(command);
    putchar('\n');
    tl_options_print_text(command->text);
    tl_options_print(groups);
    printf("\nExamples:\n");
    for (const char *line = command->examples; line != NULL && *line != '\0';) {
        const char *end = strchr(line, '\n');
        int length = end != NULL ? (int)(end - line) : (int)strlen(line);
        printf("  %.*s\n", length, line);
        line = end != NULL ? end + 1 : NULL;
    }
    putchar('\n');
    tl_options_print_text(tl_exit_codes_text);
}

static bool set_up_host(tl_cli *cli, int progress_style, tl_exit *exit_out)
{
    cli->pool = tl_thread_pool_create(cli->threads);
    if (cli->pool == NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    tl_progress_begin(&cli->progress, (tl_progress_style)progress_style, cli->command->name);
    cli->host.tasks = tl_thread_pool_tasks(cli->pool);
    cli->host.progress = &cli->progress.hook;
    tl_interrupt_catch();
    return true;
}

// Where a word says that FILE is standard input.
static bool hold_standard_input(tl_cli *cli, tl_exit *exit_out)
{
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < cli->arguments.count && result == TL_OK; ++i) {
        const char *word = cli->arguments.words[i];
        if (strcmp(word, "-") == 0 || strcmp(word, "/dev/stdin") == 0) {
            result = tl_standard_input_hold(&error);
        }
    }
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
    }
    return result == TL_OK;
}

// All processors; the processes that an mpirun starts on one machine share them.
static uint32_t default_threads(void)
{
    const char *text = getenv("OMPI_COMM_WORLD_LOCAL_SIZE"); // Open MPI, and MPICH
    text = text != NULL ? text : getenv("MPI_LOCALNRANKS");
    const unsigned long processes = text != NULL ? strtoul(text, NULL, 10) : 1;
    const uint32_t all = tl_online_processors();
    return processes <= 1 ? all : processes >= all ? 1 : all / (uint32_t)processes;
}

bool tl_cli_parse(tl_cli *cli, const tl_option_group *groups, uint32_t min_words, uint32_t max_words, tl_exit *exit_out)
{
    static const char *const styles[] = { "auto", "none", "line", "json", NULL };
    int style = TL_PROGRESS_AUTO;
    bool help = false;
    cli->threads = default_threads();
    const tl_option common[] = {
        { "json", 0, TL_OPTION_FLAG, &cli->json, NULL, "print JSON; answers to lines of a file one object a line", NULL,
          0, 0, 0, 0 },
        { "threads", 'j', TL_OPTION_COUNT, &cli->threads, "N", "threads; results do not depend on them", NULL, 0, 0, 1,
          MAX_THREADS },
        { "progress", 0, TL_OPTION_CHOICE, &style, NULL, "how to show progress; auto is a line on a terminal", styles,
          0, 0, 0, 0 },
        { "help", 'h', TL_OPTION_FLAG, &help, NULL, "print this help", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_option_group all[TL_MAX_OPTION_GROUPS + 2];
    uint32_t count = 0;
    for (; groups != NULL && groups[count].title != NULL && count < TL_MAX_OPTION_GROUPS; ++count) {
        all[count] = groups[count];
    }
    tl_option_group shared = { "Common options:", common };
    tl_option_group end = { NULL, NULL };
    all[count] = shared;
    all[count + 1] = end;

    if (cli->describe != NULL) {
        cli->describe(cli->command, all, cli->describe_user);
        *exit_out = TL_EXIT_OK;
        return false;
    }
    // The help shows defaults, so it must be asked for before anything is set.
    for (int i = 1; i < cli->argc && strcmp(cli->argv[i], "--") != 0; ++i) {
        if (strcmp(cli->argv[i], "--help") == 0 || strcmp(cli->argv[i], "-h") == 0) {
            print_help(cli->command, all);
            *exit_out = TL_EXIT_OK;
            return false;
        }
    }
    if (tl_options_parse(all, cli->argc, cli->argv, &cli->arguments) != TL_PARSE_OK) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s", cli->arguments.message);
        return false;
    }
    if (!tl_outputs_check(all, &cli->arguments)) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s", cli->arguments.message);
        return false;
    }
    if (cli->arguments.count < min_words || cli->arguments.count > max_words) {
        char message[256];
        if (cli->arguments.count > max_words) {
            snprintf(message, sizeof(message), "unexpected word '%.80s'", cli->arguments.words[max_words]);
        } else {
            snprintf(message, sizeof(message), "something is missing: talus %s %.*s", cli->command->name,
                     (int)strcspn(cli->command->usage, "\n"), cli->command->usage);
        }
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s", message);
        return false;
    }
    return set_up_host(cli, style, exit_out) && hold_standard_input(cli, exit_out);
}

static void print_message(tl_cli *cli, const char *format, va_list list)
{
    tl_progress_end(&cli->progress);
    fflush(stdout); // so that answers come before the error that ended them
    fprintf(stderr, "talus %s: ", cli->command->name);
    vfprintf(stderr, format, list);
    fputc('\n', stderr);
}

tl_exit tl_cli_fail(tl_cli *cli, tl_exit code, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(cli, format, list);
    va_end(list);
    if (code == TL_EXIT_USAGE) {
        fprintf(stderr, "Try 'talus %s --help'.\n", cli->command->name);
    }
    return code;
}

void tl_cli_warn(tl_cli *cli, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(cli, format, list);
    va_end(list);
}

void tl_cli_warn_io(tl_cli *cli, const char *before, const tl_io_error *error)
{
    char text[TL_IO_PATH_BYTES + TL_IO_MESSAGE_BYTES + TL_IO_ADVICE_BYTES + 8];
    tl_io_error_format(error, text, sizeof text);
    tl_cli_warn(cli, "%s%s", before, text);
}

tl_exit tl_exit_of(tl_result result)
{
    switch (result) {
    case TL_OK:
        return TL_EXIT_OK;
    case TL_ERR_MEMORY:
        return TL_EXIT_MEMORY;
    case TL_ERR_CANCELLED:
        return TL_EXIT_CANCELLED;
    case TL_ERR_IO:
        return TL_EXIT_IO;
    case TL_ERR_ARGUMENT:
        return TL_EXIT_USAGE;
    default:
        return TL_EXIT_DATA;
    }
}

tl_exit tl_cli_fail_io(tl_cli *cli, const tl_io_error *error)
{
    char line[32] = "";
    if (error->line > 0) {
        snprintf(line, sizeof(line), ":%llu", (unsigned long long)error->line);
    }
    if (error->result == TL_ERR_CANCELLED) {
        return tl_cli_fail(cli, TL_EXIT_CANCELLED, "cancelled");
    }
    bool message = error->message[0] != '\0';
    return tl_cli_fail(cli, tl_exit_of(error->result), "%s%s%s%s%s%s", error->path, line,
                       error->path[0] != '\0' ? ": " : "", message ? error->message : tl_result_text(error->result),
                       error->advice[0] != '\0' ? "; " : "", error->advice);
}

// A def's field is set by the option of the same name: cell_size by --cell-size.
static void name_option(const char *field, char *text, size_t capacity)
{
    snprintf(text, capacity, "--%s: ", field);
    for (char *c = text; *c != '\0'; ++c) {
        *c = *c == '_' ? '-' : *c;
    }
}

tl_exit tl_cli_fail_result(tl_cli *cli, const char *path, tl_result result, const tl_report *report)
{
    if (result == TL_ERR_CANCELLED) {
        return tl_cli_fail(cli, TL_EXIT_CANCELLED, "cancelled");
    }
    char place[128] = "";
    const char *advice = report != NULL ? report->advice : NULL;
    if (report != NULL && report->field != NULL) {
        name_option(report->field, place, sizeof(place));
    } else if (report != NULL && report->element != NULL && result == TL_ERR_ARGUMENT) {
        name_option(report->element, place, sizeof(place));
    } else if (report != NULL && report->element != NULL && report->element_index != TL_NO_ELEMENT) {
        snprintf(place, sizeof(place), "%s %llu: ", report->element, (unsigned long long)report->element_index);
    } else if (report != NULL && report->element != NULL) {
        snprintf(place, sizeof(place), "%s: ", report->element);
    }
    return tl_cli_fail(cli, tl_exit_of(result), "%s%s%s%s%s%s", path != NULL ? path : "", path != NULL ? ": " : "",
                       place, tl_result_text(result), advice != NULL ? "; " : "", advice != NULL ? advice : "");
}

// Buffered output may fail only now; a full disk must not look like success.
static tl_exit check_output(tl_cli *cli, tl_exit code)
{
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return tl_cli_fail(cli, TL_EXIT_IO, "cannot write standard output: %s; free space or send it elsewhere",
                           errno != 0 ? strerror(errno) : "write error");
    }
    return code;
}

tl_exit tl_command_run(const tl_command *command, int argc, const char *const *argv)
{
    tl_cli cli;
    memset(&cli, 0, sizeof(cli));
    cli.command = command;
    cli.argc = argc;
    cli.argv = argv;
    tl_exit code = command->run(&cli);
    tl_progress_end(&cli.progress);
    if (code != TL_EXIT_IO) {
        code = check_output(&cli, code);
    }
    tl_thread_pool_free(cli.pool);
    tl_arguments_free(&cli.arguments);
    return code;
}

void tl_command_describe(const tl_command *command, tl_describe_fn *describe, void *user)
{
    tl_cli cli;
    memset(&cli, 0, sizeof(cli));
    cli.command = command;
    cli.describe = describe;
    cli.describe_user = user;
    (void)command->run(&cli);
}

bool tl_cli_read_triple(tl_cli *cli, uint32_t word, const char *what, float numbers_out[3], tl_exit *exit_out)
{
    const char *text = cli->arguments.words[word];
    const char *reason = tl_parse_float_list(text, numbers_out, 3, 3, NULL);
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s '%s' %s; write it as X,Y,Z", what, text, reason);
    }
    return reason == NULL;
}
