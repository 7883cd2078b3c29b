// SPDX-License-Identifier: MIT

#include "cli/world/ground_map.h"

#include "cli/draw/draw_paper.h"
#include "cli/draw/draw_picture.h"
#include "world/bytes/little_endian.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { TILE_HEAD_BYTES = 256 };

// Pixels: seams of smaller tiles are not drawn.
#define LEAST_SEAM 12.0

_Static_assert(offsetof(tl_nav_tile, bounds) + 24 <= TILE_HEAD_BYTES, "a tile's bounds are in its head");

#define GROUND_NONE 0xe0dfd8u // not walkable
#define GROUND_LOW  0x4f7f74u
#define GROUND_HIGH 0xf4ecd0u
#define GROUND_SEAM 0x2b2b33u

static tl_result fail_ground_memory(const tl_ground_map *map, tl_io_error *error_out)
{
    return tl_io_fail(error_out, TL_ERR_MEMORY, map->reader->path, 0, "", "out of memory for the picture");
}

// The bytes of a chunk in `*bytes`, which grow as needed, verified.
static tl_result read_chunk_into(const tl_ground_map *map, const tl_pack_entry *entry, void **bytes, size_t *room,
                                 tl_io_error *error_out)
{
    tl_report why;
    if (entry->size > *room) {
        void *grown = entry->size < SIZE_MAX ? realloc(*bytes, (size_t)entry->size) : NULL;
        if (grown == NULL) {
            return fail_ground_memory(map, error_out);
        }
        *bytes = grown;
        *room = (size_t)entry->size;
    }
    memset(&why, 0, sizeof why);
    tl_result result = tl_world_reader_read(entry->offset, *bytes, (size_t)entry->size, map->reader);
    if (result == TL_OK) {
        result = tl_pack_entry_open(entry, *bytes, &why);
    }
    return result == TL_OK ? result : tl_world_reader_fail(map->reader, result, &why, error_out);
}

tl_result tl_ground_map_open(tl_world_reader *reader, const tl_pack_index *index, tl_ground_map *map_out,
                             tl_io_error *error_out)
{
    memset(map_out, 0, sizeof *map_out);
    map_out->reader = reader;
    map_out->index = index;
    size_t settings_room = 0, frame_room = 0;
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < index->count && result == TL_OK; i++) {
        const tl_pack_entry *entry = &index->entries[i];
        if (entry->type == TL_PACK_NAVM && map_out->settings == NULL) {
            void *bytes = NULL;
            result = read_chunk_into(map_out, entry, &bytes, &settings_room, error_out);
            map_out->settings = bytes;
        } else if (entry->type == TL_PACK_FRAM && map_out->frame == NULL) {
            void *bytes = NULL;
            result = read_chunk_into(map_out, entry, &bytes, &frame_room, error_out);
            map_out->frame = bytes;
        }
    }
    if (result != TL_OK ||
        (map_out->settings != NULL && tl_pack_navmesh_check(map_out->settings, settings_room, NULL) == TL_OK &&
         (map_out->frame == NULL || tl_pack_frame_check(map_out->frame, frame_room, NULL) == TL_OK))) {
        return result;
    }
    return tl_io_fail(error_out, TL_ERR_CORRUPT, reader->path, 0, "merge it again", "has no sound settings");
}

static bool is_on_map(const tl_ground_map *map, const unsigned char *head)
{
    const unsigned char *box = head + offsetof(tl_nav_tile, bounds); // min x y z, max x y z
    for (int k = 0; k < 2; k++) {
        if ((double)tl_get_float(box + 12 + 8 * k) < map->low[k] || (double)tl_get_float(box + 8 * k) > map->high[k]) {
            return false;
        }
    }
    return true;
}

static void paint_polygon(const tl_ground_map *map, const tl_vec3 *corners, uint32_t count)
{
    const tl_aabb *box = &map->settings->bounds;
    const float range = box->max.y - box->min.y;
    float height = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 at = corners[i];
        cairo_line_to(map->cairo, tl_ground_map_pixel(map, 0, (double)at.x), tl_ground_map_pixel(map, 1, (double)at.z));
        height += at.y / (float)count;
    }
    const float share = range > 0.0f ? tl_clampf((height - box->min.y) / range, 0.0f, 1.0f) : 0.5f;
    cairo_close_path(map->cairo);
    draw_set_colour(map->cairo, draw_colour_mix(GROUND_LOW, GROUND_HIGH, share), 1.0);
    cairo_fill_preserve(map->cairo);
    cairo_stroke(map->cairo); // half a pixel over its edges, so that no seam shines through
}

