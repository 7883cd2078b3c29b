// SPDX-License-Identifier: MIT
//
// JSON as the command prints it: floats with the fewest digits that read back the same, never NaN or infinity.

#ifndef TALUS_CLI_JSON_OUT_H
#define TALUS_CLI_JSON_OUT_H

#include "cli/shared/command.h"

#include <jansson.h>
#include <talus/pack.h>

/// A float as a JSON number that prints as short as it can; null when it is not finite.
json_t *tl_json_float(float value);
/// A double; null when it is not finite.
json_t *tl_json_double(double value);
/// [x, y, z]
json_t *tl_json_point(tl_vec3 point);
/// A place in the level's own coordinates; NULL: as it is.
json_t *tl_json_placed(const tl_pack_frame *frame, tl_vec3 point);
/// A box in the level's own coordinates: {"min": [...], "max": [...]}
json_t *tl_json_placed_bounds(const tl_pack_frame *frame, tl_aabb bounds);
/// {"min": [...], "max": [...]}
json_t *tl_json_bounds(tl_aabb bounds);

/// A text, such as a file's name. What is not UTF-8 becomes '?', because JSON cannot hold it.
json_t *tl_json_text(const char *text);

/// Prints an object and a line end to standard output, over several lines or (batch answers) in one, and frees it.
/// False when memory is out, which includes an `object` that is NULL.
int tl_json_print(json_t *object);
int tl_json_print_line(json_t *object);
/// tl_json_print as the last act of a command: reports a failure.
tl_exit tl_cli_print_json(tl_cli *cli, json_t *object);

#endif
