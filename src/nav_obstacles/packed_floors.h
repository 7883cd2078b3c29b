// SPDX-License-Identifier: MIT
//
// A tile's floors in a fraction of their memory, for as long as no obstacle is put on them.

#ifndef TALUS_SRC_NAV_OBSTACLES_PACKED_FLOORS_H
#define TALUS_SRC_NAV_OBSTACLES_PACKED_FLOORS_H

#include <talus/nav_bake.h>

/// The heights of the walkable floors of 8 by 8 columns; low > high: there are none.
typedef struct tl_floor_block {
    uint16_t low, high;
} tl_floor_block;

/// Zero: no floors.
typedef struct tl_packed_floors {
    tl_nav_compact frame; ///< all but the arrays, which are NULL
    uint8_t *bytes;
    uint64_t size;
    uint64_t floors_at, areas_at; ///< in `bytes`, behind the columns' counts
    bool has_steps;               ///< else neighbours: its links need 32 bits
    tl_floor_block *blocks;       ///< [block_count] row-major
    uint32_t block_count;
} tl_packed_floors;

/// Packs floors, areas and links; their clearances, distances and regions are left out. TL_ERR_MEMORY: `packed_out` is
/// zeroed.
tl_result tl_floors_pack(const tl_nav_compact *compact, const tl_allocator *allocator, tl_packed_floors *packed_out);
/// Whether an obstacle's box (tl_obstacle_box) can hold walkable floors; false: it marks none.
bool tl_packed_floors_reach(const tl_packed_floors *packed, tl_aabb box);

/// The arrays of unpacked floors, one after the other in one block that is used again. Zero is an empty one.
typedef struct tl_floors_scratch {
    void *block;
    uint64_t size;
    const tl_allocator *allocator;
    const uint8_t *links; ///< in the block, of the floors that were unpacked last; bit d: there is a neighbour
    uint8_t *is_done;     ///< in the block, for linking: [columns]
    uint16_t *even;       ///< in the block, for linking: [columns of a row]
} tl_floors_scratch;

/// The same floors again, in the scratch's block, where they hold until its next use: they are not freed. They have
/// room for their links, and get them by tl_floors_link. base_area_out: their areas once more. TL_ERR_MEMORY: nothing
/// is written.
tl_result tl_floors_unpack(const tl_packed_floors *packed, tl_floors_scratch *scratch, tl_nav_compact *compact_out,
                           uint8_t **base_area_out);
/// Links the floors that were unpacked last.
void tl_floors_link(const tl_floors_scratch *scratch, tl_nav_compact *compact);
void tl_floors_scratch_free(tl_floors_scratch *scratch);
void tl_packed_floors_free(tl_packed_floors *packed);

#endif
