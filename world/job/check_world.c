// SPDX-License-Identifier: MIT
//
// The file is read once, front to back, a chunk at a time. Tiles come by z, so a navmesh of the row that is read and
// the one before joins every two tiles that are neighbours; what lies further back leaves it.

#include "io/files/file_pack.h"
#include "world/job/merge_tiles.h"
#include "world/job/world_reader.h"

#include <stdlib.h>
#include <string.h>
#include <talus/nav_routes.h>

enum { FIRST_ROOM = 64 };

typedef struct check_job {
    const char *path;
    tl_world_reader reader;
    tl_pack_navmesh *settings;
    tl_navmesh *rows;
    tl_nav_tile **held; // [held_count], of `rows`, by z
    uint32_t held_count, held_room;
    tl_nav_tile last; // the head of the last tile, for the order
    bool has_last, has_links;
    tl_world_check_report *report;
    tl_io_error *error;
} check_job;

static tl_result fail_chunk(const check_job *job, tl_result result, uint32_t chunk, const char *what)
{
    return tl_io_blame(job->error,
                       tl_io_fail(job->error, result, job->path, 0, "merge it again", "chunk %u: %s", chunk, what),
                       "chunk", chunk);
}

static tl_result fail_check_memory(const check_job *job)
{
    return tl_io_fail(job->error, TL_ERR_MEMORY, job->path, 0, "", "out of memory");
}

static int compare_places(const tl_nav_tile *a, const tl_nav_tile *b)
{
    const int64_t x[3] = { a->tile_z, a->tile_x, (int64_t)a->layer },
                  y[3] = { b->tile_z, b->tile_x, (int64_t)b->layer };
    for (int i = 0; i < 3; i++) {
        if (x[i] != y[i]) {
            return x[i] < y[i] ? -1 : 1;
        }
    }
    return 0;
}

static const char *tile_fault(const tl_nav_tile *tile, const tl_nav_tile *before, const tl_pack_navmesh *navmesh)
{
    const tl_vec3 origin = navmesh->bounds.min;
    if (tile->tile_x < 0 || tile->tile_z < 0 || (uint32_t)tile->tile_x >= navmesh->tiles_x ||
        (uint32_t)tile->tile_z >= navmesh->tiles_z) {
        return "a tile that lies outside the grid";
    }
    if (tile->tile_size != navmesh->tile_size || tile->cell_size != navmesh->cell_size ||
        tile->cell_height != navmesh->cell_height || tile->origin.x != origin.x || tile->origin.y != origin.y ||
        tile->origin.z != origin.z) {
        return "a tile of another lattice";
    }
    if (before != NULL && compare_places(before, tile) >= 0) {
        return "a tile that is there twice, or out of order";
    }
    return NULL;
}

// ---- Rows of tiles -----------------------------------------------------------------------------------------

// Takes out the rows before that of `z` less one.
static void drop_rows(check_job *job, int32_t z)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < job->held_count; i++) {
        tl_nav_tile *tile = job->held[i];
        if (tile->tile_z >= z - 1) {
            job->held[count++] = tile;
        } else {
            (void)tl_navmesh_remove_layer(job->rows, tile->tile_x, tile->layer, tile->tile_z);
            free(tile);
        }
    }
    job->held_count = count;
}

static bool reserve_held(check_job *job)
{
    if (job->held_count < job->held_room) {
        return true;
    }
    const uint32_t room = job->held_room > 0 ? 2 * job->held_room : FIRST_ROOM;
    tl_nav_tile **grown = realloc(job->held, (size_t)room * sizeof *grown);
    if (grown == NULL) {
        return false;
    }
    job->held = grown;
    job->held_room = room;
    return true;
}

