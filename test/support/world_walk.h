// SPDX-License-Identifier: MIT
//
// An agent that walks over a world of which a part is in memory, with loads on a thread of their own. Every path that
// it asks for is held against the same world in memory whole. Define _POSIX_C_SOURCE before the first header.

#ifndef TALUS_TEST_WORLD_WALK_H
#define TALUS_TEST_WORLD_WALK_H

#include "base/random.h"

#include <math.h>
#include <pthread.h>
#include <string.h>
#include <talus/nav_world.h>

/// A world over what `read` reads, under a budget; NULL: refused.
static inline tl_nav_world *walk_open(tl_nav_world_read_fn *read, void *user, uint64_t budget, double frame_reach)
{
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    def.read = read;
    def.user = user;
    def.budget = budget;
    def.frame_reach = frame_reach;
    (void)tl_nav_world_create(&def, &world, NULL);
    return world;
}

// ---------------------------------------------------------------------------------------------------------
// Loads on a thread.

enum { WALK_LOADS = 4 };

typedef enum walk_load_stage { WALK_LOAD_FREE, WALK_LOAD_QUEUED, WALK_LOAD_DONE } walk_load_stage;

typedef struct walk_loader {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t wake;
    tl_nav_world_load loads[WALK_LOADS];
    walk_load_stage stages[WALK_LOADS];
    bool ends;
} walk_loader;

static inline void *walk_load_all(void *user)
{
    walk_loader *loader = (walk_loader *)user;
    pthread_mutex_lock(&loader->lock);
    for (;;) {
        int next = 0;
        while (next < WALK_LOADS && loader->stages[next] != WALK_LOAD_QUEUED) {
            next++;
        }
        if (next < WALK_LOADS) {
            pthread_mutex_unlock(&loader->lock);
            (void)tl_nav_world_run_load(&loader->loads[next]);
            pthread_mutex_lock(&loader->lock);
            loader->stages[next] = WALK_LOAD_DONE;
        } else if (loader->ends) {
            break;
        } else {
            pthread_cond_wait(&loader->wake, &loader->lock);
        }
    }
    pthread_mutex_unlock(&loader->lock);
    return NULL;
}

/// False: the system refuses the thread.
static inline bool walk_loader_begin(walk_loader *loader)
{
    memset(loader, 0, sizeof *loader);
    pthread_mutex_init(&loader->lock, NULL);
    pthread_cond_init(&loader->wake, NULL);
    return pthread_create(&loader->thread, NULL, walk_load_all, loader) == 0;
}

/// A frame's part of the loads: those that are done are handed back, others begun. `*failed` counts those that failed.
static inline tl_result walk_exchange_loads(walk_loader *loader, tl_nav_world *world, uint32_t *failed)
{
    tl_result result = TL_OK;
    pthread_mutex_lock(&loader->lock);
    for (int i = 0; i < WALK_LOADS; i++) {
        if (loader->stages[i] == WALK_LOAD_DONE) {
            *failed += loader->loads[i].result != TL_OK;
            result = tl_nav_world_end_load(&loader->loads[i]);
            loader->stages[i] = WALK_LOAD_FREE;
        }
        if (loader->stages[i] == WALK_LOAD_FREE && result == TL_OK) {
            result = tl_nav_world_begin_load(world, &loader->loads[i]);
            if (result == TL_OK) {
                loader->stages[i] = WALK_LOAD_QUEUED;
                pthread_cond_signal(&loader->wake);
            }
        }
    }
    pthread_mutex_unlock(&loader->lock);
    return result == TL_NOT_FOUND ? TL_OK : result;
}

/// Lets what was begun end, and hands it back.
static inline void walk_loader_end(walk_loader *loader)
{
    pthread_mutex_lock(&loader->lock);
    loader->ends = true;
    pthread_cond_signal(&loader->wake);
    pthread_mutex_unlock(&loader->lock);
    pthread_join(loader->thread, NULL);
    for (int i = 0; i < WALK_LOADS; i++) {
        if (loader->stages[i] == WALK_LOAD_DONE) {
            (void)tl_nav_world_end_load(&loader->loads[i]);
        }
    }
    pthread_cond_destroy(&loader->wake);
    pthread_mutex_destroy(&loader->lock);
}

// ---------------------------------------------------------------------------------------------------------
// The agent.

enum { WALK_CORNERS = 1024 };

