// SPDX-License-Identifier: MIT
//
// Area marks: a text that says which floors get which area, one mark a line.
//
//   material AREA NAME             triangles of the material; NAME may hold * and ?
//   box AREA x y z x y z           floors between two corners, the lowest first
//   cylinder AREA x y z radius height
//   prism AREA low high x z x z x z ...     an outline of three corners or more, and its heights
//
// AREA is 0 (not walkable) to 255. Coordinates are metres in the level's own axes and from its own origin (a frame);
// where z is up, low, high and a cylinder's height are along z, and a prism's corners are x y. Empty lines and lines
// that begin with # are skipped. Of several marks for one floor the last counts, but what is not walkable stays so;
// volumes come after materials.

#ifndef TALUS_IO_AREA_MARKS_H
#define TALUS_IO_AREA_MARKS_H

#include "io/files/io_error.h"

#include <talus/nav_bake.h>
#include <talus/pack.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles of the materials whose name is, or matches, a pattern.
typedef struct tl_area_rule {
    uint64_t name;    ///< offset in tl_area_marks.text of the pattern, zero-terminated
    size_t name_size; ///< without the zero
    uint64_t line;    ///< of the text, 0: from elsewhere
    uint8_t area;
} tl_area_rule;

/// All marks, in order. Zeroed: no mark; free with tl_area_marks_free.
typedef struct tl_area_marks {
    tl_nav_volume *volumes;
    uint32_t volume_count;
    tl_area_rule *rules;
    uint32_t rule_count;
    char *text;
    tl_vec3 *points; ///< of the prisms, one after another
    uint64_t text_size, point_count;
    uint64_t volume_capacity, rule_capacity, text_capacity, point_capacity; ///< the reader's own
} tl_area_marks;

/// Reads a file's marks ("-": standard input) and adds them, turned from the level's frame (NULL: talus' own). Errors
/// as tl_file_read, and with the line: TL_ERR_FORMAT, TL_ERR_RANGE (an empty box, a radius that is not above 0),
/// TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_area_marks_read(tl_area_marks *marks, const char *path, const tl_pack_frame *frame,
                             tl_io_error *error_out);

/// The same of text in memory; `path` is for messages.
tl_result tl_area_marks_parse(tl_area_marks *marks, const char *text, size_t size, const char *path,
                              const tl_pack_frame *frame, tl_io_error *error_out);

/// Adds a material's rule. TL_ERR_MEMORY, TL_ERR_LIMIT.
tl_result tl_area_marks_add_rule(tl_area_marks *marks, const char *name, size_t name_size, uint64_t line, uint8_t area);

/// Whether a rule names a material: exactly, or as a pattern in which * stands for any text and ? for any character.
bool tl_area_rule_is_exact(const tl_area_marks *marks, const tl_area_rule *rule, const char *material);
bool tl_area_rule_matches(const tl_area_marks *marks, const tl_area_rule *rule, const char *material);

void tl_area_marks_free(tl_area_marks *marks);

#ifdef __cplusplus
}
#endif

#endif
