// SPDX-License-Identifier: MIT
//
// Spans are collected unsorted and merged once, a band of columns at a time.
//
// Recast inserts each span into its column's linked list as it comes: an allocation and a walk per span, and a result
// that depends on the order of the triangles, since the area of a merged span is decided pair by pair. Here an item is
// one 64-bit word, a band's items are counting-sorted by column and then by height, and merged by a rule that knows no
// order:
//
//   Spans of a column that touch or overlap become their union. Its area is the largest among those of its parts whose
//   top lies at most walkable_climb below the top of the union.
//
// A band that collects many items (a heap of triangles in one place) is reduced in between: of each union only the
// parts stay that may still decide its area, those with a top above that of every part of larger area. So the memory is
// bounded by the columns and areas, not by the triangles, and the reduction does not change the result.

#include "nav_build/span_buffer.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

_Static_assert(sizeof(tl_nav_span) == sizeof(tl_span_item), "spans are written over the items they were made of");

enum {
    FIRST_ITEMS_PER_COLUMN = 4,
    // A buffer grows without being reduced up to here: in real levels so many triangles a column are seldom redundant.
    GROWING_ITEMS_PER_COLUMN = 16,
    INSERTION_SORT_MAX = 24
};

static void release_items(tl_span_buffer *buffer)
{
    tl_release_array(buffer->allocator, buffer->items < buffer->sorted ? buffer->items : buffer->sorted,
                     2 * buffer->capacity, sizeof(tl_span_item));
}

static tl_result grow(tl_span_buffer *buffer, uint64_t capacity)
{
    // Positions inside a band are 32 bits wide.
    if (capacity > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_span_item *items = tl_allocate_array(buffer->allocator, 2 * capacity, sizeof *items);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    if (buffer->capacity > 0) {
        memcpy(items, buffer->items, buffer->count * sizeof *items);
        release_items(buffer);
    }
    buffer->items = items;
    buffer->sorted = items + capacity;
    buffer->capacity = capacity;
    return TL_OK;
}

tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count)
{
    TL_ASSERT(column_count <= TL_SPAN_ITEM_MAX_COLUMNS);
    buffer->count = 0;
    buffer->column_count = column_count;
    if (buffer->end_capacity < column_count) {
        tl_release_array(buffer->allocator, buffer->ends, buffer->end_capacity, sizeof *buffer->ends);
        buffer->end_capacity = 0;
        buffer->ends = tl_allocate_array(buffer->allocator, column_count, sizeof *buffer->ends);
        if (buffer->ends == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->end_capacity = column_count;
    }
    uint64_t wanted = (uint64_t)column_count * FIRST_ITEMS_PER_COLUMN;
    return buffer->capacity < wanted ? grow(buffer, wanted) : TL_OK;
}

void tl_span_buffer_free(tl_span_buffer *buffer)
{
    if (buffer->capacity > 0) {
        release_items(buffer);
    }
    tl_release_array(buffer->allocator, buffer->ends, buffer->end_capacity, sizeof *buffer->ends);
    buffer->items = buffer->sorted = NULL;
    buffer->ends = NULL;
    buffer->count = buffer->capacity = 0;
    buffer->end_capacity = 0;
}

// ---- Sorting -----------------------------------------------------------------------------------------------

static void sift_down(tl_span_item *items, uint32_t root, uint32_t count)
{
    tl_span_item moved = items[root];
    for (uint32_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && items[child + 1] > items[child]) {
            child++;
        }
        if (items[child] <= moved) {
            break;
        }
        items[root] = items[child];
    }
    items[root] = moved;
}

// A column holds few items, nearly always; heapsort bounds the rest. Equal items are equal bits, so stability is moot.
static void sort_column(tl_span_item *items, uint32_t count)
{
    if (count > INSERTION_SORT_MAX) {
        for (uint32_t i = count / 2; i-- > 0;) {
            sift_down(items, i, count);
        }
        for (uint32_t end = count - 1; end > 0; end--) {
            tl_span_item largest = items[0];
            items[0] = items[end];
            items[end] = largest;
            sift_down(items, 0, end);
        }
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        tl_span_item item = items[i];
        uint32_t k = i;
        for (; k > 0 && items[k - 1] > item; k--) {
            items[k] = items[k - 1];
        }
        items[k] = item;
    }
}

// Leaves all items in `sorted`, column by column and in order within each; ends[c] is where column c ends.
static void sort_items(tl_span_buffer *buffer)
{
    uint32_t *ends = buffer->ends;
    const tl_span_item *items = buffer->items;
    tl_span_item *sorted = buffer->sorted;
    const uint32_t count = (uint32_t)buffer->count, column_count = buffer->column_count;
    memset(ends, 0, column_count * sizeof *ends);
    for (uint32_t i = 0; i < count; i++) {
        ends[tl_span_item_column(items[i])]++;
    }
    uint32_t position = 0;
    for (uint32_t c = 0; c < column_count; c++) {
        uint32_t in_column = ends[c];
        ends[c] = position;
        position += in_column;
    }
    for (uint32_t i = 0; i < count; i++) {
        sorted[ends[tl_span_item_column(items[i])]++] = items[i];
    }
    uint32_t begin = 0;
    for (uint32_t c = 0; c < column_count; c++) {
        uint32_t end = ends[c];
        if (end - begin > 1) {
            sort_column(sorted + begin, end - begin);
        }
        begin = end;
    }
}

