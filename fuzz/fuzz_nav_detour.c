// SPDX-License-Identifier: MIT
//
// Untrusted bytes as Detour tiles: what tl_detour_read accepts becomes a tile that passes its own check, and can be
// written and read again.

#include "fuzz/fuzz_input.h"

#include <string.h>
#include <talus/nav_detour.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tl_detour_tiles tiles;
    if (tl_detour_read(data, size, NULL, &tiles, NULL) != TL_OK) {
        require(tiles.tiles == NULL && tiles.tile_count == 0);
        return 0;
    }
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        const tl_nav_tile *tile = tiles.tiles[i];
        require(tl_nav_tile_check(tile, tile->blob.size, NULL) == TL_OK);
        uint64_t bytes_size = tl_detour_tile_size(tile, TL_DETOUR_REFS_32);
        if (bytes_size > 0) {
            void *bytes = malloc(bytes_size);
            require(bytes != NULL);
            require(tl_detour_tile_write(tile, TL_DETOUR_REFS_32, bytes, bytes_size, NULL) == TL_OK);
            free(bytes);
        }
    }
    tl_detour_tiles_free(&tiles);
    return 0;
}
