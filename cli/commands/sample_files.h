// SPDX-License-Identifier: MIT
//
// The sample world as files: binary STL, part by part, and the manifest that places them.

#ifndef TALUS_CLI_SAMPLE_FILES_H
#define TALUS_CLI_SAMPLE_FILES_H

#include "cli/shared/command.h"

typedef struct tl_sample_files {
    uint64_t triangles;
    uint32_t parts_x, parts_z;
} tl_sample_files;

/// Writes parts into the folder `output`, which is made when it is not there, until they hold `triangles` triangles, at
/// least one part. `*files_out` says what was written.
tl_exit tl_sample_files_write(tl_cli *cli, const char *output, uint64_t triangles, uint64_t seed,
                              tl_sample_files *files_out);

#endif
