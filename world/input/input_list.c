// SPDX-License-Identifier: MIT

#include "world/input/input_list.h"

#include "world/bytes/folder.h"

#include <stdlib.h>
#include <string.h>

static tl_result out_of_memory(const char *path, tl_io_error *error_out)
{
    return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
}

tl_world_input *tl_world_inputs_push(tl_world_inputs *inputs, const tl_world_reading *reading)
{
    if (inputs->count == inputs->capacity) {
        const uint32_t wanted = inputs->capacity > 0 ? 2 * inputs->capacity : 16;
        tl_world_input *grown =
            wanted > inputs->capacity ? realloc(inputs->items, (size_t)wanted * sizeof *grown) : NULL;
        if (grown == NULL) {
            return NULL;
        }
        inputs->items = grown;
        inputs->capacity = wanted;
    }
    tl_world_input *input = &inputs->items[inputs->count++];
    memset(input, 0, sizeof *input);
    input->matrix[0] = input->matrix[5] = input->matrix[10] = 1.0;
    input->up = reading->up;
    input->scale = reading->scale;
    input->area = TL_NAV_WALKABLE_AREA;
    return input;
}

void tl_world_inputs_free(tl_world_inputs *inputs)
{
    for (uint32_t i = 0; i < inputs->count; i++) {
        for (uint32_t k = 0; k < inputs->items[i].rule_count; k++) {
            free(inputs->items[i].rules[k].pattern);
        }
        free(inputs->items[i].rules);
        free(inputs->items[i].path);
    }
    free(inputs->items);
    memset(inputs, 0, sizeof *inputs);
}

char *tl_world_path_beside(const char *beside, const char *name)
{
    const char *slash = strrchr(beside, '/');
    const bool is_absolute = name[0] == '/' || (name[0] != '\0' && name[1] == ':');
    const size_t folder = slash != NULL && !is_absolute ? (size_t)(slash - beside) + 1 : 0, length = strlen(name) + 1;
    char *path = malloc(folder + length);
    if (path != NULL) {
        memcpy(path, beside, folder);
        memcpy(path + folder, name, length);
    }
    return path;
}

// Wildcards by the greedy method: on a mismatch the last star takes one character more.
static bool matches(const char *pattern, const char *text)
{
    const char *star = NULL, *resume = NULL;
    while (*text != '\0') {
        if (*pattern == '*') {
            star = pattern++;
            resume = text;
        } else if (*pattern == '?' || *pattern == *text) {
            pattern++;
            text++;
        } else if (star != NULL) {
            pattern = star + 1;
            text = ++resume;
        } else {
            return false;
        }
    }
    while (*pattern == '*') {
        pattern++;
    }
    return *pattern == '\0';
}

uint8_t tl_world_input_area(const tl_world_input *input, const char *material)
{
    for (uint32_t i = 0; i < input->rule_count; i++) {
        if (matches(input->rules[i].pattern, material)) {
            return input->rules[i].area;
        }
    }
    return input->area;
}

typedef struct folder_reading {
    const char *folder; // with a slash at its end
    const tl_world_reading *reading;
    tl_world_inputs *inputs;
    tl_io_error *error;
} folder_reading;

static tl_result take_entry(const char *name, void *user)
{
    folder_reading *all = user;
    if (!tl_import_is_mesh_name(name)) {
        return TL_OK;
    }
    tl_world_input *input = tl_world_inputs_push(all->inputs, all->reading);
    if (input != NULL) {
        input->path = tl_world_path_beside(all->folder, name);
    }
    return input != NULL && input->path != NULL ? TL_OK : out_of_memory(all->folder, all->error);
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(((const tl_world_input *)a)->path, ((const tl_world_input *)b)->path);
}

static tl_result read_folder(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs,
                             tl_io_error *error_out)
{
    const size_t length = strlen(path);
    char *folder = malloc(length + 2);
    if (folder == NULL) {
        return out_of_memory(path, error_out);
    }
    memcpy(folder, path, length);
    memcpy(folder + length, "/", 2);
    char *manifest = tl_world_path_beside(folder, "world.json");
    tl_result result;
    if (manifest == NULL) {
        result = out_of_memory(path, error_out);
    } else if (tl_file_look(manifest, NULL)) {
        result = tl_world_manifest_read(manifest, reading, inputs, error_out);
    } else {
        folder_reading all = { folder, reading, inputs, error_out };
        result = tl_folder_list(path, take_entry, &all, error_out);
        if (result == TL_OK && inputs->count == 0) {
            result = tl_io_fail(error_out, TL_ERR_EMPTY, path, 0, "put mesh files or a world.json there",
                                "the folder holds no mesh files");
        }
        if (result == TL_OK) {
            qsort(inputs->items, inputs->count, sizeof *inputs->items, compare_paths);
        }
    }
    free(manifest);
    free(folder);
    return result;
}

static bool is_manifest(const char *path)
{
    const size_t length = strlen(path);
    return length > 5 && strcmp(path + length - 5, ".json") == 0;
}

static tl_result list_inputs(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs_out,
                             tl_io_error *error_out)
{
    tl_file_facts facts;
    if (tl_file_look(path, &facts) && facts.is_folder) {
        return read_folder(path, reading, inputs_out, error_out);
    }
    if (is_manifest(path)) {
        return tl_world_manifest_read(path, reading, inputs_out, error_out);
    }
    tl_world_input *input = tl_world_inputs_push(inputs_out, reading);
    if (input == NULL || (input->path = tl_world_path_beside("", path)) == NULL) {
        return out_of_memory(path, error_out);
    }
    return TL_OK;
}

static int compare_shared(const void *a, const void *b)
{
    return compare_paths(*(const tl_world_input *const *)a, *(const tl_world_input *const *)b);
}

static tl_result mark_shared(const char *path, tl_world_inputs *inputs, tl_io_error *error_out)
{
    tl_world_input **sorted = malloc(((size_t)inputs->count + 1) * sizeof *sorted);
    if (sorted == NULL) {
        return out_of_memory(path, error_out);
    }
    for (uint32_t i = 0; i < inputs->count; i++) {
        sorted[i] = &inputs->items[i];
    }
    qsort(sorted, inputs->count, sizeof *sorted, compare_shared);
    for (uint32_t i = 1; i < inputs->count; i++) {
        if (compare_paths(sorted[i - 1], sorted[i]) == 0) {
            sorted[i - 1]->is_shared = sorted[i]->is_shared = true;
        }
    }
    free(sorted);
    return TL_OK;
}

tl_result tl_world_inputs_read(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs_out,
                               tl_io_error *error_out)
{
    memset(inputs_out, 0, sizeof *inputs_out);
    const tl_result result = list_inputs(path, reading, inputs_out, error_out);
    return result == TL_OK ? mark_shared(path, inputs_out, error_out) : result;
}
