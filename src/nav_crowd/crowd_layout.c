// SPDX-License-Identifier: MIT
//
// The state as bytes: how large it is, where its fields stand, its byte order.

#include "base/assert.h"
#include "base/byte_order.h"
#include "nav_crowd/crowd.h"

#include <string.h>

// Fields begin at multiples of 64, a cache line.
static uint64_t field_end(uint64_t at, uint64_t count, uint64_t size)
{
    return at + (count * size + 63) / 64 * 64;
}

uint64_t tl_crowd_state_bytes(const tl_nav_crowd_def *def)
{
    const uint32_t max_path = def->max_path;
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define ADD(type, name, per) at = field_end(at, (uint64_t)def->max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(ADD)
#undef ADD
#define ADD(type, name, per) at = field_end(at, (uint64_t)def->max_members * (uint64_t)(per), sizeof(type));
    CROWD_MEMBER_FIELDS(ADD)
#undef ADD
    at = field_end(at, def->max_groups, sizeof(crowd_group));
    return at <= SIZE_MAX / 2 ? at : 0;
}

crowd_fields tl_crowd_fields_at(void *state, const tl_nav_crowd_def *def)
{
    const uint32_t max_path = def->max_path;
    crowd_fields fields;
    uint8_t *bytes = (uint8_t *)state;
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define PLACE(type, name, per)                                                                                         \
    fields.name = (type *)(void *)(bytes + at);                                                                        \
    at = field_end(at, (uint64_t)def->max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(PLACE)
#undef PLACE
#define PLACE(type, name, per)                                                                                         \
    fields.name = (type *)(void *)(bytes + at);                                                                        \
    at = field_end(at, (uint64_t)def->max_members * (uint64_t)(per), sizeof(type));
    CROWD_MEMBER_FIELDS(PLACE)
#undef PLACE
    fields.groups = (crowd_group *)(void *)(bytes + at);
    return fields;
}

void tl_crowd_swap_words(void *state, uint64_t bytes, const tl_nav_crowd_def *def)
{
    static const tl_word_run head[] = { { 4, 2 }, { 8, 4 }, { 4, 12 } };
    static const tl_word_run shared_goal[] = { { 8, 1 }, { 4, 6 } };
    static const tl_word_run group[] = { { 8, 1 }, { 4, 20 } };
    const uint32_t max_path = def->max_path;
    tl_byte_swap swap = { (uint8_t *)state, bytes, false, true };
    tl_swap_elements(&swap, 0, 1, head, TL_COUNT_OF(head));
    tl_swap_elements(&swap, offsetof(crowd_head, shared), CROWD_MAX_SHARED, shared_goal, TL_COUNT_OF(shared_goal));
    uint64_t at = field_end(0, 1, sizeof(crowd_head));
#define SWAP(type, name, per)                                                                                          \
    tl_swap_words(&swap, at, (uint64_t)def->max_agents *(uint64_t)(per), (uint32_t)sizeof(type));                      \
    at = field_end(at, (uint64_t)def->max_agents * (uint64_t)(per), sizeof(type));
    CROWD_FIELDS(SWAP)
#undef SWAP
#define SWAP(type, name, per)                                                                                          \
    tl_swap_words(&swap, at, (uint64_t)def->max_members *(uint64_t)(per), (uint32_t)sizeof(type));                     \
    at = field_end(at, (uint64_t)def->max_members * (uint64_t)(per), sizeof(type));
    CROWD_MEMBER_FIELDS(SWAP)
#undef SWAP
    tl_swap_elements(&swap, at, def->max_groups, group, TL_COUNT_OF(group));
}
