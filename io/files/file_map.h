// SPDX-License-Identifier: MIT
//
// A whole file as read-only bytes: a copy in memory, or mapped where that is asked for.

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

/// Reads `path` ("-": standard input) into memory: whatever happens to the file afterwards, the bytes stay what they
/// are. Give them back with tl_file_map_close.
///
/// `max_bytes` is the largest size that is accepted, 0: no limit; a stream is not read beyond it. Errors: TL_ERR_IO
/// (with the system's reason; a folder is one), TL_ERR_LIMIT, TL_ERR_MEMORY. On failure `*map_out` is zeroed.
/// `error_out` may be NULL. Thread safe.
tl_result tl_file_read(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out);

/// The same, but mapped where the system can: no copy, and several processes share the memory. Only for files that
/// nobody writes to meanwhile. Whoever rewrites a mapped file changes bytes that a check has accepted, and every query
/// on them may crash; whoever cuts it short raises SIGBUS.
tl_result tl_file_map_open(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out);

/// Gives the bytes back. A zeroed map is allowed; the map is zeroed.
void tl_file_map_close(tl_file_map *map);

#ifdef __cplusplus
}
#endif

#endif
