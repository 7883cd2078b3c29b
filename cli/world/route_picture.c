// SPDX-License-Identifier: MIT
//
// Tiles come one at a time from the file and are painted at once, so a world of any size takes a picture's memory. The
// heads of tiles say where they lie: those beside the map are not read.

#include "cli/world/route_picture.h"

#include "cli/draw/draw_paper.h"
#include "cli/draw/draw_picture.h"
#include "world/bytes/little_endian.h"
#include "world/job/world_reader.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUTE_MARGIN = 20, ROUTE_HEAD = 64, ROUTE_FOOT = 48, TILE_HEAD_BYTES = 256 };

// Pixels.
#define LEAST_SEAM 12.0
#define LEAST_GATE 10.0

_Static_assert(offsetof(tl_nav_tile, bounds) + 24 <= TILE_HEAD_BYTES, "a tile's bounds are in its head");

#define ROUTE_PAPER  0xfafaf7u
#define ROUTE_GROUND 0xe0dfd8u // not walkable
#define ROUTE_LOW    0x4f7f74u
#define ROUTE_HIGH   0xf4ecd0u
#define ROUTE_SEAM   0x2b2b33u
#define ROUTE_WAY    0xd1345bu
#define ROUTE_START  0x2a6fdbu

typedef struct route_sheet {
    const tl_route_picture *picture;
    tl_world_reader reader;
    tl_pack_navmesh *settings;
    tl_pack_frame *frame; // NULL: the file's coordinates are the level's
    double (*way)[2];     // [point_count], x and z in the file
    double low[2], high[2];
    double pixels_per_metre;
    uint32_t width, height; // of the map
    cairo_surface_t *map;
    cairo_t *ground;
    void *tile;
    size_t tile_room;
    tl_io_error *error;
} route_sheet;

static tl_result fail_sheet_memory(const route_sheet *sheet)
{
    return tl_io_fail(sheet->error, TL_ERR_MEMORY, sheet->picture->file, 0, "", "out of memory for the picture");
}

// The bytes of a chunk in `*bytes`, which grow as needed, verified.
static tl_result read_chunk_into(route_sheet *sheet, const tl_pack_entry *entry, void **bytes, size_t *room)
{
    tl_report why;
    if (entry->size > *room) {
        void *grown = entry->size < SIZE_MAX ? realloc(*bytes, (size_t)entry->size) : NULL;
        if (grown == NULL) {
            return fail_sheet_memory(sheet);
        }
        *bytes = grown;
        *room = (size_t)entry->size;
    }
    memset(&why, 0, sizeof why);
    tl_result result = tl_world_reader_read(entry->offset, *bytes, (size_t)entry->size, &sheet->reader);
    if (result == TL_OK) {
        result = tl_pack_entry_open(entry, *bytes, &why);
    }
    return result == TL_OK ? result : tl_world_reader_fail(&sheet->reader, result, &why, sheet->error);
}

static tl_result open_sheet(route_sheet *sheet)
{
    size_t settings_room = 0, frame_room = 0;
    tl_result result = tl_world_reader_open(sheet->picture->file, &sheet->reader, sheet->error);
    if (result == TL_OK) {
        result = tl_world_reader_index(&sheet->reader, sheet->error);
    }
    for (uint32_t i = 0; i < sheet->reader.index.count && result == TL_OK; i++) {
        const tl_pack_entry *entry = &sheet->reader.index.entries[i];
        if (entry->type == TL_PACK_NAVM && sheet->settings == NULL) {
            void *bytes = NULL;
            result = read_chunk_into(sheet, entry, &bytes, &settings_room);
            sheet->settings = bytes;
        } else if (entry->type == TL_PACK_FRAM && sheet->frame == NULL) {
            void *bytes = NULL;
            result = read_chunk_into(sheet, entry, &bytes, &frame_room);
            sheet->frame = bytes;
        }
    }
    // The world was opened from this file before, and has checked both; it may be another one by now.
    if (result == TL_OK &&
        (sheet->settings == NULL || tl_pack_navmesh_check(sheet->settings, settings_room, NULL) != TL_OK ||
         (sheet->frame != NULL && tl_pack_frame_check(sheet->frame, frame_room, NULL) != TL_OK))) {
        result = tl_io_fail(sheet->error, TL_ERR_CORRUPT, sheet->picture->file, 0, "merge it again",
                            "has no sound settings");
    }
    return result;
}

// ---- The map -----------------------------------------------------------------------------------------------

