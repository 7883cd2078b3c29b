// SPDX-License-Identifier: MIT
//
// Filing points under the faces of a step, the innermost loop of a hull's bake: kernels, one per instruction set.

#ifndef TALUS_SRC_HULL_FILE_POINTS_H
#define TALUS_SRC_HULL_FILE_POINTS_H

#include "base/cpu.h"
#include "hull/bake/quickhull.h"

/// Up to so many faces; a step that makes more tests one after the other.
enum { TL_MAX_FILED_FACES = 64 };

/// Planes of four faces side by side (side_plane.h).
typedef struct tl_plane_block {
    double x[4], y[4], z[4], offset[4], error[4];
    double length[4]; ///< of the normal; only when each_farthest
} tl_plane_block;

struct tl_filing {
    tl_plane_block blocks[TL_MAX_FILED_FACES / 4]; ///< of the faces; none is in front of what lies beyond the last one
    const uint32_t *faces;
    uint32_t block_count;
    uint32_t eye; ///< the point that the faces have in common, which is filed nowhere, or TL_NONE
};

#if TL_CPU_LEVELS >= 1
tl_file_points_fn tl_file_points_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_file_points_fn tl_file_points_avx2;
#endif

/// Of a level (base/cpu.h); NULL where this machine or build lacks it, and where plain C does: conflict_list.c tests
/// face by face then, the twin of all.
tl_file_points_fn *tl_file_points_for(int level);

/// From a face's plane. Of a face so small that its normal is zero in double nothing is known: it counts as far.
static inline double tl_filing_distance(double height, double length)
{
    const double distance = height / length;
    return isnan(distance) ? (double)INFINITY : distance;
}

static inline void tl_file_under(tl_quickhull *hull, uint32_t face, uint32_t point, double value)
{
    tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
    hull->local[point].next = conflicts->first;
    conflicts->first = point;
    if (point >= hull->point_count) {
        return;
    }
    if (conflicts->farthest == TL_NONE || value > conflicts->farthest_value ||
        (value == conflicts->farthest_value && point < conflicts->farthest)) {
        conflicts->farthest = point;
        conflicts->farthest_value = value;
    }
}

#endif
