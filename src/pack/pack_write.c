// SPDX-License-Identifier: MIT
//
// Writing the baked file: sizes and hashes are known beforehand, so the file is written once, front to back, and the
// callback need not seek. The header holds the hash of itself and of the table, the table that of each chunk, so that
// every byte is covered; the padding between chunks is zero, and its place follows from the table.

#include "base/arena.h"
#include "base/assert.h"
#include "base/byte_order.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "pack/pack_format.h"

#include <string.h>

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

static uint64_t chunk_key(const tl_pack_item *item)
{
    return (uint64_t)item->type << 32 | item->id;
}

static tl_result check_chunk_names(const tl_pack_item *items, uint32_t count, tl_arena *arena, tl_report *report)
{
    tl_sort_item *names = TL_PUSH(arena, tl_sort_item, count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, count);
    if (names == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (items[i].type == 0 || items[i].size > SIZE_MAX) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "chunk", i, "a type has four characters");
        }
        tl_sort_item name = { chunk_key(&items[i]), i, 0 };
        names[i] = name;
    }
    tl_radix_sort(names, scratch, count);
    for (uint32_t i = 1; i < count; i++) {
        if (names[i].key == names[i - 1].key) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "chunk", names[i].value, "type and id occur twice");
        }
    }
    return TL_OK;
}

static tl_result write_padding(uint64_t written, tl_write_fn *write, void *user)
{
    static const uint8_t ZEROS[TL_PACK_ALIGNMENT] = { 0 };
    uint64_t padding = tl_pack_align(written) - written;
    return padding > 0 ? write(ZEROS, (size_t)padding, user) : TL_OK;
}

// The chunk's bytes as the file has them: the caller's own, but on machines of the other byte order a copy in `room`.
static const void *file_bytes(const tl_pack_item *item, void *room)
{
    if (!TL_BIG_ENDIAN || item->size == 0) {
        return item->bytes;
    }
    memcpy(room, item->bytes, (size_t)item->size);
    return tl_pack_swap_chunk(room, item->size, item->type, false) ? room : NULL;
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

// The file, front to back.
static tl_result write_parts(const tl_pack_item *items, uint32_t count, const tl_pack_header *header,
                             const tl_pack_entry *table, void *room, tl_write_fn *write, void *user)
{
    const uint64_t table_size = (uint64_t)count * sizeof *table;
    uint64_t written = sizeof *header + table_size;
    TL_TRY(write(header, sizeof *header, user));
    if (count > 0) {
        TL_TRY(write(table, (size_t)table_size, user));
    }
    TL_TRY(write_padding(written, write, user));
    for (uint32_t i = 0; i < count; i++) {
        written = tl_pack_align(written) + items[i].size;
        if (items[i].size > 0) {
            TL_TRY(write(file_bytes(&items[i], room), (size_t)items[i].size, user));
        }
        TL_TRY(write_padding(written, write, user));
    }
    return TL_OK;
}

static tl_result write_pack(const tl_pack_item *items, uint32_t count, tl_arena *arena, tl_write_fn *write, void *user,
                            tl_report *report)
{
    TL_TRY(check_chunk_names(items, count, arena, report));
    uint64_t table_size = (uint64_t)count * sizeof(tl_pack_entry);
    tl_pack_entry *table = tl_arena_push_zero(arena, count, sizeof *table);
    if (table == NULL) {
        return TL_ERR_MEMORY;
    }
    void *room;
    TL_TRY(make_scratch(items, count, arena, &room));
    uint64_t offset = table_end(count);
    for (uint32_t i = 0; i < count; i++) {
        const void *bytes = file_bytes(&items[i], room);
        if (bytes == NULL && items[i].size > 0) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", i, "its counts do not fit its size");
        }
        tl_pack_entry entry = { items[i].type, items[i].id, offset, items[i].size,
                                tl_hash_bytes(bytes, (size_t)items[i].size, 0) };
        table[i] = entry;
        offset = tl_pack_align(offset + items[i].size);
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
    header.table_hash = tl_hash_bytes(table, (size_t)table_size, 0);
    tl_pack_seal_header(&header, TL_BIG_ENDIAN);
    return write_parts(items, count, &header, table, room, write, user);
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
    tl_result result = write_pack(items, count, &arena, write, user, report_out);
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes;
    }
    tl_arena_free(&arena);
    return result;
}
