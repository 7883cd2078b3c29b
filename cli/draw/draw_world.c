// SPDX-License-Identifier: MIT
//
// A map has a pixel for each tile, or for a block of tiles where there are more of them than pixels, and is scaled to
// the picture. What differs by powers is coloured by its logarithm: tiles' costs and times do.

#include "cli/draw/draw_world.h"

#include "cli/draw/draw_paper.h"
#include "cli/draw/draw_picture.h"
#include "cli/shared/json_out.h"
#include "world/job/bake_tiles.h"
#include "world/job/tile_file.h"
#include "world/job/tile_times.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum world_map { MAP_WALKABLE, MAP_COST, MAP_TIME, MAP_MISSING, MAP_COUNT } world_map;

static const char *const MAP_NAMES[MAP_COUNT] = { "walkable", "cost", "time", "missing" };

enum {
    MAX_MAP_PIXELS = 4096, // of the map before it is scaled
    MAP_MARGIN = 20,
    MAP_HEAD = 64,
    MAP_FOOT = 56,
    MAP_TITLE = 24,
    SMALLEST_MAP = 240,
    BAR_WIDTH = 160,
    BAR_STEPS = 80,
    WORDS = 128
};

#define MAP_PAPER   0xfafaf7u
#define MAP_NOTHING 0xe8e8e4u // no triangles
#define MAP_UNKNOWN 0xc4c4ccu // not baked, or its time is not noted
#define MAP_THERE   0x5b9e6fu
#define MAP_GONE    0xd1495bu

// A value for each tile of the plan; < 0: not known.
typedef struct map_values {
    float *of_tile; // [plan.tile_count]
    float low, high;
    bool logarithmic;
    char low_text[32], high_text[32];
} map_values;

typedef struct map_sheet {
    tl_cli *cli;
    const char *job;
    tl_world_plan plan;
    bool wanted[MAP_COUNT];
    uint32_t count, columns;
    float *values; // of the map that is filled at the moment
    cairo_surface_t *images[MAP_COUNT];
    map_values scales[MAP_COUNT];
    uint64_t there;
    double area, seconds;
    uint32_t width, height, map_width, map_height; // pixels, of the picture and of each map in it
    double pixels_per_metre;
} map_sheet;

bool draw_is_world_job(const char *path)
{
    tl_file_facts facts;
    char *plan = tl_world_job_path(path, "plan");
    const bool is = plan != NULL && tl_file_look(plan, &facts) && !facts.is_folder;
    free(plan);
    return is;
}

// ---- Values ------------------------------------------------------------------------------------------------

static tl_result fill_walkable(map_sheet *sheet, tl_io_error *error)
{
    const double side = (double)sheet->plan.grid.def.tile_size * (double)sheet->plan.grid.def.cell_size;
    for (uint64_t i = 0; i < sheet->plan.tile_count; i++) {
        const tl_world_tile *tile = &sheet->plan.tiles[i];
        tl_world_layers layers;
        char *path = tl_world_tile_path(sheet->job, tile->key);
        if (path == NULL) {
            return tl_io_fail(error, TL_ERR_MEMORY, sheet->job, 0, "", "out of memory");
        }
        sheet->values[i] = -1.0f;
        if (tl_world_tile_read(path, tile, false, &layers, NULL) == TL_OK) {
            double area = 0.0;
            if (tl_world_layers_check(&layers, path, tile, NULL) == TL_OK) {
                for (uint32_t k = 0; k < layers.count; k++) {
                    area += (double)layers.tiles[k]->area;
                }
                sheet->values[i] = (float)(area / (side * side));
            }
            sheet->area += area;
            tl_world_layers_free(&layers);
        }
        free(path);
    }
    return TL_OK;
}

static tl_result fill_cost(map_sheet *sheet, tl_io_error *error)
{
    (void)error;
    for (uint64_t i = 0; i < sheet->plan.tile_count; i++) {
        sheet->values[i] = (float)sheet->plan.tiles[i].cost;
    }
    return TL_OK;
}

