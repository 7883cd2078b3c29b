// SPDX-License-Identifier: MIT
//
// What RecastDemo saves: the grid, then each tile behind its reference; or a tile alone, which is then the whole
// navmesh.

#include "nav_format/detour_read.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>

tl_detour_read_def tl_default_detour_read_def(void)
{
    tl_detour_read_def def = { 1.0f / 1024.0f, NULL, TL_DEF_COOKIE };
    return def;
}

typedef struct set_reader {
    const uint8_t *bytes;
    uint64_t size, at;
    tl_detour_set_header header;
    uint32_t entry_bytes; // 8 or 16; 0: not known before the first tile
} set_reader;

static tl_result open_set(set_reader *set, tl_detour_report *report)
{
    tl_detour_set_header *h = &set->header;
    if (set->size < sizeof *h) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "set", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    memcpy(h, set->bytes, sizeof *h);
    set->at = sizeof *h;
    if (h->version != TL_DETOUR_SET_VERSION) {
        return tl_report_fail(&report->base, TL_ERR_VERSION, "set", TL_NO_ELEMENT, "sets of version 1 can be read");
    }
    if (!tl_detour_is_finite(h->params.origin) || !isfinite(h->params.tile_width) || !isfinite(h->params.tile_height)) {
        return tl_report_fail(&report->base, TL_ERR_NOT_FINITE, "set", TL_NO_ELEMENT, "use finite numbers");
    }
    if (h->tile_count <= 0 || (uint32_t)h->tile_count > TL_NAV_MAX_TILES) {
        return tl_report_fail(&report->base, h->tile_count == 0 ? TL_ERR_EMPTY : TL_ERR_CORRUPT, "set", TL_NO_ELEMENT,
                              "the number of its tiles is wrong");
    }
    return TL_OK;
}

static uint32_t word_at(const set_reader *set, uint64_t offset)
{
    uint32_t word = 0;
    if (offset + 4 <= set->size) {
        memcpy(&word, set->bytes + offset, 4);
    }
    return word;
}

// A tile's data begins with its magic, eight bytes behind its entry or sixteen.
static tl_result next_tile(set_reader *set, uint32_t index, tl_detour_tile_bytes *tile, tl_detour_report *report)
{
    if (set->entry_bytes == 0) {
        set->entry_bytes = word_at(set, set->at + 8) == TL_DETOUR_TILE_MAGIC ? 8 : 16;
    }
    uint64_t begin = set->at + set->entry_bytes;
    uint64_t length = word_at(set, set->at + set->entry_bytes / 2);
    if (begin > set->size || length > set->size - begin) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "tile", index, "the bytes end too early: give them all");
    }
    TL_TRY(tl_detour_open_tile(set->bytes + begin, length, tile, report));
    set->at = begin + length;
    const tl_detour_params *params = &set->header.params;
    tile->origin = tl_vec3_make(params->origin[0], params->origin[1], params->origin[2]);
    if (set->header.tile_count == 1 && tile->header.x == 0 && tile->header.y == 0) {
        return TL_OK;
    }
    double cells = (double)params->tile_width * (double)tile->header.quantization;
    double off;
    int32_t size = tl_detour_nearest_step(cells, &off);
    if (off > TL_DETOUR_ON_LATTICE || size <= 0 || size == INT32_MAX || params->tile_width != params->tile_height) {
        return tl_report_fail(&report->base, TL_ERR_RANGE, "tile", index, "tiles are squares of whole cells");
    }
    if (tile->header.layer < 0 || (uint32_t)tile->header.layer > TL_NAV_MAX_LAYER) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "tile", index, "layers are 0 to 65535");
    }
    tile->tile_size = (uint32_t)size;
    return TL_OK;
}

