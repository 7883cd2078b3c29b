// SPDX-License-Identifier: MIT
//
// What a path stands for: a stream, nothing, or a file that has other names too.

#ifndef TALUS_CLI_SAME_FILE_H
#define TALUS_CLI_SAME_FILE_H

#include <stdbool.h>

/// Whether "-", a device or a pipe is meant, which take everything and are nothing that could be destroyed. A path
/// where nothing is yet is none.
bool tl_is_stream(const char *path);

/// Whether both paths lead to one file that is there, by whatever names and links. "-" is what standard input reads.
bool tl_is_same_file(const char *output, const char *input);

#endif
