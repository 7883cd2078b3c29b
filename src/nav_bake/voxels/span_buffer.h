// SPDX-License-Identifier: MIT
//
// The unsorted spans of a band of columns, and their canonical union.

#ifndef TALUS_SRC_NAV_BAKE_SPAN_BUFFER_H
#define TALUS_SRC_NAV_BAKE_SPAN_BUFFER_H

#include <talus/nav_bake.h>

/// One voxelized piece of a triangle: column (24 bits), min, max (16 each), area (8), most significant first. Sorting
/// the integers sorts by column, then from bottom to top.
typedef uint64_t tl_span_item;

#define TL_SPAN_ITEM_MAX_COLUMNS (1u << 24)

static inline tl_span_item tl_span_item_make(uint32_t column, uint32_t min, uint32_t max, uint32_t area)
{
    return (uint64_t)column << 40 | (uint64_t)min << 24 | (uint64_t)max << 8 | area;
}

static inline uint32_t tl_span_item_column(tl_span_item item)
{
    return (uint32_t)(item >> 40);
}

static inline uint32_t tl_span_item_min(tl_span_item item)
{
    return (uint32_t)(item >> 24) & 0xffffu;
}

static inline uint32_t tl_span_item_max(tl_span_item item)
{
    return (uint32_t)(item >> 8) & 0xffffu;
}

static inline uint32_t tl_span_item_area(tl_span_item item)
{
    return (uint32_t)item & 0xffu;
}

typedef struct tl_span_chunk tl_span_chunk;

/// Grows as needed, a chunk at a time, and is used again for the next band. Zero is an empty buffer.
typedef struct tl_span_buffer {
    tl_span_item *items;      ///< of the chunk at hand
    uint32_t count, capacity; ///< of the chunk at hand
    tl_span_chunk *used;      ///< the chunk at hand, and the full ones
    tl_span_chunk *spare;
    uint64_t full_count;  ///< items in the full chunks
    uint64_t max_items;   ///< that are held without being reduced
    tl_span_item *sorted; ///< [sorted_capacity] made when it is first needed
    uint64_t sorted_capacity;
    uint32_t *column_ends; ///< [end_capacity] items of each column; where they end, once sorted
    uint32_t end_capacity;
    uint32_t column_count;   ///< of the band at hand
    uint32_t walkable_climb; ///< voxels
    const tl_allocator *allocator;
} tl_span_buffer;

/// Empties the buffer for a band of column_count columns, 1 to TL_SPAN_ITEM_MAX_COLUMNS.
tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count);
void tl_span_buffer_free(tl_span_buffer *buffer);

/// What tl_span_buffer_reserve does when there is no room.
tl_result tl_span_buffer_make_room(tl_span_buffer *buffer, uint32_t count);

/// Makes room for `count` more items: afterwards items[buffer->count .. + count) may be written, then be added.
static inline tl_result tl_span_buffer_reserve(tl_span_buffer *buffer, uint32_t count)
{
    return buffer->capacity - buffer->count >= count ? TL_OK : tl_span_buffer_make_room(buffer, count);
}

/// Adds the item, for which there is room.
static inline void tl_span_buffer_add(tl_span_buffer *buffer, tl_span_item item)
{
    buffer->items[buffer->count++] = item;
    buffer->column_ends[tl_span_item_column(item)]++;
}

/// Adds `count` items that were written, one for each of as many columns.
static inline void tl_span_buffer_add_run(tl_span_buffer *buffer, uint32_t first_column, uint32_t count)
{
    uint32_t *ends = buffer->column_ends + first_column;
    for (uint32_t i = 0; i < count; i++) {
        ends[i]++;
    }
    buffer->count += count;
}

/// The canonical union of all items: those of column c begin at first_span_out[c] and end at first_span_out[c + 1]. The
/// spans lie in the buffer and hold until its next use.
tl_result tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *first_span_out, const tl_nav_span **spans_out);

#endif
