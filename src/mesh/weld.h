// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_MESH_WELD_H
#define TALUS_SRC_MESH_WELD_H

#include "base/arena.h"
#include "base/stage.h"

#include <talus/mesh.h>

/// Marks in `representative[v]` the vertex that each used vertex becomes: itself, or an earlier one.
/// On entry representative[v] is TL_WELD_UNUSED for vertices that take no part; they stay so. Used vertices are finite.
/// `tolerance` > 0. Scratch comes from `arena`. Errors: TL_ERR_MEMORY, TL_ERR_CANCELLED. O(vertices).
tl_result tl_weld(const tl_mesh_view *view, float tolerance, tl_stage *stage, tl_arena *arena,
                  uint32_t *representative);

/// The same with tolerance 0, on the tasks of the stage's host. Adds the view's vertices to the stage.
tl_result tl_weld_points(const tl_mesh_view *view, tl_stage *stage, tl_arena *arena, uint32_t *representative);

#define TL_WELD_UNUSED  UINT32_MAX
#define TL_WELD_PENDING (UINT32_MAX - 1u) ///< on entry: this vertex takes part

#endif
