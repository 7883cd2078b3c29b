// SPDX-License-Identifier: MIT
//
// What Assimp may open: the bytes that it is given, and regular files of their folder.

#ifndef TALUS_IO_ASSIMP_FILES_H
#define TALUS_IO_ASSIMP_FILES_H

#include "io/mesh/mesh_source.h"

#include <assimp/cfileio.h>

enum { TL_ASSIMP_NAME_BYTES = 512 };

/// A file system of one source.
typedef struct tl_assimp_files {
    struct aiFileIO io;
    const tl_mesh_source *source;
    char name[TL_ASSIMP_NAME_BYTES]; ///< what Assimp calls the source: a name of the source's kind, without a folder
    tl_io_error refused;             ///< the first file that was refused for where or what it is; TL_OK: none
} tl_assimp_files;

/// `files` must stay where it is while Assimp reads.
void tl_assimp_files_init(tl_assimp_files *files, const tl_mesh_source *source);

#endif
