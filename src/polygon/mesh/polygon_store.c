// SPDX-License-Identifier: MIT
//
// Vertices are merged across contours through an exact hash of x and z; those of one place form a list.
//
// Merging within a height is not transitive, so the result can depend on the order of vertices: the nearest one on y is
// taken, which makes chains of three within reach of each other rare and any result explicable.

#include "polygon/mesh/polygon_store.h"

#include "base/assert.h"

#include <string.h>

// Of all arrays together, neighbours among them, as long as repairs add none: a contour of n vertices makes n - 2
// triangles at most. What is not used is never touched.
#define STORE_BYTES_A_VERTEX 112u

static tl_result reserve_store(tl_arena *arena, void **array, uint64_t used, uint64_t capacity, size_t size)
{
    void *larger = tl_arena_push(arena, capacity, size);
    if (larger == NULL) {
        return TL_ERR_MEMORY;
    }
    if (used > 0) {
        memcpy(larger, *array, (size_t)used * size);
    }
    *array = larger;
    return TL_OK;
}

#define RESERVE(store, array, used, capacity)                                                                          \
    TL_TRY(reserve_store((store)->arena, (void **)&(store)->array, (used), (capacity), sizeof *(store)->array))

static tl_result grow_vertices(tl_polygon_store *s, uint32_t capacity)
{
    RESERVE(s, vertices, 3 * (uint64_t)s->vertex_count, 3 * (uint64_t)capacity);
    RESERVE(s, is_border, s->vertex_count, capacity);
    RESERVE(s, next_above, s->vertex_count, capacity);
    s->vertex_capacity = capacity;
    tl_key_table old = s->places;
    if (!tl_key_table_init(&s->places, s->arena, capacity)) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; s->place_count > 0 && i <= old.mask; i++) {
        if (old.entries[i].value != TL_NO_VALUE) {
            const uint64_t key = tl_pair_key(old.entries[i].high, old.entries[i].low);
            *tl_key_table_at(&s->places, key) = old.entries[i].value;
        }
    }
    return TL_OK;
}

tl_result tl_polygon_store_init(tl_polygon_store *store, tl_arena *arena, const tl_polygon_def *def,
                                uint32_t vertex_count)
{
    memset(store, 0, sizeof *store);
    store->arena = arena;
    store->merge_height = def->merge_height;
    if (!tl_arena_reserve(arena, STORE_BYTES_A_VERTEX * (uint64_t)vertex_count)) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(grow_vertices(store, vertex_count + 16));
    store->polygon_capacity = vertex_count + 16;
    store->index_capacity = 3 * vertex_count + 16;
    RESERVE(store, polygons, 0, store->polygon_capacity);
    RESERVE(store, indices, 0, store->index_capacity);
    return TL_OK;
}

tl_result tl_polygon_store_vertex(tl_polygon_store *store, int32_t x, int32_t y, int32_t z, bool is_border,
                                  uint32_t *vertex_out)
{
    if (store->vertex_count == store->vertex_capacity) {
        TL_TRY(grow_vertices(store, 2 * store->vertex_capacity));
    }
    uint32_t *place = tl_key_table_at(&store->places, tl_pair_key((uint32_t)x, (uint32_t)z));
    uint32_t nearest = TL_NO_VALUE;
    int64_t nearest_rise = (int64_t)store->merge_height + 1;
    uint32_t *end = place;
    for (uint32_t v = *place; v != TL_NO_VALUE; v = store->next_above[v]) {
        int64_t rise = (int64_t)store->vertices[3 * (size_t)v + 1] - y;
        rise = rise < 0 ? -rise : rise;
        if (rise < nearest_rise) {
            nearest_rise = rise;
            nearest = v;
        }
        end = &store->next_above[v];
    }
    if (nearest == TL_NO_VALUE) {
        nearest = store->vertex_count++;
        store->place_count += end == place;
        *end = nearest;
        int32_t *v = store->vertices + 3 * (size_t)nearest;
        v[0] = x;
        v[1] = y;
        v[2] = z;
        store->is_border[nearest] = 0;
        store->next_above[nearest] = TL_NO_VALUE;
    }
    store->is_border[nearest] |= is_border;
    *vertex_out = nearest;
    return TL_OK;
}

tl_result tl_polygon_store_add(tl_polygon_store *store, const uint32_t *corners, uint32_t count, const uint32_t *map,
                               const tl_stored_polygon *of)
{
    if (store->polygon_count == store->polygon_capacity) {
        store->polygon_capacity *= 2;
        RESERVE(store, polygons, store->polygon_count, store->polygon_capacity);
    }
    if (count > store->index_capacity - store->index_count) {
        store->index_capacity = 2 * store->index_capacity + count;
        RESERVE(store, indices, store->index_count, store->index_capacity);
    }
    tl_stored_polygon *polygon = &store->polygons[store->polygon_count++];
    *polygon = *of;
    polygon->first = store->index_count;
    polygon->count = count;
    for (uint32_t k = 0; k < count; k++) {
        store->indices[store->index_count++] = map != NULL ? map[corners[k]] : corners[k];
    }
    return TL_OK;
}

tl_result tl_polygon_store_note(tl_polygon_store *store, const tl_contour_note *note)
{
    if (store->note_count == store->note_capacity) {
        store->note_capacity = 2 * store->note_capacity + 8;
        RESERVE(store, notes, store->note_count, store->note_capacity);
    }
    store->notes[store->note_count++] = *note;
    return TL_OK;
}

tl_result tl_polygon_store_compact(tl_polygon_store *store, tl_arena *scratch)
{
    uint32_t *number = TL_PUSH(scratch, uint32_t, store->vertex_count);
    uint32_t *indices = TL_PUSH(store->arena, uint32_t, store->index_count);
    if (number == NULL || indices == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(number, 0xff, store->vertex_count * sizeof *number);
    uint32_t polygons = 0;
    uint32_t filled = 0;
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        tl_stored_polygon polygon = store->polygons[p];
        if (polygon.count == 0) {
            continue;
        }
        for (uint32_t k = 0; k < polygon.count; k++) {
            indices[filled + k] = store->indices[polygon.first + k];
            number[indices[filled + k]] = 0;
        }
        polygon.first = filled;
        filled += polygon.count;
        store->polygons[polygons++] = polygon;
    }
    uint32_t vertices = 0;
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        if (number[v] != TL_NO_VALUE) {
            memmove(store->vertices + 3 * (size_t)vertices, store->vertices + 3 * (size_t)v,
                    3 * sizeof *store->vertices);
            number[v] = vertices++;
        }
    }
    for (uint32_t i = 0; i < filled; i++) {
        indices[i] = number[indices[i]];
    }
    store->indices = indices;
    store->index_count = filled;
    store->polygon_count = polygons;
    store->vertex_count = vertices;
    return TL_OK;
}
