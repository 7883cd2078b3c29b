// SPDX-License-Identifier: MIT
//
// Names to ids: open addressing with linear probing over FNV-1a hashes, at most half full.
//
// A level may switch among thousands of materials at each object, so looking through a list would be quadratic.

#include "io/text/name_table.h"

#include "io/files/growable.h"

#include <string.h>

enum { FIRST_NAME_SLOTS = 64 };

// Fowler, Noll, Vo: FNV-1a, 32 bits.
static uint32_t hash_name(const char *name, size_t size)
{
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ (uint32_t)(unsigned char)name[i]) * 16777619u;
    }
    return hash;
}

static bool is_name(const tl_name_table *table, uint32_t id, const char *name, size_t size)
{
    // strncmp, not memcmp: the text may end before `size`, and the name has no zero in it.
    const char *text = table->text + table->offsets[id];
    return strncmp(text, name, size) == 0 && text[size] == '\0';
}

// The slot that holds the name, or the empty one where it belongs. The table must have an empty slot.
static uint32_t find_slot(const tl_name_table *table, const char *name, size_t size)
{
    uint32_t mask = table->slot_count - 1;
    uint32_t slot = hash_name(name, size) & mask;
    while (table->slots[slot] != 0 && !is_name(table, table->slots[slot] - 1, name, size)) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

static bool reserve_slots(tl_name_table *table, const tl_allocator *allocator)
{
    if (table->slot_count / 2 > table->count) {
        return true;
    }
    uint32_t slot_count = table->slot_count > 0 ? table->slot_count * 2 : FIRST_NAME_SLOTS;
    uint32_t *slots = tl_io_allocate(allocator, (size_t)slot_count * sizeof *slots);
    if (slots == NULL) {
        return false;
    }
    memset(slots, 0, (size_t)slot_count * sizeof *slots);
    tl_io_release(allocator, table->slots, (size_t)table->slot_count * sizeof *slots);
    table->slots = slots;
    table->slot_count = slot_count;
    for (uint32_t id = 0; id < table->count; id++) {
        const char *name = tl_name_table_get(table, id);
        slots[find_slot(table, name, strlen(name))] = id + 1;
    }
    return true;
}

tl_result tl_name_table_add(tl_name_table *table, const tl_allocator *allocator, const char *name, size_t size,
                            uint32_t max_count, uint32_t *id_out)
{
    if (size == 0) {
        name = "";
    }
    const char *zero = memchr(name, '\0', size);
    if (zero != NULL) {
        size = (size_t)(zero - name);
    }
    if (!reserve_slots(table, allocator)) {
        return TL_ERR_MEMORY;
    }
    uint32_t slot = find_slot(table, name, size);
    if (table->slots[slot] != 0) {
        *id_out = table->slots[slot] - 1;
        return TL_OK;
    }
    if (table->count >= max_count) {
        return TL_ERR_LIMIT;
    }
    uint64_t text_capacity = table->text_capacity;
    uint64_t capacity = table->capacity;
    bool enough = tl_io_grow(allocator, (void **)&table->text, &text_capacity, table->text_size,
                             table->text_size + size + 1, sizeof *table->text);
    table->text_capacity = (size_t)text_capacity;
    enough = enough && tl_io_grow(allocator, (void **)&table->offsets, &capacity, table->count,
                                  (uint64_t)table->count + 1, sizeof *table->offsets);
    table->capacity = (uint32_t)capacity;
    if (!enough) {
        return TL_ERR_MEMORY;
    }
    memcpy(table->text + table->text_size, name, size);
    table->text[table->text_size + size] = '\0';
    table->offsets[table->count] = table->text_size;
    table->text_size += size + 1;
    *id_out = table->count++;
    table->slots[slot] = table->count;
    return TL_OK;
}

const char *tl_name_table_get(const tl_name_table *table, uint32_t id)
{
    return table->text + table->offsets[id];
}

void tl_name_table_free(tl_name_table *table, const tl_allocator *allocator)
{
    tl_io_release(allocator, table->text, table->text_capacity * sizeof *table->text);
    tl_io_release(allocator, table->offsets, (size_t)table->capacity * sizeof *table->offsets);
    tl_io_release(allocator, table->slots, (size_t)table->slot_count * sizeof *table->slots);
    memset(table, 0, sizeof *table);
}
