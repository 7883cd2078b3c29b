// SPDX-License-Identifier: MIT
//
// A brute-force twin of the convex queries: every vertex against every triangle, every edge against every edge, in
// double. Slow and plain.

#ifndef TALUS_TEST_CONVEX_ORACLE_H
#define TALUS_TEST_CONVEX_ORACLE_H

#include "hull_shapes.h"

#include "math/vec3d.h"

#include <talus/convex.h>

#define ORACLE_MAX 512

typedef struct oracle_body {
    tl_vec3d vertices[ORACLE_MAX];
    uint32_t vertex_count;
    uint32_t edges[2 * ORACLE_MAX];
    uint32_t edge_count;
    uint32_t triangles[3 * ORACLE_MAX];
    uint32_t triangle_count;
    bool solid;
} oracle_body;

static inline tl_vec3d oracle_transform(tl_transform pose, tl_vec3 p)
{
    double x = (double)pose.rotation.x, y = (double)pose.rotation.y, z = (double)pose.rotation.z,
           w = (double)pose.rotation.w;
    double length = sqrt(x * x + y * y + z * z + w * w);
    tl_vec3d u = tl_vec3d_make(x / length, y / length, z / length);
    tl_vec3d v = tl_vec3d_from(p);
    tl_vec3d t = tl_vec3d_scale(tl_vec3d_cross(u, v), 2.0);
    tl_vec3d r = tl_vec3d_add(tl_vec3d_mul_add(v, t, w / length), tl_vec3d_cross(u, t));
    return tl_vec3d_add(r, tl_vec3d_from(pose.position));
}

static inline void oracle_from_hull(oracle_body *body, const tl_hull *hull, tl_transform pose)
{
    body->vertex_count = hull->vertex_count;
    body->edge_count = body->triangle_count = 0;
    body->solid = true;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        body->vertices[v] = oracle_transform(pose, tl_hull_vertices(hull)[v]);
    }
    for (uint32_t e = 0; e < hull->half_edge_count; e++) {
        const tl_hull_half_edge h = tl_hull_edge_at(hull, e);
        if (e < h.twin) {
            body->edges[2 * body->edge_count] = h.origin;
            body->edges[2 * body->edge_count++ + 1] = tl_hull_edge_origin(hull, h.next);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t k = 1; k + 1 < face.count; k++) {
            uint32_t *t = &body->triangles[3 * body->triangle_count++];
            t[0] = tl_hull_edge_origin(hull, face.first);
            t[1] = tl_hull_edge_origin(hull, face.first + k);
            t[2] = tl_hull_edge_origin(hull, face.first + k + 1);
        }
    }
}

/// A point, a segment, or the corners of a flat convex polygon in their order.
static inline void oracle_from_points(oracle_body *body, const tl_vec3 *points, uint32_t count, tl_transform pose)
{
    body->vertex_count = count;
    body->edge_count = count >= 3 ? count : count - 1;
    body->triangle_count = count >= 3 ? count - 2 : 0;
    body->solid = false;
    for (uint32_t i = 0; i < count; i++) {
        body->vertices[i] = oracle_transform(pose, points[i]);
        body->edges[2 * i] = i;
        body->edges[2 * i + 1] = (i + 1) % count;
    }
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        body->triangles[3 * i] = 0;
        body->triangles[3 * i + 1] = i + 1;
        body->triangles[3 * i + 2] = i + 2;
    }
}

static inline double oracle_clamp(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

static inline double oracle_point_segment(tl_vec3d p, tl_vec3d a, tl_vec3d b)
{
    tl_vec3d d = tl_vec3d_sub(b, a);
    double length_sq = tl_vec3d_dot(d, d);
    double t = length_sq > 0.0 ? oracle_clamp(tl_vec3d_dot(tl_vec3d_sub(p, a), d) / length_sq) : 0.0;
    return tl_vec3d_length(tl_vec3d_sub(p, tl_vec3d_mul_add(a, d, t)));
}

static inline double oracle_point_triangle(tl_vec3d p, tl_vec3d a, tl_vec3d b, tl_vec3d c)
{
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double u = tl_vec3d_dot(n, tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(p, a)));
    double v = tl_vec3d_dot(n, tl_vec3d_cross(tl_vec3d_sub(c, b), tl_vec3d_sub(p, b)));
    double w = tl_vec3d_dot(n, tl_vec3d_cross(tl_vec3d_sub(a, c), tl_vec3d_sub(p, c)));
    if (u >= 0.0 && v >= 0.0 && w >= 0.0 && tl_vec3d_dot(n, n) > 0.0) {
        return fabs(tl_vec3d_dot(n, tl_vec3d_sub(p, a))) / tl_vec3d_length(n);
    }
    return fmin(oracle_point_segment(p, a, b), fmin(oracle_point_segment(p, b, c), oracle_point_segment(p, c, a)));
}

