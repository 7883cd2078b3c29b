// SPDX-License-Identifier: MIT
//
// A piece of the mesh, and what is known of its hull.

#ifndef TALUS_SRC_DECOMPOSE_PART_H
#define TALUS_SRC_DECOMPOSE_PART_H

#include "base/arena.h"
#include "math/vec3d.h"

#include <talus/hull.h>
#include <talus/soup.h>

/// A plane that cuts: points p with normal . p > offset lie above it.
typedef struct tl_cut_plane {
    tl_vec3d normal; ///< unit
    double offset;   ///< metres
} tl_cut_plane;

typedef struct tl_part {
    tl_vec3 *corners; ///< [3 * triangle_count], an array of the bake's allocator; NULL once it is cut or merged
    uint32_t triangle_count;
    uint32_t cut_count; ///< planes that cut it, one after another
    tl_hull *hull;      ///< of all its corners, exact; NULL until it is known
    double concavity;   ///< a bound; INFINITY until it is known
    bool is_whole;      ///< nothing is to be gained by cutting it
} tl_part;

/// Frees what a part holds, and zeroes it.
void tl_part_free(tl_part *part, const tl_allocator *allocator);

/// All triangles of a soup as one part. TL_ERR_MEMORY.
tl_result tl_part_from_soup(const tl_soup *soup, uint32_t triangle_count, const tl_allocator *allocator, tl_part *part);

/// Cuts a part in two. Corners in the plane belong to both. Where nothing lies on one side, that part is empty.
/// TL_ERR_MEMORY; TL_ERR_LIMIT: more than TL_MAX_SOUP_TRIANGLES.
tl_result tl_part_cut(const tl_part *part, const tl_cut_plane *plane, const tl_allocator *allocator, tl_part halves[2]);

/// More loose pieces than this stay one part, for planes to divide: the leaves of a tree.
enum { TL_MAX_PART_PIECES = 64 };

/// Moves a part to `made`, which holds TL_MAX_PART_PIECES: in the pieces that hang together at corners of equal
/// position, or whole where they are more. Adds to `*made_count`. The part is freed in any case. TL_ERR_MEMORY.
tl_result tl_part_divide(tl_part *part, const tl_allocator *allocator, tl_part *made, uint32_t *made_count);

/// Room for so many triangles, 0 of them unset. TL_ERR_MEMORY; TL_ERR_LIMIT: more than TL_MAX_SOUP_TRIANGLES.
tl_result tl_part_allocate(uint64_t triangle_count, const tl_allocator *allocator, tl_part *part);

#endif
