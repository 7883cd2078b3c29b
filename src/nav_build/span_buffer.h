// SPDX-License-Identifier: MIT
//
// The unsorted spans of a band of columns, and their canonical union.

#ifndef TALUS_SRC_NAV_BUILD_SPAN_BUFFER_H
#define TALUS_SRC_NAV_BUILD_SPAN_BUFFER_H

#include <talus/nav_build.h>

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

/// Grows as needed and is used again for the next band. Zero is an empty buffer.
typedef struct tl_span_buffer {
    tl_span_item *items;
    tl_span_item *sorted; ///< [sorted_capacity] made when it is first needed
    uint64_t count;
    uint64_t capacity, sorted_capacity;
    uint32_t *ends; ///< [end_capacity] per column, while sorting
    uint32_t end_capacity;
    uint32_t column_count;   ///< of the band at hand
    uint32_t walkable_climb; ///< voxels
    const tl_allocator *allocator;
} tl_span_buffer;

/// Empties the buffer for a band of column_count columns, at most TL_SPAN_ITEM_MAX_COLUMNS.
tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count);
void tl_span_buffer_free(tl_span_buffer *buffer);

/// What tl_span_buffer_reserve does when there is no room.
tl_result tl_span_buffer_make_room(tl_span_buffer *buffer, uint32_t count);

/// Makes room for `count` more items: afterwards items[buffer->count .. + count) may be written.
static inline tl_result tl_span_buffer_reserve(tl_span_buffer *buffer, uint32_t count)
{
    return buffer->capacity - buffer->count >= count ? TL_OK : tl_span_buffer_make_room(buffer, count);
}

/// The canonical union of all items: those of column c begin at first_span_out[c] and end at first_span_out[c + 1]. The
/// spans lie in the buffer and hold until its next use.
tl_result tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *first_span_out, const tl_nav_span **spans_out);

#endif
