// SPDX-License-Identifier: MIT
//
// Files as bytes, as file_map.c has them elsewhere. A mapped file cannot be cut short on Windows, so no reader of one
// is ever surprised; and it cannot be replaced by others meanwhile, which tl_atomic_file_commit reports by name.

#include "io/files/file_map.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_READ_BYTES = 64 * 1024, READ_STEP = 1 << 24 };

static tl_result fail_too_large(const char *path, uint64_t max_bytes, tl_io_error *error)
{
    return tl_io_fail(error, TL_ERR_LIMIT, path, 0, "raise the limit, or cut the file into parts",
                      "larger than the limit of %llu bytes", (unsigned long long)max_bytes);
}

static tl_result fail_map_memory(const char *path, tl_io_error *error)
{
    return tl_io_fail(error, TL_ERR_MEMORY, path, 0, NULL, "out of memory while reading");
}

static tl_result read_handle(HANDLE file, const char *path, uint64_t max_bytes, tl_file_map *map, tl_io_error *error)
{
    size_t capacity = FIRST_READ_BYTES, used = 0;
    unsigned char *bytes = _aligned_malloc(capacity, TL_BLOB_ALIGNMENT);
    for (;;) {
        if (bytes != NULL && used == capacity) {
            unsigned char *larger =
                capacity <= SIZE_MAX / 2 ? _aligned_realloc(bytes, 2 * capacity, TL_BLOB_ALIGNMENT) : NULL;
            if (larger == NULL) {
                _aligned_free(bytes);
            }
            bytes = larger;
            capacity *= 2;
        }
        if (bytes == NULL) {
            return fail_map_memory(path, error);
        }
        const size_t room = capacity - used;
        DWORD got = 0;
        if (!ReadFile(file, bytes + used, room < READ_STEP ? (DWORD)room : READ_STEP, &got, NULL)) {
            // The end of a pipe whose writer has closed it.
            const int reason = tl_windows_errno();
            if (reason == EPIPE) {
                break;
            }
            _aligned_free(bytes);
            return tl_io_fail_system(error, path, "read", reason);
        }
        if (got == 0) {
            break;
        }
        used += got;
        if (max_bytes != 0 && used > max_bytes) {
            _aligned_free(bytes);
            return fail_too_large(path, max_bytes, error);
        }
    }
    map->bytes = bytes;
    map->size = used;
    return TL_OK;
}

static tl_result take_handle(HANDLE file, const char *path, uint64_t max_bytes, bool may_map, tl_file_map *map,
                             tl_io_error *error)
{
    LARGE_INTEGER size;
    if (GetFileType(file) != FILE_TYPE_DISK || !GetFileSizeEx(file, &size) || size.QuadPart <= 0) {
        return read_handle(file, path, max_bytes, map, error);
    }
    const uint64_t bytes = (uint64_t)size.QuadPart;
    if (max_bytes != 0 && bytes > max_bytes) {
        return fail_too_large(path, max_bytes, error);
    }
    if (bytes > SIZE_MAX) {
        return fail_map_memory(path, error);
    }
    if (!may_map) {
        return read_handle(file, path, max_bytes, map, error);
    }
    HANDLE mapping = CreateFileMappingW(file, NULL, PAGE_READONLY, 0, 0, NULL);
    const void *view = mapping != NULL ? MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0) : NULL;
    if (mapping != NULL) {
        CloseHandle(mapping); // the view keeps it
    }
    if (view == NULL) {
        return read_handle(file, path, max_bytes, map, error);
    }
    map->bytes = view;
    map->size = (size_t)bytes;
    map->mapped = true;
    return TL_OK;
}

static bool is_folder(const wchar_t *path)
{
    const DWORD attributes = GetFileAttributesW(path);
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

static tl_result open_file_bytes(const char *path, uint64_t max_bytes, bool may_map, tl_file_map *map_out,
                                 tl_io_error *error_out)
{
    memset(map_out, 0, sizeof *map_out);
    if (strcmp(path, "-") == 0) {
        // It may stand anywhere in its file: it is read from there.
        return read_handle(GetStdHandle(STD_INPUT_HANDLE), "standard input", max_bytes, map_out, error_out);
    }
    wchar_t *wide = tl_wide_path(path);
    if (wide == NULL) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    if (is_folder(wide)) {
        free(wide);
        return tl_io_fail_system(error_out, path, "read", EISDIR);
    }
    HANDLE file = CreateFileW(wide, GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                              OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
    free(wide);
    if (file == INVALID_HANDLE_VALUE) {
        return tl_io_fail_system(error_out, path, "open", tl_windows_errno());
    }
    const tl_result result = take_handle(file, path, max_bytes, may_map, map_out, error_out);
    CloseHandle(file);
    return result;
}

tl_result tl_file_read(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out)
{
    return open_file_bytes(path, max_bytes, false, map_out, error_out);
}

tl_result tl_file_map_open(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out)
{
    return open_file_bytes(path, max_bytes, true, map_out, error_out);
}

void tl_file_map_close(tl_file_map *map)
{
    if (map->mapped) {
        UnmapViewOfFile(map->bytes);
    } else {
        _aligned_free((void *)(uintptr_t)map->bytes);
    }
    memset(map, 0, sizeof *map);
}
