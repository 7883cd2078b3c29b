// SPDX-License-Identifier: MIT
//
// The state as bytes: how large it is, where its fields stand, its byte order.

#include "base/byte_order.h"
#include "nav_crowd/crowd.h"

#include <string.h>

// Fields begin at multiples of 64, a cache line.
static uint64_t field_end(uint64_t at, uint64_t count, uint64_t size)
{
    return at + (count * size + 63) / 64 * 64;
}

uint64_t tl_crowd_state_bytes(uint32_t max_agents, uint32_t max_path)
{
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define ADD(type, name, per) at = field_end(at, (uint64_t)max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(ADD)
#undef ADD
    return at <= SIZE_MAX / 2 ? at : 0;
}

crowd_fields tl_crowd_fields_at(void *state, uint32_t max_agents, uint32_t max_path)
{
    crowd_fields fields;
    uint8_t *bytes = (uint8_t *)state;
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define PLACE(type, name, per)                                                                                         \
    fields.name = (type *)(void *)(bytes + at);                                                                        \
    at = field_end(at, (uint64_t)max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(PLACE)
#undef PLACE
    return fields;
}

void tl_crowd_swap_words(void *state, uint64_t bytes, uint32_t max_agents, uint32_t max_path)
{
    tl_byte_swap swap = { (uint8_t *)state, bytes, false, true };
    tl_swap_words(&swap, 0, 2, 4);
    tl_swap_words(&swap, 8, 4, 8);
    tl_swap_words(&swap, 40, 8, 4);
    for (uint32_t k = 0; k < CROWD_MAX_SHARED; k++) {
        const uint64_t goal = offsetof(crowd_head, shared) + k * sizeof(crowd_shared_goal);
        tl_swap_words(&swap, goal, 1, 8);
        tl_swap_words(&swap, goal + 8, 6, 4);
    }
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define SWAP(type, name, per)                                                                                          \
    tl_swap_words(&swap, at, (uint64_t)max_agents *(uint64_t)(per), (uint32_t)sizeof(type));                           \
    at = field_end(at, (uint64_t)max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(SWAP)
#undef SWAP
}
