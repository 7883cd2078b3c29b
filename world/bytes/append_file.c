// SPDX-License-Identifier: MIT

#define _POSIX_C_SOURCE   200809L
#define _FILE_OFFSET_BITS 64

#include "world/bytes/append_file.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

static tl_result write_all(int descriptor, const char *path, const unsigned char *at, size_t size, tl_io_error *error)
{
    while (size > 0) {
        const ssize_t written = write(descriptor, at, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            return tl_io_fail_system(error, path, "write", errno);
        }
        at += written;
        size -= (size_t)written;
    }
    return TL_OK;
}

tl_result tl_file_append(const char *path, const void *bytes, size_t size, tl_io_error *error_out)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    tl_result result = write_all(descriptor, path, bytes, size, error_out);
    if (close(descriptor) != 0 && result == TL_OK) {
        result = tl_io_fail_system(error_out, path, "write", errno);
    }
    return result;
}
