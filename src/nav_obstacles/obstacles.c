// SPDX-License-Identifier: MIT
//
// The compact heightfield of every tile, the obstacles on them, and the tiles that wait to be rebaked
// (obstacle_rebake.c).
//
// Source of the idea: DetourTileCache (Mikko Mononen), which keeps compressed layers of heights and cuts obstacles out
// of those. Here the whole compact field is kept, packed (packed_floors.c): floors over one another need no layers, and
// a tile is the same as a bake of the level with those volumes.

#include "nav_obstacles/obstacle_tiles.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_obstacles/footprint.h"

#include <string.h>

static uint64_t tile_count(const tl_nav_obstacles *o)
{
    return (uint64_t)o->tiles_x * o->tiles_z;
}

// ---------------------------------------------------------------------------------------------------------
// Waiting tiles: a queue through the tiles themselves, so that nothing has to be allocated.

// Where marks may have changed since the tile began to wait. NULL: anywhere.
static void note_change(tile_floors *tile, const tl_aabb *box)
{
    if (!tile->waits) {
        tile->changed = tl_aabb_empty();
        tile->all_changed = false;
    }
    tile->changed = box != NULL ? tl_aabb_union(tile->changed, *box) : tile->changed;
    tile->all_changed = tile->all_changed || box == NULL;
}

void tl_obstacles_let_wait(tl_nav_obstacles *o, const tl_nav_tile_range *range, const tl_aabb *box)
{
    for (uint32_t z = range->z; z < range->z + range->count_z; z++) {
        for (uint32_t x = range->x; x < range->x + range->count_x; x++) {
            tile_floors *tile = tl_obstacles_tile_at(o, x, z);
            if (!tile->is_there || (box != NULL && !tl_packed_floors_reach(&tile->floors, *box))) {
                continue;
            }
            note_change(tile, box);
            if (tile->waits) {
                continue;
            }
            uint32_t index = z * o->tiles_x + x;
            tile->waits = true;
            tile->next_waiting = OBSTACLE_NO_SLOT;
            if (o->last_waiting == OBSTACLE_NO_SLOT) {
                o->first_waiting = index;
            } else {
                o->tiles[o->last_waiting].next_waiting = index;
            }
            o->last_waiting = index;
            o->waiting_count++;
        }
    }
}

void tl_obstacles_end_wait(tl_nav_obstacles *o)
{
    tile_floors *tile = &o->tiles[o->first_waiting];
    o->first_waiting = tile->next_waiting;
    o->last_waiting = o->first_waiting == OBSTACLE_NO_SLOT ? OBSTACLE_NO_SLOT : o->last_waiting;
    tile->waits = false;
    o->waiting_count--;
}

// ---------------------------------------------------------------------------------------------------------
// Floors.

static void free_floors(tile_floors *tile, const tl_allocator *allocator)
{
    tl_packed_floors_free(&tile->floors);
    tl_tile_marks_free(&tile->marks, allocator);
    tile->is_known = false;
    tl_nav_tile_memo_free(tile->memo);
    tile->memo = NULL;
}

// Where a bake puts the floors that it makes: beside those that are there until all is well. Tiles may be taken by
// several threads.
typedef struct taken_floors {
    tl_packed_floors floors;
    tl_result result;
} taken_floors;

typedef struct floors_taker {
    const tl_allocator *allocator;
    tl_nav_tile_range range;
    taken_floors *fresh; // [range.count_x * range.count_z]
} floors_taker;

static void take_floors(const tl_nav_config *config, tl_nav_stages *stages, void *user)
{
    floors_taker *taker = user;
    const uint32_t x = config->tile_x - taker->range.x, z = config->tile_z - taker->range.z;
    taken_floors *fresh = &taker->fresh[(uint64_t)z * taker->range.count_x + x];
    fresh->result = tl_floors_pack(&stages->compact, taker->allocator, &fresh->floors);
}

static tl_result first_failure_of(const floors_taker *taker)
{
    const uint64_t count = (uint64_t)taker->range.count_x * taker->range.count_z;
    for (uint64_t i = 0; i < count; i++) {
        TL_TRY(taker->fresh[i].result);
    }
    return TL_OK;
}

static void install(tl_nav_obstacles *o, const floors_taker *taker)
{
    for (uint32_t z = 0; z < taker->range.count_z; z++) {
        for (uint32_t x = 0; x < taker->range.count_x; x++) {
            tile_floors *tile = tl_obstacles_tile_at(o, taker->range.x + x, taker->range.z + z);
            free_floors(tile, &o->allocator);
            tl_unpacked_tiles_forget(&o->unpacked, (uint32_t)(tile - o->tiles));
            tile->floors = taker->fresh[(uint64_t)z * taker->range.count_x + x].floors;
            tile->is_there = true;
        }
    }
}

