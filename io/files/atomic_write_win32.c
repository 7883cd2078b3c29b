// SPDX-License-Identifier: MIT
//
// Whole files or none, as atomic_write.c has it elsewhere: a temporary file in the target's folder that disappears with
// its handle (FILE_FLAG_DELETE_ON_CLOSE would also take a renamed one), flush, replace. MoveFileEx replaces a file in
// one step on NTFS and keeps links; what others hold open without sharing, or have mapped, refuses by name.

#include "io/files/atomic_write.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WRITE_BUFFER_BYTES = 64 * 1024, TEMPORARY_NAME_BYTES = 64, NAME_ATTEMPTS = 1000, WRITE_STEP = 1 << 24 };

struct tl_atomic_file {
    char *path;         // as the caller gave it
    wchar_t *target;    // NULL when the path is written to directly
    wchar_t *temporary; // beside it; NULL: there is none
    HANDLE handle;
    bool is_standard; // standard output is not ours to close
    uint64_t size;
    size_t used; // bytes in the buffer
    tl_io_error failure;
    unsigned char buffer[WRITE_BUFFER_BYTES];
};

static void discard(tl_atomic_file *file)
{
    if (file->handle != INVALID_HANDLE_VALUE && !file->is_standard) {
        CloseHandle(file->handle);
    }
    if (file->temporary != NULL) {
        DeleteFileW(file->temporary);
    }
    free(file->path);
    free(file->target);
    free(file->temporary);
    free(file);
}

