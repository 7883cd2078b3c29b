// SPDX-License-Identifier: MIT
//
// From an open container to a navmesh that reads its tiles in place, with its links; and to one of what was left out.

#include "base/assert.h"
#include "base/host.h"

#include <talus/pack.h>

typedef tl_result add_chunk_fn(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report);

static tl_result add_tile(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report)
{
    TL_TRY(tl_nav_tile_check(chunk->bytes, chunk->size, report));
    return tl_navmesh_add_tile(navmesh, chunk->bytes, TL_NAV_TILE_BORROWED);
}

static tl_result add_offmesh(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report)
{
    TL_TRY(tl_pack_offmesh_check(chunk->bytes, chunk->size, report));
    const tl_pack_offmesh *offmesh = chunk->bytes;
    TL_TRY(tl_navmesh_reserve_offmesh(navmesh, offmesh->count));
    for (uint32_t i = 0; i < offmesh->count; i++) {
        const tl_nav_offmesh link = tl_pack_offmesh_at(offmesh, i);
        tl_nav_ref ref;
        TL_TRY(tl_navmesh_add_offmesh(navmesh, &link, &ref, report));
    }
    return TL_OK;
}

static tl_result add_navmesh_chunk(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report)
{
    if (chunk->type == TL_PACK_NAVT) {
        return add_tile(chunk, navmesh, report);
    }
    if (chunk->type == TL_PACK_LINK) {
        TL_TRY(tl_nav_links_check(chunk->bytes, chunk->size, report));
        return tl_nav_links_add(chunk->bytes, NULL, navmesh);
    }
    return chunk->type == TL_PACK_OFFM ? add_offmesh(chunk, navmesh, report) : TL_OK;
}

static tl_result add_pruned_chunk(const tl_pack_chunk *chunk, tl_navmesh *navmesh, tl_report *report)
{
    return chunk->type == TL_PACK_PRUT ? add_tile(chunk, navmesh, report) : TL_OK;
}

static tl_result add_chunks(const tl_pack *pack, add_chunk_fn *add, tl_navmesh *navmesh, tl_report *report)
{
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        tl_result result = add(&chunk, navmesh, report);
        if (result != TL_OK) {
            return tl_report_fail(report, result, "chunk", i, "bake the level again");
        }
    }
    return TL_OK;
}

static tl_result load_chunks(const tl_pack *pack, const uint32_t types[2], add_chunk_fn *add,
                             const tl_allocator *allocator, tl_navmesh **navmesh_out, tl_report *report)
{
    if (navmesh_out == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "navmesh_out", "it may not be NULL");
    }
    *navmesh_out = NULL;
    if (pack == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "pack", "it may not be NULL");
    }
    if (tl_pack_count(pack, types[0]) == 0 && tl_pack_count(pack, types[1]) == 0) {
        return tl_report_fail(report, TL_NOT_FOUND, "chunk", TL_NO_ELEMENT, "bake the file with a navmesh");
    }
    tl_navmesh *navmesh = NULL;
    TL_TRY(tl_navmesh_create(allocator, &navmesh));
    tl_result result = add_chunks(pack, add, navmesh, report);
    if (result != TL_OK) {
        tl_navmesh_destroy(navmesh);
        return result;
    }
    *navmesh_out = navmesh;
    return TL_OK;
}

tl_result tl_pack_load_navmesh(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                               tl_report *report_out)
{
    static const uint32_t types[2] = { TL_PACK_NAVM, TL_PACK_NAVT };
    tl_report_begin(report_out, "load navmesh");
    return load_chunks(pack, types, add_navmesh_chunk, allocator, navmesh_out, report_out);
}

tl_result tl_pack_load_pruned(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                              tl_report *report_out)
{
    static const uint32_t types[2] = { TL_PACK_PRUT, TL_PACK_PRUT };
    tl_report_begin(report_out, "load pruned");
    return load_chunks(pack, types, add_pruned_chunk, allocator, navmesh_out, report_out);
}
