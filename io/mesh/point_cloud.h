// SPDX-License-Identifier: MIT
//
// Reading point clouds: the input of hulls.
//
// Three kinds, recognised by their content:
//  - points: a line `x y z` each; one cloud
//  - clouds: a line `N`, then N lines `x y z`; any number of times
//  - a mesh file of any kind: its vertices, one cloud
// In the first two, numbers are separated by blanks, tabs or commas; `#` begins a comment; empty lines are skipped.

#ifndef TALUS_IO_POINT_CLOUD_H
#define TALUS_IO_POINT_CLOUD_H

#include "io/files/io_error.h"
#include "io/mesh/mesh_import.h"

#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Clouds of one file, one after another. Free with tl_point_clouds_free. To be read only.
typedef struct tl_point_clouds {
    tl_vec3 *points; ///< of all clouds; every coordinate is finite
    uint32_t point_count;
    uint32_t *first_points; ///< [cloud_count + 1]: cloud i is points[first_points[i]] up to points[first_points[i + 1]]
    uint32_t cloud_count;   ///< >= 1; a cloud may be empty (N of 0)
    tl_allocator allocator;
    uint32_t point_capacity; ///< what the arrays could hold; the reader's own
    uint32_t cloud_capacity;
} tl_point_clouds;

/// One cloud of a file.
typedef struct tl_point_cloud {
    const tl_vec3 *points;
    uint32_t count;
} tl_point_cloud;

/// Reads `path` ("-": standard input). `options` NULL: the defaults; `allow_no_triangles` is taken as set.
///
/// An announced count is not trusted: memory grows with the points that are there. Errors as tl_import_mesh, with the
/// line; TL_ERR_TRUNCATED when a cloud ends early; TL_ERR_EMPTY when there is not one point or cloud. On failure
/// `*clouds_out` is zeroed.
tl_result tl_point_clouds_read(const char *path, const tl_import_options *options, tl_point_clouds *clouds_out,
                               tl_io_error *error_out);

/// The same of text in memory, for the first two kinds only. `path` is for messages.
tl_result tl_point_clouds_parse(const void *text, size_t size, const char *path, const tl_import_options *options,
                                tl_point_clouds *clouds_out, tl_io_error *error_out);

/// Cloud `index` < cloud_count. Valid while `clouds` lives.
tl_point_cloud tl_point_clouds_get(const tl_point_clouds *clouds, uint32_t index);

void tl_point_clouds_free(tl_point_clouds *clouds);

#ifdef __cplusplus
}
#endif

#endif
