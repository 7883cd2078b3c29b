// SPDX-License-Identifier: MIT
//
// What capsules, cylinders and cones rest on: the segment, a line along the side, or a flat disc.
//
// A disc is a polygon with corners at fixed places of its rim: such corners are the same from call to call, while those
// of a polygon that is turned towards the lowest point of the rim would wander around it with every tremor of a body at
// rest. The lowest point itself joins the contacts as the deepest one.

#include "convex/contact/face_patch.h"

enum { DISC_CORNERS = TL_FACE_CORNERS };

// cos and sin of k / 16 of a turn.
static const double disc_turn[DISC_CORNERS][2] = {
    { 1, 0 },
    { 0.9238795325112867, 0.3826834323650898 },
    { 0.7071067811865476, 0.7071067811865476 },
    { 0.3826834323650898, 0.9238795325112867 },
    { 0, 1 },
    { -0.3826834323650898, 0.9238795325112867 },
    { -0.7071067811865476, 0.7071067811865476 },
    { -0.9238795325112867, 0.3826834323650898 },
    { -1, 0 },
    { -0.9238795325112867, -0.3826834323650898 },
    { -0.7071067811865476, -0.7071067811865476 },
    { -0.3826834323650898, -0.9238795325112867 },
    { 0, -1 },
    { 0.3826834323650898, -0.9238795325112867 },
    { 0.7071067811865476, -0.7071067811865476 },
    { 0.9238795325112867, -0.3826834323650898 },
};

// Features: corners of the first disc, of the second, then the line along the side.
static bool set_line(tl_vec3d p, tl_vec3d q, tl_vec3d d, tl_face *face)
{
    tl_vec3d along = tl_vec3d_sub(q, p);
    double length = tl_vec3d_length(along);
    along = tl_vec3d_scale(along, length > 0.0 ? 1.0 / length : 0.0);
    tl_vec3d across = tl_vec3d_mul_add(d, along, -tl_vec3d_dot(d, along));
    double size = tl_vec3d_length(across);
    if (!(length > 0.0 && size > 0.5)) { // steeper than 60 degrees, as with faces
        return false;
    }
    face->corners[0] = p;
    face->corners[1] = q;
    face->vertices[0] = TL_FEATURE_VERTEX | (2 * DISC_CORNERS);
    face->vertices[1] = TL_FEATURE_VERTEX | (2 * DISC_CORNERS + 1);
    face->edges[0] = face->edges[1] = face->feature = TL_FEATURE_EDGE | (2 * DISC_CORNERS);
    face->count = 2;
    face->normal = tl_vec3d_scale(across, 1.0 / size);
    return true;
}

// Counter-clockwise seen along the unit normal.
static void set_disc(tl_vec3d middle, tl_vec3d normal, double disc_radius, uint32_t disc, tl_face *face)
{
    tl_vec3d u = tl_vec3d_perpendicular(normal), v = tl_vec3d_cross(normal, u);
    for (uint32_t i = 0; i < DISC_CORNERS; i++) {
        face->corners[i] = tl_vec3d_mul_add(tl_vec3d_mul_add(middle, u, disc_radius * disc_turn[i][0]), v,
                                            disc_radius * disc_turn[i][1]);
        face->vertices[i] = TL_FEATURE_VERTEX | (disc * DISC_CORNERS + i);
        face->edges[i] = TL_FEATURE_EDGE | (disc * DISC_CORNERS + i);
    }
    face->feature = TL_FEATURE_FACE | disc;
    face->count = DISC_CORNERS;
    face->normal = normal;
}

bool tl_face_round(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    tl_vec3d a = tl_vec3d_from(shape->corners[0]), b = tl_vec3d_from(shape->corners[1]);
    if (shape->kind == TL_CONVEX_INLINE) {
        return shape->point_count == 2 && set_line(a, b, d, face);
    }
    if (shape->kind != TL_CONVEX_CYLINDER && shape->kind != TL_CONVEX_CONE) {
        return false;
    }
    double disc_radius = (double)shape->corners[2].x;
    tl_vec3d axis = tl_vec3d_sub(b, a);
    axis = tl_vec3d_scale(axis, 1.0 / tl_vec3d_length(axis));
    double rise = tl_vec3d_dot(axis, d);
    bool capped = disc_radius > 0.0 && (rise < 0.0 || shape->kind == TL_CONVEX_CYLINDER);
    if (capped && fabs(rise) >= 0.7071067811865476) {
        set_disc(rise < 0.0 ? a : b, rise < 0.0 ? tl_vec3d_neg(axis) : axis, disc_radius, rise < 0.0 ? 0 : 1, face);
        return true;
    }
    tl_vec3d across = tl_vec3d_cross(axis, tl_vec3d_cross(d, axis));
    double length = tl_vec3d_length(across);
    if (!(length > 0.0)) {
        return false;
    }
    tl_vec3d out = tl_vec3d_scale(across, disc_radius / length);
    return set_line(tl_vec3d_add(a, out), shape->kind == TL_CONVEX_CYLINDER ? tl_vec3d_add(b, out) : b, d, face);
}
