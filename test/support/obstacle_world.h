// SPDX-License-Identifier: MIT
//
// Obstacles on the test level with a navmesh that follows them; random obstacles, and how far a point is from one.

#ifndef TALUS_TEST_OBSTACLE_WORLD_H
#define TALUS_TEST_OBSTACLE_WORLD_H

#include "nav_level.h"

#include <math.h>
#include <talus/nav_obstacles.h>

enum { CELLS = 20 };

/// Of all navmeshes that are made; 0: no layers.
static float tile_height;
static tl_nav_partition partition = TL_NAV_WATERSHED;

static inline tl_nav_def make_def(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = CELLS;
    def.tile_height = tile_height;
    def.partition = partition;
    def.bounds.min = tl_vec3_make(-1, -3, -1);
    def.bounds.max = tl_vec3_make(26, 9, 20);
    return def;
}

// Obstacles on the test level, and a navmesh that follows them.
typedef struct world {
    test_level level;
    tl_nav_def def;
    tl_nav_input input;
    tl_nav_obstacles *obstacles;
    tl_navmesh *navmesh;
} world;

static inline void make_world(world *w, const tl_allocator *allocator)
{
    test_level_make(&w->level, tl_vec3_make(0, 0, 0));
    w->def = make_def();
    w->def.host.allocator = allocator;
    memset(&w->input, 0, sizeof w->input);
    w->input.mesh = w->level.mesh;
    TEST_RESULT(tl_nav_obstacles_bake(&w->def, &w->input, &w->obstacles, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(allocator, &w->navmesh), TL_OK);
    uint32_t waiting;
    TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, UINT32_MAX, &waiting, NULL), TL_OK);
    TEST_CHECK(waiting == 0 && tl_navmesh_tile_count(w->navmesh) > 10);
}

static inline void free_world(world *w)
{
    tl_navmesh_destroy(w->navmesh);
    tl_nav_obstacles_destroy(w->obstacles);
}

static inline void settle(world *w)
{
    uint32_t waiting = 1;
    for (int i = 0; waiting > 0; i++) {
        TEST_CHECK(i < 1000);
        TEST_RESULT(tl_nav_obstacles_update(w->obstacles, w->navmesh, 3, &waiting, NULL), TL_OK);
    }
    TEST_CHECK(tl_nav_obstacles_waiting(w->obstacles) == 0);
}

static inline tl_nav_obstacle cylinder(uint8_t area, tl_vec3 base, float radius, float height)
{
    tl_nav_obstacle o;
    memset(&o, 0, sizeof o);
    o.shape = TL_NAV_OBSTACLE_CYLINDER;
    o.area = area;
    o.base = base;
    o.radius = radius;
    o.height = height;
    return o;
}

static inline tl_nav_obstacle box(uint8_t area, tl_vec3 base, float half_x, float half_z, float height)
{
    tl_nav_obstacle o;
    memset(&o, 0, sizeof o);
    o.shape = TL_NAV_OBSTACLE_BOX;
    o.area = area;
    o.base = base;
    o.half_x = half_x;
    o.half_z = half_z;
    o.height = height;
    return o;
}

static inline tl_nav_obstacle random_obstacle(test_random *random)
{
    tl_vec3 base = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(26, 4, 19));
    uint8_t area = (uint8_t)(test_random_below(random, 3) == 0 ? 1 + test_random_below(random, 4) : 0);
    float height = test_random_range(random, 0.1f, 2.5f);
    uint32_t kind = test_random_below(random, 3);
    if (kind == 0) {
        return cylinder(area, base, test_random_range(random, 0.1f, 2.5f), height);
    }
    tl_nav_obstacle o =
        box(area, base, test_random_range(random, 0.0f, 2.0f), test_random_range(random, 0.05f, 2.0f), height);
    float turn = test_random_range(random, 0.0f, 6.28f);
    o.cosine = 3.0f * cosf(turn);
    o.sine = 3.0f * sinf(turn);
    if (kind == 2) { // points on an ellipse, either way round
        o.shape = TL_NAV_OBSTACLE_PRISM;
        o.point_count = 3 + test_random_below(random, TL_NAV_MAX_OBSTACLE_POINTS - 2);
        bool backward = test_random_below(random, 2) == 0;
        for (uint32_t i = 0; i < o.point_count; i++) {
            float angle = 6.2831853f * ((float)i + test_random_range(random, 0.0f, 0.8f)) / (float)o.point_count;
            uint32_t at = backward ? o.point_count - 1 - i : i;
            o.points[at] = tl_vec3_make(0.2f + 2.0f * cosf(angle), 0.0f, 1.1f * sinf(angle) - 0.1f);
        }
    }
    return o;
}

// An outline's distance from a point, by walking along its edges in small steps: slow, and nothing of the code's.
static inline double walked_distance(const tl_nav_obstacle *o, double x, double z, double *inside_turns)
{
    double corners[TL_NAV_MAX_OBSTACLE_POINTS][2];
    uint32_t count = o->shape == TL_NAV_OBSTACLE_BOX ? 4 : o->point_count;
    double length = hypot((double)o->cosine, (double)o->sine);
    double c = length > 0.0 ? (double)o->cosine / length : 1.0, s = length > 0.0 ? (double)o->sine / length : 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double lx = o->shape == TL_NAV_OBSTACLE_BOX ? (double)(i == 0 || i == 3 ? -o->half_x : o->half_x)
                                                    : (double)o->points[i].x;
        double lz = o->shape == TL_NAV_OBSTACLE_BOX ? (double)(i < 2 ? -o->half_z : o->half_z) : (double)o->points[i].z;
        // Local x points to (cosine, -sine), local z to (sine, cosine).
        corners[i][0] = (double)o->base.x + lx * c + lz * s - x;
        corners[i][1] = (double)o->base.z - lx * s + lz * c - z;
    }
    double nearest_sq = (double)INFINITY, turns = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const double *a = corners[i], *b = corners[(i + 1) % count];
        for (int k = 0; k <= 400; k++) {
            double t = k / 400.0, px = a[0] + t * (b[0] - a[0]), pz = a[1] + t * (b[1] - a[1]);
            double distance_sq = px * px + pz * pz;
            nearest_sq = distance_sq < nearest_sq ? distance_sq : nearest_sq;
        }
        turns += atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }
    *inside_turns = turns;
    return sqrt(nearest_sq);
}

// How far a point of the plane is from an obstacle's outline: below 0 inside.
static inline double outline_distance(const tl_nav_obstacle *o, double x, double z)
{
    if (o->shape == TL_NAV_OBSTACLE_CYLINDER) {
        return hypot(x - (double)o->base.x, z - (double)o->base.z) - (double)o->radius;
    }
    double turns, distance = walked_distance(o, x, z, &turns);
    return fabs(turns) > 3.0 ? -distance : distance;
}

#endif