static inline double oracle_segments(tl_vec3d a, tl_vec3d b, tl_vec3d c, tl_vec3d d)
{
    tl_vec3d u = tl_vec3d_sub(b, a), v = tl_vec3d_sub(d, c), n = tl_vec3d_cross(u, v), r = tl_vec3d_sub(c, a);
    double nn = tl_vec3d_dot(n, n);
    double best = fmin(fmin(oracle_point_segment(a, c, d), oracle_point_segment(b, c, d)),
                       fmin(oracle_point_segment(c, a, b), oracle_point_segment(d, a, b)));
    if (nn > 0.0) {
        double s = tl_vec3d_dot(tl_vec3d_cross(r, v), n) / nn, t = tl_vec3d_dot(tl_vec3d_cross(r, u), n) / nn;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
            tl_vec3d p = tl_vec3d_mul_add(a, u, s), q = tl_vec3d_mul_add(c, v, t);
            best = fmin(best, tl_vec3d_length(tl_vec3d_sub(p, q)));
        }
    }
    return best;
}

static inline bool oracle_inside(const oracle_body *body, tl_vec3d p)
{
    if (!body->solid) {
        return false;
    }
    for (uint32_t t = 0; t < body->triangle_count; t++) {
        tl_vec3d a = body->vertices[body->triangles[3 * t]], b = body->vertices[body->triangles[3 * t + 1]],
                 c = body->vertices[body->triangles[3 * t + 2]];
        if (tl_vec3d_dot(tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a)), tl_vec3d_sub(p, a)) > 0.0) {
            return false;
        }
    }
    return true;
}

static inline bool oracle_pierces(tl_vec3d p, tl_vec3d q, tl_vec3d a, tl_vec3d b, tl_vec3d c)
{
    tl_vec3d d = tl_vec3d_sub(q, p);
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double hp = tl_vec3d_dot(n, tl_vec3d_sub(p, a)), hq = tl_vec3d_dot(n, tl_vec3d_sub(q, a));
    if (hp * hq > 0.0 || hp == hq) {
        return false;
    }
    double x = tl_vec3d_dot(d, tl_vec3d_cross(tl_vec3d_sub(a, p), tl_vec3d_sub(b, p)));
    double y = tl_vec3d_dot(d, tl_vec3d_cross(tl_vec3d_sub(b, p), tl_vec3d_sub(c, p)));
    double z = tl_vec3d_dot(d, tl_vec3d_cross(tl_vec3d_sub(c, p), tl_vec3d_sub(a, p)));
    return (x >= 0.0 && y >= 0.0 && z >= 0.0) || (x <= 0.0 && y <= 0.0 && z <= 0.0);
}

/// Distance of two bodies, 0 when they share a point.
static inline double oracle_distance(const oracle_body *a, const oracle_body *b)
{
    if (oracle_inside(b, a->vertices[0]) || oracle_inside(a, b->vertices[0])) {
        return 0.0;
    }
    double best = (double)INFINITY;
    for (int turn = 0; turn < 2; turn++) {
        const oracle_body *p = turn ? b : a, *q = turn ? a : b;
        for (uint32_t t = 0; t < q->triangle_count; t++) {
            const uint32_t *i = &q->triangles[3 * t];
            for (uint32_t v = 0; v < p->vertex_count; v++) {
                best = fmin(best, oracle_point_triangle(p->vertices[v], q->vertices[i[0]], q->vertices[i[1]],
                                                        q->vertices[i[2]]));
            }
            for (uint32_t e = 0; e < p->edge_count; e++) {
                if (oracle_pierces(p->vertices[p->edges[2 * e]], p->vertices[p->edges[2 * e + 1]], q->vertices[i[0]],
                                   q->vertices[i[1]], q->vertices[i[2]])) {
                    return 0.0;
                }
            }
        }
        for (uint32_t e = 0; e < q->edge_count && p->vertex_count == 1; e++) {
            best = fmin(best, oracle_point_segment(p->vertices[0], q->vertices[q->edges[2 * e]],
                                                   q->vertices[q->edges[2 * e + 1]]));
        }
    }
    for (uint32_t i = 0; i < a->edge_count; i++) {
        for (uint32_t j = 0; j < b->edge_count; j++) {
            best = fmin(best, oracle_segments(a->vertices[a->edges[2 * i]], a->vertices[a->edges[2 * i + 1]],
                                              b->vertices[b->edges[2 * j]], b->vertices[b->edges[2 * j + 1]]));
        }
    }
    if (a->vertex_count == 1 && b->vertex_count == 1) {
        best = tl_vec3d_length(tl_vec3d_sub(a->vertices[0], b->vertices[0]));
    }
    return best;
}

