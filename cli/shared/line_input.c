// SPDX-License-Identifier: MIT
//
// One buffer, read(2) and memchr. stdio was rejected: getline cannot say whether it would wait, and a program that
// asks line by line over a pipe must get its answers line by line.

#include "cli/shared/line_input.h"

#include "cli/shared/input_wait.h"
#include "cli/shared/interrupt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINE_BUFFER_BYTES = 2 * TL_MAX_LINE_BYTES };

tl_result tl_line_input_open(const char *path, tl_line_input *input_out, tl_io_error *error_out)
{
    memset(input_out, 0, sizeof(*input_out));
    input_out->path = path;
    input_out->file = strcmp(path, "-") == 0 ? STDIN_FILENO : tl_input_open(path);
    if (input_out->file < 0) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    input_out->buffer = malloc(LINE_BUFFER_BYTES + 1);
    if (input_out->buffer == NULL) {
        tl_line_input_close(input_out);
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, NULL, "out of memory");
    }
    return TL_OK;
}

void tl_line_input_close(tl_line_input *input)
{
    free(input->buffer);
    input->buffer = NULL;
    if (input->file > STDIN_FILENO) {
        close(input->file);
    }
}

static tl_result fill_line_buffer(tl_line_input *input, tl_io_error *error_out)
{
    if (input->end - input->begin >= TL_MAX_LINE_BYTES) {
        return tl_io_fail(error_out, TL_ERR_FORMAT, input->path, input->line + 1, "is this a text file?",
                          "line longer than %d bytes", (int)TL_MAX_LINE_BYTES);
    }
    memmove(input->buffer, input->buffer + input->begin, input->end - input->begin);
    input->end -= input->begin;
    input->begin = 0;
    for (;;) {
        ssize_t got = read(input->file, input->buffer + input->end, (unsigned)(LINE_BUFFER_BYTES - input->end));
        if (got >= 0) {
            input->at_end = got == 0;
            input->end += (size_t)got;
            return TL_OK;
        }
        if (errno == EINTR && tl_interrupted()) {
            return tl_io_fail(error_out, TL_ERR_CANCELLED, input->path, 0, NULL, "cancelled");
        }
        if (errno != EINTR) {
            return tl_io_fail_system(error_out, input->path, "read", errno);
        }
    }
}

tl_result tl_line_input_next(tl_line_input *input, char **line_out, tl_io_error *error_out)
{
    char *end;
    for (;;) {
        char *begin = input->buffer + input->begin;
        end = memchr(begin, '\n', input->end - input->begin);
        if (end != NULL || (input->at_end && input->begin < input->end)) {
            break;
        }
        if (input->at_end) {
            return TL_NOT_FOUND;
        }
        tl_result result = fill_line_buffer(input, error_out);
        if (result != TL_OK) {
            return result;
        }
    }
    char *line = input->buffer + input->begin;
    if (end == NULL) {
        end = input->buffer + input->end; // the last line lacks its end; the buffer has one byte to spare
    }
    input->line++;
    input->begin = end < input->buffer + input->end ? (size_t)(end - input->buffer) + 1 : input->end;
    if (memchr(line, '\0', (size_t)(end - line)) != NULL) {
        return tl_io_fail(error_out, TL_ERR_FORMAT, input->path, input->line, "give a text file",
                          "zero byte in a line");
    }
    if (end > line && end[-1] == '\r') {
        end--;
    }
    *end = '\0';
    *line_out = line;
    return TL_OK;
}

bool tl_line_input_would_wait(const tl_line_input *input)
{
    if (input->at_end || memchr(input->buffer + input->begin, '\n', input->end - input->begin) != NULL) {
        return false;
    }
    return tl_input_would_wait(input->file);
}
