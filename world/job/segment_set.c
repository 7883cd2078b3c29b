// SPDX-License-Identifier: MIT

#include "world/job/segment_set.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_OPEN = 256 }; // files; systems allow 1024 at least, and the others are opened for each read

static tl_result open_input(const char *folder, const tl_world_stored *input, tl_world_segments *segments,
                            tl_io_error *error_out)
{
    tl_result result = TL_OK;
    char *stem = tl_world_segment_stem(folder, input->name);
    for (uint32_t n = 0; n < input->segments && result == TL_OK; n++) {
        char *path = stem != NULL ? tl_world_segment_path(stem, n) : NULL;
        tl_world_segment *segment = &segments->items[segments->count];
        if (path == NULL) {
            result = tl_io_fail(error_out, TL_ERR_MEMORY, folder, 0, "", "out of memory");
        } else {
            result = tl_world_segment_open(path, true, segment, error_out);
        }
        free(path);
        if (result == TL_OK) {
            if (segments->count >= MAX_OPEN) {
                tl_random_file_close(&segment->file);
            }
            segments->inputs[segments->count] = input->name;
            segments->numbers[segments->count++] = n;
        }
    }
    free(stem);
    return result;
}

tl_result tl_world_segments_open(const char *folder, const tl_world_stored *inputs, uint32_t input_count,
                                 tl_world_segments *segments_out, tl_io_error *error_out)
{
    uint64_t count = 1;
    memset(segments_out, 0, sizeof *segments_out);
    for (uint32_t i = 0; i < input_count; i++) {
        count += inputs[i].segments;
    }
    if (count > UINT32_MAX / 256) {
        return tl_io_fail(error_out, TL_ERR_LIMIT, folder, 0, "give more --memory", "the store has too many segments");
    }
    segments_out->items = calloc((size_t)count, sizeof *segments_out->items);
    segments_out->inputs = calloc((size_t)count, sizeof *segments_out->inputs);
    segments_out->numbers = calloc((size_t)count, sizeof *segments_out->numbers);
    tl_result result = TL_OK;
    if (segments_out->items == NULL || segments_out->inputs == NULL || segments_out->numbers == NULL) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, folder, 0, "", "out of memory");
    }
    for (uint32_t i = 0; i < input_count && result == TL_OK; i++) {
        result = open_input(folder, &inputs[i], segments_out, error_out);
    }
    if (result != TL_OK) {
        tl_world_segments_close(segments_out);
    }
    return result;
}

void tl_world_segments_close(tl_world_segments *segments)
{
    for (uint32_t i = 0; i < segments->count; i++) {
        tl_world_segment_close(&segments->items[i]);
    }
    free(segments->items);
    free(segments->inputs);
    free(segments->numbers);
    memset(segments, 0, sizeof *segments);
}
