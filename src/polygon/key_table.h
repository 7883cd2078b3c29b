// SPDX-License-Identifier: MIT
//
// A hash table from 64-bit keys to 32-bit numbers: open addressing, linear probing, at most half full, no removal.

#ifndef TALUS_SRC_POLYGON_KEY_TABLE_H
#define TALUS_SRC_POLYGON_KEY_TABLE_H

#include "base/arena.h"
#include "base/hash.h"

#define TL_NO_VALUE UINT32_MAX

typedef struct tl_key_entry {
    uint64_t key;
    uint32_t value; // TL_NO_VALUE: a free place
} tl_key_entry;

typedef struct tl_key_table {
    tl_key_entry *entries;
    uint64_t mask;
} tl_key_table;

/// Room for `count` keys. False: out of memory.
bool tl_key_table_init(tl_key_table *table, tl_arena *arena, uint64_t count);

/// The place of a key; its value is TL_NO_VALUE when the key is new, and the caller then sets it.
static inline uint32_t *tl_key_table_at(tl_key_table *table, uint64_t key)
{
    uint64_t place = tl_hash_mix(key) & table->mask;
    while (table->entries[place].value != TL_NO_VALUE && table->entries[place].key != key) {
        place = (place + 1) & table->mask;
    }
    table->entries[place].key = key;
    return &table->entries[place].value;
}

/// Two 32-bit numbers as one key.
static inline uint64_t tl_pair_key(uint32_t high, uint32_t low)
{
    return (uint64_t)high << 32 | low;
}

#endif