// The box of the route, and a tenth more all around, or a tile.
static tl_result lay_out_route(route_sheet *sheet)
{
    const tl_route_picture *picture = sheet->picture;
    const uint32_t count = picture->route->point_count;
    sheet->way = malloc(count * sizeof *sheet->way + 1);
    if (sheet->way == NULL) {
        return fail_sheet_memory(sheet);
    }
    for (uint32_t i = 0; i < count; i++) {
        const double *p = picture->points[i].point;
        const tl_vec3 at = sheet->frame != NULL ? tl_pack_place_in(sheet->frame, p)
                                                : tl_vec3_make((float)p[0], (float)p[1], (float)p[2]);
        sheet->way[i][0] = (double)at.x;
        sheet->way[i][1] = (double)at.z;
        for (int k = 0; k < 2; k++) {
            sheet->low[k] = i == 0 || sheet->way[i][k] < sheet->low[k] ? sheet->way[i][k] : sheet->low[k];
            sheet->high[k] = i == 0 || sheet->way[i][k] > sheet->high[k] ? sheet->way[i][k] : sheet->high[k];
        }
    }
    const double longest = fmax(sheet->high[0] - sheet->low[0], sheet->high[1] - sheet->low[1]);
    const double tile = (double)sheet->settings->tile_size * (double)sheet->settings->cell_size;
    const double more = fmax(0.1 * longest, tile > 0.0 ? tile : 10.0);
    for (int k = 0; k < 2; k++) {
        sheet->low[k] -= more;
        sheet->high[k] += more;
    }
    sheet->pixels_per_metre = (double)picture->size / (longest + 2.0 * more);
    sheet->width = (uint32_t)ceil((sheet->high[0] - sheet->low[0]) * sheet->pixels_per_metre);
    sheet->height = (uint32_t)ceil((sheet->high[1] - sheet->low[1]) * sheet->pixels_per_metre);
    sheet->map = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)sheet->width, (int)sheet->height);
    sheet->ground = cairo_create(sheet->map);
    return cairo_status(sheet->ground) == CAIRO_STATUS_SUCCESS ? TL_OK : fail_sheet_memory(sheet);
}

static double pixel_of(const route_sheet *sheet, int axis, double at)
{
    return (at - sheet->low[axis]) * sheet->pixels_per_metre;
}

static bool is_on_map(const route_sheet *sheet, const unsigned char *head)
{
    const unsigned char *box = head + offsetof(tl_nav_tile, bounds); // min x y z, max x y z
    for (int k = 0; k < 2; k++) {
        if ((double)tl_get_float(box + 12 + 8 * k) < sheet->low[k] ||
            (double)tl_get_float(box + 8 * k) > sheet->high[k]) {
            return false;
        }
    }
    return true;
}

static void paint_tile(const route_sheet *sheet, const tl_nav_tile *tile)
{
    const tl_aabb *box = &sheet->settings->bounds;
    const float range = box->max.y - box->min.y;
    cairo_t *cairo = sheet->ground;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        uint32_t count = 0;
        float height = 0.0f;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, p, &count);
        for (uint32_t i = 0; i < count; i++) {
            cairo_line_to(cairo, pixel_of(sheet, 0, (double)corners[i].x), pixel_of(sheet, 1, (double)corners[i].z));
            height += corners[i].y / (float)count;
        }
        const float share = range > 0.0f ? tl_clampf((height - box->min.y) / range, 0.0f, 1.0f) : 0.5f;
        cairo_close_path(cairo);
        draw_set_colour(cairo, draw_colour_mix(ROUTE_LOW, ROUTE_HIGH, share), 1.0);
        cairo_fill_preserve(cairo);
        cairo_stroke(cairo); // half a pixel over its edges, so that no seam shines through
    }
    const double side = (double)tile->tile_size * (double)tile->cell_size;
    if (side * sheet->pixels_per_metre >= LEAST_SEAM) {
        const double x = (double)tile->origin.x + side * tile->tile_x, z = (double)tile->origin.z + side * tile->tile_z;
        draw_set_colour(cairo, ROUTE_SEAM, 0.18);
        cairo_rectangle(cairo, pixel_of(sheet, 0, x), pixel_of(sheet, 1, z), side * sheet->pixels_per_metre,
                        side * sheet->pixels_per_metre);
        cairo_stroke(cairo);
    }
}

static tl_result paint_ground(route_sheet *sheet)
{
    draw_set_colour(sheet->ground, ROUTE_GROUND, 1.0);
    cairo_paint(sheet->ground);
    cairo_set_line_width(sheet->ground, 0.6);
    for (uint32_t i = 0; i < sheet->reader.index.count; i++) {
        const tl_pack_entry *entry = &sheet->reader.index.entries[i];
        unsigned char head[TILE_HEAD_BYTES];
        if (entry->type != TL_PACK_NAVT || entry->size < TILE_HEAD_BYTES) {
            continue;
        }
        tl_result result = tl_world_reader_read(entry->offset, head, TILE_HEAD_BYTES, &sheet->reader);
        if (result != TL_OK) {
            *sheet->error = sheet->reader.error;
            return result;
        }
        if (!is_on_map(sheet, head)) {
            continue;
        }
        result = read_chunk_into(sheet, entry, &sheet->tile, &sheet->tile_room);
        if (result == TL_OK && tl_nav_tile_check(sheet->tile, entry->size, NULL) != TL_OK) {
            result = tl_io_fail(sheet->error, TL_ERR_CORRUPT, sheet->picture->file, 0, "merge it again",
                                "chunk %u: no sound tile", i);
        }
        if (result != TL_OK) {
            return result;
        }
        paint_tile(sheet, sheet->tile);
    }
    return TL_OK;
}

