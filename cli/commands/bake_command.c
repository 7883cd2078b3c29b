// SPDX-License-Identifier: MIT
//
// talus bake: a level to a baked file, and a table of what it took.

#include "cli/level/bake_level.h"
#include "cli/level/level_doubt.h"
#include "cli/level/write_pack.h"
#include "cli/shared/json_out.h"
#include "cli/shared/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// The report.

typedef struct bake_result {
    const tl_level *level;
    const tl_bake *bake;
    const tl_bake_settings *settings;
    const char *output; // NULL: nothing was written
    uint64_t file_bytes;
    double seconds;
    tl_level_doubt empty; // why nothing is walkable; without a cause when something is
} bake_result;

static uint64_t blob_bytes(const void *blob)
{
    return blob != NULL ? ((const tl_blob *)blob)->size : 0;
}

static uint64_t tile_bytes(const tl_bake *bake)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < bake->tiles.tile_count; ++i) {
        bytes += blob_bytes(bake->tiles.tiles[i]);
    }
    return bytes;
}

// What a stage made: its count and what was counted.
typedef struct stage_count {
    const char *stage;
    const char *what;
    uint64_t count;
    uint64_t bytes;
} stage_count;

enum { STAGE_COUNTS = 19 };

static uint32_t collect_counts(const bake_result *r, stage_count out[STAGE_COUNTS])
{
    const tl_nav_bake_report *nav = &r->bake->nav_report;
    const stage_count counts[STAGE_COUNTS] = {
        { "read mesh", "triangles", r->level->imported.triangle_count, r->level->imported.source_bytes },
        { "weld", "vertices", r->level->mesh.vertex_count, 0 },
        { "clean", "triangles", r->level->mesh.triangle_count, 0 },
        { "pair triangles", "pairs", r->bake->soup_report.pair_count, 0 },
        { "bake soup", "triangles", r->bake->soup_report.triangle_count, blob_bytes(r->bake->soup) },
        { "hull", "vertices", r->bake->hull != NULL ? r->bake->hull->vertex_count : 0, blob_bytes(r->bake->hull) },
        { "rasterize", "spans", nav->span_count, 0 },
        { "compact", "floors", nav->compact_span_count, 0 },
        { "regions", "regions", nav->region_count, 0 },
        { "contours", "contours", nav->contour_count, 0 },
        { "polygons", "polygons", nav->polygon_count, 0 },
        { "detail", "triangles", nav->detail_triangle_count, 0 },
        { "tile", "polygons", nav->polygon_count, tile_bytes(r->bake) },
        { "tiles", "tiles", nav->tile_count, tile_bytes(r->bake) },
        { "prune", "islands", r->bake->pruned.island_count, 0 },
        { "ledges", "places", r->bake->links.report.sample_count, 0 },
        { "selection", "links", r->bake->links.links != NULL ? r->bake->links.links->link_count : 0,
          blob_bytes(r->bake->links.links) },
        { "write", "", 0, r->file_bytes },
    };
    memcpy(out, counts, sizeof(counts));
    return STAGE_COUNTS - 1;
}

static const stage_count *count_of(const stage_count *counts, uint32_t count, const char *stage)
{
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(counts[i].stage, stage) == 0) {
            return &counts[i];
        }
    }
    return NULL;
}

static void print_table(const tl_cli *cli, const bake_result *r)
{
    tl_table table;
    memset(&table, 0, sizeof(table));
    stage_count counts[STAGE_COUNTS];
    uint32_t count = collect_counts(r, counts);
    tl_table_row(&table);
    tl_table_text(&table, "stage");
    tl_table_text(&table, "time");
    tl_table_text(&table, "count");
    tl_table_blank(&table);
    tl_table_text(&table, "bytes");
    for (uint32_t i = 0; i < cli->progress.time_count; ++i) {
        const tl_stage_time *time = &cli->progress.times[i];
        const stage_count *entry = count_of(counts, count, time->stage);
        tl_table_row(&table);
        tl_table_text(&table, time->stage);
        tl_table_seconds(&table, time->seconds);
        if (entry != NULL && entry->what[0] != '\0') {
            tl_table_count(&table, entry->count);
            tl_table_text(&table, entry->what);
        } else {
            tl_table_blank(&table);
            tl_table_blank(&table);
        }
        if (entry != NULL && entry->bytes > 0) {
            tl_table_bytes(&table, entry->bytes);
        }
    }
    tl_table_row(&table);
    tl_table_text(&table, "all");
    tl_table_seconds(&table, r->seconds);
    tl_table_print(&table);
}

