// SPDX-License-Identifier: MIT
//
// Vertices in straight runs of a contour that no other contour has.

#ifndef TALUS_SRC_POLYGON_STRAIGHT_VERTICES_H
#define TALUS_SRC_POLYGON_STRAIGHT_VERTICES_H

#include "polygon/outline/key_table.h"

#include <talus/polygon.h>

/// How often each place on the xz plane is a vertex, in all contours of a set.
typedef struct tl_place_counts {
    tl_key_table table;
} tl_place_counts;

/// False: out of memory.
bool tl_place_counts_init(tl_place_counts *counts, tl_arena *arena, const tl_contour_set *contours);

/// Copies a contour's vertices to `kept`, which has room for all, without those that can go. Returns how many are kept.
uint32_t tl_drop_straight_vertices(tl_place_counts *counts, const tl_contour_set *contours, const tl_contour *contour,
                                   tl_contour_vertex *kept);

#endif
