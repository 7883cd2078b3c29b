// SPDX-License-Identifier: MIT
//
// Opening a world by its index: where each tile's bytes lie, and by the heads of the tiles which place they are of.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_world/routes.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { HEAD_BYTES = 256, LEAST_BUDGET = 65536 };

_Static_assert(offsetof(tl_nav_tile, first_corner) <= HEAD_BYTES, "a tile's place and bounds are in its head");

tl_nav_world_def tl_default_nav_world_def(void)
{
    tl_nav_world_def def;
    memset(&def, 0, sizeof def);
    def.budget = (uint64_t)64 << 20;
    def.frame_reach = 4096.0;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static tl_result check_world_def(const tl_nav_world_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_world_def()", report));
    if (def->read == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "read", "give a function that reads the file");
    }
    if (def->budget < LEAST_BUDGET) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "budget", "make it 65536 bytes or more");
    }
    if (!(def->frame_reach > 0.0) || !isfinite(def->frame_reach)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "frame_reach", "make it > 0 and finite");
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// The budget.

static void *purse_allocate(size_t size, size_t alignment, void *user)
{
    tl_nav_world_purse *purse = user;
    if (size > purse->limit - purse->taken) {
        return NULL;
    }
    void *block = tl_allocate(&purse->parent, size, alignment);
    if (block == NULL) {
        purse->parent_failed = true;
        return NULL;
    }
    purse->taken += size;
    purse->peak = purse->taken > purse->peak ? purse->taken : purse->peak;
    return block;
}

static void purse_release(void *block, size_t size, void *user)
{
    tl_nav_world_purse *purse = user;
    purse->taken -= size;
    tl_release(&purse->parent, block, size);
}

// ---------------------------------------------------------------------------------------------------------
// The file: its index and settings.

tl_result tl_nav_world_no_memory(tl_report *report)
{
    return tl_report_fail(report, TL_ERR_MEMORY, NULL, TL_NO_ELEMENT, "give it more memory");
}

tl_result tl_nav_world_read_bytes(const tl_nav_world *world, uint64_t offset, void *bytes, size_t size,
                                  const char *element, uint64_t index, tl_report *report)
{
    const tl_result result = world->read(offset, bytes, size, world->read_user);
    if (result == TL_OK) {
        return result;
    }
    return tl_report_fail(report, tl_is_error(result) ? result : TL_ERR_IO, element, index,
                          "the file could not be read");
}

static tl_result read_index(tl_nav_world *world, tl_report *report)
{
    union {
        uint64_t aligned[TL_PACK_HEAD_SIZE / 8];
        unsigned char bytes[TL_PACK_HEAD_SIZE];
    } head;
    TL_TRY(tl_nav_world_read_bytes(world, 0, head.bytes, TL_PACK_HEAD_SIZE, "header", TL_NO_ELEMENT, report));
    TL_TRY(tl_pack_index_size(head.bytes, &world->index_size, report));
    world->index_bytes = tl_allocate_array(&world->allocator, world->index_size, 1);
    if (world->index_bytes == NULL) {
        return tl_nav_world_no_memory(report);
    }
    TL_TRY(tl_nav_world_read_bytes(world, 0, world->index_bytes, (size_t)world->index_size, "table", TL_NO_ELEMENT,
                                   report));
    return tl_pack_index_open(world->index_bytes, world->index_size, &world->index, report);
}

// Bytes of a blob of a fixed size, with its padding.
#define BLOB_BYTES(type) ((sizeof(type) + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT * TL_BLOB_ALIGNMENT)

// Reads a chunk of a fixed size whole. TL_NOT_FOUND: the file has none.
static tl_result read_chunk(const tl_nav_world *world, uint32_t type, void *bytes, size_t size, tl_report *report)
{
    for (uint32_t i = 0; i < world->index.count; i++) {
        const tl_pack_entry *entry = &world->index.entries[i];
        if (entry->type != type) {
            continue;
        }
        if (entry->size != size) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", i, "bake the file again");
        }
        TL_TRY(tl_nav_world_read_bytes(world, entry->offset, bytes, size, "chunk", i, report));
        return tl_pack_entry_open(entry, bytes, report);
    }
    return TL_NOT_FOUND;
}

