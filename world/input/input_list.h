// SPDX-License-Identifier: MIT
//
// What a world is made of: mesh files, each at its place.
//
// INPUT is a mesh file, a folder (its world.json, or else all mesh files in it), or a manifest:
//
//   { "inputs": [
//       { "file": "terrain.stl", "area": 5 },
//       { "file": "house.glb", "translate": [1200, 0, 80], "areas": { "grass*": 7, "water": 0 } },
//       { "file": "tower.obj", "up": "z", "scale": 0.01,
//         "matrix": [1, 0, 0, 12.5,  0, 1, 0, 0,  0, 0, 1, -3] } ] }
//
// A file's name counts from the manifest's folder. "matrix": three rows of four, applied to y-up metres, in double.
// "area": of all its triangles; "areas": by the name of their material, * and ? are wildcards, the first that fits.

#ifndef TALUS_WORLD_INPUT_LIST_H
#define TALUS_WORLD_INPUT_LIST_H

#include "io/mesh/mesh_import.h"

#include <talus/nav_bake.h>

typedef struct tl_world_area_rule {
    char *pattern;
    uint8_t area;
} tl_world_area_rule;

typedef struct tl_world_input {
    char *path;
    bool is_shared;    ///< other inputs are of the same file
    double matrix[12]; ///< three rows of four
    bool is_placed;    ///< the matrix is not that of a file without one
    tl_up_axis up;
    float scale; ///< metres a file unit
    uint8_t area;
    tl_world_area_rule *rules;
    uint32_t rule_count;
} tl_world_input;

typedef struct tl_world_inputs {
    tl_world_input *items;
    uint32_t count, capacity;
} tl_world_inputs;

/// How files are read where no manifest says it.
typedef struct tl_world_reading {
    tl_up_axis up;
    float scale;
} tl_world_reading;

/// TL_ERR_IO, TL_ERR_FORMAT and TL_ERR_ARGUMENT (the manifest, with the place), TL_ERR_EMPTY (no mesh file in a
/// folder), TL_ERR_MEMORY. Free with tl_world_inputs_free in any case.
tl_result tl_world_inputs_read(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs_out,
                               tl_io_error *error_out);
void tl_world_inputs_free(tl_world_inputs *inputs);

/// For the readers of lists: a new input, with the default placing and no path. NULL: out of memory.
tl_world_input *tl_world_inputs_push(tl_world_inputs *inputs, const tl_world_reading *reading);
/// `name` in the folder of `beside`; an absolute `name` stays. Freed with free(); NULL: out of memory.
char *tl_world_path_beside(const char *beside, const char *name);
/// Reads a manifest.
tl_result tl_world_manifest_read(const char *path, const tl_world_reading *reading, tl_world_inputs *inputs,
                                 tl_io_error *error_out);

/// The area of a material's triangles.
uint8_t tl_world_input_area(const tl_world_input *input, const char *material);

#endif
