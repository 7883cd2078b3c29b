// SPDX-License-Identifier: MIT
//
// A hint that a line of memory is needed soon; nothing where the compiler has none.

#ifndef TALUS_SRC_BASE_PREFETCH_H
#define TALUS_SRC_BASE_PREFETCH_H

static inline void tl_prefetch(const void *at)
{
#if defined(__GNUC__)
    __builtin_prefetch(at);
#else
    (void)at;
#endif
}

#endif
