// SPDX-License-Identifier: MIT
//
// Writing the baked file: sizes and hashes are known beforehand, so the file is written once, front to back, and the
// callback need not seek. The header holds the hash of itself and of the table, the table that of each chunk, so that
// every byte is covered; the padding between chunks is zero, and its place follows from the table.
//
// There is one writer, which fetches chunk after chunk. For chunks that lie in memory their place is what it fetches;
// on machines of the other byte order a copy that was turned round.

#include "base/arena.h"
#include "base/assert.h"
#include "base/byte_order.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "pack/pack_format.h"

#include <string.h>

typedef struct pack_writer {
    const tl_pack_entry *entries; // without offsets
    uint32_t count;
    tl_pack_fetch_fn *fetch;
    void *fetch_user;
    bool is_trusted; // what is fetched has the hash that its entry says
    tl_write_fn *write;
    void *write_user;
    tl_report *report;
} pack_writer;

static uint64_t table_end(uint32_t count)
{
    return tl_pack_align(sizeof(tl_pack_header) + (uint64_t)count * sizeof(tl_pack_entry));
}

uint64_t tl_pack_size(const tl_pack_item *items, uint32_t count)
{
    uint64_t size = table_end(count);
    for (uint32_t i = 0; i < count; i++) {
        size = tl_pack_align(size + items[i].size);
    }
    return size;
}

static tl_result check_chunk_names(const pack_writer *writer, tl_arena *arena)
{
    tl_sort_item *names = TL_PUSH(arena, tl_sort_item, writer->count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, writer->count);
    if (names == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < writer->count; i++) {
        const tl_pack_entry *entry = &writer->entries[i];
        if (entry->type == 0 || entry->size > SIZE_MAX) {
            return tl_report_fail(writer->report, TL_ERR_ARGUMENT, "chunk", i, "a type has four characters");
        }
        tl_sort_item name = { (uint64_t)entry->type << 32 | entry->id, i, 0 };
        names[i] = name;
    }
    tl_radix_sort(names, scratch, writer->count);
    for (uint32_t i = 1; i < writer->count; i++) {
        if (names[i].key == names[i - 1].key) {
            return tl_report_fail(writer->report, TL_ERR_ARGUMENT, "chunk", names[i].value, "type and id occur twice");
        }
    }
    return TL_OK;
}

static tl_result write_padding(const pack_writer *writer, uint64_t written)
{
    static const uint8_t ZEROS[TL_PACK_ALIGNMENT] = { 0 };
    uint64_t padding = tl_pack_align(written) - written;
    return padding > 0 ? writer->write(ZEROS, (size_t)padding, writer->write_user) : TL_OK;
}

static tl_result write_chunk(const pack_writer *writer, uint32_t index)
{
    const tl_pack_entry *entry = &writer->entries[index];
    const void *bytes = NULL;
    TL_TRY(writer->fetch(index, &bytes, writer->fetch_user));
    if (bytes == NULL && entry->size > 0) {
        return tl_report_fail(writer->report, TL_ERR_ARGUMENT, "chunk", index, "fetch may not give NULL");
    }
    if (!writer->is_trusted && tl_hash_bytes(bytes, (size_t)entry->size, 0) != entry->hash) {
        return tl_report_fail(writer->report, TL_ERR_HASH, "chunk", index, "its bytes are others than its entry says");
    }
    return entry->size > 0 ? writer->write(bytes, (size_t)entry->size, writer->write_user) : TL_OK;
}

// The file, front to back; `table` as it stands in it.
static tl_result write_parts(const pack_writer *writer, const tl_pack_header *header, const tl_pack_entry *table)
{
    const uint64_t table_size = (uint64_t)writer->count * sizeof *table;
    uint64_t written = sizeof *header + table_size;
    TL_TRY(writer->write(header, sizeof *header, writer->write_user));
    if (writer->count > 0) {
        TL_TRY(writer->write(table, (size_t)table_size, writer->write_user));
    }
    TL_TRY(write_padding(writer, written));
    for (uint32_t i = 0; i < writer->count; i++) {
        written = tl_pack_align(written) + writer->entries[i].size;
        TL_TRY(write_chunk(writer, i));
        TL_TRY(write_padding(writer, written));
    }
    return TL_OK;
}

static tl_result write_pack(const pack_writer *writer, tl_arena *arena)
{
    const uint32_t count = writer->count;
    TL_TRY(check_chunk_names(writer, arena));
    tl_pack_entry *table = tl_arena_push_zero(arena, count, sizeof *table);
    if (table == NULL) {
        return TL_ERR_MEMORY;
    }
    uint64_t offset = table_end(count);
    for (uint32_t i = 0; i < count; i++) {
        table[i] = writer->entries[i];
        table[i].offset = offset;
        offset = tl_pack_align(offset + table[i].size);
    }
    if (TL_BIG_ENDIAN) {
        tl_pack_swap_table(table, count);
    }
    tl_pack_header header;
    memset(&header, 0, sizeof header);
    memcpy(header.magic, TL_PACK_MAGIC, sizeof header.magic);
    header.version = TL_PACK_VERSION;
    header.chunk_count = count;
    header.size = offset;
    header.table_hash = tl_hash_bytes(table, (size_t)count * sizeof *table, 0);
    tl_pack_seal_header(&header, TL_BIG_ENDIAN);
    return write_parts(writer, &header, table);
}

