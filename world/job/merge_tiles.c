// SPDX-License-Identifier: MIT

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
    tl_world_layers *places; // [plan.tile_count]
    tl_pack_meta *meta;
    tl_pack_frame *frame;
    tl_pack_navmesh *navmesh;
    tl_pack_item *items;
    uint32_t item_count;
    tl_io_error *error;
} merge_job;

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

// Reads one place. Failures of the machine end the merge; a tile that is missing or damaged is counted.
static tl_result read_place(merge_job *job, uint64_t index, tl_world_merge_report *report, const tl_world_tile **first)
{
    const tl_world_tile *tile = &job->plan.tiles[index];
    tl_io_error why;
    memset(&why, 0, sizeof why);
    char *path = tl_world_tile_path(job->def->job, tile->key);
    if (path == NULL) {
        return tl_io_fail(job->error, TL_ERR_MEMORY, job->def->job, 0, "", "out of memory");
    }
    tl_result result = TL_OK;
    if (!tl_file_look(path, NULL)) {
        report->missing++;
        *first = *first == NULL ? tile : *first;
    } else {
        result = tl_world_tile_read(path, tile, &job->places[index], &why);
    }
    if (result == TL_ERR_MEMORY || result == TL_ERR_IO) {
        *job->error = why;
    } else if (result != TL_OK) {
        note_damage(job, path, &why, report);
        *first = *first == NULL ? tile : *first;
        result = TL_OK;
    }
    free(path);
    return result;
}

static tl_result read_places(merge_job *job, tl_world_merge_report *report)
{
    const uint64_t count = job->plan.tile_count;
    const tl_world_tile *first = NULL;
    job->places = calloc((size_t)count + 1, sizeof *job->places);
    if (job->places == NULL) {
        return tl_io_fail(job->error, TL_ERR_MEMORY, job->def->job, 0, "", "out of memory");
    }
    for (uint64_t i = 0; i < count; i++) {
        tl_result result = read_place(job, i, report, &first);
        if (result == TL_OK && i % TOLD_EVERY == 0) {
            result = tell_progress(job, "read tiles", i, count);
        }
        if (result != TL_OK) {
            return result;
        }
        for (uint32_t k = 0; k < job->places[i].count; k++) {
            report->tiles++;
            report->polygons += job->places[i].tiles[k]->polygon_count;
            report->area += job->places[i].tiles[k]->area;
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

static void add_item(merge_job *job, uint32_t type, uint32_t id, const void *blob)
{
    if (blob != NULL) {
        const tl_pack_item item = { type, id, blob, ((const tl_blob *)blob)->size };
        job->items[job->item_count++] = item;
    }
}

static tl_result make_items(merge_job *job, uint64_t tiles)
{
    const tl_world_plan *plan = &job->plan;
    const double *origin = plan->grid.origin;
    tl_result result =
        tl_pack_meta_encode(plan->name, plan->vertices, plan->triangles, plan->bounds, NULL, &job->meta, NULL);
    if (result == TL_OK && (origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0)) {
        result = tl_pack_frame_encode(TL_PACK_AXES_Y_UP, origin, NULL, &job->frame, NULL);
    }
    if (result == TL_OK) {
        result = tl_pack_navmesh_encode(&plan->grid.def, plan->grid.tiles_x, plan->grid.tiles_z, (uint32_t)tiles, NULL,
                                        &job->navmesh, NULL);
    }
    job->items = malloc((size_t)(tiles + OTHER_CHUNKS) * sizeof *job->items);
    if (result == TL_OK && job->items == NULL) {
        result = TL_ERR_MEMORY;
    }
    if (result != TL_OK) {
        return tl_io_fail(job->error, result, job->def->job, 0, "", "%s", tl_result_text(result));
    }
    add_item(job, TL_PACK_META, 0, job->meta);
    add_item(job, TL_PACK_FRAM, 0, job->frame);
    add_item(job, TL_PACK_NAVM, 0, job->navmesh);
    uint32_t id = 0;
    for (uint64_t i = 0; i < plan->tile_count; i++) {
        for (uint32_t k = 0; k < job->places[i].count; k++) {
            add_item(job, TL_PACK_NAVT, id++, job->places[i].tiles[k]);
        }
    }
    return TL_OK;
}

typedef struct merge_sink {
    tl_atomic_file *file;
    tl_io_error error;
} merge_sink;

static tl_result write_bytes(const void *bytes, size_t size, void *user)
{
    merge_sink *sink = user;
    return tl_atomic_file_write(sink->file, bytes, size, &sink->error);
}

static tl_result write_file(merge_job *job, tl_world_merge_report *report)
{
    merge_sink sink;
    memset(&sink, 0, sizeof sink);
    tl_result result = tl_atomic_file_open(job->def->output, &sink.file, job->error);
    if (result != TL_OK) {
        return result;
    }
    result = tl_pack_write(job->items, job->item_count, NULL, write_bytes, &sink, NULL);
    if (result != TL_OK) {
        tl_atomic_file_abort(sink.file);
        if (sink.error.result != TL_OK) {
            *job->error = sink.error;
            return result;
        }
        return tl_io_fail(job->error, result, job->def->output, 0, "", "%s", tl_result_text(result));
    }
    report->bytes = tl_atomic_file_size(sink.file);
    return tl_atomic_file_commit(sink.file, job->error);
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
        result = make_items(&job, report_out->tiles);
    }
    if (result == TL_OK) {
        result = write_file(&job, report_out);
    }
    for (uint64_t i = 0; job.places != NULL && i < job.plan.tile_count; i++) {
        tl_world_layers_free(&job.places[i]);
    }
    free(job.places);
    free(job.items);
    tl_blob_free(job.meta);
    tl_blob_free(job.frame);
    tl_blob_free(job.navmesh);
    tl_world_plan_free(&job.plan);
    return result;
}
