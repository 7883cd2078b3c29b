// SPDX-License-Identifier: MIT
//
// Both paths are resolved by the system, so links and dots are seen through, and then compared.

#define _GNU_SOURCE

#include "io/files/sibling_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char beside_advice[] = "put the file beside it, or export it as one file (.glb)";

static tl_result refuse_sibling(tl_io_error *error, const char *shown, const char *name, const char *why)
{
    return tl_io_fail(error, TL_ERR_UNSUPPORTED, shown, 0, beside_advice, "it names '%s': %s", name, why);
}

// "http:", "file:", "c:"
static bool has_scheme(const char *name)
{
    size_t letters = strcspn(name, ":/\\");
    return letters > 0 && name[letters] == ':';
}

// FOLDER/NAME of the file `path`; false when it is too long.
static bool join_paths(const char *path, const char *name, char joined[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    int folder = slash != NULL ? (int)(slash - path) + 1 : 0;
    int length = snprintf(joined, PATH_MAX, "%.*s%s", folder, path, name);
    return length >= 0 && length < PATH_MAX;
}

static bool is_below(const char *folder, const char *file)
{
    size_t length = strlen(folder);
    if (length > 0 && folder[length - 1] == '/') {
        length--; // of the root
    }
    return strncmp(folder, file, length) == 0 && file[length] == '/';
}

tl_result tl_sibling_open(const char *path, const char *name, const char *shown, tl_file_map *map_out,
                          tl_io_error *error_out)
{
    char joined[PATH_MAX];
    char folder[PATH_MAX];
    char file[PATH_MAX];
    struct stat status;
    memset(map_out, 0, sizeof *map_out);
    if (path == NULL) {
        return refuse_sibling(error_out, shown, name, "what comes from standard input cannot name files");
    }
    if (name[0] == '/' || name[0] == '\\' || has_scheme(name)) {
        return refuse_sibling(error_out, shown, name, "only files of its own folder are opened");
    }
    if (!join_paths(path, name, joined)) {
        return refuse_sibling(error_out, shown, name, "the path is too long");
    }
    if (!join_paths(path, ".", folder) || realpath(folder, file) == NULL) {
        return tl_io_fail_system(error_out, shown, "find its folder", errno);
    }
    memcpy(folder, file, sizeof folder);
    if (realpath(joined, file) == NULL || stat(file, &status) != 0) {
        tl_io_fail(error_out, TL_ERR_IO, shown, 0, beside_advice, "it names '%s': %s", name, strerror(errno));
        return TL_ERR_IO;
    }
    if (!is_below(folder, file)) {
        return refuse_sibling(error_out, shown, name, "only files of its own folder are opened");
    }
    if (!S_ISREG(status.st_mode)) {
        return refuse_sibling(error_out, shown, name, "it is no regular file");
    }
    return tl_file_read(file, 0, map_out, error_out);
}
