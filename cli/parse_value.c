// SPDX-License-Identifier: MIT
//
// strtof in the C locale does the reading (the program never calls setlocale); what it would let pass and nobody means
// - nan, inf, 0x1p3 - is refused here, by name.

#include "parse_value.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char not_finite[] = "is not finite";
static const char not_a_number[] = "is not a number";
static const char too_large[] = "is too large for a float";

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static const char *skip_blanks(const char *text)
{
    while (is_blank(*text)) {
        text++;
    }
    return text;
}

// One number at `text`; `*end_out` is behind it.
static const char *read_float(const char *text, float *value_out, const char **end_out)
{
    const char *digits = text + (*text == '+' || *text == '-');
    *end_out = text;
    if (*digits == 'n' || *digits == 'N' || *digits == 'i' || *digits == 'I') {
        char *end;
        (void)strtof(text, &end);
        return end != text ? not_finite : not_a_number;
    }
    bool starts = (*digits >= '0' && *digits <= '9') || *digits == '.';
    if (!starts || (digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X'))) {
        return not_a_number;
    }
    char *end;
    float value = strtof(text, &end);
    if (end == text) {
        return not_a_number;
    }
    if (!isfinite(value)) {
        return too_large;
    }
    *value_out = value;
    *end_out = end;
    return NULL;
}

const char *tl_parse_float_list(const char *text, float *values_out, uint32_t least, uint32_t count,
                                uint32_t *count_out)
{
    uint32_t found = 0;
    for (;;) {
        if (found == count) {
            return "has too many numbers";
        }
        text = skip_blanks(text);
        const char *reason = read_float(text, &values_out[found], &text);
        if (reason != NULL) {
            return reason;
        }
        found++;
        text = skip_blanks(text);
        if (*text == '\0') {
            break;
        }
        if (*text != ',') {
            return count == 1 ? not_a_number : "is not a list of numbers with commas between";
        }
        text++;
    }
    if (found < least) {
        return "has too few numbers";
    }
    if (count_out != NULL) {
        *count_out = found;
    }
    return NULL;
}

const char *tl_parse_float_value(const char *text, float *value_out)
{
    const char *reason = tl_parse_float_list(text, value_out, 1, 1, NULL);
    return reason == NULL || strncmp(reason, "has", 3) != 0 ? reason : not_a_number;
}

const char *tl_parse_point_value(const char *text, tl_vec3 *point_out)
{
    float values[3];
    const char *reason = tl_parse_float_list(text, values, 3, 3, NULL);
    if (reason == NULL) {
        *point_out = tl_vec3_make(values[0], values[1], values[2]);
    }
    return reason;
}

const char *tl_parse_count_value(const char *text, uint64_t max, uint64_t *value_out)
{
    text = skip_blanks(text);
    if (*text == '-') {
        return "is negative";
    }
    if (*text < '0' || *text > '9') {
        return "is not a whole number";
    }
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (*skip_blanks(end) != '\0') {
        return "is not a whole number";
    }
    if (errno == ERANGE || value > max) {
        return "is too large";
    }
    *value_out = value;
    return NULL;
}

const char *tl_parse_float_words(const char *line, float *values_out, uint32_t capacity, uint32_t *count_out,
                                 const char **bad_out)
{
    uint32_t count = 0;
    for (;;) {
        while (is_blank(*line) || *line == ',' || *line == '\r') {
            line++;
        }
        if (*line == '\0') {
            *count_out = count;
            return NULL;
        }
        float value = 0.0f;
        const char *end;
        const char *reason = read_float(line, &value, &end);
        if (reason == NULL && *end != '\0' && *end != ',' && *end != '\r' && !is_blank(*end)) {
            reason = not_a_number;
        }
        if (reason != NULL) {
            *bad_out = line;
            return reason;
        }
        if (count < capacity) {
            values_out[count] = value;
        }
        count++;
        line = end;
    }
}
