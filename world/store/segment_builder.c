// SPDX-License-Identifier: MIT

#include "world/store/segment_builder.h"

#include "io/files/atomic_write.h"
#include "world/bytes/little_endian.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What a triangle costs while it is held: record, cell, place in the order, and its share of the cells' table.
enum { BYTES_A_TRIANGLE = 64, FIRST_TRIANGLES = 4096, FIRST_CELLS = 1024, FLUSHED_TRIANGLES = 1 << 16 };

typedef struct held_cell {
    tl_world_cell cell;
    uint32_t count;
    uint32_t first; // in the order
} held_cell;

struct tl_world_builder {
    char *stem;
    double cell_size;
    uint32_t number;
    uint64_t limit; // triangles held at one time
    tl_world_segment_head head;
    unsigned char *records;
    uint32_t *cell_of;
    uint32_t *order;
    uint64_t count, capacity;
    held_cell *cells;
    uint32_t cell_count, cell_capacity;
    uint32_t *table; // cell + 1 by hash, 0: free; twice cell_capacity
    uint32_t last_cell;
};

char *tl_world_segment_path(const char *stem, uint32_t number)
{
    const size_t size = strlen(stem) + 32;
    char *path = malloc(size);
    if (path != NULL) {
        snprintf(path, size, "%s.%u.segment", stem, number);
    }
    return path;
}

static tl_result no_memory(const tl_world_builder *builder, tl_io_error *error_out)
{
    return tl_io_fail(error_out, TL_ERR_MEMORY, builder->stem, 0, "lower --memory", "out of memory");
}

static void begin_segment(tl_world_builder *builder)
{
    const uint64_t first = builder->head.first + builder->head.count;
    memset(&builder->head, 0, sizeof builder->head);
    builder->head.cell_size = builder->cell_size;
    builder->head.first = first;
    for (int i = 0; i < 3; i++) {
        builder->head.bounds[i] = HUGE_VAL;
        builder->head.bounds[i + 3] = -HUGE_VAL;
    }
    builder->count = 0;
    builder->cell_count = 0;
    builder->last_cell = 0;
    if (builder->table != NULL) {
        memset(builder->table, 0, 2 * (size_t)builder->cell_capacity * sizeof *builder->table);
    }
}

tl_world_builder *tl_world_builder_create(const char *stem, double cell_size, uint64_t memory, uint32_t first_number,
                                          uint64_t first_triangle)
{
    tl_world_builder *builder = calloc(1, sizeof *builder);
    const size_t length = strlen(stem) + 1;
    char *copy = malloc(length);
    if (builder == NULL || copy == NULL) {
        free(builder);
        free(copy);
        return NULL;
    }
    memcpy(copy, stem, length);
    builder->stem = copy;
    builder->cell_size = cell_size;
    builder->number = first_number;
    const uint64_t limit = memory / BYTES_A_TRIANGLE, most = UINT32_MAX / 2;
    builder->limit = limit < 16384 ? 16384 : limit > most ? most : limit;
    builder->head.first = first_triangle;
    begin_segment(builder);
    return builder;
}

void tl_world_builder_free(tl_world_builder *builder)
{
    if (builder != NULL) {
        free(builder->stem);
        free(builder->records);
        free(builder->cell_of);
        free(builder->order);
        free(builder->cells);
        free(builder->table);
        free(builder);
    }
}

static bool grow_array(void **array, uint64_t count, size_t item)
{
    void *grown = count <= SIZE_MAX / item ? realloc(*array, (size_t)count * item) : NULL;
    *array = grown != NULL ? grown : *array;
    return grown != NULL;
}

static bool grow_triangles(tl_world_builder *builder)
{
    uint64_t wanted = builder->capacity > 0 ? 2 * builder->capacity : FIRST_TRIANGLES;
    wanted = wanted > builder->limit ? builder->limit : wanted;
    if (!grow_array((void **)&builder->records, wanted, TL_WORLD_RECORD_BYTES) ||
        !grow_array((void **)&builder->cell_of, wanted, sizeof *builder->cell_of) ||
        !grow_array((void **)&builder->order, wanted, sizeof *builder->order)) {
        return false;
    }
    builder->capacity = wanted;
    return true;
}

