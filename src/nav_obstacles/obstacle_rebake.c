// SPDX-License-Identifier: MIT
//
// Tiles made again with what stands on them now, one by one as they wait. Only the columns that edits have reached are
// marked anew; the marks of the others are known. Most tiles that an edit reaches need not be baked: where it marks no
// other floors, which is seen without unpacking the tile, or only floors of the border that the tile does not see, the
// tile has the bytes that were handed out last.

#include "nav_obstacles/obstacle_tiles.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "nav_obstacles/footprint.h"

#include <string.h>

static bool range_holds(const tl_nav_tile_range *range, uint32_t x, uint32_t z)
{
    return x >= range->x && x - range->x < range->count_x && z >= range->z && z - range->z < range->count_z;
}

// Whether a slot has an obstacle that touches the tile.
static bool stands_on(const obstacle_slot *slot, uint32_t x, uint32_t z)
{
    return (slot->generation & 1u) != 0 && range_holds(&slot->range, x, z);
}

static bool reaches_columns(const tl_nav_compact *compact, const tl_aabb *box)
{
    const tl_obstacle_window window = tl_obstacle_window_make(compact, *box);
    return !tl_obstacle_window_is_empty(&window);
}

// Marks all of one area, and finds the next higher area of those that reach the columns; OBSTACLE_NO_SLOT: none.
static uint32_t mark_area(const tl_nav_obstacles *o, uint32_t x, uint32_t z, uint32_t area, tl_nav_compact *compact)
{
    uint32_t next = OBSTACLE_NO_SLOT;
    for (uint32_t i = 0; i < o->slot_count; i++) {
        const obstacle_slot *slot = &o->slots[i];
        if (!stands_on(slot, x, z) || !reaches_columns(compact, &slot->box)) {
            continue;
        }
        if (slot->obstacle.area == area) {
            tl_obstacle_mark(&slot->obstacle, o->def.agent_radius, o->def.agent_height, compact);
        } else if (slot->obstacle.area > area && slot->obstacle.area < next) {
            next = slot->obstacle.area;
        }
    }
    return next;
}

// By area, not by who came first: where areas overlap the highest number counts, and a body always cuts. A floor that
// is cut stays cut, so the bodies, whose area is 0, come first.
static void mark_obstacles(const tl_nav_obstacles *o, uint32_t x, uint32_t z, tl_nav_compact *compact)
{
    for (uint32_t area = TL_NAV_NULL_AREA; area != OBSTACLE_NO_SLOT;) {
        area = mark_area(o, x, z, area, compact);
    }
}