// Joins the tile with its neighbours. Its memory is the job's from now on.
static tl_result join_tile(check_job *job, uint32_t chunk, tl_nav_tile *tile)
{
    if (!job->has_last || tile->tile_z != job->last.tile_z) {
        drop_rows(job, tile->tile_z);
    }
    const tl_result result =
        reserve_held(job) ? tl_navmesh_add_tile(job->rows, tile, TL_NAV_TILE_BORROWED) : TL_ERR_MEMORY;
    if (result != TL_OK) {
        free(tile);
        return result == TL_ERR_MEMORY ? fail_check_memory(job)
                                       : fail_chunk(job, result, chunk, "the tile does not join the others");
    }
    job->held[job->held_count++] = tile;
    return TL_OK;
}

// ---- Chunks ------------------------------------------------------------------------------------------------

static tl_result take_tile(check_job *job, uint32_t chunk, tl_nav_tile *tile)
{
    const char *fault = tl_nav_tile_check(tile, job->reader.index.entries[chunk].size, NULL) != TL_OK
                            ? "no sound tile"
                            : tile_fault(tile, job->has_last ? &job->last : NULL, job->settings);
    if (fault != NULL) {
        free(tile);
        return fail_chunk(job, TL_ERR_CORRUPT, chunk, fault);
    }
    job->report->tiles++;
    job->report->polygons += tile->polygon_count;
    job->report->links += tile->portal_count;
    job->report->area += tile->area;
    const tl_nav_tile head = *tile;
    const tl_result result = join_tile(job, chunk, tile);
    job->last = head;
    job->has_last = true;
    return result;
}

static bool is_zero(const unsigned char *bytes, size_t size)
{
    size_t i = 0;
    while (i < size && bytes[i] == 0) {
        i++;
    }
    return i == size;
}

// The chunk and the padding behind it, verified. The bytes are freed with free().
static tl_result read_chunk(const check_job *job, uint32_t chunk, void **bytes_out)
{
    const tl_pack_index *index = &job->reader.index;
    const tl_pack_entry *entry = &index->entries[chunk];
    const uint64_t end = chunk + 1 < index->count ? entry[1].offset : index->file_size;
    const size_t size = (size_t)(end - entry->offset);
    *bytes_out = NULL;
    unsigned char *bytes = end - entry->offset < SIZE_MAX ? malloc(size + 1) : NULL;
    if (bytes == NULL) {
        return fail_check_memory(job);
    }
    tl_result result = tl_random_file_read(&job->reader.file, job->path, entry->offset, bytes, size, job->error);
    if (result == TL_OK) {
        const bool is_clear = is_zero(bytes + entry->size, size - (size_t)entry->size);
        result = is_clear ? tl_pack_entry_open(entry, bytes, NULL) : TL_ERR_CORRUPT;
        if (result != TL_OK) {
            result = fail_chunk(job, result, chunk, is_clear ? tl_result_text(result) : "bytes behind it are not zero");
        }
    }
    if (result != TL_OK) {
        free(bytes);
        return result;
    }
    *bytes_out = bytes;
    return TL_OK;
}

static tl_result read_settings(check_job *job)
{
    uint32_t chunk = 0;
    while (chunk < job->reader.index.count && job->reader.index.entries[chunk].type != TL_PACK_NAVM) {
        chunk++;
    }
    tl_result result = TL_ERR_CORRUPT;
    if (chunk < job->reader.index.count) {
        void *bytes;
        result = read_chunk(job, chunk, &bytes);
        if (result != TL_OK) {
            return result;
        }
        job->settings = bytes;
        result = tl_pack_navmesh_check(bytes, job->reader.index.entries[chunk].size, NULL);
    }
    return result == TL_OK ? TL_OK
                           : tl_io_fail(job->error, TL_ERR_CORRUPT, job->path, 0, "give a file of 'talus world merge'",
                                        "holds no navmesh's settings");
}

static tl_result check_file_routes(const check_job *job, uint32_t chunk, const void *bytes)
{
    const tl_pack_index *index = &job->reader.index;
    tl_report why;
    tl_result result = tl_nav_routes_check(bytes, index->entries[chunk].size, &why);
    if (result == TL_OK) {
        result = tl_nav_routes_check_tiles(bytes, index, &why);
    }
    return result == TL_OK ? TL_OK : fail_chunk(job, result, chunk, why.advice);
}

