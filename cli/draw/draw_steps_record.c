// SPDX-License-Identifier: MIT
//
// A step can be as large as the contour, and there are as many steps as vertices: recording all of them in full would
// take the square. So a first run counts, and the second one keeps in full what is shown.

#include "cli/draw/draw_steps_record.h"

#include "io/files/growable.h"

#include <stdlib.h>
#include <string.h>

static void *grown_steps(steps_record *record, void *array, uint64_t *capacity, uint64_t used, uint64_t needed,
                         size_t size)
{
    tl_allocator allocator = tl_io_allocator_or_default(NULL);
    if (!tl_io_grow(&allocator, &array, capacity, used, needed, size)) {
        record->out_of_memory = true;
    }
    return array;
}

static void put_numbers(steps_record *record, const int32_t *numbers, uint64_t count)
{
    record->numbers = grown_steps(record, record->numbers, &record->number_capacity, record->number_count,
                                  record->number_count + count, sizeof *record->numbers);
    if (!record->out_of_memory && count > 0) {
        memcpy(record->numbers + record->number_count, numbers, (size_t)count * sizeof *numbers);
        record->number_count += count;
    }
}

static bool is_shown(const steps_of_kind *kind, uint64_t index)
{
    for (uint32_t i = 0; i < kind->shown_count; i++) {
        if (kind->shown[i] == index) {
            return true;
        }
    }
    return false;
}

static void record_polygon_step(const tl_polygon_step *step, void *user)
{
    steps_record *record = user;
    steps_of_kind *kind = &record->kinds[step->kind];
    if (record->out_of_memory || record->counting) {
        kind->count++;
        return;
    }
    bool full = is_shown(kind, kind->count);
    steps_entry entry = { record->number_count, full ? step->partition_count : step->partition_count > 0,
                          full ? step->outline_count : 0, step->corner_count, step->partition_count };
    kind->entries =
        grown_steps(record, kind->entries, &kind->capacity, kind->count, kind->count + 1, sizeof *kind->entries);
    put_numbers(record, step->partitions, 4 * (uint64_t)entry.partition_count);
    put_numbers(record, step->outline, 2 * (uint64_t)entry.outline_count);
    put_numbers(record, step->corners, 2 * (uint64_t)entry.corner_count);
    if (!record->out_of_memory) {
        kind->entries[kind->count++] = entry;
    }
}

// Evenly from the first to the last.
static tl_result choose_shown(steps_of_kind *kind, uint32_t max_shown)
{
    kind->shown_count = kind->count < max_shown ? (uint32_t)kind->count : max_shown;
    kind->shown = malloc((max_shown + 1) * sizeof *kind->shown);
    for (uint32_t i = 0; kind->shown != NULL && i < kind->shown_count; i++) {
        uint64_t gaps = kind->shown_count > 1 ? kind->shown_count - 1 : 1;
        kind->shown[i] = (uint32_t)((i * (kind->count - 1) + gaps / 2) / gaps);
    }
    return kind->shown != NULL ? TL_OK : TL_ERR_MEMORY;
}

tl_result steps_record_make(const tl_contour_set *set, uint32_t contour, uint32_t max_verts_per_poly,
                            tl_polygon_step_kind kind, uint32_t max_shown, const tl_host *host,
                            steps_record *record_out)
{
    memset(record_out, 0, sizeof *record_out);
    tl_contour_set one = *set;
    one.contours = &set->contours[contour];
    one.contour_count = 1;
    const tl_polygon_trace trace = { record_polygon_step, record_out };
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = max_verts_per_poly;
    def.keep_border_vertices = true;
    def.trace = &trace;
    def.host = *host;
    record_out->counting = true;
    tl_result result = tl_polygon_mesh_bake(&one, &def, &record_out->mesh, NULL);
    if (result == TL_OK) {
        result = choose_shown(&record_out->kinds[kind], max_shown);
    }
    if (result != TL_OK) {
        return result;
    }
    tl_polygon_mesh_free(&record_out->mesh);
    record_out->counting = false;
    record_out->kinds[0].count = record_out->kinds[1].count = 0;
    result = tl_polygon_mesh_bake(&one, &def, &record_out->mesh, NULL);
    return result == TL_OK && record_out->out_of_memory ? TL_ERR_MEMORY : result;
}

void steps_record_free(steps_record *record)
{
    tl_allocator allocator = tl_io_allocator_or_default(NULL);
    for (int i = 0; i < 2; i++) {
        steps_of_kind *kind = &record->kinds[i];
        tl_io_release(&allocator, kind->entries, (size_t)kind->capacity * sizeof *kind->entries);
        free(kind->shown);
    }
    tl_io_release(&allocator, record->numbers, (size_t)record->number_capacity * sizeof *record->numbers);
    tl_polygon_mesh_free(&record->mesh);
    memset(record, 0, sizeof *record);
}
