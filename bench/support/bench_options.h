// SPDX-License-Identifier: MIT
//
// The options of a benchmark, as a table: --name VALUE. All have --json FILE, where the report goes, and --help.

#ifndef TALUS_BENCH_OPTIONS_H
#define TALUS_BENCH_OPTIONS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum bench_option_kind {
    BENCH_COUNT,  ///< uint32_t
    BENCH_NUMBER, ///< float
    BENCH_TEXT    ///< const char *
} bench_option_kind;

/// One option. The target's value before parsing is the default that --help shows.
typedef struct bench_option {
    const char *name; ///< without the dashes before it; NULL ends the table
    bench_option_kind kind;
    void *target;
    const char *help;
} bench_option;

/// Parses the command line. Words that are no options are moved to words_out[0..], which has room for argc of them, and
/// counted; with NULL they are refused. `*json_out` is the report's path, or NULL. A wrong option or value ends the
/// program with a message and exit code 2, --help with 0.
int bench_parse(int argc, char **argv, const bench_option *options, const char **words_out, const char **json_out);

#ifdef __cplusplus
}
#endif

#endif