// ---- Chunks that lie in memory -----------------------------------------------------------------------------

typedef struct items_in_memory {
    const tl_pack_item *items;
    void *room; // on machines of the other byte order: for the largest
} items_in_memory;

// The chunk's bytes as the file has them: the caller's own, or the copy.
static tl_result fetch_item(uint32_t index, const void **bytes_out, void *user)
{
    const items_in_memory *from = user;
    const tl_pack_item *item = &from->items[index];
    *bytes_out = item->bytes;
    if (!TL_BIG_ENDIAN || item->size == 0) {
        return TL_OK;
    }
    memcpy(from->room, item->bytes, (size_t)item->size);
    *bytes_out = from->room;
    return tl_pack_swap_chunk(from->room, item->size, item->type, false) ? TL_OK : TL_ERR_CORRUPT;
}

static tl_result make_scratch(const tl_pack_item *items, uint32_t count, tl_arena *arena, void **room_out)
{
    uint64_t largest = 0;
    for (uint32_t i = 0; TL_BIG_ENDIAN && i < count; i++) {
        largest = items[i].size > largest ? items[i].size : largest;
    }
    *room_out = largest > 0 ? TL_PUSH(arena, uint8_t, (size_t)largest) : NULL;
    return largest > 0 && *room_out == NULL ? TL_ERR_MEMORY : TL_OK;
}

static tl_result write_items(const tl_pack_item *items, pack_writer *writer, tl_arena *arena)
{
    items_in_memory from = { items, NULL };
    tl_pack_entry *entries = tl_arena_push_zero(arena, writer->count, sizeof *entries);
    if (entries == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(make_scratch(items, writer->count, arena, &from.room));
    for (uint32_t i = 0; i < writer->count; i++) {
        const void *bytes = NULL;
        if (items[i].size > SIZE_MAX || fetch_item(i, &bytes, &from) != TL_OK) {
            return tl_report_fail(writer->report, items[i].size > SIZE_MAX ? TL_ERR_ARGUMENT : TL_ERR_CORRUPT, "chunk",
                                  i, "its counts do not fit its size");
        }
        tl_pack_entry entry = { items[i].type, items[i].id, 0, items[i].size,
                                tl_hash_bytes(bytes, (size_t)items[i].size, 0) };
        entries[i] = entry;
    }
    writer->entries = entries;
    writer->fetch = fetch_item;
    writer->fetch_user = &from;
    writer->is_trusted = true;
    return write_pack(writer, arena);
}

static void end_writing(tl_arena *arena, tl_report *report_out)
{
    if (report_out != NULL) {
        report_out->peak_bytes = arena->peak_bytes;
    }
    tl_arena_free(arena);
}

tl_result tl_pack_write(const tl_pack_item *items, uint32_t count, const tl_allocator *allocator, tl_write_fn *write,
                        void *user, tl_report *report_out)
{
    tl_report_begin(report_out, "write pack");
    if (write == NULL || (items == NULL && count > 0)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, write == NULL ? "write" : "items", "it may not be NULL");
    }
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    pack_writer writer = { .count = count, .write = write, .write_user = user, .report = report_out };
    const tl_result result = write_items(items, &writer, &arena);
    end_writing(&arena, report_out);
    return result;
}

// ---- Chunks that are fetched -------------------------------------------------------------------------------

tl_result tl_pack_entry_make(uint32_t type, uint32_t id, const void *bytes, uint64_t size, tl_pack_entry *entry_out)
{
    if (entry_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(entry_out, 0, sizeof *entry_out);
    if (type == 0 || size > SIZE_MAX || (bytes == NULL && size > 0)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_pack_entry entry = { type, id, 0, size, tl_hash_bytes(bytes, (size_t)size, 0) };
    *entry_out = entry;
    return TL_OK;
}

tl_result tl_pack_write_fetched(const tl_pack_entry *entries, uint32_t count, const tl_allocator *allocator,
                                tl_pack_fetch_fn *fetch, tl_write_fn *write, void *user, tl_report *report_out)
{
    tl_report_begin(report_out, "write pack");
    if (write == NULL || (count > 0 && (entries == NULL || fetch == NULL))) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT,
                               write == NULL     ? "write"
                               : entries == NULL ? "entries"
                                                 : "fetch",
                               "it may not be NULL");
    }
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    const pack_writer writer = { entries, count, fetch, user, false, write, user, report_out };
    const tl_result result = write_pack(&writer, &arena);
    end_writing(&arena, report_out);
    return result;
}
