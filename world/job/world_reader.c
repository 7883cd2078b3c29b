// SPDX-License-Identifier: MIT

#include "world/job/world_reader.h"

#include "world/bytes/folder.h"

#include <stdlib.h>
#include <string.h>

tl_result tl_world_reader_open(const char *path, tl_world_reader *reader_out, tl_io_error *error_out)
{
    memset(reader_out, 0, sizeof *reader_out);
    reader_out->path = path;
    return tl_random_file_open(path, &reader_out->file, error_out);
}

tl_result tl_world_reader_read(uint64_t offset, void *bytes, size_t size, void *user)
{
    tl_world_reader *reader = user;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    const tl_result result = tl_random_file_read(&reader->file, reader->path, offset, bytes, size, &error);
    if (result != TL_OK && reader->error.result == TL_OK) {
        reader->error = error;
    }
    return result;
}

void tl_world_reader_close(tl_world_reader *reader)
{
    free(reader->index_bytes);
    reader->index_bytes = NULL;
    tl_random_file_close(&reader->file);
}

tl_result tl_world_reader_fail(const tl_world_reader *reader, tl_result result, const tl_report *report,
                               tl_io_error *error_out)
{
    if (reader->error.result != TL_OK) {
        *error_out = reader->error;
        return result;
    }
    const char *advice = report->advice != NULL ? report->advice : "";
    if (report->element != NULL && report->element_index != TL_NO_ELEMENT) {
        return tl_io_fail(error_out, result, reader->path, 0, advice, "%s %llu: %s", report->element,
                          (unsigned long long)report->element_index, tl_result_text(result));
    }
    return tl_io_fail(error_out, result, reader->path, 0, advice, "%s", tl_result_text(result));
}

static tl_result read_index_bytes(tl_world_reader *reader, uint64_t size, tl_report *why, tl_io_error *error_out)
{
    reader->index_bytes = malloc((size_t)size);
    if (reader->index_bytes == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, reader->path, 0, "", "out of memory");
    }
    tl_result result =
        tl_random_file_read(&reader->file, reader->path, 0, reader->index_bytes, (size_t)size, error_out);
    if (result != TL_OK) {
        return result;
    }
    result = tl_pack_index_open(reader->index_bytes, size, &reader->index, why);
    return result == TL_OK ? result : tl_world_reader_fail(reader, result, why, error_out);
}

tl_result tl_world_reader_index(tl_world_reader *reader, tl_io_error *error_out)
{
    _Alignas(8) unsigned char head[TL_PACK_HEAD_SIZE];
    tl_file_facts facts;
    tl_report why;
    uint64_t size = 0;
    memset(&why, 0, sizeof why);
    if (!tl_file_look(reader->path, &facts) || facts.size < sizeof head) {
        return tl_io_fail(error_out, TL_ERR_TRUNCATED, reader->path, 0, "give a file of 'talus world merge'",
                          "is too short for a baked file");
    }
    tl_result result = tl_random_file_read(&reader->file, reader->path, 0, head, sizeof head, error_out);
    if (result != TL_OK) {
        return result;
    }
    result = tl_pack_index_size(head, &size, &why);
    if (result == TL_OK && size > facts.size) {
        result = TL_ERR_TRUNCATED;
        why.advice = "merge it again";
    }
    if (result != TL_OK) {
        return tl_world_reader_fail(reader, result, &why, error_out);
    }
    result = read_index_bytes(reader, size, &why, error_out);
    if (result == TL_OK && reader->index.file_size != facts.size) {
        result = reader->index.file_size > facts.size ? TL_ERR_TRUNCATED : TL_ERR_CORRUPT;
        why.advice = "merge it again";
        return tl_world_reader_fail(reader, result, &why, error_out);
    }
    return result;
}