static inline double oracle_overlap_along(const oracle_body *a, const oracle_body *b, tl_vec3d axis)
{
    double a_low = (double)INFINITY, a_high = -(double)INFINITY, b_low = a_low, b_high = a_high;
    for (uint32_t i = 0; i < a->vertex_count; i++) {
        double d = tl_vec3d_dot(axis, a->vertices[i]);
        a_low = fmin(a_low, d);
        a_high = fmax(a_high, d);
    }
    for (uint32_t i = 0; i < b->vertex_count; i++) {
        double d = tl_vec3d_dot(axis, b->vertices[i]);
        b_low = fmin(b_low, d);
        b_high = fmax(b_high, d);
    }
    return fmin(a_high - b_low, b_high - a_low);
}

/// The least motion that parts two overlapping solids: over all face normals and edge cross products.
static inline double oracle_depth(const oracle_body *a, const oracle_body *b)
{
    double best = (double)INFINITY;
    for (int turn = 0; turn < 2; turn++) {
        const oracle_body *p = turn ? b : a;
        for (uint32_t t = 0; t < p->triangle_count; t++) {
            tl_vec3d o = p->vertices[p->triangles[3 * t]];
            tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(p->vertices[p->triangles[3 * t + 1]], o),
                                        tl_vec3d_sub(p->vertices[p->triangles[3 * t + 2]], o));
            double length = tl_vec3d_length(n);
            if (length > 0.0) {
                best = fmin(best, oracle_overlap_along(a, b, tl_vec3d_scale(n, 1.0 / length)));
            }
        }
    }
    for (uint32_t i = 0; i < a->edge_count; i++) {
        tl_vec3d u = tl_vec3d_sub(a->vertices[a->edges[2 * i + 1]], a->vertices[a->edges[2 * i]]);
        for (uint32_t j = 0; j < b->edge_count; j++) {
            tl_vec3d v = tl_vec3d_sub(b->vertices[b->edges[2 * j + 1]], b->vertices[b->edges[2 * j]]);
            tl_vec3d n = tl_vec3d_cross(u, v);
            double length = tl_vec3d_length(n);
            if (length > 1e-12 * tl_vec3d_length(u) * tl_vec3d_length(v)) {
                best = fmin(best, oracle_overlap_along(a, b, tl_vec3d_scale(n, 1.0 / length)));
            }
        }
    }
    return best;
}

/// Families of bodies. Hulls are made once; the others are 1 to 3 points.
typedef enum body_family {
    BODY_BOX,
    BODY_SPHERE,
    BODY_NEEDLE,
    BODY_PLATE,
    BODY_PRISM,
    BODY_CONE,
    BODY_LENS,
    BODY_CAPSULE,
    BODY_BALL,
    BODY_SLAB, ///< a thickened flat cloud
    BODY_TETRAHEDRON,
    BODY_POINT,
    BODY_SEGMENT,
    BODY_TRIANGLE,
    BODY_COUNT
} body_family;

typedef struct test_body {
    tl_hull *hull; ///< NULL: points
    tl_vec3 points[3];
    uint32_t point_count;
    tl_convex shape;
    float size; ///< largest extent
} test_body;

static inline void test_body_make(test_body *body, body_family family, uint64_t seed, float scale)
{
    static const shape_kind kinds[] = { SHAPE_GRID, SHAPE_SPHERE,  SHAPE_NEEDLE, SHAPE_PLATE,  SHAPE_PRISM, SHAPE_CONE,
                                        SHAPE_LENS, SHAPE_CAPSULE, SHAPE_BALL,   SHAPE_SPHERE, SHAPE_SPHERE };
    test_random random = { seed };
    tl_vec3 points[24];
    uint32_t count = family == BODY_BOX ? 8 : family == BODY_TETRAHEDRON ? 4 : 24;
    body->hull = NULL;
    if (family >= BODY_POINT) {
        body->point_count = (uint32_t)(family - BODY_POINT) + 1;
        for (uint32_t i = 0; i < body->point_count; i++) {
            body->points[i] = tl_scale(test_random_direction(&random), scale);
        }
        body->shape = tl_convex_from_points(body->points, body->point_count, 0.0f);
        body->size = scale;
        return;
    }
    shape_make(kinds[family], &random, points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i].y = family == BODY_SLAB ? 0.0f : points[i].y;
        points[i] = tl_scale(points[i], scale * (family == BODY_NEEDLE || family == BODY_PLATE ? 1e-3f : 1.0f));
    }
    tl_hull_def def = tl_default_hull_def();
    def.thickness = 0.001f * scale;
    TEST_RESULT(tl_hull_bake(points, count, &def, &body->hull, NULL), TL_OK);
    body->shape = tl_convex_from_hull(body->hull, 0.0f);
    tl_vec3 size = tl_aabb_size(body->hull->bounds);
    body->size = tl_maxf(size.x, tl_maxf(size.y, size.z));
}

