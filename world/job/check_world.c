// SPDX-License-Identifier: MIT

#include "io/files/file_pack.h"
#include "world/job/merge_tiles.h"

#include <stdlib.h>
#include <string.h>
#include <talus/pack.h>

static tl_result fail_chunk(const char *path, uint32_t chunk, const char *what, tl_io_error *error_out)
{
    return tl_io_blame(error_out,
                       tl_io_fail(error_out, TL_ERR_CORRUPT, path, 0, "merge it again", "chunk %u: %s", chunk, what),
                       "chunk", chunk);
}

static int compare_places(const tl_nav_tile *a, const tl_nav_tile *b)
{
    const int64_t x[3] = { a->tile_z, a->tile_x, (int64_t)a->layer },
                  y[3] = { b->tile_z, b->tile_x, (int64_t)b->layer };
    for (int i = 0; i < 3; i++) {
        if (x[i] != y[i]) {
            return x[i] < y[i] ? -1 : 1;
        }
    }
    return 0;
}

static const char *tile_fault(const tl_nav_tile *tile, const tl_nav_tile *before, const tl_pack_navmesh *navmesh)
{
    const tl_vec3 origin = navmesh->bounds.min;
    if (tile->tile_x < 0 || tile->tile_z < 0 || (uint32_t)tile->tile_x >= navmesh->tiles_x ||
        (uint32_t)tile->tile_z >= navmesh->tiles_z) {
        return "a tile that lies outside the grid";
    }
    if (tile->tile_size != navmesh->tile_size || tile->cell_size != navmesh->cell_size ||
        tile->cell_height != navmesh->cell_height || tile->origin.x != origin.x || tile->origin.y != origin.y ||
        tile->origin.z != origin.z) {
        return "a tile of another lattice";
    }
    if (before != NULL && compare_places(before, tile) >= 0) {
        return "a tile that is there twice, or out of order";
    }
    return NULL;
}

static tl_result check_tiles(const char *path, const tl_pack *pack, const tl_pack_navmesh *navmesh,
                             tl_world_check_report *report, tl_io_error *error_out)
{
    const tl_nav_tile *before = NULL;
    for (uint32_t i = 0; i < pack->chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        if (chunk.type != TL_PACK_NAVT) {
            continue;
        }
        if (tl_nav_tile_check(chunk.bytes, chunk.size, NULL) != TL_OK) {
            return fail_chunk(path, i, "no sound tile", error_out);
        }
        const tl_nav_tile *tile = chunk.bytes;
        const char *fault = tile_fault(tile, before, navmesh);
        if (fault != NULL) {
            return fail_chunk(path, i, fault, error_out);
        }
        before = tile;
        report->tiles++;
        report->polygons += tile->polygon_count;
        report->links += tile->portal_count;
        report->area += tile->area;
    }
    report->tiles_x = navmesh->tiles_x;
    report->tiles_z = navmesh->tiles_z;
    if (report->tiles != navmesh->tile_count) {
        return tl_io_fail(error_out, TL_ERR_CORRUPT, path, 0, "merge it again", "holds %llu tiles, and says %u",
                          (unsigned long long)report->tiles, navmesh->tile_count);
    }
    return TL_OK;
}

static tl_result check_pack(const char *path, const tl_file_map *map, tl_world_check_report *report,
                            tl_io_error *error_out)
{
    tl_pack pack;
    tl_pack_chunk chunk;
    tl_report why;
    memset(&why, 0, sizeof why);
    tl_result result = tl_file_open_pack(map, &pack, &why);
    if (result != TL_OK) {
        return tl_io_fail(error_out, result, path, 0, "merge it again", "%s%s%s",
                          why.element != NULL ? why.element : "", why.element != NULL ? ": " : "",
                          tl_result_text(result));
    }
    result = tl_pack_find(&pack, TL_PACK_NAVM, 0, &chunk);
    if (result == TL_OK) {
        result = tl_pack_navmesh_check(chunk.bytes, chunk.size, NULL);
    }
    if (result != TL_OK) {
        return tl_io_fail(error_out, TL_ERR_CORRUPT, path, 0, "give a file of 'talus world merge'",
                          "holds no navmesh's settings");
    }
    result = check_tiles(path, &pack, chunk.bytes, report, error_out);
    if (result == TL_OK && report->tiles > 0) {
        tl_navmesh *navmesh = NULL;
        result = tl_pack_load_navmesh(&pack, NULL, &navmesh, &why);
        tl_navmesh_destroy(navmesh);
        if (result != TL_OK) {
            return tl_io_fail(error_out, result, path, 0, "merge it again", "the tiles do not join: %s",
                              tl_result_text(result));
        }
    }
    return result;
}

tl_result tl_world_check(const char *path, tl_world_check_report *report_out, tl_io_error *error_out)
{
    tl_file_map map;
    memset(report_out, 0, sizeof *report_out);
    tl_result result = tl_file_read(path, 0, &map, error_out);
    if (result == TL_OK) {
        result = check_pack(path, &map, report_out, error_out);
        tl_file_map_close(&map);
    }
    return result;
}
