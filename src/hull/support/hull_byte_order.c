// SPDX-License-Identifier: MIT
//
// The words of a hull: doubles in the mass and the planes, topology, sources and table as wide as they are, four bytes
// everywhere else.

#include "base/byte_order.h"
#include "hull/support/face_ring.h"

#include <string.h>

static const tl_word_run HULL_HEAD[] = {
    { 4, 2 },  // magic, version
    { 8, 1 },  // size
    { 4, 4 },  // vertex_count .. scan_error
    { 1, 2 },  // index_bytes, flags
    { 2, 1 },  // vertices
    { 4, 7 },  // merge_distance, bounds
    { 8, 11 }, // mass
};

static uint64_t bytes_at(uint32_t units)
{
    return (uint64_t)units * TL_BLOB_ALIGNMENT;
}

// The parts that only a hull of more than TL_HULL_FEW vertices has.
static void swap_climb(tl_byte_swap *swap, const tl_hull_climb *climb)
{
    tl_swap_words(swap, bytes_at(climb->table), tl_hull_cell_count(climb), climb->cell_bytes);
    tl_swap_words(swap, bytes_at(climb->rings), (uint64_t)climb->ring_count * (sizeof(tl_face_ring) / 4), 4);
    tl_swap_words(swap, bytes_at(climb->blocks), (uint64_t)climb->block_count * (sizeof(tl_climb_block) / 4), 4);
}

// The counts of it, in this machine's order; the rest follows from them. False where the bytes are too few.
static bool swap_climb_head(tl_byte_swap *swap, tl_hull_climb *climb)
{
    if (swap->size < TL_HULL_CLIMB_OFFSET + sizeof *climb) {
        return false;
    }
    const uint8_t *at = swap->bytes + TL_HULL_CLIMB_OFFSET;
    if (!swap->to_host) {
        memcpy(climb, at, sizeof *climb);
    }
    tl_swap_words(swap, TL_HULL_CLIMB_OFFSET, sizeof *climb / 4, 4);
    if (swap->to_host) {
        memcpy(climb, at, sizeof *climb);
    }
    return true;
}

void tl_hull_swap_words(tl_byte_swap *swap)
{
    tl_hull head;
    tl_hull_climb climb;
    tl_swap_head(swap, HULL_HEAD, sizeof HULL_HEAD / sizeof HULL_HEAD[0], &head, sizeof head);
    memset(&climb, 0, sizeof climb);
    if (!swap->fits) {
        return;
    }
    // The rest follows from the counts; counts beyond what a hull may have do not fit the size.
    const bool few = head.vertex_count <= TL_HULL_FEW;
    if (head.vertex_count > TL_MAX_HULL_POINTS || !tl_hull_is_width(tl_hull_source_bytes(&head)) ||
        (!few && !swap_climb_head(swap, &climb)) || tl_hull_lay_out(&head, &climb) != swap->size) {
        swap->fits = false;
        return;
    }
    const uint64_t scan_count = tl_hull_scan_count(&head), vertex_bytes = sizeof(tl_vec3) * (uint64_t)head.vertex_count;
    const uint64_t rows = few ? sizeof head : TL_HULL_CLIMB_OFFSET + sizeof climb;
    const uint64_t planes = few ? rows + 3 * sizeof(float) * scan_count : bytes_at(climb.planes);
    tl_swap_words(swap, rows, 3 * scan_count, 4);
    tl_swap_words(swap, planes, tl_hull_plane_bytes(&head) / 8, 8);
    tl_swap_words(swap, head.vertices, 3 * (uint64_t)head.vertex_count, 4);
    tl_swap_words(swap, head.vertices + vertex_bytes, tl_hull_word_count(&head), head.index_bytes);
    if (tl_hull_source_bytes(&head) > 0) {
        tl_swap_words(swap, tl_hull_sources_offset(&head), head.vertex_count, tl_hull_source_bytes(&head));
    }
    if (!few) {
        swap_climb(swap, &climb);
    }
}
