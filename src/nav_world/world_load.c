// SPDX-License-Identifier: MIT
//
// Loads: the tiles of one place, read and checked on a thread of the host's.
//
// Memory is taken when a load begins, on the thread that updates, so that the budget is counted without locks. A load
// that runs writes to its own tiles alone.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_world/world.h"

#include <math.h>
#include <string.h>

// What a tile takes beside its own bytes, in its bytes, before any was measured.
enum { FIRST_RATIO = 4 };

double tl_nav_world_bytes_needed(const tl_nav_world *world, uint32_t place)
{
    double ratio = (double)FIRST_RATIO;
    if (world->present_count >= 8) {
        ratio = (double)world->purse.taken / (double)world->present_file_bytes;
    }
    return (double)world->places[place].file_bytes * (ratio > 1.0 ? ratio : 1.0);
}

void tl_nav_world_drop_blobs(tl_nav_world *world, uint32_t place)
{
    const tl_nav_world_place *at = &world->places[place];
    for (uint32_t i = 0; i < at->tile_count; i++) {
        tl_blob_free(world->tiles[at->first_tile + i].blob);
        world->tiles[at->first_tile + i].blob = NULL;
    }
}

uint32_t tl_nav_world_next_wanted(const tl_nav_world *world)
{
    for (uint32_t i = 0; i < world->wanted_count && !world->is_full; i++) {
        if (world->places[world->wanted[i]].stage == TL_NAV_PLACE_ABSENT) {
            return world->wanted[i];
        }
    }
    return TL_NAV_WORLD_NO_PLACE;
}

bool tl_nav_world_has_room(const tl_nav_world *world, uint32_t place)
{
    // What is on its way has its tiles' bytes, and will take as much again as those in memory do.
    double coming = tl_nav_world_bytes_needed(world, place);
    coming *= (double)(1 + world->loading + world->ready);
    return (double)(world->purse.limit - world->purse.taken) >= coming;
}

static tl_result take_memory(tl_nav_world *world, uint32_t place)
{
    const tl_nav_world_place *at = &world->places[place];
    for (uint32_t i = 0; i < at->tile_count; i++) {
        tl_nav_world_tile *tile = &world->tiles[at->first_tile + i];
        const uint64_t size = world->index.entries[tile->entry].size;
        world->purse.parent_failed = false;
        tile->blob = tl_blob_allocate(&world->budgeted, TL_NAV_TILE_MAGIC, TL_NAV_TILE_VERSION, size);
        if (tile->blob == NULL) {
            tl_nav_world_drop_blobs(world, place);
            return world->purse.parent_failed ? TL_ERR_MEMORY : TL_NOT_FOUND;
        }
    }
    return TL_OK;
}

tl_result tl_nav_world_begin_load(tl_nav_world *world, tl_nav_world_load *load_out)
{
    if (load_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(load_out, 0, sizeof *load_out);
    if (world == NULL) {
        return TL_ERR_ARGUMENT;
    }
    const uint32_t next = tl_nav_world_next_wanted(world);
    if (next == TL_NAV_WORLD_NO_PLACE || !tl_nav_world_has_room(world, next)) {
        return TL_NOT_FOUND;
    }
    TL_TRY(take_memory(world, next));
    tl_nav_world_place *place = &world->places[next];
    place->stage = TL_NAV_PLACE_LOADING;
    world->loading++;
    load_out->world = world;
    load_out->place = next;
    load_out->tile_x = place->x;
    load_out->tile_z = place->z;
    load_out->result = TL_NOT_LOADED;
    return TL_OK;
}

// Whether a checked tile is the one that the index promised, of the file's own lattice.
static bool is_promised(const tl_nav_world *world, const tl_nav_world_tile *tile, const tl_nav_tile *blob)
{
    return blob->tile_x == tile->x && blob->tile_z == tile->z && blob->layer == tile->layer &&
           memcmp(&blob->bounds, &tile->bounds, sizeof tile->bounds) == 0 && blob->tile_size == world->tile_size &&
           blob->cell_size == world->cell_size && blob->origin.x == world->lattice_origin.x &&
           blob->origin.z == world->lattice_origin.z;
}

tl_result tl_nav_world_read_tile(const tl_nav_world *world, const tl_nav_world_tile *tile, tl_nav_tile *blob,
                                 const char **advice)
{
    const tl_pack_entry *entry = &world->index.entries[tile->entry];
    tl_report report;
    memset(&report, 0, sizeof report);
    tl_result result =
        tl_nav_world_read_bytes(world, entry->offset, blob, (size_t)entry->size, "chunk", tile->entry, &report);
    if (result == TL_OK) {
        result = tl_pack_entry_open(entry, blob, &report);
    }
    if (result == TL_OK) {
        result = tl_nav_tile_check(blob, entry->size, &report);
    }
    if (result == TL_OK && !is_promised(world, tile, blob)) {
        report.advice = "it is another tile than its head said: merge the file again";
        result = TL_ERR_CORRUPT;
    }
    *advice = report.advice;
    return result;
}

tl_result tl_nav_world_run_load(tl_nav_world_load *load)
{
    if (load == NULL || load->world == NULL) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_world *world = load->world;
    const tl_nav_world_place *place = &world->places[load->place];
    load->result = TL_OK;
    for (uint32_t i = 0; load->result == TL_OK && i < place->tile_count; i++) {
        const tl_nav_world_tile *tile = &world->tiles[place->first_tile + i];
        load->result = tl_nav_world_read_tile(world, tile, tile->blob, &load->advice);
    }
    return load->result;
}

tl_result tl_nav_world_end_load(tl_nav_world_load *load)
{
    if (load == NULL || load->world == NULL || load->place >= load->world->place_count ||
        load->world->places[load->place].stage != TL_NAV_PLACE_LOADING) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_world *world = load->world;
    tl_nav_world_place *place = &world->places[load->place];
    world->loading--;
    if (load->result == TL_OK) {
        place->stage = TL_NAV_PLACE_READY;
        world->ready++;
        world->read_bytes += place->file_bytes;
    } else {
        tl_nav_world_drop_blobs(world, load->place);
        // One that was never run is wanted still.
        place->stage = load->result == TL_NOT_LOADED ? TL_NAV_PLACE_ABSENT : TL_NAV_PLACE_FAILED;
        world->failed += place->stage == TL_NAV_PLACE_FAILED;
    }
    load->world = NULL;
    return TL_OK;
}
