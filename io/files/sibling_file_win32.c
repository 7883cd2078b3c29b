// SPDX-License-Identifier: MIT
//
// Files beside a file, as sibling_file.c has them elsewhere. Both paths are resolved by the system, through links and
// dots, and then compared without regard to case, as the system does.

#include "io/files/sibling_file.h"

#include "io/files/windows_path.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char beside_advice[] = "put the file beside it, or export it as one file (.glb)";

static tl_result refuse_sibling(tl_io_error *error, const char *shown, const char *name, const char *why)
{
    return tl_io_fail(error, TL_ERR_UNSUPPORTED, shown, 0, beside_advice, "it names '%s': %s", name, why);
}

// FOLDER/NAME of the file `path`, freed with free(). NULL: out of memory.
static char *join_paths(const char *path, const char *name)
{
    size_t folder = 0;
    for (size_t i = 0; path[i] != '\0'; i++) {
        folder = path[i] == '/' || path[i] == '\\' || path[i] == ':' ? i + 1 : folder;
    }
    const size_t length = strlen(name) + 1;
    char *joined = malloc(folder + length);
    if (joined != NULL) {
        memcpy(joined, path, folder);
        memcpy(joined + folder, name, length);
    }
    return joined;
}

typedef struct resolved {
    wchar_t *path; // NULL: errno says why
    bool is_regular;
} resolved;

// Where the system ends up, and whether a file of a disk is there.
static resolved resolve(const char *path)
{
    resolved result = { NULL, false };
    wchar_t *wide = tl_wide_path(path);
    if (wide == NULL) {
        return result;
    }
    // BACKUP_SEMANTICS: folders too.
    HANDLE handle = CreateFileW(wide, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING,
                                FILE_FLAG_BACKUP_SEMANTICS, NULL);
    free(wide);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = tl_windows_errno();
        return result;
    }
    BY_HANDLE_FILE_INFORMATION about;
    result.is_regular = GetFileType(handle) == FILE_TYPE_DISK && GetFileInformationByHandle(handle, &about) &&
                        (about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
    const DWORD length = GetFinalPathNameByHandleW(handle, NULL, 0, 0);
    result.path = length > 0 ? malloc(((size_t)length + 1) * sizeof *result.path) : NULL;
    if (result.path == NULL || GetFinalPathNameByHandleW(handle, result.path, length + 1, 0) == 0) {
        errno = length > 0 ? ENOMEM : tl_windows_errno();
        free(result.path);
        result.path = NULL;
    }
    CloseHandle(handle);
    return result;
}

static bool is_below(const wchar_t *folder, const wchar_t *file)
{
    size_t length = wcslen(folder);
    if (length > 0 && folder[length - 1] == L'\\') {
        length--; // of the root
    }
    return _wcsnicmp(folder, file, length) == 0 && file[length] == L'\\';
}

static tl_result open_resolved(const char *path, const char *name, const char *shown, tl_file_map *map_out,
                               tl_io_error *error_out)
{
    char *joined = join_paths(path, name), *folder = join_paths(path, ".");
    tl_result result = joined != NULL && folder != NULL ? TL_OK : tl_io_fail_system(error_out, shown, "read", ENOMEM);
    resolved home = { NULL, false }, file = { NULL, false };
    if (result == TL_OK) {
        home = resolve(folder);
        result = home.path != NULL ? TL_OK : tl_io_fail_system(error_out, shown, "find its folder", errno);
    }
    if (result == TL_OK) {
        file = resolve(joined);
        if (file.path == NULL) {
            result =
                tl_io_fail(error_out, TL_ERR_IO, shown, 0, beside_advice, "it names '%s': %s", name, strerror(errno));
        } else if (!is_below(home.path, file.path)) {
            result = refuse_sibling(error_out, shown, name, "only files of its own folder are opened");
        } else if (!file.is_regular) {
            result = refuse_sibling(error_out, shown, name, "it is no regular file");
        } else {
            result = tl_file_read(joined, 0, map_out, error_out);
        }
    }
    free(file.path);
    free(home.path);
    free(joined);
    free(folder);
    return result;
}

tl_result tl_sibling_open(const char *path, const char *name, const char *shown, tl_file_map *map_out,
                          tl_io_error *error_out)
{
    memset(map_out, 0, sizeof *map_out);
    if (path == NULL) {
        return refuse_sibling(error_out, shown, name, "what comes from standard input cannot name files");
    }
    // A colon names a drive, an address of the net or a stream within a file.
    if (name[0] == '/' || name[0] == '\\' || strchr(name, ':') != NULL) {
        return refuse_sibling(error_out, shown, name, "only files of its own folder are opened");
    }
    return open_resolved(path, name, shown, map_out, error_out);
}
