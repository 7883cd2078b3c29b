// SPDX-License-Identifier: MIT
//
// Routes of a merged file: baked and put into it; and such a file opened for answers.

#ifndef TALUS_WORLD_ROUTE_FILE_H
#define TALUS_WORLD_ROUTE_FILE_H

#include "world/bytes/random_read.h"

#include <talus/nav_routes.h>

/// A file that a world reads from. `error` is that of the first read that failed.
typedef struct tl_world_reader {
    tl_random_file file;
    const char *path;
    tl_io_error error;
} tl_world_reader;

tl_result tl_world_reader_open(const char *path, tl_world_reader *reader_out, tl_io_error *error_out);
/// A tl_nav_world_read_fn; `user` is a tl_world_reader.
tl_result tl_world_reader_read(uint64_t offset, void *bytes, size_t size, void *user);
void tl_world_reader_close(tl_world_reader *reader);
/// What a call that read gave, in words: the reader's own error, or the report's.
tl_result tl_world_reader_fail(const tl_world_reader *reader, tl_result result, const tl_report *report,
                               tl_io_error *error_out);

typedef struct tl_world_routes_def {
    const char *input, *output; ///< paths of a merged file and of the one with routes; may be the same
    uint32_t block;             ///< of tl_nav_routes_def; 0: its default
    tl_host host;               ///< its progress is used
} tl_world_routes_def;

typedef struct tl_world_routes_report {
    uint64_t gates, lengths;
    uint64_t route_bytes, bytes; ///< of the chunk, of the file
    uint64_t tiles;
} tl_world_routes_report;

/// Writes a merged file again with its routes, in place of those that it had. The same input gives the same bytes.
tl_result tl_world_add_routes(const tl_world_routes_def *def, tl_world_routes_report *report_out,
                              tl_io_error *error_out);

#endif
