// SPDX-License-Identifier: MIT
//
// A merged file opened for reading: by a world, and by its index.

#ifndef TALUS_WORLD_READER_H
#define TALUS_WORLD_READER_H

#include "world/bytes/random_read.h"

#include <talus/pack.h>

/// A file that a world reads from. `error` is that of the first read that failed.
typedef struct tl_world_reader {
    tl_random_file file;
    const char *path;
    tl_io_error error;
    void *index_bytes;   ///< NULL, or what `index` points into
    tl_pack_index index; ///< after tl_world_reader_index
} tl_world_reader;

tl_result tl_world_reader_open(const char *path, tl_world_reader *reader_out, tl_io_error *error_out);
/// A tl_nav_world_read_fn; `user` is a tl_world_reader.
tl_result tl_world_reader_read(uint64_t offset, void *bytes, size_t size, void *user);
/// Reads the file's index, and holds it to the size of the file.
tl_result tl_world_reader_index(tl_world_reader *reader, tl_io_error *error_out);
void tl_world_reader_close(tl_world_reader *reader);
/// What a call that read gave, in words: the reader's own error, or the report's.
tl_result tl_world_reader_fail(const tl_world_reader *reader, tl_result result, const tl_report *report,
                               tl_io_error *error_out);

#endif
