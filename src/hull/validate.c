// SPDX-License-Identifier: MIT
//
// Proof by exact predicates that a hull is convex and contains its points.
//
// Every vertex is asked of every face: local convexity at the edges alone would also accept a surface that winds around
// twice.

#include "hull/side_plane.h"

#include "base/assert.h"

#include <talus/hull.h>

#include <string.h>

static tl_side_plane plane_of(const tl_hull *hull, uint32_t face, const double extent[3])
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    const tl_hull_half_edge *h = &tl_hull_half_edges(hull)[tl_hull_faces(hull)[face].first];
    return tl_side_plane_make(vertices[h[0].origin], vertices[h[1].origin], vertices[h[2].origin], extent);
}

static bool face_has(const tl_hull *hull, uint32_t face, uint32_t vertex)
{
    tl_hull_face f = tl_hull_faces(hull)[face];
    for (uint32_t k = 0; k < f.count; k++) {
        if (tl_hull_half_edges(hull)[f.first + k].origin == vertex) {
            return true;
        }
    }
    return false;
}

static void validate_face(const tl_hull *hull, uint32_t face, const tl_side_plane *plane, tl_hull_validation *out)
{
    uint32_t in_plane = 0;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        double value;
        int side = tl_side_plane_test(plane, tl_hull_vertices(hull)[v], &value);
        // In the plane are the face's own corners and no others.
        if (side > 0 || (side == 0 && !face_has(hull, face, v))) {
            out->convex = false;
        }
        in_plane += side == 0;
    }
    if (in_plane != tl_hull_faces(hull)[face].count) {
        out->flat_faces = false;
    }
    // No three corners of a face are on a line, and the loop turns left everywhere, seen along the normal.
    tl_hull_face f = tl_hull_faces(hull)[face];
    const tl_hull_half_edge *h = &tl_hull_half_edges(hull)[f.first];
    // The exact normal: in double a thin face may seem to have none.
    tl_vec3 p = plane->a, q = plane->b, r = plane->c;
    double n[3] = { tl_area2d(p.y, p.z, q.y, q.z, r.y, r.z), tl_area2d(p.z, p.x, q.z, q.x, r.z, r.x),
                    tl_area2d(p.x, p.y, q.x, q.y, r.x, r.y) };
    for (uint32_t k = 0; k < f.count; k++) {
        tl_vec3 a = tl_hull_vertices(hull)[h[k].origin];
        tl_vec3 b = tl_hull_vertices(hull)[h[(k + 1) % f.count].origin];
        tl_vec3 c = tl_hull_vertices(hull)[h[(k + 2) % f.count].origin];
        // Seen along the coordinate axis that the normal leans to most.
        int turn = fabs(n[0]) >= fabs(n[1]) && fabs(n[0]) >= fabs(n[2])
                       ? tl_orient2d(a.y, a.z, b.y, b.z, c.y, c.z) * (n[0] > 0.0 ? 1 : -1)
                   : fabs(n[1]) >= fabs(n[2]) ? tl_orient2d(a.z, a.x, b.z, b.x, c.z, c.x) * (n[1] > 0.0 ? 1 : -1)
                                              : tl_orient2d(a.x, a.y, b.x, b.y, c.x, c.y) * (n[2] > 0.0 ? 1 : -1);
        if (turn <= 0) {
            out->convex = false;
        }
    }
}

static void validate_points(const tl_side_plane *plane, const tl_vec3 *points, uint32_t count, tl_hull_validation *out)
{
    for (uint32_t i = 0; i < count; i++) {
        double value;
        if (tl_side_plane_test(plane, points[i], &value) > 0) {
            double height = value / tl_side_plane_length(plane);
            out->contains = false;
            out->max_outside = height > out->max_outside ? height : out->max_outside;
        }
    }
}

tl_result tl_hull_validate(const tl_hull *hull, const tl_vec3 *points, uint32_t count,
                           tl_hull_validation *validation_out)
{
    tl_hull_validation found;
    memset(&found, 0, sizeof found);
    found.euler = (uint64_t)hull->vertex_count + hull->face_count == (uint64_t)hull->half_edge_count / 2 + 2;
    found.flat_faces = found.convex = found.contains = true;
    tl_aabb box = hull->bounds;
    for (uint32_t i = 0; i < count; i++) {
        box = tl_aabb_add_point(box, points[i]);
    }
    double extent[3] = { (double)box.max.x - (double)box.min.x, (double)box.max.y - (double)box.min.y,
                         (double)box.max.z - (double)box.min.z };
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_side_plane plane = plane_of(hull, f, extent);
        validate_face(hull, f, &plane, &found);
        validate_points(&plane, points, count, &found);
    }
    if (validation_out != NULL) {
        *validation_out = found;
    }
    if (!found.euler || !found.flat_faces || !found.convex) {
        return TL_ERR_CORRUPT;
    }
    return found.contains ? TL_OK : TL_ERR_RANGE;
}
