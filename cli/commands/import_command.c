// SPDX-License-Identifier: MIT
//
// talus import: Detour tiles to a baked file.

#include "cli/level/write_pack.h"
#include "cli/shared/json_out.h"
#include "io/files/file_map.h"

#include <talus/nav_detour.h>

#include <stdio.h>
#include <string.h>

static tl_result make_imported_content(const char *path, const tl_detour_tiles *tiles, tl_pack_content *content)
{
    tl_result result = tl_pack_content_make(tiles->tile_count + 2, content);
    if (result != TL_OK) {
        return result;
    }
    const tl_nav_tile *model = tiles->tiles[0];
    tl_aabb bounds = tl_aabb_empty();
    int32_t max_x = 0, max_z = 0;
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        const tl_nav_tile *tile = tiles->tiles[i];
        bounds = tl_aabb_union(bounds, tile->bounds);
        max_x = tile->tile_x > max_x ? tile->tile_x : max_x;
        max_z = tile->tile_z > max_z ? tile->tile_z : max_z;
    }
    bounds.min = tl_min(bounds.min, model->origin);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = model->cell_size;
    def.cell_height = model->cell_height;
    def.agent_height = model->agent_height;
    def.agent_radius = model->agent_radius;
    def.agent_max_climb = model->agent_max_climb;
    def.tile_size = model->tile_size;
    result = tl_pack_meta_encode(tl_pack_source_name(path), 0, 0, bounds, NULL, &content->meta, NULL);
    if (result == TL_OK) {
        def.bounds = bounds;
        result = tl_pack_navmesh_encode(&def, (uint32_t)max_x + 1, (uint32_t)max_z + 1, tiles->tile_count, NULL,
                                        &content->navmesh, NULL);
    }
    if (result == TL_OK) {
        tl_pack_content_add(content, TL_PACK_META, 0, content->meta);
        tl_pack_content_add(content, TL_PACK_NAVM, 0, content->navmesh);
        for (uint32_t i = 0; i < tiles->tile_count; i++) {
            tl_pack_content_add(content, TL_PACK_NAVT, i, tiles->tiles[i]);
        }
    }
    return result;
}

// What could not be taken as it came is said, not kept.
static void warn_of_losses(tl_cli *cli, const char *path, const tl_detour_report *report)
{
    if (report->dropped_polygons > 0) {
        tl_cli_warn(cli, "%s: %u polygons without area or not convex were left out", path, report->dropped_polygons);
    }
    if (report->one_way_links > 0) {
        tl_cli_warn(cli, "%s: %u links lead one way only; they are walls now", path, report->one_way_links);
    }
    if (report->off_mesh_links > 0) {
        tl_cli_warn(cli, "%s: %u off-mesh connections were left out: a baked file keeps links that talus links found",
                    path, report->off_mesh_links);
    }
    if (report->plain_patches > 0) {
        tl_cli_warn(cli, "%s: %u polygons have no usable height detail; their corners' surface is taken", path,
                    report->plain_patches);
    }
}

static tl_exit print_import_report(tl_cli *cli, const char *output, uint64_t size, const tl_detour_report *r)
{
    if (cli->json) {
        return tl_cli_print_json(
            cli,
            json_pack("{so so sI sI sI sI sI sI sI sI}", "file", tl_json_text(cli->arguments.words[0]), "output",
                      tl_json_text(output), "bytes", (json_int_t)size, "tiles", (json_int_t)r->tile_count, "polygons",
                      (json_int_t)r->polygon_count, "dropped_polygons", (json_int_t)r->dropped_polygons,
                      "one_way_links", (json_int_t)r->one_way_links, "off_mesh_links", (json_int_t)r->off_mesh_links,
                      "plain_patches", (json_int_t)r->plain_patches, "area_zeros", (json_int_t)r->area_zeros));
    }
    printf("%s: %u tiles, %u polygons, %llu bytes\n", output, r->tile_count, r->polygon_count,
           (unsigned long long)size);
    return TL_EXIT_OK;
}

static tl_exit import_bytes(tl_cli *cli, const char *path, const tl_file_map *map, const tl_detour_read_def *def,
                            const char *output)
{
    tl_detour_tiles tiles;
    tl_detour_report report;
    tl_result result = tl_detour_read(map->bytes, map->size, def, &tiles, &report);
    if (result != TL_OK) {
        return tl_cli_fail_result(cli, path, result, &report.base);
    }
    tl_pack_content content;
    uint64_t size = 0;
    result = make_imported_content(path, &tiles, &content);
    tl_exit code = result == TL_OK ? tl_pack_content_write(cli, output, &content, &size)
                                   : tl_cli_fail_result(cli, path, result, NULL);
    tl_progress_end(&cli->progress);
    if (code == TL_EXIT_OK) {
        warn_of_losses(cli, path, &report);
        code = print_import_report(cli, output, size, &report);
    }
    tl_pack_content_free(&content);
    tl_detour_tiles_free(&tiles);
    return code;
}

static tl_exit run_import(tl_cli *cli)
{
    const char *output = NULL;
    tl_detour_read_def def = tl_default_detour_read_def();
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE", "where to write; required", NULL, 0, 0, 0, 0 },
        { "cell-height", 0, TL_OPTION_FLOAT, &def.cell_height, "M",
          "metres: corners' heights are rounded to multiples of it", NULL, 1e-6f, 100.0f, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 1, 1, &code)) {
        return code;
    }
    if (output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o FILE.talus");
    }
    const char *path = cli->arguments.words[0];
    tl_file_map map;
    tl_io_error error;
    if (tl_file_read(path, 0, &map, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    code = import_bytes(cli, path, &map, &def, output);
    tl_file_map_close(&map);
    return code;
}

const tl_command tl_import_command = {
    "import",
    "Other formats",
    "read Detour tiles into a baked file",
    "TILES.bin -o OUT.talus",
    "TILES is a set of Detour tiles as RecastDemo saves it (\"MSET\"), or the data of one tile (version 7). The\n"
    "baked file holds a navmesh and no triangles. Invalid polygons, links that lead one way only, and\n"
    "off-mesh connections are left out, and counted.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus export courtyard.obj -o courtyard.bin\n"
    "talus import courtyard.bin -o imported.talus\n"
    "talus path imported.talus 2,0,20 38,0,20\n"
    "talus import courtyard.bin -o fine.talus --cell-height 0.05 --json",
    run_import,
};
