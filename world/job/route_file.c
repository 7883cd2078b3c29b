// SPDX-License-Identifier: MIT
//
// Chunks are copied one at a time as they stand in the file, so neither file is ever in memory.

#include "world/job/route_file.h"

#include "io/files/atomic_write.h"

#include <stdlib.h>
#include <string.h>
#include <talus/pack.h>

// ---- Writing the file again ----------------------------------------------------------------------------------

typedef struct route_job {
    const tl_world_routes_def *def;
    tl_world_reader reader;
    tl_pack_entry *entries; // of the new file, with the offsets of the old one
    uint32_t count;
    tl_nav_routes *routes;
    void *chunk;
    size_t chunk_room;
    tl_atomic_file *file;
    tl_io_error *error;
} route_job;

static tl_result fail_route_memory(const route_job *job)
{
    return tl_io_fail(job->error, TL_ERR_MEMORY, job->reader.path, 0, "", "out of memory");
}

static tl_result bake_file_routes(route_job *job, tl_world_routes_report *report)
{
    tl_nav_routes_def def = tl_default_nav_routes_def();
    tl_report why;
    def.read = tl_world_reader_read;
    def.user = &job->reader;
    def.block = job->def->block != 0 ? job->def->block : def.block;
    def.host = job->def->host;
    const tl_result result = tl_nav_routes_bake(&def, &job->routes, &why);
    if (result != TL_OK) {
        return tl_world_reader_fail(&job->reader, result, &why, job->error);
    }
    report->gates = job->routes->gate_count;
    report->lengths = job->routes->length_count;
    report->route_bytes = job->routes->blob.size;
    return TL_OK;
}

static tl_result list_chunks(route_job *job, tl_world_routes_report *report)
{
    job->entries = malloc(((size_t)job->reader.index.count + 1) * sizeof *job->entries);
    if (job->entries == NULL) {
        return fail_route_memory(job);
    }
    for (uint32_t i = 0; i < job->reader.index.count; i++) {
        if (job->reader.index.entries[i].type != TL_PACK_ROUT) {
            job->entries[job->count++] = job->reader.index.entries[i];
            report->tiles += job->reader.index.entries[i].type == TL_PACK_NAVT;
        }
    }
    tl_result result = tl_blob_to_file_order(job->routes, job->routes->blob.size, NULL);
    if (result == TL_OK) {
        result = tl_pack_entry_make(TL_PACK_ROUT, 0, job->routes, report->route_bytes, &job->entries[job->count++]);
    }
    return result == TL_OK
               ? result
               : tl_io_fail(job->error, result, job->reader.path, 0, "", "routes: %s", tl_result_text(result));
}

static tl_result fetch_file_chunk(uint32_t index, const void **bytes_out, void *user)
{
    route_job *job = user;
    const tl_pack_entry *entry = &job->entries[index];
    if (entry->type == TL_PACK_ROUT) {
        *bytes_out = job->routes;
        return TL_OK;
    }
    if (entry->size > job->chunk_room) {
        void *room = realloc(job->chunk, (size_t)entry->size);
        if (room == NULL) {
            return fail_route_memory(job);
        }
        job->chunk = room;
        job->chunk_room = (size_t)entry->size;
    }
    *bytes_out = job->chunk;
    const tl_result result = tl_world_reader_read(entry->offset, job->chunk, (size_t)entry->size, &job->reader);
    if (result != TL_OK) {
        *job->error = job->reader.error;
    }
    return result;
}

static tl_result write_file_bytes(const void *bytes, size_t size, void *user)
{
    route_job *job = user;
    return tl_atomic_file_write(job->file, bytes, size, job->error);
}

static tl_result write_with_routes(route_job *job, tl_world_routes_report *report)
{
    tl_report why;
    tl_result result = tl_atomic_file_open(job->def->output, &job->file, job->error);
    if (result != TL_OK) {
        return result;
    }
    result = tl_pack_write_fetched(job->entries, job->count, NULL, fetch_file_chunk, write_file_bytes, job, &why);
    if (result != TL_OK) {
        tl_atomic_file_abort(job->file);
        return job->error->result != TL_OK ? result : tl_world_reader_fail(&job->reader, result, &why, job->error);
    }
    report->bytes = tl_atomic_file_size(job->file);
    return tl_atomic_file_commit(job->file, job->error);
}

tl_result tl_world_add_routes(const tl_world_routes_def *def, tl_world_routes_report *report_out,
                              tl_io_error *error_out)
{
    route_job job;
    memset(&job, 0, sizeof job);
    memset(report_out, 0, sizeof *report_out);
    memset(error_out, 0, sizeof *error_out);
    job.def = def;
    job.error = error_out;
    tl_result result = tl_world_reader_open(def->input, &job.reader, error_out);
    if (result == TL_OK) {
        result = bake_file_routes(&job, report_out);
    }
    if (result == TL_OK) {
        result = tl_world_reader_index(&job.reader, error_out);
    }
    if (result == TL_OK) {
        result = list_chunks(&job, report_out);
    }
    if (result == TL_OK) {
        result = write_with_routes(&job, report_out);
    }
    free(job.chunk);
    free(job.entries);
    tl_blob_free(job.routes);
    tl_world_reader_close(&job.reader);
    return result;
}
