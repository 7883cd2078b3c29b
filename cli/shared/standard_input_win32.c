// SPDX-License-Identifier: MIT
//
// tmpfile() of Windows' C library writes to the root of the drive, which needs rights; a file of the user's temporary
// folder that goes with its last handle needs none.

#include "cli/shared/standard_input.h"

#include "cli/shared/interrupt.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdio.h>

enum { COPY_BYTES = 1 << 16 };

static const char name[] = "standard input";

static HANDLE open_scratch(void)
{
    wchar_t folder[MAX_PATH + 1], path[MAX_PATH + 1];
    if (GetTempPathW(MAX_PATH + 1, folder) == 0 || GetTempFileNameW(folder, L"tls", 0, path) == 0) {
        return INVALID_HANDLE_VALUE;
    }
    return CreateFileW(path, GENERIC_READ | GENERIC_WRITE, 0, NULL, CREATE_ALWAYS,
                       FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, NULL);
}

static tl_result fail_hold(tl_io_error *error)
{
    return tl_interrupted() ? tl_io_fail(error, TL_ERR_CANCELLED, name, 0, NULL, "cancelled")
                            : tl_io_fail_system(error, name, "read", tl_windows_errno());
}

static tl_result copy_pipe(HANDLE from, HANDLE to, tl_io_error *error)
{
    char bytes[COPY_BYTES];
    for (;;) {
        DWORD got = 0, put = 0;
        if (!ReadFile(from, bytes, sizeof bytes, &got, NULL) && GetLastError() != ERROR_BROKEN_PIPE) {
            return fail_hold(error);
        }
        if (tl_interrupted()) {
            return fail_hold(error);
        }
        if (got == 0) {
            return TL_OK;
        }
        if (!WriteFile(to, bytes, got, &put, NULL) || put != got) {
            return fail_hold(error);
        }
    }
}

tl_result tl_standard_input_hold(tl_io_error *error_out)
{
    HANDLE input = GetStdHandle(STD_INPUT_HANDLE);
    if (GetFileType(input) == FILE_TYPE_DISK) {
        return TL_OK; // a file already
    }
    HANDLE scratch = open_scratch();
    if (scratch == INVALID_HANDLE_VALUE) {
        return fail_hold(error_out);
    }
    const tl_result result = copy_pipe(input, scratch, error_out);
    const LARGE_INTEGER start = { .QuadPart = 0 };
    const int descriptor = result == TL_OK && SetFilePointerEx(scratch, start, NULL, FILE_BEGIN)
                               ? _open_osfhandle((intptr_t)scratch, _O_RDONLY | _O_BINARY)
                               : -1;
    if (descriptor < 0) {
        const tl_result failed = result != TL_OK ? result : fail_hold(error_out);
        CloseHandle(scratch);
        return failed;
    }
    // The descriptor, which owns the file, stays open beside the standard one: it ends with the program.
    if (_dup2(descriptor, _fileno(stdin)) != 0 || !SetStdHandle(STD_INPUT_HANDLE, scratch)) {
        return tl_io_fail_system(error_out, name, "read", errno);
    }
    return TL_OK;
}

size_t tl_standard_input_peek(void *bytes, size_t capacity)
{
    HANDLE input = GetStdHandle(STD_INPUT_HANDLE);
    const LARGE_INTEGER none = { .QuadPart = 0 };
    LARGE_INTEGER at;
    DWORD got = 0;
    if (!SetFilePointerEx(input, none, &at, FILE_CURRENT)) {
        return 0;
    }
    const BOOL read = ReadFile(input, bytes, capacity < COPY_BYTES ? (DWORD)capacity : COPY_BYTES, &got, NULL);
    SetFilePointerEx(input, at, NULL, FILE_BEGIN);
    return read ? got : 0;
}
