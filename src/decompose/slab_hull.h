// SPDX-License-Identifier: MIT
//
// The slab hull of points (a k-DOP): how far they reach along fixed axes; and the excess of such hulls on the grid.

#ifndef TALUS_SRC_DECOMPOSE_SLAB_HULL_H
#define TALUS_SRC_DECOMPOSE_SLAB_HULL_H

#include "decompose/distance_grid.h"

/// Axes: all directions of whole numbers up to 2, opposite ones being one. Between neighbours are 27 degrees at most.
enum { TL_SLAB_AXES = 49, TL_SLAB_LANES = 52 };

/// In the grid's frame: cells, from its corner. Points p with low[i] <= axis i . p <= high[i] are inside.
typedef struct tl_slab_hull {
    float low[TL_SLAB_LANES], high[TL_SLAB_LANES];
} tl_slab_hull;

/// The axes' components, an array a component.
typedef struct tl_slab_axes {
    float x[TL_SLAB_LANES], y[TL_SLAB_LANES], z[TL_SLAB_LANES];
} tl_slab_axes;

/// The first axes are x, y and z; behind the last they are zero.
void tl_slab_axes_make(tl_slab_axes *axes);

/// Empty: nothing is inside.
void tl_slab_hull_clear(tl_slab_hull *hull);

/// Adds a point, and all of another hull.
void tl_slab_hull_add_point(tl_slab_hull *hull, const tl_slab_axes *axes, float x, float y, float z);
void tl_slab_hull_add(tl_slab_hull *hull, const tl_slab_hull *other);

/// The sum of the grid's excess over all cells in a hull, made thicker by half a cell so that flat ones hold some.
/// `scratch` holds 2 size[1] floats.
uint64_t tl_slab_hull_excess(const tl_slab_hull *hull, const tl_slab_axes *axes, const tl_distance_grid *grid,
                             float *scratch);

#endif
