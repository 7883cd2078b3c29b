// SPDX-License-Identifier: MIT
//
// How long the calling thread has kept a processor busy. One source a system.

#ifndef TALUS_WORLD_THREAD_CLOCK_H
#define TALUS_WORLD_THREAD_CLOCK_H

#include <stdint.h>

/// Nanoseconds of processor time since the thread began, as fine as the system knows.
uint64_t tl_thread_nanoseconds(void);

#endif
