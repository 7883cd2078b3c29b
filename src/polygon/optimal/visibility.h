// SPDX-License-Identifier: MIT
//
// Which corners of an outline see each other?

#ifndef TALUS_SRC_POLYGON_VISIBILITY_H
#define TALUS_SRC_POLYGON_VISIBILITY_H

#include "base/arena.h"
#include "polygon/outline/lattice_point.h"

/// An outline of `count` corners with its triangulation, as tl_triangulate makes it.
typedef struct tl_triangulated_outline {
    const tl_lattice_point *points; // [count]
    uint32_t count;
    const uint32_t *triangles; // [3 * (count - 2)]
    const uint32_t *twins;     // [3 * (count - 2)]
} tl_triangulated_outline;

/// The chords of an outline of `count` corners: from corner i to the later corners seen from it, by rising number:
/// to[first[i]] .. to[first[i + 1] - 1]. The outline's own edges are among them, so i + 1 comes first.
typedef struct tl_visibility {
    uint32_t *first; // [count + 1]
    uint32_t *to;
} tl_visibility;

/// Finds all chords that lie strictly inside the outline. When there are more than `max_chords`, *found is false and
/// the rest undefined. TL_ERR_MEMORY is the only error.
tl_result tl_find_visibility(tl_arena *arena, const tl_triangulated_outline *outline, uint64_t max_chords,
                             tl_visibility *visibility_out, bool *found);

#endif
