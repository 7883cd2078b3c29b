// SPDX-License-Identifier: MIT
//
// How long the calling thread has kept a processor busy, and the time of day. One source a system.

#ifndef TALUS_WORLD_THREAD_CLOCK_H
#define TALUS_WORLD_THREAD_CLOCK_H

#include <stdint.h>

/// Nanoseconds of processor time since the thread began, as fine as the system knows.
uint64_t tl_thread_nanoseconds(void);

/// Nanoseconds since a moment of the system's choice, as fine as it knows.
uint64_t tl_clock_nanoseconds(void);

#endif