// ---- The picture -------------------------------------------------------------------------------------------

static void trace_way(cairo_t *cairo, const route_sheet *sheet)
{
    for (uint32_t i = 0; i < sheet->picture->route->point_count; i++) {
        cairo_line_to(cairo, pixel_of(sheet, 0, sheet->way[i][0]), pixel_of(sheet, 1, sheet->way[i][1]));
    }
}

static void paint_dot(cairo_t *cairo, const route_sheet *sheet, uint32_t point, double radius, draw_colour colour)
{
    cairo_arc(cairo, pixel_of(sheet, 0, sheet->way[point][0]), pixel_of(sheet, 1, sheet->way[point][1]), radius, 0.0,
              6.2831853);
    draw_set_colour(cairo, colour, 1.0);
    cairo_fill_preserve(cairo);
    draw_set_colour(cairo, ROUTE_PAPER, 1.0);
    cairo_set_line_width(cairo, 1.5);
    cairo_stroke(cairo);
}

static void paint_way(cairo_t *cairo, const route_sheet *sheet)
{
    const uint32_t last = sheet->picture->route->point_count - 1;
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    trace_way(cairo, sheet);
    draw_set_colour(cairo, ROUTE_PAPER, 0.9);
    cairo_set_line_width(cairo, 5.5);
    cairo_stroke_preserve(cairo);
    draw_set_colour(cairo, ROUTE_WAY, 1.0);
    cairo_set_line_width(cairo, 2.5);
    cairo_stroke(cairo);
    double shown = -1e9; // metres along the route
    for (uint32_t i = 1; i < last; i++) {
        if ((sheet->picture->points[i].length - shown) * sheet->pixels_per_metre >= LEAST_GATE) {
            paint_dot(cairo, sheet, i, 2.5, ROUTE_WAY);
            shown = sheet->picture->points[i].length;
        }
    }
    paint_dot(cairo, sheet, 0, 6.0, ROUTE_START);
    paint_dot(cairo, sheet, last, 6.0, ROUTE_WAY);
}

static void paint_route_sheet(cairo_t *cairo, const void *user)
{
    const route_sheet *sheet = user;
    const tl_nav_world_route *route = sheet->picture->route;
    char words[160];
    draw_set_colour(cairo, ROUTE_PAPER, 1.0);
    cairo_paint(cairo);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text_within(cairo, ROUTE_MARGIN, 30, 20, true, draw_file_name(sheet->picture->file), sheet->width);
    snprintf(words, sizeof words, "a route of %.1f m, and no path is shorter than %.1f m; dots are gates",
             route->length, route->lower_bound);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text_within(cairo, ROUTE_MARGIN, 52, 13, false, words, sheet->width);
    cairo_save(cairo);
    cairo_translate(cairo, ROUTE_MARGIN, ROUTE_HEAD);
    cairo_rectangle(cairo, 0, 0, sheet->width, sheet->height);
    cairo_clip(cairo);
    cairo_set_source_surface(cairo, sheet->map, 0, 0);
    cairo_paint(cairo);
    paint_way(cairo, sheet);
    cairo_restore(cairo);
    draw_scale_bar(cairo, sheet->pixels_per_metre, sheet->width, (double)ROUTE_MARGIN + (double)sheet->width,
                   (double)ROUTE_HEAD + (double)sheet->height + 28.0);
}

tl_result tl_draw_world_route(const tl_route_picture *picture, tl_io_error *error_out)
{
    route_sheet sheet;
    memset(&sheet, 0, sizeof sheet);
    memset(error_out, 0, sizeof *error_out);
    sheet.picture = picture;
    sheet.error = error_out;
    tl_result result = open_sheet(&sheet);
    if (result == TL_OK) {
        result = lay_out_route(&sheet);
    }
    if (result == TL_OK) {
        result = paint_ground(&sheet);
    }
    if (result == TL_OK) {
        cairo_surface_flush(sheet.map);
        result = draw_paper_write(picture->output, sheet.width + 2 * ROUTE_MARGIN,
                                  sheet.height + ROUTE_HEAD + ROUTE_FOOT, paint_route_sheet, &sheet, error_out);
    }
    cairo_destroy(sheet.ground);
    cairo_surface_destroy(sheet.map);
    free(sheet.tile);
    free(sheet.way);
    free(sheet.settings);
    free(sheet.frame);
    tl_world_reader_close(&sheet.reader);
    return result;
}
