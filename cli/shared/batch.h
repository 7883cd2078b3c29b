// SPDX-License-Identifier: MIT
//
// One question from the command line, or many, one a line: read, answered on all threads, printed in order.

#ifndef TALUS_CLI_BATCH_H
#define TALUS_CLI_BATCH_H

#include "cli/shared/command.h"
#include "cli/shared/text_buffer.h"

enum { TL_MAX_LINE_NUMBERS = 8 };

/// Answers one question: appends its text, line end included, and returns false when the answer is no. Called on
/// several threads at once; `worker` is below the host's worker count.
typedef bool tl_answer_fn(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user);

typedef struct tl_batch {
    const char *path;     ///< of the lines; "-" is standard input. NULL: there is one question, the caller's numbers
    const char *wanted;   ///< what a line holds, such as "ox oy oz dx dy dz [tmax]"
    uint32_t least, most; ///< how many numbers a line holds, most <= TL_MAX_LINE_NUMBERS
    tl_answer_fn *answer;
    void *user;
} tl_batch;

/// Without a path: answers `numbers`, `least` of them; no ends with TL_EXIT_NEGATIVE. With one `numbers` is not looked
/// at.
///
/// Numbers are parted by blanks, tabs or commas; empty lines and lines that begin with # are skipped. A line that is
/// not right ends the run with its number, after the answers to all lines before it. Answers are flushed whenever the
/// input would have to be waited for.
tl_exit tl_batch_run(tl_cli *cli, const tl_batch *batch, const float *numbers);

#endif
