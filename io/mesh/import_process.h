// SPDX-License-Identifier: MIT
//
// Reading in a process of its own.
//
// Assimp 5 answers some damaged files with a failed assertion (a PLY whose face list is cut), an endless loop (a PLY
// whose header is cut) or a wild pointer. A level that cannot be read must not take the calling program down, so the
// file is read by a child process with limits on its processor time, wall clock and memory, and what it found comes
// back through a pipe; on Linux the system refuses it all else (child_sandbox.h). What comes back is not trusted
// either: counts, indices and coordinates are checked again. The copy costs a few milliseconds for a million triangles;
// Assimp needs seconds.

#ifndef TALUS_IO_IMPORT_PROCESS_H
#define TALUS_IO_IMPORT_PROCESS_H

#include "io/mesh/mesh_import.h"
#include "io/mesh/mesh_source.h"

/// `read`, but TL_ERR_FORMAT when it crashes, and TL_ERR_LIMIT beyond `limits` (NULL: the defaults of
/// tl_import_limits). The host's progress hook is called four times a second and can cancel. Thread safe; where the
/// system refuses a process: TL_ERR_IO.
tl_result tl_read_isolated(tl_mesh_reader *read, const tl_mesh_source *source, const tl_import_limits *limits,
                           const tl_host *host, tl_imported_mesh *mesh_out, tl_io_error *error_out);

#endif
