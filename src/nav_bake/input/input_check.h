// SPDX-License-Identifier: MIT
//
// The input of a bake, checked once before any work.

#ifndef TALUS_SRC_NAV_BAKE_INPUT_CHECK_H
#define TALUS_SRC_NAV_BAKE_INPUT_CHECK_H

#include <talus/nav_bake.h>

/// Checks the mesh and the volumes, and measures the bounds of the vertices that triangles use. `host` and
/// `bounds_out` may be NULL. TL_ERR_EMPTY, TL_ERR_INDEX, TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_ARGUMENT, with the
/// element named.
tl_result tl_nav_input_check(const tl_nav_input *input, const tl_host *host, tl_aabb *bounds_out, tl_report *report);

#endif
