// SPDX-License-Identifier: MIT
//
// Who takes which slot of a formation.

#ifndef TALUS_SRC_NAV_CROWD_SLOT_DEAL_H
#define TALUS_SRC_NAV_CROWD_SLOT_DEAL_H

#include "base/radix_sort.h"

#include <stdint.h>

enum { TL_SLOT_DEAL_EXACT = 64 }; ///< followers up to which the sum of squares is the smallest

/// Followers and as many slots.
typedef struct tl_slot_deal {
    float *from;                               ///< [2 * count] where each follower stands, metres in the plan
    float *to;                                 ///< [2 * count] the slots
    uint32_t *taker;                           ///< [count] out: who takes each slot
    tl_sort_item *followers, *slots, *scratch; ///< [count] each, of no use afterwards
    uint32_t count;
} tl_slot_deal;

/// Deals the slots out. All coordinates are finite. O(count^3) up to TL_SLOT_DEAL_EXACT, above it O(count).
void tl_slot_deal_out(const tl_slot_deal *deal);
/// The second method, for any count >= 1.
void tl_slot_deal_by_strips(const tl_slot_deal *deal);

#endif
