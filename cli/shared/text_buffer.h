// SPDX-License-Identifier: MIT
//
// Text in the making: answers of a batch, built on several threads and printed in order.

#ifndef TALUS_CLI_TEXT_BUFFER_H
#define TALUS_CLI_TEXT_BUFFER_H

#include <talus/pack.h>

#include <stddef.h>

/// Zero is an empty text. When memory is out `failed` is set and the text stays as it is.
typedef struct tl_text {
    char *bytes; ///< not terminated
    size_t size, capacity;
    bool failed;
    const tl_pack_frame *frame; ///< of the places that are added; NULL: as they are
} tl_text;

void tl_text_free(tl_text *text);
void tl_text_add(tl_text *text, const char *words);
/// Words out of a file, with ? for the bytes that could drive a terminal.
void tl_text_add_safe(tl_text *text, const char *words);
/// The fewest digits that read back as the same float; -0 is written 0, since the sign would only puzzle a reader.
void tl_text_add_float(tl_text *text, float value);
void tl_text_add_count(tl_text *text, uint64_t value);
/// A place with a separator between its numbers, in the level's own coordinates: as few digits as read back as the same
/// baked point.
void tl_text_add_point(tl_text *text, tl_vec3 point, char separator);
/// A direction, in the level's axes.
void tl_text_add_direction(tl_text *text, tl_vec3 v, char separator);
/// The same as JSON: a number, or null when it is not finite.
void tl_text_add_json_float(tl_text *text, float value);
void tl_text_add_json_point(tl_text *text, tl_vec3 point);
void tl_text_add_json_direction(tl_text *text, tl_vec3 v);

enum { TL_PLACE_TEXT_BYTES = 40 };

/// A place's number on `axis` of the level, `near` metres from the frame's origin, in as few digits as read back as the
/// same `near`.
void tl_format_place(const tl_pack_frame *frame, int axis, float near, char text_out[TL_PLACE_TEXT_BYTES]);

#endif
