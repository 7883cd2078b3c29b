// SPDX-License-Identifier: MIT
//
// The motion nearest to a wish that all contacts allow.

#ifndef TALUS_SRC_CHARACTER_ALLOWED_MOTION_H
#define TALUS_SRC_CHARACTER_ALLOWED_MOTION_H

#include "math/vec3d.h"

#include <stdint.h>

/// Allows the motions with normal * motion >= least.
typedef struct tl_mover_plane {
    tl_vec3d normal; ///< unit
    double least;    ///< metres
} tl_mover_plane;

enum { TL_MAX_MOVER_PLANES = 64 };

/// The point nearest to `wish` that satisfies all planes, each to within `slack` metres; false when there is none.
bool tl_allowed_motion(const tl_mover_plane *planes, uint32_t count, tl_vec3d wish, double slack, tl_vec3d *motion_out);

#endif
