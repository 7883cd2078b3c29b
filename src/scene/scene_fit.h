// SPDX-License-Identifier: MIT
//
// Fitting a scene's boxes to its instances.

#ifndef TALUS_SRC_SCENE_SCENE_FIT_H
#define TALUS_SRC_SCENE_SCENE_FIT_H

#include "scene/scene_layout.h"

/// Writes a box and its mask into a lane. Every query ignores a mask of 0, so its box is empty.
void tl_scene_set_lane(tl_scene *scene, uint32_t lane, tl_aabb box, uint32_t mask);

/// Fits the inner boxes to the instances', and measures the scene. O(nodes).
void tl_scene_fit_nodes(tl_scene *scene);

/// Reports an instance that tl_scene_read_instance refused.
tl_result tl_scene_refuse_instance(tl_report *report, tl_result result, uint32_t instance);

#endif
