// SPDX-License-Identifier: MIT
//
// The solid spans of a run of rows, as the rasterizer leaves them and a heightfield holds them.

#ifndef TALUS_SRC_NAV_BAKE_SPAN_ROWS_H
#define TALUS_SRC_NAV_BAKE_SPAN_ROWS_H

#include <talus/nav_bake.h>

/// The spans of some rows of a field: column x of row z has spans[first_span[k]] .. spans[first_span[k + 1] - 1], with
/// k = (z - first_row) * width + x.
typedef struct tl_span_rows {
    const tl_nav_span *spans;
    const uint32_t *first_span;
    uint32_t width, field_height;
    uint32_t first_row;
} tl_span_rows;

static inline const uint32_t *tl_span_rows_at(const tl_span_rows *rows, uint32_t z)
{
    return rows->first_span + (size_t)(z - rows->first_row) * rows->width;
}

#endif
