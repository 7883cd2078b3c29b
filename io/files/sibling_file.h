// SPDX-License-Identifier: MIT
//
// Files that a file names, such as the buffers of a glTF: only regular files of its own folder and the folders below.

#ifndef TALUS_IO_SIBLING_FILE_H
#define TALUS_IO_SIBLING_FILE_H

#include "io/files/file_map.h"

/// Opens the file that `name` means to the file `path` (NULL: standard input, which has no siblings). `shown` names the
/// naming file in messages.
///
/// TL_ERR_UNSUPPORTED, before anything is opened: an absolute path, an address of the net ("http://..."), a path that
/// leaves the folder ("../x", also by a symbolic link), a folder, a device, a named pipe. TL_ERR_IO, TL_ERR_MEMORY as
/// tl_file_read.
tl_result tl_sibling_open(const char *path, const char *name, const char *shown, tl_file_map *map_out,
                          tl_io_error *error_out);

#endif
