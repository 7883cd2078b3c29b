// SPDX-License-Identifier: MIT
//
// Files as bytes.
//
// A file that is mapped may change between a look at it and the next: what a check has accepted is no longer there, and
// behind the end of a file that was cut short lies a signal. So files are copied; a copy costs a quarter of a second
// for a gigabyte, less than the check that follows. What is not asked to be mapped, or has no size (a pipe, a file of
// /proc), is read to its end, into a buffer that doubles.

#define _GNU_SOURCE

#include "io/files/file_map.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_READ_BYTES = 64 * 1024 };

static tl_result fail_too_large(const char *path, uint64_t max_bytes, tl_io_error *error)
{
    return tl_io_fail(error, TL_ERR_LIMIT, path, 0, "raise the limit, or cut the file into parts",
                      "larger than the limit of %llu bytes", (unsigned long long)max_bytes);
}

static tl_result fail_map_memory(const char *path, tl_io_error *error)
{
    return tl_io_fail(error, TL_ERR_MEMORY, path, 0, NULL, "out of memory while reading");
}

// A block of `capacity` bytes that begins with the `used` ones of the old block, which is freed in any case.
static void *enlarge(void *block, size_t used, size_t capacity)
{
    void *larger = capacity <= SIZE_MAX / 2 ? aligned_alloc(TL_BLOB_ALIGNMENT, capacity) : NULL;
    if (larger != NULL && used > 0) {
        memcpy(larger, block, used);
    }
    free(block);
    return larger;
}

// `expected` bytes are likely to come.
static tl_result read_stream(int descriptor, const char *path, uint64_t max_bytes, uint64_t expected, tl_file_map *map,
                             tl_io_error *error)
{
    // One byte more, so that the end is seen without doubling.
    size_t capacity =
        expected < SIZE_MAX / 4 ? (size_t)(expected / FIRST_READ_BYTES + 1) * FIRST_READ_BYTES : FIRST_READ_BYTES;
    size_t used = 0;
    unsigned char *bytes = enlarge(NULL, 0, capacity);
    for (;;) {
        if (used == capacity) {
            capacity *= 2;
            bytes = enlarge(bytes, used, capacity);
        }
        if (bytes == NULL) {
            return fail_map_memory(path, error);
        }
        ssize_t got = read(descriptor, bytes + used, capacity - used);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            int reason = errno;
            free(bytes);
            return tl_io_fail_system(error, path, "read", reason);
        }
        if (got == 0) {
            break;
        }
        used += (size_t)got;
        if (max_bytes != 0 && used > max_bytes) {
            free(bytes);
            return fail_too_large(path, max_bytes, error);
        }
    }
    map->bytes = bytes;
    map->size = used;
    return TL_OK;
}

static tl_result take_descriptor(int descriptor, const char *path, uint64_t max_bytes, bool may_map, tl_file_map *map,
                                 tl_io_error *error)
{
    struct stat status;
    if (fstat(descriptor, &status) != 0) {
        return tl_io_fail_system(error, path, "read", errno);
    }
    if (S_ISDIR(status.st_mode)) {
        return tl_io_fail_system(error, path, "read", EISDIR);
    }
    // A descriptor that was handed over (standard input) may stand anywhere in its file: it is read from there.
    if (!S_ISREG(status.st_mode) || status.st_size <= 0 || descriptor == STDIN_FILENO) {
        return read_stream(descriptor, path, max_bytes, 0, map, error);
    }
    uint64_t size = (uint64_t)status.st_size;
    if (max_bytes != 0 && size > max_bytes) {
        return fail_too_large(path, max_bytes, error);
    }
    if (size > SIZE_MAX) {
        return fail_map_memory(path, error);
    }
    if (!may_map) {
        return read_stream(descriptor, path, max_bytes, size, map, error);
    }
    void *bytes = mmap(NULL, (size_t)size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (bytes == MAP_FAILED) {
        // Some file systems cannot map.
        return read_stream(descriptor, path, max_bytes, size, map, error);
    }
    map->bytes = bytes;
    map->size = (size_t)size;
    map->mapped = true;
    return TL_OK;
}

static tl_result open_file_bytes(const char *path, uint64_t max_bytes, bool may_map, tl_file_map *map_out,
                                 tl_io_error *error_out)
{
    memset(map_out, 0, sizeof *map_out);
    if (strcmp(path, "-") == 0) {
        return take_descriptor(STDIN_FILENO, "standard input", max_bytes, may_map, map_out, error_out);
    }
    int descriptor;
    do {
        descriptor = open(path, O_RDONLY | O_CLOEXEC);
    } while (descriptor < 0 && errno == EINTR);
    if (descriptor < 0) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    tl_result result = take_descriptor(descriptor, path, max_bytes, may_map, map_out, error_out);
    close(descriptor);
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
        munmap((void *)(uintptr_t)map->bytes, map->size);
    } else {
        free((void *)(uintptr_t)map->bytes);
    }
    memset(map, 0, sizeof *map);
}
