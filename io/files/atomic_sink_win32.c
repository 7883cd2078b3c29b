// SPDX-License-Identifier: MIT
//
// Whole files or none, as atomic_sink.c has it elsewhere: a temporary file in the target's folder, flush, replace.
// MoveFileEx replaces a file in one step on NTFS and keeps links; what others hold open without sharing, or have
// mapped, refuses by name. A process that is killed leaves its temporary file: FILE_FLAG_DELETE_ON_CLOSE would take it
// away, but the renamed one too.

#include "io/files/atomic_sink.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEMPORARY_NAME_BYTES = 64, NAME_ATTEMPTS = 1000, WRITE_STEP = 1 << 24 };

struct tl_atomic_sink {
    const char *path;   // as the caller gave it
    wchar_t *target;    // NULL when the path is written to directly
    wchar_t *temporary; // beside it; NULL: there is none
    HANDLE handle;
    bool is_standard; // standard output is not ours to close
    tl_io_error *failure;
};

void tl_atomic_sink_close(tl_atomic_sink *sink)
{
    if (sink == NULL) {
        return;
    }
    if (sink->handle != INVALID_HANDLE_VALUE && !sink->is_standard) {
        CloseHandle(sink->handle);
    }
    if (sink->temporary != NULL) {
        DeleteFileW(sink->temporary);
    }
    free(sink->target);
    free(sink->temporary);
    free(sink);
}

static tl_result open_temporary(tl_atomic_sink *sink)
{
    const wchar_t *name = sink->target;
    for (const wchar_t *at = sink->target; *at != L'\0'; at++) {
        name = *at == L'\\' || *at == L'/' || *at == L':' ? at + 1 : name;
    }
    const size_t folder = (size_t)(name - sink->target);
    wchar_t *path = malloc((folder + TEMPORARY_NAME_BYTES) * sizeof *path);
    if (path == NULL) {
        return tl_io_fail_system(sink->failure, sink->path, "write", ENOMEM);
    }
    memcpy(path, sink->target, folder * sizeof *path);
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        swprintf(path + folder, TEMPORARY_NAME_BYTES, L".talus-%lu-%d.tmp", (unsigned long)GetCurrentProcessId(), i);
        sink->handle = CreateFileW(path, GENERIC_WRITE, 0, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
        if (sink->handle != INVALID_HANDLE_VALUE) {
            sink->temporary = path;
            return TL_OK;
        }
        if (GetLastError() != ERROR_FILE_EXISTS) {
            break;
        }
    }
    const int reason = tl_windows_errno();
    free(path);
    return tl_io_fail_system(sink->failure, sink->path, "write into its folder", reason);
}

// Devices (NUL, a serial port, the console) and named pipes.
static bool is_device(const wchar_t *path)
{
    HANDLE handle =
        CreateFileW(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING, 0, NULL);
    const bool device = handle != INVALID_HANDLE_VALUE && GetFileType(handle) != FILE_TYPE_DISK;
    if (handle != INVALID_HANDLE_VALUE) {
        CloseHandle(handle);
    }
    return device;
}

static tl_result open_target(tl_atomic_sink *sink)
{
    if (strcmp(sink->path, "-") == 0) {
        sink->handle = GetStdHandle(STD_OUTPUT_HANDLE);
        sink->is_standard = true;
        return TL_OK;
    }
    sink->target = tl_wide_path(sink->path);
    if (sink->target == NULL) {
        return tl_io_fail_system(sink->failure, sink->path, "write", errno);
    }
    const char last = sink->path[strlen(sink->path) - 1];
    const DWORD attributes = GetFileAttributesW(sink->target);
    const bool exists = attributes != INVALID_FILE_ATTRIBUTES;
    if ((exists && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) || last == '/' || last == '\\') {
        return tl_io_fail_system(sink->failure, sink->path, "write", EISDIR);
    }
    if (exists && (attributes & FILE_ATTRIBUTE_READONLY) != 0) {
        return tl_io_fail_system(sink->failure, sink->path, "write", EACCES);
    }
    if (!is_device(sink->target)) {
        return open_temporary(sink);
    }
    sink->handle =
        CreateFileW(sink->target, GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, NULL, OPEN_EXISTING, 0, NULL);
    free(sink->target);
    sink->target = NULL;
    return sink->handle != INVALID_HANDLE_VALUE
               ? TL_OK
               : tl_io_fail_system(sink->failure, sink->path, "open", tl_windows_errno());
}

tl_result tl_atomic_sink_open(const char *path, tl_io_error *failure, tl_atomic_sink **sink_out)
{
    *sink_out = NULL;
    tl_atomic_sink *sink = calloc(1, sizeof *sink);
    if (sink == NULL) {
        return tl_io_fail_system(failure, path, "write", ENOMEM);
    }
    sink->path = path;
    sink->failure = failure;
    sink->handle = INVALID_HANDLE_VALUE;
    const tl_result result = open_target(sink);
    if (result != TL_OK) {
        tl_atomic_sink_close(sink);
        return result;
    }
    *sink_out = sink;
    return TL_OK;
}

tl_result tl_atomic_sink_write(tl_atomic_sink *sink, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    while (size > 0) {
        DWORD put = 0;
        if (!WriteFile(sink->handle, at, size < WRITE_STEP ? (DWORD)size : WRITE_STEP, &put, NULL)) {
            return tl_io_fail_system(sink->failure, sink->path, "write", tl_windows_errno());
        }
        at += put;
        size -= put;
    }
    return TL_OK;
}

tl_result tl_atomic_sink_replace(tl_atomic_sink *sink, bool flush)
{
    if (sink->target == NULL) {
        return TL_OK;
    }
    if (flush && !FlushFileBuffers(sink->handle)) {
        return tl_io_fail_system(sink->failure, sink->path, "flush to disk", tl_windows_errno());
    }
    CloseHandle(sink->handle);
    sink->handle = INVALID_HANDLE_VALUE;
    const DWORD how = MOVEFILE_REPLACE_EXISTING | (flush ? MOVEFILE_WRITE_THROUGH : 0);
    if (!MoveFileExW(sink->temporary, sink->target, how)) {
        return tl_io_fail_system(sink->failure, sink->path, "replace", tl_windows_errno());
    }
    free(sink->temporary);
    sink->temporary = NULL;
    return TL_OK;
}
