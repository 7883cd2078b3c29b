// SPDX-License-Identifier: MIT
//
// Writing Wavefront OBJ, atomically: vertices, triangles and polygons.
//
// Coordinates are written with the fewest digits that read back as the same float (format_float.h), with a point
// whatever the locale is. The same calls give the same bytes.

#ifndef TALUS_IO_OBJ_WRITE_H
#define TALUS_IO_OBJ_WRITE_H

#include "io/files/io_error.h"

#include <talus/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/// An OBJ file being written. A failure sticks: later calls do nothing, and the commit reports the first one, so only
/// the commit's result need be looked at. Not thread safe.
typedef struct tl_obj_writer tl_obj_writer;

/// Starts to write `path` ("-": standard output). Errors as tl_atomic_file_open; then `*writer_out` is NULL.
tl_result tl_obj_writer_open(const char *path, tl_obj_writer **writer_out, tl_io_error *error_out);

/// A comment line. Line ends in `text` become blanks.
void tl_obj_writer_comment(tl_obj_writer *writer, const char *text);

/// `o NAME` and `usemtl NAME`. Line ends and leading blanks in the name become '_'.
void tl_obj_writer_object(tl_obj_writer *writer, const char *name);
void tl_obj_writer_material(tl_obj_writer *writer, const char *name);

/// Appends vertices, and returns the index of the first: faces name vertices by the order of all that were written.
/// A vertex that is not finite fails with TL_ERR_NOT_FINITE.
uint32_t tl_obj_writer_vertices(tl_obj_writer *writer, const tl_vec3 *vertices, uint32_t count);

/// A face of `count` >= 3 corners. An index at or beyond the vertices written so far fails with TL_ERR_INDEX.
void tl_obj_writer_face(tl_obj_writer *writer, const uint32_t *corners, uint32_t count);

/// `count` triangles, 3 indices each, to each of which `first_vertex` is added.
void tl_obj_writer_triangles(tl_obj_writer *writer, const uint32_t *indices, uint32_t count, uint32_t first_vertex);

/// Ends the file and frees the writer, whatever the outcome. The path then holds all of it, or what it held before.
tl_result tl_obj_writer_commit(tl_obj_writer *writer, tl_io_error *error_out);

/// Discards the file. NULL: nothing happens.
void tl_obj_writer_abort(tl_obj_writer *writer);

/// A whole mesh in one call: vertices, then triangles in order, with a `usemtl` wherever the material changes.
/// `material_names` is indexed by material id and may be NULL: "material_ID" then.
tl_result tl_obj_write_mesh(const char *path, const tl_mesh_view *mesh, const char *const *material_names,
                            uint32_t material_name_count, tl_io_error *error_out);

#ifdef __cplusplus
}
#endif

#endif
