// SPDX-License-Identifier: MIT
//
// Writing polygon meshes as text, `navpolys 1` (docs/guide/polygons.md).

#ifndef TALUS_IO_POLYGON_TEXT_WRITE_H
#define TALUS_IO_POLYGON_TEXT_WRITE_H

#include <talus/polygon.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Takes the next bytes of the text. Any result but TL_OK ends the writing and is returned.
typedef tl_result tl_text_sink_fn(const char *bytes, size_t size, void *user);

/// `name` and `producer` stand in the text's head, `cpu_us` is the processor time in microseconds. What `sink` returns.
tl_result tl_polygon_text_write(const tl_polygon_mesh *mesh, const char *name, const char *producer,
                                uint32_t bad_triangulations, double cpu_us, tl_text_sink_fn *sink, void *user);

#ifdef __cplusplus
}
#endif

#endif