// TL_NOT_FOUND: all that was marked since is out in the border, and the tile has the bytes that were handed out last.
static tl_result compare_borders(const tl_nav_obstacles *o, const tile_floors *tile, const tl_nav_config *config,
                                 const tl_nav_compact *compact, const uint8_t *base_area)
{
    if (!tile->is_known || config->partition == TL_NAV_WATERSHED) {
        return TL_OK;
    }
    uint8_t *before = tl_allocate_array(&o->allocator, compact->span_count, sizeof *before);
    if (before == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_tile_marks_apply(&tile->marks, base_area, 0, compact->span_count, before);
    const bool same = tl_nav_tile_keeps_bytes(config, compact, before);
    tl_release_array(&o->allocator, before, compact->span_count, sizeof *before);
    return same ? TL_NOT_FOUND : TL_OK;
}

static tl_result rebake_marked(const tl_nav_obstacles *o, tile_floors *tile, tl_unpacked_tile *now,
                               tl_nav_rebaked_tile *rebaked, tl_nav_bake_report *report)
{
    const uint32_t x = (uint32_t)rebaked->tile_x, z = (uint32_t)rebaked->tile_z;
    tl_nav_config config;
    tl_tile_marks marks;
    TL_TRY(tl_nav_config_from_def(&o->def, o->def.bounds, x, z, &config, report != NULL ? &report->base : NULL));
    tl_unpacked_tile_link(now);
    tl_nav_compact compact = now->compact;
    TL_TRY(tl_tile_marks_find(now->base_area, compact.area, compact.span_count, &o->allocator, &marks));
    tl_result result = compare_borders(o, tile, &config, &compact, now->base_area);
    if (result == TL_OK) {
        const tl_host host = { &o->allocator, NULL, NULL };
        result = tl_nav_tile_rebake(&config, &compact, now->base_area, &tile->memo, &host, &rebaked->stack, report);
    }
    tl_tile_marks_free(tl_is_error(result) ? &marks : &tile->marks, &o->allocator);
    if (!tl_is_error(result)) {
        tile->marks = marks;
    }
    return result;
}

// Makes a window hold another.
static void widen_window(tl_obstacle_window *window, const tl_obstacle_window *other)
{
    window->first_x = tl_min_u32(window->first_x, other->first_x);
    window->first_z = tl_min_u32(window->first_z, other->first_z);
    window->end_x = tl_max_u32(window->end_x, other->end_x);
    window->end_z = tl_max_u32(window->end_z, other->end_z);
}

static bool windows_overlap(const tl_obstacle_window *a, const tl_obstacle_window *b)
{
    return a->first_x < b->end_x && b->first_x < a->end_x && a->first_z < b->end_z && b->first_z < a->end_z;
}

// The columns in which marks may have changed since the tile was handed out. A shape at any pose finds the ends of a
// row's marked columns by searching between those of its own window: it is there as a whole or not at all.
static tl_obstacle_window changed_columns(const tl_nav_obstacles *o, const tile_floors *tile, uint32_t x, uint32_t z)
{
    const tl_nav_compact *frame = &tile->floors.frame;
    tl_obstacle_window window = tl_obstacle_window_make(frame, tile->changed), before;
    do {
        before = window;
        for (uint32_t i = 0; i < o->slot_count; i++) {
            const obstacle_slot *slot = &o->slots[i];
            if (slot->obstacle.shape == TL_NAV_OBSTACLE_CONVEX && stands_on(slot, x, z)) {
                const tl_obstacle_window own = tl_obstacle_window_make(frame, slot->box);
                if (windows_overlap(&window, &own)) {
                    widen_window(&window, &own);
                }
            }
        }
    } while (memcmp(&before, &window, sizeof before) != 0);
    return window;
}

// Marks the changed columns of a tile that is known. TL_NOT_FOUND: they are as they were handed out last.
static tl_result mark_changed_columns(const tl_nav_obstacles *o, tl_floor_window *columns, const tile_floors *tile,
                                      uint32_t x, uint32_t z)
{
    TL_TRY(tl_floor_window_read(columns, &tile->floors, changed_columns(o, tile, x, z), &o->allocator));
    mark_obstacles(o, x, z, &columns->compact);
    return tl_floor_window_holds(columns, &tile->marks) ? TL_NOT_FOUND : TL_OK;
}

// A tile that waits, and what is made of it.
typedef struct rebake_job {
    uint32_t tile;
    tl_unpacked_tile *room; // for its floors
    tl_nav_rebaked_tile rebaked;
    tl_nav_bake_report report;
    tl_result result; // TL_NOT_FOUND: the tile is as it was handed out last
} rebake_job;

// Makes a tile with what stands on it now.
static tl_result rebake_with_obstacles(const tl_nav_obstacles *o, tl_floor_window *columns, rebake_job *job)
{
    tile_floors *tile = &o->tiles[job->tile];
    tl_unpacked_tile *now = job->room;
    if (tile->floors.frame.span_count == 0) {
        return tile->is_known ? TL_NOT_FOUND : TL_OK;
    }
    const uint32_t x = (uint32_t)job->rebaked.tile_x, z = (uint32_t)job->rebaked.tile_z;
    const bool only_changed = tile->is_known && !tile->all_changed;
    if (only_changed) {
        const tl_result marked = mark_changed_columns(o, columns, tile, x, z);
        if (marked != TL_OK) {
            return marked;
        }
    }
    TL_TRY(tl_unpacked_tile_fill(now, job->tile, &tile->floors, &o->allocator));
    tl_nav_compact *compact = &now->compact;
    if (only_changed) {
        tl_tile_marks_apply(&tile->marks, now->base_area, 0, compact->span_count, compact->area);
        tl_floor_window_paste(columns, compact->area);
    } else {
        mark_obstacles(o, x, z, compact);
        if (tile->is_known && tl_tile_marks_hold(&tile->marks, now->base_area, compact->area, compact->span_count)) {
            return TL_NOT_FOUND;
        }
    }
    return rebake_marked(o, tile, now, &job->rebaked, &job->report);
}

// ---------------------------------------------------------------------------------------------------------
// Tiles that wait, several as tasks.

typedef struct rebake_batch {
    tl_nav_obstacles *o;
    rebake_job jobs[TL_MAX_UNPACKED_TILES];
    uint32_t count;
} rebake_batch;

static void rebake_one(uint32_t index, uint32_t worker, void *user)
{
    rebake_batch *batch = user;
    rebake_job *job = &batch->jobs[index];
    job->result = rebake_with_obstacles(batch->o, &batch->o->windows[worker], job);
}

// Makes the first `most` tiles of the queue, where there are rooms for their floors. They keep waiting.
static void rebake_first(tl_nav_obstacles *o, uint32_t most, rebake_batch *batch)
{
    const tl_host host = { NULL, o->tasks, NULL };
    bool any_failed = false;
    batch->o = o;
    batch->count = 0;
    for (uint32_t tile = o->first_waiting; tile != OBSTACLE_NO_SLOT && batch->count < most;
         tile = o->tiles[tile].next_waiting) {
        tl_unpacked_tile *room = tl_unpacked_tiles_reserve(&o->unpacked, tile);
        if (room == NULL) {
            break;
        }
        rebake_job *job = &batch->jobs[batch->count];
        memset(job, 0, sizeof *job);
        tl_report_begin(&job->report.base, "rebake");
        job->tile = tile;
        job->rebaked.tile_x = (int32_t)(tile % o->tiles_x);
        job->rebaked.tile_z = (int32_t)(tile / o->tiles_x);
        job->room = room;
        batch->count++;
    }
    tl_run_tasks(&host, rebake_one, batch->count, batch);
    tl_unpacked_tiles_release(&o->unpacked);
    for (uint32_t i = 0; i < batch->count; i++) {
        any_failed = any_failed || tl_is_error(batch->jobs[i].result);
    }
    if (any_failed) {
        tl_unpacked_tiles_free(&o->unpacked); // where memory is short
    }
}

// The first tile of the queue is handed out, or was found as it is.
static void end_first_wait(tl_nav_obstacles *o)
{
    o->tiles[o->first_waiting].is_known = true;
    tl_obstacles_end_wait(o);
}

tl_result tl_nav_obstacles_bake_next(tl_nav_obstacles *obstacles, tl_nav_rebaked_tile *rebaked_out,
                                     tl_nav_bake_report *report_out)
{
    tl_nav_obstacles *o = obstacles;
    tl_report *base = tl_obstacles_report_begin(report_out, "rebake");
    TL_REFUSE_NULL(rebaked_out, base);
    memset(rebaked_out, 0, sizeof *rebaked_out);
    TL_REFUSE_NULL(obstacles, base);
    while (o->first_waiting != OBSTACLE_NO_SLOT) {
        rebake_batch batch;
        rebake_first(o, 1, &batch);
        const rebake_job *job = &batch.jobs[0];
        if (report_out != NULL) {
            *report_out = job->report;
        }
        if (tl_is_error(job->result)) {
            return job->result;
        }
        end_first_wait(o);
        if (job->result == TL_OK) {
            *rebaked_out = job->rebaked;
            return TL_OK;
        }
    }
    return TL_NOT_FOUND;
}

// Puts a tile into the navmesh. Where that fails it waits again, to be made from nothing.
static tl_result install_rebaked(tl_nav_obstacles *o, tl_navmesh *navmesh, rebake_job *job)
{
    end_first_wait(o);
    if (job->result == TL_NOT_FOUND) {
        return TL_OK;
    }
    const tl_nav_rebaked_tile *rebaked = &job->rebaked;
    const tl_result result = tl_navmesh_replace_tiles(navmesh, rebaked->tile_x, rebaked->tile_z, &job->rebaked.stack);
    if (result != TL_OK) {
        const tl_nav_tile_range again = { (uint32_t)rebaked->tile_x, (uint32_t)rebaked->tile_z, 1, 1 };
        tl_obstacles_tile_at(o, again.x, again.z)->is_known = false;
        tl_obstacles_let_wait(o, &again, NULL);
    }
    return result;
}

// What was made behind a failure: its tile, which waits still, is made from nothing.
static void discard_rebaked(tl_nav_obstacles *o, rebake_job *job)
{
    if (job->result == TL_OK) {
        tl_nav_tile_stack_free(&job->rebaked.stack);
        o->tiles[job->tile].is_known = false;
    }
}

// Makes the first `most` tiles that wait, and puts them into the navmesh one after another. `*made_out`: how many were
// not as they had been.
static tl_result update_some(tl_nav_obstacles *o, tl_navmesh *navmesh, uint32_t most, uint32_t *made_out,
                             tl_nav_bake_report *report_out)
{
    rebake_batch batch;
    tl_result result = TL_OK;
    *made_out = 0;
    rebake_first(o, o->tasks != NULL ? most : tl_min_u32(most, 1), &batch);
    for (uint32_t i = 0; i < batch.count; i++) {
        rebake_job *job = &batch.jobs[i];
        if (result != TL_OK) {
            discard_rebaked(o, job);
            continue;
        }
        if (report_out != NULL && job->result != TL_NOT_FOUND) {
            *report_out = job->report;
        }
        result = tl_is_error(job->result) ? job->result : install_rebaked(o, navmesh, job);
        *made_out += job->result == TL_OK ? 1 : 0;
    }
    return result;
}

tl_result tl_nav_obstacles_update(tl_nav_obstacles *obstacles, tl_navmesh *navmesh, uint32_t max_tiles,
                                  uint32_t *waiting_out, tl_nav_bake_report *report_out)
{
    tl_report *base = tl_obstacles_report_begin(report_out, "rebake");
    if (waiting_out != NULL) {
        *waiting_out = 0;
    }
    TL_REFUSE_NULL(obstacles, base);
    TL_REFUSE_NULL(navmesh, base);
    tl_nav_obstacles *o = obstacles;
    tl_result result = TL_OK;
    while (max_tiles > 0 && result == TL_OK && o->first_waiting != OBSTACLE_NO_SLOT) {
        uint32_t made = 0;
        result = update_some(o, navmesh, max_tiles, &made, report_out);
        max_tiles -= made;
    }
    if (waiting_out != NULL) {
        *waiting_out = o->waiting_count;
    }
    return result;
}
