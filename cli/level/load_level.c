// SPDX-License-Identifier: MIT
//
// Two views of one level: the cleaned mesh, which the navmesh is built from, and the source's own triangle list, whose
// indices rays must report. Without welding the second is the file as read; with it, the welded vertices are put back
// under the source's triangles.

#include "cli/level/load_level.h"

#include "cli/options/parse_value.h"
#include "io/text/format_float.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const axes_names[] = { "y", "z", "y-left", "z-left", NULL }; // as tl_up_axis and tl_pack_axes

const char *tl_level_axes_name(tl_pack_axes axes)
{
    return axes_names[axes];
}

tl_level_settings tl_default_level_settings(void)
{
    tl_level_settings settings = { TL_UP_Y, 1.0f, 0.0f, NULL };
    return settings;
}

void tl_level_options(tl_level_settings *settings, tl_option table[TL_LEVEL_OPTIONS])
{
    const tl_option options[TL_LEVEL_OPTIONS] = {
        { "up", 0, TL_OPTION_CHOICE, &settings->up, NULL,
          "the level's axis that points up, left where its axes are left-handed; points are given and answered in them",
          axes_names, 0, 0, 0, 0 },
        { "scale", 0, TL_OPTION_FLOAT, &settings->scale, "S", "metres per unit of the file: 0.01 for centimetres", NULL,
          1e-9f, 1e9f, 0, 0 },
        { "weld", 0, TL_OPTION_FLOAT, &settings->weld, "M", "metres: vertices no farther apart become one", NULL, 0.0f,
          1e6f, 0, 0 },
        { "origin", 0, TL_OPTION_TEXT, &settings->origin, "X,Y,Z|auto",
          "the point of the file that becomes 0,0,0 inside, in its own units and axes, so that floats are fine enough; "
          "auto: the level's middle when it lies far out. Points are given and answered in the file's coordinates",
          NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

bool tl_level_import_options(tl_cli *cli, const tl_level_settings *settings, tl_import_options *options_out,
                             tl_exit *exit_out)
{
    *options_out = tl_default_import_options();
    options_out->up_axis = (tl_up_axis)settings->up;
    options_out->unit_scale = settings->scale;
    options_out->host = cli->host;
    options_out->auto_origin = settings->origin != NULL && strcmp(settings->origin, "auto") == 0;
    if (settings->origin == NULL || options_out->auto_origin) {
        return true;
    }
    const char *reason = tl_parse_double_triple(settings->origin, options_out->origin);
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--origin: '%s' %s; give x,y,z, or auto", settings->origin, reason);
    }
    return reason == NULL;
}

// The mesh report names elements of the import; a vertex or triangle is easier found by its line.
static tl_exit fail_mesh(tl_cli *cli, const tl_level *level, tl_result result)
{
    const tl_report *report = &level->report.base;
    const tl_imported_mesh *imported = &level->imported;
    bool triangle = report->element != NULL && strcmp(report->element, "triangle") == 0 &&
                    report->element_index < imported->triangle_count;
    if (triangle && imported->source_lines != NULL && imported->source_lines[report->element_index] > 0) {
        char place[TL_IO_PATH_BYTES + 16];
        snprintf(place, sizeof(place), "%s:%u", level->path, imported->source_lines[report->element_index]);
        return tl_cli_fail_result(cli, place, result, report);
    }
    if (result == TL_ERR_EMPTY) {
        return tl_cli_fail(
            cli, TL_EXIT_DATA,
            "%s: none of the %u triangles has area, so there is nothing to stand on or to hit; check the "
            "export, or its --scale",
            level->path, imported->triangle_count);
    }
    return tl_cli_fail_result(cli, level->path, result, report);
}

static bool restore_source(tl_level *level)
{
    const tl_mesh *mesh = &level->mesh;
    size_t corners = 3 * (size_t)level->imported.triangle_count;
    level->source_indices = calloc(corners, sizeof(uint32_t));
    if (level->source_indices == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        memcpy(level->source_indices + 3 * (size_t)mesh->source_triangles[i], mesh->indices + 3 * (size_t)i,
               3 * sizeof(uint32_t));
    }
    return true;
}

tl_vec3 tl_level_enter_half(const tl_cli *cli, tl_vec3 half)
{
    return cli->frame != NULL ? tl_abs(tl_pack_turn_in((tl_pack_axes)cli->frame->axes, half)) : half;
}

void tl_level_take_frame(tl_cli *cli, const char *path, tl_pack_axes axes, const double origin[3])
{
    static const char *const turned[] = { "x,y,z", "x,z,-y", "x,y,-z", "x,z,y" };
    const bool moved = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
    cli->frame = NULL;
    memset(&cli->frame_room, 0, sizeof(cli->frame_room));
    if (axes == TL_PACK_AXES_Y_UP && !moved) {
        return;
    }
    cli->frame_room.axes = (uint32_t)axes;
    memcpy(cli->frame_room.origin, origin, sizeof(cli->frame_room.origin));
    if (cli->speaks_frame) {
        cli->frame = &cli->frame_room;
    } else {
        tl_cli_warn(cli,
                    "%s: coordinates here are y-up and right-handed, from the level's origin on: a point (x, y, z) of "
                    "it, less %.15g,%.15g,%.15g, is %s",
                    path, origin[0], origin[1], origin[2], turned[axes]);
    }
}

bool tl_level_load(tl_cli *cli, const char *path, const tl_level_settings *settings, tl_level *level_out,
                   tl_exit *exit_out)
{
    memset(level_out, 0, sizeof(*level_out));
    level_out->path = path;
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_import_options options;
    if (!tl_level_import_options(cli, settings, &options, exit_out)) {
        return false;
    }
    if (tl_import_mesh(path, &options, &level_out->imported, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
        return false;
    }
    level_out->axes = (tl_pack_axes)settings->up;
    char digits[TL_FLOAT_TEXT_BYTES]; // the scale as it was given: 0.001, not the float next to it
    tl_format_float(settings->scale, digits);
    const double scale = strtod(digits, NULL);
    for (int i = 0; i < 3; i++) {
        level_out->origin[i] = level_out->imported.origin[i] * scale;
    }
    tl_level_take_frame(cli, path, level_out->axes, level_out->origin);
    tl_mesh_view view = tl_imported_mesh_as_view(&level_out->imported);
    tl_mesh_def def = tl_default_mesh_def();
    def.weld_tolerance = settings->weld;
    def.host = cli->host;
    tl_result result = tl_mesh_bake(&view, &def, &level_out->mesh, &level_out->report);
    if (result != TL_OK) {
        *exit_out = fail_mesh(cli, level_out, result);
        return false;
    }
    if (settings->weld > 0.0f && !restore_source(level_out)) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "%s: out of memory", path);
        return false;
    }
    return true;
}

void tl_level_free(tl_level *level)
{
    tl_imported_mesh_free(&level->imported);
    tl_mesh_free(&level->mesh);
    free(level->source_indices);
    memset(level, 0, sizeof(*level));
}

tl_mesh_view tl_level_source_view(const tl_level *level)
{
    tl_mesh_view view = tl_imported_mesh_as_view(&level->imported);
    if (level->source_indices != NULL) {
        view.vertices = level->mesh.vertices;
        view.vertex_count = level->mesh.vertex_count;
        view.indices = level->source_indices;
    }
    return view;
}
