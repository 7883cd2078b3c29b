// SPDX-License-Identifier: MIT
//
// All segments of a world, open.

#ifndef TALUS_WORLD_SEGMENT_SET_H
#define TALUS_WORLD_SEGMENT_SET_H

#include "world/input/read_input.h"

typedef struct tl_world_segments {
    tl_world_segment *items; ///< in the order of inputs
    tl_content_hash *inputs; ///< [count] the name of each one's input
    uint32_t *numbers;       ///< [count] among its input's segments
    uint32_t count;
} tl_world_segments;

/// Opens the segments of inputs, with their indexes. On failure nothing is open. Free with tl_world_segments_close.
tl_result tl_world_segments_open(const char *folder, const tl_world_stored *inputs, uint32_t input_count,
                                 tl_world_segments *segments_out, tl_io_error *error_out);
void tl_world_segments_close(tl_world_segments *segments);

#endif
