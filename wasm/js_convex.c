// SPDX-License-Identifier: MIT
//
// Hulls, and queries on pairs of convex shapes.

#include "js_convex.h"

#include <string.h>

// The kinds of js/src/shape.js, in its order.
enum { SPHERE, CAPSULE, BOX, TRIANGLE, CYLINDER, CONE, POINTS, HULL };

tl_convex tl_js_shape(uint32_t at)
{
    const float radius = tl_js_f32(at + 1);
    const void *pointer = (const void *)(uintptr_t)tl_js_slot[at + 2];
    const tl_vec3 a = tl_js_vec3(at + 4), b = tl_js_vec3(at + 7), c = tl_js_vec3(at + 10);
    switch (tl_js_u32(at)) {
    case SPHERE:
        return tl_convex_sphere(a, radius);
    case CAPSULE:
        return tl_convex_capsule(a, b, radius);
    case BOX:
        return tl_convex_box(a, b, radius);
    case TRIANGLE:
        return tl_convex_triangle(a, b, c, radius);
    case CYLINDER:
        return tl_convex_cylinder(a, b, c.x, radius);
    case CONE:
        return tl_convex_cone(a, b, c.x, radius);
    case POINTS:
        return tl_convex_from_points(pointer, tl_js_u32(at + 3), radius);
    default:
        return tl_convex_from_hull(pointer, radius);
    }
}

// ---------------------------------------------------------------------------------------------------------
// Hulls.

static tl_hull *put_hull(tl_result *result, tl_hull *hull, const tl_hull_report *report)
{
    tl_js_report = report->base;
    uint32_t at = tl_js_put(0, *result);
    at = tl_js_put(at, report->triangle_count);
    at = tl_js_put(at, report->thickened);
    at = tl_js_put(at, report->points_left_out);
    at = tl_js_put(at, report->max_outside);
    tl_js_put(at, report->corners_left_out);
    return hull;
}

/// Slot: the result, then the report.
tl_hull *TL_JS_FULL_EXPORT(js_hull_bake)(const tl_vec3 *points, uint32_t count, uint32_t max_vertices, float tolerance,
                                         float thickness, float flatness, float weld_distance, float merge_distance)
{
    tl_hull_def def = tl_default_hull_def();
    def.max_vertices = max_vertices;
    def.tolerance = tolerance;
    def.thickness = thickness;
    def.flatness = flatness;
    def.weld_distance = weld_distance;
    def.merge_distance = merge_distance;
    def.host = *tl_js_host();
    tl_hull *hull;
    tl_hull_report report;
    tl_result result = tl_hull_bake(points, count, &def, &hull, &report);
    return put_hull(&result, hull, &report);
}

/// Slot: scale, pose; then as js_hull_bake.
tl_hull *TL_JS_FULL_EXPORT(js_hull_transform)(const tl_hull *source)
{
    tl_hull *hull;
    tl_hull_report report;
    tl_result result = tl_hull_transform(source, tl_js_vec3(0), tl_js_pose(3), NULL, &hull, &report);
    return put_hull(&result, hull, &report);
}

tl_result TL_JS_FULL_EXPORT(js_hull_check)(const void *bytes, uint32_t size)
{
    return tl_hull_check(bytes, size, &tl_js_report);
}

/// Slot: size, counts, vertices, bounds, mass.
void TL_JS_FULL_EXPORT(js_hull_info)(const tl_hull *hull)
{
    uint32_t at = tl_js_put(0, (double)hull->blob.size);
    at = tl_js_put(at, hull->vertex_count);
    at = tl_js_put(at, hull->face_count);
    at = tl_js_put(at, hull->half_edge_count);
    at = tl_js_put_pointer(at, tl_hull_vertices(hull));
    at = tl_js_put_aabb(at, hull->bounds);
    at = tl_js_put(tl_js_put(at, hull->mass.volume), hull->mass.area);
    memcpy(&tl_js_slot[at], hull->mass.center, sizeof hull->mass.center);
    memcpy(&tl_js_slot[at + 3], hull->mass.inertia, sizeof hull->mass.inertia);
}

/// The sources, V words; then of each vertex a half-edge; of each half-edge origin, twin, next and face; of each face
/// its first half-edge and how many it has.
void TL_JS_FULL_EXPORT(js_hull_topology)(const tl_hull *hull, uint32_t *words)
{
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        words[v] = tl_hull_source(hull, v);
        words[hull->vertex_count + v] = tl_hull_vertex_edge(hull, v);
    }
    tl_hull_half_edge *half_edges = (tl_hull_half_edge *)(words + 2 * hull->vertex_count);
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        half_edges[h] = tl_hull_edge_at(hull, h);
    }
    tl_hull_face *faces = (tl_hull_face *)(half_edges + hull->half_edge_count);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        faces[f] = tl_hull_face_at(hull, f);
    }
}

uint32_t TL_JS_FULL_EXPORT(js_hull_support)(const tl_hull *hull, float x, float y, float z, uint32_t hint)
{
    return tl_hull_support(hull, tl_vec3_make(x, y, z), hint);
}

