// SPDX-License-Identifier: MIT
//
// Corridors: the polygons from an agent to its target, kept while both move.

#include "js_navmesh.h"

#include <stdlib.h>

typedef struct js_corridor {
    tl_nav_corridor corridor;
    tl_nav_ref path[];
} js_corridor;

/// NULL: out of memory.
js_corridor *TL_JS_EXPORT(js_corridor_create)(uint32_t capacity)
{
    js_corridor *self = malloc(sizeof *self + capacity * sizeof *self->path);
    if (self != NULL) {
        self->corridor = tl_nav_corridor_init(self->path, capacity);
    }
    return self;
}

void TL_JS_EXPORT(js_corridor_free)(js_corridor *self)
{
    free(self);
}

/// Slot: the place.
void TL_JS_EXPORT(js_corridor_reset)(js_corridor *self)
{
    const tl_nav_location at = tl_js_place(0);
    tl_nav_corridor_reset(&self->corridor, &at);
}

/// Slot: position, target, goal, whether the target is the goal, how many polygons, and where.
void TL_JS_EXPORT(js_corridor_state)(const js_corridor *self)
{
    const tl_nav_corridor *c = &self->corridor;
    const uint32_t at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_vec3(0, c->position), c->target), c->goal);
    tl_js_put_pointer(tl_js_put(tl_js_put(at, c->reaches), c->count), c->path);
}

static tl_result put_search(tl_result result, const tl_nav_path *path)
{
    tl_js_put(tl_js_put(tl_js_put(0, path->status), (double)path->cost), path->node_count);
    return result;
}

/// Slot: the goal; then status, cost, nodes.
tl_result TL_JS_EXPORT(js_corridor_find)(js_corridor *self, tl_js_navmesh *navmesh, uint32_t flags)
{
    const tl_nav_location goal = tl_js_place(0);
    tl_nav_query *query;
    const tl_result result = tl_js_navmesh_query(navmesh, &query);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_path path;
    return put_search(
        tl_nav_corridor_find(&self->corridor, query, navmesh->navmesh, tl_js_filter_of(flags), &goal, &path), &path);
}

/// Slot: status, cost, nodes. TL_NOT_FOUND: no polygon is near the agent.
tl_result TL_JS_EXPORT(js_corridor_repair)(js_corridor *self, tl_js_navmesh *navmesh, uint32_t flags, float hx,
                                           float hy, float hz)
{
    tl_nav_query *query;
    const tl_result result = tl_js_navmesh_query(navmesh, &query);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_path path;
    return put_search(tl_nav_corridor_repair(&self->corridor, query, navmesh->navmesh, tl_js_filter_of(flags),
                                             tl_vec3_make(hx, hy, hz), &path),
                      &path);
}

/// Slot: the corners (tl_js_put_corners). TL_INCOMPLETE: there are more.
tl_result TL_JS_EXPORT(js_corridor_corners)(const js_corridor *self, const tl_js_navmesh *navmesh, uint32_t capacity)
{
    tl_nav_corner *corners = malloc(capacity * sizeof *corners);
    if (corners == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    const tl_result result = tl_nav_corridor_corners(&self->corridor, navmesh->navmesh, corners, capacity, &count);
    const tl_result put = tl_js_put_corners(0, corners, count);
    free(corners);
    return put == TL_OK ? result : put;
}

/// Moves the agent, or the target.
tl_result TL_JS_EXPORT(js_corridor_move)(js_corridor *self, tl_js_navmesh *navmesh, uint32_t flags, int32_t of_target,
                                         float x, float y, float z)
{
    tl_nav_query *query;
    const tl_result result = tl_js_navmesh_query(navmesh, &query);
    if (result != TL_OK) {
        return result;
    }
    return (of_target ? tl_nav_corridor_move_target : tl_nav_corridor_move)(
        &self->corridor, query, navmesh->navmesh, tl_js_filter_of(flags), tl_vec3_make(x, y, z));
}

/// Slot: the link, and the places where it begins and ends. TL_NOT_FOUND: there is none ahead.
tl_result TL_JS_EXPORT(js_corridor_pass_link)(js_corridor *self, const tl_js_navmesh *navmesh)
{
    tl_nav_location ends[2] = { { 0 } };
    tl_nav_ref link = 0;
    const tl_result result = tl_nav_corridor_pass_link(&self->corridor, navmesh->navmesh, ends, &link);
    uint32_t at = tl_js_put_u64(0, link);
    for (uint32_t i = 0; i < 2; i++) {
        at = tl_js_put_place(at, &ends[i]);
    }
    return result;
}

/// Slot: whether it changed.
tl_result TL_JS_EXPORT(js_corridor_shorten)(js_corridor *self, const tl_js_navmesh *navmesh, uint32_t flags,
                                            float range)
{
    bool changed = false;
    const tl_result result =
        tl_nav_corridor_shorten(&self->corridor, navmesh->navmesh, tl_js_filter_of(flags), range, &changed);
    tl_js_put(0, changed);
    return result;
}

/// Slot: whether it changed.
tl_result TL_JS_EXPORT(js_corridor_improve)(js_corridor *self, tl_js_navmesh *navmesh, uint32_t flags, uint32_t ahead,
                                            uint32_t max_steps)
{
    bool changed = false;
    tl_nav_query *query;
    tl_result result = tl_js_navmesh_query(navmesh, &query);
    if (result == TL_OK) {
        result = tl_nav_corridor_improve(&self->corridor, query, navmesh->navmesh, tl_js_filter_of(flags), ahead,
                                         max_steps, &changed);
    }
    tl_js_put(0, changed);
    return result;
}

/// How many of its first entries are valid.
uint32_t TL_JS_EXPORT(js_corridor_check)(const js_corridor *self, const tl_js_navmesh *navmesh, uint32_t flags,
                                         uint32_t max_count)
{
    return tl_nav_corridor_check(&self->corridor, navmesh->navmesh, tl_js_filter_of(flags), max_count);
}
