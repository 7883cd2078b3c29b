// SPDX-License-Identifier: MIT
//
// Any text as a number: the same bits and the same end as strtof, by both readers.

#include "io/text/parse_float.h"

#include <assert.h>
#include <stdlib.h>

// strtof takes more than decimal numbers: leading blanks, words, hexadecimal.
static bool is_decimal_text(const char *text)
{
    if (strspn(text, " \t\n\v\f\r") > 0) {
        return false;
    }
    const char *at = text + (*text == '-' || *text == '+');
    return strchr("iInN", *at) == NULL && !(at[0] == '0' && (at[1] | 0x20) == 'x');
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = calloc(size + 1 + TL_PARSE_PADDING, 1);
    memcpy(text, data, size);
    size = strlen(text);
    if (size > 0 && !is_decimal_text(text)) {
        free(text);
        return 0;
    }
    char *expected_end;
    float expected = strtof(text, &expected_end);
    float exact = 0.0f;
    float fast = 0.0f;
    const char *exact_end = tl_parse_float(text, text + size, &exact);
    text[size] = '\n';
    const char *fast_end = tl_parse_float_padded(text, text + size + 1, &fast);
    if (expected_end == text) {
        assert(exact_end == NULL && fast_end == NULL);
    } else {
        assert(exact_end == expected_end && memcmp(&exact, &expected, sizeof exact) == 0);
        assert(fast_end == expected_end && memcmp(&fast, &expected, sizeof fast) == 0);
    }
    free(text);
    return 0;
}
