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

#include "io/files/atomic_sink.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    TEMPORARY_NAME_BYTES = 64, // ".talus-", two 64-bit numbers, ".tmp"
    NAME_ATTEMPTS = 1000,
};

struct tl_atomic_sink {
    const char *path; // as the caller gave it
    char *target;     // without symbolic links; NULL when the path is written to directly
    int folder;       // descriptor of the target's folder, or -1
    int descriptor;
    bool named; // the temporary file has the name below
    char temporary[TEMPORARY_NAME_BYTES];
    tl_io_error *failure;
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

void tl_atomic_sink_close(tl_atomic_sink *sink)
{
    if (sink == NULL) {
        return;
    }
    if (sink->named) {
        unlinkat(sink->folder, sink->temporary, 0);
    }
    if (sink->descriptor >= 0 && sink->descriptor != STDOUT_FILENO) {
        close(sink->descriptor);
    }
    if (sink->folder >= 0) {
        close(sink->folder);
    }
    free(sink->target);
    free(sink);
}

static tl_result open_named(tl_atomic_sink *sink, mode_t mode)
{
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        make_temporary_name(sink->temporary, i);
        sink->descriptor = openat(sink->folder, sink->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (sink->descriptor >= 0) {
            sink->named = true;
            return TL_OK;
        }
        if (errno != EEXIST) {
            break;
        }
    }
    return tl_io_fail_system(sink->failure, sink->path, "write into its folder", errno);
}

static tl_result open_temporary(tl_atomic_sink *sink, const struct stat *existing)
{
    const char *name = base_name(sink->target);
    char *folder = name == sink->target ? strdup(".") : strndup(sink->target, (size_t)(name - sink->target));
    if (folder == NULL) {
        return tl_io_fail_system(sink->failure, sink->path, "write", ENOMEM);
    }
    sink->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    free(folder);
    if (sink->folder < 0) {
        return tl_io_fail_system(sink->failure, sink->path, "open its folder", errno);
    }
    // The kernel takes the umask off.
    mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) { // the way to give it a name later
        sink->descriptor = openat(sink->folder, ".", O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
    }
#endif
    if (sink->descriptor < 0 && open_named(sink, mode) != TL_OK) {
        return sink->failure->result;
    }
    if (existing != NULL && fchmod(sink->descriptor, existing->st_mode & 0777) != 0) {
        return tl_io_fail_system(sink->failure, sink->path, "keep its permissions", errno);
    }
    return TL_OK;
}

static tl_result open_directly(tl_atomic_sink *sink)
{
    sink->descriptor = open(sink->path, O_WRONLY | O_CLOEXEC);
    return sink->descriptor >= 0 ? TL_OK : tl_io_fail_system(sink->failure, sink->path, "open", errno);
}

static tl_result open_target(tl_atomic_sink *sink)
{
    if (strcmp(sink->path, "-") == 0) {
        sink->descriptor = STDOUT_FILENO;
        return TL_OK;
    }
    struct stat status;
    bool exists = stat(sink->path, &status) == 0;
    size_t length = strlen(sink->path);
    if ((exists && S_ISDIR(status.st_mode)) || sink->path[length - 1] == '/') {
        return tl_io_fail_system(sink->failure, sink->path, "write", EISDIR);
    }
    if (exists && !S_ISREG(status.st_mode)) {
        return open_directly(sink);
    }
    // A rename would replace a symbolic link instead of the file behind it. A link to nowhere is replaced.
    sink->target = exists ? realpath(sink->path, NULL) : strdup(sink->path);
    if (sink->target == NULL) {
        return tl_io_fail_system(sink->failure, sink->path, "write", errno);
    }
    if (exists && faccessat(AT_FDCWD, sink->target, W_OK, AT_EACCESS) != 0) {
        return tl_io_fail_system(sink->failure, sink->path, "write", errno);
    }
    return open_temporary(sink, exists ? &status : NULL);
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
    sink->folder = sink->descriptor = -1;
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
        ssize_t put = write(sink->descriptor, at, size);
        if (put < 0 && errno == EINTR) {
            continue;
        }
        if (put < 0) {
            return tl_io_fail_system(sink->failure, sink->path, "write", errno);
        }
        at += put;
        size -= (size_t)put;
    }
    return TL_OK;
}

// Gives the unnamed file a name, so that it can be renamed.
static tl_result link_unnamed(tl_atomic_sink *sink)
{
    char self[64];
    snprintf(self, sizeof self, "/proc/self/fd/%d", sink->descriptor);
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        make_temporary_name(sink->temporary, i);
        if (linkat(AT_FDCWD, self, sink->folder, sink->temporary, AT_SYMLINK_FOLLOW) == 0) {
            sink->named = true;
            return TL_OK;
        }
        if (errno != EEXIST) {
            break;
        }
    }
    return tl_io_fail_system(sink->failure, sink->path, "write", errno);
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

tl_result tl_atomic_sink_replace(tl_atomic_sink *sink, bool flush)
{
    if (flush && !flush_to_disk(sink->descriptor)) {
        return tl_io_fail_system(sink->failure, sink->path, "flush to disk", errno);
    }
    if (sink->target == NULL) {
        return TL_OK;
    }
    if (!sink->named && link_unnamed(sink) != TL_OK) {
        return sink->failure->result;
    }
    if (renameat(sink->folder, sink->temporary, sink->folder, base_name(sink->target)) != 0) {
        return tl_io_fail_system(sink->failure, sink->path, "replace", errno);
    }
    sink->named = false;
    if (flush && !flush_to_disk(sink->folder)) {
        return tl_io_fail_system(sink->failure, sink->path, "flush its folder to disk", errno);
    }
    return TL_OK;
}