static uint32_t cell_hash(const tl_world_cell *cell)
{
    uint64_t mixed =
        (uint64_t)(uint32_t)cell->x * UINT64_C(0x9e3779b97f4a7c15) ^
        (uint64_t)(uint32_t)cell->z * UINT64_C(0xc2b2ae3d27d4eb4f) ^
        ((uint64_t)(uint32_t)cell->y << 8 | (uint64_t)(uint32_t)cell->level) * UINT64_C(0x165667b19e3779f9);
    mixed ^= mixed >> 29;
    return (uint32_t)((mixed * UINT64_C(0xbf58476d1ce4e5b9)) >> 32);
}

// The slot of a cell, or the free one where it goes.
static uint32_t find_cell_slot(const tl_world_builder *builder, const tl_world_cell *cell)
{
    const uint32_t mask = 2 * builder->cell_capacity - 1;
    uint32_t slot = cell_hash(cell) & mask;
    while (builder->table[slot] != 0 &&
           tl_world_cell_compare(&builder->cells[builder->table[slot] - 1].cell, cell) != 0) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

static bool grow_cells(tl_world_builder *builder)
{
    const uint32_t wanted = builder->cell_capacity > 0 ? 2 * builder->cell_capacity : FIRST_CELLS;
    uint32_t *table = wanted < 1u << 30 ? calloc(2 * (size_t)wanted, sizeof *table) : NULL;
    if (table == NULL || !grow_array((void **)&builder->cells, wanted, sizeof *builder->cells)) {
        free(table);
        return false;
    }
    free(builder->table);
    builder->table = table;
    builder->cell_capacity = wanted;
    for (uint32_t i = 0; i < builder->cell_count; i++) {
        builder->table[find_cell_slot(builder, &builder->cells[i].cell)] = i + 1;
    }
    return true;
}

// The number of a cell, which is new or not; UINT32_MAX: out of memory. Neighbours in a file mostly lie in one cell.
static uint32_t number_of_cell(tl_world_builder *builder, const tl_world_cell *cell)
{
    if (builder->cell_count > 0 && tl_world_cell_compare(&builder->cells[builder->last_cell].cell, cell) == 0) {
        return builder->last_cell;
    }
    if (builder->cell_count == builder->cell_capacity && !grow_cells(builder)) {
        return UINT32_MAX;
    }
    const uint32_t slot = find_cell_slot(builder, cell);
    if (builder->table[slot] == 0) {
        const held_cell held = { *cell, 0, 0 };
        builder->cells[builder->cell_count] = held;
        builder->table[slot] = ++builder->cell_count;
    }
    builder->last_cell = builder->table[slot] - 1;
    return builder->last_cell;
}

static int compare_held(const void *a, const void *b)
{
    return tl_world_cell_compare(&((*(const held_cell *const *)a)->cell), &((*(const held_cell *const *)b)->cell));
}

typedef struct sorted_record {
    uint64_t key; // the first bytes
    const unsigned char *record;
} sorted_record;

static bool is_before(const sorted_record *a, const sorted_record *b)
{
    return a->key != b->key ? a->key < b->key : memcmp(a->record, b->record, TL_WORLD_RECORD_BYTES) < 0;
}

// Merges runs of 8 that were sorted by insertion, twice as long in each pass, from one array to the other and back.
// Cells hold some hundred triangles, of which qsort moves each through a function's pointer. `other`: as much room.
// Returns the one that is sorted.
static sorted_record *sort_records(sorted_record *items, sorted_record *other, uint64_t count)
{
    enum { RUN = 8 };
    for (uint64_t i = 1; i < count; i++) {
        const sorted_record item = items[i];
        uint64_t at = i;
        for (; at % RUN > 0 && is_before(&item, &items[at - 1]); at--) {
            items[at] = items[at - 1];
        }
        items[at] = item;
    }
    for (uint64_t run = RUN; run < count; run *= 2) {
        for (uint64_t first = 0; first < count; first += 2 * run) {
            const uint64_t middle = count - first < run ? count : first + run;
            const uint64_t end = count - first < 2 * run ? count : first + 2 * run;
            uint64_t a = first, b = middle;
            for (uint64_t out = first; out < end; out++) {
                const bool from_b = a == middle || (b < end && is_before(&items[b], &items[a]));
                other[out] = items[from_b ? b : a];
                a += !from_b;
                b += from_b;
            }
        }
        sorted_record *swapped = items;
        items = other;
        other = swapped;
    }
    return items;
}

// The cells in their order, and in `order` the triangles of each.
static held_cell **sort_cells(tl_world_builder *builder)
{
    held_cell **sorted = malloc(((size_t)builder->cell_count + 1) * sizeof *sorted);
    if (sorted == NULL) {
        return NULL;
    }
    for (uint32_t i = 0; i < builder->cell_count; i++) {
        sorted[i] = &builder->cells[i];
    }
    if (builder->cell_count > 1) {
        qsort(sorted, builder->cell_count, sizeof *sorted, compare_held);
    }
    uint32_t first = 0;
    for (uint32_t i = 0; i < builder->cell_count; i++) {
        sorted[i]->first = first;
        first += sorted[i]->count;
        sorted[i]->count = 0;
    }
    for (uint32_t t = 0; t < (uint32_t)builder->count; t++) {
        held_cell *cell = &builder->cells[builder->cell_of[t]];
        builder->order[cell->first + cell->count++] = t;
    }
    return sorted;
}

static tl_aabb bounds_of_records(const unsigned char *records, uint32_t count)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < 3 * count; i++) {
        const unsigned char *at = records + (size_t)(i / 3) * TL_WORLD_RECORD_BYTES + 12 * (i % 3);
        bounds = tl_aabb_add_point(bounds, tl_vec3_make(tl_get_float(at), tl_get_float(at + 4), tl_get_float(at + 8)));
    }
    return bounds;
}

