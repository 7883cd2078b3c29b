// SPDX-License-Identifier: MIT
//
// Levels of several storeys, for tests of places that are divided into layers.

#ifndef TALUS_TEST_STACKED_LEVELS_H
#define TALUS_TEST_STACKED_LEVELS_H

#include "cli/sample/sample_level.h"

#include "talus_test.h"

#include <string.h>

// A floor whose height goes from y0 at its low end to y1 at its high end, along x or along z.
static inline void add_floor(tl_sample_mesh *mesh, float x0, float z0, float x1, float z1, float y0, float y1,
                             bool along_x)
{
    const uint32_t a = tl_sample_vertex(mesh, tl_vec3_make(x0, y0, z0));
    const uint32_t b = tl_sample_vertex(mesh, tl_vec3_make(x0, along_x ? y0 : y1, z1));
    const uint32_t c = tl_sample_vertex(mesh, tl_vec3_make(x1, y1, z1));
    const uint32_t d = tl_sample_vertex(mesh, tl_vec3_make(x1, along_x ? y1 : y0, z0));
    tl_sample_quad(mesh, a, b, c, d);
}

// A ramp that winds around a pillar, six storeys up, with a platform at its foot and its head.
static inline void build_spiral(tl_sample_mesh *mesh)
{
    enum { STEPS = 24, TURNS = 6 };
    static const float quarter[7] = { 0.0f, 0.258819f, 0.5f, 0.707107f, 0.866025f, 0.965926f, 1.0f };
    add_floor(mesh, -10, -10, 10, 10, 0, 0, true);
    uint32_t last[2] = { 0, 0 };
    for (uint32_t i = 0; i <= STEPS * TURNS; i++) {
        const uint32_t k = i % STEPS, q = k / 6, r = k % 6;
        const float s = quarter[r], c = quarter[6 - r];
        const float x = q == 0 ? c : q == 1 ? -s : q == 2 ? -c : s, z = q == 0 ? s : q == 1 ? c : q == 2 ? -s : -c;
        const float y = 3.6f * (float)i / (float)STEPS;
        const uint32_t inner = tl_sample_vertex(mesh, tl_vec3_make(3.0f * x, y, 3.0f * z));
        const uint32_t outer = tl_sample_vertex(mesh, tl_vec3_make(7.0f * x, y, 7.0f * z));
        if (i > 0) {
            tl_sample_quad(mesh, last[0], inner, outer, last[1]);
        }
        last[0] = inner;
        last[1] = outer;
    }
    add_floor(mesh, 3, -8, 12, 0.3f, 3.6f * TURNS, 3.6f * TURNS, true);
}

// Five storeys over one another, with flights of stairs at their side, to and fro.
static inline void build_house(tl_sample_mesh *mesh)
{
    for (uint32_t k = 0; k < 5; k++) {
        const float y = 3.0f * (float)k;
        add_floor(mesh, 0, 0, 16, 10, y, y, true);
        const bool east = k % 2 == 0;
        add_floor(mesh, 0, 10, 3, 16, y, y, true);
        add_floor(mesh, 13, 10, 16, 16, y, y, true);
        if (k < 4) {
            const float z0 = k % 2 == 0 ? 10.0f : 13.0f;
            add_floor(mesh, 3, z0, 13, z0 + 3, east ? y : y + 3, east ? y + 3 : y, true);
        }
    }
}

// Three bridges over one another, ramps at both of their ends.
static inline void build_bridges(tl_sample_mesh *mesh)
{
    add_floor(mesh, 0, 0, 44, 44, 0, 0, true);
    for (uint32_t k = 1; k <= 3; k++) {
        const float y = 2.9f * (float)k, at = 14.0f + 3.0f * (float)k;
        const bool along_x = k % 2 == 1;
        for (uint32_t part = 0; part < 3; part++) {
            const float low = part == 0 ? 1.0f : part == 1 ? 15.0f : 29.0f, high = low + 14.0f;
            const float y0 = part == 0 ? 0 : y, y1 = part == 2 ? 0 : y;
            if (along_x) {
                add_floor(mesh, low, at, high, at + 4, y0, y1, true);
            } else {
                add_floor(mesh, at, low, at + 4, high, y0, y1, false);
            }
        }
    }
}

typedef struct level_source {
    const char *name;
    void (*build)(tl_sample_mesh *mesh); // NULL: built in
    uint32_t triangles;
} level_source;

static const level_source STACKED_LEVELS[] = {
    { "spiral", build_spiral, 0 }, { "house", build_house, 0 }, { "bridges", build_bridges, 0 },
    { "dungeon", NULL, 3000 },     { "city", NULL, 3000 },      { "courtyard", NULL, 3000 },
    { "terrain", NULL, 2000 },
};

static inline void make_level(const level_source *source, tl_sample_mesh *mesh)
{
    memset(mesh, 0, sizeof *mesh);
    if (source->build != NULL) {
        source->build(mesh);
        TEST_RESULT(mesh->result, TL_OK);
    } else {
        TEST_RESULT(tl_sample_build_level(tl_sample_find_level(source->name), source->triangles, 1, mesh), TL_OK);
    }
}

static inline tl_aabb bounds_of(const tl_sample_mesh *mesh)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        bounds = tl_aabb_add_point(bounds, mesh->vertices[v]);
    }
    return bounds;
}

#endif
