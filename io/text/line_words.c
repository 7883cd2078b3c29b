// SPDX-License-Identifier: MIT
//
// Words of a line, bounded on both sides: the text need not end with anything.

#include "io/text/line_words.h"

#include "io/text/parse_float.h"

#include <math.h>
#include <string.h>

static bool is_line_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static void skip_line_blanks(tl_line *line)
{
    while (line->at < line->end && is_line_blank(*line->at)) {
        line->at++;
    }
}

bool tl_next_line(tl_text_reader *reader, tl_line *line_out)
{
    while (reader->offset < reader->size) {
        const char *begin = reader->bytes + reader->offset;
        size_t left = reader->size - reader->offset;
        const char *end = memchr(begin, '\n', left);
        size_t length = end != NULL ? (size_t)(end - begin) : left;
        reader->offset += end != NULL ? length + 1 : length;
        reader->line++;
        line_out->at = begin;
        line_out->end = begin + length;
        skip_line_blanks(line_out);
        if (line_out->at < line_out->end) {
            return true;
        }
    }
    return false;
}

bool tl_text_reader_at_end(tl_text_reader *reader)
{
    tl_text_reader ahead = *reader;
    tl_line line;
    return !tl_next_line(&ahead, &line);
}

bool tl_next_word(tl_line *line, const char **begin, const char **end)
{
    skip_line_blanks(line);
    *begin = line->at;
    while (line->at < line->end && !is_line_blank(*line->at)) {
        line->at++;
    }
    *end = line->at;
    return *end > *begin;
}

bool tl_take_word(tl_line *line, const char *word)
{
    tl_line rest = *line;
    const char *begin, *end;
    size_t length = strlen(word);
    if (!tl_next_word(&rest, &begin, &end) || (size_t)(end - begin) != length || memcmp(begin, word, length) != 0) {
        return false;
    }
    *line = rest;
    return true;
}

bool tl_take_integer(tl_line *line, int64_t low, int64_t high, int64_t *value_out)
{
    const char *begin, *end;
    if (!tl_next_word(line, &begin, &end)) {
        return false;
    }
    bool negative = *begin == '-';
    begin += negative || *begin == '+';
    // 18 digits stay below 10^18, which fits.
    if (begin == end || end - begin > 18) {
        return false;
    }
    int64_t value = 0;
    for (; begin < end; begin++) {
        if (*begin < '0' || *begin > '9') {
            return false;
        }
        value = 10 * value + (*begin - '0');
    }
    *value_out = negative ? -value : value;
    return *value_out >= low && *value_out <= high;
}

bool tl_take_float(tl_line *line, float *value_out)
{
    const char *begin, *end;
    return tl_next_word(line, &begin, &end) && tl_parse_float(begin, end, value_out) == end && isfinite(*value_out);
}

bool tl_take_double(tl_line *line, double *value_out)
{
    const char *begin, *end;
    return tl_next_word(line, &begin, &end) && tl_parse_double(begin, end, value_out) == end && isfinite(*value_out);
}

bool tl_line_is_done(const tl_line *line)
{
    tl_line rest = *line;
    skip_line_blanks(&rest);
    return rest.at == rest.end;
}

void tl_take_rest(tl_line *line, char *text, size_t capacity)
{
    skip_line_blanks(line);
    while (line->end > line->at && is_line_blank(line->end[-1])) {
        line->end--;
    }
    size_t length = (size_t)(line->end - line->at);
    length = length < capacity - 1 ? length : capacity - 1;
    memcpy(text, line->at, length);
    text[length] = '\0';
    line->at = line->end;
}

tl_result tl_line_fail(const tl_text_reader *reader, tl_io_error *error, const char *expected)
{
    return tl_io_fail(error, TL_ERR_FORMAT, reader->path, reader->line, "docs/guide/polygons.md describes the format",
                      "expected %s", expected);
}

tl_result tl_line_missing(const tl_text_reader *reader, tl_io_error *error, const char *expected)
{
    return tl_io_fail(error, TL_ERR_TRUNCATED, reader->path, reader->line, "the file is cut off; write it again",
                      "the text ends where %s should follow", expected);
}
