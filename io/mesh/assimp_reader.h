// SPDX-License-Identifier: MIT
//
// Mesh files of every other kind (FBX, STL, PLY, Collada, 3DS ...), read by Assimp. Only assimp_reader.c and
// assimp_files.h include its headers.

#ifndef TALUS_IO_ASSIMP_READER_H
#define TALUS_IO_ASSIMP_READER_H

#include "io/mesh/mesh_source.h"

/// Whether Assimp reads files of this extension (with its point, any case).
bool tl_assimp_knows(const char *extension);

/// A tl_mesh_reader. A damaged file may make Assimp abort, crash or loop for ever: import_process.h guards against
/// that.
tl_result tl_assimp_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out);

#endif
