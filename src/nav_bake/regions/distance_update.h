// SPDX-License-Identifier: MIT
//
// Incremental distance field, where few floors have changed their area.

#ifndef TALUS_SRC_NAV_BAKE_DISTANCE_UPDATE_H
#define TALUS_SRC_NAV_BAKE_DISTANCE_UPDATE_H

#include <talus/nav_bake.h>

/// What the steps of a distance field left: the forward sweep, the backward one and the blur, one after the other. 3
/// bytes a floor where all distances fit in 8 bits, as in tiles; else 6.
typedef struct tl_distance_stages {
    void *values;        ///< [3 * span_count] of value_size each
    uint32_t value_size; ///< bytes; 0: none are held
} tl_distance_stages;

/// Allocates and fills the stages for the areas of `compact` as they are. On failure nothing is held.
tl_result tl_distance_stages_make(const tl_nav_compact *compact, const tl_allocator *allocator,
                                  tl_distance_stages *stages_out);
uint64_t tl_distance_stages_bytes(const tl_distance_stages *stages, uint32_t span_count);
void tl_distance_stages_free(tl_distance_stages *stages, uint32_t span_count, const tl_allocator *allocator);

/// As tl_nav_distance_field, from the stages for the areas `before`. O(floors / 64 + floors whose distance changes).
tl_result tl_distance_field_update(const uint8_t *before, const tl_distance_stages *stages,
                                   const tl_allocator *allocator, tl_nav_compact *compact);

#endif
