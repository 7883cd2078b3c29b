// SPDX-License-Identifier: MIT
//
// Whole files or none: unnamed temporary file, flush, link, rename, flush the folder.
//
// O_TMPFILE gives a file without a name, so whatever ends the process takes it away; it gets a name for the moment
// between linkat and rename only, because linkat cannot replace a file. Where it is missing, a named temporary file in
// the same folder does (rename works within one file system only, so /tmp is no place for it).
// Order of flushing: Pillai et al., All File Systems Are Not Created Equal (OSDI 2014): without the first fsync a crash
// may leave an empty file under the target's name, without the second one the old file.

#define _GNU_SOURCE

#include "io/files/atomic_write.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    WRITE_BUFFER_BYTES = 64 * 1024,
    TEMPORARY_NAME_BYTES = 64, // ".talus-", two 64-bit numbers, ".tmp"
    NAME_ATTEMPTS = 1000,
};

struct tl_atomic_file {
    char *path;   // as the caller gave it
    char *target; // without symbolic links; NULL when the path is written to directly
    int folder;   // descriptor of the target's folder, or -1
    int descriptor;
    bool named; // the temporary file has the name below
    char temporary[TEMPORARY_NAME_BYTES];
    uint64_t size;
    size_t used; // bytes in the buffer
    tl_io_error failure;
    unsigned char buffer[WRITE_BUFFER_BYTES];
};

// Several files in the making in one folder, or what a killed process of the same number left, take different attempts.
static void make_temporary_name(char *name, int attempt)
{
    snprintf(name, TEMPORARY_NAME_BYTES, ".talus-%lld-%d.tmp", (long long)getpid(), attempt);
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

// Frees the file and takes its temporary name away.
static void discard(tl_atomic_file *file)
{
    if (file->named) {
        unlinkat(file->folder, file->temporary, 0);
    }
    if (file->descriptor >= 0 && file->descriptor != STDOUT_FILENO) {
        close(file->descriptor);
    }
    if (file->folder >= 0) {
        close(file->folder);
    }
    free(file->path);
    free(file->target);
    free(file);
}

static tl_result open_named(tl_atomic_file *file, mode_t mode)
{
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        make_temporary_name(file->temporary, i);
        file->descriptor = openat(file->folder, file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (file->descriptor >= 0) {
            file->named = true;
            return TL_OK;
        }
        if (errno != EEXIST) {
            break;
        }
    }
    return tl_io_fail_system(&file->failure, file->path, "write into its folder", errno);
}

static tl_result open_temporary(tl_atomic_file *file, const struct stat *existing)
{
    const char *name = base_name(file->target);
    char *folder = name == file->target ? strdup(".") : strndup(file->target, (size_t)(name - file->target));
    if (folder == NULL) {
        return tl_io_fail_system(&file->failure, file->path, "write", ENOMEM);
    }
    file->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    free(folder);
    if (file->folder < 0) {
        return tl_io_fail_system(&file->failure, file->path, "open its folder", errno);
    }
    // The kernel takes the umask off.
    mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) { // the way to give it a name later
        file->descriptor = openat(file->folder, ".", O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
    }
#endif
    if (file->descriptor < 0 && open_named(file, mode) != TL_OK) {
        return file->failure.result;
    }
    if (existing != NULL && fchmod(file->descriptor, existing->st_mode & 0777) != 0) {
        return tl_io_fail_system(&file->failure, file->path, "keep its permissions", errno);
    }
    return TL_OK;
}

static tl_result open_directly(tl_atomic_file *file)
{
    file->descriptor = open(file->path, O_WRONLY | O_CLOEXEC);
    return file->descriptor >= 0 ? TL_OK : tl_io_fail_system(&file->failure, file->path, "open", errno);
}

static tl_result open_target(tl_atomic_file *file)
{
    if (strcmp(file->path, "-") == 0) {
        file->descriptor = STDOUT_FILENO;
        return TL_OK;
    }
    if (file->path[0] == '\0') {
        return tl_io_fail_system(&file->failure, file->path, "write a file without a name", ENOENT);
    }
    struct stat status;
    bool exists = stat(file->path, &status) == 0;
    size_t length = strlen(file->path);
    if ((exists && S_ISDIR(status.st_mode)) || (length > 0 && file->path[length - 1] == '/')) {
        return tl_io_fail_system(&file->failure, file->path, "write", EISDIR);
    }
    if (exists && !S_ISREG(status.st_mode)) {
        return open_directly(file);
    }
    // A rename would replace a symbolic link instead of the file behind it. A link to nowhere is replaced.
    file->target = exists ? realpath(file->path, NULL) : strdup(file->path);
    if (file->target == NULL) {
        return tl_io_fail_system(&file->failure, file->path, "write", errno);
    }
    if (exists && faccessat(AT_FDCWD, file->target, W_OK, AT_EACCESS) != 0) {
        return tl_io_fail_system(&file->failure, file->path, "write", errno);
    }
    return open_temporary(file, exists ? &status : NULL);
}

tl_result tl_atomic_file_open(const char *path, tl_atomic_file **file_out, tl_io_error *error_out)
{
    *file_out = NULL;
    tl_atomic_file *file = malloc(sizeof *file);
    if (file == NULL) {
        return tl_io_fail_system(error_out, path, "write", ENOMEM);
    }
    // Not the buffer.
    memset(file, 0, offsetof(tl_atomic_file, buffer));
    file->folder = -1;
    file->descriptor = -1;
    file->path = strdup(path);
    tl_result result =
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
        ssize_t put = write(file->descriptor, bytes, size);
        if (put < 0 && errno == EINTR) {
            continue;
        }
        if (put < 0) {
            return tl_io_fail_system(&file->failure, file->path, "write", errno);
        }
        bytes += put;
        size -= (size_t)put;
    }
    return TL_OK;
}

