// SPDX-License-Identifier: MIT
//
// Numbers and points out of text, whole or not at all, with the reason when not.

#ifndef TALUS_CLI_PARSE_VALUE_H
#define TALUS_CLI_PARSE_VALUE_H

#include <talus/base.h>
#include <talus/vec.h>

/// All of these skip blanks at both ends, return NULL on success and else a static reason such as "is not a number".
/// NaN, infinity, hexadecimal floats and trailing characters are refused.
const char *tl_parse_float_value(const char *text, float *value_out);
const char *tl_parse_count_value(const char *text, uint64_t max, uint64_t *value_out);
/// "x,y,z".
const char *tl_parse_point_value(const char *text, tl_vec3 *point_out);
/// `count` numbers separated by commas; exactly `count`, or `min_count` <= written `*count_out` <= `count` when that is
/// given.
const char *tl_parse_float_list(const char *text, float *values_out, uint32_t min_count, uint32_t count,
                                uint32_t *count_out);

/// The numbers of a line, separated by blanks, tabs or commas: fills at most `capacity`, counts all. `*bad_out` is the
/// first word that is not a number, and the reason is returned; NULL when all are.
const char *tl_parse_float_words(const char *line, float *values_out, uint32_t capacity, uint32_t *count_out,
                                 const char **bad_out);

/// Three numbers with commas between, as doubles: for coordinates too large for floats.
/// The first `count` numbers of a line that tl_parse_float_words took, as doubles.
void tl_parse_double_words(const char *line, double *values_out, uint32_t count);
const char *tl_parse_double_triple(const char *text, double values_out[3]);

#endif
