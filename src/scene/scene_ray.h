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
    tl_vec3 end;             ///< of a line of sight; where and how a ray runs, the line knows
    float whole;             ///< tmax of the ray as it was given
    float tmax;              ///< of the best
    uint32_t instance;       ///< of the best; TL_NO_INSTANCE: none yet
    tl_scene_hit *hit;       ///< the best; NULL: any will do
    tl_scene_hit *candidate; ///< the room for another
} tl_scene_ray_search;

/// Asks a convex shape; they have no triangles, and are where they are in the world.
bool tl_scene_ray_meets_shape(const tl_scene_line *line, uint32_t instance, tl_scene_hit *hit);
bool tl_scene_shape_hides(const tl_scene_line *line, uint32_t instance);

#endif
