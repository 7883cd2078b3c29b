// SPDX-License-Identifier: MIT
//
// A matching of some triangles over the edges that they share.

#ifndef TALUS_SRC_SOUP_PAIR_MATCH_H
#define TALUS_SRC_SOUP_PAIR_MATCH_H

#include "base/arena.h"
#include "base/stage.h"

#include <talus/mesh.h>

#define TL_NO_MATE UINT32_MAX

/// Edges are numbered like corners: edge 3 t + k of triangle t runs from its corner k to the next.
typedef struct tl_pair_matcher tl_pair_matcher;

/// A matcher of up to `capacity` triangles at once. NULL: out of memory.
tl_pair_matcher *tl_pair_matcher_make(const tl_mesh *mesh, uint32_t capacity, tl_arena *arena);

/// Matches `count` triangles: those in `list`, or, where it is NULL, those from `first` on. Writes to mates[t], for
/// each of them, the edge of its partner that they share, or TL_NO_MATE. Ticks the stage, which tasks leave NULL.
tl_result tl_pair_match(tl_pair_matcher *matcher, tl_stage *stage, const uint32_t *list, uint32_t first, uint32_t count,
                        uint32_t *mates);

#endif
