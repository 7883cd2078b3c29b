// SPDX-License-Identifier: MIT
//
// Files as bytes.
//
// Mapping beats reading for the large files that matter here: no copy, and pages come in while the reader works. Only
// regular files with a size are mapped. All else is read to its end, into a buffer that doubles: a pipe has no size,
// and files of /proc claim 0.

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

static tl_result read_stream(int descriptor, const char *path, uint64_t max_bytes, tl_file_map *map, tl_io_error *error)
{
    size_t capacity = FIRST_READ_BYTES;
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

static tl_result map_descriptor(int descriptor, const char *path, uint64_t max_bytes, tl_file_map *map,
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
        return read_stream(descriptor, path, max_bytes, map, error);
    }
    uint64_t size = (uint64_t)status.st_size;
    if (max_bytes != 0 && size > max_bytes) {
        return fail_too_large(path, max_bytes, error);
    }
    if (size > SIZE_MAX) {
        return fail_map_memory(path, error);
    }
    void *bytes = mmap(NULL, (size_t)size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (bytes == MAP_FAILED) {
        // Some file systems cannot map.
        return read_stream(descriptor, path, max_bytes, map, error);
    }
    map->bytes = bytes;
    map->size = (size_t)size;
    map->mapped = true;
    return TL_OK;
}

tl_result tl_file_map_open(const char *path, uint64_t max_bytes, tl_file_map *map_out, tl_io_error *error_out)
{
    memset(map_out, 0, sizeof *map_out);
    if (strcmp(path, "-") == 0) {
        return map_descriptor(STDIN_FILENO, "standard input", max_bytes, map_out, error_out);
    }
    int descriptor;
    do {
        descriptor = open(path, O_RDONLY | O_CLOEXEC);
    } while (descriptor < 0 && errno == EINTR);
    if (descriptor < 0) {
        return tl_io_fail_system(error_out, path, "open", errno);
    }
    tl_result result = map_descriptor(descriptor, path, max_bytes, map_out, error_out);
    close(descriptor);
    return result;
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
