// SPDX-License-Identifier: MIT

#define _XOPEN_SOURCE 700

#include "world/bytes/thread_clock.h"

#include <time.h>

uint64_t tl_thread_nanoseconds(void)
{
    struct timespec time = { 0, 0 };
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (uint64_t)time.tv_sec * 1000000000u + (uint64_t)time.tv_nsec;
}