/// Slot: origin, direction, max t; then t, face, normal.
int32_t TL_JS_FULL_EXPORT(js_hull_cast_ray)(const tl_hull *hull)
{
    tl_hull_hit hit;
    if (!tl_hull_cast_ray(hull, tl_js_vec3(0), tl_js_vec3(3), tl_js_f32(6), &hit)) {
        return 0;
    }
    tl_js_put_vec3(tl_js_put(tl_js_put(0, (double)hit.t), hit.face), hit.normal);
    return 1;
}

int32_t TL_JS_FULL_EXPORT(js_hull_contains)(const tl_hull *hull, float x, float y, float z)
{
    return tl_hull_contains(hull, tl_vec3_make(x, y, z));
}

// ---------------------------------------------------------------------------------------------------------
// Pairs. Slot: shape A, its pose, shape B, its pose, then a vector and two numbers.

enum { POSE_A = TL_JS_SHAPE_NUMBERS, SHAPE_B = POSE_A + 7, POSE_B = SHAPE_B + TL_JS_SHAPE_NUMBERS, EXTRA = POSE_B + 7 };

void TL_JS_FULL_EXPORT(js_convex_distance)(void)
{
    const tl_convex a = tl_js_shape(0), b = tl_js_shape(SHAPE_B);
    tl_separation s;
    tl_convex_distance(&a, tl_js_pose(POSE_A), &b, tl_js_pose(POSE_B), NULL, &s);
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(0, (double)s.distance), (double)s.lower_bound), s.overlap);
    at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_vec3(at, s.point_a), s.point_b), s.normal);
    tl_js_put(tl_js_put(at, s.status), s.iterations);
}

int32_t TL_JS_FULL_EXPORT(js_convex_overlap)(void)
{
    const tl_convex a = tl_js_shape(0), b = tl_js_shape(SHAPE_B);
    return tl_convex_overlap(&a, tl_js_pose(POSE_A), &b, tl_js_pose(POSE_B), NULL);
}

int32_t TL_JS_FULL_EXPORT(js_convex_penetration)(void)
{
    const tl_convex a = tl_js_shape(0), b = tl_js_shape(SHAPE_B);
    tl_penetration p;
    tl_convex_penetration(&a, tl_js_pose(POSE_A), &b, tl_js_pose(POSE_B), NULL, &p);
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(0, (double)p.depth), (double)p.lower_bound), (double)p.upper_bound);
    at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_vec3(at, p.normal), p.point_a), p.point_b);
    tl_js_put(tl_js_put(at, p.status), p.iterations);
    return p.overlap;
}

static int32_t put_convex_hit(const tl_convex_hit *hit)
{
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(0, hit->initial_overlap), (double)hit->t), (double)hit->gap);
    at = tl_js_put_vec3(tl_js_put_vec3(at, hit->point), hit->normal);
    tl_js_put(tl_js_put(at, hit->status), hit->iterations);
    return hit->hit;
}

int32_t TL_JS_FULL_EXPORT(js_convex_cast)(void)
{
    const tl_convex a = tl_js_shape(0), b = tl_js_shape(SHAPE_B);
    tl_convex_hit hit;
    tl_convex_cast(&a, tl_js_pose(POSE_A), &b, tl_js_pose(POSE_B), tl_js_vec3(EXTRA), &hit);
    return put_convex_hit(&hit);
}

/// Slot: shape A, its pose, origin, direction, max t.
int32_t TL_JS_FULL_EXPORT(js_convex_cast_ray)(void)
{
    const tl_convex a = tl_js_shape(0);
    tl_convex_hit hit;
    tl_convex_cast_ray(&a, tl_js_pose(POSE_A), tl_js_vec3(SHAPE_B), tl_js_vec3(SHAPE_B + 3), tl_js_f32(SHAPE_B + 6),
                       &hit);
    return put_convex_hit(&hit);
}

/// Slot: the number of contacts, normal, status, and seven numbers a contact.
void TL_JS_FULL_EXPORT(js_convex_contacts)(void)
{
    const tl_convex a = tl_js_shape(0), b = tl_js_shape(SHAPE_B);
    const tl_contact_limits limits = { tl_js_f32(EXTRA), tl_js_f32(EXTRA + 1), 0 };
    tl_contact_manifold m;
    tl_convex_contacts(&a, tl_js_pose(POSE_A), &b, tl_js_pose(POSE_B), &limits, NULL, &m);
    uint32_t at = tl_js_put(tl_js_put_vec3(tl_js_put(0, m.count), m.normal), m.status);
    for (uint32_t i = 0; i < m.count; i++) {
        at = tl_js_put_vec3(tl_js_put_vec3(at, m.contacts[i].point_a), m.contacts[i].point_b);
        at = tl_js_put(at, (double)m.contacts[i].separation);
    }
}

void TL_JS_FULL_EXPORT(js_convex_bounds)(void)
{
    const tl_convex a = tl_js_shape(0);
    tl_js_put_aabb(0, tl_convex_bounds(&a, tl_js_pose(POSE_A)));
}
