// SPDX-License-Identifier: MIT
//
// Reading any mesh file by one call.
//
// OBJ, glTF and GLB are read by our own readers (obj_reader.h, gltf_reader.h); FBX, STL, PLY, Collada (DAE)
// and every other format that Assimp knows, by Assimp. The file's name decides, then its first bytes: a file without a
// known extension, or standard input ("-"), is recognised by its content. A build without Assimp or Jansson (CMake's
// TALUS_ASSIMP and TALUS_GLTF) knows those kinds too, and refuses them by the library's name.

#ifndef TALUS_IO_MESH_IMPORT_H
#define TALUS_IO_MESH_IMPORT_H

#include "io/files/io_error.h"
#include "io/mesh/imported_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which axis of the file points up. talus has y up and is right-handed.
typedef enum tl_up_axis {
    TL_UP_Y,      ///< taken as it is
    TL_UP_Z,      ///< turned by -90 degrees about x: (x, y, z) becomes (x, z, -y), as exporters of z-up tools do
    TL_UP_Y_LEFT, ///< left-handed, as in Unity: (x, y, z) becomes (x, y, -z), and triangles are wound the other way
    TL_UP_Z_LEFT, ///< left-handed, as in Unreal: (x, y, z) becomes (x, z, y), and triangles are wound the other way
} tl_up_axis;

/// What the process that reads anything but OBJ may use, where the system can limit it. A file of S bytes has 10 s and
/// one more for each MB of processor time, four times that by the wall clock, and 4 GiB and 64 S of memory; a value
/// that is not 0 is used instead.
typedef struct tl_import_limits {
    uint32_t seconds;      ///< of processor time, and by the wall clock
    uint64_t memory_bytes; ///< not counted with -fsanitize=address
} tl_import_limits;

/// Files that state their unit and axes (FBX, Collada; glTF is in metres, y up) come in metres, y up, by themselves:
/// up_axis and unit_scale are applied to what they give, and are for other files and for wrong statements.
typedef struct tl_import_options {
    tl_up_axis up_axis;
    double origin[3]; ///< in the file's units and axes: this point becomes 0,0,0. OBJ subtracts it before it rounds to
                      ///< floats, glTF from its nodes' places; other formats have rounded already
    bool auto_origin; ///< `origin` is chosen: on axes where the level lies far out, its middle, in whole units; else 0
    float unit_scale; ///< metres a file unit, finite and > 0; 0.01 for a file in centimetres
    bool allow_no_triangles; ///< a file with vertices only is no error (point clouds)
    uint64_t max_file_bytes; ///< 0: no limit
    tl_import_limits limits; ///< zeroed: the defaults
    tl_host host;            ///< allocator, and progress (stage "read mesh", done and total in bytes)
} tl_import_options;

/// y up, metres, triangles needed, no size limit.
tl_import_options tl_default_import_options(void);

/// Reads the mesh file `path`.
///
/// Node transforms are applied (a mesh that several nodes show is there several times); triangles of a mirrored node
/// are re-wound, so they face the way their author saw; polygons are split; points and lines are counted and ignored.
/// Triangles keep the file's order, so the same file gives the same mesh. `options` NULL: the defaults.
///
/// Errors, each with file, place and advice in `error_out` (may be NULL): TL_ERR_IO, TL_ERR_FORMAT,
/// TL_ERR_UNSUPPORTED (a kind of file, or an extension that it requires, that is not known), TL_ERR_EMPTY (no
/// triangles), TL_ERR_NOT_FINITE, TL_ERR_RANGE (a coordinate does not fit a float), TL_ERR_INDEX, TL_ERR_LIMIT,
/// TL_ERR_ARGUMENT, TL_ERR_MEMORY, TL_ERR_CANCELLED. On failure `*mesh_out` is zeroed. All but OBJ is read in a child
/// process with limits, so that a file that makes a reader crash or loop for ever is an error too (import_process.h);
/// the child's memory is not the host's allocator's. On Windows that needs tl_import_child_main. A file that the level
/// names (a glTF's buffer) is opened only when it is a regular file of the level's folder or below.
tl_result tl_import_mesh(const char *path, const tl_import_options *options, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out);

/// Call it first in main() of a program that reads files of strangers on Windows; it does nothing elsewhere. Windows
/// has no fork: the process that reads is your program started anew, in which this call reads, answers and ends it.
/// Without it files are read in the calling process there, unguarded, and limits other than zeros are
/// TL_ERR_UNSUPPORTED.
void tl_import_child_main(void);

/// The same of a file that is in memory already. `path` names it, and is where files beside it are looked for; "-" is
/// standard input, of which nothing more is read.
tl_result tl_import_mesh_bytes(const void *bytes, size_t size, const char *path, const tl_import_options *options,
                               tl_imported_mesh *mesh_out, tl_io_error *error_out);

/// For readers of other kinds: checks the options' values, and turns and scales vertices as they say.
tl_result tl_import_options_check(const tl_import_options *options, const char *path, tl_io_error *error_out);
tl_result tl_import_place_vertices(const tl_import_options *options, const char *path, tl_vec3 *vertices,
                                   uint32_t count, tl_io_error *error_out);

/// For readers of other kinds: whether the path's extension names a kind of mesh file.
bool tl_import_is_mesh_name(const char *path);

#ifdef __cplusplus
}
#endif

#endif
