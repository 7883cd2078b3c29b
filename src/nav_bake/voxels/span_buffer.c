// SPDX-License-Identifier: MIT
//
// Spans are collected unsorted and merged once, a band of columns at a time.
//
// Recast inserts each span into its column's linked list as it comes: an allocation and a walk per span, and a result
// that depends on the order of the triangles, since the area of a merged span is decided pair by pair. Here an item is
// one 64-bit word, written to chunks that never move; a band's items are counting-sorted by column and then by height,
// and merged by a rule that knows no order:
//
//   Spans of a column that touch or overlap become their union. Its area is the largest among those of its parts whose
//   top lies at most walkable_climb below the top of the union.
//
// A band that collects many items (a heap of triangles in one place) is reduced in between: of each union only the
// parts stay that may still decide its area, those with a top above that of every part of larger area. So the memory is
// bounded by the columns and areas, not by the triangles, and the reduction does not change the result.

#include "nav_bake/voxels/span_buffer.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/lowest_bit.h"

#include <string.h>

_Static_assert(sizeof(tl_nav_span) == sizeof(tl_span_item), "spans are written over the items they were made of");

enum {
    MIN_CHUNK = 64, // items; else one a column of the band, so that little is taken and not used
    // Items are held without being reduced up to here: in real levels so many triangles a column are seldom redundant.
    MAX_ITEMS_PER_COLUMN = 16,
    INSERTION_SORT_MAX = 24,
    SORTED_MAX = 10, // items of a column that are sorted rather than drawn
    DRAWN_VOXELS = 4096,
    VOXELS_PER_DRAWN_ITEM = 32 // a drawing's cost is about an item's a machine word
};

struct tl_span_chunk {
    tl_span_chunk *next;
    uint32_t count, capacity;
    tl_span_item items[];
};

static uint64_t chunk_size(uint32_t capacity)
{
    return sizeof(tl_span_chunk) + (uint64_t)capacity * sizeof(tl_span_item);
}

static void free_chunks(tl_span_chunk *chunk, const tl_allocator *allocator)
{
    while (chunk != NULL) {
        tl_span_chunk *next = chunk->next;
        tl_release_array(allocator, chunk, chunk_size(chunk->capacity), 1);
        chunk = next;
    }
}

// The next chunk to be filled, with room for `count` items.
static tl_result take_chunk(tl_span_buffer *buffer, uint32_t count)
{
    tl_span_chunk *chunk = buffer->spare;
    if (chunk != NULL && chunk->capacity >= count) {
        buffer->spare = chunk->next;
    } else {
        uint32_t capacity = buffer->column_count > MIN_CHUNK ? buffer->column_count : MIN_CHUNK;
        capacity = capacity > count ? capacity : count;
        chunk = tl_allocate_array(buffer->allocator, chunk_size(capacity), 1);
        if (chunk == NULL) {
            return TL_ERR_MEMORY;
        }
        chunk->capacity = capacity;
    }
    if (buffer->used != NULL) {
        buffer->used->count = buffer->count;
        buffer->full_count += buffer->count;
    }
    chunk->next = buffer->used;
    buffer->used = chunk;
    buffer->items = chunk->items;
    buffer->count = 0;
    buffer->capacity = chunk->capacity;
    return TL_OK;
}

// No chunk is in use any more.
static void empty(tl_span_buffer *buffer)
{
    while (buffer->used != NULL) {
        tl_span_chunk *chunk = buffer->used;
        buffer->used = chunk->next;
        chunk->next = buffer->spare;
        buffer->spare = chunk;
    }
    buffer->count = buffer->capacity = 0;
    buffer->full_count = 0;
}

tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count)
{
    TL_ASSERT(column_count > 0 && column_count <= TL_SPAN_ITEM_MAX_COLUMNS);
    empty(buffer);
    buffer->column_count = column_count;
    buffer->max_items = (uint64_t)column_count * MAX_ITEMS_PER_COLUMN;
    if (buffer->end_capacity < column_count) {
        tl_release_array(buffer->allocator, buffer->column_ends, buffer->end_capacity, sizeof *buffer->column_ends);
        buffer->end_capacity = 0;
        buffer->column_ends = tl_allocate_array(buffer->allocator, column_count, sizeof *buffer->column_ends);
        if (buffer->column_ends == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->end_capacity = column_count;
    }
    memset(buffer->column_ends, 0, column_count * sizeof *buffer->column_ends);
    return TL_OK;
}

void tl_span_buffer_free(tl_span_buffer *buffer)
{
    empty(buffer);
    free_chunks(buffer->spare, buffer->allocator);
    tl_release_array(buffer->allocator, buffer->sorted, buffer->sorted_capacity, sizeof *buffer->sorted);
    tl_release_array(buffer->allocator, buffer->column_ends, buffer->end_capacity, sizeof *buffer->column_ends);
    buffer->spare = NULL;
    buffer->sorted = NULL;
    buffer->column_ends = NULL;
    buffer->sorted_capacity = 0;
    buffer->end_capacity = 0;
}

// ---- Sorting -----------------------------------------------------------------------------------------------

#define TL_HEAP(name)                 span_heap_##name
#define TL_HEAP_ITEM                  tl_span_item
#define TL_HEAP_BEFORE(context, a, b) ((a) > (b))
#include "base/heap.inl"

// Compiles to conditional moves: the order of two spans is a coin's toss that no branch predictor wins.
static inline void order(tl_span_item *a, tl_span_item *b)
{
    tl_span_item low = *a < *b ? *a : *b, high = *a < *b ? *b : *a;
    *a = low;
    *b = high;
}

// A column holds few items, nearly always; heapsort bounds the rest. Equal items are equal bits, so stability is moot.
static void sort_column(tl_span_item *items, uint32_t count)
{
    switch (count) {
    case 2:
        order(&items[0], &items[1]);
        return;
    case 3:
        order(&items[0], &items[1]);
        order(&items[1], &items[2]);
        order(&items[0], &items[1]);
        return;
    case 4:
        order(&items[0], &items[1]);
        order(&items[2], &items[3]);
        order(&items[0], &items[2]);
        order(&items[1], &items[3]);
        order(&items[1], &items[2]);
        return;
    default:
        break;
    }
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

static void scatter(const tl_span_item *items, uint32_t count, uint32_t *ends, tl_span_item *sorted)
{
    for (uint32_t i = 0; i < count; i++) {
        sorted[ends[tl_span_item_column(items[i])]++] = items[i];
    }
}

// Leaves all items in `sorted`, column by column; column_ends[c] is where column c ends. No chunk is in use afterwards.
static tl_result group_by_column(tl_span_buffer *buffer)
{
    const uint64_t count = buffer->full_count + buffer->count;
    if (buffer->sorted == NULL || buffer->sorted_capacity < count) {
        tl_release_array(buffer->allocator, buffer->sorted, buffer->sorted_capacity, sizeof *buffer->sorted);
        buffer->sorted_capacity = 0;
        buffer->sorted = tl_allocate_array(buffer->allocator, count, sizeof *buffer->sorted);
        if (buffer->sorted == NULL) {
            return TL_ERR_MEMORY;
        }
        buffer->sorted_capacity = count;
    }
    uint32_t *ends = buffer->column_ends, position = 0;
    for (uint32_t c = 0; c < buffer->column_count; c++) {
        const uint32_t in_column = ends[c];
        ends[c] = position;
        position += in_column;
    }
    scatter(buffer->items, buffer->count, ends, buffer->sorted);
    for (const tl_span_chunk *full = buffer->used != NULL ? buffer->used->next : NULL; full != NULL;
         full = full->next) {
        scatter(full->items, full->count, ends, buffer->sorted);
    }
    empty(buffer);
    return TL_OK;
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
static tl_result reduce_column(tl_span_buffer *buffer)
{
    TL_TRY(group_by_column(buffer));
    uint32_t begin = 0;
    for (uint32_t c = 0; c < buffer->column_count; c++) {
        const uint32_t end = buffer->column_ends[c], in_column = end - begin;
        uint32_t kept = 0;
        sort_column(buffer->sorted + begin, in_column);
        TL_TRY(buffer->capacity - buffer->count >= in_column ? TL_OK : take_chunk(buffer, in_column));
        while (begin < end) {
            uint32_t max;
            const uint32_t next = union_end(buffer->sorted, begin, end, &max);
            kept += reduce_union(buffer->sorted + begin, next - begin, max, buffer->items + buffer->count + kept);
            begin = next;
        }
        buffer->count += kept;
        buffer->column_ends[c] = kept;
    }
    return TL_OK;
}

tl_result tl_span_buffer_make_room(tl_span_buffer *buffer, uint32_t count)
{
    if (buffer->full_count + buffer->count + count > buffer->max_items) {
        TL_TRY(reduce_column(buffer));
        while (2 * (buffer->full_count + buffer->count) + count > buffer->max_items) {
            buffer->max_items *= 2;
        }
        // Positions inside a band are 32 bits wide.
        if (buffer->max_items > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
    }
    return buffer->capacity - buffer->count >= count ? TL_OK : take_chunk(buffer, count);
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

// The unions of a column of few items, bottom to top; returns how many.
static uint32_t merge_sorted(tl_span_item *items, uint32_t count, uint32_t walkable_climb, tl_nav_span *spans)
{
    uint32_t span_count = 0;
    sort_column(items, count);
    for (uint32_t begin = 0; begin < count;) {
        uint32_t max;
        uint32_t end = union_end(items, begin, count, &max);
        spans[span_count++] = merge_union(items + begin, end - begin, max, walkable_climb);
        begin = end;
    }
    return span_count;
}

// Sets the bits [begin, end), end > begin.
static void set_bits(uint64_t *words, uint32_t begin, uint32_t end)
{
    const uint32_t first = begin / 64, last = (end - 1) / 64;
    const uint64_t from_begin = UINT64_MAX << (begin % 64), to_end = UINT64_MAX >> (63 - (end - 1) % 64);
    if (first == last) {
        words[first] |= from_begin & to_end;
        return;
    }
    words[first] |= from_begin;
    for (uint32_t i = first + 1; i < last; i++) {
        words[i] = UINT64_MAX;
    }
    words[last] |= to_end;
}

// The first bit at or above `from` that is `set`; there is one.
static uint32_t find_bit(const uint64_t *words, uint32_t from, bool set)
{
    const uint64_t flip = set ? 0 : UINT64_MAX;
    uint32_t word = from / 64;
    uint64_t found = (words[word] ^ flip) & (UINT64_MAX << (from % 64));
    while (found == 0) {
        found = words[++word] ^ flip;
    }
    return word * 64 + tl_lowest_bit(found);
}

// The same for many items within few voxels: they are drawn into a column of bits, and each top notes its largest area.
// No sorting; detailed props put hundreds of small triangles over one column.
static uint32_t merge_drawn(const tl_span_item *items, uint32_t count, uint32_t bottom, uint32_t top,
                            uint32_t walkable_climb, tl_nav_span *spans)
{
    uint64_t solid[DRAWN_VOXELS / 64 + 1]; // a clear bit above the top included
    uint8_t area_of_top[DRAWN_VOXELS + 1];
    const uint32_t height = top - bottom;
    memset(solid, 0, (height / 64 + 1) * sizeof *solid);
    memset(area_of_top, 0, height + 1);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t max = tl_span_item_max(items[i]) - bottom, area = tl_span_item_area(items[i]);
        set_bits(solid, tl_span_item_min(items[i]) - bottom, max);
        area_of_top[max] = (uint8_t)(area > area_of_top[max] ? area : area_of_top[max]);
    }
    uint32_t span_count = 0;
    for (uint32_t end = 0; end < height;) {
        const uint32_t begin = find_bit(solid, end, true);
        end = find_bit(solid, begin, false);
        uint32_t area = 0, y = end > begin + walkable_climb ? end - walkable_climb : begin + 1;
        for (; y <= end; y++) {
            area = area_of_top[y] > area ? area_of_top[y] : area;
        }
        tl_nav_span span = { (uint16_t)(bottom + begin), (uint16_t)(bottom + end), (uint16_t)area, 0 };
        spans[span_count++] = span;
    }
    return span_count;
}

static uint32_t merge_column(tl_span_item *items, uint32_t count, uint32_t walkable_climb, tl_nav_span *spans)
{
    if (count > SORTED_MAX) {
        uint32_t bottom = UINT32_MAX, top = 0;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t min = tl_span_item_min(items[i]), max = tl_span_item_max(items[i]);
            bottom = min < bottom ? min : bottom;
            top = max > top ? max : top;
        }
        if (top - bottom < DRAWN_VOXELS && top - bottom < count * VOXELS_PER_DRAWN_ITEM) {
            return merge_drawn(items, count, bottom, top, walkable_climb, spans);
        }
    }
    return merge_sorted(items, count, walkable_climb, spans);
}

// The unions of two items, as most columns hold.
static inline uint32_t merge_two(tl_span_item a, tl_span_item b, uint32_t walkable_climb, tl_nav_span *spans)
{
    order(&a, &b);
    const tl_span_item both[2] = { a, b };
    const uint32_t max_a = tl_span_item_max(a), max_b = tl_span_item_max(b);
    if (tl_span_item_min(b) <= max_a) {
        spans[0] = merge_union(both, 2, max_a > max_b ? max_a : max_b, walkable_climb);
        return 1;
    }
    spans[0] = merge_union(both, 1, max_a, walkable_climb);
    spans[1] = merge_union(both + 1, 1, max_b, walkable_climb);
    return 2;
}

tl_result tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *first_span_out, const tl_nav_span **spans_out)
{
    TL_TRY(group_by_column(buffer));
    // No column has more spans than items: spans take the place of items that were read.
    tl_nav_span *spans = (tl_nav_span *)(void *)buffer->sorted;
    uint32_t span_count = 0, begin = 0;
    for (uint32_t c = 0; c < buffer->column_count; c++) {
        const uint32_t end = buffer->column_ends[c];
        tl_span_item *items = buffer->sorted + begin;
        first_span_out[c] = span_count;
        if (end - begin == 2) {
            span_count += merge_two(items[0], items[1], buffer->walkable_climb, spans + span_count);
        } else if (end > begin) {
            span_count += merge_column(items, end - begin, buffer->walkable_climb, spans + span_count);
        }
        begin = end;
    }
    first_span_out[buffer->column_count] = span_count;
    *spans_out = spans;
    return TL_OK;
}