static tl_result open_temporary(tl_atomic_file *file)
{
    const wchar_t *name = file->target;
    for (const wchar_t *at = file->target; *at != L'\0'; at++) {
        name = *at == L'\\' || *at == L'/' || *at == L':' ? at + 1 : name;
    }
    const size_t folder = (size_t)(name - file->target);
    wchar_t *path = malloc((folder + TEMPORARY_NAME_BYTES) * sizeof *path);
    if (path == NULL) {
        return tl_io_fail_system(&file->failure, file->path, "write", ENOMEM);
    }
    memcpy(path, file->target, folder * sizeof *path);
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        swprintf(path + folder, TEMPORARY_NAME_BYTES, L".talus-%lu-%d.tmp", (unsigned long)GetCurrentProcessId(), i);
        file->handle = CreateFileW(path, GENERIC_WRITE, 0, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
        if (file->handle != INVALID_HANDLE_VALUE) {
            file->temporary = path;
            return TL_OK;
        }
        if (GetLastError() != ERROR_FILE_EXISTS) {
            break;
        }
    }
    const int reason = tl_windows_errno();
    free(path);
    return tl_io_fail_system(&file->failure, file->path, "write into its folder", reason);
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

static tl_result open_target(tl_atomic_file *file)
{
    if (strcmp(file->path, "-") == 0) {
        file->handle = GetStdHandle(STD_OUTPUT_HANDLE);
        file->is_standard = true;
        return TL_OK;
    }
    file->target = tl_wide_path(file->path);
    if (file->target == NULL) {
        return tl_io_fail_system(&file->failure, file->path, "write", errno);
    }
    const char last = file->path[strlen(file->path) - 1];
    const DWORD attributes = GetFileAttributesW(file->target);
    const bool exists = attributes != INVALID_FILE_ATTRIBUTES;
    if ((exists && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) || last == '/' || last == '\\') {
        return tl_io_fail_system(&file->failure, file->path, "write", EISDIR);
    }
    if (exists && (attributes & FILE_ATTRIBUTE_READONLY) != 0) {
        return tl_io_fail_system(&file->failure, file->path, "write", EACCES);
    }
    if (!is_device(file->target)) {
        return open_temporary(file);
    }
    file->handle =
        CreateFileW(file->target, GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, NULL, OPEN_EXISTING, 0, NULL);
    free(file->target);
    file->target = NULL;
    return file->handle != INVALID_HANDLE_VALUE
               ? TL_OK
               : tl_io_fail_system(&file->failure, file->path, "open", tl_windows_errno());
}

tl_result tl_atomic_file_open(const char *path, tl_atomic_file **file_out, tl_io_error *error_out)
{
    *file_out = NULL;
    tl_atomic_file *file = malloc(sizeof *file);
    if (file == NULL) {
        return tl_io_fail_system(error_out, path, "write", ENOMEM);
    }
    memset(file, 0, offsetof(tl_atomic_file, buffer)); // not the buffer
    file->handle = INVALID_HANDLE_VALUE;
    file->path = _strdup(path);
    const tl_result result =
        file->path != NULL ? open_target(file) : tl_io_fail_system(&file->failure, path, "write", ENOMEM);
    if (result != TL_OK) {
        if (error_out != NULL) {
            *error_out = file->failure;
        }
        discard(file);
        return result;
    }
    *file_out = file;
    return TL_OK;
}

static tl_result write_through(tl_atomic_file *file, const unsigned char *bytes, size_t size)
{
    while (size > 0) {
        DWORD put = 0;
        if (!WriteFile(file->handle, bytes, size < WRITE_STEP ? (DWORD)size : WRITE_STEP, &put, NULL)) {
            return tl_io_fail_system(&file->failure, file->path, "write", tl_windows_errno());
        }
        bytes += put;
        size -= put;
    }
    return TL_OK;
}

static tl_result flush_buffer(tl_atomic_file *file)
{
    const size_t used = file->used;
    file->used = 0;
    return write_through(file, file->buffer, used);
}

static tl_result append_to_file(tl_atomic_file *file, const unsigned char *bytes, size_t size)
{
    if (size > WRITE_BUFFER_BYTES - file->used) {
        const tl_result result = flush_buffer(file);
        if (result != TL_OK || size >= WRITE_BUFFER_BYTES) {
            return result != TL_OK ? result : write_through(file, bytes, size);
        }
    }
    memcpy(file->buffer + file->used, bytes, size);
    file->used += size;
    return TL_OK;
}

tl_result tl_atomic_file_write(tl_atomic_file *file, const void *bytes, size_t size, tl_io_error *error_out)
{
    if (size == 0) {
        return file->failure.result;
    }
    if (file->failure.result == TL_OK && append_to_file(file, bytes, size) == TL_OK) {
        file->size += size;
        return TL_OK;
    }
    if (error_out != NULL) {
        *error_out = file->failure;
    }
    return file->failure.result;
}

static tl_result put_in_place(tl_atomic_file *file)
{
    if (file->target == NULL) {
        return TL_OK;
    }
    if (!FlushFileBuffers(file->handle)) {
        return tl_io_fail_system(&file->failure, file->path, "flush to disk", tl_windows_errno());
    }
    CloseHandle(file->handle);
    file->handle = INVALID_HANDLE_VALUE;
    if (!MoveFileExW(file->temporary, file->target, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) {
        return tl_io_fail_system(&file->failure, file->path, "replace", tl_windows_errno());
    }
    free(file->temporary);
    file->temporary = NULL;
    return TL_OK;
}

tl_result tl_atomic_file_commit(tl_atomic_file *file, tl_io_error *error_out)
{
    tl_result result = file->failure.result;
    if (result == TL_OK) {
        result = flush_buffer(file);
    }
    if (result == TL_OK) {
        result = put_in_place(file);
    }
    if (result != TL_OK && error_out != NULL) {
        *error_out = file->failure;
    }
    discard(file);
    return result;
}

void tl_atomic_file_abort(tl_atomic_file *file)
{
    if (file != NULL) {
        discard(file);
    }
}

uint64_t tl_atomic_file_size(const tl_atomic_file *file)
{
    return file->size;
}

tl_result tl_atomic_write(const char *path, const void *bytes, size_t size, tl_io_error *error_out)
{
    tl_atomic_file *file;
    tl_result result = tl_atomic_file_open(path, &file, error_out);
    if (result != TL_OK) {
        return result;
    }
    result = tl_atomic_file_write(file, bytes, size, error_out);
    if (result != TL_OK) {
        tl_atomic_file_abort(file);
        return result;
    }
    return tl_atomic_file_commit(file, error_out);
}