// Room for the largest cell.
typedef struct cell_room {
    sorted_record *sorted; // twice
    unsigned char *bytes;
} cell_room;

static tl_result write_cell(tl_world_builder *builder, const held_cell *held, const cell_room *room,
                            tl_atomic_file *file, unsigned char *index_out, tl_io_error *error_out)
{
    for (uint32_t i = 0; i < held->count; i++) {
        const uint32_t triangle = builder->order[held->first + i];
        const unsigned char *record = builder->records + (size_t)triangle * TL_WORLD_RECORD_BYTES;
        const sorted_record item = { tl_get_u64(record), record };
        room->sorted[i] = item;
    }
    const sorted_record *sorted = sort_records(room->sorted, room->sorted + held->count, held->count);
    for (uint32_t i = 0; i < held->count; i++) {
        memcpy(room->bytes + (size_t)i * TL_WORLD_RECORD_BYTES, sorted[i].record, TL_WORLD_RECORD_BYTES);
    }
    const size_t size = (size_t)held->count * TL_WORLD_RECORD_BYTES;
    tl_world_segment_cell cell = { held->cell, held->first, held->count, bounds_of_records(room->bytes, held->count),
                                   tl_content_checksum(room->bytes, size) };
    tl_world_segment_cell_encode(&cell, index_out);
    return tl_atomic_file_write(file, room->bytes, size, error_out);
}

static tl_result write_parts(tl_world_builder *builder, held_cell *const *sorted, tl_atomic_file *file,
                             tl_io_error *error_out)
{
    uint32_t largest = 1;
    for (uint32_t i = 0; i < builder->cell_count; i++) {
        largest = sorted[i]->count > largest ? sorted[i]->count : largest;
    }
    const size_t index_size = (size_t)builder->cell_count * TL_WORLD_SEGMENT_CELL;
    cell_room room = { malloc(2 * (size_t)largest * sizeof *room.sorted),
                       malloc((size_t)largest * TL_WORLD_RECORD_BYTES) };
    unsigned char *index = malloc(index_size + 8);
    unsigned char head[TL_WORLD_SEGMENT_HEADER];
    tl_world_segment_head_encode(&builder->head, head);
    tl_result result =
        room.sorted != NULL && room.bytes != NULL && index != NULL ? TL_OK : no_memory(builder, error_out);
    if (result == TL_OK) {
        result = tl_atomic_file_write(file, head, sizeof head, error_out);
    }
    for (uint32_t i = 0; i < builder->cell_count && result == TL_OK; i++) {
        result = write_cell(builder, sorted[i], &room, file, index + (size_t)i * TL_WORLD_SEGMENT_CELL, error_out);
    }
    if (result == TL_OK) {
        tl_put_u64(index + index_size, tl_content_checksum(index, index_size));
        result = tl_atomic_file_write(file, index, index_size + 8, error_out);
    }
    free(room.sorted);
    free(room.bytes);
    free(index);
    return result;
}

