// SPDX-License-Identifier: MIT
//
// Mesh files of every other kind (glTF, FBX, STL, PLY, Collada, 3DS ...), read by Assimp. Only assimp_reader.c includes
// its headers.

#ifndef TALUS_IO_ASSIMP_READER_H
#define TALUS_IO_ASSIMP_READER_H

#include "io/files/io_error.h"
#include "io/mesh/imported_mesh.h"

#include <stddef.h>

/// Whether Assimp reads files of this extension (with its point, any case).
bool tl_assimp_knows(const char *extension);

/// What to read: the file `path` when `hint` is NULL, so that files beside it (glTF buffers) are found; else `bytes`,
/// as a file of the kind that `hint` names ("stl").
typedef struct tl_assimp_source {
    const char *path; ///< with a hint: for error messages alone
    const void *bytes;
    size_t size; ///< of the file or the bytes
    const char *hint;
    bool allow_no_triangles; ///< a point cloud is no failure
} tl_assimp_source;

/// See tl_import_mesh for what is done and which errors there are. A damaged file may make Assimp abort, crash or loop
/// for ever: assimp_process.h guards against that.
tl_result tl_assimp_read(const tl_assimp_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out);

#endif
