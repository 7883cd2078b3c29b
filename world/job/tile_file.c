// SPDX-License-Identifier: MIT

#include "world/job/tile_file.h"

#include "io/files/atomic_write.h"
#include "world/bytes/little_endian.h"

#include <stdlib.h>
#include <string.h>
#include <talus/pack.h>

static const char bake_again[] = "run 'talus world bake' again: it makes the tile anew";

static size_t table_size(uint64_t layers)
{
    return (size_t)((layers * 8 + 63) / 64 * 64);
}

static void encode_head(const tl_world_tile *tile, unsigned char *bytes, size_t size, uint32_t layers)
{
    memcpy(bytes, TL_WORLD_TILE_MAGIC, 8);
    tl_put_u32(bytes + 8, TL_WORLD_TILE_VERSION);
    tl_put_u32(bytes + 12, layers);
    tl_put_u64(bytes + 16, tile->key.low);
    tl_put_u64(bytes + 24, tile->key.high);
    tl_put_u32(bytes + 32, tile->x);
    tl_put_u32(bytes + 36, tile->z);
    tl_put_u64(bytes + 40, size);
    tl_put_u64(bytes + 48, tl_content_checksum(bytes + TL_WORLD_TILE_HEADER, size - TL_WORLD_TILE_HEADER));
    tl_put_u64(bytes + 56, tl_content_checksum(bytes, 56));
}

static tl_result encode_tile(const tl_world_tile *tile, const tl_nav_tile_stack *stack, unsigned char *bytes,
                             size_t size)
{
    unsigned char *at = bytes + TL_WORLD_TILE_HEADER + table_size(stack->count);
    for (uint32_t i = 0; i < stack->count; i++) {
        const uint64_t layer = stack->tiles[i]->blob.size;
        memcpy(at, stack->tiles[i], (size_t)layer);
        const tl_result result = tl_blob_to_file_order(at, layer, NULL);
        if (result != TL_OK) {
            return result;
        }
        tl_put_u64(bytes + TL_WORLD_TILE_HEADER + 8 * (size_t)i, layer);
        at += layer;
    }
    encode_head(tile, bytes, size, stack->count);
    return TL_OK;
}

tl_result tl_world_tile_write(const char *path, const tl_world_tile *tile, const tl_nav_tile_stack *stack,
                              tl_io_error *error_out)
{
    size_t size = TL_WORLD_TILE_HEADER + table_size(stack->count);
    for (uint32_t i = 0; i < stack->count; i++) {
        size += (size_t)stack->tiles[i]->blob.size;
    }
    unsigned char *bytes = calloc(1, size);
    if (bytes == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
    }
    tl_result result = encode_tile(tile, stack, bytes, size);
    if (result != TL_OK) {
        result = tl_io_fail(error_out, result, path, 0, "", "cannot be turned to the file's byte order");
    } else {
        result = tl_atomic_write_unflushed(path, bytes, size, error_out);
    }
    free(bytes);
    return result;
}

// What is wrong with the header of a file of `size` bytes; NULL: nothing.
static const char *header_fault(const unsigned char *bytes, uint64_t size, const tl_world_tile *tile,
                                tl_result *result_out)
{
    *result_out = TL_ERR_MAGIC;
    if (size < TL_WORLD_TILE_HEADER || memcmp(bytes, TL_WORLD_TILE_MAGIC, 8) != 0) {
        return "is no tile of a world";
    }
    *result_out = TL_ERR_VERSION;
    if (tl_get_u32(bytes + 8) != TL_WORLD_TILE_VERSION) {
        return "was written by another version";
    }
    *result_out = TL_ERR_HASH;
    if (tl_get_u64(bytes + 56) != tl_content_checksum(bytes, 56)) {
        return "is damaged: its header was altered";
    }
    *result_out = TL_ERR_TRUNCATED;
    if (tl_get_u64(bytes + 40) != size) {
        return "is damaged: it has another size than it says";
    }
    *result_out = TL_ERR_CORRUPT;
    const tl_content_hash key = { tl_get_u64(bytes + 16), tl_get_u64(bytes + 24) };
    if (!tl_content_hash_equal(key, tile->key) || tl_get_u32(bytes + 32) != tile->x ||
        tl_get_u32(bytes + 36) != tile->z) {
        return "is another tile than its name says";
    }
    *result_out = TL_OK;
    return NULL;
}