static tl_result fill_time(map_sheet *sheet, tl_io_error *error)
{
    uint64_t *times;
    const tl_result result = tl_world_times_read(sheet->job, &sheet->plan, &times, error);
    for (uint64_t i = 0; result == TL_OK && i < sheet->plan.tile_count; i++) {
        sheet->values[i] = times[i] > 0 ? (float)((double)times[i] / 1e9) : -1.0f;
        sheet->seconds += (double)times[i] / 1e9;
    }
    free(times);
    return result;
}

static tl_result fill_missing(map_sheet *sheet, tl_io_error *error)
{
    for (uint64_t i = 0; i < sheet->plan.tile_count; i++) {
        const tl_world_tile *tile = &sheet->plan.tiles[i];
        char *path = tl_world_tile_path(sheet->job, tile->key);
        if (path == NULL) {
            return tl_io_fail(error, TL_ERR_MEMORY, sheet->job, 0, "", "out of memory");
        }
        const bool there = tl_world_tile_is_there(path, tile);
        sheet->values[i] = there ? 1.0f : 0.0f;
        sheet->there += there;
        free(path);
    }
    return TL_OK;
}

// ---- Colours -----------------------------------------------------------------------------------------------

// Dark blue over green to yellow: told apart in grey too.
static draw_colour colour_of_share(float share)
{
    static const draw_colour stops[] = { 0x2d2a6e, 0x2a6f8e, 0x35a37c, 0xa6d14f, 0xfbe64d };
    const float at = 4.0f * tl_clampf(share, 0.0f, 1.0f);
    const int stop = at >= 4.0f ? 3 : (int)at;
    return draw_colour_mix(stops[stop], stops[stop + 1], at - (float)stop);
}

static float share_of_value(const map_values *scale, float value)
{
    if (scale->logarithmic) {
        return scale->high > scale->low ? logf(value / scale->low) / logf(scale->high / scale->low) : 1.0f;
    }
    return scale->high > scale->low ? (value - scale->low) / (scale->high - scale->low) : 1.0f;
}

static draw_colour colour_of_value(world_map map, const map_values *scale, float value)
{
    if (map == MAP_MISSING) {
        return value < 0.0f ? MAP_UNKNOWN : draw_colour_mix(MAP_GONE, MAP_THERE, value);
    }
    return value < 0.0f ? MAP_UNKNOWN : colour_of_share(share_of_value(scale, value));
}

// The range of what is known, without zeros, which no logarithm has: they get the lowest colour.
static void find_scale(const map_sheet *sheet, world_map map, map_values *scale)
{
    static const char *const units[MAP_COUNT] = { "%.0f%%", "%.0f", "%.3g ms", "" };
    static const float factors[MAP_COUNT] = { 100.0f, 1.0f, 1000.0f, 1.0f };
    scale->logarithmic = map == MAP_COST || map == MAP_TIME;
    scale->low = INFINITY; // nothing is known
    scale->high = 0.0f;
    for (uint64_t i = 0; i < sheet->plan.tile_count; i++) {
        const float value = sheet->values[i];
        if (value > 0.0f) {
            scale->low = tl_minf(scale->low, value);
            scale->high = tl_maxf(scale->high, value);
        }
    }
    if (map != MAP_MISSING && scale->low <= scale->high) {
        scale->low = map == MAP_WALKABLE ? 0.0f : scale->low;
        snprintf(scale->low_text, sizeof scale->low_text, units[map], (double)(factors[map] * scale->low));
        snprintf(scale->high_text, sizeof scale->high_text, units[map], (double)(factors[map] * scale->high));
    }
}

// ---- The maps ----------------------------------------------------------------------------------------------

