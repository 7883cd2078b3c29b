// SPDX-License-Identifier: MIT
//
// A picture of a level with something on it, as audit and links draw theirs.

#ifndef TALUS_CLI_DRAW_PICTURE_H
#define TALUS_CLI_DRAW_PICTURE_H

#include "cli/draw/draw_scene.h"
#include "cli/draw/draw_source.h"

/// What stands before the colon of a title: the name without its folders.
const char *draw_file_name(const char *path);

/// Begins it: the title is FILE: `what`, the backdrop are the level's triangles. Needs the source's mesh.
void draw_picture_begin(const draw_source *source, const char *what, draw_scene *scene);

/// Writes both views, `size` pixels wide or high each, to `path`, and frees the scene. False: reported.
bool draw_picture_end(draw_source *source, draw_scene *scene, uint32_t size, const char *path, tl_exit *exit_out);

#endif
