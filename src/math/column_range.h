// SPDX-License-Identifier: MIT
//
// Which columns of a field of square cells an interval along one axis covers.

#ifndef TALUS_SRC_MATH_COLUMN_RANGE_H
#define TALUS_SRC_MATH_COLUMN_RANGE_H

#include <stdint.h>

/// A field's columns along one axis. Column i has its centre at origin + (first_column + i + 0.5) * cell_size.
typedef struct tl_column_axis {
    float origin;         ///< metres
    float cell_size;      ///< metres, > 0
    int32_t first_column; ///< in the level's lattice
    uint32_t count;
} tl_column_axis;

/// The number, not rounded, of the column that has its centre at `at`, metres.
static inline double tl_column_of_center(const tl_column_axis *axis, float at)
{
    const double shift = (double)axis->first_column + 0.5;
    return ((double)at - (double)axis->origin) / (double)axis->cell_size - shift;
}

/// Columns [*first, *end) of the field that lie in [low, high); none when either is NaN.
static inline void tl_clamp_columns(const tl_column_axis *axis, double low, double high, uint32_t *first, uint32_t *end)
{
    *first = *end = 0;
    if (low < high && high > 0.0 && low < (double)axis->count) {
        *first = low > 0.0 ? (uint32_t)low : 0;
        *end = high < (double)axis->count ? (uint32_t)high : axis->count;
    }
}

#endif
