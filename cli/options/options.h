// SPDX-License-Identifier: MIT
//
// Options as tables: each command lists its options once, and gets parsing, range checks and help from it. popt reads
// the command line.

#ifndef TALUS_CLI_OPTIONS_H
#define TALUS_CLI_OPTIONS_H

#include <talus/base.h>

typedef enum tl_option_kind {
    TL_OPTION_FLAG,   ///< bool, set to true
    TL_OPTION_UNFLAG, ///< bool, set to false
    TL_OPTION_FLOAT,
    TL_OPTION_COUNT,        ///< uint32_t
    TL_OPTION_NEEDED_COUNT, ///< uint32_t without a default: UINT32_MAX when it is not given
    TL_OPTION_NUMBER,       ///< uint64_t
    TL_OPTION_TEXT,         ///< const char *; points into the command line
    TL_OPTION_INPUT,        ///< TEXT: a file that is read
    TL_OPTION_OUTPUT,       ///< TEXT: a file that is written, so none that is read; `words`: the endings it may have
    TL_OPTION_TEXTS,        ///< tl_option_texts; the option may be given again and again
    TL_OPTION_CHOICE        ///< int; the index of the word in `words`
} tl_option_kind;

enum { TL_MAX_OPTION_TEXTS = 256 };

/// The values of an option that may be given several times, in order.
typedef struct tl_option_texts {
    const char *words[TL_MAX_OPTION_TEXTS];
    uint32_t count;
} tl_option_texts;

/// One option. The target's value before parsing is the default that the help shows.
typedef struct tl_option {
    const char *name; ///< long name; NULL ends a table
    char letter;      ///< or 0
    tl_option_kind kind;
    void *target;
    const char *metavar;           ///< what stands for the value in the help
    const char *help;              ///< without full stop
    const char *const *words;      ///< CHOICE, OUTPUT: NULL-terminated
    float min, max;                ///< FLOAT: closed range
    uint32_t min_count, max_count; ///< COUNT: closed range; max_count 0: any
} tl_option;

#define TL_OPTION_TABLE_END                                                                                            \
    {                                                                                                                  \
        NULL, 0, TL_OPTION_FLAG, NULL, NULL, NULL, NULL, 0, 0, 0, 0                                                    \
    }

/// A headed part of a command's options.
typedef struct tl_option_group {
    const char *title; ///< "Options:", or NULL ends the groups
    const tl_option *options;
} tl_option_group;

typedef enum tl_parse_outcome {
    TL_PARSE_OK,
    TL_PARSE_HELP, ///< --help or -? was given
    TL_PARSE_ERROR ///< `message` says what and what to do
} tl_parse_outcome;

enum { TL_MAX_ARGUMENTS = 64, TL_MAX_OPTIONS = 96, TL_OPTION_MESSAGE_BYTES = 512 };

/// The words that are not options, in order.
typedef struct tl_arguments {
    const char *words[TL_MAX_ARGUMENTS];
    uint32_t count;
    const char *given[TL_MAX_OPTIONS]; ///< names of the options that were given, each once
    uint32_t given_count;
    char message[TL_OPTION_MESSAGE_BYTES];
    void *storage; ///< what the words and TEXT targets point into; freed by tl_arguments_free
} tl_arguments;

/// Parses argv[1..]. Words like -1,2,3 are values, not options.
tl_parse_outcome tl_options_parse(const tl_option_group *groups, int argc, const char *const *argv,
                                  tl_arguments *arguments_out);
/// The name of the first option of `options` that was given; NULL: none was.
const char *tl_arguments_find_given(const tl_arguments *arguments, const tl_option *options);
/// Whether a NULL-terminated list of words holds a name.
bool tl_is_listed(const char *const *list, const char *name);
/// The name of the first option that was given and that none of the NULL-terminated list `taken`, nor of `options`
/// (NULL: no more), nor of those that all commands have, is called; NULL: there is none.
const char *tl_arguments_find_other(const tl_arguments *arguments, const char *const *taken, const tl_option *options);
void tl_arguments_free(tl_arguments *arguments);

/// Prints words from `column` on, broken at blanks and line ends so that lines keep to the help's width; later lines
/// begin at `indent`. Ends with a line end.
void tl_options_print_wrapped(const char *text, int column, int indent);
/// Prints paragraphs, parted by empty lines, wrapped to the help's width.
void tl_options_print_text(const char *text);

/// Writes the default, " [0.3]", or nothing where there is none.
void tl_option_default_text(const tl_option *option, char *text, size_t capacity);

/// Prints the options with their defaults, one or two lines each.
void tl_options_print(const tl_option_group *groups);

#endif
