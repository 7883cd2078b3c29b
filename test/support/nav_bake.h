// SPDX-License-Identifier: MIT
//
// A level to a navmesh that owns its tiles.

#ifndef TALUS_TEST_NAV_BAKE_H
#define TALUS_TEST_NAV_BAKE_H

#include "talus_test.h"

#include <talus/nav_bake.h>
#include <talus/nav_query.h>

static inline tl_navmesh *test_nav_bake(const tl_nav_def *def, const tl_nav_input *input)
{
    tl_navmesh *navmesh;
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(def, input, &tiles, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles.tiles[i], TL_NAV_TILE_OWNED), TL_OK);
        tiles.tiles[i] = NULL; // the navmesh's now
    }
    tl_nav_tiles_free(&tiles);
    return navmesh;
}

#endif
