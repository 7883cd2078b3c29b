// SPDX-License-Identifier: MIT
//
// stat() has no file numbers on Windows: the system is asked for its own.

#include "cli/options/same_file.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <stdlib.h>
#include <string.h>

static HANDLE open_to_ask(const char *path)
{
    wchar_t *wide = tl_wide_path(path);
    HANDLE handle = wide != NULL ? CreateFileW(wide, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                                               OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL)
                                 : INVALID_HANDLE_VALUE;
    free(wide);
    return handle;
}

bool tl_is_stream(const char *path)
{
    if (strcmp(path, "-") == 0) {
        return true;
    }
    HANDLE handle = open_to_ask(path);
    BY_HANDLE_FILE_INFORMATION about;
    const bool is_there = handle != INVALID_HANDLE_VALUE;
    const bool is_file = is_there && GetFileType(handle) == FILE_TYPE_DISK &&
                         GetFileInformationByHandle(handle, &about) &&
                         (about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
    if (is_there) {
        CloseHandle(handle);
    }
    return is_there && !is_file;
}

bool tl_is_same_file(const char *output, const char *input)
{
    const bool standard = strcmp(input, "-") == 0;
    HANDLE handles[2] = { open_to_ask(output), standard ? GetStdHandle(STD_INPUT_HANDLE) : open_to_ask(input) };
    BY_HANDLE_FILE_INFORMATION about[2];
    bool there = true;
    for (int i = 0; i < 2; i++) {
        there = there && handles[i] != INVALID_HANDLE_VALUE && GetFileInformationByHandle(handles[i], &about[i]);
    }
    for (int i = 0; i < 2; i++) {
        if (handles[i] != INVALID_HANDLE_VALUE && !(standard && i == 1)) {
            CloseHandle(handles[i]);
        }
    }
    return there && about[0].dwVolumeSerialNumber == about[1].dwVolumeSerialNumber &&
           about[0].nFileIndexHigh == about[1].nFileIndexHigh && about[0].nFileIndexLow == about[1].nFileIndexLow;
}
