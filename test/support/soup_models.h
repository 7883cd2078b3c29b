// SPDX-License-Identifier: MIT
//
// Triangle lists for the soup's tests: generated ones, and the levels at TALUS_DATA_DIR where those are present.

#ifndef TALUS_TEST_SOUP_MODELS_H
#define TALUS_TEST_SOUP_MODELS_H

#include "talus_test.h"

#include <stdio.h>
#include <string.h>
#include <talus/soup.h>

typedef struct model {
    tl_vec3 *vertices;
    uint32_t vertex_count, vertex_capacity;
    uint32_t *indices;
    uint32_t triangle_count, triangle_capacity;
} model;

static inline void model_free(model *m)
{
    free(m->vertices);
    free(m->indices);
    memset(m, 0, sizeof *m);
}

static inline uint32_t model_vertex(model *m, float x, float y, float z)
{
    if (m->vertex_count == m->vertex_capacity) {
        m->vertex_capacity = m->vertex_capacity * 2 + 64;
        m->vertices = realloc(m->vertices, m->vertex_capacity * sizeof *m->vertices);
        TEST_CHECK(m->vertices != NULL);
    }
    m->vertices[m->vertex_count] = tl_vec3_make(x, y, z);
    return m->vertex_count++;
}

static inline void model_triangle(model *m, uint32_t a, uint32_t b, uint32_t c)
{
    if (m->triangle_count == m->triangle_capacity) {
        m->triangle_capacity = m->triangle_capacity * 2 + 64;
        m->indices = realloc(m->indices, m->triangle_capacity * 3 * sizeof *m->indices);
        TEST_CHECK(m->indices != NULL);
    }
    uint32_t *corner = m->indices + 3 * (size_t)m->triangle_count++;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

/// Each triangle twice or three times, in other orders and windings.
static inline void model_repeat_triangles(model *m)
{
    uint32_t count = m->triangle_count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = m->indices[3 * i], b = m->indices[3 * i + 1], c = m->indices[3 * i + 2];
        model_triangle(m, b, c, a);
        if (i % 3 == 0) {
            model_triangle(m, c, b, a);
        }
    }
}

static inline tl_mesh_view model_view(const model *m)
{
    tl_mesh_view view = { m->vertices, m->vertex_count, m->indices, m->triangle_count, NULL };
    return view;
}

/// The ways to store a model: answers must not tell them apart.
typedef enum model_storage {
    MODEL_BOXES,
    MODEL_SPLITS,
    MODEL_KD,
    MODEL_COMPACT,
    MODEL_COMPACT_SPLITS,
    MODEL_STORAGES
} model_storage;

static inline tl_soup_def model_soup_def(model_storage storage)
{
    tl_soup_def def = tl_default_soup_def();
    def.quality = TL_SOUP_QUALITY_FAST;
    def.split_budget = storage == MODEL_SPLITS || storage == MODEL_COMPACT_SPLITS ? 0.5f : 0.0f;
    def.partition = storage == MODEL_KD ? TL_SOUP_KD_TREE : TL_SOUP_BVH;
    def.layout = storage >= MODEL_COMPACT ? TL_SOUP_COMPACT : TL_SOUP_FAST;
    return def;
}

static inline tl_soup *model_soup(const model *m, const tl_soup_def *def)
{
    tl_mesh_view view = model_view(m);
    tl_soup *soup = NULL;
    TEST_RESULT(tl_soup_bake(&view, def, &soup, NULL), TL_OK);
    return soup;
}

