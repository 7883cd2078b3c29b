// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_NAV_BAKE_RANGE_INPUT_H
#define TALUS_SRC_NAV_BAKE_RANGE_INPUT_H

#include "nav_bake/input/triangle_bins.h"

/// The triangles of an input that can lie in a part of the plane: an input of its own, over the same vertices.
typedef struct tl_range_input {
    tl_nav_input input;
    uint32_t *triangles; ///< [input.mesh.triangle_count] in the caller's numbering, ascending
    uint32_t *indices;
    uint8_t *areas;
    uint64_t capacity;
} tl_range_input;

/// One pass over the triangles of a list, which reads and compares; what is wrong with a triangle outside the window is
/// not looked for. A triangle with a corner that does not exist, or that is not a number, is taken, so that the build
/// names it. TL_ERR_MEMORY. Free with tl_range_input_free in any case.
tl_result tl_range_input_make(const tl_nav_input *input, tl_triangle_list list, tl_aabb window,
                              const tl_allocator *allocator, tl_range_input *range_out);
void tl_range_input_free(tl_range_input *range, const tl_allocator *allocator);

#endif