static tl_result read_settings(tl_nav_world *world, tl_report *report)
{
    union {
        tl_pack_navmesh blob;
        unsigned char bytes[BLOB_BYTES(tl_pack_navmesh)];
    } navmesh;
    union {
        tl_pack_frame blob;
        unsigned char bytes[BLOB_BYTES(tl_pack_frame)];
    } frame;
    const tl_result found = read_chunk(world, TL_PACK_NAVM, navmesh.bytes, sizeof navmesh, report);
    if (found == TL_NOT_FOUND) {
        return tl_report_fail(report, found, "chunk", TL_NO_ELEMENT, "give a file that was baked with a navmesh");
    }
    TL_TRY(found);
    TL_TRY(tl_pack_navmesh_check(navmesh.bytes, sizeof navmesh, report));
    world->lattice_origin = navmesh.blob.bounds.min;
    world->cell_size = navmesh.blob.cell_size;
    world->tile_size = navmesh.blob.tile_size;
    world->tiles_x = navmesh.blob.tiles_x;
    world->tiles_z = navmesh.blob.tiles_z;
    const tl_result framed = read_chunk(world, TL_PACK_FRAM, frame.bytes, sizeof frame, report);
    if (framed == TL_NOT_FOUND) {
        world->axes = TL_PACK_AXES_Y_UP;
        return TL_OK;
    }
    TL_TRY(framed);
    TL_TRY(tl_pack_frame_check(frame.bytes, sizeof frame, report));
    memcpy(world->origin, frame.blob.origin, sizeof world->origin);
    world->axes = frame.blob.axes;
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Tiles and places.

static uint32_t head_u32(const unsigned char *head, size_t offset)
{
    const unsigned char *at = head + offset;
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static float head_float(const unsigned char *head, size_t offset)
{
    const uint32_t bits = head_u32(head, offset);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// From the head of a tile as it stands in the file, which nothing has verified yet: a load does.
static bool read_head(const tl_nav_world *world, const unsigned char *head, tl_nav_world_tile *tile)
{
    const size_t box = offsetof(tl_nav_tile, bounds);
    tile->x = (int32_t)head_u32(head, offsetof(tl_nav_tile, tile_x));
    tile->z = (int32_t)head_u32(head, offsetof(tl_nav_tile, tile_z));
    tile->layer = head_u32(head, offsetof(tl_nav_tile, layer));
    tile->bounds.min = tl_vec3_make(head_float(head, box), head_float(head, box + 4), head_float(head, box + 8));
    tile->bounds.max = tl_vec3_make(head_float(head, box + 12), head_float(head, box + 16), head_float(head, box + 20));
    bool sound = head_u32(head, 0) == TL_NAV_TILE_MAGIC && tile->x >= 0 && tile->z >= 0 &&
                 (uint32_t)tile->x < world->tiles_x && (uint32_t)tile->z < world->tiles_z &&
                 tile->x <= TL_NAV_MAX_TILE_INDEX && tile->z <= TL_NAV_MAX_TILE_INDEX &&
                 tile->layer <= TL_NAV_MAX_LAYER;
    const tl_aabb *b = &tile->bounds;
    return sound && tl_is_finite(b->min) && tl_is_finite(b->max) && b->min.x <= b->max.x && b->min.y <= b->max.y &&
           b->min.z <= b->max.z;
}

static int compare_tiles(const tl_nav_world_tile *a, const tl_nav_world_tile *b)
{
    if (a->z != b->z || a->x != b->x) {
        return a->z != b->z ? (a->z < b->z ? -1 : 1) : a->x < b->x ? -1 : 1;
    }
    return (a->layer > b->layer) - (a->layer < b->layer);
}

static tl_result read_tiles(tl_nav_world *world, tl_report *report)
{
    const tl_nav_world_tile *before = NULL;
    for (uint32_t i = 0; i < world->index.count; i++) {
        const tl_pack_entry *entry = &world->index.entries[i];
        unsigned char head[HEAD_BYTES];
        if (entry->type != TL_PACK_NAVT) {
            continue;
        }
        if (entry->size < HEAD_BYTES || entry->size > SIZE_MAX / 2) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", i, "bake the file again");
        }
        TL_TRY(tl_nav_world_read_bytes(world, entry->offset, head, HEAD_BYTES, "chunk", i, report));
        tl_nav_world_tile *tile = &world->tiles[world->tile_count];
        memset(tile, 0, sizeof *tile);
        tile->entry = i;
        if (!read_head(world, head, tile)) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", i, "no tile of the file's grid: bake it again");
        }
        if (before != NULL && compare_tiles(before, tile) >= 0) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "chunk", i,
                                  "a tile that is there twice, or not in the order of a merged file: merge it again");
        }
        before = tile;
        world->tile_count++;
    }
    return TL_OK;
}

static void gather_places(tl_nav_world *world)
{
    tl_nav_world_place *place = NULL;
    for (uint32_t i = 0; i < world->tile_count; i++) {
        const tl_nav_world_tile *tile = &world->tiles[i];
        if (place == NULL || place->x != tile->x || place->z != tile->z) {
            place = &world->places[world->place_count++];
            memset(place, 0, sizeof *place);
            place->x = tile->x;
            place->z = tile->z;
            place->first_tile = i;
            place->bounds = tile->bounds;
            place->distance = (double)INFINITY;
        }
        place->tile_count++;
        place->bounds = tl_aabb_union(place->bounds, tile->bounds);
        place->file_bytes += world->index.entries[tile->entry].size;
    }
    static const int step[4][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 } };
    for (uint32_t i = 0; i < world->place_count; i++) {
        for (int side = 0; side < 4; side++) {
            world->places[i].neighbour[side] = tl_nav_world_find_place(
                world, (int64_t)world->places[i].x + step[side][0], (int64_t)world->places[i].z + step[side][1]);
        }
    }
}

