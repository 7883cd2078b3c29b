// SPDX-License-Identifier: MIT
//
// What changes a navmesh: off-mesh links, obstacles, tiles that are baked again.

#include "js_convex.h"
#include "js_navmesh.h"
#include "js_threads.h"

#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// Off-mesh links.

tl_nav_offmesh tl_js_offmesh(uint32_t at)
{
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = tl_js_vec3(at);
    link.end = tl_js_vec3(at + 3);
    link.radius = tl_js_f32(at + 6);
    link.cost_factor = tl_js_f32(at + 7);
    link.fixed_cost = tl_js_f32(at + 8);
    link.flags = tl_js_u64(at + 9);
    link.user = tl_js_u64(at + 10);
    link.area = (uint8_t)tl_js_u32(at + 11);
    link.both_ways = tl_js_slot[at + 12] != 0.0;
    return link;
}

uint32_t tl_js_put_offmesh(uint32_t at, const tl_nav_offmesh *link)
{
    at = tl_js_put_vec3(tl_js_put_vec3(at, link->start), link->end);
    at = tl_js_put(tl_js_put(at, (double)link->radius), (double)link->cost_factor);
    at = tl_js_put_u64(tl_js_put_u64(tl_js_put(at, (double)link->fixed_cost), link->flags), link->user);
    return tl_js_put(tl_js_put(at, link->area), link->both_ways);
}

/// Slot: the link; then its reference.
tl_result TL_JS_EXPORT(js_offmesh_add)(tl_js_navmesh *self)
{
    const tl_nav_offmesh link = tl_js_offmesh(0);
    tl_nav_ref ref;
    const tl_result result = tl_navmesh_add_offmesh(self->navmesh, &link, &ref, &tl_js_report);
    tl_js_put_u64(0, ref);
    return result;
}

/// Slot: the reference.
tl_result TL_JS_EXPORT(js_offmesh_remove)(tl_js_navmesh *self)
{
    return tl_navmesh_remove_offmesh(self->navmesh, tl_js_u64(0));
}

/// The link behind `cursor`. Slot: the next cursor, its reference, the link, whether it is anchored, length, cost, and
/// where its ends are. False: there is none.
int32_t TL_JS_EXPORT(js_offmesh_next)(const tl_js_navmesh *self, uint32_t cursor)
{
    tl_nav_ref ref;
    tl_nav_offmesh_state state;
    if (!tl_navmesh_next_offmesh(self->navmesh, &cursor, &ref) ||
        tl_navmesh_offmesh_state(self->navmesh, ref, &state) != TL_OK) {
        return 0;
    }
    uint32_t at = tl_js_put_offmesh(tl_js_put_u64(tl_js_put(0, cursor), ref), &state.offmesh);
    at = tl_js_put(tl_js_put(tl_js_put(at, state.anchored), (double)state.length), (double)state.cost);
    for (uint32_t end = 0; end < 2; end++) {
        at = tl_js_put_place(at, &state.ends[end]);
    }
    return 1;
}

// ---------------------------------------------------------------------------------------------------------
// Obstacles. In the slot: shape, area, base, height, radius, half extents, cosine, sine, points; of a convex one the
// shape and its pose behind them.

enum { OBSTACLE_CONVEX = 12 + 2 * TL_NAV_MAX_OBSTACLE_POINTS };

static tl_nav_obstacle obstacle_at(uint32_t at)
{
    tl_nav_obstacle obstacle;
    memset(&obstacle, 0, sizeof obstacle);
    obstacle.shape = (tl_nav_obstacle_shape)tl_js_u32(at);
    obstacle.area = (uint8_t)tl_js_u32(at + 1);
    obstacle.base = tl_js_vec3(at + 2);
    obstacle.height = tl_js_f32(at + 5);
    obstacle.radius = tl_js_f32(at + 6);
    obstacle.half_x = tl_js_f32(at + 7);
    obstacle.half_z = tl_js_f32(at + 8);
    obstacle.cosine = tl_js_f32(at + 9);
    obstacle.sine = tl_js_f32(at + 10);
    obstacle.point_count = tl_js_u32(at + 11);
    for (uint32_t i = 0; i < obstacle.point_count && i < TL_NAV_MAX_OBSTACLE_POINTS; i++) {
        obstacle.points[i] = tl_vec3_make(tl_js_f32(at + 12 + 2 * i), 0.0f, tl_js_f32(at + 13 + 2 * i));
    }
    if (obstacle.shape == TL_NAV_OBSTACLE_CONVEX) {
        obstacle.convex = tl_js_shape(at + OBSTACLE_CONVEX);
        obstacle.pose = tl_js_pose(at + OBSTACLE_CONVEX + TL_JS_SHAPE_NUMBERS);
    }
    return obstacle;
}

