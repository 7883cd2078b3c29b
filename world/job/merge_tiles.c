// SPDX-License-Identifier: MIT
//
// Two passes over the tiles' files: the first proves every tile and notes its size and hash, the second copies them
// into the file. So what is in memory is one place, and 100 bytes for each tile of the world. Copying while proving
// would need an output whose head can be written last, which standard output is not, and would write what one missing
// tile makes useless.

#include "world/job/merge_tiles.h"

#include "io/files/atomic_write.h"
#include "world/job/tile_file.h"

#include <stdlib.h>
#include <string.h>
#include <talus/pack.h>

enum { OTHER_CHUNKS = 3, TOLD_EVERY = 64 };

typedef struct merge_job {
    const tl_world_merge_def *def;
    tl_world_plan plan;
    uint32_t *layers; // [plan.tile_count]: at each place
    tl_pack_entry *entries;
    size_t entry_count, entry_capacity;
    void *others[OTHER_CHUNKS]; // META, FRAM, NAVM, in the file's byte order; entries of their own come first
    uint32_t other_count;
    tl_atomic_file *file;
    tl_world_layers open; // the second pass: the tiles of a place, and which of them is next
    uint64_t open_place, next_place;
    uint32_t next_layer;
    tl_io_error *error;
} merge_job;

static tl_result fail_merge_memory(merge_job *job)
{
    return tl_io_fail(job->error, TL_ERR_MEMORY, job->def->job, 0, "", "out of memory");
}

static tl_result tell_progress(const merge_job *job, const char *stage, uint64_t done, uint64_t total)
{
    const tl_progress *progress = job->def->host.progress;
    if (progress != NULL && !progress->update(stage, done, total, progress->user)) {
        return tl_io_fail(job->error, TL_ERR_CANCELLED, NULL, 0, "", "cancelled");
    }
    return TL_OK;
}

static void note_damage(merge_job *job, const char *path, const tl_io_error *why, tl_world_merge_report *report)
{
    report->damaged++;
    tl_file_remove(path);
    if (job->def->fail != NULL) {
        job->def->fail(why, job->def->user);
    }
}

// ---- The first pass ----------------------------------------------------------------------------------------

static bool reserve_entries(merge_job *job, size_t more)
{
    if (job->entry_count + more <= job->entry_capacity) {
        return true;
    }
    const size_t capacity = (job->entry_count + more) * 3 / 2;
    tl_pack_entry *grown = realloc(job->entries, capacity * sizeof *grown);
    if (grown == NULL) {
        return false;
    }
    job->entries = grown;
    job->entry_capacity = capacity;
    return true;
}

// The layers of a place that is sound.
static tl_result note_layers(merge_job *job, uint64_t index, const tl_world_layers *layers,
                             tl_world_merge_report *report)
{
    if (!reserve_entries(job, layers->count)) {
        return fail_merge_memory(job);
    }
    for (uint32_t k = 0; k < layers->count; k++) {
        job->entries[job->entry_count] = layers->entries[k];
        job->entries[job->entry_count++].id = (uint32_t)report->tiles++;
        report->polygons += layers->tiles[k]->polygon_count;
        report->area += layers->tiles[k]->area;
    }
    job->layers[index] = layers->count;
    return TL_OK;
}

// Reads one place. Failures of the machine end the merge; a tile that is missing or damaged is counted.
static tl_result read_place(merge_job *job, uint64_t index, tl_world_merge_report *report, const tl_world_tile **first)
{
    const tl_world_tile *tile = &job->plan.tiles[index];
    tl_world_layers layers;
    tl_io_error why;
    memset(&why, 0, sizeof why);
    memset(&layers, 0, sizeof layers);
    char *path = tl_world_tile_path(job->def->job, tile->key);
    if (path == NULL) {
        return fail_merge_memory(job);
    }
    tl_result result = TL_OK;
    if (!tl_file_look(path, NULL)) {
        report->missing++;
        *first = *first == NULL ? tile : *first;
    } else {
        result = tl_world_tile_read(path, tile, true, &layers, &why);
        if (result == TL_OK) {
            result = tl_world_layers_check(&layers, path, tile, &why);
        }
    }
    if (result == TL_ERR_MEMORY || result == TL_ERR_IO) {
        *job->error = why;
    } else if (result != TL_OK) {
        note_damage(job, path, &why, report);
        *first = *first == NULL ? tile : *first;
        result = TL_OK;
    } else {
        result = note_layers(job, index, &layers, report);
    }
    tl_world_layers_free(&layers);
    free(path);
    return result;
}

