// SPDX-License-Identifier: MIT
//
// main's own words are in the code page of the user, which lacks most of the world's letters; the command line in
// UTF-16 has them all.

#include "cli/shared/start.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <shellapi.h>

#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>

static char *narrow(const wchar_t *text)
{
    const int size = WideCharToMultiByte(CP_UTF8, WC_ERR_INVALID_CHARS, text, -1, NULL, 0, NULL, NULL);
    char *result = size > 0 ? malloc((size_t)size) : NULL;
    if (result != NULL) {
        WideCharToMultiByte(CP_UTF8, WC_ERR_INVALID_CHARS, text, -1, result, size, NULL, NULL);
    }
    return result;
}

// Escape sequences, which the progress line uses; consoles of old systems do not know them and show no line then.
static void prepare_console(DWORD which)
{
    DWORD mode;
    HANDLE console = GetStdHandle(which);
    if (GetConsoleMode(console, &mode)) {
        SetConsoleMode(console, mode | ENABLE_PROCESSED_OUTPUT | 0x0004 /* ENABLE_VIRTUAL_TERMINAL_PROCESSING */);
    }
}

bool tl_start(int *count, char ***words)
{
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), count);
    char **list = wide != NULL ? calloc((size_t)*count + 1, sizeof *list) : NULL;
    bool all = list != NULL;
    for (int i = 0; all && i < *count; i++) {
        list[i] = narrow(wide[i]);
        all = list[i] != NULL;
    }
    LocalFree(wide);
    *words = list; // they live as long as the program
    // A baked file is no text, and lines end as they do everywhere.
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
    SetConsoleOutputCP(CP_UTF8);
    prepare_console(STD_OUTPUT_HANDLE);
    prepare_console(STD_ERROR_HANDLE);
    return all;
}

bool tl_own_path(char *path, size_t capacity)
{
    wchar_t wide[4096];
    const DWORD length = GetModuleFileNameW(NULL, wide, sizeof wide / sizeof wide[0]);
    for (DWORD i = 0; i < length; i++) {
        wide[i] = wide[i] == L'\\' ? L'/' : wide[i];
    }
    return length > 0 && length < sizeof wide / sizeof wide[0] && capacity < 0x7fffffff &&
           WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, (int)capacity, NULL, NULL) > 0;
}
