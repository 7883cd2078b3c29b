// SPDX-License-Identifier: MIT
//
// Where to cut a part: planes across several directions, weighed by the excess of both sides.

#ifndef TALUS_SRC_DECOMPOSE_CUT_SEARCH_H
#define TALUS_SRC_DECOMPOSE_CUT_SEARCH_H

#include "decompose/distance_grid.h"
#include "decompose/part.h"

/// Directions that a part may be cut across: the three axes, the principal ones, and those of most area.
enum { TL_CUT_DIRECTIONS = 10 };

/// The directions of a part, unit vectors; how many there are. At least the three axes.
uint32_t tl_cut_directions(const tl_part *part, tl_vec3d directions[TL_CUT_DIRECTIONS]);

/// The best plane across one direction.
typedef struct tl_cut_choice {
    tl_cut_plane plane;
    double cost;     ///< of the excess of both sides; INFINITY: no plane divides the part
    double narrower; ///< metres, extent of the narrower side: of equal cost the plane is best that leaves most
} tl_cut_choice;

/// Whether a choice is better than another.
static inline bool tl_cut_is_better(const tl_cut_choice *a, const tl_cut_choice *b)
{
    return a->cost < b->cost || (a->cost == b->cost && a->narrower > b->narrower);
}

/// TL_ERR_MEMORY.
tl_result tl_cut_search(const tl_part *part, tl_vec3d direction, const tl_distance_grid *grid,
                        const tl_allocator *allocator, tl_cut_choice *choice_out);

#endif