// The navmesh, with tables for the tiles that the budget will hold: one that had to grow would be copied in a frame.
static tl_result create_navmesh(tl_nav_world *world)
{
    double file_bytes = 0.0;
    for (uint32_t i = 0; i < world->place_count; i++) {
        file_bytes += (double)world->places[i].file_bytes;
    }
    const double share = (double)world->purse.limit / (TL_NAV_WORLD_LEAST_RATIO * file_bytes);
    const uint32_t tiles = share < 1.0 ? (uint32_t)(share * (double)world->tile_count) : world->tile_count;
    TL_TRY(tl_navmesh_create(&world->budgeted, &world->navmesh));
    return tl_navmesh_reserve_tiles(world->navmesh, tiles);
}

static tl_result open_world(tl_nav_world *world, bool bare, tl_report *report)
{
    TL_TRY(read_index(world, report));
    TL_TRY(read_settings(world, report));
    uint32_t count = 0;
    for (uint32_t i = 0; i < world->index.count; i++) {
        const uint32_t type = world->index.entries[i].type;
        count += type == TL_PACK_NAVT;
        if (type == TL_PACK_LINK || type == TL_PACK_OFFM) {
            return tl_report_fail(report, TL_ERR_UNSUPPORTED, "chunk", i,
                                  "it has links, which need all tiles at once: load it by tl_pack_load_navmesh");
        }
    }
    if (count > TL_NAV_MAX_TILES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "chunk", TL_NO_ELEMENT, "bake with larger tiles");
    }
    world->tiles = tl_allocate_array(&world->allocator, count, sizeof *world->tiles);
    world->places = tl_allocate_array(&world->allocator, count, sizeof *world->places);
    world->wanted = tl_allocate_array(&world->allocator, count, sizeof *world->wanted);
    world->present = tl_allocate_array(&world->allocator, count, sizeof *world->present);
    world->open = tl_allocate_array(&world->allocator, count, sizeof *world->open);
    world->sorted = tl_allocate_array(&world->allocator, 2 * (uint64_t)count, sizeof *world->sorted);
    world->tile_capacity = count;
    if (world->tiles == NULL || world->places == NULL || world->wanted == NULL || world->present == NULL ||
        world->open == NULL || world->sorted == NULL) {
        return tl_nav_world_no_memory(report);
    }
    TL_TRY(read_tiles(world, report));
    gather_places(world);
    if (!bare) {
        TL_TRY(tl_nav_world_open_routes(world, report));
    }
    return create_navmesh(world) == TL_OK ? TL_OK : tl_nav_world_no_memory(report);
}

tl_result tl_nav_world_create(const tl_nav_world_def *def, tl_nav_world **world_out, tl_report *report)
{
    return tl_nav_world_open(def, false, world_out, report);
}

tl_result tl_nav_world_open(const tl_nav_world_def *def, bool bare, tl_nav_world **world_out, tl_report *report)
{
    tl_report_begin(report, "open world");
    TL_REFUSE_NULL(world_out, report);
    *world_out = NULL;
    TL_REFUSE_NULL(def, report);
    TL_TRY(check_world_def(def, report));
    tl_nav_world *world = tl_allocate_array(def->allocator, 1, sizeof *world);
    if (world == NULL) {
        return tl_nav_world_no_memory(report);
    }
    memset(world, 0, sizeof *world);
    world->allocator = tl_allocator_or_default(def->allocator);
    world->purse.parent = world->allocator;
    world->purse.limit = def->budget;
    const tl_allocator budgeted = { purse_allocate, purse_release, &world->purse };
    world->budgeted = budgeted;
    world->read = def->read;
    world->read_user = def->user;
    world->frame_reach = def->frame_reach;
    const tl_result result = open_world(world, bare, report);
    if (result != TL_OK) {
        tl_nav_world_destroy(world);
        return result;
    }
    *world_out = world;
    return TL_OK;
}

const tl_pack_index *tl_nav_world_index(const tl_nav_world *world)
{
    TL_ASSERT(world != NULL);
    return &world->index;
}

void tl_nav_world_destroy(tl_nav_world *world)
{
    if (world == NULL) {
        return;
    }
    tl_navmesh_destroy(world->navmesh);
    tl_nav_world_close_routes(world);
    for (uint32_t i = 0; i < world->place_count; i++) {
        tl_nav_world_drop_blobs(world, i);
    }
    const tl_allocator allocator = world->allocator;
    tl_release_array(&allocator, world->index_bytes, world->index_size, 1);
    tl_release_array(&allocator, world->tiles, world->tile_capacity, sizeof *world->tiles);
    tl_release_array(&allocator, world->places, world->tile_capacity, sizeof *world->places);
    tl_release_array(&allocator, world->wanted, world->tile_capacity, sizeof *world->wanted);
    tl_release_array(&allocator, world->present, world->tile_capacity, sizeof *world->present);
    tl_release_array(&allocator, world->open, world->tile_capacity, sizeof *world->open);
    tl_release_array(&allocator, world->sorted, 2 * (uint64_t)world->tile_capacity, sizeof *world->sorted);
    tl_release_array(&allocator, world->interests, world->interest_count, sizeof *world->interests);
    tl_release_array(&allocator, world, 1, sizeof *world);
}
