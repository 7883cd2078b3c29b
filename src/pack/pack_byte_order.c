// SPDX-License-Identifier: MIT
//
// Blobs and containers between the order of files, little-endian, and that of a machine of the other order. A container
// is turned round as a whole: its header, its table, the chunks that hold blobs; and its hashes, which are of the bytes
// as they stand, are computed again.

#include "base/byte_order.h"

#include "base/assert.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/range_fits.h"
#include "pack/pack_format.h"

#include <talus/hull.h>
#include <talus/nav_sight.h>
#include <talus/soup.h>

#include <string.h>

static void swap_meta(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 3 }, { 4, 8 } }; // the name behind it is bytes
    tl_pack_meta head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
}

// A head, and words of four bytes up to the end.
static void swap_settings(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 1 } };
    tl_blob head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
    tl_swap_words(swap, sizeof head, (swap->size - sizeof head) / 4, 4);
}

static void swap_frame(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 4 }, { 4, 6 } };
    tl_pack_frame head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
}

// Rules and, behind them, the seeds.
static void swap_pruning(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 2 }, { 4, 10 } };
    tl_pack_pruning head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
    tl_swap_words(swap, sizeof head, 3 * (uint64_t)head.seed_count, 4);
}

static void swap_offmesh(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 1 }, { 4, 12 } };
    static const tl_word_run LINK[] = { { 4, 12 }, { 8, 2 } };
    tl_pack_offmesh head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
    tl_swap_elements(swap, sizeof head, head.count, LINK, TL_COUNT_OF(LINK));
}

static void swap_areas(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, 2 }, { 8, 1 }, { 4, 12 } }; // bytes behind it
    tl_pack_areas head;
    tl_swap_head(swap, HEAD, TL_COUNT_OF(HEAD), &head, sizeof head);
}

typedef struct blob_kind {
    uint32_t magic;
    uint32_t chunk_type; // 0: none of the file's own
    tl_blob_swap_fn *swap;
} blob_kind;

static const blob_kind KINDS[] = {
    { TL_SOUP_MAGIC, TL_PACK_SOUP, tl_soup_swap_words },
    { TL_HULL_MAGIC, TL_PACK_HULL, tl_hull_swap_words },
    { TL_NAV_TILE_MAGIC, TL_PACK_NAVT, tl_nav_tile_swap_words },
    { TL_NAV_LINKS_MAGIC, TL_PACK_LINK, tl_nav_links_swap_words },
    { TL_NAV_PVS_MAGIC, 0, tl_nav_pvs_swap_words },
    { TL_PACK_META_MAGIC, TL_PACK_META, swap_meta },
    { TL_PACK_NAVMESH_MAGIC, TL_PACK_NAVM, swap_settings },
    { TL_PACK_FRAME_MAGIC, TL_PACK_FRAM, swap_frame },
    { TL_PACK_VOLUMES_MAGIC, TL_PACK_MARK, swap_settings },
    { TL_PACK_PRUNING_MAGIC, TL_PACK_PRUN, swap_pruning },
    { TL_PACK_OFFMESH_MAGIC, TL_PACK_OFFM, swap_offmesh },
    { TL_PACK_AREAS_MAGIC, TL_PACK_AREA, swap_areas },
    { TL_PACK_ROUTES_MAGIC, TL_PACK_ROUT, swap_settings },
};

static const blob_kind *find_kind(const void *bytes, uint64_t size, bool foreign)
{
    uint32_t magic;
    if (size < sizeof(tl_blob)) {
        return NULL;
    }
    memcpy(&magic, bytes, sizeof magic);
    if (foreign) {
        magic = magic >> 24 | (magic >> 8 & 0xff00u) | (magic & 0xff00u) << 8 | magic << 24;
    }
    for (size_t i = 0; i < TL_COUNT_OF(KINDS); i++) {
        if (KINDS[i].magic == magic) {
            return &KINDS[i];
        }
    }
    return NULL;
}

