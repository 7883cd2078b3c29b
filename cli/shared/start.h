// SPDX-License-Identifier: MIT
//
// What the system does differently before the first line of main: nothing but on Windows.

#ifndef TALUS_CLI_START_H
#define TALUS_CLI_START_H

#include <stdbool.h>
#include <stddef.h>

/// Makes arguments UTF-8, standard streams bytes, and the console one that knows UTF-8 and escape sequences. False: out
/// of memory, or an argument that is no text.
bool tl_start(int *count, char ***words);

/// The path of the running program, zero-terminated, with slashes. False: the system does not say, or it does not fit.
bool tl_own_path(char *path, size_t capacity);

#endif
