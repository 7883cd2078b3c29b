// SPDX-License-Identifier: MIT
//
// Mesh files of every other kind, read by Assimp. Only assimp_reader.c knows its headers.

#ifndef TALUS_IO_ASSIMP_READER_H
#define TALUS_IO_ASSIMP_READER_H

#include "io/files/io_error.h"
#include "io/mesh/imported_mesh.h"

#include <stddef.h>

/// Whether Assimp reads files of this extension (with its point, any case).
bool tl_assimp_knows(const char *extension);

/// Reads `path` when `hint` is NULL, so that files beside it (glTF buffers) are found; else the `size` bytes at `bytes`
/// as a file of the kind that `hint` names ("stl"). See tl_import_mesh for what is done and which errors there are.
/// A damaged file may make Assimp abort, crash or run for ever: assimp_process.h holds that off.
tl_result tl_assimp_read(const char *path, const void *bytes, size_t size, const char *hint, bool allow_no_triangles,
                         const tl_allocator *allocator, tl_imported_mesh *mesh_out, tl_io_error *error_out);

#endif
