// SPDX-License-Identifier: MIT
//
// Windows has no fork, and a library cannot start its caller's program anew: files are read in the calling process
// there, without limits. mesh_import.h says so.

#include "io/mesh/import_process.h"

tl_result tl_read_isolated(tl_mesh_reader *read_mesh, const tl_mesh_source *source, const tl_import_limits *limits,
                           const tl_host *host, tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    if (limits != NULL && (limits->seconds > 0 || limits->memory_bytes > 0)) {
        return tl_io_fail(error_out, TL_ERR_UNSUPPORTED, source->name, 0,
                          "leave the limits out for files that you trust", "reading cannot be limited on Windows");
    }
    return read_mesh(source, host != NULL ? host->allocator : NULL, mesh_out, error_out);
}
