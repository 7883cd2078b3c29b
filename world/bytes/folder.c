// SPDX-License-Identifier: MIT

#define _XOPEN_SOURCE     700
#define _FILE_OFFSET_BITS 64 // 32-bit machines too know files of more than 2 GB, and folders with large numbers
#ifdef __APPLE__
#define _DARWIN_C_SOURCE // for st_mtimespec
#endif

#include "world/bytes/folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool tl_file_look(const char *path, tl_file_facts *facts_out)
{
    struct stat status;
    const bool there = stat(path, &status) == 0;
    if (facts_out != NULL) {
        memset(facts_out, 0, sizeof *facts_out);
        if (there) {
#ifdef __APPLE__
            const struct timespec changed = status.st_mtimespec;
#else
            const struct timespec changed = status.st_mtim;
#endif
            facts_out->size = (uint64_t)status.st_size;
            facts_out->changed = (uint64_t)changed.tv_sec * 1000000000u + (uint64_t)changed.tv_nsec;
            facts_out->is_folder = S_ISDIR(status.st_mode);
        }
    }
    return there;
}

tl_result tl_folder_make(const char *path, tl_io_error *error_out)
{
    tl_file_facts facts;
    if (mkdir(path, 0777) != 0) {
        const int reason = errno;
        if (reason != EEXIST || !tl_file_look(path, &facts) || !facts.is_folder) {
            return tl_io_fail_system(error_out, path, "make the folder", reason);
        }
    }
    return TL_OK;
}

tl_result tl_folder_list(const char *path, tl_folder_entry_fn *entry, void *user, tl_io_error *error_out)
{
    DIR *folder = opendir(path);
    if (folder == NULL) {
        return tl_io_fail_system(error_out, path, "list the folder", errno);
    }
    tl_result result = TL_OK;
    errno = 0;
    for (const struct dirent *item = readdir(folder); item != NULL && result == TL_OK; item = readdir(folder)) {
        if (strcmp(item->d_name, ".") != 0 && strcmp(item->d_name, "..") != 0) {
            result = entry(item->d_name, user);
        }
        errno = 0;
    }
    if (result == TL_OK && errno != 0) {
        result = tl_io_fail_system(error_out, path, "list the folder", errno);
    }
    closedir(folder);
    return result;
}

char *tl_full_path(const char *path)
{
    return realpath(path, NULL);
}

void tl_file_remove(const char *path)
{
    unlink(path);
}
