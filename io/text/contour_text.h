// SPDX-License-Identifier: MIT
//
// Contour sets as text, `navcontours 1` (docs/guide/polygons.md). A file holds any number of sets one after another:
// they are read set by set from bytes in memory.

#ifndef TALUS_IO_CONTOUR_TEXT_H
#define TALUS_IO_CONTOUR_TEXT_H

#include "io/text/line_words.h"

#include <talus/polygon.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_TEXT_NAME_BYTES 128

/// A contour set that owns its arrays.
typedef struct tl_contour_text {
    tl_contour_set set;
    char name[TL_TEXT_NAME_BYTES]; ///< cut at that length
    uint32_t max_verts_per_poly;   ///< 0 when the file does not say
    uint64_t vertex_capacity;      ///< of the arrays that set.vertices and set.contours point at
    uint64_t contour_capacity;
    tl_allocator allocator;
} tl_contour_text;

/// Reads the next contour set. Errors name file and line: TL_ERR_MAGIC (another kind of file), TL_ERR_VERSION,
/// TL_ERR_FORMAT, TL_ERR_TRUNCATED, TL_ERR_MEMORY; then `*text_out` is zeroed. Free with tl_contour_text_free.
tl_result tl_contour_text_read(tl_text_reader *reader, tl_contour_text *text_out, tl_io_error *error_out);
void tl_contour_text_free(tl_contour_text *text);

#ifdef __cplusplus
}
#endif

#endif