static void drop_floors(const floors_taker *taker)
{
    const uint64_t count = (uint64_t)taker->range.count_x * taker->range.count_z;
    for (uint64_t i = 0; i < count; i++) {
        tl_packed_floors_free(&taker->fresh[i].floors);
    }
}

// Bakes a range and keeps its floors; the tiles come back in `block`.
static tl_result bake_range(tl_nav_obstacles *o, const tl_host *host, const tl_nav_input *input,
                            tl_nav_tile_range range, tl_nav_tile_block *block, tl_nav_bake_report *report_out)
{
    const uint64_t count = (uint64_t)range.count_x * range.count_z;
    floors_taker taker = { &o->allocator, range, tl_allocate_array(&o->allocator, count, sizeof *taker.fresh) };
    if (taker.fresh == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(taker.fresh, 0, (size_t)count * sizeof *taker.fresh);
    const tl_nav_stage_sink sink = { take_floors, &taker };
    tl_nav_def def = o->def;
    def.host = *host;
    def.host.allocator = &o->allocator;
    tl_result result = tl_nav_bake_range(&def, input, range, &sink, block, report_out);
    if (result == TL_OK) {
        result = first_failure_of(&taker);
    }
    if (result == TL_OK) {
        install(o, &taker);
    } else {
        drop_floors(&taker);
        tl_nav_tile_block_free(block);
    }
    tl_release_array(&o->allocator, taker.fresh, count, sizeof *taker.fresh);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Making and ending.

tl_report *tl_obstacles_report_begin(tl_nav_bake_report *report, const char *stage)
{
    if (report == NULL) {
        return NULL;
    }
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, stage);
    return &report->base;
}

static tl_result check_obstacles_def(const tl_nav_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_def()", report));
    if (def->tile_size == 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "tile_size",
                               "give a tile_size, such as 64: only touched tiles are made again");
    }
    if (tl_aabb_is_empty(def->bounds)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "bounds",
                               "give def->bounds, or the lattice moves when the mesh does");
    }
    return TL_OK;
}

static void free_windows(const tl_nav_obstacles *o)
{
    for (uint32_t w = 0; w < o->window_count; w++) {
        tl_floor_window_free(&o->windows[w], &o->allocator);
    }
    tl_release_array(&o->allocator, o->windows, o->window_count, sizeof *o->windows);
}

// Makes room for so many workers. Fewer can do with it.
static tl_result make_room_for_workers(tl_nav_obstacles *o, uint32_t workers)
{
    if (workers > o->window_count) {
        tl_floor_window *windows = tl_allocate_array(&o->allocator, workers, sizeof *windows);
        if (windows == NULL) {
            return TL_ERR_MEMORY;
        }
        memset(windows, 0, workers * sizeof *windows);
        free_windows(o);
        o->windows = windows;
        o->window_count = workers;
    }
    tl_unpacked_tiles_init(&o->unpacked, tile_count(o), workers);
    return TL_OK;
}

tl_result tl_nav_obstacles_set_tasks(tl_nav_obstacles *obstacles, const tl_tasks *tasks)
{
    TL_REFUSE_NULL(obstacles, NULL);
    const tl_host host = { NULL, tasks, NULL };
    TL_TRY(make_room_for_workers(obstacles, tl_worker_count(&host)));
    obstacles->tasks = tasks;
    return TL_OK;
}

