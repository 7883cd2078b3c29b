// SPDX-License-Identifier: MIT
//
// Triangles in any order and number become segments, each as large as memory allows.
//
// An external sort would merge its runs into one file, and write every byte twice. The runs are left as they are:
// whoever reads a window reads it in each segment, and what must not depend on order is a sum over all.

#ifndef TALUS_WORLD_SEGMENT_BUILDER_H
#define TALUS_WORLD_SEGMENT_BUILDER_H

#include "world/store/segment_file.h"

typedef struct tl_world_builder tl_world_builder;

/// Writes `<stem>.<n>.segment`, n from `first_number` on, for the triangles of an input from its `first_triangle` on.
/// `memory`: bytes that may be held at one time, one MiB at least. NULL: out of memory.
tl_world_builder *tl_world_builder_create(const char *stem, double cell_size, uint64_t memory, uint32_t first_number,
                                          uint64_t first_triangle);

/// Takes a triangle. TL_ERR_NOT_FINITE, TL_ERR_RANGE: with its number in the input; and what writing returns.
tl_result tl_world_builder_add(tl_world_builder *builder, const tl_world_triangle *triangle, tl_io_error *error_out);

/// Writes the last segment, also when it is empty.
tl_result tl_world_builder_finish(tl_world_builder *builder, uint64_t vertices, tl_io_error *error_out);
void tl_world_builder_free(tl_world_builder *builder);

/// "<stem>.<n>.segment", freed with free(); NULL: out of memory.
char *tl_world_segment_path(const char *stem, uint32_t number);

#endif
