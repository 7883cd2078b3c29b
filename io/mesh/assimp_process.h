// SPDX-License-Identifier: MIT
//
// Assimp in a process of its own.
//
// Assimp 5 answers some damaged files with a failed assertion (a PLY whose face list is cut), an endless loop (a PLY
// whose header is cut) or a wild pointer. A level that cannot be read must not take the calling program down, so the
// file is read by a child process with a limit on its time, and what it found comes back through a pipe. The
// copy costs a few milliseconds for a million triangles; Assimp needs seconds.

#ifndef TALUS_IO_ASSIMP_PROCESS_H
#define TALUS_IO_ASSIMP_PROCESS_H

#include "io/mesh/assimp_reader.h"

/// tl_assimp_read, but TL_ERR_FORMAT when Assimp crashes, TL_ERR_LIMIT when it takes more processor time than 10
/// seconds and one more for each MB. The host's progress hook is called four times a second and can cancel. Thread
/// safe; where the system refuses a process: TL_ERR_IO.
tl_result tl_assimp_read_isolated(const tl_assimp_source *source, const tl_host *host, tl_imported_mesh *mesh_out,
                                  tl_io_error *error_out);

#endif
