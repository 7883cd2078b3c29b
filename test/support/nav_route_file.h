// SPDX-License-Identifier: MIT
//
// Files of small worlds with their routes.

#ifndef TALUS_TEST_NAV_ROUTE_FILE_H
#define TALUS_TEST_NAV_ROUTE_FILE_H

#include "nav_world_file.h"

#include <talus/nav_routes.h>

static inline tl_nav_routes *route_file_bake(world_file *file, uint32_t block)
{
    tl_nav_routes_def def = tl_default_nav_routes_def();
    tl_nav_routes *routes = NULL;
    tl_report report;
    def.read = world_file_read;
    def.user = file;
    def.block = block;
    TEST_RESULT(tl_nav_routes_bake(&def, &routes, &report), TL_OK);
    TEST_RESULT(tl_nav_routes_check(routes, routes->blob.size, &report), TL_OK);
    return routes;
}

/// The chunks of a file, and one more.
static inline world_file route_file_with(const world_file *file, const void *routes, uint64_t size)
{
    enum { MAX_CHUNKS = 2048 };
    static tl_pack_item items[MAX_CHUNKS];
    tl_pack pack;
    world_file out;
    memset(&out, 0, sizeof out);
    unsigned char *bytes = (unsigned char *)test_blob_alloc(file->in.size);
    TEST_CHECK(bytes != NULL);
    memcpy(bytes, file->in.bytes, file->in.size);
    TEST_RESULT(tl_pack_to_host_order(bytes, file->in.size, NULL), TL_OK);
    TEST_RESULT(tl_pack_open(bytes, file->in.size, &pack, NULL), TL_OK);
    TEST_CHECK(pack.chunk_count < MAX_CHUNKS);
    for (uint32_t i = 0; i < pack.chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(&pack, i);
        const tl_pack_item item = { chunk.type, chunk.id, chunk.bytes, chunk.size };
        items[i] = item;
    }
    const tl_pack_item extra = { TL_PACK_ROUT, 0, routes, size };
    items[pack.chunk_count] = extra;
    TEST_RESULT(tl_pack_write(items, pack.chunk_count + 1, NULL, memory_file_write, &out.in, NULL), TL_OK);
    test_blob_free(bytes);
    return out;
}

/// A world's file with routes over such blocks.
static inline world_file route_file_make(const fixture_level *level, const double origin[3], uint32_t block)
{
    world_file bare = world_file_make(level, origin, TL_PACK_AXES_Y_UP);
    tl_nav_routes *routes = route_file_bake(&bare, block);
    world_file out = route_file_with(&bare, routes, routes->blob.size);
    tl_blob_free(routes);
    world_file_free(&bare);
    return out;
}

#endif
