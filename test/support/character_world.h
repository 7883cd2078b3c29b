// SPDX-License-Identifier: MIT
//
// Levels for the character's tests, and a judge of its places that shares no code with it: the distance of the capsule
// from every triangle by GJK.

#ifndef TALUS_TEST_CHARACTER_WORLD_H
#define TALUS_TEST_CHARACTER_WORLD_H

#include "soup_models.h"

#include <math.h>
#include <talus/character.h>

#define WORLD_TICK (1.0f / 60.0f)

static inline void world_quad(model *m, tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
{
    uint32_t i = model_vertex(m, a.x, a.y, a.z);
    model_vertex(m, b.x, b.y, b.z);
    model_vertex(m, c.x, c.y, c.z);
    model_vertex(m, d.x, d.y, d.z);
    model_triangle(m, i, i + 1, i + 2);
    model_triangle(m, i, i + 2, i + 3);
}

/// The six sides of a box, seen from outside.
static inline void world_box(model *m, tl_vec3 low, tl_vec3 high)
{
    const tl_vec3 v[8] = { { low.x, low.y, low.z },    { high.x, low.y, low.z }, { high.x, low.y, high.z },
                           { low.x, low.y, high.z },   { low.x, high.y, low.z }, { high.x, high.y, low.z },
                           { high.x, high.y, high.z }, { low.x, high.y, high.z } };
    world_quad(m, v[0], v[1], v[2], v[3]);
    world_quad(m, v[4], v[7], v[6], v[5]);
    world_quad(m, v[0], v[4], v[5], v[1]);
    world_quad(m, v[1], v[5], v[6], v[2]);
    world_quad(m, v[2], v[6], v[7], v[3]);
    world_quad(m, v[3], v[7], v[4], v[0]);
}

/// A floor at height y of squares of `cell` metres, cut both ways.
static inline void world_floor(model *m, float x0, float z0, float x1, float z1, float y, float cell)
{
    uint32_t columns = (uint32_t)((x1 - x0) / cell + 0.5f), rows = (uint32_t)((z1 - z0) / cell + 0.5f);
    for (uint32_t i = 0; i < columns; i++) {
        for (uint32_t k = 0; k < rows; k++) {
            float ax = x0 + (float)i * cell, az = z0 + (float)k * cell, bx = ax + cell, bz = az + cell;
            tl_vec3 a = { ax, y, az }, b = { ax, y, bz }, c = { bx, y, bz }, d = { bx, y, az };
            if ((i + k) % 2 == 0) {
                world_quad(m, a, b, c, d);
            } else {
                world_quad(m, b, c, d, a);
            }
        }
    }
}

static inline tl_soup *world_bake(const model *m)
{
    tl_mesh_view view = model_view(m);
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    return soup;
}

static inline tl_character_mover *world_mover(void)
{
    tl_character_mover *mover;
    TEST_RESULT(tl_character_mover_create(NULL, &mover, NULL), TL_OK);
    return mover;
}

/// How deep the capsule of `def` is in the soup: metres, 0 when it touches nothing.
static inline double world_depth(const tl_soup *soup, const tl_character_def *def, tl_vec3 feet)
{
    double deepest = 0.0;
    uint64_t cursor = 0;
    tl_soup_triangle t;
    tl_vec3 low = { feet.x - def->radius, feet.y, feet.z - def->radius };
    tl_vec3 high = { feet.x + def->radius, feet.y + def->height, feet.z + def->radius };
    tl_aabb box = { low, high };
    tl_convex core =
        tl_convex_capsule(tl_vec3_make(0, def->radius, 0), tl_vec3_make(0, def->height - def->radius, 0), 0.0f);
    tl_transform here = { { 0, 0, 0, 1 }, feet };
    while (tl_soup_next_triangle(soup, &cursor, &t)) {
        tl_aabb own = tl_aabb_add_point(
            tl_aabb_add_point(tl_aabb_add_point(tl_aabb_empty(), t.corners[0]), t.corners[1]), t.corners[2]);
        if (tl_aabb_overlaps(own, box)) {
            tl_convex shape = tl_convex_triangle(t.corners[0], t.corners[1], t.corners[2], 0.0f);
            tl_separation s;
            tl_convex_distance(&shape, tl_transform_identity(), &core, here, NULL, &s);
            double depth = (double)def->radius - (double)s.distance;
            deepest = depth > deepest ? depth : deepest;
        }
    }
    return deepest;
}

/// One tick: walks by a velocity; in the air it keeps its speed where it does not steer, and falls.
static inline tl_character_report world_tick(tl_character_mover *mover, const tl_character_level *level,
                                             tl_character *c, tl_vec3 walk)
{
    tl_character_step step = { walk, WORLD_TICK, false };
    tl_character_report report;
    if (c->grounded == 0) {
        bool steers = walk.x != 0.0f || walk.z != 0.0f;
        step.velocity = steers ? tl_vec3_make(walk.x, c->velocity.y, walk.z) : c->velocity;
        step.velocity.y -= 9.81f * WORLD_TICK;
    }
    TEST_RESULT(tl_character_move(mover, level, &step, c, &report), TL_OK);
    return report;
}

#endif
