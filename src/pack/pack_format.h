// SPDX-License-Identifier: MIT
//
// The layout of the baked file: header, table, chunks (docs/guide/file-format.md).

#ifndef TALUS_SRC_PACK_FORMAT_H
#define TALUS_SRC_PACK_FORMAT_H

#include <talus/pack.h>

/// "TALUS", then bytes that text transfers and 7-bit channels would damage.
#define TL_PACK_MAGIC     "TALUS\r\n\xb5"
#define TL_PACK_ALIGNMENT 64

/// At offset 0.
typedef struct tl_pack_header {
    uint8_t magic[8];
    uint32_t version;
    uint32_t chunk_count;
    uint64_t size;       ///< of the whole file
    uint64_t table_hash; ///< XXH64 of the table
    uint64_t reserved[3];
    uint64_t header_hash; ///< XXH64 of the 56 bytes before
} tl_pack_header;

// Entries, tl_pack_entry, follow the header; then zeros up to a multiple of 64.
_Static_assert(sizeof(tl_pack_header) == 64 && sizeof(tl_pack_entry) == 32, "no hidden padding");

/// Whether the header of a file of `size` bytes, in the machine's byte order, is sound (pack_open.c).
tl_result tl_pack_check_header(const void *bytes, uint64_t size, tl_report *report);

/// tl_blob_check_head for a chunk, behind whose blob no more bytes may follow (TL_ERR_CORRUPT).
tl_result tl_pack_check_head(const void *bytes, uint64_t size, tl_blob expected, tl_report *report);

// pack_byte_order.c. `to_host`: the bytes have the order that this machine has not, and get its own; false: the other
// way. They do so on every machine, for tests; callers ask TL_BIG_ENDIAN. After a failure the bytes are of no use.
/// Any blob of the library. TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_CORRUPT (its counts do not fit its size).
tl_result tl_blob_swap(void *bytes, uint64_t size, bool to_host, tl_report *report);
/// A whole container, with its chunks and its hashes, which are verified first.
tl_result tl_pack_swap(void *bytes, uint64_t size, bool to_host, tl_report *report);
/// A chunk, where it holds a blob of its type; else nothing is done. False: its counts do not fit its size.
bool tl_pack_swap_chunk(void *bytes, uint64_t size, uint32_t type, bool to_host);
void tl_pack_swap_header(tl_pack_header *header);
void tl_pack_swap_table(tl_pack_entry *table, uint32_t count);
/// Hashes a header whose other fields are there; `foreign`: it is turned round.
void tl_pack_seal_header(tl_pack_header *header, bool foreign);

static inline uint64_t tl_pack_align(uint64_t offset)
{
    return (offset + TL_PACK_ALIGNMENT - 1) & ~(uint64_t)(TL_PACK_ALIGNMENT - 1);
}

#endif
