// SPDX-License-Identifier: MIT
//
// The solid spans of a band of columns, joined as they come.

#ifndef TALUS_SRC_NAV_BAKE_SPAN_BUFFER_H
#define TALUS_SRC_NAV_BAKE_SPAN_BUFFER_H

#include "base/compiler.h"

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

/// A span of a column's list: max, min (16 bits each), area (8), the node above it (24; 0: none), most significant
/// first. Spans rise and do not touch. Behind a span come its lower tops of larger area, with TL_SPAN_STEP as min.
typedef uint64_t tl_span_node;

/// No span begins so high, though one may end there. A column without spans holds TL_NO_SPANS.
#define TL_SPAN_STEP 0xffffu
#define TL_NO_SPANS  ((tl_span_node)0xffffffff << 32)

static inline tl_span_node tl_span_node_make(uint32_t min, uint32_t max, uint32_t area, uint32_t next)
{
    return (uint64_t)max << 48 | (uint64_t)min << 32 | (uint64_t)area << 24 | next;
}

static inline uint32_t tl_span_node_max(tl_span_node node)
{
    return (uint32_t)(node >> 48);
}

static inline uint32_t tl_span_node_min(tl_span_node node)
{
    return (uint32_t)(node >> 32) & 0xffffu;
}

static inline uint32_t tl_span_node_area(tl_span_node node)
{
    return (uint32_t)(node >> 24) & 0xffu;
}

static inline uint32_t tl_span_node_next(tl_span_node node)
{
    return (uint32_t)node & 0xffffffu;
}

/// Used again for the next band. Zero is an empty buffer.
typedef struct tl_span_buffer {
    tl_span_node *lowest; ///< [lowest_capacity] of each column
    tl_span_node *nodes;  ///< [node_capacity] all others; nodes[0] ends all lists
    uint32_t lowest_capacity, node_capacity;
    uint32_t node_count; ///< that were ever used
    uint32_t free_node;  ///< list of those that are free again
    uint32_t span_count; ///< in the lists
    uint32_t column_count;
    uint32_t walkable_climb; ///< voxels
    uint32_t max_nodes;      ///< at most 2^24, which links can count; 0: so many
    tl_span_item *late;      ///< [late_capacity] what lists that are too long did not take
    uint64_t late_count, late_capacity;
    uint64_t late_sorted; ///< of these were sorted and reduced
    tl_span_item *column; ///< [column_capacity] a column's spans and what came late
    uint64_t column_capacity;
    tl_nav_span *spans; ///< [span_capacity] the result
    uint64_t span_capacity;
    const tl_allocator *allocator;
} tl_span_buffer;

/// Empties the buffer for a band of column_count columns, 1 to TL_SPAN_ITEM_MAX_COLUMNS.
tl_result tl_span_buffer_begin(tl_span_buffer *buffer, uint32_t column_count);
void tl_span_buffer_free(tl_span_buffer *buffer);

/// What tl_span_buffer_reserve does when there is no room.
tl_result tl_span_buffer_make_room(tl_span_buffer *buffer, uint32_t count);
/// What tl_span_buffer_add does when the item reaches out of the lowest span that it touches, or has a larger area.
void tl_span_buffer_join(tl_span_buffer *buffer, tl_span_node *span, tl_span_item item);
/// What tl_span_buffer_add does when the column's list is long, or no node is left.
void tl_span_buffer_add_late(tl_span_buffer *buffer, tl_span_item item);

enum { TL_SPAN_LIST_STEPS = 24 };

/// Makes room for `count` more items.
static inline tl_result tl_span_buffer_reserve(tl_span_buffer *buffer, uint32_t count)
{
    const bool has_room =
        buffer->node_count + count <= buffer->node_capacity && buffer->late_capacity - buffer->late_count >= count;
    return has_room ? TL_OK : tl_span_buffer_make_room(buffer, count);
}

/// A free node, for which there is room; 0: there is none.
static inline uint32_t tl_span_buffer_take_node(tl_span_buffer *buffer)
{
    const uint32_t node = buffer->free_node;
    if (node != 0) {
        buffer->free_node = tl_span_node_next(buffer->nodes[node]);
        return node;
    }
    return buffer->node_count < buffer->node_capacity ? buffer->node_count++ : 0;
}

/// Adds [min, max), of the given area, to a column; there is room. min < max <= 0xffff.
static TL_ALWAYS_INLINE void tl_span_buffer_add(tl_span_buffer *buffer, uint32_t column, uint32_t min, uint32_t max,
                                                uint32_t area)
{
    tl_span_node *span = &buffer->lowest[column];
    uint32_t steps = 0;
    while (tl_span_node_max(*span) < min) {
        const uint32_t next = tl_span_node_next(*span);
        if (next == 0 || ++steps == TL_SPAN_LIST_STEPS) {
            const uint32_t node = next == 0 ? tl_span_buffer_take_node(buffer) : 0;
            if (node == 0) {
                tl_span_buffer_add_late(buffer, tl_span_item_make(column, min, max, area));
                return;
            }
            buffer->nodes[node] = tl_span_node_make(min, max, area, 0);
            *span |= node;
            buffer->span_count++;
            return;
        }
        span = &buffer->nodes[next];
    }
    const tl_span_node above = *span;
    if (above == TL_NO_SPANS) {
        *span = tl_span_node_make(min, max, area, 0);
        buffer->span_count++;
        return;
    }
    if (tl_span_node_min(above) > max) { // nothing touches it
        const uint32_t node = tl_span_buffer_take_node(buffer);
        if (node == 0) {
            tl_span_buffer_add_late(buffer, tl_span_item_make(column, min, max, area));
            return;
        }
        buffer->nodes[node] = above;
        *span = tl_span_node_make(min, max, area, node);
        buffer->span_count++;
        return;
    }
    if (max <= tl_span_node_max(above) && area <= tl_span_node_area(above)) {
        if (min < tl_span_node_min(above)) {
            *span = tl_span_node_make(min, tl_span_node_max(above), tl_span_node_area(above), tl_span_node_next(above));
        }
        return;
    }
    tl_span_buffer_join(buffer, span, tl_span_item_make(column, min, max, area));
}

/// The canonical union of all items: those of column c begin at first_span_out[c] and end at first_span_out[c + 1]. The
/// spans lie in the buffer and hold until its next use.
tl_result tl_span_buffer_merge(tl_span_buffer *buffer, uint32_t *first_span_out, const tl_nav_span **spans_out);

/// The same of the columns [begin, end) alone: the spans of column begin + k begin at first_span_out[k]. It may be
/// asked of any columns, again and again, but nothing more is added then.
tl_result tl_span_buffer_merge_columns(tl_span_buffer *buffer, uint32_t begin, uint32_t end, uint32_t *first_span_out,
                                       const tl_nav_span **spans_out);

#endif
