// SPDX-License-Identifier: MIT
//
// Proof by exact predicates that a hull is convex and contains its points.
//
// Every vertex is tested against every face: local convexity at the edges alone would also accept a surface that winds
// around twice.

#include "hull/bake/quickhull.h"

#include "base/assert.h"
#include "base/host.h"
#include "hull/support/hull_support.h"

#include <talus/hull.h>

#include <string.h>

// A face's plane, by three of its corners; positions near the origin, as side planes like them.
typedef struct face_plane {
    tl_vec3 a, b, c, origin;
    tl_side_plane plane;
} face_plane;

static face_plane plane_of(const tl_hull *hull, uint32_t face, tl_aabb box)
{
    const uint32_t first = tl_hull_face_first(hull, face);
    face_plane p;
    p.origin = tl_vec3_make(tl_side_origin(box.min.x, box.max.x), tl_side_origin(box.min.y, box.max.y),
                            tl_side_origin(box.min.z, box.max.z));
    p.a = tl_sub(tl_hull_corner(hull, first), p.origin);
    p.b = tl_sub(tl_hull_corner(hull, first + 1), p.origin);
    p.c = tl_sub(tl_hull_corner(hull, first + 2), p.origin);
    tl_vec3 size = tl_max(tl_abs(tl_sub(box.min, p.origin)), tl_abs(tl_sub(box.max, p.origin)));
    double reach[3] = { (double)size.x, (double)size.y, (double)size.z };
    p.plane = tl_side_plane_make(p.a, p.b, p.c, reach);
    return p;
}

static int side_of_face(const face_plane *p, tl_vec3 point, double *height_out)
{
    tl_vec3 local = tl_sub(point, p->origin);
    *height_out = tl_side_plane_height(&p->plane, local);
    int sign = tl_side_plane_sign(&p->plane, *height_out);
    return sign != 0 ? sign : tl_orient3d(p->a, p->b, p->c, local);
}

static bool face_has(const tl_hull *hull, uint32_t face, uint32_t vertex)
{
    tl_hull_face f = tl_hull_face_at(hull, face);
    for (uint32_t k = 0; k < f.count; k++) {
        if (tl_hull_edge_origin(hull, f.first + k) == vertex) {
            return true;
        }
    }
    return false;
}

static void validate_face(const tl_hull *hull, uint32_t face, const face_plane *plane, tl_hull_validation *out)
{
    uint32_t in_plane = 0;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        double value;
        int side = side_of_face(plane, tl_hull_vertices(hull)[v], &value);
        // In the plane are the face's own corners and no others.
        if (side > 0 || (side == 0 && !face_has(hull, face, v))) {
            out->convex = false;
        }
        in_plane += side == 0;
    }
    if (in_plane != tl_hull_face_at(hull, face).count) {
        out->flat_faces = false;
    }
    // No three corners of a face are on a line, and the loop turns left everywhere, seen along the normal.
    tl_hull_face f = tl_hull_face_at(hull, face);
    // The exact normal: in double a thin face may seem to have none.
    tl_vec3 p = plane->a, q = plane->b, r = plane->c;
    double n[3] = { tl_area2d(p.y, p.z, q.y, q.z, r.y, r.z), tl_area2d(p.z, p.x, q.z, q.x, r.z, r.x),
                    tl_area2d(p.x, p.y, q.x, q.y, r.x, r.y) };
    for (uint32_t k = 0; k < f.count; k++) {
        tl_vec3 a = tl_hull_corner(hull, f.first + k);
        tl_vec3 b = tl_hull_corner(hull, f.first + (k + 1) % f.count);
        tl_vec3 c = tl_hull_corner(hull, f.first + (k + 2) % f.count);
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

// The lowest point outside so far.
static uint64_t validate_points(const face_plane *plane, const tl_vec3 *points, uint32_t count, uint64_t lowest,
                                tl_hull_validation *out)
{
    for (uint32_t i = 0; i < count; i++) {
        double value;
        if (side_of_face(plane, points[i], &value) > 0) {
            double height = value / tl_side_plane_length(&plane->plane);
            out->contains = false;
            lowest = i < lowest ? i : lowest;
            out->max_outside = height > out->max_outside ? height : out->max_outside;
        }
    }
    return lowest;
}

static tl_result validate(const tl_hull *hull, const tl_vec3 *points, uint32_t count, tl_hull_validation *found)
{
    if (hull == NULL || (points == NULL && count > 0)) {
        return tl_report_field(&found->base, TL_ERR_ARGUMENT, hull == NULL ? "hull" : "points", "do not give NULL");
    }
    found->euler = (uint64_t)hull->vertex_count + hull->face_count == (uint64_t)hull->half_edge_count / 2 + 2;
    found->flat_faces = found->convex = found->contains = true;
    tl_aabb box = hull->bounds;
    for (uint32_t i = 0; i < count; i++) {
        box = tl_aabb_add_point(box, points[i]);
    }
    uint64_t bad_face = TL_NO_ELEMENT, bad_point = TL_NO_ELEMENT;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        face_plane plane = plane_of(hull, f, box);
        validate_face(hull, f, &plane, found);
        if (bad_face == TL_NO_ELEMENT && !(found->flat_faces && found->convex)) {
            bad_face = f;
        }
        bad_point = validate_points(&plane, points, count, bad_point, found);
    }
    if (!found->euler) {
        return tl_report_field(&found->base, TL_ERR_CORRUPT, "face_count", "bake the hull again");
    }
    if (bad_face != TL_NO_ELEMENT) {
        return tl_report_fail(&found->base, TL_ERR_CORRUPT, "face", bad_face, "bake the hull again");
    }
    if (bad_point != TL_NO_ELEMENT) {
        return tl_report_fail(&found->base, TL_ERR_RANGE, "point", bad_point, "bake a hull of all points");
    }
    return TL_OK;
}

// A hull with merged faces is judged by the exact hull of its vertices; the check has compared the two.
static tl_result validate_merged(const tl_hull *hull, const tl_vec3 *points, uint32_t count, tl_hull_validation *found)
{
    TL_TRY(tl_hull_check(hull, hull->blob.size, &found->base));
    tl_hull *exact;
    TL_TRY(tl_hull_bake_merged(hull, 0.0f, NULL, &exact));
    const tl_result result = validate(exact, points, count, found);
    tl_blob_free(exact);
    return result;
}

tl_result tl_hull_validate(const tl_hull *hull, const tl_vec3 *points, uint32_t count,
                           tl_hull_validation *validation_out)
{
    tl_hull_validation found;
    memset(&found, 0, sizeof found);
    tl_report_begin(&found.base, "validate hull");
    const bool is_merged = hull != NULL && hull->merge_distance > 0.0f && (points != NULL || count == 0);
    tl_result result = is_merged ? validate_merged(hull, points, count, &found) : validate(hull, points, count, &found);
    if (validation_out != NULL) {
        *validation_out = found;
    }
    return result;
}
