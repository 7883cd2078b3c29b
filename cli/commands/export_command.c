// SPDX-License-Identifier: MIT
//
// talus export: the navmesh as a set of Detour tiles, the file that RecastDemo saves and loads.

#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "io/files/atomic_write.h"

#include <talus/nav_detour.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void warn_of_links(tl_cli *cli, const tl_detour_report *report)
{
    if (report->off_mesh_outside > 0) {
        tl_cli_warn(cli, "%u off-mesh links start in no tile: left out", report->off_mesh_outside);
    }
    if (report->off_mesh_far > 0) {
        tl_cli_warn(cli, "%u off-mesh links lead beyond the next tile, where Detour does not connect them",
                    report->off_mesh_far);
    }
}

static tl_exit print_export_report(tl_cli *cli, const char *output, uint64_t size, const tl_detour_report *report)
{
    if (report->plain_patches > 0) {
        tl_cli_warn(cli, "%u polygons have more height detail than Detour's 255 vertices or triangles: written flat",
                    report->plain_patches);
    }
    warn_of_links(cli, report);
    if (cli->json) {
        return tl_cli_print_json(
            cli,
            json_pack("{so so sI sI sI sI sI sI sI}", "file", tl_json_text(cli->arguments.words[0]), "output",
                      tl_json_text(output), "bytes", (json_int_t)size, "tiles", (json_int_t)report->tile_count,
                      "polygons", (json_int_t)report->polygon_count, "plain_patches", (json_int_t)report->plain_patches,
                      "off_mesh_links", (json_int_t)report->off_mesh_links, "off_mesh_outside",
                      (json_int_t)report->off_mesh_outside, "off_mesh_far", (json_int_t)report->off_mesh_far));
    }
    printf("%s: %u tiles, %u polygons, ", output, report->tile_count, report->polygon_count);
    if (report->off_mesh_links > 0) {
        printf("%u off-mesh links, ", report->off_mesh_links);
    }
    printf("%llu bytes\n", (unsigned long long)size);
    return TL_EXIT_OK;
}

// The navmesh's off-mesh links. False: out of memory, or one that Detour cannot hold.
static bool collect_off_mesh(tl_cli *cli, const tl_input *input, tl_detour_set *set, tl_exit *exit_out)
{
    tl_detour_off_mesh *links = calloc((size_t)tl_navmesh_offmesh_count(input->navmesh) + 1, sizeof *links);
    set->off_mesh = links;
    uint32_t cursor = 0;
    tl_nav_ref link;
    while (links != NULL && tl_navmesh_next_offmesh(input->navmesh, &cursor, &link)) {
        tl_nav_offmesh_state state;
        if (tl_navmesh_offmesh_state(input->navmesh, link, &state) != TL_OK) {
            continue;
        }
        const tl_nav_offmesh *from = &state.offmesh;
        if (from->flags > UINT16_MAX) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_DATA, "%s: off-mesh link %u: Detour keeps the lowest 16 flags only",
                                    input->path, set->off_mesh_count);
            return false;
        }
        links[set->off_mesh_count++] =
            (tl_detour_off_mesh){ from->start,           from->end,  from->radius,   (uint32_t)from->user,
                                  (uint16_t)from->flags, from->area, from->both_ways };
    }
    if (links == NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
    }
    return links != NULL;
}

static tl_exit export_navmesh(tl_cli *cli, const tl_input *input, tl_detour_refs refs, const char *output)
{
    uint32_t slots = tl_navmesh_slot_count(input->navmesh), count = 0;
    const tl_nav_tile **tiles = calloc((size_t)slots + 1, sizeof *tiles);
    if (tiles == NULL) {
        return tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
    }
    for (uint32_t slot = 0; slot < slots; slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(input->navmesh, slot);
        if (tile != NULL) {
            tiles[count++] = tile;
        }
    }
    tl_exit code = TL_EXIT_OK;
    tl_detour_set set = { tiles, count, NULL, 0, refs };
    if (!collect_off_mesh(cli, input, &set, &code)) {
        free(tiles);
        free((void *)set.off_mesh);
        return code;
    }
    // Without room the first run only says what is wrong; else it says CAPACITY.
    uint64_t size = tl_detour_linked_set_size(&set);
    void *bytes = size > 0 && size <= SIZE_MAX ? malloc((size_t)size) : NULL;
    tl_detour_report report;
    tl_result result =
        size > 0 && bytes == NULL ? TL_ERR_MEMORY : tl_detour_linked_set_write(&set, bytes, size, &report);
    tl_io_error error;
    if (result != TL_OK) {
        code = tl_cli_fail_result(cli, input->path, result, result == TL_ERR_MEMORY ? NULL : &report.base);
    } else if (tl_atomic_write(output, bytes, (size_t)size, &error) != TL_OK) {
        code = tl_cli_fail_io(cli, &error);
    } else {
        code = print_export_report(cli, output, size, &report);
    }
    free(bytes);
    free(tiles);
    free((void *)set.off_mesh);
    return code;
}

static tl_exit run_export(tl_cli *cli)
{
    const char *output = NULL;
    int refs = 0;
    static const char *const widths[] = { "32", "64", NULL };
    tl_bake_settings settings = tl_default_bake_settings();
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE", "where to write; required", NULL, 0, 0, 0, 0 },
        { "refs", 0, TL_OPTION_CHOICE, &refs, "BITS",
          "bits of a polygon reference: 64 for a Detour compiled with DT_POLYREF64", widths, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code = TL_EXIT_OK;
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings, 1, 1, &code)) {
        return code;
    }
    if (output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o FILE.bin");
    }
    tl_input input;
    if (tl_input_open_navmesh(cli, cli->arguments.words[0], &settings, &input, &code)) {
        tl_progress_end(&cli->progress);
        code = export_navmesh(cli, &input, (tl_detour_refs)refs, output);
    }
    tl_input_close(&input);
    return code;
}

const tl_command tl_export_command = {
    "export",
    "Other formats",
    "write the navmesh as Detour tiles",
    "FILE -o OUT.bin [--refs 32|64]",
    "FILE is a baked file, or a level, which is then baked in memory. OUT is a set of Detour tiles (\"MSET\",\n"
    "tiles of version 7), the file that RecastDemo loads. Detour's polygons have at most 6 corners and 16\n"
    "flags. Off-mesh links (drops, jumps, climbs) become Detour's; those that it cannot connect are told.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus export courtyard.talus -o courtyard.bin\n"
    "talus export courtyard.obj -o tiled.bin --tile-size 64 --refs 64",
    run_export,
};
