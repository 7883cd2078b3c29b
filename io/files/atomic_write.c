// SPDX-License-Identifier: MIT
//
// Atomic files: a buffer before a sink, and the first failure, which all later calls repeat.

#include "io/files/atomic_write.h"

#include "io/files/atomic_sink.h"

#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { WRITE_BUFFER_BYTES = 64 * 1024 };

struct tl_atomic_file {
    tl_atomic_sink *sink;
    char *path; // as the caller gave it
    uint64_t size;
    size_t used; // bytes in the buffer
    tl_io_error failure;
    unsigned char buffer[WRITE_BUFFER_BYTES];
};

static void discard(tl_atomic_file *file)
{
    tl_atomic_sink_close(file->sink);
    free(file->path);
    free(file);
}

static char *copy_path(const char *path)
{
    const size_t size = strlen(path) + 1;
    char *copy = malloc(size);
    return copy != NULL ? memcpy(copy, path, size) : NULL;
}

tl_result tl_atomic_file_open(const char *path, tl_atomic_file **file_out, tl_io_error *error_out)
{
    *file_out = NULL;
    tl_atomic_file *file = malloc(sizeof *file);
    if (file == NULL) {
        return tl_io_fail_system(error_out, path, "write", ENOMEM);
    }
    memset(file, 0, offsetof(tl_atomic_file, buffer)); // not the buffer
    file->path = copy_path(path);
    const tl_result result = file->path == NULL ? tl_io_fail_system(&file->failure, path, "write", ENOMEM)
                             : path[0] == '\0'
                                 ? tl_io_fail_system(&file->failure, path, "write a file without a name", ENOENT)
                                 : tl_atomic_sink_open(file->path, &file->failure, &file->sink);
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

static tl_result flush_buffer(tl_atomic_file *file)
{
    const size_t used = file->used;
    file->used = 0;
    return tl_atomic_sink_write(file->sink, file->buffer, used);
}

// The sink gets whole buffers, so that no page of a file is written in two parts.
static tl_result append_to_file(tl_atomic_file *file, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    const size_t room = WRITE_BUFFER_BYTES - file->used;
    if (size > room) {
        memcpy(file->buffer + file->used, at, room);
        file->used = WRITE_BUFFER_BYTES;
        at += room;
        size -= room;
        const size_t whole = size / WRITE_BUFFER_BYTES * WRITE_BUFFER_BYTES;
        tl_result result = flush_buffer(file);
        if (result == TL_OK && whole > 0) {
            result = tl_atomic_sink_write(file->sink, at, whole);
        }
        if (result != TL_OK) {
            return result;
        }
        at += whole;
        size -= whole;
    }
    memcpy(file->buffer + file->used, at, size);
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

static tl_result put_in_place(tl_atomic_file *file, bool flush, tl_io_error *error_out)
{
    tl_result result = file->failure.result;
    if (result == TL_OK) {
        result = flush_buffer(file);
    }
    if (result == TL_OK) {
        result = tl_atomic_sink_replace(file->sink, flush);
    }
    if (result != TL_OK && error_out != NULL) {
        *error_out = file->failure;
    }
    discard(file);
    return result;
}

tl_result tl_atomic_file_commit(tl_atomic_file *file, tl_io_error *error_out)
{
    return put_in_place(file, true, error_out);
}

tl_result tl_atomic_file_commit_unflushed(tl_atomic_file *file, tl_io_error *error_out)
{
    return put_in_place(file, false, error_out);
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

static tl_result write_whole(const char *path, const void *bytes, size_t size, bool flush, tl_io_error *error_out)
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
    return put_in_place(file, flush, error_out);
}

tl_result tl_atomic_write(const char *path, const void *bytes, size_t size, tl_io_error *error_out)
{
    return write_whole(path, bytes, size, true, error_out);
}

tl_result tl_atomic_write_unflushed(const char *path, const void *bytes, size_t size, tl_io_error *error_out)
{
    return write_whole(path, bytes, size, false, error_out);
}
