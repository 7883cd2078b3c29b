// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_MESH_CLEAN_H
#define TALUS_SRC_MESH_CLEAN_H

#include "base/arena.h"
#include "base/stage.h"

#include <talus/mesh.h>

/// Whether a view, its indices and, with the second, its vertices are there, and no more of them than the limits allow.
tl_result tl_mesh_view_check_indices(const tl_mesh_view *view, tl_report *report);
tl_result tl_mesh_view_check(const tl_mesh_view *view, tl_report *report);

/// Indices in range, used vertices finite and below TL_MAX_COORDINATE. Names the first offending element in `report`.
/// Writes TL_WELD_PENDING into used[v] for each vertex that a triangle uses, TL_WELD_UNUSED for the others.
tl_result tl_check_triangles(const tl_mesh_view *view, tl_stage *stage, uint32_t *used, tl_report *report);

/// Writes the indices of the triangles to keep, ascending, into `kept`, which holds triangle_count: those whose three
/// representative corners differ and span an area, and which repeat no earlier triangle unless the def keeps
/// duplicates. Counts the others in `report`. Errors: TL_ERR_MEMORY, TL_ERR_CANCELLED. O(triangles), on the tasks of
/// the cleaning's host where duplicates are kept.
typedef struct tl_cleaning {
    const tl_mesh_view *view;
    const uint32_t *representative;
    bool keep_duplicates;
    tl_stage *stage;
} tl_cleaning;
tl_result tl_clean_triangles(const tl_cleaning *cleaning, tl_arena *arena, uint32_t *kept, uint32_t *kept_count_out,
                             tl_mesh_report *report);

#endif