bool tl_world_tile_is_there(const char *path, const tl_world_tile *tile)
{
    tl_file_facts facts;
    tl_random_file file;
    unsigned char bytes[TL_WORLD_TILE_HEADER];
    tl_result result;
    if (!tl_file_look(path, &facts) || facts.size < TL_WORLD_TILE_HEADER ||
        tl_random_file_open(path, &file, NULL) != TL_OK) {
        return false;
    }
    const bool read = tl_random_file_read(&file, path, 0, bytes, sizeof bytes, NULL) == TL_OK;
    tl_random_file_close(&file);
    return read && header_fault(bytes, facts.size, tile, &result) == NULL;
}

static tl_result take_layers(unsigned char *bytes, uint64_t size, bool hashed, tl_world_layers *layers)
{
    const uint64_t count = tl_get_u32(bytes + 12);
    uint64_t offset = TL_WORLD_TILE_HEADER + (uint64_t)table_size(count);
    if (offset > size) {
        return TL_ERR_CORRUPT;
    }
    layers->tiles = malloc((size_t)(count + 1) * sizeof *layers->tiles);
    layers->entries = calloc((size_t)(count + 1), sizeof *layers->entries);
    if (layers->tiles == NULL || layers->entries == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < count; i++) {
        const uint64_t layer = tl_get_u64(bytes + TL_WORLD_TILE_HEADER + 8 * i);
        if (layer % 64 != 0 || layer < sizeof(tl_blob) || layer > size - offset) {
            return TL_ERR_CORRUPT;
        }
        layers->tiles[i] = (const tl_nav_tile *)(const void *)(bytes + offset);
        layers->entries[i].size = layer;
        if (hashed) {
            const tl_result result =
                tl_pack_entry_make(TL_PACK_NAVT, (uint32_t)i, bytes + offset, layer, &layers->entries[i]);
            if (result != TL_OK) {
                return result;
            }
        }
        offset += layer;
    }
    layers->count = (uint32_t)count;
    return offset == size ? TL_OK : TL_ERR_CORRUPT;
}

static tl_result fail_tile_file(tl_io_error *error_out, tl_result result, const char *path, const tl_world_tile *tile,
                                const char *fault)
{
    return tl_io_fail(error_out, result, path, 0, result == TL_ERR_MEMORY ? "" : bake_again, "tile %u,%u %s", tile->x,
                      tile->z, fault);
}

tl_result tl_world_tile_read(const char *path, const tl_world_tile *tile, bool hashed, tl_world_layers *layers_out,
                             tl_io_error *error_out)
{
    memset(layers_out, 0, sizeof *layers_out);
    tl_result result = tl_file_read(path, 0, &layers_out->map, error_out);
    if (result != TL_OK) {
        return result;
    }
    unsigned char *bytes = (unsigned char *)(uintptr_t)layers_out->map.bytes; // a copy, to be turned round in place
    const uint64_t size = layers_out->map.size;
    const char *fault = header_fault(bytes, size, tile, &result);
    if (fault == NULL && tl_get_u64(bytes + 48) !=
                             tl_content_checksum(bytes + TL_WORLD_TILE_HEADER, (size_t)(size - TL_WORLD_TILE_HEADER))) {
        result = TL_ERR_HASH;
        fault = "is damaged: its content was altered";
    }
    if (fault == NULL) {
        result = take_layers(bytes, size, hashed, layers_out);
        fault = result != TL_OK ? tl_result_text(result) : NULL;
    }
    if (fault != NULL) {
        tl_world_layers_free(layers_out);
        return fail_tile_file(error_out, result, path, tile, fault);
    }
    return TL_OK;
}

static tl_result check_layer(void *bytes, uint64_t size, const tl_world_tile *tile)
{
    tl_result result = tl_blob_to_host_order(bytes, size, NULL);
    if (result == TL_OK) {
        result = tl_nav_tile_check(bytes, size, NULL);
    }
    const tl_nav_tile *layer = bytes;
    const bool placed = result == TL_OK && layer->tile_x == (int32_t)tile->x && layer->tile_z == (int32_t)tile->z;
    return result != TL_OK ? result : placed ? TL_OK : TL_ERR_CORRUPT;
}

tl_result tl_world_layers_check(tl_world_layers *layers, const char *path, const tl_world_tile *tile,
                                tl_io_error *error_out)
{
    for (uint32_t i = 0; i < layers->count; i++) {
        const tl_result result =
            check_layer((void *)(uintptr_t)layers->tiles[i], layers->entries[i].size, tile); // of the map's copy
        if (result != TL_OK) {
            return fail_tile_file(error_out, result, path, tile, tl_result_text(result));
        }
    }
    return TL_OK;
}

void tl_world_layers_free(tl_world_layers *layers)
{
    free(layers->tiles);
    free(layers->entries);
    tl_file_map_close(&layers->map);
    memset(layers, 0, sizeof *layers);
}
