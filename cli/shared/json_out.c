// SPDX-License-Identifier: MIT
//
// A float's shortest decimal form (found with 6 to 9 digits) becomes a double, which then prints the same digits again
// because 15 digits survive a double unchanged.

#include "cli/shared/json_out.h"

#include "cli/shared/text_buffer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JSON_STYLE (JSON_REAL_PRECISION(15) | JSON_PRESERVE_ORDER)

json_t *tl_json_float(float value)
{
    if (!isfinite(value)) {
        return json_null();
    }
    char text[40];
    for (int digits = 6; digits <= 9; ++digits) {
        snprintf(text, sizeof(text), "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            break;
        }
    }
    return json_real(strtod(text, NULL));
}

json_t *tl_json_double(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *tl_json_point(tl_vec3 point)
{
    return json_pack("[ooo]", tl_json_float(point.x), tl_json_float(point.y), tl_json_float(point.z));
}

json_t *tl_json_bounds(tl_aabb bounds)
{
    return json_pack("{so so}", "min", tl_json_point(bounds.min), "max", tl_json_point(bounds.max));
}

json_t *tl_json_placed(const tl_pack_frame *frame, tl_vec3 point)
{
    if (frame == NULL || !tl_is_finite(point)) {
        return tl_json_point(point);
    }
    const tl_vec3 turned = tl_pack_turn_out((tl_pack_axes)frame->axes, point);
    const float near[3] = { turned.x, turned.y, turned.z };
    json_t *array = json_array();
    for (int i = 0; i < 3; ++i) {
        char text[TL_PLACE_TEXT_BYTES];
        tl_format_place(frame, i, near[i], text);
        json_array_append_new(array,
                              frame->origin[i] != 0.0 ? json_real(strtod(text, NULL)) : tl_json_float(near[i] + 0.0f));
    }
    return array;
}

json_t *tl_json_placed_bounds(const tl_pack_frame *frame, tl_aabb bounds)
{
    if (frame == NULL || tl_aabb_is_empty(bounds)) {
        return tl_json_bounds(bounds);
    }
    // Turned, the lowest corner is another one.
    const tl_pack_axes axes = (tl_pack_axes)frame->axes;
    const tl_vec3 a = tl_pack_turn_out(axes, bounds.min), b = tl_pack_turn_out(axes, bounds.max);
    return json_pack("{so so}", "min", tl_json_placed(frame, tl_pack_turn_in(axes, tl_min(a, b))), "max",
                     tl_json_placed(frame, tl_pack_turn_in(axes, tl_max(a, b))));
}

json_t *tl_json_text(const char *text)
{
    json_t *value = json_string(text);
    char *copy = value == NULL ? strdup(text) : NULL;
    if (copy != NULL) {
        for (char *c = copy; *c != '\0'; ++c) {
            *c = (unsigned char)*c < 0x80 ? *c : '?';
        }
        value = json_string(copy);
        free(copy);
    }
    return value;
}

// Length of the string that begins at `text`, with both quotes.
static size_t string_length(const char *text)
{
    size_t length = 1;
    while (text[length] != '"') {
        length += text[length] == '\\' ? 2 : 1;
    }
    return length + 1;
}

// An array of numbers on one line: the white space inside is dropped.
static void print_array(const char *text, size_t length)
{
    for (size_t i = 0; i < length; ++i) {
        if (text[i] != ' ' && text[i] != '\n') {
            putchar(text[i]);
        }
        if (text[i] == ',') {
            putchar(' ');
        }
    }
}

// Indented JSON, but a point takes one line and not five.
static void print_folded(const char *text)
{
    while (*text != '\0') {
        size_t length = 1;
        if (*text == '"') {
            length = string_length(text);
        } else if (*text == '[') {
            length += strcspn(text + 1, "[]{\"");
            if (text[length] == ']') {
                print_array(text, length);
                text += length;
                continue;
            }
            length = 1;
        }
        fwrite(text, 1, length, stdout);
        text += length;
    }
    putchar('\n');
}

int tl_json_print(json_t *object)
{
    char *text = object != NULL ? json_dumps(object, JSON_STYLE | JSON_INDENT(2)) : NULL;
    json_decref(object);
    if (text == NULL) {
        return 0;
    }
    print_folded(text);
    free(text);
    return 1;
}

int tl_json_print_line(json_t *object)
{
    int failed = object == NULL || json_dumpf(object, stdout, JSON_STYLE | JSON_COMPACT) != 0;
    json_decref(object);
    if (!failed) {
        putchar('\n');
    }
    return !failed;
}

tl_exit tl_cli_print_json(tl_cli *cli, json_t *object)
{
    return tl_json_print(object) ? TL_EXIT_OK : tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
}
