// SPDX-License-Identifier: MIT

#include "world/job/tile_sums.h"

#include "io/files/atomic_write.h"
#include "io/files/file_map.h"
#include "world/bytes/little_endian.h"

#include <stdlib.h>
#include <string.h>

#define SUMS_MAGIC "TLWSUMS\n"

enum { SUM_BYTES = 24, SUMS_HEAD = 16, FIRST_SLOTS = 1024 };

tl_content_hash tl_world_record_hash(const tl_world_cell *cell, const unsigned char *record)
{
    unsigned char bytes[16 + TL_WORLD_RECORD_BYTES];
    tl_put_u32(bytes, (uint32_t)cell->level);
    tl_put_u32(bytes + 4, (uint32_t)cell->x);
    tl_put_u32(bytes + 8, (uint32_t)cell->y);
    tl_put_u32(bytes + 12, (uint32_t)cell->z);
    memcpy(bytes + 16, record, TL_WORLD_RECORD_BYTES);
    return tl_content_hash_of(bytes, sizeof bytes);
}

// A hash table by tile, by linear probing, at most half full; a row without triangles is free.
typedef struct sum_table {
    tl_world_tile_sum *slots;
    uint64_t mask, count;
    uint64_t last; // slot
} sum_table;

static uint64_t slot_of(const sum_table *table, uint32_t tile)
{
    uint64_t slot = ((uint64_t)tile * UINT64_C(0x9e3779b97f4a7c15) >> 32) & table->mask;
    while (table->slots[slot].triangles != 0 && table->slots[slot].tile != tile) {
        slot = (slot + 1) & table->mask;
    }
    return slot;
}

static bool grow_table(sum_table *table)
{
    const uint64_t size = table->slots != NULL ? 2 * (table->mask + 1) : FIRST_SLOTS;
    sum_table grown = { size < SIZE_MAX / 64 ? calloc((size_t)size, sizeof *grown.slots) : NULL, size - 1, table->count,
                        0 };
    if (grown.slots == NULL) {
        return false;
    }
    for (uint64_t i = 0; table->slots != NULL && i <= table->mask; i++) {
        if (table->slots[i].triangles != 0) {
            grown.slots[slot_of(&grown, table->slots[i].tile)] = table->slots[i];
        }
    }
    free(table->slots);
    *table = grown;
    return true;
}

static bool add_to_tile(sum_table *table, uint32_t tile, tl_content_hash hash)
{
    uint64_t slot = table->last; // triangles of a cell mostly lie in one tile
    if (table->slots[slot].triangles == 0 || table->slots[slot].tile != tile) {
        slot = slot_of(table, tile);
    }
    if (table->slots[slot].triangles == 0) {
        if (2 * (table->count + 1) > table->mask + 1) {
            if (!grow_table(table)) {
                return false;
            }
            slot = slot_of(table, tile);
        }
        table->slots[slot].tile = tile;
        table->count++;
    }
    tl_world_tile_sum *row = &table->slots[slot];
    row->triangles++;
    row->sum = tl_content_hash_add(row->sum, hash);
    table->last = slot;
    return true;
}

