// SPDX-License-Identifier: MIT

#include "world/job/tile_times.h"

#include "io/files/file_map.h"
#include "world/bytes/append_file.h"
#include "world/bytes/folder.h"
#include "world/bytes/little_endian.h"
#include "world/bytes/thread_clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TIME_MAGIC "TLT1"

void tl_world_time_encode(const tl_world_tile *tile, uint64_t nanoseconds,
                          unsigned char record_out[TL_WORLD_TIME_RECORD])
{
    memcpy(record_out, TIME_MAGIC, 4);
    tl_put_u32(record_out + 4, tile->x);
    tl_put_u32(record_out + 8, tile->z);
    tl_put_u32(record_out + 12, 0);
    tl_put_u64(record_out + 16, tile->key.low);
    tl_put_u64(record_out + 24, tile->key.high);
    tl_put_u64(record_out + 32, nanoseconds);
    tl_put_u64(record_out + 40, tl_content_checksum(record_out, 40));
}

// A name that no other process takes: the time, the shard, and where this process has its memory. Two that took the
// same would append to one file, which does no harm.
static char *name_file(const tl_world_times *times, const char *job, uint32_t shard)
{
    unsigned char seed[24] = { 0 };
    char text[TL_CONTENT_TEXT_BYTES], part[TL_CONTENT_TEXT_BYTES + 16];
    tl_put_u64(seed, tl_clock_nanoseconds());
    tl_put_u64(seed + 8, (uint64_t)(uintptr_t)times);
    tl_put_u32(seed + 16, shard);
    tl_content_hash_text(tl_content_hash_of(seed, sizeof seed), text);
    snprintf(part, sizeof part, "times/%s.times", text);
    return tl_world_job_path(job, part);
}

tl_result tl_world_times_append(tl_world_times *times, const char *job, uint32_t shard, const void *records,
                                size_t count, tl_io_error *error_out)
{
    if (times->path == NULL) {
        char *folder = tl_world_job_path(job, "times");
        times->path = name_file(times, job, shard);
        const tl_result result = folder != NULL && times->path != NULL
                                     ? tl_folder_make(folder, error_out)
                                     : tl_io_fail(error_out, TL_ERR_MEMORY, job, 0, "", "out of memory");
        free(folder);
        if (result != TL_OK) {
            free(times->path);
            times->path = NULL;
            return result;
        }
    }
    return tl_file_append(times->path, records, count * TL_WORLD_TIME_RECORD, error_out);
}

// ---- Reading -----------------------------------------------------------------------------------------------

typedef struct times_reader {
    const char *folder;
    const tl_world_plan *plan;
    uint64_t *times;
    tl_io_error *error;
} times_reader;

static void take_record(const times_reader *reader, const unsigned char *record)
{
    if (memcmp(record, TIME_MAGIC, 4) != 0 || tl_get_u64(record + 40) != tl_content_checksum(record, 40)) {
        return;
    }
    const uint32_t x = tl_get_u32(record + 4), z = tl_get_u32(record + 8);
    const uint64_t tile = tl_world_plan_find(reader->plan, x, z);
    const tl_content_hash key = { tl_get_u64(record + 16), tl_get_u64(record + 24) };
    const uint64_t time = tl_get_u64(record + 32);
    const tl_world_tile *at = tile < reader->plan->tile_count ? &reader->plan->tiles[tile] : NULL;
    if (at != NULL && at->x == x && at->z == z && tl_content_hash_equal(key, at->key) &&
        (reader->times[tile] == 0 || time < reader->times[tile])) {
        reader->times[tile] = time;
    }
}

static tl_result read_times_file(const char *name, void *user)
{
    const times_reader *reader = user;
    const size_t length = strlen(name);
    if (length < 6 || strcmp(name + length - 6, ".times") != 0) {
        return TL_OK;
    }
    char *path = tl_world_job_path(reader->folder, name);
    tl_file_map map;
    tl_result result = path != NULL ? tl_file_read(path, 0, &map, reader->error)
                                    : tl_io_fail(reader->error, TL_ERR_MEMORY, name, 0, "", "out of memory");
    if (result == TL_OK) {
        for (size_t at = 0; map.size - at >= TL_WORLD_TIME_RECORD; at += TL_WORLD_TIME_RECORD) {
            take_record(reader, (const unsigned char *)map.bytes + at);
        }
        tl_file_map_close(&map);
    }
    free(path);
    return result;
}

tl_result tl_world_times_read(const char *job, const tl_world_plan *plan, uint64_t **times_out, tl_io_error *error_out)
{
    char *folder = tl_world_job_path(job, "times");
    times_reader reader = { folder, plan, calloc((size_t)plan->tile_count + 1, sizeof *reader.times), error_out };
    tl_result result = TL_OK;
    if (folder == NULL || reader.times == NULL) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, job, 0, "", "out of memory");
    } else if (tl_file_look(folder, NULL)) {
        result = tl_folder_list(folder, read_times_file, &reader, error_out);
    }
    if (result != TL_OK) {
        free(reader.times);
        reader.times = NULL;
    }
    free(folder);
    *times_out = reader.times;
    return result;
}
