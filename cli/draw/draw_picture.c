// SPDX-License-Identifier: MIT

#include "cli/draw/draw_picture.h"

#include "cli/draw/draw_sheet.h"
#include "cli/draw/draw_stage.h"

#include <stdio.h>
#include <string.h>

const char *draw_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

void draw_picture_begin(const draw_source *source, const char *what, draw_scene *scene)
{
    draw_scene_init(scene, source->bounds);
    snprintf(scene->title, sizeof scene->title, "%s: %s", draw_file_name(source->input.path), what);
    // Coarse polygons dip under the ground between their corners. What is less than an agent's height above them is
    // their own floor, not one overhead.
    scene->overlay_bias = 0.95f * source->nav_def.agent_height;
    draw_add_backdrop(scene, &source->mesh);
}

bool draw_picture_end(draw_source *source, draw_scene *scene, uint32_t size, const char *path, tl_exit *exit_out)
{
    const draw_options options = { true, true, size };
    tl_io_error error;
    memset(&error, 0, sizeof error);
    const bool written = draw_sheet_write(scene, &options, path, &source->cli->host, &error) == TL_OK;
    if (!written) {
        *exit_out = tl_cli_fail_io(source->cli, &error);
    }
    draw_scene_free(scene);
    return written;
}
