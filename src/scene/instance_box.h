// SPDX-License-Identifier: MIT
//
// An instance's boxes.

#ifndef TALUS_SRC_SCENE_INSTANCE_BOX_H
#define TALUS_SRC_SCENE_INSTANCE_BOX_H

#include "scene/scene_layout.h"

/// Share of coordinates by which boxes of instances and of queries are widened (instance_box.c).
#define TL_SCENE_WIDEN TL_FLOAT_GAMMA(32)

/// The sum of a point's coordinates' sizes.
static inline double tl_scene_size(tl_vec3 a)
{
    return tl_vec3d_size(tl_vec3d_from(a));
}

/// Checks an instance, and gives its box in its own space: empty when nothing is there.
tl_result tl_scene_read_instance(const tl_scene_instance *instance, tl_aabb *local_out);

/// Fills a record and a place, but for its lane. Returns the box in the world; empty when nothing is there.
tl_aabb tl_scene_place_instance(tl_scene_record *record, tl_scene_place *place, const tl_scene_instance *instance,
                                tl_aabb local);

#endif