static void paint_tile(tl_ground_map *map, const tl_nav_tile *tile)
{
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, p, &count);
        paint_polygon(map, corners, count);
    }
    map->tiles++;
    tl_area_sums_add(&map->sums, tile);
    const double side = (double)tile->tile_size * (double)tile->cell_size;
    if (side * map->pixels_per_metre >= LEAST_SEAM) {
        const double x = (double)tile->origin.x + side * tile->tile_x, z = (double)tile->origin.z + side * tile->tile_z;
        draw_set_colour(map->cairo, GROUND_SEAM, 0.18);
        cairo_rectangle(map->cairo, tl_ground_map_pixel(map, 0, x), tl_ground_map_pixel(map, 1, z),
                        side * map->pixels_per_metre, side * map->pixels_per_metre);
        cairo_stroke(map->cairo);
    }
}

// Reads a tile into `*bytes` and paints it, unless it lies beside the map.
static tl_result paint_chunk(tl_ground_map *map, uint32_t chunk, void **bytes, size_t *room, tl_io_error *error_out)
{
    const tl_pack_entry *entry = &map->index->entries[chunk];
    unsigned char head[TILE_HEAD_BYTES];
    if (entry->type != TL_PACK_NAVT || entry->size < TILE_HEAD_BYTES) {
        return TL_OK;
    }
    tl_result result = tl_world_reader_read(entry->offset, head, TILE_HEAD_BYTES, map->reader);
    if (result != TL_OK) {
        *error_out = map->reader->error;
        return result;
    }
    if (!is_on_map(map, head)) {
        return TL_OK;
    }
    result = read_chunk_into(map, entry, bytes, room, error_out);
    if (result == TL_OK && tl_nav_tile_check(*bytes, entry->size, NULL) != TL_OK) {
        result = tl_io_fail(error_out, TL_ERR_CORRUPT, map->reader->path, 0, "merge it again",
                            "chunk %u: no sound tile", chunk);
    }
    if (result == TL_OK) {
        paint_tile(map, *bytes);
    }
    return result;
}

tl_result tl_ground_map_paint(tl_ground_map *map, uint32_t size, const tl_progress *progress, tl_io_error *error_out)
{
    enum { STEP = 256 };
    const double longest = fmax(map->high[0] - map->low[0], map->high[1] - map->low[1]);
    if (!(longest > 0.0)) {
        return tl_io_fail(error_out, TL_ERR_EMPTY, map->reader->path, 0, "", "there is no ground to draw");
    }
    map->pixels_per_metre = (double)size / longest;
    map->width = (uint32_t)fmax(1.0, ceil((map->high[0] - map->low[0]) * map->pixels_per_metre));
    map->height = (uint32_t)fmax(1.0, ceil((map->high[1] - map->low[1]) * map->pixels_per_metre));
    map->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)map->width, (int)map->height);
    map->cairo = cairo_create(map->surface);
    if (cairo_status(map->cairo) != CAIRO_STATUS_SUCCESS) {
        return fail_ground_memory(map, error_out);
    }
    draw_set_colour(map->cairo, GROUND_NONE, 1.0);
    cairo_paint(map->cairo);
    cairo_set_line_width(map->cairo, 0.6);
    void *bytes = NULL;
    size_t room = 0;
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < map->index->count && result == TL_OK; i++) {
        result = paint_chunk(map, i, &bytes, &room, error_out);
        if (result == TL_OK && progress != NULL && i % STEP == 0 &&
            !progress->update("draw", i, map->index->count, progress->user)) {
            result = tl_io_fail(error_out, TL_ERR_CANCELLED, NULL, 0, "", "cancelled");
        }
    }
    free(bytes);
    cairo_surface_flush(map->surface);
    return result;
}

void tl_ground_map_close(tl_ground_map *map)
{
    cairo_destroy(map->cairo);
    cairo_surface_destroy(map->surface);
    free(map->settings);
    free(map->frame);
    memset(map, 0, sizeof *map);
}

void tl_ground_map_show(cairo_t *cairo, const tl_ground_map *map, const char *words,
                        void (*over)(cairo_t *cairo, const void *user), const void *user)
{
    draw_set_colour(cairo, TL_GROUND_PAPER, 1.0);
    cairo_paint(cairo);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text_within(cairo, TL_GROUND_MARGIN, 30, 20, true, draw_file_name(map->reader->path), map->width);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text_within(cairo, TL_GROUND_MARGIN, 52, 13, false, words, map->width);
    cairo_save(cairo);
    cairo_translate(cairo, TL_GROUND_MARGIN, TL_GROUND_HEAD);
    cairo_rectangle(cairo, 0, 0, map->width, map->height);
    cairo_clip(cairo);
    cairo_set_source_surface(cairo, map->surface, 0, 0);
    cairo_paint(cairo);
    if (over != NULL) {
        over(cairo, user);
    }
    cairo_restore(cairo);
    draw_scale_bar(cairo, map->pixels_per_metre, map->width, (double)TL_GROUND_MARGIN + (double)map->width,
                   (double)TL_GROUND_HEAD + (double)map->height + 28.0);
}