static tl_result create(const tl_nav_def *def, tl_nav_obstacles **out, tl_report *report)
{
    TL_TRY(check_obstacles_def(def, report));
    uint32_t tiles_x, tiles_z;
    TL_TRY(tl_nav_tile_grid(def, def->bounds, &tiles_x, &tiles_z, report));
    if ((uint64_t)tiles_x * tiles_z > TL_NAV_MAX_TILES) {
        return tl_report_field(report, TL_ERR_LIMIT, "tile_size", "raise tile_size: obstacles keep every place");
    }
    const tl_allocator allocator = tl_allocator_or_default(def->host.allocator);
    tl_nav_obstacles *o = tl_allocate_array(&allocator, 1, sizeof *o);
    if (o == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(o, 0, sizeof *o);
    o->allocator = allocator;
    o->def = *def;
    memset(&o->def.host, 0, sizeof o->def.host);
    o->tiles_x = tiles_x;
    o->tiles_z = tiles_z;
    o->first_free = o->first_waiting = o->last_waiting = OBSTACLE_NO_SLOT;
    o->tiles = tl_allocate_array(&allocator, tile_count(o), sizeof *o->tiles);
    if (o->tiles == NULL) {
        tl_release_array(&allocator, o, 1, sizeof *o);
        return TL_ERR_MEMORY;
    }
    memset(o->tiles, 0, (size_t)tile_count(o) * sizeof *o->tiles);
    const tl_result result = make_room_for_workers(o, 1);
    if (result != TL_OK) {
        tl_nav_obstacles_destroy(o);
        return result;
    }
    *out = o;
    return TL_OK;
}

tl_result tl_nav_obstacles_bake(const tl_nav_def *def, const tl_nav_input *input, tl_nav_obstacles **obstacles_out,
                                tl_nav_tile_block *block_out, tl_nav_bake_report *report_out)
{
    tl_report *base = tl_obstacles_report_begin(report_out, "obstacles");
    tl_nav_obstacles *o = NULL;
    tl_nav_tile_block block;
    memset(&block, 0, sizeof block);
    if (block_out != NULL) {
        *block_out = block;
    }
    TL_REFUSE_NULL(obstacles_out, base);
    *obstacles_out = NULL;
    TL_REFUSE_NULL(input, base);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "obstacles");
    tl_result result = create(def, &o, &report.base);
    if (result == TL_OK) {
        tl_nav_tile_range all = { 0, 0, o->tiles_x, o->tiles_z };
        result = bake_range(o, &def->host, input, all, &block, &report);
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    if (result != TL_OK) {
        tl_nav_obstacles_destroy(o);
        return result;
    }
    for (uint64_t i = 0; i < tile_count(o); i++) {
        o->tiles[i].is_known = block_out != NULL;
    }
    if (block_out != NULL) {
        *block_out = block;
    } else {
        tl_obstacles_let_wait(o, &block.range, NULL);
        tl_nav_tile_block_free(&block);
    }
    *obstacles_out = o;
    return TL_OK;
}

tl_result tl_nav_obstacles_rebake(tl_nav_obstacles *obstacles, const tl_nav_input *input, tl_aabb changed,
                                  tl_nav_bake_report *report_out)
{
    tl_report *base = tl_obstacles_report_begin(report_out, "rebake");
    TL_REFUSE_NULL(obstacles, base);
    TL_REFUSE_NULL(input, base);
    tl_nav_obstacles *o = obstacles;
    tl_nav_tile_range range;
    tl_nav_tile_block block;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "rebake");
    tl_result result = tl_nav_tiles_in_box(&o->def, o->def.bounds, changed, &range, &report.base);
    if (result == TL_OK && range.count_x > 0) {
        const tl_host host = { NULL, o->tasks, NULL };
        result = bake_range(o, &host, input, range, &block, &report);
        if (result == TL_OK) {
            tl_nav_tile_block_free(&block); // made again with the obstacles
            tl_obstacles_let_wait(o, &range, NULL);
        }
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}

void tl_nav_obstacles_destroy(tl_nav_obstacles *obstacles)
{
    tl_nav_obstacles *o = obstacles;
    if (o == NULL) {
        return;
    }
    for (uint64_t i = 0; i < tile_count(o); i++) {
        free_floors(&o->tiles[i], &o->allocator);
    }
    tl_unpacked_tiles_free(&o->unpacked);
    free_windows(o);
    const tl_allocator allocator = o->allocator;
    tl_release_array(&allocator, o->tiles, tile_count(o), sizeof *o->tiles);
    tl_release_array(&allocator, o->slots, o->slot_capacity, sizeof *o->slots);
    tl_release_array(&allocator, o, 1, sizeof *o);
}

// ---------------------------------------------------------------------------------------------------------
// Obstacles.

static tl_nav_obstacle_id id_of(const tl_nav_obstacles *o, uint32_t slot)
{
    return (uint64_t)o->slots[slot].generation << 32 | slot;
}

static obstacle_slot *find_obstacle_slot(const tl_nav_obstacles *o, tl_nav_obstacle_id id)
{
    uint32_t slot = (uint32_t)id, generation = (uint32_t)(id >> 32);
    bool there = slot < o->slot_count && (generation & 1u) != 0 && o->slots[slot].generation == generation;
    return there ? &o->slots[slot] : NULL;
}

static tl_result range_of(const tl_nav_obstacles *o, const tl_nav_obstacle *obstacle, tl_nav_tile_range *range,
                          tl_aabb *box, tl_report *report)
{
    TL_TRY(tl_obstacle_check(obstacle, report));
    *box = tl_obstacle_box(obstacle, o->def.agent_radius, o->def.agent_height);
    return tl_nav_tiles_in_box(&o->def, o->def.bounds, *box, range, report);
}

static void place_obstacle(tl_nav_obstacles *o, obstacle_slot *slot, const tl_nav_obstacle *obstacle,
                           const tl_nav_tile_range *range, const tl_aabb *box)
{
    slot->obstacle = *obstacle;
    slot->range = *range;
    slot->box = *box;
    tl_obstacles_let_wait(o, range, box);
}

static tl_result take_slot(tl_nav_obstacles *o, uint32_t *slot_out)
{
    if (o->first_free != OBSTACLE_NO_SLOT) {
        *slot_out = o->first_free;
        o->first_free = o->slots[o->first_free].next_free;
        return TL_OK;
    }
    if (o->slot_count == o->slot_capacity) {
        uint32_t capacity = o->slot_capacity > 0 ? 2 * o->slot_capacity : 16;
        if (capacity < o->slot_capacity || capacity == OBSTACLE_NO_SLOT) {
            return TL_ERR_LIMIT;
        }
        obstacle_slot *slots = tl_allocate_array(&o->allocator, capacity, sizeof *slots);
        if (slots == NULL) {
            return TL_ERR_MEMORY;
        }
        if (o->slot_count > 0) {
            memcpy(slots, o->slots, o->slot_count * sizeof *slots);
        }
        tl_release_array(&o->allocator, o->slots, o->slot_capacity, sizeof *slots);
        o->slots = slots;
        o->slot_capacity = capacity;
    }
    memset(&o->slots[o->slot_count], 0, sizeof *o->slots);
    *slot_out = o->slot_count++;
    return TL_OK;
}

tl_result tl_nav_obstacles_add(tl_nav_obstacles *obstacles, const tl_nav_obstacle *obstacle, tl_nav_obstacle_id *id_out,
                               tl_report *report_out)
{
    tl_nav_tile_range range;
    tl_aabb box;
    uint32_t index = 0;
    tl_report_begin(report_out, "add obstacle");
    TL_REFUSE_NULL(id_out, report_out);
    *id_out = 0;
    TL_REFUSE_NULL(obstacles, report_out);
    TL_REFUSE_NULL(obstacle, report_out);
    TL_TRY(range_of(obstacles, obstacle, &range, &box, report_out));
    TL_TRY(take_slot(obstacles, &index));
    obstacle_slot *slot = &obstacles->slots[index];
    slot->generation++;
    obstacles->used_count++;
    place_obstacle(obstacles, slot, obstacle, &range, &box);
    *id_out = id_of(obstacles, index);
    return TL_OK;
}

tl_result tl_nav_obstacles_move(tl_nav_obstacles *obstacles, tl_nav_obstacle_id id, const tl_nav_obstacle *obstacle,
                                tl_report *report_out)
{
    tl_report_begin(report_out, "move obstacle");
    TL_REFUSE_NULL(obstacles, report_out);
    TL_REFUSE_NULL(obstacle, report_out);
    obstacle_slot *slot = find_obstacle_slot(obstacles, id);
    tl_nav_tile_range range;
    tl_aabb box;
    if (slot == NULL) {
        return tl_report_fail(report_out, TL_ERR_STALE, "obstacle", id, "it was removed, or never was");
    }
    TL_TRY(range_of(obstacles, obstacle, &range, &box, report_out));
    tl_obstacles_let_wait(obstacles, &slot->range, &slot->box);
    place_obstacle(obstacles, slot, obstacle, &range, &box);
    return TL_OK;
}

tl_result tl_nav_obstacles_remove(tl_nav_obstacles *obstacles, tl_nav_obstacle_id id)
{
    TL_REFUSE_NULL(obstacles, NULL);
    obstacle_slot *slot = find_obstacle_slot(obstacles, id);
    if (slot == NULL) {
        return TL_ERR_STALE;
    }
    tl_obstacles_let_wait(obstacles, &slot->range, &slot->box);
    slot->generation++;
    // A name is not used again: a slot whose generations are used up is given up.
    if (slot->generation != 0) {
        slot->next_free = obstacles->first_free;
        obstacles->first_free = (uint32_t)(slot - obstacles->slots);
    }
    obstacles->used_count--;
    return TL_OK;
}

uint32_t tl_nav_obstacles_count(const tl_nav_obstacles *obstacles)
{
    return obstacles->used_count;
}

uint32_t tl_nav_obstacles_waiting(const tl_nav_obstacles *obstacles)
{
    return obstacles->waiting_count;
}

uint64_t tl_nav_obstacles_bytes(const tl_nav_obstacles *obstacles)
{
    const tl_nav_obstacles *o = obstacles;
    uint64_t bytes = sizeof *o + tl_unpacked_tiles_bytes(&o->unpacked) + tile_count(o) * sizeof *o->tiles +
                     (uint64_t)o->slot_capacity * sizeof *o->slots;
    for (uint32_t w = 0; w < o->window_count; w++) {
        bytes += sizeof *o->windows + tl_floor_window_bytes(&o->windows[w]);
    }
    for (uint64_t i = 0; i < tile_count(o); i++) {
        bytes += (uint64_t)o->tiles[i].floors.block_count * sizeof(tl_floor_block);
        bytes += o->tiles[i].floors.size + tl_nav_tile_memo_bytes(o->tiles[i].memo);
        bytes += (uint64_t)o->tiles[i].marks.run_count * sizeof *o->tiles[i].marks.runs;
    }
    return bytes;
}
