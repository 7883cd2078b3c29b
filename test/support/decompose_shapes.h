// SPDX-License-Identifier: MIT
//
// Bodies to decompose, made of boxes, rings and loose triangles.

#ifndef TALUS_TEST_DECOMPOSE_SHAPES_H
#define TALUS_TEST_DECOMPOSE_SHAPES_H

#include "talus_test.h"

#include <math.h>
#include <talus/mesh.h>

enum { SHAPE_MAX_VERTICES = 8192, SHAPE_MAX_TRIANGLES = 16384 };

typedef struct test_shape {
    tl_vec3 vertices[SHAPE_MAX_VERTICES];
    uint32_t indices[3 * SHAPE_MAX_TRIANGLES];
    uint32_t vertex_count, triangle_count;
} test_shape;

static inline uint32_t shape_vertex(test_shape *s, float x, float y, float z)
{
    TEST_CHECK(s->vertex_count < SHAPE_MAX_VERTICES);
    s->vertices[s->vertex_count] = tl_vec3_make(x, y, z);
    return s->vertex_count++;
}

static inline void shape_triangle(test_shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    TEST_CHECK(s->triangle_count < SHAPE_MAX_TRIANGLES);
    uint32_t *at = s->indices + 3 * s->triangle_count++;
    at[0] = a;
    at[1] = b;
    at[2] = c;
}

static inline void shape_quad(test_shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    shape_triangle(s, a, b, c);
    shape_triangle(s, a, c, d);
}

/// A closed box.
static inline void shape_box(test_shape *s, tl_vec3 low, tl_vec3 high)
{
    const uint32_t first = s->vertex_count;
    for (uint32_t i = 0; i < 8; i++) {
        shape_vertex(s, (i & 1u) != 0 ? high.x : low.x, (i & 2u) != 0 ? high.y : low.y, (i & 4u) != 0 ? high.z : low.z);
    }
    static const uint32_t quads[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                          { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (uint32_t i = 0; i < 6; i++) {
        shape_quad(s, first + quads[i][0], first + quads[i][1], first + quads[i][2], first + quads[i][3]);
    }
}

/// A closed prism over a polygon in the xy plane that is star-shaped around its first corner, from z 0 to `height`.
static inline void shape_prism(test_shape *s, const float (*outline)[2], uint32_t count, float height)
{
    const uint32_t first = s->vertex_count;
    for (uint32_t i = 0; i < 2 * count; i++) {
        shape_vertex(s, outline[i % count][0], outline[i % count][1], i < count ? 0.0f : height);
    }
    for (uint32_t i = 1; i + 1 < count; i++) {
        shape_triangle(s, first, first + i + 1, first + i);
        shape_triangle(s, first + count, first + count + i, first + count + i + 1);
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = (i + 1) % count;
        shape_quad(s, first + i, first + next, first + count + next, first + count + i);
    }
}

/// A torus around z. Of a ring of `radius` the tube has radius `tube`.
static inline void shape_torus(test_shape *s, float radius, float tube, uint32_t around, uint32_t across)
{
    const uint32_t first = s->vertex_count;
    for (uint32_t i = 0; i < around; i++) {
        for (uint32_t j = 0; j < across; j++) {
            const float a = 6.2831853f * (float)i / (float)around, b = 6.2831853f * (float)j / (float)across;
            const float r = radius + tube * cosf(b);
            shape_vertex(s, r * cosf(a), r * sinf(a), tube * sinf(b));
        }
    }
    for (uint32_t i = 0; i < around; i++) {
        for (uint32_t j = 0; j < across; j++) {
            const uint32_t n = (i + 1) % around, m = (j + 1) % across;
            shape_quad(s, first + i * across + j, first + n * across + j, first + n * across + m,
                       first + i * across + m);
        }
    }
}

/// An open bowl: the lower half of a sphere, one triangle thick.
static inline void shape_bowl(test_shape *s, float radius, uint32_t around, uint32_t rows)
{
    const uint32_t first = s->vertex_count;
    for (uint32_t i = 0; i <= rows; i++) {
        for (uint32_t j = 0; j < around; j++) {
            const float a = 6.2831853f * (float)j / (float)around, b = 1.5707963f * (float)i / (float)rows;
            shape_vertex(s, radius * cosf(b) * cosf(a), radius * cosf(b) * sinf(a), -radius * sinf(b));
        }
    }
    for (uint32_t i = 0; i < rows; i++) {
        for (uint32_t j = 0; j < around; j++) {
            const uint32_t row = first + i * around, next = (j + 1) % around;
            shape_quad(s, row + j, row + around + j, row + around + next, row + next);
        }
    }
}

static inline void shape_map(test_shape *s, float scale, tl_vec3 shift)
{
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        s->vertices[i] = tl_add(tl_scale(s->vertices[i], scale), shift);
    }
}

static inline tl_mesh_view shape_view(const test_shape *s)
{
    const tl_mesh_view view = { s->vertices, s->vertex_count, s->indices, s->triangle_count, NULL };
    return view;
}

#endif
