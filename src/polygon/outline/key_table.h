// SPDX-License-Identifier: MIT
//
// A hash table from 64-bit keys to 32-bit numbers: open addressing, linear probing, at most half full, no removal.

#ifndef TALUS_SRC_POLYGON_KEY_TABLE_H
#define TALUS_SRC_POLYGON_KEY_TABLE_H

#include "base/arena.h"
#include "base/compiler.h"
#include "base/hash.h"

#define TL_NO_VALUE UINT32_MAX

/// So many keys ahead a place is fetched in a large table.
enum { TL_KEYS_AHEAD = 16 };

// The key in halves, so that an entry takes 12 bytes instead of 16.
typedef struct tl_key_entry {
    uint32_t high, low;
    uint32_t value; // TL_NO_VALUE: a free place
} tl_key_entry;

typedef struct tl_key_table {
    tl_key_entry *entries;
    uint64_t mask;
} tl_key_table;

/// Room for `count` keys. False: out of memory.
bool tl_key_table_init(tl_key_table *table, tl_arena *arena, uint64_t count);

/// Two 32-bit numbers as one key.
static inline uint64_t tl_pair_key(uint32_t high, uint32_t low)
{
    return (uint64_t)high << 32 | low;
}

/// The same for two numbers in either order: the lower one comes first.
static inline uint64_t tl_unordered_key(uint32_t a, uint32_t b)
{
    return a < b ? tl_pair_key(a, b) : tl_pair_key(b, a);
}

/// A key that is looked for soon.
static TL_ALWAYS_INLINE void tl_key_table_fetch(const tl_key_table *table, uint64_t key)
{
    tl_prefetch(&table->entries[tl_hash_mix(key) & table->mask]);
}

/// The place of a key; its value is TL_NO_VALUE when the key is new, and the caller then sets it.
static inline uint32_t *tl_key_table_at(tl_key_table *table, uint64_t key)
{
    const uint32_t high = (uint32_t)(key >> 32), low = (uint32_t)key;
    uint64_t place = tl_hash_mix(key) & table->mask;
    tl_key_entry *entry = &table->entries[place];
    while (entry->value != TL_NO_VALUE && (entry->low != low || entry->high != high)) {
        place = (place + 1) & table->mask;
        entry = &table->entries[place];
    }
    entry->high = high;
    entry->low = low;
    return &entry->value;
}

#endif
