// SPDX-License-Identifier: MIT
//
// A level, its navmesh and its soup side by side, for tests of what holds both. The soup may be made of a level that
// has changed since the bake.

#ifndef TALUS_TEST_NAV_AUDIT_LEVEL_H
#define TALUS_TEST_NAV_AUDIT_LEVEL_H

#include "nav_bake.h"
#include "nav_level.h"

#include <talus/nav_query.h>
#include <talus/soup.h>

/// An upright box with all its sides.
static inline void audit_block(test_level *level, float x0, float y0, float z0, float x1, float y1, float z1)
{
    test_level_box(level, x0, y0, z0, x1, y1, z1, y1);
    level->mesh.vertices = level->vertices;
    level->mesh.indices = level->indices;
}

/// A floor, seen from above.
static inline void audit_floor(test_level *level, float x0, float z0, float x1, float z1, float y)
{
    test_level_quad(level, tl_vec3_make(x0, y, z0), tl_vec3_make(x0, y, z1), tl_vec3_make(x1, y, z1),
                    tl_vec3_make(x1, y, z0));
    level->mesh.vertices = level->vertices;
    level->mesh.indices = level->indices;
}

static inline void audit_move(test_level *level, tl_vec3 offset)
{
    for (uint32_t i = 0; i < level->mesh.vertex_count; i++) {
        level->vertices[i] = tl_add(level->vertices[i], offset);
    }
}

static inline tl_soup *audit_soup(const test_level *level)
{
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&level->mesh, NULL, &soup, NULL), TL_OK);
    return soup;
}

#endif
