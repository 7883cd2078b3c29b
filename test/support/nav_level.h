// SPDX-License-Identifier: MIT
//
// A small level for tests of the whole navmesh build: ground with blocks, a ramp up to a bridge that one can walk
// under, a step, a pit.

#ifndef TALUS_TEST_NAV_LEVEL_H
#define TALUS_TEST_NAV_LEVEL_H

#include "talus_test.h"

#include <string.h>
#include <talus/mesh.h>
#include <talus/nav_bake.h>

enum { TEST_LEVEL_MAX_VERTICES = 256, TEST_LEVEL_MAX_TRIANGLES = 256 };

typedef struct test_level {
    tl_vec3 vertices[TEST_LEVEL_MAX_VERTICES];
    uint32_t indices[3 * TEST_LEVEL_MAX_TRIANGLES];
    tl_mesh_view mesh;
} test_level;

static inline void test_level_quad(test_level *level, tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
{
    uint32_t v = level->mesh.vertex_count, *t = level->indices + 3 * level->mesh.triangle_count;
    TEST_CHECK(v + 4 <= TEST_LEVEL_MAX_VERTICES && level->mesh.triangle_count + 2 <= TEST_LEVEL_MAX_TRIANGLES);
    level->vertices[v] = a;
    level->vertices[v + 1] = b;
    level->vertices[v + 2] = c;
    level->vertices[v + 3] = d;
    t[0] = t[3] = v;
    t[1] = v + 1;
    t[2] = t[4] = v + 2;
    t[5] = v + 3;
    level->mesh.vertex_count += 4;
    level->mesh.triangle_count += 2;
}

/// A box whose top may slope along x: y1 at x0, y2 at x1.
static inline void test_level_box(test_level *level, float x0, float y0, float z0, float x1, float y1, float z1,
                                  float y2)
{
    tl_vec3 a = { x0, y0, z0 }, b = { x1, y0, z0 }, c = { x1, y0, z1 }, d = { x0, y0, z1 };
    tl_vec3 e = { x0, y1, z0 }, f = { x1, y2, z0 }, g = { x1, y2, z1 }, h = { x0, y1, z1 };
    test_level_quad(level, e, h, g, f);
    test_level_quad(level, a, b, c, d);
    test_level_quad(level, a, e, f, b);
    test_level_quad(level, d, c, g, h);
    test_level_quad(level, a, d, h, e);
    test_level_quad(level, b, f, g, c);
}

static inline void test_level_make(test_level *level, tl_vec3 offset)
{
    memset(level, 0, sizeof *level);
    tl_vec3 corners[4] = { { 0, 0, 0 }, { 0, 0, 18.2f }, { 24.4f, 0, 18.2f }, { 24.4f, 0, 0 } };
    test_level_quad(level, corners[0], corners[1], corners[2], corners[3]);
    test_level_box(level, 3, 0, 3, 5, 2.5f, 6.3f, 2.5f);           // a block
    test_level_box(level, 7.1f, 0, 11, 12.1f, 0, 13.4f, 3.2f);     // the ramp
    test_level_box(level, 12.1f, 2.9f, 11, 20, 3.2f, 13.4f, 3.2f); // the bridge, open below
    test_level_box(level, 20, 0, 10.5f, 22, 3.2f, 13.9f, 3.2f);    // its far end
    test_level_box(level, 10, 0, 2, 16, 0.5f, 6, 0.5f);            // a step
    test_level_box(level, 0, -2, 16, 24.4f, 5, 16.5f, 5);          // a wall across
    for (uint32_t i = 0; i < level->mesh.vertex_count; i++) {
        level->vertices[i] = tl_add(level->vertices[i], offset);
    }
    level->mesh.vertices = level->vertices;
    level->mesh.indices = level->indices;
}

static inline tl_aabb test_level_bounds(const test_level *level)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < level->mesh.vertex_count; i++) {
        bounds = tl_aabb_add_point(bounds, level->vertices[i]);
    }
    return bounds;
}

#endif
