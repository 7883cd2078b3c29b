// SPDX-License-Identifier: MIT
//
// The manifest of a world (input_list.h). A key that is not known is an error: a misspelt "translate" would put a town
// in the wrong place.

#include "io/files/file_map.h"
#include "io/text/json_place.h"
#include "world/input/input_list.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MANIFEST_MIB = 1024 };

static bool take_area(tl_json_reader *json, const tl_json_place *at, const char *key, const json_t *value,
                      uint8_t *area)
{
    const double number = json_is_number(value) ? json_number_value(value) : -1.0;
    if (!(number >= 0.0 && number <= 255.0) || number != floor(number)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no area; use 0 to 255");
        return false;
    }
    *area = (uint8_t)number;
    return true;
}

static bool take_rules(tl_json_reader *json, const tl_json_place *at, tl_world_input *input)
{
    tl_json_place rules;
    if (!tl_json_object(json, at, "areas", &rules)) {
        return json->result == TL_OK;
    }
    input->rules = calloc(json_object_size(rules.value) + 1, sizeof *input->rules);
    if (input->rules == NULL) {
        tl_json_fail(json, TL_ERR_MEMORY, at, "areas", "is too long for the memory");
        return false;
    }
    const char *key;
    json_t *value;
    json_object_foreach(rules.value, key, value)
    {
        tl_world_area_rule *rule = &input->rules[input->rule_count];
        rule->pattern = tl_world_path_beside("", key);
        if (rule->pattern == NULL) {
            tl_json_fail(json, TL_ERR_MEMORY, &rules, key, "is too long for the memory");
            return false;
        }
        input->rule_count++;
        if (!take_area(json, &rules, key, value, &rule->area)) {
            return false;
        }
    }
    return true;
}

static bool take_placing(tl_json_reader *json, const tl_json_place *at, tl_world_input *input)
{
    double move[3];
    const bool matrix = tl_json_numbers(json, at, "matrix", input->matrix, 12);
    const bool translate = tl_json_numbers(json, at, "translate", move, 3);
    if (matrix && translate) {
        tl_json_fail(json, TL_ERR_FORMAT, at, "translate", "stands beside a matrix; leave one out");
    }
    if (translate) {
        for (int i = 0; i < 3; i++) {
            input->matrix[4 * i + 3] = move[i];
        }
    }
    input->is_placed = matrix || translate;
    for (int i = 0; i < 12; i++) {
        if (json->result == TL_OK && !isfinite(input->matrix[i])) {
            tl_json_fail(json, TL_ERR_NOT_FINITE, at, "matrix", "holds what is no number");
        }
    }
    return json->result == TL_OK;
}

static bool take_axes(tl_json_reader *json, const tl_json_place *at, tl_world_input *input)
{
    static const char *const names[] = { "y", "z", "y-left", "z-left" };
    const char *up = tl_json_string(json, at, "up");
    if (up != NULL) {
        int axis = 0;
        while (axis < 4 && strcmp(names[axis], up) != 0) {
            axis++;
        }
        if (axis == 4) {
            tl_json_fail(json, TL_ERR_FORMAT, at, "up", "is none of y, z, y-left, z-left");
            return false;
        }
        input->up = (tl_up_axis)axis;
    }
    const json_t *value = json_object_get(at->value, "scale");
    const double scale = value != NULL ? json_number_value(value) : 1.0;
    if (!(scale > 1e-9 && scale < 1e9)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, "scale", "is no scale; give metres a unit, such as 0.01");
        return false;
    }
    input->scale = value != NULL ? (float)scale : input->scale;
    return json->result == TL_OK;
}

static bool take_input(tl_json_reader *json, const tl_json_place *at, const char *path, tl_world_input *input)
{
    static const char *const known[] = { "file", "matrix", "translate", "up", "scale", "area", "areas", NULL };
    if (!tl_json_keys_are_known(json, at, known)) {
        return false;
    }
    const char *file = tl_json_string(json, at, "file");
    if (file == NULL || file[0] == '\0') {
        tl_json_fail(json, TL_ERR_FORMAT, at, "file", "is missing: it names a mesh file");
        return false;
    }
    input->path = tl_world_path_beside(path, file);
    if (input->path == NULL) {
        tl_json_fail(json, TL_ERR_MEMORY, at, "file", "is too long for the memory");
        return false;
    }
    const json_t *area = json_object_get(at->value, "area");
    return (area == NULL || take_area(json, at, "area", area, &input->area)) && take_rules(json, at, input) &&
           take_placing(json, at, input) && take_axes(json, at, input);
}

static void take_inputs(tl_json_reader *json, const tl_json_place *root, const tl_world_reading *reading,
                        tl_world_inputs *inputs)
{
    static const char *const known[] = { "inputs", NULL };
    tl_json_place list, item;
    if (!tl_json_keys_are_known(json, root, known)) {
        return;
    }
    const size_t count = tl_json_list(json, root, "inputs", &list);
    if (count == 0 && json->result == TL_OK) {
        tl_json_fail(json, TL_ERR_EMPTY, root, "inputs", "is empty or missing");
    }
    for (size_t i = 0; i < count && tl_json_item(json, &list, i, &item); i++) {
        tl_world_input *input = tl_world_inputs_push(inputs, reading);
        if (input == NULL) {
            tl_json_fail(json, TL_ERR_MEMORY, root, "inputs", "is too long for the memory");
            return;
        }
        if (!take_input(json, &item, json->name, input)) {
            return;
        }
    }
}

tl_result tl_world_manifest_read(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs,
                                 tl_io_error *error_out)
{
    tl_file_map map;
    const tl_result result = tl_file_read(path, (uint64_t)MANIFEST_MIB << 20, &map, error_out);
    if (result != TL_OK) {
        return result;
    }
    tl_json_reader json = { TL_OK, path, error_out, "see docs/world.md" };
    tl_json_place root;
    if (tl_json_load(&json, map.bytes, map.size, &root) == TL_OK) {
        take_inputs(&json, &root, reading, inputs);
        json_decref(root.value);
    }
    tl_file_map_close(&map);
    return json.result;
}
