// SPDX-License-Identifier: MIT
//
// A whole file as read-only bytes: mapped where the system can, read where it cannot (pipes, standard input, files of
// /proc that claim size 0).

#ifndef TALUS_IO_FILE_MAP_H
#define TALUS_IO_FILE_MAP_H

#include "io/files/io_error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_file_map {
    const void *bytes; ///< aligned to TL_BLOB_ALIGNMENT; never NULL after a successful open, even of an empty file
    size_t size;
    bool mapped; ///< false: a copy in memory
} tl_file_map;

/// Opens `path` ("-": standard input) and makes its bytes readable until tl_file_map_close.
///
/// `max_bytes` is the largest size that is accepted, 0: no limit; a stream is not read beyond it. A mapped file that
/// another process cuts short while it is read raises SIGBUS, as with every mapping: files under change are to be
/// piped in instead. Errors: TL_ERR_IO (with the system's reason; a folder is one), TL_ERR_LIMIT,
/// TL_ERR_MEMORY. On failure `*map_out` is zeroed. `error_out` may be NULL. Thread safe.
tl_result tl_file_map_open(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out);

/// Gives the bytes back. A zeroed map is allowed; the map is zeroed.
void tl_file_map_close(tl_file_map *map);

#ifdef __cplusplus
}
#endif

#endif