// Mean value of the known tiles of each block, and whether it has tiles at all.
static bool paint_map(map_sheet *sheet, world_map map)
{
    const tl_world_grid *grid = &sheet->plan.grid;
    const uint32_t longest = grid->tiles_x > grid->tiles_z ? grid->tiles_x : grid->tiles_z;
    const uint32_t block = (longest + MAX_MAP_PIXELS - 1) / MAX_MAP_PIXELS;
    const uint32_t width = (grid->tiles_x + block - 1) / block, height = (grid->tiles_z + block - 1) / block;
    map_values *scale = &sheet->scales[map];
    find_scale(sheet, map, scale);
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    float *sums = calloc((size_t)width * height, sizeof *sums);
    uint32_t *counts = calloc(2 * (size_t)width * height, sizeof *counts); // known ones; all
    sheet->images[map] = image;
    const bool has_room = cairo_surface_status(image) == CAIRO_STATUS_SUCCESS && sums != NULL && counts != NULL;
    for (uint64_t i = 0; has_room && i < sheet->plan.tile_count; i++) {
        const tl_world_tile *tile = &sheet->plan.tiles[i];
        const size_t at = (size_t)(tile->z / block) * width + tile->x / block;
        const bool known = sheet->values[i] >= 0.0f;
        sums[at] += known ? sheet->values[i] : 0.0f;
        counts[2 * at] += known;
        counts[2 * at + 1]++;
    }
    uint32_t *pixels = has_room ? (uint32_t *)(void *)cairo_image_surface_get_data(image) : NULL;
    const size_t stride = has_room ? (size_t)cairo_image_surface_get_stride(image) / 4 : 0;
    for (size_t at = 0; has_room && at < (size_t)width * height; at++) {
        const float mean = counts[2 * at] > 0 ? sums[at] / (float)counts[2 * at] : -1.0f;
        pixels[at / width * stride + at % width] =
            counts[2 * at + 1] == 0 ? MAP_NOTHING : colour_of_value(map, scale, mean);
    }
    cairo_surface_mark_dirty(image);
    free(sums);
    free(counts);
    return has_room;
}

static tl_result make_maps(map_sheet *sheet, tl_io_error *error)
{
    typedef tl_result fill_fn(map_sheet *, tl_io_error *);
    static fill_fn *const fills[MAP_COUNT] = { fill_walkable, fill_cost, fill_time, fill_missing };
    sheet->values = malloc((size_t)(sheet->plan.tile_count + 1) * sizeof *sheet->values);
    tl_result result = sheet->values != NULL ? TL_OK : TL_ERR_MEMORY;
    for (int map = 0; map < MAP_COUNT && result == TL_OK; map++) {
        if (sheet->wanted[map]) {
            result = fills[map](sheet, error);
            result = result == TL_OK && !paint_map(sheet, (world_map)map) ? TL_ERR_MEMORY : result;
        }
    }
    return result == TL_ERR_MEMORY ? tl_io_fail(error, result, sheet->job, 0, "", "out of memory for the picture")
                                   : result;
}

// ---- The picture -------------------------------------------------------------------------------------------

static void lay_out_maps(map_sheet *sheet, uint32_t size)
{
    const tl_world_grid *grid = &sheet->plan.grid;
    const uint32_t longest = grid->tiles_x > grid->tiles_z ? grid->tiles_x : grid->tiles_z;
    const double scale = (double)size / longest;
    const double side = (double)grid->def.tile_size * (double)grid->def.cell_size;
    sheet->pixels_per_metre = scale / side;
    sheet->map_width = (uint32_t)ceil(scale * grid->tiles_x);
    sheet->map_height = (uint32_t)ceil(scale * grid->tiles_z);
    sheet->columns = sheet->count < 2 ? 1 : 2;
    const uint32_t rows = (sheet->count + sheet->columns - 1) / sheet->columns;
    const uint32_t column = sheet->map_width < SMALLEST_MAP ? SMALLEST_MAP : sheet->map_width;
    sheet->width = sheet->columns * (column + MAP_MARGIN) + MAP_MARGIN;
    sheet->height = MAP_HEAD + rows * (sheet->map_height + MAP_TITLE + MAP_FOOT);
}