/// A closed bumpy ball of 8 * 4^levels triangles around `center`: an octahedron split `levels` times.
static inline model model_ball(uint32_t levels, float radius, float bump, tl_vec3 center, uint64_t seed)
{
    test_random random = { seed };
    model m = { 0 };
    static const float axis[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    static const uint32_t faces[8][3] = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                          { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
    uint32_t n = 1u << levels;
    // Each face is a grid of barycentric integers; equal positions on shared edges are welded by a search.
    for (uint32_t f = 0; f < 8; f++) {
        uint32_t *row = malloc((n + 1) * (n + 1) * sizeof *row);
        TEST_CHECK(row != NULL);
        for (uint32_t i = 0; i <= n; i++) {
            for (uint32_t j = 0; i + j <= n; j++) {
                float w[3] = { (float)(n - i - j), (float)i, (float)j };
                float p[3];
                for (int k = 0; k < 3; k++) {
                    p[k] = w[0] * axis[faces[f][0]][k] + w[1] * axis[faces[f][1]][k] + w[2] * axis[faces[f][2]][k];
                }
                tl_vec3 unit = tl_normalize(tl_vec3_make(p[0], p[1], p[2]));
                uint32_t found = UINT32_MAX;
                for (uint32_t v = 0; v < m.vertex_count && found == UINT32_MAX; v++) {
                    if (m.vertices[v].x == unit.x && m.vertices[v].y == unit.y && m.vertices[v].z == unit.z) {
                        found = v;
                    }
                }
                row[i * (n + 1) + j] = found != UINT32_MAX ? found : model_vertex(&m, unit.x, unit.y, unit.z);
            }
        }
        for (uint32_t i = 0; i < n; i++) {
            for (uint32_t j = 0; i + j < n; j++) {
                uint32_t a = row[i * (n + 1) + j], b = row[(i + 1) * (n + 1) + j], c = row[i * (n + 1) + j + 1];
                model_triangle(&m, a, b, c);
                if (i + j + 1 < n) {
                    model_triangle(&m, b, row[(i + 1) * (n + 1) + j + 1], c);
                }
            }
        }
        free(row);
    }
    for (uint32_t v = 0; v < m.vertex_count; v++) {
        float r = radius * (1.0f + bump * test_random_range(&random, -1.0f, 1.0f));
        m.vertices[v] = tl_mul_add(center, m.vertices[v], r);
    }
    return m;
}

/// Random triangles: `size` is their extent, `range` where they lie.
static inline model model_random(uint32_t count, float range, float size, uint64_t seed)
{
    test_random random = { seed };
    model m = { 0 };
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 low = tl_vec3_make(-range, -range, -range), high = tl_vec3_make(range, range, range);
        tl_vec3 p = test_random_point(&random, low, high);
        uint32_t corner[3];
        for (int k = 0; k < 3; k++) {
            tl_vec3 d = test_random_point(&random, tl_vec3_make(-size, -size, -size), tl_vec3_make(size, size, size));
            tl_vec3 v = tl_add(p, d);
            corner[k] = model_vertex(&m, v.x, v.y, v.z);
        }
        model_triangle(&m, corner[0], corner[1], corner[2]);
    }
    return m;
}

/// A height field of n * n cells of one metre with random heights up to `height`, and a few boxes standing on it.
static inline model model_terrain(uint32_t n, float height, tl_vec3 offset, uint64_t seed)
{
    test_random random = { seed };
    model m = { 0 };
    for (uint32_t z = 0; z <= n; z++) {
        for (uint32_t x = 0; x <= n; x++) {
            model_vertex(&m, offset.x + (float)x, offset.y + test_random_range(&random, 0, height),
                         offset.z + (float)z);
        }
    }
    for (uint32_t z = 0; z < n; z++) {
        for (uint32_t x = 0; x < n; x++) {
            uint32_t a = z * (n + 1) + x;
            model_triangle(&m, a, a + n + 1, a + 1);
            model_triangle(&m, a + 1, a + n + 1, a + n + 2);
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        float x = offset.x + (float)test_random_below(&random, n), z = offset.z + (float)test_random_below(&random, n);
        float y = offset.y, w = test_random_range(&random, 0.2f, 2.0f), h = test_random_range(&random, 1.0f, 8.0f);
        uint32_t v[8];
        for (uint32_t k = 0; k < 8; k++) {
            v[k] = model_vertex(&m, x + (k & 1 ? w : 0), y + (k & 2 ? h : 0), z + (k & 4 ? w : 0));
        }
        static const uint8_t quads[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                             { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
        for (uint32_t q = 0; q < 6; q++) {
            model_triangle(&m, v[quads[q][0]], v[quads[q][1]], v[quads[q][2]]);
            model_triangle(&m, v[quads[q][0]], v[quads[q][2]], v[quads[q][3]]);
        }
    }
    return m;
}

/// The corners scaled, each coordinate rounded once; mirrored triangles the other way round.
static inline model model_scaled(const model *m, tl_vec3 scale)
{
    model out = { 0 };
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        const tl_vec3 v = tl_mul(m->vertices[i], scale);
        model_vertex(&out, v.x, v.y, v.z);
    }
    const bool mirrored = (scale.x < 0.0f) ^ (scale.y < 0.0f) ^ (scale.z < 0.0f);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *k = m->indices + 3 * (size_t)i;
        model_triangle(&out, k[0], mirrored ? k[2] : k[1], mirrored ? k[1] : k[2]);
    }
    return out;
}

/// Reads "v x y z" and "f a b c" lines of TALUS_DATA_DIR/name; an empty model when the file is not there.
static inline model model_load(const char *name)
{
    model m = { 0 };
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", TALUS_DATA_DIR, name);
    FILE *file = fopen(path, "r");
    char line[512];
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        float x, y, z;
        unsigned a, b, c;
        if (sscanf(line, "v %f %f %f", &x, &y, &z) == 3) {
            model_vertex(&m, x, y, z);
        } else if (sscanf(line, "f %u%*[^ ] %u%*[^ ] %u", &a, &b, &c) == 3 ||
                   sscanf(line, "f %u %u %u", &a, &b, &c) == 3) {
            model_triangle(&m, a - 1, b - 1, c - 1);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return m;
}

static const char *const model_levels[] = { "levels/nav_test.obj",    "levels/dungeon.obj",
                                            "levels/undulating.obj",  "levels/test_map01.obj",
                                            "levels/proto-level.obj", "levels/collision_mesh_01.obj" };

/// The triangle (0,0,0) (4,0,0) (0,0,4), whose front faces down, at y = 0.
static inline model model_one_triangle(void)
{
    model m = { 0 };
    model_vertex(&m, 0, 0, 0);
    model_vertex(&m, 4, 0, 0);
    model_vertex(&m, 0, 0, 4);
    model_triangle(&m, 0, 1, 2);
    return m;
}

#endif
