// SPDX-License-Identifier: MIT
//
// Floor that must outlive a bake's filters and erosion, known from the triangles alone.

#ifndef TALUS_SRC_NAV_AUDIT_CERTAIN_FLOOR_H
#define TALUS_SRC_NAV_AUDIT_CERTAIN_FLOOR_H

#include "nav_audit/column_surfaces.h"

/// A block of columns around the one in question.
typedef struct tl_audit_block {
    int32_t x, z;    ///< blocks from the middle
    uint32_t parent; ///< the block before it towards the middle; its own number in the middle
    bool is_walked;  ///< erosion would reach the middle from here: it must be walkable; else floor is enough
} tl_audit_block;

/// The blocks that decide about one column, the nearest first.
typedef struct tl_audit_window {
    tl_audit_block *blocks;
    uint32_t count, capacity;
    uint32_t block_columns; ///< a block's edge, odd
    float reach;            ///< metres from the middle to the window's farthest side
} tl_audit_window;

/// The window of an agent whose radius is that many columns. TL_ERR_MEMORY.
tl_result tl_audit_window_create(uint32_t radius, float cell_size, const tl_allocator *allocator,
                                 tl_audit_window *window_out);
void tl_audit_window_free(tl_audit_window *window, const tl_allocator *allocator);

/// Whether a column outlives the filters, and erosion by the window's radius, with its floor at a height.
/// TL_ERR_MEMORY.
tl_result tl_audit_is_certain(tl_audit_columns *columns, const tl_audit_window *window, const int32_t column[2],
                              float y, bool *is_certain_out);

/// Moves a height from the floor of a neighbouring column to the walkable floor of this one. `*found_out` is false:
/// there is none within half a climb. TL_ERR_MEMORY.
tl_result tl_audit_follow_floor(tl_audit_columns *columns, const int32_t column[2], float *y, bool *found_out);

#endif