static bool swap_kind(const blob_kind *kind, void *bytes, uint64_t size, bool to_host)
{
    tl_byte_swap swap = { bytes, size, to_host, true };
    kind->swap(&swap);
    return swap.fits;
}

tl_result tl_blob_swap(void *bytes, uint64_t size, bool to_host, tl_report *report)
{
    if (size < sizeof(tl_blob)) {
        return tl_report_fail(report, TL_ERR_TRUNCATED, "head", TL_NO_ELEMENT, "copy or bake the file again");
    }
    const blob_kind *kind = find_kind(bytes, size, to_host);
    if (kind == NULL) {
        return tl_report_fail(report, TL_ERR_MAGIC, "head", TL_NO_ELEMENT, "it is no blob, or already in that order");
    }
    return swap_kind(kind, bytes, size, to_host)
               ? TL_OK
               : tl_report_fail(report, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, "its counts do not fit its size");
}

bool tl_pack_swap_chunk(void *bytes, uint64_t size, uint32_t type, bool to_host)
{
    const blob_kind *kind = find_kind(bytes, size, to_host);
    const uint32_t blob_type = type == TL_PACK_PRUT ? TL_PACK_NAVT : type; // both hold tiles
    return kind == NULL || kind->chunk_type != blob_type || swap_kind(kind, bytes, size, to_host);
}

// ---------------------------------------------------------------------------------------------------------
// Containers.

void tl_pack_swap_header(tl_pack_header *header)
{
    static const tl_word_run RUNS[] = { { 1, 8 }, { 4, 2 }, { 8, 6 } };
    tl_byte_swap swap = { (uint8_t *)header, sizeof *header, true, true };
    tl_swap_elements(&swap, 0, 1, RUNS, TL_COUNT_OF(RUNS));
}

void tl_pack_swap_table(tl_pack_entry *table, uint32_t count)
{
    static const tl_word_run RUNS[] = { { 4, 2 }, { 8, 3 } };
    tl_byte_swap swap = { (uint8_t *)table, (uint64_t)count * sizeof *table, true, true };
    tl_swap_elements(&swap, 0, count, RUNS, TL_COUNT_OF(RUNS));
}

static tl_result damaged(tl_report *report, tl_result result, const char *element, uint64_t index)
{
    return tl_report_fail(report, result, element, index, "copy or bake the file again");
}

static tl_result swap_chunk_at(uint8_t *bytes, uint64_t size, tl_pack_entry *entry, uint32_t index, bool to_host,
                               tl_report *report)
{
    if (entry->offset > size || entry->size > size - entry->offset) {
        return damaged(report, TL_ERR_CORRUPT, "table", index);
    }
    uint8_t *chunk = bytes + entry->offset;
    if (entry->hash != tl_hash_bytes(chunk, (size_t)entry->size, 0)) {
        return damaged(report, TL_ERR_HASH, "chunk", index);
    }
    if (!tl_pack_swap_chunk(chunk, entry->size, entry->type, to_host)) {
        return damaged(report, TL_ERR_CORRUPT, "chunk", index);
    }
    entry->hash = tl_hash_bytes(chunk, (size_t)entry->size, 0);
    return TL_OK;
}