static tl_result write_segment(tl_world_builder *builder, tl_io_error *error_out)
{
    builder->head.triangles = builder->count;
    builder->head.cells = builder->cell_count;
    held_cell **sorted = sort_cells(builder);
    char *path = tl_world_segment_path(builder->stem, builder->number);
    tl_atomic_file *file = NULL;
    tl_result result = sorted != NULL && path != NULL ? TL_OK : no_memory(builder, error_out);
    if (result == TL_OK) {
        result = tl_atomic_file_open(path, &file, error_out);
    }
    if (result == TL_OK) {
        result = write_parts(builder, sorted, file, error_out);
        if (result != TL_OK) {
            tl_atomic_file_abort(file);
        } else if (builder->count >= FLUSHED_TRIANGLES) {
            result = tl_atomic_file_commit(file, error_out);
        } else {
            result = tl_atomic_file_commit_unflushed(file, error_out);
        }
    }
    free(sorted);
    free(path);
    builder->number++;
    begin_segment(builder);
    return result;
}

static tl_result refuse_triangle(const tl_world_builder *builder, tl_world_taken taken, tl_io_error *error_out)
{
    const uint64_t triangle = builder->head.first + builder->head.count;
    const tl_result result = taken == TL_WORLD_NOT_FINITE
                                 ? tl_io_fail(error_out, TL_ERR_NOT_FINITE, NULL, 0, "export it again",
                                              "a corner of triangle %llu is no number", (unsigned long long)triangle)
                                 : tl_io_fail(error_out, TL_ERR_RANGE, NULL, 0, "move it towards the origin",
                                              "triangle %llu is too far out", (unsigned long long)triangle);
    return tl_io_blame(error_out, result, "triangle", triangle);
}

tl_result tl_world_builder_add(tl_world_builder *builder, const tl_world_triangle *triangle, tl_io_error *error_out)
{
    tl_result result = TL_OK;
    if (builder->count == builder->capacity && builder->capacity < builder->limit) {
        result = grow_triangles(builder) ? TL_OK : no_memory(builder, error_out);
    } else if (builder->count == builder->limit) {
        result = write_segment(builder, error_out);
    }
    if (result != TL_OK) {
        return result;
    }
    tl_world_cell cell;
    const tl_world_taken taken = tl_world_record_encode(triangle, builder->cell_size, &cell,
                                                        builder->records + builder->count * TL_WORLD_RECORD_BYTES);
    if (taken == TL_WORLD_NO_AREA) {
        builder->head.degenerate++;
    } else if (taken != TL_WORLD_TAKEN) {
        return refuse_triangle(builder, taken, error_out);
    } else {
        const uint32_t number = number_of_cell(builder, &cell);
        if (number == UINT32_MAX) {
            return no_memory(builder, error_out);
        }
        builder->cells[number].count++;
        builder->cell_of[builder->count++] = number;
        for (int i = 0; i < 9; i++) {
            const double value = triangle->corner[i / 3][i % 3];
            double *bounds = &builder->head.bounds[i % 3];
            bounds[0] = value < bounds[0] ? value : bounds[0];
            bounds[3] = value > bounds[3] ? value : bounds[3];
        }
    }
    builder->head.count++;
    return TL_OK;
}

tl_result tl_world_builder_finish(tl_world_builder *builder, uint64_t vertices, tl_io_error *error_out)
{
    builder->head.last = true;
    builder->head.vertices = vertices;
    return write_segment(builder, error_out);
}
