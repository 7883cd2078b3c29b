// SPDX-License-Identifier: MIT
//
// A growing array of bytes.

#include "cli/shared/text_buffer.h"

#include "io/text/format_float.h"

#include <stdlib.h>
#include <string.h>

void tl_text_free(tl_text *text)
{
    free(text->bytes);
    memset(text, 0, sizeof(*text));
}

static void append_bytes(tl_text *text, const char *bytes, size_t size)
{
    if (size == 0) {
        return; // memcpy takes no NULL, not even for nothing
    }
    if (text->capacity - text->size < size) {
        size_t grown = 2 * text->capacity + size + 256;
        char *moved = realloc(text->bytes, grown);
        if (moved == NULL) {
            text->failed = true;
            return;
        }
        text->bytes = moved;
        text->capacity = grown;
    }
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
}

void tl_text_add(tl_text *text, const char *words)
{
    append_bytes(text, words, strlen(words));
}

void tl_text_add_safe(tl_text *text, const char *words)
{
    for (; *words != '\0'; words++) {
        const char letter[2] = { (unsigned char)*words >= ' ' && *words != 0x7f ? *words : '?', '\0' };
        tl_text_add(text, letter);
    }
}

void tl_text_add_float(tl_text *text, float value)
{
    char digits[TL_FLOAT_TEXT_BYTES];
    append_bytes(text, digits, tl_format_float(value + 0.0f, digits)); // -0 + 0 is 0
}

void tl_text_add_count(tl_text *text, uint64_t value)
{
    char digits[20]; // 2^64 has 20
    size_t at = sizeof(digits);
    do {
        digits[--at] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    append_bytes(text, digits + at, sizeof(digits) - at);
}

void tl_text_add_point(tl_text *text, tl_vec3 point, char separator)
{
    tl_text_add_float(text, point.x);
    append_bytes(text, &separator, 1);
    tl_text_add_float(text, point.y);
    append_bytes(text, &separator, 1);
    tl_text_add_float(text, point.z);
}

void tl_text_add_json_float(tl_text *text, float value)
{
    if (isfinite(value)) {
        tl_text_add_float(text, value);
    } else {
        tl_text_add(text, "null");
    }
}

void tl_text_add_json_point(tl_text *text, tl_vec3 point)
{
    tl_text_add(text, "[");
    tl_text_add_json_float(text, point.x);
    tl_text_add(text, ",");
    tl_text_add_json_float(text, point.y);
    tl_text_add(text, ",");
    tl_text_add_json_float(text, point.z);
    tl_text_add(text, "]");
}
