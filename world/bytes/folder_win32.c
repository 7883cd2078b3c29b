// SPDX-License-Identifier: MIT
//
// Windows: in place of folder.c.

#include "world/bytes/folder.h"

#include "io/files/windows_path.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

// 100 ns since 1601 to nanoseconds since 1970.
static uint64_t unix_nanoseconds(FILETIME time)
{
    const uint64_t ticks = (uint64_t)time.dwHighDateTime << 32 | time.dwLowDateTime;
    const uint64_t epoch = UINT64_C(116444736000000000);
    return ticks > epoch ? (ticks - epoch) * 100u : 0;
}

bool tl_file_look(const char *path, tl_file_facts *facts_out)
{
    WIN32_FILE_ATTRIBUTE_DATA data;
    wchar_t *wide = tl_wide_path(path);
    const bool there = wide != NULL && GetFileAttributesExW(wide, GetFileExInfoStandard, &data) != 0;
    free(wide);
    if (facts_out != NULL) {
        memset(facts_out, 0, sizeof *facts_out);
        if (there) {
            facts_out->size = (uint64_t)data.nFileSizeHigh << 32 | data.nFileSizeLow;
            facts_out->changed = unix_nanoseconds(data.ftLastWriteTime);
            facts_out->is_folder = (data.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
        }
    }
    return there;
}

tl_result tl_folder_make(const char *path, tl_io_error *error_out)
{
    tl_file_facts facts;
    wchar_t *wide = tl_wide_path(path);
    const bool made = wide != NULL && CreateDirectoryW(wide, NULL) != 0;
    const int reason = wide == NULL ? errno : made ? 0 : tl_windows_errno();
    free(wide);
    if (!made && !(tl_file_look(path, &facts) && facts.is_folder)) {
        return tl_io_fail_system(error_out, path, "make the folder", reason);
    }
    return TL_OK;
}

static char *narrow_name(const wchar_t *wide)
{
    const int size = WideCharToMultiByte(CP_UTF8, 0, wide, -1, NULL, 0, NULL, NULL);
    char *name = size > 0 ? malloc((size_t)size) : NULL;
    if (name != NULL) {
        WideCharToMultiByte(CP_UTF8, 0, wide, -1, name, size, NULL, NULL);
    }
    return name;
}

tl_result tl_folder_list(const char *path, tl_folder_entry_fn *entry, void *user, tl_io_error *error_out)
{
    const size_t length = strlen(path);
    char *pattern = malloc(length + 3);
    if (pattern == NULL) {
        return tl_io_fail_system(error_out, path, "list the folder", ENOMEM);
    }
    memcpy(pattern, path, length);
    memcpy(pattern + length, "/*", 3);
    wchar_t *wide = tl_wide_path(pattern);
    free(pattern);
    WIN32_FIND_DATAW data;
    HANDLE search = wide != NULL ? FindFirstFileW(wide, &data) : INVALID_HANDLE_VALUE;
    const int reason = wide == NULL ? errno : tl_windows_errno();
    free(wide);
    if (search == INVALID_HANDLE_VALUE) {
        return tl_io_fail_system(error_out, path, "list the folder", reason);
    }
    tl_result result = TL_OK;
    do {
        char *name = narrow_name(data.cFileName);
        if (name == NULL) {
            result = tl_io_fail_system(error_out, path, "list the folder", ENOMEM);
        } else if (strcmp(name, ".") != 0 && strcmp(name, "..") != 0) {
            result = entry(name, user);
        }
        free(name);
    } while (result == TL_OK && FindNextFileW(search, &data) != 0);
    FindClose(search);
    return result;
}

char *tl_full_path(const char *path)
{
    wchar_t *wide = tl_wide_path(path);
    const DWORD size = wide != NULL ? GetFullPathNameW(wide, 0, NULL, NULL) : 0;
    wchar_t *full = size > 0 ? malloc(size * sizeof *full) : NULL;
    char *result = NULL;
    if (full != NULL && GetFullPathNameW(wide, size, full, NULL) != 0) {
        result = narrow_name(full);
    }
    free(full);
    free(wide);
    return result;
}

void tl_file_remove(const char *path)
{
    wchar_t *wide = tl_wide_path(path);
    if (wide != NULL) {
        DeleteFileW(wide);
        free(wide);
    }
}