static void print_pruned(const tl_nav_pruned *pruned, const char *why)
{
    if (pruned->islands > 0) {
        printf("left out %u islands, %llu polygons, %.1f m2: %s\n", pruned->islands,
               (unsigned long long)pruned->polygons, pruned->area, why);
    }
}

// What was walkable and is not in the navmesh.
static void print_left_out(const tl_bake *bake)
{
    const tl_nav_bake_report *nav = &bake->nav_report;
    if (nav->filtered_regions > 0) {
        printf("left out %u islands, %llu floors, %.1f m2: fewer cells than --region-min-size squared\n",
               nav->filtered_regions, (unsigned long long)nav->filtered_spans, nav->filtered_area);
    }
    print_pruned(&bake->pruned.inside, "inside solids");
    print_pruned(&bake->pruned.unreachable, "not reachable from --reachable-from");
    print_pruned(&bake->pruned.small, "smaller than --island-min-area");
    if (nav->unbridged_holes > 0) {
        printf("holes    %u became floor, since no bridge to their outline was found\n", nav->unbridged_holes);
    }
    if (nav->limited_patches > 0) {
        printf("detail   %u polygons are too large for the height detail asked for\n", nav->limited_patches);
    }
}

// Triangles that the navmesh is baked without.
static void print_cleaned(const tl_level *level)
{
    const tl_mesh_report *report = &level->report;
    const uint32_t dropped = report->degenerate_triangles + report->duplicate_triangles;
    if (dropped > 0) {
        printf("dropped  %u of %u triangles: %u without area in floats, %u that repeat another\n", dropped,
               level->imported.triangle_count, report->degenerate_triangles, report->duplicate_triangles);
    }
}

static void print_bake_summary(const tl_pack_frame *frame, const bake_result *r)
{
    const tl_bake *bake = r->bake;
    printf("\n");
    if (frame != NULL) {
        printf("points   are given and answered as in the level: %s up, 0,0,0 inside is %.15g,%.15g,%.15g\n",
               tl_level_axes_name((tl_pack_axes)frame->axes), frame->origin[0], frame->origin[1], frame->origin[2]);
    }
    print_cleaned(r->level);
    if (bake->soup != NULL) {
        tl_soup_stats stats = tl_soup_get_stats(bake->soup);
        printf("soup     %u triangles, %.1f%% paired, %.1f bytes a triangle\n", stats.triangle_count,
               200.0 * stats.pair_count / (stats.triangle_count - stats.coincident_count),
               (double)stats.size / stats.triangle_count);
    }
    if (bake->hull != NULL) {
        printf("hull     %u vertices, %u faces\n", bake->hull->vertex_count, bake->hull->face_count);
    }
    if (r->settings->nav && bake->walkable) {
        const bool layered = bake->nav_def.tile_height > 0.0f; // then a place may hold several
        printf(layered ? "navmesh  %u polygons, %.1f m2, %u tiles in layers at %u places\n"
                       : "navmesh  %u polygons, %.1f m2, %u of %u tiles\n",
               (unsigned)bake->nav_polygons, bake->nav_area, bake->tiles.tile_count,
               bake->tiles.tiles_x * bake->tiles.tiles_z);
        tl_area_sums_print(&bake->areas);
        print_left_out(bake);
    } else if (r->settings->nav) {
        printf("navmesh  empty: nothing is walkable (%s)\n", r->empty.cause);
        print_left_out(bake);
    }
    if (bake->links.links != NULL) {
        printf("links    %u drops, %u jumps, %u climbs\n", bake->links.links->kind_counts[TL_NAV_LINK_DROP],
               bake->links.links->kind_counts[TL_NAV_LINK_JUMP], bake->links.links->kind_counts[TL_NAV_LINK_CLIMB]);
    }
    if (bake->offmesh != NULL) {
        printf("off-mesh %u links set by hand\n", bake->offmesh->count);
    }
    printf("wrote    %s\n", r->output);
}

static json_t *stages_json(const tl_cli *cli, const bake_result *r)
{
    stage_count counts[STAGE_COUNTS];
    uint32_t count = collect_counts(r, counts);
    json_t *array = json_array();
    for (uint32_t i = 0; i < cli->progress.time_count; ++i) {
        const tl_stage_time *time = &cli->progress.times[i];
        const stage_count *entry = count_of(counts, count, time->stage);
        json_t *object = json_pack("{ss so}", "stage", time->stage, "seconds", tl_json_double(time->seconds));
        if (entry != NULL && entry->what[0] != '\0') {
            json_object_set_new(object, entry->what, json_integer((json_int_t)entry->count));
        }
        if (entry != NULL && entry->bytes > 0) {
            json_object_set_new(object, "bytes", json_integer((json_int_t)entry->bytes));
        }
        json_array_append_new(array, object);
    }
    return array;
}

