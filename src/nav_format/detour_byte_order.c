// SPDX-License-Identifier: MIT
//
// Detour writes its data in the order of the machine that bakes; talus writes it little-endian everywhere and reads
// both, also what an older console's tools left behind. Detour's own dtNavMeshDataSwapEndian does the same to a tile's
// arrays, and like here leaves out the links, which are made when a tile is added.

#include "nav_format/detour_read.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/byte_order.h"
#include "base/host.h"

#include <string.h>

static uint32_t load_word(const uint8_t *bytes, bool foreign)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return foreign ? word >> 24 | (word >> 8 & 0xff00u) | (word & 0xff00u) << 8 | word << 24 : word;
}

static void swap_tile(tl_byte_swap *swap)
{
    static const tl_word_run HEAD[] = { { 4, sizeof(tl_detour_header) / 4 } };
    static const tl_word_run POLYGON[] = { { 4, 1 }, { 2, 2 * TL_DETOUR_MAX_CORNERS + 1 }, { 1, 2 } };
    static const tl_word_run PATCH[] = { { 4, 2 }, { 1, 4 } };
    static const tl_word_run NODE[] = { { 2, 6 }, { 4, 1 } };
    static const tl_word_run CONNECTION[] = { { 4, 7 }, { 2, 1 }, { 1, 2 }, { 4, 1 } };
    tl_detour_header head;
    tl_swap_head(swap, HEAD, 1, &head, sizeof head);
    if (!swap->fits || head.polygon_count < 0 || head.vertex_count < 0 || head.max_link_count < 0 ||
        head.detail_mesh_count < 0 || head.detail_vertex_count < 0 || head.detail_triangle_count < 0 ||
        head.node_count < 0 || head.off_mesh_count < 0) {
        swap->fits = false;
        return;
    }
    tl_detour_offsets at = tl_detour_offsets_of(&head, TL_DETOUR_REFS_64);
    if (at.end != swap->size) {
        at = tl_detour_offsets_of(&head, TL_DETOUR_REFS_32);
    }
    tl_swap_words(swap, at.vertices, 3 * (uint64_t)head.vertex_count, 4);
    tl_swap_elements(swap, at.polygons, (uint64_t)head.polygon_count, POLYGON, TL_COUNT_OF(POLYGON));
    tl_swap_elements(swap, at.patches, (uint64_t)head.detail_mesh_count, PATCH, TL_COUNT_OF(PATCH));
    tl_swap_words(swap, at.detail_vertices, 3 * (uint64_t)head.detail_vertex_count, 4);
    tl_swap_elements(swap, at.nodes, (uint64_t)head.node_count, NODE, TL_COUNT_OF(NODE));
    tl_swap_elements(swap, at.off_mesh, (uint64_t)head.off_mesh_count, CONNECTION, TL_COUNT_OF(CONNECTION));
}

static void swap_set(tl_byte_swap *swap)
{
    tl_detour_set_header head;
    static const tl_word_run HEAD[] = { { 4, sizeof head / 4 } };
    tl_swap_head(swap, HEAD, 1, &head, sizeof head);
    uint64_t at = sizeof head;
    uint32_t entry = 0; // bytes; the first tile tells, as in the reader
    for (int32_t i = 0; i < head.tile_count && swap->fits; i++) {
        if (swap->size - at < 12) {
            swap->fits = false;
            return;
        }
        if (entry == 0) {
            entry = load_word(swap->bytes + at + 8, swap->to_host) == TL_DETOUR_TILE_MAGIC ? 8 : 16;
        }
        const uint32_t size = load_word(swap->bytes + at + entry / 2, swap->to_host);
        tl_swap_words(swap, at, 1, entry / 2);
        tl_swap_words(swap, at + entry / 2, 1, 4);
        at += entry;
        if (at > swap->size || size > swap->size - at) {
            swap->fits = false;
            return;
        }
        tl_byte_swap tile = { swap->bytes + at, size, swap->to_host, swap->fits };
        swap_tile(&tile);
        swap->fits = tile.fits;
        at += size;
    }
}

bool tl_detour_swap(uint8_t *bytes, uint64_t size, bool to_host)
{
    tl_byte_swap swap = { bytes, size, to_host, true };
    if (size < 8) {
        return false;
    }
    if (load_word(bytes, to_host) == TL_DETOUR_SET_MAGIC) {
        swap_set(&swap);
    } else {
        swap_tile(&swap);
    }
    return swap.fits;
}

tl_result tl_detour_open_bytes(const void *bytes, uint64_t size, const tl_allocator *allocator,
                               tl_detour_bytes *open_out)
{
    memset(open_out, 0, sizeof *open_out);
    open_out->bytes = bytes;
    open_out->allocator = tl_allocator_or_default(allocator);
    if (size < 8) {
        return TL_OK;
    }
    const uint32_t magic = load_word(bytes, true);
    if (magic != TL_DETOUR_SET_MAGIC && magic != TL_DETOUR_TILE_MAGIC) {
        return TL_OK;
    }
    open_out->copy = tl_allocate_array(&open_out->allocator, size, 1);
    if (open_out->copy == NULL) {
        return TL_ERR_MEMORY;
    }
    open_out->copy_size = size;
    memcpy(open_out->copy, bytes, (size_t)size);
    open_out->bytes = open_out->copy;
    // Where counts do not fit the size, the head at least is turned round, and the reader says what is wrong with it.
    tl_detour_swap(open_out->copy, size, true);
    return TL_OK;
}

void tl_detour_close_bytes(tl_detour_bytes *open)
{
    tl_release_array(&open->allocator, open->copy, open->copy_size, 1);
    open->copy = NULL;
}
