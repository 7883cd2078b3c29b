// SPDX-License-Identifier: MIT
//
// From an open container to a navmesh that reads its tiles in place, with its links.

#include "base/assert.h"
#include "base/host.h"

#include <talus/pack.h>

static tl_result add_chunk(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report)
{
    if (chunk->type == TL_PACK_NAVT) {
        TL_TRY(tl_nav_tile_check(chunk->bytes, chunk->size, report));
        return tl_navmesh_add_tile(navmesh, chunk->bytes, TL_NAV_TILE_BORROWED);
    }
    if (chunk->type == TL_PACK_LINK) {
        TL_TRY(tl_nav_links_check(chunk->bytes, chunk->size, report));
        return tl_nav_links_add(chunk->bytes, NULL, navmesh);
    }
    return TL_OK;
}

static tl_result add_chunks(const tl_pack *pack, tl_navmesh *navmesh, tl_report *report)
{
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        tl_result result = add_chunk(&chunk, navmesh, report);
        if (result != TL_OK) {
            return tl_report_fail(report, result, "chunk", i, "bake the level again");
        }
    }
    return TL_OK;
}

tl_result tl_pack_load_navmesh(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                               tl_report *report_out)
{
    tl_report_begin(report_out, "load navmesh");
    if (navmesh_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "navmesh_out", "it may not be NULL");
    }
    *navmesh_out = NULL;
    if (pack == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "pack", "it may not be NULL");
    }
    if (tl_pack_count(pack, TL_PACK_NAVM) == 0 && tl_pack_count(pack, TL_PACK_NAVT) == 0) {
        return tl_report_fail(report_out, TL_NOT_FOUND, "chunk", TL_NO_ELEMENT, "bake the file with a navmesh");
    }
    tl_navmesh *navmesh = NULL;
    TL_TRY(tl_navmesh_create(allocator, &navmesh));
    tl_result result = add_chunks(pack, navmesh, report_out);
    if (result != TL_OK) {
        tl_navmesh_destroy(navmesh);
        return result;
    }
    *navmesh_out = navmesh;
    return TL_OK;
}
