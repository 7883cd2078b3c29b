// SPDX-License-Identifier: MIT
//
// The shapes of convex queries, as values.

#include <talus/convex.h>

#include "base/assert.h"

#include <string.h>

static tl_convex make(tl_convex_kind kind, float radius)
{
    tl_convex shape;
    memset(&shape, 0, sizeof shape);
    shape.kind = kind;
    shape.radius = radius;
    return shape;
}

tl_convex tl_convex_from_hull(const tl_hull *hull, float radius)
{
    tl_convex shape = make(TL_CONVEX_HULL, radius);
    shape.hull = hull;
    return shape;
}

tl_convex tl_convex_from_points(const tl_vec3 *points, uint32_t count, float radius)
{
    TL_ASSERT(count > 0);
    tl_convex shape = make(TL_CONVEX_POINTS, radius);
    shape.points = points;
    shape.point_count = count;
    return shape;
}

tl_convex tl_convex_box(tl_vec3 center, tl_vec3 half_extents, float radius)
{
    tl_convex shape = make(TL_CONVEX_BOX, radius);
    shape.corners[0] = center;
    shape.corners[1] = half_extents;
    return shape;
}

tl_convex tl_convex_sphere(tl_vec3 center, float radius)
{
    tl_convex shape = make(TL_CONVEX_INLINE, radius);
    shape.corners[0] = center;
    shape.point_count = 1;
    return shape;
}

tl_convex tl_convex_capsule(tl_vec3 a, tl_vec3 b, float radius)
{
    tl_convex shape = make(TL_CONVEX_INLINE, radius);
    shape.corners[0] = a;
    shape.corners[1] = b;
    shape.point_count = 2;
    return shape;
}

tl_convex tl_convex_triangle(tl_vec3 a, tl_vec3 b, tl_vec3 c, float radius)
{
    tl_convex shape = make(TL_CONVEX_INLINE, radius);
    shape.corners[0] = a;
    shape.corners[1] = b;
    shape.corners[2] = c;
    shape.point_count = 3;
    return shape;
}

static tl_convex make_round(tl_convex_kind kind, tl_vec3 a, tl_vec3 b, float disc_radius, float radius)
{
    tl_convex shape = make(kind, radius);
    shape.corners[0] = a;
    shape.corners[1] = b;
    shape.corners[2] = tl_vec3_make(disc_radius, 0.0f, 0.0f);
    return shape;
}

tl_convex tl_convex_cylinder(tl_vec3 a, tl_vec3 b, float disc_radius, float radius)
{
    return make_round(TL_CONVEX_CYLINDER, a, b, disc_radius, radius);
}

tl_convex tl_convex_cone(tl_vec3 base, tl_vec3 apex, float disc_radius, float radius)
{
    return make_round(TL_CONVEX_CONE, base, apex, disc_radius, radius);
}

tl_convex tl_convex_custom(tl_convex_support_fn *support, void *user, float radius)
{
    tl_convex shape = make(TL_CONVEX_CUSTOM, radius);
    shape.support = support;
    shape.user = user;
    return shape;
}