static json_t *pruned_json(const tl_nav_pruned *pruned)
{
    return json_pack("{sI sI so}", "islands", (json_int_t)pruned->islands, "polygons", (json_int_t)pruned->polygons,
                     "square_metres", tl_json_double(pruned->area));
}

static json_t *left_out_json(const tl_bake *bake)
{
    const tl_nav_bake_report *nav = &bake->nav_report;
    return json_pack("{so so so so sI sI sI}", "small_regions",
                     json_pack("{sI sI so}", "islands", (json_int_t)nav->filtered_regions, "floors",
                               (json_int_t)nav->filtered_spans, "square_metres", tl_json_double(nav->filtered_area)),
                     "inside_solids", pruned_json(&bake->pruned.inside), "unreachable",
                     pruned_json(&bake->pruned.unreachable), "small_islands", pruned_json(&bake->pruned.small),
                     "unbridged_holes", (json_int_t)nav->unbridged_holes, "slit_outlines",
                     (json_int_t)nav->slit_outlines, "limited_patches", (json_int_t)nav->limited_patches);
}

static json_t *result_json(const tl_cli *cli, const bake_result *r)
{
    const tl_bake *bake = r->bake;
    const tl_mesh_report *report = &r->level->report;
    json_t *object = json_pack("{so so so}", "file", tl_json_text(r->level->path), "output", tl_json_text(r->output),
                               "stages", stages_json(cli, r));
    json_object_set_new(object, "seconds", tl_json_double(r->seconds));
    json_object_set_new(object, "bytes", json_integer((json_int_t)r->file_bytes));
    json_object_set_new(object, "bounds", tl_json_placed_bounds(cli->frame, r->level->mesh.bounds));
    json_object_set_new(object, "cleaned",
                        json_pack("{sI sI sI sI}", "welded_vertices", (json_int_t)report->welded_vertices,
                                  "unused_vertices", (json_int_t)report->unused_vertices, "degenerate_triangles",
                                  (json_int_t)report->degenerate_triangles, "duplicate_triangles",
                                  (json_int_t)report->duplicate_triangles));
    const double *origin = r->level->imported.origin;
    json_object_set_new(object, "origin", json_pack("[fff]", origin[0], origin[1], origin[2]));
    json_object_set_new(object, "up", json_string(tl_level_axes_name(r->level->axes)));
    if (bake->soup != NULL) {
        tl_soup_stats stats = tl_soup_get_stats(bake->soup);
        json_object_set_new(object, "soup",
                            json_pack("{sI sI sI sI sI}", "triangles", (json_int_t)stats.triangle_count, "pairs",
                                      (json_int_t)stats.pair_count, "singles", (json_int_t)stats.single_count,
                                      "coincident", (json_int_t)stats.coincident_count, "bytes",
                                      (json_int_t)stats.size));
    }
    if (bake->hull != NULL) {
        json_object_set_new(object, "hull",
                            json_pack("{sI sI sI}", "vertices", (json_int_t)bake->hull->vertex_count, "faces",
                                      (json_int_t)bake->hull->face_count, "bytes", (json_int_t)bake->hull->blob.size));
    }
    if (r->settings->nav) {
        const tl_nav_bake_report *nav = &bake->nav_report;
        json_object_set_new(object, "navmesh",
                            json_pack("{sb sI sI so sI sI sI}", "walkable", (int)bake->walkable, "tiles",
                                      (json_int_t)bake->tiles.tile_count, "polygons", (json_int_t)bake->nav_polygons,
                                      "area", tl_json_double(bake->nav_area), "regions", (json_int_t)nav->region_count,
                                      "repaired_contours", (json_int_t)nav->repaired_contours, "bytes",
                                      (json_int_t)tile_bytes(bake)));
        json_object_set_new(json_object_get(object, "navmesh"), "areas", tl_area_sums_json(&bake->areas));
        json_object_set_new(json_object_get(object, "navmesh"), "left_out", left_out_json(bake));
        if (r->empty.cause != NULL) {
            json_object_set_new(json_object_get(object, "navmesh"), "cause", json_string(r->empty.cause));
        }
    }
    if (bake->offmesh != NULL) {
        json_object_set_new(object, "off_mesh", json_integer((json_int_t)bake->offmesh->count));
    }
    if (bake->links.links != NULL) {
        json_object_set_new(object, "links", tl_level_links_json(&bake->links.report));
    }
    return object;
}

static tl_exit print_bake_report(tl_cli *cli, const bake_result *r)
{
    if (cli->json) {
        return tl_cli_print_json(cli, result_json(cli, r));
    }
    print_table(cli, r);
    print_bake_summary(cli->frame, r);
    return TL_EXIT_OK;
}

// ---------------------------------------------------------------------------------------------------------

