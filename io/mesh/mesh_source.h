// SPDX-License-Identifier: MIT
//
// What a reader of meshes is given.

#ifndef TALUS_IO_MESH_SOURCE_H
#define TALUS_IO_MESH_SOURCE_H

#include "io/files/io_error.h"
#include "io/mesh/imported_mesh.h"

#include <stddef.h>

typedef struct tl_mesh_source {
    const char *name; ///< for messages
    const char *path; ///< its folder is where files beside it are looked for; NULL: nowhere (standard input)
    const void *bytes;
    size_t size;
    const char *kind;        ///< its extension without the point ("stl")
    bool allow_no_triangles; ///< a point cloud is no failure
    double origin[3];        ///< this point of the file becomes 0,0,0: a reader that does so says it in mesh->origin
} tl_mesh_source;

/// A reader. See tl_import_mesh for what is done and which errors there are.
typedef tl_result tl_mesh_reader(const tl_mesh_source *source, const tl_allocator *allocator,
                                 tl_imported_mesh *mesh_out, tl_io_error *error_out);

#endif
