// SPDX-License-Identifier: MIT
//
// The index of a container, opened without its chunks; and a single chunk, opened without its container.

#include "base/assert.h"
#include "base/byte_order.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/range_fits.h"
#include "pack/pack_format.h"

#include <string.h>

_Static_assert(TL_PACK_HEAD_SIZE == sizeof(tl_pack_header), "the head is the header");

// The header in the machine's order, from the file's. One that was altered keeps a hash that does not match.
static tl_pack_header header_of(const void *head)
{
    tl_pack_header header;
    memcpy(&header, head, sizeof header);
    if (TL_BIG_ENDIAN) {
        const uint64_t hash = tl_hash_bytes(head, offsetof(tl_pack_header, header_hash), 0);
        tl_pack_swap_header(&header);
        if (header.header_hash == hash) {
            tl_pack_seal_header(&header, false);
        }
    }
    return header;
}

tl_result tl_pack_index_size(const void *head, uint64_t *size_out, tl_report *report_out)
{
    tl_report_begin(report_out, "open index");
    TL_REFUSE_NULL(size_out, report_out);
    *size_out = 0;
    if (head == NULL || (uintptr_t)head % 8 != 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "head", "give bytes aligned to 8");
    }
    const tl_pack_header header = header_of(head);
    const uint64_t claimed = header.size > sizeof header ? header.size : sizeof header;
    TL_TRY(tl_pack_check_header(&header, claimed, report_out));
    if (!tl_range_fits(sizeof header, header.chunk_count, sizeof(tl_pack_entry), header.size)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "table", TL_NO_ELEMENT, "copy or bake the file again");
    }
    *size_out = sizeof header + (uint64_t)header.chunk_count * sizeof(tl_pack_entry);
    return TL_OK;
}

// Chunks stand one behind the other, without gaps but for the padding.
static tl_result check_entries(const tl_pack_entry *entries, uint32_t count, uint64_t file_size, tl_report *report)
{
    uint64_t end = sizeof(tl_pack_header) + (uint64_t)count * sizeof *entries;
    for (uint32_t i = 0; i <= count; i++) {
        const uint64_t next = i < count ? entries[i].offset : file_size;
        if (next != tl_pack_align(end) || next > file_size) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "table", i,
                                  "an offset is wrong: copy or bake the file again");
        }
        if (i < count) {
            if (entries[i].type == 0 || entries[i].size > file_size - next) {
                return tl_report_fail(report, TL_ERR_CORRUPT, "table", i, "a chunk has no type or no room");
            }
            end = next + entries[i].size;
        }
    }
    return TL_OK;
}

tl_result tl_pack_index_open(void *bytes, uint64_t size, tl_pack_index *index_out, tl_report *report_out)
{
    tl_report_begin(report_out, "open index");
    TL_REFUSE_NULL(index_out, report_out);
    memset(index_out, 0, sizeof *index_out);
    if (bytes == NULL || (uintptr_t)bytes % 8 != 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "bytes", "give bytes aligned to 8");
    }
    if (size < sizeof(tl_pack_header)) {
        return tl_report_fail(report_out, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT, "copy or bake the file again");
    }
    uint64_t needed = 0;
    TL_TRY(tl_pack_index_size(bytes, &needed, report_out));
    if (size < needed) {
        return tl_report_fail(report_out, TL_ERR_TRUNCATED, "table", TL_NO_ELEMENT,
                              "give as many bytes as tl_pack_index_size says");
    }
    const tl_pack_header header = header_of(bytes);
    tl_pack_entry *entries = (tl_pack_entry *)((char *)bytes + sizeof header);
    if (header.table_hash != tl_hash_bytes(entries, (size_t)header.chunk_count * sizeof *entries, 0)) {
        return tl_report_fail(report_out, TL_ERR_HASH, "table", TL_NO_ELEMENT, "copy or bake the file again");
    }
    if (TL_BIG_ENDIAN) {
        tl_pack_swap_table(entries, header.chunk_count);
    }
    TL_TRY(check_entries(entries, header.chunk_count, header.size, report_out));
    index_out->entries = entries;
    index_out->count = header.chunk_count;
    index_out->file_size = header.size;
    return TL_OK;
}

tl_result tl_pack_entry_open(const tl_pack_entry *entry, void *bytes, tl_report *report_out)
{
    tl_report_begin(report_out, "open chunk");
    TL_REFUSE_NULL(entry, report_out);
    if (bytes == NULL || (uintptr_t)bytes % 8 != 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "bytes", "give bytes aligned to 8");
    }
    if (entry->hash != tl_hash_bytes(bytes, (size_t)entry->size, 0)) {
        return tl_report_fail(report_out, TL_ERR_HASH, "chunk", TL_NO_ELEMENT, "copy or bake the file again");
    }
    if (TL_BIG_ENDIAN && !tl_pack_swap_chunk(bytes, entry->size, entry->type, true)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "chunk", TL_NO_ELEMENT, "bake the file again");
    }
    return TL_OK;
}