// Hashes are verified before anything is turned round: afterwards they would be those of whatever was there.
tl_result tl_pack_swap(void *bytes, uint64_t size, bool to_host, tl_report *report)
{
    tl_pack_header head;
    if (size < sizeof head) {
        return damaged(report, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT);
    }
    memcpy(&head, bytes, sizeof head);
    const uint64_t header_hash = tl_hash_bytes(bytes, offsetof(tl_pack_header, header_hash), 0);
    if (to_host) {
        tl_pack_swap_header(&head);
    }
    if (memcmp(head.magic, TL_PACK_MAGIC, sizeof head.magic) != 0) {
        return tl_report_fail(report, TL_ERR_MAGIC, "header", TL_NO_ELEMENT, "it is not a talus file");
    }
    if (head.version != TL_PACK_VERSION) {
        return tl_report_fail(report, TL_ERR_VERSION, "header", TL_NO_ELEMENT,
                              "bake the level again with this version");
    }
    if (head.header_hash != header_hash) {
        return damaged(report, TL_ERR_HASH, "header", TL_NO_ELEMENT);
    }
    if (size < head.size || !tl_range_fits(sizeof head, head.chunk_count, sizeof(tl_pack_entry), size)) {
        return damaged(report, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT);
    }
    const size_t table_size = head.chunk_count * sizeof(tl_pack_entry);
    uint8_t *table = (uint8_t *)bytes + sizeof head;
    if (head.table_hash != tl_hash_bytes(table, table_size, 0)) {
        return damaged(report, TL_ERR_HASH, "table", TL_NO_ELEMENT);
    }
    for (uint32_t i = 0; i < head.chunk_count; i++) {
        tl_pack_entry entry;
        uint8_t *at = table + i * sizeof entry;
        memcpy(&entry, at, sizeof entry);
        if (to_host) {
            tl_pack_swap_table(&entry, 1);
        }
        TL_TRY(swap_chunk_at(bytes, size, &entry, i, to_host, report));
        if (!to_host) {
            tl_pack_swap_table(&entry, 1);
        }
        memcpy(at, &entry, sizeof entry);
    }
    head.table_hash = tl_hash_bytes(table, table_size, 0);
    tl_pack_seal_header(&head, !to_host);
    memcpy(bytes, &head, sizeof head);
    return TL_OK;
}

void tl_pack_seal_header(tl_pack_header *header, bool foreign)
{
    if (foreign) {
        tl_pack_swap_header(header);
    }
    header->header_hash = tl_hash_bytes(header, offsetof(tl_pack_header, header_hash), 0);
    if (foreign) {
        tl_byte_swap hash = { (uint8_t *)&header->header_hash, sizeof header->header_hash, true, true };
        tl_swap_words(&hash, 0, 1, sizeof header->header_hash);
    }
}

// ---------------------------------------------------------------------------------------------------------
// What callers see: nothing is done where the two orders are one.

static tl_result order_blob(void *bytes, uint64_t size, bool to_host, tl_report *report)
{
    tl_report_begin(report, "byte order");
    TL_REFUSE_NULL(bytes, report);
    if (TL_BIG_ENDIAN) {
        return tl_blob_swap(bytes, size, to_host, report);
    }
    // The same errors as on other machines, but for counts, which only the blob's own check looks at here.
    if (size < sizeof(tl_blob)) {
        return damaged(report, TL_ERR_TRUNCATED, "head", TL_NO_ELEMENT);
    }
    return find_kind(bytes, size, false) != NULL
               ? TL_OK
               : tl_report_fail(report, TL_ERR_MAGIC, "head", TL_NO_ELEMENT, "it is no blob");
}

tl_result tl_blob_to_file_order(void *bytes, uint64_t size, tl_report *report_out)
{
    return order_blob(bytes, size, false, report_out);
}

tl_result tl_blob_to_host_order(void *bytes, uint64_t size, tl_report *report_out)
{
    return order_blob(bytes, size, true, report_out);
}

tl_result tl_pack_to_host_order(void *bytes, uint64_t size, tl_report *report_out)
{
    tl_report_begin(report_out, "byte order");
    TL_REFUSE_NULL(bytes, report_out);
    if (!TL_BIG_ENDIAN) {
        return TL_OK; // tl_pack_open checks the bytes
    }
    tl_pack_header head;
    if (size >= sizeof head) {
        memcpy(&head, bytes, sizeof head);
        if (head.version == TL_PACK_VERSION) {
            return TL_OK; // done before
        }
    }
    return tl_pack_swap(bytes, size, true, report_out);
}
