// SPDX-License-Identifier: MIT

#define _POSIX_C_SOURCE   200809L
#define _FILE_OFFSET_BITS 64

#include "world/bytes/random_read.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

tl_result tl_random_file_open(const char *path, tl_random_file *file_out, tl_io_error *error_out)
{
    memset(file_out, 0, sizeof *file_out);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    file_out->handle = descriptor;
    file_out->is_open = 1;
    return TL_OK;
}

tl_result tl_random_file_read(const tl_random_file *file, const char *path, uint64_t offset, void *bytes, size_t size,
                              tl_io_error *error_out)
{
    unsigned char *at = bytes;
    while (size > 0) {
        const ssize_t got = pread((int)file->handle, at, size, (off_t)offset);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return tl_io_fail_system(error_out, path, "read", errno);
        }
        if (got == 0) {
            return tl_io_fail(error_out, TL_ERR_TRUNCATED, path, 0, "", "ends at byte %llu, and more was read before",
                              (unsigned long long)offset);
        }
        at += got;
        offset += (uint64_t)got;
        size -= (size_t)got;
    }
    return TL_OK;
}

void tl_random_file_forget(const tl_random_file *file)
{
#ifdef POSIX_FADV_DONTNEED
    if (file->is_open) {
        (void)posix_fadvise((int)file->handle, 0, 0, POSIX_FADV_DONTNEED);
    }
#else
    (void)file;
#endif
}

void tl_random_file_close(tl_random_file *file)
{
    if (file->is_open) {
        close((int)file->handle);
    }
    memset(file, 0, sizeof *file);
}
