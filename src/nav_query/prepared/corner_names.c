// SPDX-License-Identifier: MIT
//
// Names of corner vertices: linear probing, and no tombstones, so that a table lives through any number of edits.
// Source: Knuth, The Art of Computer Programming, volume 3, 6.4, algorithm R (how an entry is taken out).

#include "nav_query/prepared/corner_names.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"

#include <string.h>

enum { LEAST_NAMES = 64 };

static uint32_t name_home(const tl_nav_corner_names *names, uint32_t turn)
{
    return (uint32_t)tl_hash_mix(turn) & (names->capacity - 1);
}

// Where a name stands, or the free entry where it would.
static uint32_t entry_of(const tl_nav_corner_names *names, uint32_t turn)
{
    uint32_t at = name_home(names, turn);
    while (names->entries[at] != 0 && (uint32_t)(names->entries[at] >> 32) != turn) {
        at = (at + 1) & (names->capacity - 1);
    }
    return at;
}

uint32_t tl_nav_find_name(const tl_nav_corner_names *names, uint32_t turn)
{
    const uint64_t entry = names->count > 0 ? names->entries[entry_of(names, turn)] : 0;
    return entry != 0 ? (uint32_t)entry : UINT32_MAX;
}

static tl_result grow_names(const tl_allocator *allocator, tl_nav_corner_names *names)
{
    tl_nav_corner_names grown = { NULL, names->capacity > 0 ? 2 * names->capacity : LEAST_NAMES, names->count };
    grown.entries = tl_allocate_array(allocator, grown.capacity, sizeof *grown.entries);
    if (grown.entries == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(grown.entries, 0, grown.capacity * sizeof *grown.entries);
    for (uint32_t i = 0; i < names->capacity; i++) {
        if (names->entries[i] != 0) {
            grown.entries[entry_of(&grown, (uint32_t)(names->entries[i] >> 32))] = names->entries[i];
        }
    }
    tl_nav_free_names(allocator, names);
    *names = grown;
    return TL_OK;
}

tl_result tl_nav_set_name(const tl_allocator *allocator, tl_nav_corner_names *names, uint32_t turn, uint32_t vertex)
{
    TL_ASSERT(turn != 0);
    if (2 * (uint64_t)names->count >= names->capacity) {
        TL_TRY(grow_names(allocator, names));
    }
    const uint32_t at = entry_of(names, turn);
    names->count += names->entries[at] == 0 ? 1 : 0;
    names->entries[at] = (uint64_t)turn << 32 | vertex;
    return TL_OK;
}

void tl_nav_drop_name(tl_nav_corner_names *names, uint32_t turn)
{
    const uint32_t mask = names->capacity - 1;
    uint32_t hole = entry_of(names, turn);
    TL_ASSERT(names->entries[hole] != 0);
    // What stands behind, and would be sought from the hole on or before it, moves up.
    for (uint32_t at = (hole + 1) & mask; names->entries[at] != 0; at = (at + 1) & mask) {
        const uint32_t home = name_home(names, (uint32_t)(names->entries[at] >> 32));
        if (((at - home) & mask) >= ((at - hole) & mask)) {
            names->entries[hole] = names->entries[at];
            hole = at;
        }
    }
    names->entries[hole] = 0;
    names->count--;
}

void tl_nav_free_names(const tl_allocator *allocator, tl_nav_corner_names *names)
{
    tl_release_array(allocator, names->entries, names->capacity, sizeof *names->entries);
    memset(names, 0, sizeof *names);
}