static tl_result check_chunks(check_job *job)
{
    for (uint32_t i = 0; i < job->reader.index.count; i++) {
        const uint32_t type = job->reader.index.entries[i].type;
        void *bytes;
        tl_result result = read_chunk(job, i, &bytes);
        if (result == TL_OK && type == TL_PACK_NAVT) {
            result = take_tile(job, i, bytes);
        } else {
            result = result == TL_OK && type == TL_PACK_ROUT ? check_file_routes(job, i, bytes) : result;
            free(bytes);
        }
        if (result != TL_OK) {
            return result;
        }
        job->has_links = job->has_links || type == TL_PACK_LINK || type == TL_PACK_OFFM;
    }
    job->report->tiles_x = job->settings->tiles_x;
    job->report->tiles_z = job->settings->tiles_z;
    if (job->report->tiles != job->settings->tile_count) {
        return tl_io_fail(job->error, TL_ERR_CORRUPT, job->path, 0, "merge it again", "holds %llu tiles, and says %u",
                          (unsigned long long)job->report->tiles, job->settings->tile_count);
    }
    return TL_OK;
}

// Links are anchored to tiles anywhere: a file with some is joined as a whole, in memory.
static tl_result join_links(check_job *job)
{
    tl_file_map map;
    tl_pack pack;
    tl_report why;
    tl_navmesh *navmesh = NULL;
    memset(&why, 0, sizeof why);
    tl_result result = tl_file_read(job->path, 0, &map, job->error);
    if (result != TL_OK) {
        return result;
    }
    result = tl_file_open_pack(&map, &pack, &why);
    if (result == TL_OK) {
        result = tl_pack_load_navmesh(&pack, NULL, &navmesh, &why);
    }
    tl_navmesh_destroy(navmesh);
    tl_file_map_close(&map);
    return result == TL_OK ? TL_OK : tl_world_reader_fail(&job->reader, result, &why, job->error);
}

// ---- The file ----------------------------------------------------------------------------------------------

// Between the index and the first chunk.
static tl_result check_padding(const check_job *job)
{
    unsigned char padding[TL_BLOB_ALIGNMENT];
    const tl_pack_index *index = &job->reader.index;
    const uint64_t end = TL_PACK_HEAD_SIZE + (uint64_t)index->count * sizeof *index->entries;
    const size_t size = (size_t)((index->count > 0 ? index->entries[0].offset : index->file_size) - end);
    tl_result result = tl_random_file_read(&job->reader.file, job->path, end, padding, size, job->error);
    if (result == TL_OK && !is_zero(padding, size)) {
        result = tl_io_fail(job->error, TL_ERR_CORRUPT, job->path, 0, "merge it again",
                            "bytes behind its table are not zero");
    }
    return result;
}

static tl_result check_file(check_job *job)
{
    tl_result result = tl_world_reader_open(job->path, &job->reader, job->error);
    if (result == TL_OK) {
        result = tl_world_reader_index(&job->reader, job->error);
    }
    if (result == TL_OK) {
        result = check_padding(job);
    }
    if (result == TL_OK) {
        result = read_settings(job);
    }
    if (result == TL_OK && tl_navmesh_create(NULL, &job->rows) != TL_OK) {
        result = fail_check_memory(job);
    }
    if (result == TL_OK) {
        result = check_chunks(job);
    }
    if (result == TL_OK && job->has_links) {
        result = join_links(job);
    }
    return result;
}

tl_result tl_world_check(const char *path, tl_world_check_report *report_out, tl_io_error *error_out)
{
    check_job job;
    memset(&job, 0, sizeof job);
    memset(report_out, 0, sizeof *report_out);
    job.path = path;
    job.report = report_out;
    job.error = error_out;
    const tl_result result = check_file(&job);
    tl_navmesh_destroy(job.rows);
    for (uint32_t i = 0; i < job.held_count; i++) {
        free(job.held[i]);
    }
    free(job.held);
    free(job.settings);
    tl_world_reader_close(&job.reader);
    return result;
}
