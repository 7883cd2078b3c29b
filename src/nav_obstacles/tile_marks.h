// SPDX-License-Identifier: MIT
//
// What obstacles have marked of a tile's floors, to know whether it is as it was when it was last baked.

#ifndef TALUS_SRC_NAV_OBSTACLES_TILE_MARKS_H
#define TALUS_SRC_NAV_OBSTACLES_TILE_MARKS_H

#include <talus/base.h>

/// Floors that follow one another and got the same area.
typedef struct tl_marked_run {
    uint32_t first, count;
    uint32_t area;
} tl_marked_run;

/// Zero: none is marked.
typedef struct tl_tile_marks {
    tl_marked_run *runs; ///< [run_count] in order, none touching one of its own area
    uint32_t run_count;
} tl_tile_marks;

/// Whether the floors whose area differs from their base area, and their areas, are those of the marks.
bool tl_tile_marks_hold(const tl_tile_marks *marks, const uint8_t *base_area, const uint8_t *area, uint32_t count);
/// The areas that the marks stand for, [count], of the floors from `first` on; base_area: of these.
void tl_tile_marks_apply(const tl_tile_marks *marks, const uint8_t *base_area, uint32_t first, uint32_t count,
                         uint8_t *area_out);
/// The marks of floors as they are. TL_ERR_MEMORY: `marks_out` is zeroed.
tl_result tl_tile_marks_find(const uint8_t *base_area, const uint8_t *area, uint32_t count,
                             const tl_allocator *allocator, tl_tile_marks *marks_out);
void tl_tile_marks_free(tl_tile_marks *marks, const tl_allocator *allocator);

#endif
