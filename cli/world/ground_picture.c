// SPDX-License-Identifier: MIT

#include "cli/world/ground_picture.h"

#include "cli/draw/draw_paper.h"
#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "cli/world/ground_map.h"

#include <stdio.h>
#include <string.h>

enum { GROUND_WORDS = 128 };

static bool is_large_ground(const tl_pack_index *index)
{
    uint32_t tiles = 0, soups = 0;
    for (uint32_t i = 0; i < index->count; i++) {
        tiles += index->entries[i].type == TL_PACK_NAVT;
        soups += index->entries[i].type == TL_PACK_SOUP;
    }
    return tiles > TL_GROUND_LEAST_TILES && soups == 0;
}

static void describe_ground(const tl_ground_map *map, char words[GROUND_WORDS])
{
    uint64_t polygons = 0;
    double area = 0.0;
    for (uint32_t i = 0; i <= TL_NAV_MAX_AREA; i++) {
        polygons += map->sums.polygons[i];
        area += map->sums.square_metres[i];
    }
    snprintf(words, GROUND_WORDS, "%llu tiles, %llu polygons, %.4g km2 walkable, light is high",
             (unsigned long long)map->tiles, (unsigned long long)polygons, area / 1e6);
}

static void paint_ground_sheet(cairo_t *cairo, const void *user)
{
    char words[GROUND_WORDS];
    describe_ground(user, words);
    tl_ground_map_show(cairo, user, words, NULL, NULL);
}

static tl_result draw_map(tl_cli *cli, tl_ground_map *map, const char *output, uint32_t size, tl_io_error *error)
{
    const tl_aabb *box = &map->settings->bounds;
    map->low[0] = (double)box->min.x;
    map->low[1] = (double)box->min.z;
    map->high[0] = (double)box->max.x;
    map->high[1] = (double)box->max.z;
    const tl_result result = tl_ground_map_paint(map, size, cli->host.progress, error);
    tl_progress_end(&cli->progress);
    return result == TL_OK
               ? draw_paper_write(output, map->width + 2 * TL_GROUND_MARGIN,
                                  map->height + TL_GROUND_HEAD + TL_GROUND_FOOT, paint_ground_sheet, map, error)
               : result;
}

static tl_exit answer_ground(tl_cli *cli, const tl_ground_map *map, const char *stage, const char *output)
{
    char words[GROUND_WORDS];
    describe_ground(map, words);
    if (cli->json) {
        json_t *list = json_array();
        json_array_append_new(list,
                              json_pack("{sssoss}", "stage", stage, "output", tl_json_text(output), "summary", words));
        return tl_cli_print_json(cli, json_pack("{so so}", "file", tl_json_text(map->reader->path), "pictures", list));
    }
    if (strcmp(output, "-") != 0) { // else the picture itself went there
        printf("%s: %s\n", output, words);
    }
    return TL_EXIT_OK;
}

static tl_exit draw_ground(tl_cli *cli, tl_world_reader *reader, const char *stage, const char *output, uint32_t size)
{
    tl_ground_map map;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    tl_result result = tl_ground_map_open(reader, &reader->index, &map, &error);
    if (result == TL_OK) {
        result = draw_map(cli, &map, output, size, &error);
    }
    const tl_exit code = result == TL_OK ? answer_ground(cli, &map, stage, output) : tl_cli_fail_io(cli, &error);
    tl_ground_map_close(&map);
    return code;
}

// A file that cannot be opened is left to those who draw all others, and say why.
bool tl_draw_large_ground(tl_cli *cli, const char *path, const char *stage, const char *output, uint32_t size,
                          tl_exit *exit_out)
{
    tl_world_reader reader;
    if (!tl_input_is_baked(path) || tl_world_reader_open(path, &reader, NULL) != TL_OK) {
        return false;
    }
    const bool large = tl_world_reader_index(&reader, NULL) == TL_OK && is_large_ground(&reader.index);
    if (large) {
        *exit_out = draw_ground(cli, &reader, stage, output, size);
    }
    tl_world_reader_close(&reader);
    return large;
}
