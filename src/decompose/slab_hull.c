// SPDX-License-Identifier: MIT
//
// Slab hulls: convex hulls with faces in 98 fixed directions, by which hundreds of cuts are compared at once.
//
// A real hull of each side of each plane would be built a thousand times a part. Slab hulls of growing sets of points
// come from a sweep, one minimum and maximum an axis and step; and what one holds of the grid is a run of cells a row,
// between two numbers that the axes bound, whose excess is the difference of two sums.
//
// Source: Klosowski, Held, Mitchell, Sowizral, Zikan, Efficient Collision Detection Using Bounding Volume Hierarchies
// of k-DOPs, 1998.

#include "decompose/slab_hull.h"

#include "base/min_max.h"

#include <float.h>
#include <math.h>
#include <string.h>

static bool is_primitive(int x, int y, int z)
{
    return x % 2 != 0 || y % 2 != 0 || z % 2 != 0;
}

static void put_axis(tl_slab_axes *axes, uint32_t at, int x, int y, int z)
{
    axes->x[at] = (float)x;
    axes->y[at] = (float)y;
    axes->z[at] = (float)z;
}

void tl_slab_axes_make(tl_slab_axes *axes)
{
    memset(axes, 0, sizeof *axes);
    put_axis(axes, 0, 1, 0, 0);
    put_axis(axes, 1, 0, 1, 0);
    put_axis(axes, 2, 0, 0, 1);
    uint32_t count = 3;
    for (int i = 0; i < 125; i++) {
        const int x = i / 25 - 2, y = i / 5 % 5 - 2, z = i % 5 - 2;
        const bool is_positive = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        const bool is_main = x * x + y * y + z * z == 1;
        if (is_positive && !is_main && is_primitive(x, y, z)) {
            put_axis(axes, count++, x, y, z);
        }
    }
}

void tl_slab_hull_clear(tl_slab_hull *hull)
{
    for (uint32_t i = 0; i < TL_SLAB_LANES; i++) {
        hull->low[i] = FLT_MAX;
        hull->high[i] = -FLT_MAX;
    }
}

void tl_slab_hull_add_point(tl_slab_hull *hull, const tl_slab_axes *axes, float x, float y, float z)
{
    for (uint32_t i = 0; i < TL_SLAB_LANES; i++) {
        const float along = axes->x[i] * x + axes->y[i] * y + axes->z[i] * z;
        hull->low[i] = tl_min_f32(hull->low[i], along);
        hull->high[i] = tl_max_f32(hull->high[i], along);
    }
}

void tl_slab_hull_add(tl_slab_hull *hull, const tl_slab_hull *other)
{
    for (uint32_t i = 0; i < TL_SLAB_LANES; i++) {
        hull->low[i] = tl_min_f32(hull->low[i], other->low[i]);
        hull->high[i] = tl_max_f32(hull->high[i], other->high[i]);
    }
}

// The cells whose centres lie between two places along an axis; none: first > last.
static void centers_between(float low, float high, uint32_t size, int32_t *first, int32_t *last)
{
    *first = (int32_t)ceilf(tl_clamp_f32(low - 0.5f, 0.0f, (float)size));
    *last = (int32_t)floorf(tl_clamp_f32(high - 0.5f, -1.0f, (float)size - 1.0f));
}

typedef struct slab_rows {
    const tl_slab_hull *hull; // already thicker
    const tl_slab_axes *axes;
    float *low, *high; // [size y] of each row, along x
    int32_t first, last;
} slab_rows;

// Narrows the rows of one layer by an axis that leans along x.
static void narrow_rows(const slab_rows *rows, uint32_t axis, float z)
{
    const float inverse = 1.0f / rows->axes->x[axis], y_step = rows->axes->y[axis];
    const float along_z = rows->axes->z[axis] * z;
    const float low = (rows->hull->low[axis] - along_z) * inverse, high = (rows->hull->high[axis] - along_z) * inverse;
    const float slope = y_step * inverse;
    float *row_low = rows->low, *row_high = rows->high;
    for (int32_t y = rows->first; y <= rows->last; y++) {
        const float shift = ((float)y + 0.5f) * slope;
        row_low[y] = tl_max_f32(row_low[y], low - shift);
        row_high[y] = tl_min_f32(row_high[y], high - shift);
    }
}

// Narrows which rows there are by an axis across x and z; false: by one across x, a row of this layer may be empty.
static void narrow_layer(slab_rows *rows, uint32_t axis, float z, uint32_t size_y)
{
    const float y_step = rows->axes->y[axis], along_z = rows->axes->z[axis] * z;
    float low = (rows->hull->low[axis] - along_z) / y_step, high = (rows->hull->high[axis] - along_z) / y_step;
    int32_t first, last;
    centers_between(low, high, size_y, &first, &last);
    rows->first = first > rows->first ? first : rows->first;
    rows->last = last < rows->last ? last : rows->last;
}

static uint64_t layer_excess(slab_rows *rows, const tl_distance_grid *grid, uint32_t layer)
{
    const float z = (float)layer + 0.5f;
    rows->first = 0;
    rows->last = (int32_t)grid->size[1] - 1;
    for (uint32_t i = 0; i < TL_SLAB_AXES; i++) {
        if (rows->axes->x[i] == 0.0f && rows->axes->y[i] != 0.0f) {
            narrow_layer(rows, i, z, grid->size[1]);
        }
    }
    for (int32_t y = rows->first; y <= rows->last; y++) {
        rows->low[y] = rows->hull->low[0];
        rows->high[y] = rows->hull->high[0];
    }
    for (uint32_t i = 3; i < TL_SLAB_AXES; i++) {
        if (rows->axes->x[i] != 0.0f) {
            narrow_rows(rows, i, z);
        }
    }
    uint64_t sum = 0;
    for (int32_t y = rows->first; y <= rows->last; y++) {
        int32_t first, last;
        centers_between(rows->low[y], rows->high[y], grid->size[0], &first, &last);
        if (first <= last) {
            const uint32_t *sums =
                grid->excess + ((size_t)layer * grid->size[1] + (uint32_t)y) * ((size_t)grid->size[0] + 1);
            sum += sums[last + 1] - sums[first];
        }
    }
    return sum;
}

uint64_t tl_slab_hull_excess(const tl_slab_hull *hull, const tl_slab_axes *axes, const tl_distance_grid *grid,
                             float *scratch)
{
    tl_slab_hull thick;
    for (uint32_t i = 0; i < TL_SLAB_LANES; i++) {
        const float length = sqrtf(axes->x[i] * axes->x[i] + axes->y[i] * axes->y[i] + axes->z[i] * axes->z[i]);
        thick.low[i] = hull->low[i] - 0.5f * length;
        thick.high[i] = hull->high[i] + 0.5f * length;
    }
    slab_rows rows = { &thick, axes, scratch, scratch + grid->size[1], 0, 0 };
    int32_t first, last;
    centers_between(thick.low[2], thick.high[2], grid->size[2], &first, &last);
    uint64_t sum = 0;
    for (int32_t layer = first; layer <= last; layer++) {
        sum += layer_excess(&rows, grid, (uint32_t)layer);
    }
    return sum;
}