static void paint_legend(cairo_t *cairo, const map_sheet *sheet, world_map map, double x, double right, double y)
{
    const map_values *scale = &sheet->scales[map];
    if (map == MAP_MISSING) {
        draw_set_colour(cairo, MAP_THERE, 1.0);
        cairo_rectangle(cairo, x, y, 12, 12);
        cairo_fill(cairo);
        draw_set_colour(cairo, MAP_GONE, 1.0);
        cairo_rectangle(cairo, x + 80, y, 12, 12);
        cairo_fill(cairo);
        draw_set_colour(cairo, DRAW_INK, 1.0);
        draw_text(cairo, x + 18, y + 11, 12, false, "there");
        draw_text(cairo, x + 98, y + 11, 12, false, "missing");
        return;
    }
    draw_choose_font(cairo, 12, false);
    if (scale->high_text[0] == '\0') {
        draw_set_colour(cairo, DRAW_INK, 1.0);
        draw_text(cairo, x, y + 11, 12, false, "nothing is known yet");
        return;
    }
    const double from = x + draw_text_width(cairo, scale->low_text) + 6;
    const double room = right - from - draw_text_width(cairo, scale->high_text) - 6;
    const double width = fmin(room, (double)BAR_WIDTH), step = width / (double)BAR_STEPS;
    for (int i = 0; i < BAR_STEPS; i++) {
        draw_set_colour(cairo, colour_of_share(((float)i + 0.5f) / (float)BAR_STEPS), 1.0);
        cairo_rectangle(cairo, from + i * step, y, step + 0.5, 12);
        cairo_fill(cairo);
    }
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text(cairo, x, y + 11, 12, false, scale->low_text);
    draw_text(cairo, from + width + 6, y + 11, 12, false, scale->high_text);
}

static void describe_world(const map_sheet *sheet, char words[WORDS])
{
    int at = snprintf(words, WORDS, "%llu tiles of a grid %u x %u", (unsigned long long)sheet->plan.tile_count,
                      sheet->plan.grid.tiles_x, sheet->plan.grid.tiles_z);
    if (sheet->wanted[MAP_MISSING]) {
        at += snprintf(words + at, (size_t)(WORDS - at), ", %llu missing",
                       (unsigned long long)(sheet->plan.tile_count - sheet->there));
    }
    if (sheet->wanted[MAP_WALKABLE]) {
        at += snprintf(words + at, (size_t)(WORDS - at), ", %.4g km2 walkable", sheet->area / 1e6);
    }
    if (sheet->wanted[MAP_TIME]) {
        snprintf(words + at, (size_t)(WORDS - at), ", %.3g s of processor", sheet->seconds);
    }
}

