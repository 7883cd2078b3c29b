// SPDX-License-Identifier: MIT
//
// The bytes of a glTF file: buffers loaded, compressed views decoded, accessors read.
//
// No count, offset or index of the file is trusted: what is read is compared with what is there, without overflow.

#ifndef TALUS_IO_GLTF_BUFFERS_H
#define TALUS_IO_GLTF_BUFFERS_H

#include "io/files/file_map.h"
#include "io/mesh/gltf_parser.h"
#include "io/mesh/mesh_source.h"

/// Bytes of one buffer or decoded view.
typedef struct tl_gltf_bytes {
    const unsigned char *bytes;
    size_t size;
    void *owned; ///< from the allocator, `size` bytes, or NULL
    tl_file_map map;
} tl_gltf_bytes;

/// A parsed file, and what its buffers hold so far: each is loaded when it is first read.
typedef struct tl_gltf_file {
    const tl_mesh_source *source;
    const tl_gltf_data *data;
    tl_gltf_bytes *buffers; ///< one a buffer
    tl_gltf_bytes *views;   ///< one a buffer view; filled for compressed views only
    tl_allocator allocator;
    tl_io_error *error;
} tl_gltf_file;

/// The arrays of `file`, whose source, data, allocator and error are set. TL_ERR_MEMORY.
tl_result tl_gltf_file_init(tl_gltf_file *file);
void tl_gltf_file_free(tl_gltf_file *file);

/// Reads `accessor` as floats, `width` an element (3: VEC3), `out` holding count * width; normalised integers become
/// fractions. TL_ERR_FORMAT: of another type, or beyond its buffer; errors of tl_sibling_open.
tl_result tl_gltf_read_floats(tl_gltf_file *file, uint32_t accessor, size_t width, float *out);

/// Reads `accessor` as indices, `out` holding count.
tl_result tl_gltf_read_indices(tl_gltf_file *file, uint32_t accessor, uint32_t *out);

/// Whether so many elements can be there: a count that only says so allocates nothing.
tl_result tl_gltf_check_accessor(tl_gltf_file *file, uint32_t accessor);

#endif
