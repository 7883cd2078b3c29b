// SPDX-License-Identifier: MIT
//
// Contour sets and polygon meshes as text: `navcontours 1` and `navpolys 1`. docs/polygon.md describes both formats.
//
// A file holds any number of sets one after another, so reading goes set by set from bytes in memory.

#ifndef TALUS_IO_CONTOUR_TEXT_H
#define TALUS_IO_CONTOUR_TEXT_H

#include "io/files/io_error.h"

#include <talus/polygon.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_TEXT_NAME_BYTES 128

/// Where a reader is. Zero, then bytes, size, path and allocator.
typedef struct tl_contour_reader {
    const char *bytes;
    size_t size;
    const char *path;              ///< for error messages; may be NULL
    const tl_allocator *allocator; ///< NULL: malloc
    size_t offset;
    uint64_t line; ///< lines read so far
} tl_contour_reader;

/// A contour set that owns its arrays.
typedef struct tl_contour_text {
    tl_contour_set set;
    char name[TL_TEXT_NAME_BYTES]; ///< cut at that length
    uint32_t max_verts_per_poly;   ///< 0 when the file does not say
    uint64_t vertex_capacity;      ///< of the arrays that set.vertices and set.contours point at
    uint64_t contour_capacity;
    tl_allocator allocator;
} tl_contour_text;

/// Whether only blank lines are left.
bool tl_contour_reader_at_end(tl_contour_reader *reader);

/// Reads the next contour set. Errors name file and line: TL_ERR_MAGIC (another kind of file), TL_ERR_VERSION,
/// TL_ERR_FORMAT, TL_ERR_TRUNCATED, TL_ERR_MEMORY; then `*text_out` is zeroed. Free with tl_contour_text_free.
tl_result tl_contour_text_read(tl_contour_reader *reader, tl_contour_text *text_out, tl_io_error *error_out);
void tl_contour_text_free(tl_contour_text *text);

/// A polygon mesh with what the text says beside it.
typedef struct tl_polygon_text {
    tl_polygon_mesh mesh; ///< bounds and cells are not in the text: 0. contours[p]: TL_SEVERAL_CONTOURS
    char name[TL_TEXT_NAME_BYTES];
    char producer[TL_TEXT_NAME_BYTES];
    bool ok;
    uint32_t bad_triangulations;
    double cpu_us;
    tl_allocator allocator;
} tl_polygon_text;

/// Reads the next polygon mesh; corners and neighbours that do not exist are refused, nothing else is judged
/// (tl_polygon_mesh_check does that). Errors: TL_ERR_FORMAT, TL_ERR_TRUNCATED, TL_ERR_MEMORY.
tl_result tl_polygon_text_read(tl_contour_reader *reader, tl_polygon_text *text_out, tl_io_error *error_out);
void tl_polygon_text_free(tl_polygon_text *text);

/// Where text goes to. Anything but TL_OK ends the writing and is handed on.
typedef tl_result tl_text_sink_fn(const char *bytes, size_t size, void *user);

tl_result tl_contour_text_write(const tl_contour_set *set, const char *name, uint32_t max_verts_per_poly,
                                tl_text_sink_fn *sink, void *user);
tl_result tl_polygon_text_write(const tl_polygon_mesh *mesh, const char *name, const char *producer,
                                uint32_t bad_triangulations, double cpu_us, tl_text_sink_fn *sink, void *user);

#ifdef __cplusplus
}
#endif

#endif
