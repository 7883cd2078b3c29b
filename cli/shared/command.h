// SPDX-License-Identifier: MIT
//
// What every subcommand shares: its entry in the table, the common options, the host it lends to builds, the form of
// its errors, and the exit codes.
//
// A command is one file that defines `const tl_command tl_NAME_command`, and one line in command_table.c.

#ifndef TALUS_CLI_COMMAND_H
#define TALUS_CLI_COMMAND_H

#include "cli/options/options.h"
#include "cli/shared/progress.h"
#include "cli/shared/thread_pool.h"
#include "io/files/io_error.h"

#include <talus/base.h>
#include <talus/pack.h>

/// How the program ends. Documented in docs/guide/command.md.
typedef enum tl_exit {
    TL_EXIT_OK = 0,
    TL_EXIT_NEGATIVE = 1,   ///< the answer is no: check found faults; a single ray misses; a single path does not exist
    TL_EXIT_USAGE = 2,      ///< the command line is wrong
    TL_EXIT_DATA = 3,       ///< the input's content is wrong
    TL_EXIT_IO = 4,         ///< a file cannot be found, read or written
    TL_EXIT_MEMORY = 5,     ///< out of memory
    TL_EXIT_EMPTY = 6,      ///< nothing is walkable; the likely cause is told
    TL_EXIT_CANCELLED = 130 ///< Ctrl-C; nothing was written
} tl_exit;

typedef struct tl_cli tl_cli;

typedef struct tl_command {
    const char *name;
    const char *topic;   ///< its heading in `talus --help`; commands of a topic stand together
    const char *summary; ///< one line of `talus --help`
    const char *usage;   ///< words after the command's name; alternatives on lines of their own
    const char *text;    ///< what it does, formats included; ends without line end
    /// Lines for a shell, one each: typed in order in an empty folder they run as they are. "# exits with 1" stands
    /// behind a line whose answer is no. test_cli_examples runs them all.
    const char *examples;
    tl_exit (*run)(tl_cli *cli);
} tl_command;

enum { TL_MAX_OPTION_GROUPS = 8 };

/// What each exit code means, for help and manual.
extern const char tl_exit_codes_text[];

/// Is told a command's options, the common ones last. The targets hold the defaults.
typedef void tl_describe_fn(const tl_command *command, const tl_option_group *groups, void *user);

/// All commands, `count_out` of them.
const tl_command *const *tl_command_table(uint32_t *count_out);

/// What a running command has at hand.
struct tl_cli {
    const tl_command *command;
    int argc; ///< from the command's name on
    const char *const *argv;
    bool json;              ///< --json
    tl_arguments arguments; ///< the words that are no options
    tl_progress_display progress;
    uint32_t threads; ///< --threads
    tl_thread_pool *pool;
    tl_host host;               ///< for builds: tasks and progress
    const tl_pack_frame *frame; ///< the level's own coordinates, in which points are read and printed; NULL: as baked
    tl_pack_frame frame_room;   ///< what `frame` points to
    bool speaks_frame;          ///< the command does so; else opening a level with a frame is told of
    tl_describe_fn *describe;   ///< not NULL: the options are wanted, and nothing is to be done
    void *describe_user;
};

/// Runs a command from its name on: argv[0] is the name. Sets up, runs, cleans up, and makes sure that standard output
/// was taken.
tl_exit tl_command_run(const tl_command *command, int argc, const char *const *argv);

/// Tells `describe` the command's options, and does nothing else.
void tl_command_describe(const tl_command *command, tl_describe_fn *describe, void *user);

/// Parses the command line with the command's own groups (NULL-ended, may be NULL) and the common options, and sets up
/// host and progress. False: `*exit_out` says how to end (help was printed, or an error). Between
/// `min_words` and `max_words` must be there.
bool tl_cli_parse(tl_cli *cli, const tl_option_group *groups, uint32_t min_words, uint32_t max_words,
                  tl_exit *exit_out);

/// Ends the progress line, prints "talus NAME: message" to standard error, after a usage error where the help is, and
/// returns `code`.
tl_exit tl_cli_fail(tl_cli *cli, tl_exit code, const char *format, ...) TL_IO_PRINTF(3, 4);
/// The same for a message that is not the end.
void tl_cli_warn(tl_cli *cli, const char *format, ...) TL_IO_PRINTF(2, 3);
/// The same of an error of io that ends nothing, behind some words ("" or "rank 3: ").
void tl_cli_warn_io(tl_cli *cli, const char *before, const tl_io_error *error);

/// A failure of io: "file:line: message; advice".
tl_exit tl_cli_fail_io(tl_cli *cli, const tl_io_error *error);
/// A failure of a build or check: "path: element index: text; advice". `path` may be NULL; `report` too.
tl_exit tl_cli_fail_result(tl_cli *cli, const char *path, tl_result result, const tl_report *report);
tl_exit tl_exit_of(tl_result result);

/// Reads word number `word` as X,Y,Z. False: reported; `what` names it ("point", "goal").
bool tl_cli_read_triple(tl_cli *cli, uint32_t word, const char *what, float numbers_out[3], tl_exit *exit_out);

#endif
