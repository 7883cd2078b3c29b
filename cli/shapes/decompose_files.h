// SPDX-License-Identifier: MIT
//
// What talus decompose writes: the parts as objects of an OBJ file, or a picture of them.

#ifndef TALUS_CLI_DECOMPOSE_FILES_H
#define TALUS_CLI_DECOMPOSE_FILES_H

#include "io/files/io_error.h"

#include <talus/decompose.h>

/// Writes the parts to `path`: PNG or SVG by its ending, else OBJ, an object each. Each is moved away from the middle
/// of all by `apart` times its distance from it. `title`: the mesh's name, for the picture. Errors: TL_ERR_IO,
/// TL_ERR_MEMORY, TL_ERR_CANCELLED; `error_out` says more.
tl_result tl_decomposition_write(const tl_decomposition *decomposition, float apart, const char *path,
                                 const char *title, const tl_host *host, tl_io_error *error_out);

#endif
