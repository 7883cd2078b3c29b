// SPDX-License-Identifier: MIT
//
// The contract's level as a baked file of tiles.

#ifndef CONTRACT_WORLD_FILE_H
#define CONTRACT_WORLD_FILE_H

#include "contract_nav.h"
#include "memory_file.h"

#include <talus/nav_routes.h>

/// The level's tiles as a file, with routes unless they are NULL.
static inline memory_file level_file_make(const void *routes, uint64_t routes_size)
{
    const contract_level *level = contract_level_get();
    const tl_nav_tiles *tiles = &level->tiles;
    tl_pack_item items[9];
    memory_file file = { NULL, 0, 0 };
    tl_pack_navmesh *navmesh = NULL;
    tl_nav_def def = level->nav_def;
    def.bounds.min = tiles->tiles[0]->origin;
    def.bounds.max = tl_add(def.bounds.min, tl_vec3_make(30, 10, 30));
    TEST_CHECK(tiles->tile_count < 8);
    TEST_RESULT(tl_pack_navmesh_encode(&def, 4, 4, tiles->tile_count, NULL, &navmesh, NULL), TL_OK);
    const tl_pack_item settings = { TL_PACK_NAVM, 0, navmesh, navmesh->blob.size };
    items[0] = settings;
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        const tl_pack_item item = { TL_PACK_NAVT, i, tiles->tiles[i], tiles->tiles[i]->blob.size };
        items[1 + i] = item;
    }
    uint32_t count = 1 + tiles->tile_count;
    if (routes != NULL) {
        const tl_pack_item item = { TL_PACK_ROUT, 0, routes, routes_size };
        items[count++] = item;
    }
    TEST_RESULT(tl_pack_write(items, count, NULL, memory_file_write, &file, NULL), TL_OK);
    tl_blob_free(navmesh);
    return file;
}

#endif
