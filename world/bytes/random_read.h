// SPDX-License-Identifier: MIT
//
// Reading anywhere in a file that is larger than memory. Not mapped: pages of a mapped file count as the process's
// memory, and a file that shrinks would end it. One source a system.

#ifndef TALUS_WORLD_RANDOM_READ_H
#define TALUS_WORLD_RANDOM_READ_H

#include "io/files/io_error.h"

#include <stdint.h>

/// An open file. All zero is closed. Reads of one file from several threads are independent.
typedef struct tl_random_file {
    intptr_t handle;
    int is_open;
} tl_random_file;

tl_result tl_random_file_open(const char *path, tl_random_file *file_out, tl_io_error *error_out);
/// Reads exactly `size` bytes at `offset`. TL_ERR_TRUNCATED: the file ends before that. `path` is for messages.
tl_result tl_random_file_read(const tl_random_file *file, const char *path, uint64_t offset, void *bytes, size_t size,
                              tl_io_error *error_out);
/// Lets the system use its memory of an open file for something else: it will not be read again soon. A hint.
void tl_random_file_forget(const tl_random_file *file);
void tl_random_file_close(tl_random_file *file);

#endif
