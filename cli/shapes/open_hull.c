// SPDX-License-Identifier: MIT
//
// How hull, support and distance open their input.

#include "cli/shapes/open_hull.h"

#include <string.h>

tl_hull_settings tl_default_hull_settings(void)
{
    tl_hull_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.level = tl_default_level_settings();
    settings.index = UINT32_MAX;
    return settings;
}

void tl_hull_options(tl_hull_settings *settings, tl_option table[TL_HULL_OPTIONS])
{
    static const char *const axes[] = { "y", "z", NULL };
    const tl_option options[TL_HULL_OPTIONS] = {
        { "index", 'i', TL_OPTION_NEEDED_COUNT, &settings->index, "I", "which cloud of a file of several, from 0", NULL,
          0, 0, 0, 0 },
        { "max-vertices", 0, TL_OPTION_COUNT, &settings->max_vertices, "N", "most vertices, from 4; 0: no limit", NULL,
          0, 0, 0, 0 },
        { "tolerance", 0, TL_OPTION_FLOAT, &settings->tolerance, "M",
          "metres: points may lie this far outside, for fewer vertices; 0: none does", NULL, 0, 1e6f, 0, 0 },
        { "thickness", 0, TL_OPTION_FLOAT, &settings->thickness, "M",
          "metres: make flat input, a line or a single point this thick; 0: refuse it", NULL, 0, 1e6f, 0, 0 },
        { "weld-distance", 0, TL_OPTION_FLOAT, &settings->weld_distance, "M",
          "metres: leave out corners this close to another; 0: only equal ones", NULL, 0, 1e6f, 0, 0 },
        { "merge-distance", 0, TL_OPTION_FLOAT, &settings->merge_distance, "M",
          "metres: faces this flat are one; 1e-5 of the size undoes rounding; 0: exactly flat", NULL, 0, 1e6f, 0, 0 },
        { "up", 0, TL_OPTION_CHOICE, &settings->level.up, NULL, "a mesh file's axis that points up", axes, 0, 0, 0, 0 },
        { "scale", 0, TL_OPTION_FLOAT, &settings->level.scale, "S", "metres per unit of the file", NULL, 1e-9f, 1e9f, 0,
          0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

bool tl_hull_parse(tl_cli *cli, const tl_option *options, uint32_t max_words, tl_hull_settings *settings,
                   tl_exit *exit_out)
{
    tl_option hull_options[TL_HULL_OPTIONS];
    tl_hull_options(settings, hull_options);
    const tl_option_group groups[] = { { "Options:", options },
                                       { "When the hull is not baked:", hull_options },
                                       { NULL, NULL } };
    return tl_cli_parse(cli, groups, 1, max_words, exit_out) &&
           tl_input_refuse_options(cli, cli->arguments.words[0], hull_options, exit_out);
}

tl_result tl_hull_bake_cloud(tl_cli *cli, const tl_hull_settings *settings, tl_point_cloud cloud, tl_hull **hull_out,
                             tl_hull_report *report_out)
{
    tl_hull_def def = tl_default_hull_def();
    def.max_vertices = settings->max_vertices;
    def.tolerance = settings->tolerance;
    def.thickness = settings->thickness;
    def.weld_distance = settings->weld_distance;
    def.merge_distance = settings->merge_distance;
    def.host = cli->host;
    return tl_hull_bake(cloud.points, cloud.count, &def, hull_out, report_out);
}

tl_exit tl_hull_fail(tl_cli *cli, const char *path, tl_result result, const tl_hull_report *report)
{
    switch (result) {
    case TL_ERR_COINCIDENT:
    case TL_ERR_COLLINEAR:
    case TL_ERR_COPLANAR:
        return tl_cli_fail(cli, TL_EXIT_DATA, "%s: %s, so there is no volume; give --thickness to make it a thin body",
                           path, tl_result_text(result));
    default:
        return tl_cli_fail_result(cli, path, result, &report->base);
    }
}

bool tl_read_clouds(tl_cli *cli, const char *path, const tl_hull_settings *settings, tl_point_clouds *clouds_out,
                    tl_exit *exit_out)
{
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_import_options options;
    if (!tl_level_import_options(cli, &settings->level, &options, exit_out)) {
        return false;
    }
    options.allow_no_triangles = true;
    if (tl_point_clouds_read(path, &options, clouds_out, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
        return false;
    }
    if (settings->index != UINT32_MAX && settings->index >= clouds_out->cloud_count) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--index: %s holds %u clouds; use 0 to %u", path,
                                clouds_out->cloud_count, clouds_out->cloud_count - 1);
        tl_point_clouds_free(clouds_out);
        return false;
    }
    return true;
}

static bool open_baked_hull(tl_cli *cli, const char *path, tl_hull_input *input, tl_exit *exit_out)
{
    if (!tl_input_open_baked(cli, path, &input->baked, exit_out)) {
        return false;
    }
    tl_result result;
    input->hull = tl_input_checked_chunk(&input->baked, TL_PACK_HULL, tl_hull_check, &result);
    if (result == TL_NOT_FOUND) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no hull; bake it with --hull", path);
    } else if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, path, result, NULL);
    }
    return input->hull != NULL;
}

bool tl_hull_open(tl_cli *cli, const char *path, const tl_hull_settings *settings, tl_hull_input *input_out,
                  tl_exit *exit_out)
{
    memset(input_out, 0, sizeof(*input_out));
    if (tl_input_is_baked(path)) {
        const bool is_open = open_baked_hull(cli, path, input_out, exit_out);
        input_out->frame = cli->frame_room;
        return is_open;
    }
    static const double nowhere[3] = { 0.0, 0.0, 0.0 };
    tl_level_take_frame(cli, path, (tl_pack_axes)settings->level.up, nowhere);
    input_out->frame = cli->frame_room;
    tl_point_clouds clouds;
    if (!tl_read_clouds(cli, path, settings, &clouds, exit_out)) {
        return false;
    }
    if (settings->index == UINT32_MAX && clouds.cloud_count > 1) {
        *exit_out =
            tl_cli_fail(cli, TL_EXIT_USAGE, "%s: holds %u clouds; choose one with --index", path, clouds.cloud_count);
        tl_point_clouds_free(&clouds);
        return false;
    }
    tl_point_cloud cloud = tl_point_clouds_get(&clouds, settings->index == UINT32_MAX ? 0 : settings->index);
    tl_result result = tl_hull_bake_cloud(cli, settings, cloud, &input_out->built, &input_out->report);
    input_out->hull = input_out->built;
    input_out->points = cloud.count;
    tl_point_clouds_free(&clouds);
    tl_progress_end(&cli->progress);
    if (result != TL_OK) {
        *exit_out = tl_hull_fail(cli, path, result, &input_out->report);
    }
    return result == TL_OK;
}

void tl_hull_input_close(tl_hull_input *input)
{
    tl_blob_free(input->built);
    tl_input_close(&input->baked);
    memset(input, 0, sizeof(*input));
}
