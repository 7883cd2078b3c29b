// SPDX-License-Identifier: MIT
//
// The velocity nearest to a wanted one that a set of half-planes and a disc allow (half_plane_program.c).

#ifndef TALUS_SRC_NAV_CROWD_HALF_PLANE_PROGRAM_H
#define TALUS_SRC_NAV_CROWD_HALF_PLANE_PROGRAM_H

#include "base/exact_floats.h"

#include <stdint.h>

#define TL_MAX_HALF_PLANES 48

/// What lies to the left of a line through `x`, `z` along the unit vector `along_x`, `along_z`, seen with x to the
/// right and z up: along_x * (v_z - z) - along_z * (v_x - x) >= 0.
typedef struct tl_half_plane {
    float x, z, along_x, along_z;
} tl_half_plane;

typedef struct tl_half_plane_program {
    tl_half_plane planes[TL_MAX_HALF_PLANES]; ///< the hard ones first
    uint32_t count, hard_count;
    float max_length;         ///< of the answer
    float wanted_x, wanted_z; ///< no longer than that
} tl_half_plane_program;

/// The point nearest to the wanted one in all half-planes and the disc. Where there is none: the point of the disc that
/// keeps the hard ones, and violates none of the others by more than it must.
void tl_half_plane_solve(const tl_half_plane_program *program, float velocity_out[2]);

#endif
