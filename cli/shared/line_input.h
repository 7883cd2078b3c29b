// SPDX-License-Identifier: MIT
//
// Lines of a file or of standard input, streamed.

#ifndef TALUS_CLI_LINE_INPUT_H
#define TALUS_CLI_LINE_INPUT_H

#include "io/files/io_error.h"

#include <talus/base.h>

enum { TL_MAX_LINE_BYTES = 1 << 16 };

typedef struct tl_line_input {
    const char *path; ///< as given; "-" is standard input
    int file;
    char *buffer;
    size_t begin, end; ///< what is read and not yet handed out
    uint64_t line;     ///< number of the line handed out last, from 1
    bool at_end;
} tl_line_input;

tl_result tl_line_input_open(const char *path, tl_line_input *input_out, tl_io_error *error_out);
void tl_line_input_close(tl_line_input *input);

/// The next line, without its end, terminated; valid until the next call. TL_NOT_FOUND at the end of the input.
/// TL_ERR_IO, TL_ERR_FORMAT (a line too long, or with a zero byte), TL_ERR_CANCELLED (Ctrl-C while it waited).
tl_result tl_line_input_next(tl_line_input *input, char **line_out, tl_io_error *error_out);

/// Whether reading the next line may block: answers to the lines so far should be flushed before that.
bool tl_line_input_would_wait(const tl_line_input *input);

#endif
