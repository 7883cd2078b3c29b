// SPDX-License-Identifier: MIT
//
// The edges of one polygon's ring, one by one: a tile's corners and links, with border edges split at the ends of their
// seam links. They are counted, written, or held against a ring that stands.

#ifndef TALUS_SRC_NAV_QUERY_RING_WRITER_H
#define TALUS_SRC_NAV_QUERY_RING_WRITER_H

#include "nav_query/navmesh/rings.h"

typedef enum tl_nav_rings_mode {
    TL_NAV_RINGS_COUNT,   ///< and find which rings have points of their own
    TL_NAV_RINGS_WRITE,   ///< into arrays
    TL_NAV_RINGS_COMPARE, ///< with the rings that stand there
    TL_NAV_RINGS_REOPEN   ///< closed ways in those
} tl_nav_rings_mode;

/// Appends edges; the last one's end is where the next one starts.
typedef struct tl_nav_ring_writer {
    tl_nav_rings_mode mode;
    tl_nav_rings *rings;
    uint32_t *first, *first_point; ///< as the rings', to be written; NULL: they are the tile's
    tl_vec3 *points;
    uint64_t edge_count, seam_count;
    uint64_t point_count; ///< of rings that have their own
    bool has_back;        ///< some edge is a TL_NAV_RING_BACK
    // The ring that is being written.
    const tl_vec3 *corners; ///< of its polygon
    uint32_t corner_count;
    uint32_t count; ///< of its edges so far
    bool has_points;
    // To compare and to reopen.
    tl_nav_ring standing;
    tl_nav_ring_seam seam; ///< across the next edge, when that is one
    bool is_same;          ///< what stands is what would be written, but for ways that are closed
} tl_nav_ring_writer;

/// A polygon's ring with these links on the tile's sides.
void tl_nav_write_ring(tl_nav_ring_writer *writer, const tl_nav_tile *tile,
                       const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t polygon);

/// A polygon whose edges stay as they were; only its seams get new places.
void tl_nav_write_same_ring(tl_nav_ring_writer *writer, const tl_nav_rings *old, uint32_t polygon);

#endif
