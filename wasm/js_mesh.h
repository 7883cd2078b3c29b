// SPDX-License-Identifier: MIT
//
// The level that a call is about: JavaScript copies its arrays into the module's memory and names them here.

#ifndef TALUS_WASM_JS_MESH_H
#define TALUS_WASM_JS_MESH_H

#include "js_slot.h"

/// The mesh, its areas and volumes, as set by js_set_input.
extern tl_nav_input tl_js_input;

/// A def's fields from the slot, in the order of js/src/nav_options.js.
tl_nav_def tl_js_nav_def(uint32_t at);
/// ... and into the slot.
uint32_t tl_js_put_nav_def(uint32_t at, const tl_nav_def *def);

/// Volumes from doubles; see js/src/nav_options.js for their layout. NULL with `*result_out` TL_ERR_MEMORY, or with
/// TL_OK where there are none. One block: free() frees it.
tl_nav_volume *tl_js_volumes(const double *numbers, uint32_t count, tl_result *result_out);

/// The bounds of the input's level, as tl_nav_bake takes them: of the vertices that triangles use.
tl_aabb tl_js_input_bounds(void);

#endif
