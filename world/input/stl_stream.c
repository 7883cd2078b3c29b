// SPDX-License-Identifier: MIT
//
// Binary STL, the one common format that can be read in pieces: 50 bytes a triangle and nothing that points elsewhere.
// So a world of one file may be larger than memory.
//
// A file is read once, and then the system is told so. Else the inputs push the store, which is read twice more, out of
// the system's memory, and each page of both is a new one: a plan of 100 million triangles takes 17.5 s of processor
// instead of 25.2 s. Flushed parts of the store given up in the same way: no faster.

#include "world/bytes/little_endian.h"
#include "world/bytes/random_read.h"
#include "world/input/read_input.h"

#include <stdlib.h>
#include <string.h>

enum { STL_HEAD = 84, STL_TRIANGLE = 50, STL_PIECE = 1 << 14 }; // triangles

typedef struct stl_stream {
    const tl_world_input *input;
    const tl_host *host;
    tl_random_file file;
    tl_import_options options;
    unsigned char *bytes; // [STL_PIECE * STL_TRIANGLE]
    tl_vec3 *corners;     // [3 * STL_PIECE]
    uint64_t count;
} stl_stream;

static bool is_binary_stl_file(stl_stream *stream, const tl_file_facts *facts)
{
    unsigned char head[STL_HEAD];
    if (facts->size < STL_HEAD || tl_random_file_read(&stream->file, stream->input->path, 0, head, STL_HEAD, NULL)) {
        return false;
    }
    stream->count = tl_get_u32(head + 80);
    return stream->count > 0 && facts->size == STL_HEAD + stream->count * STL_TRIANGLE;
}

static tl_result take_stl_piece(stl_stream *stream, uint64_t first, uint32_t count, tl_world_builder *builder,
                                tl_io_error *error_out)
{
    static const double nowhere[3] = { 0.0, 0.0, 0.0 };
    const char *path = stream->input->path;
    tl_result result = tl_random_file_read(&stream->file, path, STL_HEAD + first * STL_TRIANGLE, stream->bytes,
                                           (size_t)count * STL_TRIANGLE, error_out);
    for (uint32_t i = 0; i < 3 * count && result == TL_OK; i++) {
        const unsigned char *at = stream->bytes + (size_t)(i / 3) * STL_TRIANGLE + 12 + 12 * (i % 3);
        stream->corners[i] = tl_vec3_make(tl_get_float(at), tl_get_float(at + 4), tl_get_float(at + 8));
    }
    if (result == TL_OK) {
        result = tl_import_place_vertices(&stream->options, path, stream->corners, 3 * count, error_out);
    }
    const bool turned = stream->input->up == TL_UP_Y_LEFT || stream->input->up == TL_UP_Z_LEFT;
    for (uint32_t i = 0; i < count && result == TL_OK; i++) {
        tl_vec3 *corner = stream->corners + 3 * (size_t)i;
        if (turned) {
            const tl_vec3 second = corner[1];
            corner[1] = corner[2];
            corner[2] = second;
        }
        result = tl_world_place_triangle(stream->input, corner, nowhere, stream->input->area, builder, error_out);
    }
    return result;
}

static tl_result stream_triangles(stl_stream *stream, uint64_t first, tl_world_builder *builder, tl_io_error *error_out)
{
    stream->bytes = malloc((size_t)STL_PIECE * STL_TRIANGLE);
    stream->corners = malloc(3 * (size_t)STL_PIECE * sizeof *stream->corners);
    if (stream->bytes == NULL || stream->corners == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, stream->input->path, 0, "", "out of memory");
    }
    const tl_progress *progress = stream->host != NULL ? stream->host->progress : NULL;
    tl_result result = TL_OK;
    while (first < stream->count && result == TL_OK) {
        const uint64_t left = stream->count - first;
        const uint32_t count = left < STL_PIECE ? (uint32_t)left : STL_PIECE;
        result = take_stl_piece(stream, first, count, builder, error_out);
        first += count;
        if (result == TL_OK && progress != NULL && !progress->update("store", first, stream->count, progress->user)) {
            result = tl_io_fail(error_out, TL_ERR_CANCELLED, NULL, 0, "", "cancelled");
        }
    }
    return result;
}

tl_result tl_world_stl_read(const tl_world_input *input, uint64_t first, const tl_host *host, tl_world_builder *builder,
                            uint64_t *count_out, tl_io_error *error_out)
{
    stl_stream stream;
    tl_file_facts facts;
    memset(&stream, 0, sizeof stream);
    stream.input = input;
    stream.host = host;
    stream.options = tl_default_import_options();
    stream.options.up_axis = input->up;
    stream.options.unit_scale = input->scale;
    *count_out = 0;
    if (!tl_file_look(input->path, &facts) || facts.is_folder) {
        return TL_NOT_FOUND; // the importer says why
    }
    tl_result result = tl_random_file_open(input->path, &stream.file, error_out);
    if (result == TL_OK) {
        result =
            is_binary_stl_file(&stream, &facts) ? stream_triangles(&stream, first, builder, error_out) : TL_NOT_FOUND;
        *count_out = stream.count;
    }
    if (result == TL_OK && !input->is_shared) {
        tl_random_file_forget(&stream.file);
    }
    free(stream.bytes);
    free(stream.corners);
    tl_random_file_close(&stream.file);
    return result;
}