static bool sum_records(const tl_world_grid *grid, const tl_world_segment_cell *cell, const unsigned char *records,
                        sum_table *table)
{
    double origin[3];
    tl_world_cell_origin(&cell->cell, grid->cell_size, origin);
    for (uint32_t i = 0; i < cell->count; i++) {
        const unsigned char *record = records + (size_t)i * TL_WORLD_RECORD_BYTES;
        tl_nav_tile_range range;
        if (!tl_world_grid_tiles_of_record(grid, origin, record, &range)) {
            continue;
        }
        const tl_content_hash hash = tl_world_record_hash(&cell->cell, record);
        for (uint32_t z = range.z; z < range.z + range.count_z; z++) {
            for (uint32_t x = range.x; x < range.x + range.count_x; x++) {
                if (!add_to_tile(table, z * grid->tiles_x + x, hash)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static int compare_sums(const void *a, const void *b)
{
    const uint32_t x = ((const tl_world_tile_sum *)a)->tile, y = ((const tl_world_tile_sum *)b)->tile;
    return x < y ? -1 : x > y;
}

static void pack_rows(sum_table *table, tl_world_tile_sums *sums)
{
    uint64_t count = 0;
    for (uint64_t i = 0; i <= table->mask; i++) {
        if (table->slots[i].triangles != 0) {
            table->slots[count++] = table->slots[i];
        }
    }
    qsort(table->slots, (size_t)count, sizeof *table->slots, compare_sums);
    sums->rows = table->slots;
    sums->count = count;
}

tl_result tl_world_tile_sums_make(const tl_world_grid *grid, const tl_world_segment *segment,
                                  tl_world_tile_sums *sums_out, tl_io_error *error_out)
{
    memset(sums_out, 0, sizeof *sums_out);
    uint32_t largest = 1;
    for (uint64_t c = 0; c < segment->head.cells; c++) {
        largest = segment->cells[c].count > largest ? segment->cells[c].count : largest;
    }
    sum_table table = { NULL, 0, 0, 0 };
    unsigned char *records = malloc((size_t)largest * TL_WORLD_RECORD_BYTES);
    tl_result result = TL_OK;
    bool memory = records != NULL && grow_table(&table);
    for (uint64_t c = 0; c < segment->head.cells && memory && result == TL_OK; c++) {
        tl_nav_tile_range range;
        if (tl_world_grid_tiles_of_cell(grid, &segment->cells[c], &range)) {
            result = tl_world_segment_read(segment, c, records, error_out);
            memory = result != TL_OK || sum_records(grid, &segment->cells[c], records, &table);
        }
    }
    free(records);
    if (!memory) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, segment->path, 0, "", "out of memory");
    }
    if (result != TL_OK) {
        free(table.slots);
        return result;
    }
    pack_rows(&table, sums_out);
    return TL_OK;
}

// ---- Files of sums: magic, u64 rows, and each: u32 tile, u32 triangles, u64 sum twice; the checksum, u64 -----

static bool load_sums(const char *path, const tl_world_grid *grid, tl_world_tile_sums *sums)
{
    tl_file_map map;
    if (tl_file_read(path, 0, &map, NULL) != TL_OK) {
        return false;
    }
    const unsigned char *bytes = map.bytes;
    bool sound = map.size >= SUMS_HEAD + 8 && memcmp(bytes, SUMS_MAGIC, 8) == 0 &&
                 tl_get_u64(bytes + 8) == (map.size - SUMS_HEAD - 8) / SUM_BYTES &&
                 (map.size - SUMS_HEAD - 8) % SUM_BYTES == 0 &&
                 tl_get_u64(bytes + map.size - 8) == tl_content_checksum(bytes, map.size - 8);
    const uint64_t count = sound ? tl_get_u64(bytes + 8) : 0, places = (uint64_t)grid->tiles_x * grid->tiles_z;
    sums->rows = sound ? malloc((size_t)count * sizeof *sums->rows + 1) : NULL;
    for (uint64_t i = 0; i < count && sums->rows != NULL && sound; i++) {
        const unsigned char *at = bytes + SUMS_HEAD + i * SUM_BYTES;
        const tl_world_tile_sum row = { tl_get_u32(at),
                                        tl_get_u32(at + 4),
                                        { tl_get_u64(at + 8), tl_get_u64(at + 16) } };
        sound = row.tile < places && row.triangles > 0 && (i == 0 || row.tile > sums->rows[i - 1].tile);
        sums->rows[i] = row;
    }
    sums->count = count;
    tl_file_map_close(&map);
    if (sums->rows == NULL || !sound) {
        tl_world_tile_sums_free(sums);
        return false;
    }
    return true;
}

static tl_result save_sums(const char *path, const tl_world_tile_sums *sums, tl_io_error *error_out)
{
    const size_t size = SUMS_HEAD + (size_t)sums->count * SUM_BYTES + 8;
    unsigned char *bytes = malloc(size);
    if (bytes == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
    }
    memcpy(bytes, SUMS_MAGIC, 8);
    tl_put_u64(bytes + 8, sums->count);
    for (uint64_t i = 0; i < sums->count; i++) {
        unsigned char *at = bytes + SUMS_HEAD + i * SUM_BYTES;
        tl_put_u32(at, sums->rows[i].tile);
        tl_put_u32(at + 4, sums->rows[i].triangles);
        tl_put_u64(at + 8, sums->rows[i].sum.low);
        tl_put_u64(at + 16, sums->rows[i].sum.high);
    }
    tl_put_u64(bytes + size - 8, tl_content_checksum(bytes, size - 8));
    const tl_result result = tl_atomic_write_unflushed(path, bytes, size, error_out);
    free(bytes);
    return result;
}

tl_result tl_world_tile_sums_get(const tl_world_grid *grid, const tl_world_segment *segment, const char *path,
                                 tl_world_tile_sums *sums_out, tl_io_error *error_out)
{
    memset(sums_out, 0, sizeof *sums_out);
    if (load_sums(path, grid, sums_out)) {
        return TL_OK;
    }
    tl_result result = tl_world_tile_sums_make(grid, segment, sums_out, error_out);
    if (result == TL_OK) {
        result = save_sums(path, sums_out, error_out);
        if (result != TL_OK) {
            tl_world_tile_sums_free(sums_out);
        }
    }
    return result;
}

bool tl_world_tile_sums_add(tl_world_tile_sums *sums, tl_world_tile_sums *more)
{
    tl_world_tile_sum *rows = malloc((size_t)(sums->count + more->count) * sizeof *rows + 1);
    uint64_t i = 0, k = 0, count = 0;
    while (rows != NULL && (i < sums->count || k < more->count)) {
        const uint64_t a = i < sums->count ? sums->rows[i].tile : UINT64_MAX;
        const uint64_t b = k < more->count ? more->rows[k].tile : UINT64_MAX;
        rows[count] = a <= b ? sums->rows[i] : more->rows[k];
        if (a == b) {
            rows[count].triangles += more->rows[k].triangles;
            rows[count].sum = tl_content_hash_add(rows[count].sum, more->rows[k].sum);
        }
        i += a <= b;
        k += b <= a;
        count++;
    }
    tl_world_tile_sums_free(more);
    if (rows != NULL) {
        free(sums->rows);
        sums->rows = rows;
        sums->count = count;
    }
    return rows != NULL;
}

void tl_world_tile_sums_free(tl_world_tile_sums *sums)
{
    free(sums->rows);
    memset(sums, 0, sizeof *sums);
}