static tl_result read_places(merge_job *job, tl_world_merge_report *report)
{
    const uint64_t count = job->plan.tile_count;
    const tl_world_tile *first = NULL;
    job->layers = calloc((size_t)count + 1, sizeof *job->layers);
    if (job->layers == NULL || !reserve_entries(job, (size_t)count + OTHER_CHUNKS)) {
        return fail_merge_memory(job);
    }
    job->entry_count = OTHER_CHUNKS; // filled in last
    for (uint64_t i = 0; i < count; i++) {
        tl_result result = read_place(job, i, report, &first);
        if (result == TL_OK && i % TOLD_EVERY == 0) {
            result = tell_progress(job, "prove tiles", i, count);
        }
        if (result != TL_OK) {
            return result;
        }
    }
    report->places = count;
    if (first != NULL) {
        return tl_io_fail(job->error, TL_NOT_FOUND, job->def->job, 0, "run 'talus world bake' for what is missing",
                          "%llu of %llu tiles are missing and %llu damaged, the first is tile %u,%u",
                          (unsigned long long)report->missing, (unsigned long long)count,
                          (unsigned long long)report->damaged, first->x, first->z);
    }
    if (report->tiles > TL_NAV_MAX_TILES) {
        return tl_io_fail(job->error, TL_ERR_LIMIT, job->def->job, 0, "bake with a larger --tile-size",
                          "%llu tiles are more than one navmesh may have (%u)", (unsigned long long)report->tiles,
                          (unsigned)TL_NAV_MAX_TILES);
    }
    return TL_OK;
}

// ---- The file's own chunks ---------------------------------------------------------------------------------

static tl_result take_other(merge_job *job, uint32_t type, tl_result result, void *blob)
{
    if (result == TL_OK) {
        const uint64_t size = ((const tl_blob *)blob)->size;
        job->others[job->other_count] = blob;
        result = tl_blob_to_file_order(blob, size, NULL);
        if (result == TL_OK) {
            result = tl_pack_entry_make(type, 0, blob, size, &job->entries[job->other_count++]);
        }
    }
    return result != TL_OK ? tl_io_fail(job->error, result, job->def->job, 0, "", "%s", tl_result_text(result)) : TL_OK;
}

static tl_result make_others(merge_job *job, uint64_t tiles)
{
    const tl_world_plan *plan = &job->plan;
    const double *origin = plan->grid.origin;
    tl_pack_meta *meta = NULL;
    tl_pack_frame *frame = NULL;
    tl_pack_navmesh *navmesh = NULL;
    tl_result result =
        tl_pack_meta_encode(plan->name, plan->vertices, plan->triangles, plan->bounds, NULL, &meta, NULL);
    result = take_other(job, TL_PACK_META, result, meta);
    if (result == TL_OK && (origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0)) {
        result = tl_pack_frame_encode(TL_PACK_AXES_Y_UP, origin, NULL, &frame, NULL);
        result = take_other(job, TL_PACK_FRAM, result, frame);
    }
    if (result == TL_OK) {
        result = tl_pack_navmesh_encode(&plan->grid.def, plan->grid.tiles_x, plan->grid.tiles_z, (uint32_t)tiles, NULL,
                                        &navmesh, NULL);
        result = take_other(job, TL_PACK_NAVM, result, navmesh);
    }
    return result;
}

// ---- The second pass ---------------------------------------------------------------------------------------

