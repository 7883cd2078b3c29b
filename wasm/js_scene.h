// SPDX-License-Identifier: MIT

#ifndef TALUS_WASM_JS_SCENE_H
#define TALUS_WASM_JS_SCENE_H

#include "js_slot.h"

/// A scene with the instances that its queries take, and the shapes that these point to.
typedef struct tl_js_scene {
    tl_scene *scene; ///< NULL before the first bake
    tl_scene_instance *instances;
    tl_convex *shapes; ///< of the instance with the same index, where it has one
    uint32_t count;
} tl_js_scene;

#endif
