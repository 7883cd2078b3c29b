// SPDX-License-Identifier: MIT
//
// Windows: in place of append_file.c.

#include "world/bytes/append_file.h"

#include "io/files/windows_path.h"

#include <errno.h>
#include <stdlib.h>
#include <windows.h>

enum { MAX_WRITE = 1 << 30 };

tl_result tl_file_append(const char *path, const void *bytes, size_t size, tl_io_error *error_out)
{
    wchar_t *wide = tl_wide_path(path);
    if (wide == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
    }
    const HANDLE file = CreateFileW(wide, FILE_APPEND_DATA, FILE_SHARE_READ | FILE_SHARE_WRITE, NULL, OPEN_ALWAYS,
                                    FILE_ATTRIBUTE_NORMAL, NULL);
    free(wide);
    if (file == INVALID_HANDLE_VALUE) {
        return tl_io_fail_system(error_out, path, "open", tl_windows_errno());
    }
    const unsigned char *at = bytes;
    tl_result result = TL_OK;
    while (size > 0 && result == TL_OK) {
        DWORD written = 0;
        if (!WriteFile(file, at, (DWORD)(size < MAX_WRITE ? size : MAX_WRITE), &written, NULL)) {
            result = tl_io_fail_system(error_out, path, "write", tl_windows_errno());
        }
        at += written;
        size -= written;
    }
    CloseHandle(file);
    return result;
}
