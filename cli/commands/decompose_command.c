// SPDX-License-Identifier: MIT
//
// talus decompose: a mesh into convex parts, measured and written.

#include "cli/level/load_level.h"
#include "cli/options/output_check.h"
#include "cli/shapes/decompose_files.h"
#include "cli/shared/json_out.h"

#include <talus/decompose.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *decomposition_json(const tl_decomposition *d, const tl_decompose_report *report)
{
    json_t *parts = json_array();
    for (uint32_t i = 0; i < d->part_count; ++i) {
        const tl_convex_part *part = &d->parts[i];
        json_array_append_new(parts, json_pack("{sI sI so so so}", "vertices", (json_int_t)part->hull->vertex_count,
                                               "faces", (json_int_t)part->hull->face_count, "volume",
                                               tl_json_double(part->hull->mass.volume), "concavity",
                                               tl_json_double(part->concavity), "max_outside",
                                               tl_json_double(part->max_outside)));
    }
    return json_pack("{so so so so so sI sI sI so}", "tolerance", tl_json_double((double)report->tolerance),
                     "concavity", tl_json_double(d->concavity), "max_outside", tl_json_double(d->max_outside), "volume",
                     tl_json_double(d->hull_volume), "cell", tl_json_double((double)report->cell), "cuts",
                     (json_int_t)report->cut_count, "parts_before_merging", (json_int_t)report->parts_before_merging,
                     "parts_over_tolerance", (json_int_t)report->parts_over_tolerance, "parts", parts);
}

static void print_decomposition(const tl_decomposition *d, const tl_decompose_report *report)
{
    uint32_t vertices = 0;
    for (uint32_t i = 0; i < d->part_count; ++i) {
        vertices += d->parts[i].hull->vertex_count;
    }
    printf("parts      %u\nvertices   %u\nvolume     %.6g\n", d->part_count, vertices, d->hull_volume);
    printf("tolerance  %.6g\nconcavity  %.6g\noutside    %.3g\n", (double)report->tolerance, d->concavity,
           d->max_outside);
    if (report->parts_over_tolerance > 0) {
        printf("%u parts reach farther from the body than the tolerance\n", report->parts_over_tolerance);
    }
}

static tl_exit decompose_level(tl_cli *cli, const tl_level *level, tl_decompose_def *def, float apart,
                               const char *output)
{
    const tl_mesh_view view = tl_level_source_view(level);
    tl_decomposition decomposition;
    tl_decompose_report report;
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    def->host = cli->host;
    const tl_result result = tl_decomposition_bake(&view, def, &decomposition, &report);
    tl_progress_end(&cli->progress);
    if (result != TL_OK) {
        return tl_cli_fail_result(cli, cli->arguments.words[0], result, &report.base);
    }
    tl_exit code = TL_EXIT_OK;
    if (output != NULL &&
        tl_decomposition_write(&decomposition, apart, output, cli->arguments.words[0], &cli->host, &error) != TL_OK) {
        code = tl_cli_fail_io(cli, &error);
    } else if (output != NULL && strcmp(output, "-") == 0) {
        code = TL_EXIT_OK; // the parts themselves went to standard output
    } else if (cli->json) {
        json_t *object = decomposition_json(&decomposition, &report);
        if (output != NULL) {
            json_object_set_new(object, "output", tl_json_text(output));
        }
        code = tl_cli_print_json(cli, object);
    } else {
        print_decomposition(&decomposition, &report);
    }
    tl_decomposition_free(&decomposition);
    return code;
}

static tl_exit run_decompose(tl_cli *cli)
{
    const char *output = NULL;
    float apart = 0.0f;
    bool surface = false;
    tl_decompose_def def = tl_default_decompose_def();
    tl_level_settings settings = tl_default_level_settings();
    static const char *const endings[] = { ".obj", ".png", ".svg", NULL };
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE", "where to write the parts: objects, or a picture of them",
          endings, 0, 0, 0, 0 },
        { "tolerance", 't', TL_OPTION_FLOAT, &def.tolerance, "M",
          "metres: the concavity a part may have; 0: as --relative-tolerance says", NULL, 0, 1e6f, 0, 0 },
        { "relative-tolerance", 0, TL_OPTION_FLOAT, &def.relative_tolerance, "R",
          "share of the longest side of the mesh's box", NULL, 1e-6f, 1.0f, 0, 0 },
        { "max-parts", 0, TL_OPTION_COUNT, &def.max_parts, "N", "most parts, beyond the tolerance; 0: no limit", NULL,
          0, 0, 0, 0 },
        { "max-vertices", 0, TL_OPTION_COUNT, &def.max_vertices, "N", "most vertices of a part, from 4; 0: no limit",
          NULL, 0, 0, 0, 0 },
        { "thickness", 0, TL_OPTION_FLOAT, &def.thickness, "M",
          "metres, of flat parts, at most the tolerance; 0: a sixteenth of it", NULL, 0, 1e6f, 0, 0 },
        { "surface", 0, TL_OPTION_FLAG, &surface, NULL, "what the mesh encloses is open, not solid", NULL, 0, 0, 0, 0 },
        { "max-cells", 0, TL_OPTION_COUNT, &def.max_cells, "N", "most cells of the grid that guides the cuts", NULL, 0,
          0, 4096, 67108864 },
        { "apart", 0, TL_OPTION_FLOAT, &apart, "F", "write the parts moved apart, by this share, to look at", NULL, 0,
          100.0f, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_option level_options[TL_LEVEL_OPTIONS];
    tl_level_options(&settings, level_options);
    const tl_option_group groups[] = { { "Options:", options }, { "The mesh:", level_options }, { NULL, NULL } };
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 1, 1, &code)) {
        return code;
    }
    def.solid = surface ? TL_SOLID_SURFACE : TL_SOLID_ENCLOSED;
    tl_level level;
    if (tl_level_load(cli, cli->arguments.words[0], &settings, &level, &code)) {
        code = decompose_level(cli, &level, &def, apart, output);
    }
    tl_level_free(&level);
    return code;
}

const tl_command tl_decompose_command = {
    "decompose",
    "Convex hulls",
    "divide a mesh into convex parts",
    "MESH [-o PARTS.obj|PICTURE.png] [options]",
    "Divides a mesh into few convex parts, none of which reaches farther from the mesh, or from what it\n"
    "encloses, than a tolerance. Prints how many there are, and two bounds: how far the parts reach beyond\n"
    "the mesh (concavity), and how far the mesh reaches beyond the parts (outside).",
    "talus sample dungeon -o dungeon.obj\n"
    "talus decompose dungeon.obj --surface --tolerance 2 -o parts.obj\n"
    "talus decompose dungeon.obj --surface --tolerance 2 --apart 0.5 -o parts.png\n"
    "talus decompose dungeon.obj --surface --max-parts 8 --tolerance 2 --json",
    run_decompose,
};
