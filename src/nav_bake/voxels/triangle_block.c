// SPDX-License-Identifier: MIT
//
// Fills blocks of triangles, and chooses who answers.

#include "nav_bake/voxels/triangle_block.h"

#include "base/assert.h"

const tl_block_questions *tl_block_questions_best(void)
{
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        return &tl_block_questions_avx2;
    }
#endif
    return &tl_block_questions_scalar;
}

static inline void set_corners(tl_triangle_block *block, uint32_t i, const tl_vec3 *vertices, const uint32_t *corners)
{
    for (uint32_t corner = 0; corner < 3; corner++) {
        const tl_vec3 p = vertices[corners[corner]];
        block->metres[0][corner][i] = p.x;
        block->metres[1][corner][i] = p.y;
        block->metres[2][corner][i] = p.z;
    }
}

uint32_t tl_triangle_block_fill(tl_triangle_block *block, const tl_mesh_view *mesh, const tl_triangle_list *list,
                                uint32_t first)
{
    TL_ASSERT(first < list->count);
    const uint32_t left = list->count - first, count = left < TL_TRIANGLE_BLOCK ? left : TL_TRIANGLE_BLOCK;
    for (uint32_t i = 0; i < count; i++) {
        set_corners(block, i, mesh->vertices, mesh->indices + 3 * (size_t)tl_triangle_list_get(list, first + i));
    }
    const uint32_t *last = mesh->indices + 3 * (size_t)tl_triangle_list_get(list, first + count - 1);
    for (uint32_t i = count; i < TL_TRIANGLE_BLOCK; i++) {
        set_corners(block, i, mesh->vertices, last);
    }
    return count;
}
