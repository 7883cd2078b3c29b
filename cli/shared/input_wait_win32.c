// SPDX-License-Identifier: MIT
//
// Windows cannot poll everything: files never wait, pipes tell how much is in them, and a console is taken to wait,
// which costs a flush too many.

#include "cli/shared/input_wait.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <stdlib.h>

int tl_input_open(const char *path)
{
    wchar_t *wide = tl_wide_path(path);
    const int descriptor = wide != NULL ? _wopen(wide, _O_RDONLY | _O_BINARY | _O_NOINHERIT) : -1;
    free(wide);
    return descriptor;
}

bool tl_input_would_wait(int descriptor)
{
    HANDLE handle = (HANDLE)_get_osfhandle(descriptor);
    const DWORD type = GetFileType(handle);
    DWORD waiting = 0;
    if (type == FILE_TYPE_PIPE && PeekNamedPipe(handle, NULL, 0, NULL, &waiting, NULL)) {
        return waiting == 0;
    }
    return type == FILE_TYPE_CHAR;
}
