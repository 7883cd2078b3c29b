// SPDX-License-Identifier: MIT
//
// Adding to the end of a file, for records that are told from one another by themselves. One source a system.

#ifndef TALUS_WORLD_APPEND_FILE_H
#define TALUS_WORLD_APPEND_FILE_H

#include "io/files/io_error.h"

/// Opens the file, which need not be there, adds the bytes at its end and closes it.
tl_result tl_file_append(const char *path, const void *bytes, size_t size, tl_io_error *error_out);

#endif
