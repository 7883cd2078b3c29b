// SPDX-License-Identifier: MIT

#define _XOPEN_SOURCE 700

#include "world/bytes/thread_clock.h"

#include <time.h>

static uint64_t nanoseconds_of(clockid_t clock)
{
    struct timespec time = { 0, 0 };
    clock_gettime(clock, &time);
    return (uint64_t)time.tv_sec * 1000000000u + (uint64_t)time.tv_nsec;
}

uint64_t tl_thread_nanoseconds(void)
{
    return nanoseconds_of(CLOCK_THREAD_CPUTIME_ID);
}

uint64_t tl_clock_nanoseconds(void)
{
    return nanoseconds_of(CLOCK_REALTIME);
}