// Closes the place that is open, and opens the next that has tiles.
static tl_result open_next_place(merge_job *job)
{
    tl_world_layers_free(&job->open);
    while (job->layers[job->next_place] == 0) {
        job->next_place++;
    }
    job->open_place = job->next_place++;
    job->next_layer = 0;
    const tl_world_tile *tile = &job->plan.tiles[job->open_place];
    char *path = tl_world_tile_path(job->def->job, tile->key);
    if (path == NULL) {
        return fail_merge_memory(job);
    }
    tl_result result = tl_world_tile_read(path, tile, false, &job->open, job->error);
    if (result == TL_OK && job->open.count != job->layers[job->open_place]) {
        result = TL_ERR_HASH; // as the writer says of other changes
    }
    free(path);
    return result;
}

static tl_result fetch_chunk(uint32_t index, const void **bytes_out, void *user)
{
    merge_job *job = user;
    tl_result result = TL_OK;
    if (index < job->other_count) {
        *bytes_out = job->others[index];
        return TL_OK;
    }
    if (job->next_layer == job->open.count) {
        result = open_next_place(job);
        if (result == TL_OK && job->open_place % TOLD_EVERY == 0) {
            result = tell_progress(job, "write tiles", job->open_place, job->plan.tile_count);
        }
    }
    if (result == TL_OK) {
        *bytes_out = job->open.tiles[job->next_layer++];
    }
    return result;
}

static tl_result write_bytes(const void *bytes, size_t size, void *user)
{
    merge_job *job = user;
    return tl_atomic_file_write(job->file, bytes, size, job->error);
}

static tl_result write_file(merge_job *job, tl_world_merge_report *report)
{
    tl_result result = tl_atomic_file_open(job->def->output, &job->file, job->error);
    if (result != TL_OK) {
        return result;
    }
    // The others' entries, moved up to the tiles'.
    const uint32_t first = OTHER_CHUNKS - job->other_count;
    memmove(job->entries + first, job->entries, job->other_count * sizeof *job->entries);
    result = tl_pack_write_fetched(job->entries + first, (uint32_t)(job->entry_count - first), NULL, fetch_chunk,
                                   write_bytes, job, NULL);
    if (result != TL_OK) {
        tl_atomic_file_abort(job->file);
        if (result == TL_ERR_HASH) {
            const tl_world_tile *tile = &job->plan.tiles[job->open_place];
            return tl_io_fail(job->error, result, job->def->job, 0, "run it again when nothing else writes there",
                              "tile %u,%u changed while it was merged", tile->x, tile->z);
        }
        return job->error->result != TL_OK
                   ? result
                   : tl_io_fail(job->error, result, job->def->output, 0, "", "%s", tl_result_text(result));
    }
    report->bytes = tl_atomic_file_size(job->file);
    return tl_atomic_file_commit(job->file, job->error);
}

static void free_merge(merge_job *job)
{
    tl_world_layers_free(&job->open);
    for (uint32_t i = 0; i < OTHER_CHUNKS; i++) {
        tl_blob_free(job->others[i]);
    }
    free(job->layers);
    free(job->entries);
    tl_world_plan_free(&job->plan);
}

tl_result tl_world_merge(const tl_world_merge_def *def, tl_world_merge_report *report_out, tl_io_error *error_out)
{
    merge_job job;
    memset(&job, 0, sizeof job);
    memset(report_out, 0, sizeof *report_out);
    job.def = def;
    job.error = error_out;
    tl_result result = tl_world_plan_of_job(def->job, &job.plan, error_out);
    if (result == TL_OK && !def->as_planned) {
        result = tl_world_inputs_unchanged(&job.plan, error_out);
    }
    if (result == TL_OK) {
        result = read_places(&job, report_out);
    }
    if (result == TL_OK) {
        result = make_others(&job, report_out->tiles);
    }
    if (result == TL_OK) {
        result = write_file(&job, report_out);
    }
    free_merge(&job);
    return result;
}
