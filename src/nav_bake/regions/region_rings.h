// SPDX-License-Identifier: MIT
//
// A region's ring: the neighbours met on a walk round its outer outline, in order, without repeats in a row.

#ifndef TALUS_SRC_NAV_BAKE_REGION_RINGS_H
#define TALUS_SRC_NAV_BAKE_REGION_RINGS_H

#include "nav_bake/regions/regions.h"

#define TL_NO_REGION_RING UINT32_MAX

/// A ring is a circular list of entries. Regions are as they were when the walk was made.
typedef struct tl_ring_entry {
    uint32_t region; ///< 0: a wall or a floor without region; may be a border region
    uint32_t next;   ///< entry
} tl_ring_entry;

typedef struct tl_region_rings {
    tl_ring_entry *entries;
    uint32_t entry_count;
    uint32_t *head;       ///< [region_count] first entry, or TL_NO_REGION_RING for a region without floors
    uint32_t *span_count; ///< [region_count]
    uint8_t *area;        ///< [region_count]
} tl_region_rings;

/// O(floors + outlines). TL_ERR_CORRUPT when neighbours are not mutual and a walk does not close.
tl_result tl_region_rings_make(const tl_region_work *work, tl_region_rings *rings_out);

#endif
