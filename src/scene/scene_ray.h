// SPDX-License-Identifier: MIT
//
// A ray or a line of sight on its way through a scene: what scene_cast_ray.c sets up, and the walks visit instances
// with (scene_ray.inl).

#ifndef TALUS_SRC_SCENE_SCENE_RAY_H
#define TALUS_SRC_SCENE_SCENE_RAY_H

#include "scene/scene_walk.h"

typedef struct tl_scene_ray_search {
    const tl_scene_instance *instances;
    const tl_scene_record *records;
    const tl_scene_filter *filter;
    const tl_ray_filter *triangles;
    tl_ray ray;              ///< of a line of sight the direction is its far end
    float tmax;              ///< of the best
    uint32_t instance;       ///< of the best; TL_NO_INSTANCE: none yet
    tl_scene_hit *hit;       ///< the best; NULL: any will do
    tl_scene_hit *candidate; ///< the room for another
} tl_scene_ray_search;

/// Asks a convex shape; they have no triangles, and are where they are in the world.
bool tl_scene_ray_meets_shape(const tl_scene_ray_search *s, uint32_t instance, tl_scene_hit *hit);
bool tl_scene_shape_hides(const tl_scene_ray_search *s, uint32_t instance);

#endif
