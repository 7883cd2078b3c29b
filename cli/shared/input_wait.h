// SPDX-License-Identifier: MIT
//
// Inputs by their descriptor: opened with a UTF-8 path, and asked whether there is something to read.

#ifndef TALUS_CLI_INPUT_WAIT_H
#define TALUS_CLI_INPUT_WAIT_H

#include <stdbool.h>

/// A descriptor to read bytes from, closed with close(); -1, and errno says why.
int tl_input_open(const char *path);

/// Whether read() would have to wait now.
bool tl_input_would_wait(int descriptor);

#endif