static void paint_maps(cairo_t *cairo, const void *user)
{
    static const char *const titles[MAP_COUNT] = { "walkable share of the tile", "expected cost", "time of the bake",
                                                   "missing" };
    const map_sheet *sheet = user;
    char words[WORDS];
    describe_world(sheet, words);
    draw_set_colour(cairo, MAP_PAPER, 1.0);
    cairo_paint(cairo);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    const double room = sheet->width - 2.0 * (double)MAP_MARGIN;
    draw_text_within(cairo, MAP_MARGIN, 30, 20, true, draw_file_name(sheet->job), room);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text_within(cairo, MAP_MARGIN, 52, 13, false, words, room);
    uint32_t place = 0;
    for (int map = 0; map < MAP_COUNT; map++) {
        if (!sheet->wanted[map]) {
            continue;
        }
        const uint32_t column = (sheet->width - MAP_MARGIN) / sheet->columns;
        const double x = MAP_MARGIN + place % sheet->columns * column;
        const double y = MAP_HEAD + place / sheet->columns * (sheet->map_height + MAP_TITLE + MAP_FOOT) + MAP_TITLE;
        draw_set_colour(cairo, DRAW_INK, 1.0);
        draw_text_within(cairo, x, y - 8, 13, true, titles[map], column - MAP_MARGIN);
        cairo_save(cairo);
        cairo_translate(cairo, x, y);
        cairo_scale(cairo, (double)sheet->map_width / cairo_image_surface_get_width(sheet->images[map]),
                    (double)sheet->map_height / cairo_image_surface_get_height(sheet->images[map]));
        cairo_set_source_surface(cairo, sheet->images[map], 0, 0);
        const bool grows = (uint32_t)cairo_image_surface_get_width(sheet->images[map]) <= sheet->map_width;
        cairo_pattern_set_filter(cairo_get_source(cairo), grows ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
        cairo_paint(cairo);
        cairo_restore(cairo);
        paint_legend(cairo, sheet, (world_map)map, x, x + (double)(column - MAP_MARGIN), y + sheet->map_height + 8);
        draw_scale_bar(cairo, sheet->pixels_per_metre, sheet->map_width, x + sheet->map_width,
                       y + sheet->map_height + 40);
        place++;
    }
}

// ---- The command -------------------------------------------------------------------------------------------

static bool choose_maps(map_sheet *sheet, const char *text, tl_exit *exit_out)
{
    for (const char *word = text != NULL ? text : "all"; *word != '\0';) {
        const size_t length = strcspn(word, ",");
        const bool all = length == 3 && strncmp(word, "all", 3) == 0;
        bool known = all;
        for (int map = 0; map < MAP_COUNT; map++) {
            const bool named = strlen(MAP_NAMES[map]) == length && strncmp(MAP_NAMES[map], word, length) == 0;
            if ((all || named) && !sheet->wanted[map]) {
                sheet->wanted[map] = true;
                sheet->count++;
            }
            known = known || named;
        }
        if (!known) {
            *exit_out = tl_cli_fail(sheet->cli, TL_EXIT_USAGE,
                                    "--stage: of a world's job there are walkable, cost, time and missing; '%.*s' is "
                                    "none of them",
                                    (int)length, word);
            return false;
        }
        word += length + (word[length] == ',');
    }
    if (sheet->count == 0) {
        *exit_out = tl_cli_fail(sheet->cli, TL_EXIT_USAGE, "--stage: name a map, or all");
    }
    return sheet->count > 0;
}

static tl_exit answer_maps(const map_sheet *sheet, const char *output)
{
    char words[WORDS];
    describe_world(sheet, words);
    if (sheet->cli->json) {
        json_t *list = json_array();
        json_array_append_new(
            list, json_pack("{sssoss}", "stage", "world", "output", tl_json_text(output), "summary", words));
        return tl_cli_print_json(sheet->cli, json_pack("{so so}", "file", tl_json_text(sheet->job), "pictures", list));
    }
    if (strcmp(output, "-") != 0) {
        printf("%s: %s\n", output, words);
    }
    return TL_EXIT_OK;
}

tl_exit draw_world(tl_cli *cli, const char *job, const draw_world_options *options)
{
    map_sheet sheet;
    tl_io_error error;
    tl_exit code = TL_EXIT_OK;
    memset(&sheet, 0, sizeof sheet);
    memset(&error, 0, sizeof error);
    sheet.cli = cli;
    sheet.job = job;
    if (!choose_maps(&sheet, options->stages, &code)) {
        return code;
    }
    tl_result result = tl_world_plan_of_job(job, &sheet.plan, &error);
    if (result == TL_OK) {
        result = make_maps(&sheet, &error);
    }
    if (result == TL_OK) {
        lay_out_maps(&sheet, options->size);
        result = draw_paper_write(options->output, sheet.width, sheet.height, paint_maps, &sheet, &error);
    }
    code = result == TL_OK ? answer_maps(&sheet, options->output) : tl_cli_fail_io(cli, &error);
    for (int map = 0; map < MAP_COUNT; map++) {
        cairo_surface_destroy(sheet.images[map]);
    }
    free(sheet.values);
    tl_world_plan_free(&sheet.plan);
    return code;
}