int32_t TL_JS_FULL_EXPORT(js_has_obstacles)(const tl_js_navmesh *self)
{
    return self->obstacles != NULL;
}

/// Slot: the obstacle; then its id.
tl_result TL_JS_FULL_EXPORT(js_obstacle_add)(tl_js_navmesh *self)
{
    const tl_nav_obstacle obstacle = obstacle_at(0);
    tl_nav_obstacle_id id = 0;
    const tl_result result = tl_nav_obstacles_add(self->obstacles, &obstacle, &id, &tl_js_report);
    tl_js_put_u64(0, id);
    return result;
}

/// Slot: the id, the obstacle.
tl_result TL_JS_FULL_EXPORT(js_obstacle_move)(tl_js_navmesh *self)
{
    const tl_nav_obstacle obstacle = obstacle_at(1);
    return tl_nav_obstacles_move(self->obstacles, tl_js_u64(0), &obstacle, &tl_js_report);
}

/// Slot: the id.
tl_result TL_JS_FULL_EXPORT(js_obstacle_remove)(tl_js_navmesh *self)
{
    return tl_nav_obstacles_remove(self->obstacles, tl_js_u64(0));
}

/// Slot: how many tiles wait still.
tl_result TL_JS_FULL_EXPORT(js_obstacles_update)(tl_js_navmesh *self, uint32_t max_tiles)
{
    uint32_t waiting = 0;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_result result = tl_nav_obstacles_set_tasks(self->obstacles, tl_js_tasks());
    if (result == TL_OK) {
        result = tl_nav_obstacles_update(self->obstacles, self->navmesh, max_tiles, &waiting, &report);
    }
    tl_js_report = report.base;
    tl_js_put(0, waiting);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Baking tiles again.

static tl_result rebake_range(tl_js_navmesh *self, tl_aabb changed, uint32_t *count_out)
{
    tl_nav_tile_block block;
    memset(&block, 0, sizeof block);
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_nav_def def = self->def;
    def.host = *tl_js_host();
    tl_result result = tl_nav_rebake(&def, &tl_js_input, changed, &block, &report);
    tl_js_report = report.base;
    const tl_nav_tile_range range = block.range;
    *count_out = range.count_x * range.count_z;
    for (uint32_t i = 0; i < *count_out && result == TL_OK; i++) {
        const uint32_t x = range.x + i % range.count_x, z = range.z + i / range.count_x;
        result = tl_navmesh_replace_tiles(self->navmesh, (int32_t)x, (int32_t)z, &block.stacks[i]);
    }
    tl_nav_tile_block_free(&block);
    return result;
}

/// Of the input, inside a box in the slot; then how many tiles were baked.
tl_result TL_JS_FULL_EXPORT(js_rebake)(tl_js_navmesh *self)
{
    const tl_aabb changed = tl_js_aabb(0);
    uint32_t count = 0;
    tl_result result;
    if (self->obstacles != NULL) {
        tl_nav_bake_report report;
        memset(&report, 0, sizeof report);
        result = tl_nav_obstacles_rebake(self->obstacles, &tl_js_input, changed, &report);
        tl_js_report = report.base;
        count = tl_nav_obstacles_waiting(self->obstacles);
        if (result == TL_OK) {
            result = tl_nav_obstacles_update(self->obstacles, self->navmesh, count, NULL, NULL);
        }
    } else {
        result = rebake_range(self, changed, &count);
    }
    tl_js_put(0, count);
    return result;
}
