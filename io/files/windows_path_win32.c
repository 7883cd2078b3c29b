// SPDX-License-Identifier: MIT

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { LONG_PATH = 240 }; // MAX_PATH less a file name of 8.3, which folders must leave room for

static wchar_t *widen(const char *text)
{
    const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, NULL, 0);
    if (length <= 0) {
        errno = EILSEQ;
        return NULL;
    }
    wchar_t *wide = malloc((size_t)length * sizeof *wide);
    if (wide == NULL) {
        errno = ENOMEM;
        return NULL;
    }
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, wide, length);
    return wide;
}

// \\?\ switches the limit off, and with it the reading of "." and "/", so the path is made a full one first. Paths of
// the net have an own form.
static wchar_t *lengthen(wchar_t *path)
{
    static const wchar_t local[] = L"\\\\?\\", net[] = L"\\\\?\\UNC";
    const DWORD full = GetFullPathNameW(path, 0, NULL, NULL);
    wchar_t *result = malloc(((size_t)full + sizeof net / sizeof net[0]) * sizeof *result);
    wchar_t *plain = malloc(((size_t)full + 1) * sizeof *plain);
    if (result == NULL || plain == NULL || full == 0 || GetFullPathNameW(path, full, plain, NULL) == 0) {
        free(result);
        result = NULL;
        errno = ENOMEM;
    } else if (plain[0] == L'\\' && plain[1] == L'\\') {
        wcscpy(result, net);
        wcscat(result, plain + 1);
    } else {
        wcscpy(result, local);
        wcscat(result, plain);
    }
    free(plain);
    free(path);
    return result;
}

wchar_t *tl_wide_path(const char *path)
{
    if (path[0] == '\0') {
        errno = ENOENT;
        return NULL;
    }
    wchar_t *wide = widen(path);
    if (wide == NULL || wcslen(wide) < LONG_PATH || wcsncmp(wide, L"\\\\?\\", 4) == 0) {
        return wide;
    }
    return lengthen(wide);
}

int tl_windows_errno(void)
{
    static const struct {
        DWORD system;
        int number;
    } REASONS[] = {
        { ERROR_FILE_NOT_FOUND, ENOENT },
        { ERROR_PATH_NOT_FOUND, ENOENT },
        { ERROR_INVALID_NAME, ENOENT },
        { ERROR_BAD_PATHNAME, ENOENT },
        { ERROR_BAD_NETPATH, ENOENT },
        { ERROR_ACCESS_DENIED, EACCES },
        { ERROR_SHARING_VIOLATION, EBUSY },
        { ERROR_LOCK_VIOLATION, EBUSY },
        { ERROR_USER_MAPPED_FILE, EBUSY },
        { ERROR_FILE_EXISTS, EEXIST },
        { ERROR_ALREADY_EXISTS, EEXIST },
        { ERROR_DISK_FULL, ENOSPC },
        { ERROR_HANDLE_DISK_FULL, ENOSPC },
        { ERROR_NOT_ENOUGH_MEMORY, ENOMEM },
        { ERROR_OUTOFMEMORY, ENOMEM },
        { ERROR_COMMITMENT_LIMIT, ENOMEM },
        { ERROR_TOO_MANY_OPEN_FILES, EMFILE },
        { ERROR_BROKEN_PIPE, EPIPE },
        { ERROR_NO_DATA, EPIPE },
        { ERROR_WRITE_PROTECT, EROFS },
        { ERROR_DIRECTORY, ENOTDIR },
        { ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG },
    };
    const DWORD reason = GetLastError();
    for (size_t i = 0; i < sizeof REASONS / sizeof REASONS[0]; i++) {
        if (REASONS[i].system == reason) {
            return REASONS[i].number;
        }
    }
    return EIO;
}
