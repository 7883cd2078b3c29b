// SPDX-License-Identifier: MIT
//
// Wavefront OBJ, read in one pass.
//
// Read: v, f, usemtl. Counted and ignored: vn and vt (unread), g, o, s, mtllib, p, l, and unknown keywords.
//  - `v x y z`, with w or r g b or both behind it; those must be numbers and are ignored (w is for curves only).
//  - `f` corners `v`, `v/vt`, `v//vn`, `v/vt/vn`; v counts from 1, or from -1 backwards; it may point ahead. vt and vn
//    must be integers and are ignored.
//  - A polygon is split from its first corner as a fan when it is convex, else along its ears in its own plane. Beyond
//    TL_MAX_SPLIT_CORNERS corners, or where no ears are found (it crosses itself), it is a fan and is counted.
//  - Lines end with LF, CRLF or CR; `\` before the line's end continues it; `#` begins a comment; a UTF-8 byte order
//    mark, leading blanks, tabs and a missing last line end are allowed.
//  - Numbers are read as strtof does in the C locale, correctly rounded, whatever the program's locale is.

#ifndef TALUS_IO_OBJ_READER_H
#define TALUS_IO_OBJ_READER_H

#include "io/files/io_error.h"
#include "io/mesh/imported_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Longest line, continuations included.
#define TL_MAX_OBJ_LINE_BYTES (1u << 20)

/// Longest keyword: anything longer is no OBJ file.
#define TL_MAX_OBJ_KEYWORD_BYTES 32u

/// Reads an OBJ text of `size` bytes. `path` is for messages only and may be NULL.
///
/// Memory is at most proportional to the text (under 30 bytes a byte of it, in the worst case): no count in it is
/// trusted. Errors, with line and element in `error_out` (may be NULL): TL_ERR_FORMAT (no number where one must be,
/// fewer than 3 corners, binary content, UTF-16), TL_ERR_NOT_FINITE (nan or inf), TL_ERR_RANGE (a number beyond
/// FLT_MAX), TL_ERR_INDEX, TL_ERR_LIMIT (line, keyword, count of vertices, triangles or materials), TL_ERR_EMPTY (no
/// vertices; or no faces, unless `allow_no_faces`), TL_ERR_MEMORY, TL_ERR_CANCELLED. On failure `*mesh_out` is zeroed.
/// `host` may be NULL; its allocator and progress (stage "read mesh", bytes) are used.
tl_result tl_obj_read(const void *text, size_t size, const char *path, bool allow_no_faces, const tl_host *host,
                      tl_imported_mesh *mesh_out, tl_io_error *error_out);

/// A text, and the point that becomes 0,0,0: it is subtracted in double before coordinates are rounded to floats, so
/// that a level far from its origin keeps its shape.
typedef struct tl_obj_source {
    const void *text;
    size_t size;
    const char *path; ///< as for tl_obj_read
    bool allow_no_faces;
    double origin[3];
} tl_obj_source;

/// tl_obj_read with an origin.
tl_result tl_obj_read_source(const tl_obj_source *source, const tl_host *host, tl_imported_mesh *mesh_out,
                             tl_io_error *error_out);

#ifdef __cplusplus
}
#endif

#endif
