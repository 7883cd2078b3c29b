// SPDX-License-Identifier: MIT
//
// What voxelizing a triangle by rows and by lines has in common: which cells a range overlaps, which voxels heights
// take.

#ifndef TALUS_SRC_NAV_BAKE_VOXEL_WALK_H
#define TALUS_SRC_NAV_BAKE_VOXEL_WALK_H

#include "base/min_max.h"
#include "nav_bake/input/lattice_map.h"
#include "nav_bake/voxels/voxel_band.h"

#include <string.h>

enum { TL_SUBDIVISION_BITS = 10 };
_Static_assert(TL_SUBDIVISIONS == 1 << TL_SUBDIVISION_BITS, "heights are shifted by the bits");

/// As TL_SUBDIVISION_ROUNDER, for whole numbers; the sum then ends in the number's low bits, as two's complement.
#define TL_WHOLE_ROUNDER 6755399441055744.0

// The nearest whole number, ties to even, of a value within +-2^31.
static inline int32_t tl_voxel_round(double value)
{
    double sum = value + TL_WHOLE_ROUNDER;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    return (int32_t)(uint32_t)bits;
}

// The cells of 0 .. count - 1 that [min, max] overlaps; none when *last_out < *first_out. What is only touched is not
// overlapped, but a single point lies in the cell to its right.
static inline void tl_voxel_cell_range(double min, double max, uint32_t count, int32_t *first_out, int32_t *last_out)
{
    const double end = (double)count;
    int32_t first = (int32_t)tl_clamp_f64(min, 0.0, end), last = (int32_t)tl_clamp_f64(max, 0.0, end);
    if (min < max) {
        last -= (double)last >= max; // touched by max, or max is left of all
    } else {
        last -= max < 0.0;
    }
    *first_out = first;
    *last_out = last < (int32_t)count ? last : (int32_t)count - 1;
}

// The voxels of the heights [low, high], in subdivisions, cut to the field. False when they lie outside.
static inline bool tl_voxel_span_of_heights(double low, double high, uint32_t height_voxels, uint32_t *min_out,
                                            uint32_t *max_out)
{
    // Bounded before the conversion, by more than rounding can bring back.
    const int32_t limit = (int32_t)height_voxels * TL_SUBDIVISIONS;
    int32_t bottom = tl_voxel_round(tl_clamp_f64(low, -TL_SUBDIVISIONS, (double)limit + TL_SUBDIVISIONS));
    int32_t top = tl_voxel_round(tl_clamp_f64(high, -TL_SUBDIVISIONS, (double)limit + TL_SUBDIVISIONS));
    if (top < 0 || bottom > limit) {
        return false;
    }
    bottom = bottom > 0 ? bottom : 0;
    top = top < limit ? top : limit;
    uint32_t min = (uint32_t)bottom >> TL_SUBDIVISION_BITS;
    uint32_t max = ((uint32_t)top + TL_SUBDIVISIONS - 1) >> TL_SUBDIVISION_BITS;
    *min_out = min;
    *max_out = max > min ? max : min + 1;
    return true;
}

// A triangle on its way through the rows of a band. Heights in subdivisions of a voxel.
typedef struct tl_voxel_walk {
    const tl_voxel_band *band;
    uint32_t area;
    bool level;  ///< all cells have the span [level_min, level_max)
    bool inside; ///< all heights lie inside the field
    bool beyond; ///< some of it lies left or right of the field
    uint32_t level_min, level_max;
    double *low, *high;           ///< of the row at hand
    double *next_low, *next_high; ///< of the row after it
    double left, right;           ///< of the piece in the row at hand
    double next_left, next_right;
} tl_voxel_walk;

// Adds the span of a column, for which there is room, if it is not outside the field.
static inline void tl_voxel_add_heights(const tl_voxel_walk *w, double low, double high, uint32_t column)
{
    uint32_t min, max;
    if (tl_voxel_span_of_heights(low, high, w->band->height_voxels, &min, &max)) {
        tl_span_buffer_add(w->band->buffer, column, min, max, w->area);
    }
}

/// Voxelizes a triangle of several rows and columns, the field's rows first..last in the band.
tl_result tl_voxelize_rows(tl_voxel_walk *w, const tl_voxel_point *const corners[3], int32_t first, int32_t last);

#endif
