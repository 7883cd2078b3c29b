// SPDX-License-Identifier: MIT
//
// The rows of solid spans that a sweep asks for one after the other: those of a field that is whole, or of a band that
// the rasterizer has filled, whose lists are merged a row at a time, while the row is in the cache.

#ifndef TALUS_SRC_NAV_BAKE_ROW_SOURCE_H
#define TALUS_SRC_NAV_BAKE_ROW_SOURCE_H

#include "nav_bake/voxels/span_buffer.h"
#include "nav_bake/voxels/span_rows.h"

typedef struct tl_row_source {
    tl_span_rows rows;      ///< all rows; of a buffer, the one that was asked for last
    tl_span_buffer *buffer; ///< NULL: the rows are there
    uint32_t first_row;     ///< of the buffer
    uint32_t *first_span;   ///< [rows.width + 1] of the buffer's row
} tl_row_source;

/// Makes row z of the field the one to read.
static inline tl_result tl_row_source_seek(tl_row_source *source, uint32_t z)
{
    if (source->buffer == NULL) {
        return TL_OK;
    }
    const uint32_t width = source->rows.width, begin = (z - source->first_row) * width;
    source->rows.first_row = z;
    source->rows.first_span = source->first_span;
    return tl_span_buffer_merge_columns(source->buffer, begin, begin + width, source->first_span, &source->rows.spans);
}

#endif
