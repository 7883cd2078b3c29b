// SPDX-License-Identifier: MIT

#include "cli/shared/start.h"

#include <stdint.h>
#include <unistd.h>

#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

bool tl_start(int *count, char ***words)
{
    (void)count;
    (void)words;
    return true;
}

bool tl_own_path(char *path, size_t capacity)
{
#ifdef __APPLE__
    uint32_t size = capacity < UINT32_MAX ? (uint32_t)capacity : UINT32_MAX;
    return _NSGetExecutablePath(path, &size) == 0;
#else
    const ssize_t length = readlink("/proc/self/exe", path, capacity);
    if (length <= 0 || (size_t)length >= capacity) {
        return false;
    }
    path[length] = '\0';
    return true;
#endif
}
