// SPDX-License-Identifier: MIT
//
// The words of a hull: doubles in the mass and the planes, four bytes everywhere else.

#include "base/byte_order.h"
#include "hull/support/face_ring.h"

static const tl_word_run HULL_HEAD[] = {
    { 4, 2 },  // magic, version
    { 8, 1 },  // size
    { 4, 16 }, // vertex_count .. half_edge_count
    { 4, 6 },  // bounds
    { 8, 11 }, // mass
    { 8, 7 },  // offsets, merge_distance
};

static uint64_t bytes_at(uint32_t units)
{
    return (uint64_t)units * TL_BLOB_ALIGNMENT;
}

void tl_hull_swap_words(tl_byte_swap *swap)
{
    tl_hull head;
    tl_swap_head(swap, HULL_HEAD, sizeof HULL_HEAD / sizeof HULL_HEAD[0], &head, sizeof head);
    if (!swap->fits) {
        return;
    }
    // Table, scan and offsets follow from the counts; counts beyond what a hull may have do not fit the size.
    if (head.vertex_count > TL_MAX_HULL_POINTS || tl_hull_lay_out(&head) != swap->size) {
        swap->fits = false;
        return;
    }
    tl_swap_words(swap, bytes_at(head.scan), 3 * (uint64_t)head.scan_count, 4);
    tl_swap_words(swap, bytes_at(head.table), 2 * (uint64_t)head.table_side * head.table_side + head.ring_cells, 4);
    tl_swap_words(swap, bytes_at(head.rings), (uint64_t)head.ring_count * (sizeof(tl_face_ring) / 4), 4);
    tl_swap_words(swap, bytes_at(head.blocks), (uint64_t)head.block_count * (sizeof(tl_climb_block) / 4), 4);
    tl_swap_words(swap, head.vertices, 3 * (uint64_t)head.vertex_count, 4);
    tl_swap_words(swap, head.sources, head.vertex_count, 4);
    tl_swap_words(swap, head.vertex_edges, head.vertex_count, 4);
    tl_swap_words(swap, head.half_edges, (uint64_t)head.half_edge_count * (sizeof(tl_hull_half_edge) / 4), 4);
    tl_swap_words(swap, head.faces, (uint64_t)head.face_count * (sizeof(tl_hull_face) / 4), 4);
    tl_swap_words(swap, head.planes,
                  (uint64_t)tl_hull_plane_block_count(head.face_count) * (sizeof(tl_hull_plane_block) / 8), 8);
}
