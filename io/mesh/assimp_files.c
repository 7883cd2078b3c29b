// SPDX-License-Identifier: MIT
//
// Assimp's callbacks over bytes in memory.

#include "io/mesh/assimp_files.h"

#include "io/files/sibling_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct open_bytes {
    struct aiFile file;
    const unsigned char *bytes;
    size_t size;
    size_t at;
    tl_file_map map; // zeroed for the source itself
} open_bytes;

static open_bytes *bytes_of(struct aiFile *file)
{
    return (open_bytes *)(void *)file->UserData;
}

static size_t read_items(struct aiFile *file, char *out, size_t size, size_t count)
{
    open_bytes *open = bytes_of(file);
    size_t there = size > 0 ? (open->size - open->at) / size : 0;
    size_t items = count < there ? count : there;
    if (items > 0) {
        memcpy(out, open->bytes + open->at, items * size);
    }
    open->at += items * size;
    return items;
}

static size_t write_nothing(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file;
    (void)bytes;
    (void)size;
    (void)count;
    return 0;
}

static size_t tell_position(struct aiFile *file)
{
    return bytes_of(file)->at;
}

static size_t tell_size(struct aiFile *file)
{
    return bytes_of(file)->size;
}

// Offsets are unsigned in Assimp's interface; one backwards has wrapped around, and wraps back when it is added.
static enum aiReturn seek_position(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    open_bytes *open = bytes_of(file);
    size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? open->at : open->size;
    size_t at = from + offset;
    if (at > open->size) {
        return aiReturn_FAILURE;
    }
    open->at = at;
    return aiReturn_SUCCESS;
}

static void flush_nothing(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *open_for_assimp(struct aiFileIO *io, const char *name, const char *mode)
{
    tl_assimp_files *files = (tl_assimp_files *)(void *)io->UserData;
    const tl_mesh_source *source = files->source;
    open_bytes *open = mode[0] == 'r' ? calloc(1, sizeof *open) : NULL;
    if (open == NULL) {
        return NULL;
    }
    if (strcmp(name, files->name) == 0) {
        open->bytes = source->bytes;
        open->size = source->size;
    } else {
        tl_io_error error;
        tl_result result = tl_sibling_open(source->path, name, source->name, &open->map, &error);
        if (result != TL_OK) {
            if (result == TL_ERR_UNSUPPORTED && source->path != NULL && files->refused.result == TL_OK) {
                files->refused = error;
            }
            free(open);
            return NULL;
        }
        open->bytes = open->map.bytes;
        open->size = open->map.size;
    }
    open->file = (struct aiFile){ read_items,    write_nothing, tell_position, tell_size,
                                  seek_position, flush_nothing, (char *)open };
    return &open->file;
}

static void close_for_assimp(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    open_bytes *open = bytes_of(file);
    tl_file_map_close(&open->map);
    free(open);
}

void tl_assimp_files_init(tl_assimp_files *files, const tl_mesh_source *source)
{
    memset(files, 0, sizeof *files);
    files->io = (struct aiFileIO){ open_for_assimp, close_for_assimp, (char *)files };
    files->source = source;
    const char *slash = source->path != NULL ? strrchr(source->path, '/') : NULL;
    const char *name = slash != NULL ? slash + 1 : source->path;
    size_t length = name != NULL ? strlen(name) : 0;
    size_t kind = strlen(source->kind);
    if (length == 0 || length + kind + 2 > sizeof files->name) {
        snprintf(files->name, sizeof files->name, "level.%s", source->kind);
        return;
    }
    // Files beside it may have its name, so it keeps it when its kind is what its extension says.
    bool says_kind = length > kind && name[length - kind - 1] == '.';
    for (size_t i = 0; i < kind && says_kind; i++) {
        char c = name[length - kind + i];
        says_kind = (c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c) == source->kind[i];
    }
    memcpy(files->name, name, length);
    if (!says_kind) {
        files->name[length] = '.';
        memcpy(files->name + length + 1, source->kind, kind);
    }
}
