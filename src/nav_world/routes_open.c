// SPDX-License-Identifier: MIT
//
// The ROUT chunk: its check, and what a world makes of it when it is opened. Cells are not stored: they follow from the
// places of the gates, so that no damaged file can contradict itself in them.

#include "base/arena.h"
#include "base/assert.h"
#include "base/blob_check.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/range_fits.h"
#include "nav_world/routes.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_nav_routes) == 64 && sizeof(tl_nav_gate) == 40, "no hidden padding");

static tl_result corrupt_routes(tl_report *report, const char *element, uint64_t index)
{
    return tl_report_fail(report, TL_ERR_CORRUPT, element, index, "bake the routes again");
}

static bool is_sound_gate(const tl_nav_gate *gate)
{
    return gate->x >= 0 && gate->x <= TL_NAV_MAX_TILE_INDEX && gate->z >= 0 && gate->z <= TL_NAV_MAX_TILE_INDEX &&
           (gate->side == 1 || gate->side == 2) && gate->low >= 0 && gate->low < gate->high && isfinite(gate->height) &&
           gate->layer[0] <= TL_NAV_MAX_LAYER && gate->layer[1] <= TL_NAV_MAX_LAYER;
}

tl_result tl_nav_routes_check(const void *bytes, uint64_t size, tl_report *report)
{
    const tl_blob expected = { TL_PACK_ROUTES_MAGIC, TL_PACK_ROUTES_VERSION, sizeof(tl_nav_routes) };
    TL_TRY(tl_blob_check_head(bytes, size, expected, 8, report));
    const tl_nav_routes *routes = bytes;
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(routes->reserved); i++) {
        any |= routes->reserved[i];
    }
    if (any != 0 || size != routes->blob.size || !tl_route_is_block_side(routes->block) ||
        routes->gate_count > TL_ROUTE_MAX_GATES) {
        return corrupt_routes(report, any != 0 ? "padding" : "settings", TL_NO_ELEMENT);
    }
    const uint64_t end = sizeof *routes + (uint64_t)routes->gate_count * sizeof(tl_nav_gate) +
                         (uint64_t)routes->length_count * sizeof(float);
    if (end > size || size - end >= TL_BLOB_ALIGNMENT) {
        return corrupt_routes(report, "settings", TL_NO_ELEMENT);
    }
    const tl_nav_gate *gates = tl_nav_routes_gates(routes);
    for (uint32_t i = 0; i < routes->gate_count; i++) {
        if (!is_sound_gate(&gates[i])) {
            return corrupt_routes(report, "gate", i);
        }
    }
    const float *lengths = tl_nav_routes_lengths(routes);
    for (uint32_t i = 0; i < routes->length_count; i++) {
        if (!(lengths[i] >= 0.0f)) {
            return corrupt_routes(report, "length", i);
        }
    }
    for (uint64_t i = end; i < size; i++) {
        if (((const uint8_t *)bytes)[i] != 0) {
            return corrupt_routes(report, "padding", TL_NO_ELEMENT);
        }
    }
    return TL_OK;
}

uint64_t tl_route_tiles_hash(const tl_pack_index *index)
{
    uint64_t hash = 0;
    for (uint32_t i = 0; i < index->count; i++) {
        const tl_pack_entry *entry = &index->entries[i];
        if (entry->type == TL_PACK_NAVT) {
            hash = tl_hash_mix(hash ^ entry->hash);
        }
    }
    return hash;
}

tl_result tl_nav_routes_check_tiles(const tl_nav_routes *routes, const tl_pack_index *index, tl_report *report)
{
    tl_report_begin(report, "routes");
    TL_REFUSE_NULL(routes, report);
    TL_REFUSE_NULL(index, report);
    const uint64_t hash = (uint64_t)routes->tiles_hash[0] | (uint64_t)routes->tiles_hash[1] << 32;
    return hash == tl_route_tiles_hash(index)
               ? TL_OK
               : tl_report_fail(report, TL_ERR_CORRUPT, "tiles", TL_NO_ELEMENT,
                                "its routes are those of other tiles: bake the routes again");
}

// Whether a gate lies between two places of the world.
static bool is_of_world(const tl_nav_world *world, const tl_nav_gate *gate)
{
    int32_t across[2];
    tl_nav_gate_across(gate, across);
    return (uint32_t)gate->high <= world->tile_size &&
           tl_nav_world_find_place(world, gate->x, gate->z) != TL_NAV_WORLD_NO_PLACE &&
           tl_nav_world_find_place(world, across[0], across[1]) != TL_NAV_WORLD_NO_PLACE;
}

static tl_result take_routes(tl_nav_world *world, tl_world_routes *routes, uint32_t chunk, tl_report *report)
{
    const tl_nav_routes *blob = routes->blob;
    if (tl_nav_routes_check_tiles(blob, &world->index, NULL) != TL_OK) {
        return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", chunk,
                              "its routes are those of other tiles: bake the routes again");
    }
    const tl_nav_gate *gates = tl_nav_routes_gates(blob);
    for (uint32_t i = 0; i < blob->gate_count; i++) {
        if (!is_of_world(world, &gates[i])) {
            return corrupt_routes(report, "gate", i);
        }
    }
    routes->lengths = tl_nav_routes_lengths(blob);
    tl_result result = tl_route_tree_begin(&routes->tree, &world->allocator, gates, blob->gate_count, blob->block);
    if (result == TL_OK) {
        result = tl_route_tree_finish(&routes->tree);
    }
    if (result == TL_ERR_MEMORY) {
        return tl_nav_world_no_memory(report);
    }
    if (result != TL_OK || routes->tree.length_count != blob->length_count) {
        return corrupt_routes(report, "chunk", chunk);
    }
    return TL_OK;
}

static tl_result read_routes(tl_nav_world *world, const tl_pack_entry *entry, uint32_t chunk, tl_report *report)
{
    tl_world_routes *routes = tl_allocate_array(&world->allocator, 1, sizeof *routes);
    if (routes == NULL) {
        return tl_nav_world_no_memory(report);
    }
    memset(routes, 0, sizeof *routes);
    world->routes = routes;
    if (entry->size < sizeof(tl_nav_routes) || entry->size > SIZE_MAX / 2) {
        return corrupt_routes(report, "chunk", chunk);
    }
    routes->blob = tl_blob_allocate(&world->allocator, TL_PACK_ROUTES_MAGIC, TL_PACK_ROUTES_VERSION, entry->size);
    if (routes->blob == NULL) {
        return tl_nav_world_no_memory(report);
    }
    TL_TRY(tl_nav_world_read_bytes(world, entry->offset, routes->blob, (size_t)entry->size, "chunk", chunk, report));
    TL_TRY(tl_pack_entry_open(entry, routes->blob, report));
    TL_TRY(tl_nav_routes_check(routes->blob, entry->size, report));
    return take_routes(world, routes, chunk, report);
}

tl_result tl_nav_world_open_routes(tl_nav_world *world, tl_report *report)
{
    for (uint32_t i = 0; i < world->index.count; i++) {
        if (world->index.entries[i].type == TL_PACK_ROUT) {
            return read_routes(world, &world->index.entries[i], i, report);
        }
    }
    return TL_OK;
}

void tl_nav_world_close_routes(tl_nav_world *world)
{
    tl_world_routes *routes = world->routes;
    if (routes == NULL) {
        return;
    }
    tl_route_tree_free(&routes->tree);
    tl_blob_free(routes->blob);
    tl_release_array(&world->allocator, routes, 1, sizeof *routes);
    world->routes = NULL;
}
