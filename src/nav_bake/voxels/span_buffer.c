// SPDX-License-Identifier: MIT
//
// Spans are joined as they come, in a short sorted list a column, by a rule that knows no order:
//
//   Spans of a column that touch or overlap become their union. Its area is the largest among those of its parts whose
//   top lies at most walkable_climb below the top of the union.
//
// So a span has to remember its parts that may still decide: its tops from high to low, each of larger area than those
// above it (a Pareto front; mostly there is one). What is below a part in both top and area is dropped at once, and
// that is most of what a crowded column is given. Memory follows what is solid, not how many triangles it was made of.
//
// Recast inserts into lists too; there the area of a merged span depends on the order of the triangles, each span is an
// allocation, and a column of n spans takes n^2 steps. Here the lowest span lies in the column's own word, others in
// one array, and a list is walked for a few steps only: what belongs farther up is kept aside, sorted at the end, and
// reduced whenever it has doubled. So no pile of triangles takes more than n log n.
//
// Rejected: to collect all items, to sort them by column and height, and to merge them at the end. It takes as long
// where columns are sparse, twice as long where they are crowded, and the memory of all items, twice.

#include "nav_bake/voxels/span_buffer.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

enum {
    MIN_NODES = 256,
    MIN_LATE = 64,
    MIN_SPANS = 64,
    MAX_NODES = 1 << 24, // links have so many bits
    INSERTION_SORT_MAX = 24,
    AREAS = 256
};

void tl_span_buffer_free(tl_span_buffer *buffer)
{
    const tl_allocator *allocator = buffer->allocator;
    tl_release_array(allocator, buffer->lowest, buffer->lowest_capacity, sizeof *buffer->lowest);
    tl_release_array(allocator, buffer->nodes, buffer->node_capacity, sizeof *buffer->nodes);
    tl_release_array(allocator, buffer->late, buffer->late_capacity, sizeof *buffer->late);
    tl_release_array(allocator, buffer->column, buffer->column_capacity, sizeof *buffer->column);
    tl_release_array(allocator, buffer->spans, buffer->span_capacity, sizeof *buffer->spans);
    memset(buffer, 0, sizeof *buffer);
}

tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count)
{
    TL_ASSERT(column_count > 0 && column_count <= TL_SPAN_ITEM_MAX_COLUMNS);
    buffer->node_count = 1;
    buffer->free_node = 0;
    buffer->span_count = 0;
    buffer->late_count = buffer->late_sorted = 0;
    buffer->column_count = column_count;
    if (buffer->lowest_capacity < column_count) {
        tl_release_array(buffer->allocator, buffer->lowest, buffer->lowest_capacity, sizeof *buffer->lowest);
        buffer->lowest_capacity = 0;
        buffer->lowest = tl_allocate_array(buffer->allocator, column_count, sizeof *buffer->lowest);
        if (buffer->lowest == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->lowest_capacity = column_count;
    }
    for (uint32_t c = 0; c < column_count; c++) {
        buffer->lowest[c] = TL_NO_SPANS;
    }
    return buffer->nodes != NULL ? TL_OK : tl_span_buffer_make_room(buffer, 1);
}

// An array of 8-byte words with room for `capacity`, the first `count` of which stay. NULL: no memory.
static uint64_t *grow_words(const tl_allocator *allocator, uint64_t *words, uint64_t old_capacity, uint64_t count,
                            uint64_t capacity)
{
    uint64_t *grown = tl_allocate_array(allocator, capacity, sizeof *grown);
    if (grown != NULL && words != NULL) {
        memcpy(grown, words, (size_t)count * sizeof *grown);
    }
    if (grown != NULL) {
        tl_release_array(allocator, words, old_capacity, sizeof *words);
    }
    return grown;
}

// ---- Sorting -----------------------------------------------------------------------------------------------

#define TL_HEAP(name)                 span_heap_##name
#define TL_HEAP_ITEM                  tl_span_item
#define TL_HEAP_BEFORE(context, a, b) ((a) > (b))
#include "base/heap.inl"

// Equal items are equal bits, so stability is moot.
static void sort_items(tl_span_item *items, uint32_t count)
{
    if (count > INSERTION_SORT_MAX) {
        for (uint32_t i = count / 2; i-- > 0;) {
            span_heap_sift_down(items, count, i, items[i], NULL);
        }
        for (uint32_t end = count - 1; end > 0; end--) {
            tl_span_item largest = items[0];
            span_heap_sift_down(items, end, 0, items[end], NULL);
            items[end] = largest;
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

// ---- The parts of a union ----------------------------------------------------------------------------------

// Tops and areas, none of which is below another in both: at most one an area.
typedef struct span_parts {
    uint32_t count;
    uint32_t highest;
    struct {
        uint16_t top, area;
    } part[AREAS];
} span_parts;

static void add_part(span_parts *parts, uint32_t top, uint32_t area)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < parts->count; k++) {
        if (parts->part[k].top >= top && parts->part[k].area >= area) {
            return; // then it has nothing below it
        }
        if (parts->part[k].top > top || parts->part[k].area > area) {
            parts->part[kept++] = parts->part[k];
        }
    }
    parts->part[kept].top = (uint16_t)top;
    parts->part[kept].area = (uint16_t)area;
    parts->count = kept + 1;
    parts->highest = top > parts->highest ? top : parts->highest;
}

static void add_parts(tl_span_buffer *buffer, span_parts *parts, const tl_span_node *span)
{
    uint32_t next;
    do {
        add_part(parts, tl_span_node_max(*span), tl_span_node_area(*span));
        next = tl_span_node_next(*span);
        span = &buffer->nodes[next];
    } while (next != 0 && tl_span_node_min(*span) == TL_SPAN_STEP);
}

// ---- Adding ------------------------------------------------------------------------------------------------

static void free_node(tl_span_buffer *buffer, uint32_t node)
{
    buffer->nodes[node] = buffer->free_node;
    buffer->free_node = node;
}

// The node behind a span and its steps, which are free then.
static uint32_t free_steps(tl_span_buffer *buffer, uint32_t next)
{
    while (next != 0 && tl_span_node_min(buffer->nodes[next]) == TL_SPAN_STEP) {
        const uint32_t after = tl_span_node_next(buffer->nodes[next]);
        free_node(buffer, next);
        next = after;
    }
    return next;
}

// The span and those above it that touch become one. Their nodes are freed before its steps are written anew, so at
// most one more is needed.
void tl_span_buffer_join(tl_span_buffer *buffer, tl_span_node *span, tl_span_item item)
{
    span_parts parts;
    parts.count = parts.highest = 0;
    add_part(&parts, tl_span_item_max(item), tl_span_item_area(item));
    add_parts(buffer, &parts, span);
    const uint32_t own_min = tl_span_node_min(*span), item_min = tl_span_item_min(item);
    const uint32_t min = own_min < item_min ? own_min : item_min;
    uint32_t next = free_steps(buffer, tl_span_node_next(*span));
    while (next != 0 && tl_span_node_min(buffer->nodes[next]) <= parts.highest) {
        add_parts(buffer, &parts, &buffer->nodes[next]);
        const uint32_t after = free_steps(buffer, tl_span_node_next(buffer->nodes[next]));
        free_node(buffer, next);
        buffer->span_count--;
        next = after;
    }
    uint32_t top_area = 0;
    for (uint32_t k = 0; k < parts.count; k++) {
        const uint32_t top = parts.part[k].top;
        if (top == parts.highest) {
            top_area = parts.part[k].area;
        } else if (top + buffer->walkable_climb >= parts.highest) {
            const uint32_t node = tl_span_buffer_take_node(buffer), area = parts.part[k].area;
            if (node != 0) {
                buffer->nodes[node] = tl_span_node_make(TL_SPAN_STEP, top, area, next);
                next = node;
            } else {
                tl_span_buffer_add_late(buffer, tl_span_item_make(tl_span_item_column(item), min, top, area));
            }
        }
    }
    *span = tl_span_node_make(min, parts.highest, top_area, next);
}

void tl_span_buffer_add_late(tl_span_buffer *buffer, tl_span_item item)
{
    TL_ASSERT(buffer->late_count < buffer->late_capacity);
    buffer->late[buffer->late_count++] = item;
}

// One past the last item of the union that begins with items[begin]; its top in *max_out.
static uint64_t union_end(const tl_span_item *items, uint64_t begin, uint64_t end, uint32_t *max_out)
{
    const uint32_t column = tl_span_item_column(items[begin]);
    uint32_t max = tl_span_item_max(items[begin]);
    uint64_t i = begin + 1;
    for (; i < end && tl_span_item_column(items[i]) == column && tl_span_item_min(items[i]) <= max; i++) {
        const uint32_t item_max = tl_span_item_max(items[i]);
        max = item_max > max ? item_max : max;
    }
    *max_out = max;
    return i;
}

// Sorts what came late, and of each union keeps the parts that may still decide its area.
static void reduce_late(tl_span_buffer *buffer)
{
    tl_span_item *items = buffer->late;
    const uint64_t count = buffer->late_count;
    uint64_t kept = 0;
    sort_items(items, (uint32_t)count);
    for (uint64_t begin = 0; begin < count;) {
        uint32_t max;
        const uint64_t end = union_end(items, begin, count, &max);
        const uint32_t column = tl_span_item_column(items[begin]), min = tl_span_item_min(items[begin]);
        span_parts parts;
        parts.count = parts.highest = 0;
        for (uint64_t i = begin; i < end; i++) {
            add_part(&parts, tl_span_item_max(items[i]), tl_span_item_area(items[i]));
        }
        for (uint32_t k = 0; k < parts.count; k++) { // no more than there were
            items[kept++] = tl_span_item_make(column, min, parts.part[k].top, parts.part[k].area);
        }
        begin = end;
    }
    buffer->late_count = buffer->late_sorted = kept;
}

static tl_result make_late_room(tl_span_buffer *buffer, uint32_t count)
{
    if (buffer->late_count > 2 * buffer->late_sorted) {
        reduce_late(buffer);
    }
    uint64_t wanted = buffer->late_count + count;
    wanted += wanted / 2; // so that it grows by half at least before it is reduced again
    if (buffer->late_capacity >= wanted) {
        return TL_OK;
    }
    const uint64_t doubled = 2 * buffer->late_capacity;
    wanted = wanted > doubled ? wanted : doubled;
    wanted = wanted > MIN_LATE ? wanted : MIN_LATE;
    // Positions inside a band are 32 bits wide.
    if (wanted > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_span_item *grown =
        grow_words(buffer->allocator, buffer->late, buffer->late_capacity, buffer->late_count, wanted);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    buffer->late = grown;
    buffer->late_capacity = wanted;
    return TL_OK;
}

tl_result tl_span_buffer_make_room(tl_span_buffer *buffer, uint32_t count)
{
    const uint32_t most = buffer->max_nodes > 0 ? buffer->max_nodes : MAX_NODES;
    if (buffer->node_count + count > buffer->node_capacity && buffer->node_capacity < most) {
        const uint64_t used = buffer->node_count, half = used + used / 2, needed = used + count;
        uint64_t wanted = half > needed ? half : needed;
        wanted = wanted > MIN_NODES ? wanted : MIN_NODES;
        wanted = wanted < most ? wanted : most; // beyond that all comes late
        tl_span_node *grown = grow_words(buffer->allocator, buffer->nodes, buffer->node_capacity, used, wanted);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->nodes = grown;
        buffer->node_capacity = (uint32_t)wanted;
    }
    return buffer->late_capacity - buffer->late_count >= count ? TL_OK : make_late_room(buffer, count);
}

#define NO_ROOM UINT32_MAX

// ---- The result --------------------------------------------------------------------------------------------

// A column's list as spans, behind `used` others; returns how many, or NO_ROOM where there is none for all of them.
static inline uint32_t list_spans(const tl_span_buffer *buffer, tl_span_node node, uint32_t used)
{
    tl_nav_span *spans = buffer->spans + used;
    const uint64_t room = buffer->span_capacity - used;
    const uint32_t climb = buffer->walkable_climb;
    uint32_t count = 0;
    if (node == TL_NO_SPANS) {
        return 0;
    }
    for (;;) {
        const uint32_t max = tl_span_node_max(node), min = tl_span_node_min(node);
        uint32_t area = tl_span_node_area(node), next = tl_span_node_next(node);
        if (next != 0) {
            node = buffer->nodes[next];
            while (next != 0 && tl_span_node_min(node) == TL_SPAN_STEP) {
                const uint32_t step_area = tl_span_node_area(node);
                area = step_area > area && tl_span_node_max(node) + climb >= max ? step_area : area;
                next = tl_span_node_next(node);
                node = buffer->nodes[next];
            }
        }
        if (count == room) {
            return NO_ROOM;
        }
        spans[count++] = (tl_nav_span){ (uint16_t)min, (uint16_t)max, (uint16_t)area, 0 };
        if (next == 0) {
            return count;
        }
    }
}

// A column's list as items.
static uint64_t list_items(const tl_span_buffer *buffer, uint32_t column, tl_span_item *items)
{
    tl_span_node node = buffer->lowest[column];
    uint64_t count = 0;
    uint32_t min = 0;
    while (node != TL_NO_SPANS) {
        min = tl_span_node_min(node) == TL_SPAN_STEP ? min : tl_span_node_min(node); // a step is a part of its span
        if (items != NULL) {
            items[count] = tl_span_item_make(column, min, tl_span_node_max(node), tl_span_node_area(node));
        }
        count++;
        const uint32_t next = tl_span_node_next(node);
        node = next != 0 ? buffer->nodes[next] : TL_NO_SPANS;
    }
    return count;
}

static tl_nav_span merge_union(const tl_span_item *items, uint64_t count, uint32_t max, uint32_t walkable_climb)
{
    uint32_t area = 0;
    for (uint64_t i = 0; i < count; i++) {
        uint32_t item_area = tl_span_item_area(items[i]);
        if (item_area > area && tl_span_item_max(items[i]) + walkable_climb >= max) {
            area = item_area;
        }
    }
    tl_nav_span span = { (uint16_t)tl_span_item_min(items[0]), (uint16_t)max, (uint16_t)area, 0 };
    return span;
}

// A column's list joined with what came late.
static tl_result join_late(tl_span_buffer *buffer, uint32_t column, const tl_span_item *late, uint64_t late_count,
                           tl_nav_span *spans, uint32_t *count_out)
{
    const uint64_t listed = list_items(buffer, column, NULL), count = listed + late_count;
    if (buffer->column_capacity < count) {
        tl_release_array(buffer->allocator, buffer->column, buffer->column_capacity, sizeof *buffer->column);
        buffer->column_capacity = 0;
        buffer->column = tl_allocate_array(buffer->allocator, count + count / 2, sizeof *buffer->column);
        if (buffer->column == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->column_capacity = count + count / 2;
    }
    tl_span_item *items = buffer->column;
    list_items(buffer, column, items);
    memcpy(items + listed, late, (size_t)late_count * sizeof *late);
    sort_items(items, (uint32_t)count);
    uint32_t span_count = 0;
    for (uint64_t begin = 0; begin < count;) {
        uint32_t max;
        const uint64_t end = union_end(items, begin, count, &max);
        spans[span_count++] = merge_union(items + begin, end - begin, max, buffer->walkable_climb);
        begin = end;
    }
    *count_out = span_count;
    return TL_OK;
}

// Room for `wanted` spans, the first `used` of which stay.
static tl_result make_span_room(tl_span_buffer *buffer, uint64_t used, uint64_t wanted)
{
    if (buffer->spans != NULL && buffer->span_capacity >= wanted) {
        return TL_OK;
    }
    tl_nav_span *grown = tl_allocate_array(buffer->allocator, wanted, sizeof *grown);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    if (used > 0) {
        memcpy(grown, buffer->spans, (size_t)used * sizeof *grown);
    }
    tl_release_array(buffer->allocator, buffer->spans, buffer->span_capacity, sizeof *grown);
    buffer->spans = grown;
    buffer->span_capacity = wanted;
    return TL_OK;
}

// A column's list joined with what came late, behind `used` other spans.
static tl_result append_joined(tl_span_buffer *buffer, uint32_t column, const tl_span_item *late, uint64_t late_count,
                               uint32_t used, uint32_t *count_out)
{
    TL_TRY(make_span_room(buffer, used, used + list_items(buffer, column, NULL) + late_count));
    return join_late(buffer, column, late, late_count, buffer->spans + used, count_out);
}

// The first late item of a column or a later one; they are sorted.
static uint64_t first_late_from(const tl_span_buffer *buffer, uint32_t column)
{
    uint64_t low = 0, high = buffer->late_count;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (tl_span_item_column(buffer->late[middle]) < column) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

tl_result tl_span_buffer_merge_columns(tl_span_buffer *buffer, uint32_t begin, uint32_t end, uint32_t *first_span_out,
                                       const tl_nav_span **spans_out)
{
    if (buffer->late_count > buffer->late_sorted) {
        reduce_late(buffer);
    }
    TL_TRY(make_span_room(buffer, 0, end - begin + MIN_SPANS));
    uint32_t span_count = 0;
    uint64_t late = first_late_from(buffer, begin);
    for (uint32_t c = begin; c < end; c++) {
        uint32_t in_column;
        uint64_t late_end = late;
        first_span_out[c - begin] = span_count;
        while (late_end < buffer->late_count && tl_span_item_column(buffer->late[late_end]) == c) {
            late_end++;
        }
        if (late_end > late) {
            uint32_t joined = 0;
            TL_TRY(append_joined(buffer, c, buffer->late + late, late_end - late, span_count, &joined));
            in_column = joined;
        } else {
            in_column = list_spans(buffer, buffer->lowest[c], span_count);
            for (; in_column == NO_ROOM; in_column = list_spans(buffer, buffer->lowest[c], span_count)) {
                TL_TRY(make_span_room(buffer, span_count, 2 * buffer->span_capacity + MIN_SPANS));
            }
        }
        span_count += in_column;
        late = late_end;
    }
    first_span_out[end - begin] = span_count;
    *spans_out = buffer->spans;
    return TL_OK;
}

tl_result tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *first_span_out, const tl_nav_span **spans_out)
{
    const uint64_t most = (uint64_t)buffer->span_count + buffer->late_count;
    TL_TRY(make_span_room(buffer, 0, most > 0 ? most : 1));
    return tl_span_buffer_merge_columns(buffer, 0, buffer->column_count, first_span_out, spans_out);
}