static tl_result read_tile_set(set_reader *set, const tl_detour_read_def *def, tl_detour_report *report,
                               tl_detour_tiles *tiles)
{
    TL_TRY(open_set(set, report));
    uint32_t count = (uint32_t)set->header.tile_count;
    // A tile takes at least its header: no more room is taken than the bytes can fill.
    if ((uint64_t)count * sizeof(tl_detour_header) > set->size) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "set", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    tiles->tiles = tl_allocate_array(def->allocator, count, sizeof *tiles->tiles);
    if (tiles->tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(tiles->tiles, 0, count * sizeof *tiles->tiles);
    tiles->tile_count = count;
    for (uint32_t i = 0; i < count; i++) {
        tl_detour_tile_bytes tile;
        memset(&tile, 0, sizeof tile);
        TL_TRY(next_tile(set, i, &tile, report));
        TL_TRY(tl_detour_read_tile(&tile, def, report, &tiles->tiles[i]));
    }
    return TL_OK;
}

static tl_result read_single(const void *bytes, uint64_t size, const tl_detour_read_def *def, tl_detour_report *report,
                             tl_detour_tiles *tiles)
{
    tl_detour_tile_bytes tile;
    memset(&tile, 0, sizeof tile);
    TL_TRY(tl_detour_open_tile(bytes, size, &tile, report));
    tile.origin = tl_vec3_make(tile.header.min[0], tile.header.min[1], tile.header.min[2]);
    tiles->tiles = tl_allocate_array(def->allocator, 1, sizeof *tiles->tiles);
    if (tiles->tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    tiles->tiles[0] = NULL;
    tiles->tile_count = 1;
    return tl_detour_read_tile(&tile, def, report, &tiles->tiles[0]);
}

static tl_result read_any(const void *bytes, uint64_t size, const tl_detour_read_def *def, tl_detour_report *report,
                          tl_detour_tiles *tiles)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_detour_read_def()", &report->base));
    TL_REFUSE_NULL(bytes, &report->base);
    if (!(def->cell_height >= TL_NAV_MIN_CELL) || !isfinite(def->cell_height)) {
        return tl_report_field(&report->base, TL_ERR_ARGUMENT, "cell_height", "make it >= TL_NAV_MIN_CELL");
    }
    tl_detour_bytes open;
    tl_result result = tl_detour_open_bytes(bytes, size, def->allocator, &open);
    if (result == TL_OK) {
        set_reader set;
        memset(&set, 0, sizeof set);
        set.bytes = open.bytes;
        set.size = size;
        result = word_at(&set, 0) == TL_DETOUR_SET_MAGIC ? read_tile_set(&set, def, report, tiles)
                                                         : read_single(open.bytes, size, def, report, tiles);
    }
    tl_detour_close_bytes(&open);
    return result;
}

tl_result tl_detour_read(const void *bytes, uint64_t size, const tl_detour_read_def *def, tl_detour_tiles *tiles_out,
                         tl_detour_report *report_out)
{
    tl_detour_read_def settings = def != NULL ? *def : tl_default_detour_read_def();
    tl_allocator allocator = tl_allocator_or_default(settings.allocator);
    settings.allocator = &allocator;
    tl_detour_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "read detour");
    tl_result result = tl_refuse_null(tiles_out, "tiles_out", &report.base);
    if (result == TL_OK) {
        memset(tiles_out, 0, sizeof *tiles_out);
        tiles_out->allocator = allocator;
        result = read_any(bytes, size, &settings, &report, tiles_out);
    }
    if (result != TL_OK) {
        tl_detour_tiles_free(tiles_out);
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}

void tl_detour_tiles_free(tl_detour_tiles *tiles)
{
    if (tiles != NULL) {
        tl_blob_array_free(&tiles->allocator, tiles->tiles, tiles->tile_count);
        memset(tiles, 0, sizeof *tiles);
    }
}

// ---------------------------------------------------------------------------------------------------------
// Off-mesh connections.

typedef struct connection_list {
    tl_detour_off_mesh *links;
    uint32_t capacity, count;
} connection_list;

static tl_result read_connection(const tl_detour_tile_bytes *tile, uint32_t index, connection_list *list,
                                 tl_detour_report *report)
{
    tl_detour_connection from;
    tl_detour_polygon polygon;
    memcpy(&from, tile->bytes + tile->at.off_mesh + (uint64_t)index * sizeof from, sizeof from);
    if (from.polygon >= (uint32_t)tile->header.polygon_count) {
        return tl_report_fail(&report->base, TL_ERR_CORRUPT, "connection", list->count, "its polygon is out of range");
    }
    if (!tl_detour_is_finite(from.ends[0]) || !tl_detour_is_finite(from.ends[1]) || !isfinite(from.radius)) {
        return tl_report_fail(&report->base, TL_ERR_NOT_FINITE, "connection", list->count, "use finite numbers");
    }
    memcpy(&polygon, tile->bytes + tile->at.polygons + (uint64_t)from.polygon * sizeof polygon, sizeof polygon);
    if (list->count < list->capacity) {
        tl_detour_off_mesh *link = &list->links[list->count];
        memset(link, 0, sizeof *link);
        link->start = tl_vec3_make(from.ends[0][0], from.ends[0][1], from.ends[0][2]);
        link->end = tl_vec3_make(from.ends[1][0], from.ends[1][1], from.ends[1][2]);
        link->radius = from.radius;
        link->user_id = from.user_id;
        link->flags = polygon.flags;
        link->area = polygon.area_and_type & 0x3f;
        link->both_ways = (from.flags & TL_DETOUR_BOTH_WAYS) != 0;
    }
    list->count++;
    return TL_OK;
}

static tl_result read_connections(const tl_detour_tile_bytes *tile, connection_list *list, tl_detour_report *report)
{
    for (uint32_t i = 0; i < (uint32_t)tile->header.off_mesh_count; i++) {
        TL_TRY(read_connection(tile, i, list, report));
    }
    return TL_OK;
}

static tl_result read_all_connections(set_reader *set, connection_list *list, tl_detour_report *report)
{
    tl_detour_tile_bytes tile;
    memset(&tile, 0, sizeof tile);
    if (word_at(set, 0) != TL_DETOUR_SET_MAGIC) {
        TL_TRY(tl_detour_open_tile(set->bytes, set->size, &tile, report));
        return read_connections(&tile, list, report);
    }
    TL_TRY(open_set(set, report));
    for (uint32_t i = 0; i < (uint32_t)set->header.tile_count; i++) {
        TL_TRY(next_tile(set, i, &tile, report));
        TL_TRY(read_connections(&tile, list, report));
    }
    return TL_OK;
}

tl_result tl_detour_read_off_mesh(const void *bytes, uint64_t size, tl_detour_off_mesh *links_out, uint32_t capacity,
                                  uint32_t *count_out, tl_detour_report *report_out)
{
    tl_detour_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "read detour");
    connection_list list = { links_out, capacity, 0 };
    tl_result result = tl_refuse_null(bytes, "bytes", &report.base);
    if (result == TL_OK) {
        result = tl_refuse_null(count_out, "count_out", &report.base);
    }
    if (result == TL_OK) {
        tl_detour_bytes open;
        set_reader set;
        memset(&set, 0, sizeof set);
        result = tl_detour_open_bytes(bytes, size, NULL, &open);
        set.bytes = open.bytes;
        set.size = size;
        result = result == TL_OK ? read_all_connections(&set, &list, &report) : result;
        tl_detour_close_bytes(&open);
    }
    if (count_out != NULL) {
        *count_out = result == TL_OK ? list.count : 0;
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result == TL_OK && list.count > capacity ? TL_INCOMPLETE : result;
}