typedef struct world_walk {
    tl_nav_world *part, *whole; ///< of the same file
    tl_nav_query *query;
    double low[2], high[2]; ///< metres, x and z of the level: goals lie between
    double reach;           ///< metres to a goal, at most
    tl_vec3 extents;        ///< around a goal
    uint64_t random;
    double at[3], heading;
    double corners[WALK_CORNERS][3]; ///< of the way ahead
    uint32_t corner_count, next;
    double walked;
    /// Answers: proven and equal to those of the whole; said to be open; different, which must not be.
    uint32_t paths, proven, unreachable, nowhere, open, wrong;
    uint32_t jumps; ///< to a random place, where no way led on
} world_walk;

/// How far lengths may differ over two frames: each corner is rounded in both, by 2^-24 of the distance from its
/// frame's origin along each axis.
static inline double walk_rounding(tl_vec3 a, tl_vec3 b, uint32_t corners)
{
    const double reach = fmax(fmax(fabs((double)a.x), fabs((double)a.z)), fmax(fabs((double)b.x), fabs((double)b.z)));
    return 1e-4 + 0x1p-21 * reach * (double)(corners + 2);
}

static inline double walk_distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/// Between what the measure of find_nearest may be for a place that is off by `rounding`: it jumps where a floor is
/// agent_max_climb overhead.
static inline void walk_measure(const tl_nav_world *world, const tl_nav_location *found, const double point[3],
                                double rounding, double range_out[2])
{
    const tl_nav_tile *tile = NULL;
    double at[3];
    (void)tl_navmesh_resolve(tl_nav_world_navmesh(world), found->polygon, &tile, NULL);
    tl_nav_world_place_out(world, found->point, at);
    for (int i = 0; i < 2; i++) {
        const double slack = i == 0 ? -rounding : rounding;
        const double up = at[1] - point[1] + slack > (double)tile->agent_max_climb ? (double)tile->agent_height : 0.0;
        const double lifted[3] = { at[0], at[1] + up, at[2] };
        range_out[i] = walk_distance(lifted, point) + slack;
    }
}

/// The place of the part in the whole: the same polygon of the same tile. False: it has none.
static inline bool walk_same_place(const world_walk *w, const tl_nav_location *in_part, tl_nav_location *in_whole)
{
    const tl_navmesh *part = tl_nav_world_navmesh(w->part), *whole = tl_nav_world_navmesh(w->whole);
    const tl_vec3 zero = { 0.0f, 0.0f, 0.0f };
    const tl_nav_tile *tile = NULL;
    double a[3], b[3];
    uint32_t polygon = 0, slot = 0;
    if (tl_navmesh_resolve(part, in_part->polygon, &tile, &polygon) != TL_OK) {
        return false;
    }
    tl_nav_world_place_out(w->part, zero, a);
    tl_nav_world_place_out(w->whole, zero, b);
    const double side = (double)tile->tile_size * (double)tile->cell_size;
    const tl_nav_tile *same = tl_navmesh_find_layer(whole, tile->tile_x + (int32_t)lround((a[0] - b[0]) / side),
                                                    tile->layer, tile->tile_z + (int32_t)lround((a[2] - b[2]) / side));
    while (same != NULL && tl_navmesh_slot_tile(whole, slot) != same) {
        slot++;
    }
    tl_nav_world_place_out(w->part, in_part->point, a);
    in_whole->polygon = same != NULL ? tl_navmesh_polygon_ref(whole, slot, polygon) : TL_NAV_NO_REF;
    return tl_navmesh_closest_point(whole, in_whole->polygon, tl_nav_world_place_in(w->whole, a), &in_whole->point,
                                    NULL) == TL_OK;
}

/// The nearest place in the part, which none of the whole may beat: by more than rounding, which may also move places
/// into the box and out of it. And that place in the whole. False: there is none, or it is open, which was counted.
static inline bool walk_find(world_walk *w, const double point[3], tl_nav_location found[2])
{
    tl_nav_location least, most;
    const double r = walk_rounding(tl_nav_world_place_in(w->part, point), tl_nav_world_place_in(w->whole, point), 1);
    const tl_vec3 by = tl_vec3_make((float)r, (float)r, (float)r);
    const tl_result result = tl_nav_world_find_nearest(w->part, NULL, point, w->extents, &found[0]);
    const tl_result in_less = tl_nav_world_find_nearest(w->whole, NULL, point, tl_sub(w->extents, by), &least);
    const tl_result in_more = tl_nav_world_find_nearest(w->whole, NULL, point, tl_add(w->extents, by), &most);
    if (result == TL_NOT_LOADED) {
        w->open++;
        return false;
    }
    if ((result != TL_OK && result != TL_NOT_FOUND) || (result == TL_NOT_FOUND && in_less != TL_NOT_FOUND) ||
        (result == TL_OK && (in_more != TL_OK || !walk_same_place(w, &found[0], &found[1])))) {
        w->wrong++;
        return false;
    }
    if (result == TL_NOT_FOUND) {
        w->nowhere++;
        return false;
    }
    double measure[2], of_least[2], of_most[2];
    walk_measure(w->part, &found[0], point, r, measure);
    walk_measure(w->whole, &most, point, r, of_most);
    w->wrong += of_most[0] > measure[1];
    if (in_less == TL_OK) {
        walk_measure(w->whole, &least, point, r, of_least);
        w->wrong += measure[0] > of_least[1];
    }
    return true;
}

