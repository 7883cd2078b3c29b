// SPDX-License-Identifier: MIT
//
// One question from the command line, or many, one a line: read, answered on all threads, printed in order.

#ifndef TALUS_CLI_LINE_BATCH_H
#define TALUS_CLI_LINE_BATCH_H

#include "cli/shared/command.h"
#include "cli/shared/text_buffer.h"

enum { TL_MAX_LINE_NUMBERS = 8 };

/// Answers one question: appends its text, line end included, and returns false when the answer is no. Called on
/// several threads at once; `worker` is below the host's worker count.
typedef bool tl_answer_fn(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user);

typedef struct tl_batch {
    const char *path;   ///< of the lines; "-" is standard input. NULL: there is one question, the caller's numbers
    const char *wanted; ///< what a line holds, such as "ox oy oz dx dy dz [tmax]"
    uint32_t min_numbers, max_numbers; ///< a line holds the one or the other; at most TL_MAX_LINE_NUMBERS
    tl_answer_fn *answer;
    void *user;
    uint32_t directions; ///< bit i: the i-th three numbers are no place but a direction
} tl_batch;

/// Without a path: answers `numbers`, `min_numbers` of them; no ends with TL_EXIT_NEGATIVE. With a path `numbers` is
/// ignored.
///
/// Places and directions are in the level's own coordinates where it has some (tl_cli.frame), of questions and of
/// answers; `numbers` is then what tl_question_read read, and is read once more from the command line, in double.
///
/// Numbers are separated by blanks, tabs or commas; empty lines and lines that begin with # are skipped. A line that is
/// not right ends the run with its number, after the answers to all lines before it. Answers are flushed whenever the
/// input would have to be waited for.
tl_exit tl_batch_run(tl_cli *cli, const tl_batch *batch, const float *numbers);

/// The names of the triples of one question, such as "origin" and "direction", and of the option for a file of many.
typedef struct tl_question_words {
    const char *first, *second; ///< `second` NULL: there is one triple
    const char *option;         ///< "rays"
} tl_question_words;

/// Reads the triples that stand behind FILE into `numbers_out`, unless `path` names a file of many: exactly one of the
/// two must be given. False: reported.
bool tl_question_read(tl_cli *cli, const tl_question_words *words, const char *path, float *numbers_out,
                      tl_exit *exit_out);

#endif
