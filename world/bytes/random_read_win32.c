// SPDX-License-Identifier: MIT
//
// Windows: in place of random_read.c.

#include "world/bytes/random_read.h"

#include "io/files/windows_path.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

tl_result tl_random_file_open(const char *path, tl_random_file *file_out, tl_io_error *error_out)
{
    memset(file_out, 0, sizeof *file_out);
    wchar_t *wide = tl_wide_path(path);
    if (wide == NULL) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    const DWORD share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE handle = CreateFileW(wide, GENERIC_READ, share, NULL, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
    free(wide);
    if (handle == INVALID_HANDLE_VALUE) {
        return tl_io_fail_system(error_out, path, "open", tl_windows_errno());
    }
    file_out->handle = (intptr_t)handle;
    file_out->is_open = 1;
    return TL_OK;
}

tl_result tl_random_file_read(const tl_random_file *file, const char *path, uint64_t offset, void *bytes, size_t size,
                              tl_io_error *error_out)
{
    unsigned char *at = bytes;
    while (size > 0) {
        OVERLAPPED place;
        memset(&place, 0, sizeof place);
        place.Offset = (DWORD)offset;
        place.OffsetHigh = (DWORD)(offset >> 32);
        const DWORD wanted = size < (1u << 30) ? (DWORD)size : 1u << 30;
        DWORD got = 0;
        const BOOL read = ReadFile((HANDLE)file->handle, at, wanted, &got, &place);
        if (!read && GetLastError() != ERROR_HANDLE_EOF) {
            return tl_io_fail_system(error_out, path, "read", tl_windows_errno());
        }
        if (got == 0) {
            return tl_io_fail(error_out, TL_ERR_TRUNCATED, path, 0, "", "ends at byte %llu, and more was read before",
                              (unsigned long long)offset);
        }
        at += got;
        offset += got;
        size -= got;
    }
    return TL_OK;
}

// Windows has no such hint for a file that is open already.
void tl_random_file_forget(const tl_random_file *file)
{
    (void)file;
}

void tl_random_file_close(tl_random_file *file)
{
    if (file->is_open) {
        CloseHandle((HANDLE)file->handle);
    }
    memset(file, 0, sizeof *file);
}
