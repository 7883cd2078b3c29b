// SPDX-License-Identifier: MIT
//
// The statements of an OBJ file, line by line.

#ifndef TALUS_IO_OBJ_STATEMENTS_H
#define TALUS_IO_OBJ_STATEMENTS_H

#include "io/mesh/obj_reader.h"

#define TL_OBJ_STAGE "read mesh" // of progress

/// A face of more than three corners, which lies there as a fan of triangles.
typedef struct tl_obj_polygon {
    uint32_t first_triangle;
    uint32_t corner_count;
} tl_obj_polygon;

/// What has been read so far.
typedef struct tl_obj_state {
    tl_imported_mesh *mesh;
    const char *path;
    const tl_host *host;
    tl_io_error *error;
    tl_result result; // of the failure that a reading function has returned NULL for
    const char *end;  // of the section that is read; see text_scan.h
    uint64_t line;    // of the reading position, from 1
    uint32_t material;
    const double *origin; // NULL: 0,0,0
    // The furthest vertex that a face pointed ahead to, and the face's line; 0 when none did.
    uint32_t ahead_index;
    uint64_t ahead_line;
    uint64_t ahead_face;
    tl_obj_polygon *polygons;
    uint64_t polygon_count;
    uint64_t polygon_capacity;
    size_t size; // of the text
    size_t section_offset;
    size_t next_progress;
} tl_obj_state;

/// Reads a section of the text, whole lines that end at `end`, where a line end must stand (text_scan.h). Polygons are
/// noted, and left as fans. TL_ERR_FORMAT, TL_ERR_INDEX, TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_LIMIT, TL_ERR_MEMORY,
/// TL_ERR_CANCELLED: told in state->error.
tl_result tl_obj_read_section(tl_obj_state *state, const char *text, const char *end);

#endif