// One past the last item of the union that begins with items[begin]; its top in *max_out.
static uint32_t union_end(const tl_span_item *items, uint32_t begin, uint32_t end, uint32_t *max_out)
{
    uint32_t max = tl_span_item_max(items[begin]);
    uint32_t i = begin + 1;
    for (; i < end && tl_span_item_min(items[i]) <= max; i++) {
        uint32_t item_max = tl_span_item_max(items[i]);
        max = item_max > max ? item_max : max;
    }
    *max_out = max;
    return i;
}

// ---- Reducing ----------------------------------------------------------------------------------------------

// Writes the deciding parts of one union to `kept`, tops from high to low, areas from small to large; returns how many.
// At most as many as there were items, since each has a top of its own.
static uint32_t reduce_union(const tl_span_item *items, uint32_t count, uint32_t max, tl_span_item *kept)
{
    const uint32_t column = tl_span_item_column(items[0]), min = tl_span_item_min(items[0]);
    uint32_t kept_count = 0, top = max;
    int64_t area = -1; // largest among the tops above
    for (;;) {
        // The next lower top is the highest one whose area exceeds all above it.
        int64_t next_top = -1, next_area = -1;
        for (uint32_t i = 0; i < count; i++) {
            int64_t item_top = tl_span_item_max(items[i]), item_area = tl_span_item_area(items[i]);
            if (item_top <= (int64_t)top && item_area > area &&
                (item_top > next_top || (item_top == next_top && item_area > next_area))) {
                next_top = item_top;
                next_area = item_area;
            }
        }
        if (next_top < 0) {
            return kept_count;
        }
        kept[kept_count++] = tl_span_item_make(column, min, (uint32_t)next_top, (uint32_t)next_area);
        top = (uint32_t)next_top;
        area = next_area;
    }
}

// Replaces the items by the fewest that have the same union. At most 256 passes over each, one an area.
static void reduce(tl_span_buffer *buffer)
{
    sort_items(buffer);
    uint64_t kept = 0;
    uint32_t begin = 0;
    for (uint32_t c = 0; c < buffer->column_count; c++) {
        uint32_t end = buffer->ends[c];
        while (begin < end) {
            uint32_t max;
            uint32_t next = union_end(buffer->sorted, begin, end, &max);
            kept += reduce_union(buffer->sorted + begin, next - begin, max, buffer->items + kept);
            begin = next;
        }
    }
    buffer->count = kept;
}

tl_result tl_span_buffer_reserve(tl_span_buffer *buffer, uint32_t count)
{
    if (buffer->capacity - buffer->count >= count) {
        return TL_OK;
    }
    uint64_t growing = (uint64_t)buffer->column_count * GROWING_ITEMS_PER_COLUMN;
    if (buffer->capacity >= growing) {
        reduce(buffer);
        if (buffer->count <= buffer->capacity / 2 && buffer->capacity - buffer->count >= count) {
            return TL_OK;
        }
    }
    uint64_t doubled = 2 * buffer->capacity, needed = buffer->count + count;
    return grow(buffer, doubled > needed ? doubled : needed);
}

// ---- Merging -----------------------------------------------------------------------------------------------

static tl_nav_span merge_union(const tl_span_item *items, uint32_t count, uint32_t max, uint32_t walkable_climb)
{
    uint32_t area = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t item_area = tl_span_item_area(items[i]);
        if (item_area > area && tl_span_item_max(items[i]) + walkable_climb >= max) {
            area = item_area;
        }
    }
    tl_nav_span span = { (uint16_t)tl_span_item_min(items[0]), (uint16_t)max, (uint16_t)area, 0 };
    return span;
}

void tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *counts_out, const tl_nav_span **spans_out,
                          uint32_t *span_count_out)
{
    sort_items(buffer);
    // The unsorted items are no longer needed: the spans take their place.
    tl_nav_span *spans = (tl_nav_span *)(void *)buffer->items;
    uint32_t span_count = 0, begin = 0;
    for (uint32_t c = 0; c < buffer->column_count; c++) {
        uint32_t end = buffer->ends[c], before = span_count;
        while (begin < end) {
            uint32_t max;
            uint32_t next = union_end(buffer->sorted, begin, end, &max);
            spans[span_count++] = merge_union(buffer->sorted + begin, next - begin, max, buffer->walkable_climb);
            begin = next;
        }
        counts_out[c] = span_count - before;
    }
    *spans_out = spans;
    *span_count_out = span_count;
}
