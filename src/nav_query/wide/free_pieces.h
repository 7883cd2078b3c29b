// SPDX-License-Identifier: MIT
//
// The free pieces of a convex outline (free_pieces.c), and which of them a spot inside can reach (component_at.c).

#ifndef TALUS_SRC_NAV_QUERY_FREE_PIECES_H
#define TALUS_SRC_NAV_QUERY_FREE_PIECES_H

#include "nav_query/wide/wall_cell.h"

#define TL_NAV_NO_COMPONENT UINT32_MAX

/// A stretch of an edge on which the agent's centre may stand.
typedef struct tl_nav_piece {
    double from, to; ///< [0, 1] of the edge
    uint32_t edge;
    uint32_t component; ///< pieces have the same one when there is a free way between them inside the outline
} tl_nav_piece;

typedef struct tl_nav_pieces {
    tl_nav_piece *pieces; ///< in the outline's order
    uint32_t count;
    uint32_t component_count; ///< components are below it
} tl_nav_pieces;

/// Cuts a polygon's outline into free pieces. False: out of scratch memory.
bool tl_nav_cut_cell(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, tl_nav_pieces *pieces_out);

/// The same for any convex outline.
bool tl_nav_cut_outline(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                        const tl_nav_near_walls *near, tl_nav_pieces *pieces_out);

/// The piece that holds a spot of the outline within `slack`, or NULL.
const tl_nav_piece *tl_nav_piece_at(const tl_nav_pieces *pieces, const tl_nav_spot *corners, uint32_t count,
                                    tl_nav_spot spot, double slack);

/// The component of an outline's pieces that can be reached from a free spot inside it, or TL_NAV_NO_COMPONENT when
/// none can be.
/// `*joined_out` (may be NULL): whether there is a free way inside the outline from the spot to `other`.
/// `*component_out` is undefined when this returns false: out of scratch memory.
bool tl_nav_component_at(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, const tl_nav_pieces *pieces,
                         tl_nav_spot spot, tl_nav_spot other, uint32_t *component_out, bool *joined_out);

#endif
