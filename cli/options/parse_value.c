// SPDX-License-Identifier: MIT
//
// The io library reads the digits, correctly rounded and without a locale; what people write instead of numbers - nan,
// inf, 0x1p3 - is refused here, by name.

#include "cli/options/parse_value.h"

#include "io/text/parse_float.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char not_finite[] = "is not finite";
static const char not_a_number[] = "is not a number";
static const char too_large[] = "is too large for a float";

static bool is_blank_letter(char c)
{
    return c == ' ' || c == '\t';
}

static const char *skip_blank_letters(const char *text)
{
    while (is_blank_letter(*text)) {
        text++;
    }
    return text;
}

// One number at `text`; `*text` is moved behind it.
static const char *read_float(const char **text, const char *end, float *value_out)
{
    const char *word = *text;
    const char *letter = word + (word < end && (*word == '+' || *word == '-'));
    if (end - letter >= 3 && (strncasecmp(letter, "nan", 3) == 0 || strncasecmp(letter, "inf", 3) == 0)) {
        return not_finite;
    }
    float value = 0.0f;
    const char *behind = tl_parse_float(word, end, &value);
    if (behind == NULL) {
        return not_a_number;
    }
    if (!isfinite(value)) {
        return too_large;
    }
    *value_out = value;
    *text = behind;
    return NULL;
}

const char *tl_parse_float_list(const char *text, float *values_out, uint32_t min_count, uint32_t count,
                                uint32_t *count_out)
{
    const char *end = text + strlen(text);
    uint32_t found = 0;
    for (;;) {
        if (found == count) {
            return "has too many numbers";
        }
        text = skip_blank_letters(text);
        const char *reason = read_float(&text, end, &values_out[found]);
        if (reason != NULL) {
            return reason;
        }
        found++;
        text = skip_blank_letters(text);
        if (*text == '\0') {
            break;
        }
        if (*text != ',') {
            return count == 1 ? not_a_number : "is not a list of numbers with commas between";
        }
        text++;
    }
    if (found < min_count) {
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
    text = skip_blank_letters(text);
    if (*text == '-') {
        return "is negative";
    }
    if (*text < '0' || *text > '9') {
        return "is not a whole number";
    }
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (*skip_blank_letters(end) != '\0') {
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
    const char *end = line + strlen(line);
    uint32_t count = 0;
    for (;;) {
        while (is_blank_letter(*line) || *line == ',' || *line == '\r') {
            line++;
        }
        if (*line == '\0') {
            *count_out = count;
            return NULL;
        }
        const char *word = line;
        float value = 0.0f;
        const char *reason = read_float(&line, end, &value);
        if (reason == NULL && *line != '\0' && *line != ',' && *line != '\r' && !is_blank_letter(*line)) {
            reason = not_a_number;
        }
        if (reason != NULL) {
            *bad_out = word;
            return reason;
        }
        if (count < capacity) {
            values_out[count] = value;
        }
        count++;
    }
}

const char *tl_parse_double_triple(const char *text, double values_out[3])
{
    tl_vec3 checked;
    const char *reason = tl_parse_point_value(text, &checked);
    const char *end = text + strlen(text);
    for (int i = 0; i < 3 && reason == NULL; ++i) {
        text = skip_blank_letters(text);
        text = skip_blank_letters(tl_parse_double(text, end, &values_out[i]));
        text += *text == ',';
    }
    return reason;
}

void tl_parse_double_words(const char *line, double *values_out, uint32_t count)
{
    const char *end = line + strlen(line);
    for (uint32_t i = 0; i < count; ++i) {
        line += strspn(line, " \t,\r");
        const char *behind = tl_parse_double(line, end, &values_out[i]);
        line = behind != NULL ? behind : end;
    }
}
