// SPDX-License-Identifier: MIT

#ifndef TALUS_WASM_JS_CONVEX_H
#define TALUS_WASM_JS_CONVEX_H

#include "js_slot.h"

/// Doubles of a shape in the slot: kind, rounding radius, pointer, number of points, nine coordinates.
enum { TL_JS_SHAPE_NUMBERS = 13 };

/// A shape from the slot; see js/src/shape.js.
tl_convex tl_js_shape(uint32_t at);

#endif
