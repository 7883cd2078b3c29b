// SPDX-License-Identifier: MIT

#include "cli/level/write_pack.h"

#include "io/files/atomic_write.h"

#include <stdlib.h>
#include <string.h>

tl_result tl_pack_content_make(uint32_t max_count, tl_pack_content *content_out)
{
    memset(content_out, 0, sizeof(*content_out));
    content_out->items = calloc(max_count, sizeof(*content_out->items));
    return content_out->items != NULL ? TL_OK : TL_ERR_MEMORY;
}

void tl_pack_content_free(tl_pack_content *content)
{
    tl_blob_free(content->meta);
    tl_blob_free(content->navmesh);
    tl_blob_free(content->frame);
    free(content->items);
    memset(content, 0, sizeof(*content));
}

void tl_pack_content_add(tl_pack_content *content, uint32_t type, uint32_t id, const void *blob)
{
    if (blob != NULL) {
        tl_pack_item item = { type, id, blob, ((const tl_blob *)blob)->size };
        content->items[content->count++] = item;
    }
}

const char *tl_pack_source_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

tl_result tl_pack_content_of_bake(const tl_level *level, const tl_bake *bake, bool nav, tl_pack_content *content)
{
    tl_result result = tl_pack_content_make(bake->tiles.tile_count + bake->removed.tile_count + 10, content);
    if (result != TL_OK) {
        return result;
    }
    result = tl_pack_meta_encode(tl_pack_source_name(level->path), level->imported.vertex_count,
                                 level->imported.triangle_count, level->mesh.bounds, NULL, &content->meta, NULL);
    if (result == TL_OK) {
        content->meta->source_up = level->axes == TL_PACK_AXES_Z_UP ? TL_PACK_UP_Z : TL_PACK_UP_Y;
    }
    const double *o = level->origin;
    if (result == TL_OK && (level->axes != TL_PACK_AXES_Y_UP || o[0] != 0.0 || o[1] != 0.0 || o[2] != 0.0)) {
        result = tl_pack_frame_encode(level->axes, o, NULL, &content->frame, NULL);
    }
    if (result == TL_OK && nav) {
        tl_nav_def def = bake->nav_def;
        def.bounds = bake->nav_bounds;
        result = tl_pack_navmesh_encode(&def, bake->tiles.tiles_x, bake->tiles.tiles_z, bake->tiles.tile_count, NULL,
                                        &content->navmesh, NULL);
    }
    if (result != TL_OK) {
        return result;
    }
    tl_pack_content_add(content, TL_PACK_META, 0, content->meta);
    tl_pack_content_add(content, TL_PACK_FRAM, 0, content->frame);
    tl_pack_content_add(content, TL_PACK_SOUP, 0, bake->soup);
    tl_pack_content_add(content, TL_PACK_HULL, 0, bake->hull);
    tl_pack_content_add(content, TL_PACK_NAVM, 0, content->navmesh);
    for (uint32_t i = 0; i < bake->tiles.tile_count; ++i) {
        tl_pack_content_add(content, TL_PACK_NAVT, i, bake->tiles.tiles[i]);
    }
    tl_pack_content_add(content, TL_PACK_LINK, 0, bake->links.links);
    tl_pack_content_add(content, TL_PACK_OFFM, 0, bake->offmesh);
    tl_pack_content_add(content, TL_PACK_AREA, 0, bake->triangle_areas);
    tl_pack_content_add(content, TL_PACK_MARK, 0, bake->marks);
    tl_pack_content_add(content, TL_PACK_PRUN, 0, bake->pruning);
    for (uint32_t i = 0; i < bake->removed.tile_count; ++i) {
        tl_pack_content_add(content, TL_PACK_PRUT, i, bake->removed.tiles[i]);
    }
    return TL_OK;
}

typedef struct file_sink {
    tl_cli *cli;
    tl_atomic_file *file;
    tl_io_error error;
    uint64_t total;
} file_sink;

static tl_result write_pack_bytes(const void *bytes, size_t size, void *user)
{
    file_sink *sink = user;
    tl_result result = tl_atomic_file_write(sink->file, bytes, size, &sink->error);
    const tl_progress *progress = sink->cli->host.progress;
    uint64_t done = tl_atomic_file_size(sink->file);
    // The last step is left to the commit, which flushes to disk.
    if (result == TL_OK &&
        !progress->update("write", done < sink->total ? done : sink->total, sink->total + 1, progress->user)) {
        result = TL_ERR_CANCELLED;
    }
    return result;
}

tl_exit tl_pack_content_write(tl_cli *cli, const char *output, const tl_pack_content *content, uint64_t *size_out)
{
    file_sink sink;
    memset(&sink, 0, sizeof(sink));
    sink.cli = cli;
    sink.total = tl_pack_size(content->items, content->count);
    *size_out = sink.total;
    if (tl_atomic_file_open(output, &sink.file, &sink.error) != TL_OK) {
        return tl_cli_fail_io(cli, &sink.error);
    }
    tl_result result = tl_pack_write(content->items, content->count, NULL, write_pack_bytes, &sink, NULL);
    if (result != TL_OK) {
        tl_atomic_file_abort(sink.file);
        return sink.error.result != TL_OK ? tl_cli_fail_io(cli, &sink.error)
                                          : tl_cli_fail_result(cli, output, result, NULL);
    }
    if (tl_atomic_file_commit(sink.file, &sink.error) != TL_OK) {
        return tl_cli_fail_io(cli, &sink.error);
    }
    const tl_progress *progress = cli->host.progress;
    progress->update("write", sink.total + 1, sink.total + 1, progress->user);
    return TL_EXIT_OK;
}