static tl_exit bake_and_write(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, const char *output,
                              double began)
{
    tl_bake bake;
    tl_pack_content content;
    memset(&content, 0, sizeof(content));
    tl_exit code;
    if (tl_bake_level(cli, level, settings, &bake, &code)) {
        bake_result result = { level, &bake, settings, output, 0, 0.0, { NULL, "" } };
        const bool empty = settings->nav && !bake.walkable;
        if (empty) {
            result.empty = tl_level_explain_empty(cli, level, settings, &bake.nav_report, &bake.pruned);
        }
        tl_result made = tl_pack_content_of_bake(level, &bake, settings->nav, &content);
        code = made == TL_OK ? tl_pack_content_write(cli, output, &content, &result.file_bytes)
                             : tl_cli_fail_result(cli, output, made, NULL);
        tl_progress_end(&cli->progress);
        result.seconds = tl_clock_seconds() - began;
        if (code == TL_EXIT_OK && strcmp(output, "-") != 0) {
            code = print_bake_report(cli, &result);
        }
        if (code == TL_EXIT_OK && empty) {
            code = tl_cli_fail(cli, TL_EXIT_EMPTY, "%s: nothing is walkable (%s): %s", level->path, result.empty.cause,
                               result.empty.text);
        }
    }
    tl_pack_content_free(&content);
    tl_bake_free(&bake);
    return code;
}

static tl_exit run_bake(tl_cli *cli)
{
    const char *output = NULL;
    tl_bake_settings settings = tl_default_bake_settings();
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE", "where to write; required", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_option part_options[TL_PART_OPTIONS];
    tl_option level_options[TL_LEVEL_OPTIONS];
    tl_option nav_options[TL_NAV_OPTIONS];
    tl_option link_options[TL_LINK_OPTIONS];
    tl_part_options(&settings, part_options);
    tl_link_options(&settings.links_def, link_options);
    tl_level_options(&settings.level, level_options);
    tl_nav_options(&settings, nav_options);
    const tl_option_group groups[] = {
        { "Options:", options },     { "What is baked:", part_options }, { "How the level is read:", level_options },
        { "Navmesh:", nav_options }, { "With --links:", link_options },  { NULL, NULL }
    };
    cli->speaks_frame = true;
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 1, 1, &code) || !tl_bake_take_bounds(cli, &settings, &code)) {
        return code;
    }
    if (output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o FILE.talus");
    }
    if (!settings.soup && !settings.nav && !settings.hull) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--no-soup and --no-nav leave nothing to bake; add --hull");
    }
    if (settings.links && !(settings.soup && settings.nav)) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           "--links needs triangles and a navmesh; leave out --no-soup and --no-nav");
    }
    double began = tl_clock_seconds();
    tl_level level;
    if (tl_level_load(cli, cli->arguments.words[0], &settings.level, &level, &code)) {
        code = bake_and_write(cli, &level, &settings, output, began);
    }
    tl_level_free(&level);
    return code;
}

const tl_command tl_bake_command = {
    "bake",
    "Levels",
    "bake a level into one file for rays, shapes and paths",
    "LEVEL -o OUT.talus [options]",
    "Reads a level (OBJ, glTF, GLB, FBX, STL, PLY, DAE; - is standard input), bakes a BVH over its triangles\n"
    "for rays and shapes, and a navmesh for paths, and writes both to one file. Prints what each stage made\n"
    "and how long it took. The same level and options give the same bytes on every machine. When no place of\n"
    "the level is walkable, the file holds no navmesh, and the command says why and exits with 6.\n"
    "\n"
    "Options may be written as users of Recast know them: --cs, --cellSize, --walkableSlopeAngle. Where\n"
    "Recast counts cells and talus takes metres, a message names the option and its unit.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus bake courtyard.obj -o courtyard.talus --agent-radius 0.4 --agent-height 1.8 --tile-size 64\n"
    "talus bake courtyard.obj -o linked.talus --links --drop 5 --jump 2.5\n"
    "(echo 'usemtl grass'; cat courtyard.obj) > park.obj\n"
    "echo 'box 0 18 -1 18 22 3 22' > areas.txt\n"
    "talus bake park.obj -o park.talus --area 'gr*=5' --areas areas.txt\n"
    "talus bake courtyard.obj -o ladder.talus --link 2,0,20,20,5,20\n"
    "echo '{\"links\": [{\"start\": [2,0,20], \"end\": [20,5,20], \"both_ways\": true}]}' > links.json\n"
    "talus bake courtyard.obj -o ladder.talus --link-file links.json\n"
    "talus bake courtyard.obj -o rays.talus --up z --scale 0.01 --no-nav --json",
    run_bake,
};
