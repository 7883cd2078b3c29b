// SPDX-License-Identifier: MIT
//
// The key table's memory: the power of two that keeps it at most half full, so probes stay short.

#include "polygon/outline/key_table.h"

#include <string.h>

bool tl_key_table_init(tl_key_table *table, tl_arena *arena, uint64_t count)
{
    uint64_t size = 16;
    while (size < 2 * count) {
        size *= 2;
    }
    table->entries = TL_PUSH(arena, tl_key_entry, size);
    table->mask = size - 1;
    if (table->entries == NULL) {
        return false;
    }
    memset(table->entries, 0xff, (size_t)size * sizeof *table->entries);
    return true;
}