static tl_result flush_buffer(tl_atomic_file *file)
{
    size_t used = file->used;
    file->used = 0;
    return write_through(file, file->buffer, used);
}

static tl_result append_to_file(tl_atomic_file *file, const unsigned char *bytes, size_t size)
{
    if (size > WRITE_BUFFER_BYTES - file->used) {
        tl_result result = flush_buffer(file);
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

// Gives the unnamed file a name, so that it can be renamed.
static tl_result link_unnamed(tl_atomic_file *file)
{
    char self[64];
    snprintf(self, sizeof self, "/proc/self/fd/%d", file->descriptor);
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        make_temporary_name(file->temporary, i);
        if (linkat(AT_FDCWD, self, file->folder, file->temporary, AT_SYMLINK_FOLLOW) == 0) {
            file->named = true;
            return TL_OK;
        }
        if (errno != EEXIST) {
            break;
        }
    }
    return tl_io_fail_system(&file->failure, file->path, "write", errno);
}

// fsync says EINVAL or EROFS of what cannot be flushed, such as a pipe or a folder of some file systems.
static bool flush_to_disk(int descriptor)
{
    int result;
    do {
        result = fsync(descriptor);
    } while (result != 0 && errno == EINTR);
    return result == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

static tl_result put_in_place(tl_atomic_file *file)
{
    if (!flush_to_disk(file->descriptor)) {
        return tl_io_fail_system(&file->failure, file->path, "flush to disk", errno);
    }
    if (file->target == NULL) {
        return TL_OK;
    }
    if (!file->named && link_unnamed(file) != TL_OK) {
        return file->failure.result;
    }
    if (renameat(file->folder, file->temporary, file->folder, base_name(file->target)) != 0) {
        return tl_io_fail_system(&file->failure, file->path, "replace", errno);
    }
    file->named = false;
    if (!flush_to_disk(file->folder)) {
        return tl_io_fail_system(&file->failure, file->path, "flush its folder to disk", errno);
    }
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
