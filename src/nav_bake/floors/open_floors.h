// SPDX-License-Identifier: MIT
//
// From the solid spans of a run of rows to the floors above them, filtered.

#ifndef TALUS_SRC_NAV_BAKE_OPEN_FLOORS_H
#define TALUS_SRC_NAV_BAKE_OPEN_FLOORS_H

#include "nav_bake/voxels/row_source.h"

/// Floors in the order of their columns: three arrays in one block.
typedef struct tl_floors {
    uint16_t *floor, *clearance;
    uint8_t *area;
    uint32_t count;
    uint32_t capacity;
} tl_floors;

tl_result tl_floors_allocate(tl_floors *floors, uint32_t capacity, const tl_allocator *allocator);
void tl_floors_release(tl_floors *floors, const tl_allocator *allocator);
/// Copies the floors behind those that are there; they fit.
void tl_floors_append(tl_floors *floors, const tl_floors *more);

struct tl_gap;

/// The gaps of a row, in blocks of columns.
typedef struct tl_open_row {
    struct tl_gap_block *blocks;
    struct tl_gap_layer *layers;
    uint64_t block_capacity, layer_capacity;
    uint32_t span_count;
} tl_open_row;

/// The rows that a sweep looks at, kept from one run of rows to the next. Zero is an empty one.
typedef struct tl_open_scratch {
    tl_open_row rows[3];
    uint64_t span_count; ///< of the rows that were opened
    const tl_allocator *allocator;
} tl_open_scratch;

void tl_open_scratch_free(tl_open_scratch *scratch);

/// Applies config's filters to the spans of the rows [begin, end) and appends the floors that are left to `floors`,
/// which grow in the scratch's allocator as needed; ends_out[column] is how many there are after each column. Where the
/// ledge filter is on, the source has one row more on each side that is inside the field; of those only heights matter.
tl_result tl_open_rows(const tl_nav_config *config, tl_row_source *source, uint32_t begin, uint32_t end,
                       tl_open_scratch *scratch, tl_floors *floors, uint32_t *ends_out);

#endif
