// SPDX-License-Identifier: MIT
//
// Line-based text taken word by word, with errors that name the line.

#ifndef TALUS_IO_LINE_WORDS_H
#define TALUS_IO_LINE_WORDS_H

#include "io/files/io_error.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The place of a reader in its text. Begin zeroed, with bytes, size, path and allocator set.
typedef struct tl_text_reader {
    const char *bytes;
    size_t size;
    const char *path;              ///< for error messages; may be NULL
    const tl_allocator *allocator; ///< NULL: malloc
    size_t offset;
    uint64_t line; ///< lines read so far
} tl_text_reader;

/// One line: what is left of it.
typedef struct tl_line {
    const char *at;
    const char *end;
} tl_line;

/// Whether only blank lines are left.
bool tl_text_reader_at_end(tl_text_reader *reader);

/// Moves to the next line that is not blank. False: there is none.
bool tl_next_line(tl_text_reader *reader, tl_line *line_out);

/// The next word of the line, [*begin, *end). False: none is left.
bool tl_next_word(tl_line *line, const char **begin, const char **end);

/// Whether the line's next word is `word`; then it is taken.
bool tl_take_word(tl_line *line, const char *word);

/// A whole number within [low, high].
bool tl_take_integer(tl_line *line, int64_t low, int64_t high, int64_t *value_out);
/// A finite number.
bool tl_take_float(tl_line *line, float *value_out);
bool tl_take_double(tl_line *line, double *value_out);
/// Whether nothing is left.
bool tl_line_is_done(const tl_line *line);
/// The rest of the line without blanks at its ends, cut at `capacity` - 1 bytes.
void tl_take_rest(tl_line *line, char *text, size_t capacity);

/// TL_ERR_FORMAT, told as "expected ..." at the line that was read last.
tl_result tl_line_fail(const tl_text_reader *reader, tl_io_error *error, const char *expected);
/// The text ends too early.
tl_result tl_line_missing(const tl_text_reader *reader, tl_io_error *error, const char *expected);

#ifdef __cplusplus
}
#endif

#endif
