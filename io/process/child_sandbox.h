// SPDX-License-Identifier: MIT
//
// What a process that reads a stranger's file may ask of the system: memory, reading files, and writing to one pipe.

#ifndef TALUS_IO_CHILD_SANDBOX_H
#define TALUS_IO_CHILD_SANDBOX_H

#include <stdbool.h>

/// From now on this process, for good, is refused (EPERM) every system call but those that a reader needs: no new
/// process or program, no network, no signal to others, nothing opened but for reading, nothing written but to `pipe`.
/// False where the system has no such filter (only Linux has), or refuses it: then nothing has changed.
bool tl_enter_child_sandbox(int pipe);

#endif
