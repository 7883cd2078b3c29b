// SPDX-License-Identifier: MIT
//
// Incremental distance field, where few floors have changed their area.

#ifndef TALUS_SRC_NAV_BAKE_DISTANCE_UPDATE_H
#define TALUS_SRC_NAV_BAKE_DISTANCE_UPDATE_H

#include <talus/nav_bake.h>

/// What the steps of a distance field left, each [span_count]: 6 bytes a floor.
typedef struct tl_distance_stages {
    uint16_t *forward, *sharp, *blurred;
} tl_distance_stages;

/// Allocates and fills the stages for the areas of `compact` as they are. On failure nothing is held.
tl_result tl_distance_stages_make(const tl_nav_compact *compact, const tl_allocator *allocator,
                                  tl_distance_stages *stages_out);
void tl_distance_stages_free(tl_distance_stages *stages, uint32_t span_count, const tl_allocator *allocator);

/// As tl_nav_distance_field, from the stages for the areas `before`. O(floors / 64 + floors whose distance changes).
tl_result tl_distance_field_update(const uint8_t *before, const tl_distance_stages *stages,
                                   const tl_allocator *allocator, tl_nav_compact *compact);

#endif