/// A path from where the agent is to a goal, compared; it becomes the way ahead where it is complete.
static inline bool walk_ask(world_walk *w, const double goal[3])
{
    tl_nav_corner corners[WALK_CORNERS];
    const tl_nav_path_buffers buffers = { NULL, 0, corners, WALK_CORNERS };
    tl_nav_location from[2], to[2];
    tl_nav_shortest_path path, truth;
    if (!walk_find(w, w->at, from) || !walk_find(w, goal, to)) {
        return false;
    }
    const tl_nav_path_request in_part = { NULL, from[0], to[0] }, in_whole = { NULL, from[1], to[1] };
    const tl_result whole = tl_nav_world_find_path(w->whole, w->query, &in_whole, NULL, &truth);
    const tl_result result = tl_nav_world_find_path(w->part, w->query, &in_part, &buffers, &path);
    const bool is_way = truth.status == TL_NAV_PATH_COMPLETE;
    const double rounding = walk_rounding(from[0].point, from[1].point, truth.corner_count);
    w->paths++;
    if (whole != TL_OK) {
        w->wrong++;
    } else if (result == TL_NOT_LOADED) {
        w->open++;
        w->wrong += is_way && path.lower_bound > truth.length + rounding;
        w->wrong += path.status == TL_NAV_PATH_COMPLETE && (!is_way || path.length < truth.length - rounding);
    } else if (result != TL_OK && result != TL_INCOMPLETE) {
        w->wrong++;
    } else if (path.status != truth.status || (is_way && fabs(path.length - truth.length) > rounding)) {
        w->wrong++;
    } else {
        w->proven += is_way;
        w->unreachable += !is_way;
    }
    if (path.status != TL_NAV_PATH_COMPLETE) {
        return false;
    }
    w->corner_count = path.corner_count < WALK_CORNERS ? path.corner_count : WALK_CORNERS;
    for (uint32_t i = 0; i < w->corner_count; i++) {
        tl_nav_world_place_out(w->part, corners[i].point, w->corners[i]);
    }
    w->next = 1;
    return w->corner_count > 1;
}

static inline double walk_between(world_walk *w, double low, double high)
{
    return low + (high - low) * tl_random_unit(&w->random);
}

/// The next goal: ahead as a rule. After many that did not do the agent goes on elsewhere.
static inline void walk_choose(world_walk *w)
{
    const double pi = 3.14159265358979323846;
    for (uint32_t tries = 0; tries < 16; tries++) {
        const double angle = w->heading + walk_between(w, -0.2, 0.2) * pi * (1.0 + 0.3 * tries);
        const double far = walk_between(w, 0.3, 1.0) * w->reach;
        const double goal[3] = { w->at[0] + far * cos(angle), w->at[1] + walk_between(w, -1.0, 1.0),
                                 w->at[2] + far * sin(angle) };
        if (goal[0] > w->low[0] && goal[0] < w->high[0] && goal[2] > w->low[1] && goal[2] < w->high[1] &&
            walk_ask(w, goal)) {
            w->heading = angle;
            return;
        }
        w->heading += 0.25 * pi * (double)(tries == 8);
    }
    w->jumps++;
    w->at[0] = walk_between(w, w->low[0], w->high[0]);
    w->at[2] = walk_between(w, w->low[1], w->high[1]);
    w->heading = walk_between(w, -pi, pi);
}

/// Walks so many metres along the way ahead. False: it is at the end of it.
static inline bool walk_on(world_walk *w, double metres)
{
    while (w->next < w->corner_count) {
        const double *to = w->corners[w->next];
        const double left = walk_distance(w->at, to), share = left > metres ? metres / left : 1.0;
        for (int i = 0; i < 3; i++) {
            w->at[i] += share * (to[i] - w->at[i]);
        }
        w->walked += share * left;
        if (left > metres) {
            return true;
        }
        metres -= left;
        w->next++;
    }
    return false;
}

#endif
