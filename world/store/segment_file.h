// SPDX-License-Identifier: MIT
//
// A segment of the store: the triangles of an input, or of a part of it, in one file, cell by cell. Segments are never
// changed: an input that changed gets new ones, and what reads the store takes the sum of all.
//
// Layout, little-endian: a header of 192 bytes; the records (triangle_record.h), by cell, within a cell by their bytes;
// the index, 64 bytes a cell; the checksum of the index, 8 bytes.
//
//   header  0 magic "TLWSEG\r\n"   8 u32 version       12 u32 flags: 1, the input's last segment
//          16 f64 cell size       24 u64 triangles     32 u64 cells     40 u64 degenerate triangles left out
//          48 u64 first triangle of the input          56 u64 triangles read of it
//          64 f64 bounds, min and max, 6              112 u64 vertices that the input says it has
//         120 zeros               184 u64 checksum of bytes 0 to 183
//   cell    0 i32 level, x, y, z  16 u64 first record  24 u32 records   28 zero
//          32 f32 min x y z, max x y z from its origin 56 u64 checksum of its records

#ifndef TALUS_WORLD_SEGMENT_FILE_H
#define TALUS_WORLD_SEGMENT_FILE_H

#include "world/bytes/content_hash.h"
#include "world/bytes/random_read.h"
#include "world/store/triangle_record.h"

#include <talus/vec.h>

#define TL_WORLD_SEGMENT_MAGIC "TLWSEG\r\n"
#define TL_WORLD_STORE_VERSION 1u

enum { TL_WORLD_SEGMENT_HEADER = 192, TL_WORLD_SEGMENT_CELL = 64 };

typedef struct tl_world_segment_head {
    double cell_size;   ///< metres
    uint64_t triangles; ///< records
    uint64_t cells;
    uint64_t degenerate;   ///< left out, since they have no area
    uint64_t first, count; ///< which triangles of the input it was made from
    uint64_t vertices;     ///< of the input, in its last segment; else 0
    double bounds[6];      ///< metres, of the records; min above max when there are none
    bool last;             ///< of its input
} tl_world_segment_head;

typedef struct tl_world_segment_cell {
    tl_world_cell cell;
    uint64_t first; ///< record
    uint32_t count; ///< records, > 0
    tl_aabb bounds; ///< metres from the cell's origin
    uint64_t checksum;
} tl_world_segment_cell;

void tl_world_segment_head_encode(const tl_world_segment_head *head, unsigned char bytes_out[TL_WORLD_SEGMENT_HEADER]);
void tl_world_segment_cell_encode(const tl_world_segment_cell *cell, unsigned char bytes_out[TL_WORLD_SEGMENT_CELL]);

/// An open segment.
typedef struct tl_world_segment {
    char *path;
    tl_random_file file;
    tl_world_segment_head head;
    tl_world_segment_cell *cells; ///< [head.cells]; NULL: only the head was read
} tl_world_segment;

/// Opens a segment and checks its head, and with `with_index` its index; every count and place in it holds afterwards.
/// TL_ERR_IO, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_TRUNCATED, TL_ERR_HASH, TL_ERR_CORRUPT, TL_ERR_MEMORY. On failure
/// `*segment_out` is zeroed. Close it with tl_world_segment_close.
tl_result tl_world_segment_open(const char *path, bool with_index, tl_world_segment *segment_out,
                                tl_io_error *error_out);
void tl_world_segment_close(tl_world_segment *segment);

/// The records of a cell, checked, into `records_out` of `count * TL_WORLD_RECORD_BYTES` bytes. Thread safe.
tl_result tl_world_segment_read(const tl_world_segment *segment, uint64_t cell, unsigned char *records_out,
                                tl_io_error *error_out);

#endif
