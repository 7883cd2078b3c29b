// SPDX-License-Identifier: MIT
//
// Point clouds that the hull and convex tests share. Each fills up to `count` points and returns how many it made.

#ifndef TALUS_TEST_HULL_SHAPES_H
#define TALUS_TEST_HULL_SHAPES_H

#include "talus_test.h"

#include <talus/hull.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum shape_kind {
    SHAPE_SPHERE,       ///< on a sphere
    SHAPE_BALL,         ///< in a ball
    SHAPE_CUBE_VOLUME,  ///< in a cube
    SHAPE_CUBE_SURFACE, ///< on the faces of a cube, corners included
    SHAPE_GRID,         ///< a lattice: most points coplanar or collinear with others
    SHAPE_PRISM,        ///< two rings
    SHAPE_CONE,         ///< a ring and an apex
    SHAPE_NEEDLE,       ///< a sphere stretched 1000 : 1
    SHAPE_PLATE,        ///< a sphere flattened 1 : 1000
    SHAPE_LENS,         ///< the common part of two balls
    SHAPE_CAPSULE,      ///< two half spheres apart
    SHAPE_CLUSTER,      ///< few distinct points, many times
    SHAPE_COUNT
} shape_kind;

/// Whether two hulls have the same faces of the same points.
static inline bool shape_is_same_topology(const tl_hull *a, const tl_hull *b)
{
    bool same = a->vertex_count == b->vertex_count && a->face_count == b->face_count &&
                a->half_edge_count == b->half_edge_count;
    for (uint32_t h = 0; same && h < a->half_edge_count; h++) {
        const tl_hull_half_edge e = tl_hull_edge_at(a, h), f = tl_hull_edge_at(b, h);
        same = memcmp(&e, &f, sizeof e) == 0;
    }
    for (uint32_t v = 0; same && v < a->vertex_count; v++) {
        same = tl_hull_source(a, v) == tl_hull_source(b, v);
    }
    return same;
}

static inline tl_vec3 shape_on_ring(uint32_t i, uint32_t count)
{
    float angle = 6.2831853f * (float)i / (float)count;
    return tl_vec3_make(cosf(angle), 0.0f, sinf(angle));
}

static inline tl_vec3 shape_on_cube(test_random *random)
{
    tl_vec3 p = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
    uint32_t side = test_random_below(random, 6);
    float value = side % 2 ? 1.0f : -1.0f;
    return side / 2 == 0   ? tl_vec3_make(value, p.y, p.z)
           : side / 2 == 1 ? tl_vec3_make(p.x, value, p.z)
                           : tl_vec3_make(p.x, p.y, value);
}

static inline uint32_t shape_make(shape_kind kind, test_random *random, tl_vec3 *points, uint32_t count)
{
    uint32_t side = (uint32_t)ceilf(cbrtf((float)count));
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 d = test_random_direction(random);
        tl_vec3 p = d;
        switch (kind) {
        case SHAPE_BALL:
            p = tl_scale(d, test_random_unit(random));
            break;
        case SHAPE_CUBE_VOLUME:
            p = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
            break;
        case SHAPE_CUBE_SURFACE:
            p = i < 8 ? tl_vec3_make(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f)
                      : shape_on_cube(random);
            break;
        case SHAPE_GRID:
            p = tl_vec3_make((float)(i % side), (float)(i / side % side), (float)(i / (side * side)));
            break;
        case SHAPE_PRISM:
            p = shape_on_ring(i / 2, (count + 1) / 2);
            p.y = i % 2 ? 1.0f : -1.0f;
            break;
        case SHAPE_CONE:
            p = i == 0 ? tl_vec3_make(0, 2, 0) : shape_on_ring(i, count - 1);
            break;
        case SHAPE_NEEDLE:
            p = tl_vec3_make(d.x * 1000.0f, d.y, d.z);
            break;
        case SHAPE_PLATE:
            p = tl_vec3_make(d.x * 1000.0f, d.y, d.z * 1000.0f);
            break;
        case SHAPE_LENS:
            p = tl_vec3_make(d.x, d.y + (d.y > 0 ? -0.8f : 0.8f), d.z);
            break;
        case SHAPE_CAPSULE:
            p = tl_vec3_make(d.x, d.y + (d.y > 0 ? 2.0f : -2.0f), d.z);
            break;
        case SHAPE_CLUSTER: {
            test_random fixed = { i % 17u };
            p = test_random_direction(&fixed);
            break;
        }
        default:
            break;
        }
        points[i] = p;
    }
    return count;
}

/// The clouds of a text file: a line N, then N lines x y z. Calls `visit` for each; returns how many there were, 0 when
/// the file is not there.
static inline uint32_t shape_each_cloud(const char *path, void (*visit)(tl_vec3 *points, uint32_t count, void *user),
                                        void *user)
{
    FILE *file = fopen(path, "r");
    uint32_t clouds = 0, count;
    if (file == NULL) {
        return 0;
    }
    while (fscanf(file, "%u", &count) == 1) {
        tl_vec3 *points = (tl_vec3 *)malloc((count + 1) * sizeof *points);
        for (uint32_t i = 0; i < count; i++) {
            assert_int_equal(fscanf(file, "%f %f %f", &points[i].x, &points[i].y, &points[i].z), 3);
        }
        visit(points, count, user);
        free(points);
        clouds++;
    }
    fclose(file);
    return clouds;
}

/// The vertices of an OBJ file, or NULL when it is not there. Freed by the caller.
static inline tl_vec3 *shape_read_obj(const char *path, uint32_t *count_out)
{
    FILE *file = fopen(path, "r");
    *count_out = 0;
    if (file == NULL) {
        return NULL;
    }
    char line[256];
    uint32_t count = 0, capacity = 1024;
    tl_vec3 *points = (tl_vec3 *)malloc(capacity * sizeof *points);
    while (fgets(line, sizeof line, file) != NULL) {
        tl_vec3 p;
        if (sscanf(line, "v %f %f %f", &p.x, &p.y, &p.z) == 3) {
            if (count == capacity) {
                capacity *= 2;
                points = (tl_vec3 *)realloc(points, capacity * sizeof *points);
            }
            points[count++] = p;
        }
    }
    fclose(file);
    *count_out = count;
    return points;
}

#endif
