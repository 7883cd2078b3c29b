// SPDX-License-Identifier: MIT
//
// A file in memory, as tl_pack_write fills it and worlds read it. Needs no framework: fuzz targets and the golden
// program have it too.

#ifndef TALUS_TEST_MEMORY_FILE_H
#define TALUS_TEST_MEMORY_FILE_H

#include <stdlib.h>
#include <string.h>
#include <talus/talus.h> // not a header of it: the amalgamation has this one alone

/// Zeroed: empty. Freed with free(bytes).
typedef struct memory_file {
    unsigned char *bytes;
    size_t size, capacity;
} memory_file;

/// A tl_write_fn.
static inline tl_result memory_file_write(const void *bytes, size_t size, void *user)
{
    memory_file *file = (memory_file *)user;
    if (size > file->capacity - file->size) {
        const size_t capacity = 2 * (file->size + size);
        unsigned char *grown = (unsigned char *)realloc(file->bytes, capacity);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        file->bytes = grown;
        file->capacity = capacity;
    }
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
    return TL_OK;
}

/// A tl_nav_world_read_fn.
static inline tl_result memory_file_read(uint64_t offset, void *bytes, size_t size, void *user)
{
    const memory_file *file = (const memory_file *)user;
    if (offset > file->size || size > file->size - offset) {
        return TL_ERR_TRUNCATED;
    }
    memcpy(bytes, file->bytes + offset, size);
    return TL_OK;
}

#endif