static inline void test_body_free(test_body *body)
{
    tl_blob_free(body->hull);
}

static inline void test_body_oracle(const test_body *body, tl_transform pose, oracle_body *out)
{
    if (body->hull != NULL) {
        oracle_from_hull(out, body->hull, pose);
    } else {
        oracle_from_points(out, body->points, body->point_count, pose);
    }
}

static inline tl_quat test_random_rotation(test_random *random)
{
    tl_vec3 a = test_random_direction(random);
    tl_quat q = { a.x, a.y, a.z, test_random_range(random, -1, 1) };
    return tl_quat_normalize(q);
}

typedef enum gap_class {
    GAP_CONCENTRIC,
    GAP_DEEP,
    GAP_SHALLOW,
    GAP_TOUCHING,
    GAP_1E_6,
    GAP_1E_4,
    GAP_1E_2,
    GAP_ONE,
    GAP_HUNDRED,
    GAP_COUNT
} gap_class;

static inline tl_vec3d oracle_support(const oracle_body *body, tl_vec3d d)
{
    tl_vec3d best = body->vertices[0];
    for (uint32_t i = 1; i < body->vertex_count; i++) {
        best = tl_vec3d_dot(d, body->vertices[i]) > tl_vec3d_dot(d, best) ? body->vertices[i] : best;
    }
    return best;
}

/// Turns both and moves b so that, along a random direction, it begins `gap` behind where a ends, vertex against
/// vertex.
static inline void test_place(test_random *random, const test_body *a, const test_body *b, gap_class gap,
                              tl_transform *pose_a, tl_transform *pose_b)
{
    static const float gaps[] = { 0, -0.5f, -0.01f, 0, 1e-6f, 1e-4f, 1e-2f, 1, 100 };
    static oracle_body body_a, body_b;
    float size = tl_maxf(a->size, b->size);
    pose_a->rotation = test_random_rotation(random);
    pose_b->rotation = test_random_rotation(random);
    pose_a->position = pose_b->position = tl_scale(test_random_direction(random), size);
    if (gap == GAP_CONCENTRIC) {
        return;
    }
    test_body_oracle(a, *pose_a, &body_a);
    test_body_oracle(b, *pose_b, &body_b);
    tl_vec3d n = tl_vec3d_from(test_random_direction(random));
    tl_vec3d end = oracle_support(&body_a, n), begin = oracle_support(&body_b, tl_vec3d_neg(n));
    tl_vec3d move = tl_vec3d_mul_add(tl_vec3d_sub(end, begin), n,
                                     (double)(gaps[gap] * (gap <= GAP_SHALLOW ? tl_minf(a->size, b->size) : size)));
    pose_b->position = tl_vec3d_to_float(tl_vec3d_add(tl_vec3d_from(pose_b->position), move));
}

/// Pairs of all families near the origin and 16384 sizes away: B lies on a lattice that floats hold at both places, up
/// to `reach` sizes from A, so whatever is asked has the same bits.
static inline void test_each_far_pair(uint64_t seed, float reach,
                                      void (*visit)(const test_body *a, const test_body *b, const tl_transform near[2],
                                                    const tl_transform far[2], void *user),
                                      void *user)
{
    test_random random = { seed };
    const tl_vec3 offset = tl_vec3_make(16384, -16384, 8192);
    for (int i = 0; i < 400; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 3 % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_transform near[2], far[2];
        near[0].rotation = test_random_rotation(&random);
        near[1].rotation = test_random_rotation(&random);
        tl_vec3 d = tl_scale(test_random_direction(&random), 256.0f * reach);
        near[0].position = tl_vec3_make(0, 0, 0);
        near[1].position = tl_scale(tl_vec3_make(rintf(d.x), rintf(d.y), rintf(d.z)), 1.0f / 256.0f);
        for (int k = 0; k < 2; k++) {
            far[k] = near[k];
            far[k].position = tl_add(near[k].position, offset);
        }
        visit(&a, &b, near, far, user);
        test_body_free(&a);
        test_body_free(&b);
    }
}

#endif
