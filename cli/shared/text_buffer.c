// SPDX-License-Identifier: MIT
//
// A growing array of bytes.

#include "cli/shared/text_buffer.h"

#include "io/text/format_float.h"

#include <math.h>
#include <stdio.h>
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

void tl_format_place(const tl_pack_frame *frame, int axis, float near, char text_out[TL_PLACE_TEXT_BYTES])
{
    enum { MOST_DECIMALS = 17 };
    const double origin = frame->origin[axis];
    const double value = origin + (double)near;
    for (int decimals = 0; decimals <= MOST_DECIMALS && fabs(value) < 1e15; ++decimals) {
        snprintf(text_out, TL_PLACE_TEXT_BYTES, "%.*f", decimals, value);
        if ((float)(strtod(text_out, NULL) - origin) == near) {
            return;
        }
    }
    snprintf(text_out, TL_PLACE_TEXT_BYTES, "%.17g", value);
}

static void add_place_number(tl_text *text, int axis, float near)
{
    char number[TL_PLACE_TEXT_BYTES];
    if (text->frame == NULL || text->frame->origin[axis] == 0.0) {
        tl_text_add_float(text, near);
    } else {
        tl_format_place(text->frame, axis, near, number);
        tl_text_add(text, number);
    }
}

static tl_vec3 turn_out(const tl_text *text, tl_vec3 v)
{
    return text->frame != NULL ? tl_pack_turn_out((tl_pack_axes)text->frame->axes, v) : v;
}

void tl_text_add_point(tl_text *text, tl_vec3 point, char separator)
{
    const tl_vec3 near = turn_out(text, point);
    add_place_number(text, 0, near.x);
    append_bytes(text, &separator, 1);
    add_place_number(text, 1, near.y);
    append_bytes(text, &separator, 1);
    add_place_number(text, 2, near.z);
}

void tl_text_add_direction(tl_text *text, tl_vec3 v, char separator)
{
    const tl_vec3 turned = turn_out(text, v);
    tl_text_add_float(text, turned.x);
    append_bytes(text, &separator, 1);
    tl_text_add_float(text, turned.y);
    append_bytes(text, &separator, 1);
    tl_text_add_float(text, turned.z);
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
    if (!tl_is_finite(point)) {
        tl_text_add_json_direction(text, point);
        return;
    }
    tl_text_add(text, "[");
    tl_text_add_point(text, point, ',');
    tl_text_add(text, "]");
}

void tl_text_add_json_direction(tl_text *text, tl_vec3 v)
{
    const tl_vec3 turned = turn_out(text, v);
    tl_text_add(text, "[");
    tl_text_add_json_float(text, turned.x);
    tl_text_add(text, ",");
    tl_text_add_json_float(text, turned.y);
    tl_text_add(text, ",");
    tl_text_add_json_float(text, turned.z);
    tl_text_add(text, "]");
}
