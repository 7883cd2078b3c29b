// SPDX-License-Identifier: MIT
//
// Shapes as support functions, and pairs of them in the frame of the first.
//
// Only differences of the two poses enter, taken in double: two shapes far from the origin see each other as well as
// two near it.

#include "convex/proxy.h"

#include "base/assert.h"
#include "math/tolerance.h"

#include <string.h>

// A direction is rounded to float once in each shape's frame: a component is off by half an ulp, so the direction by at
// most sqrt(3) of that.
#define DIRECTION_ROUNDING (1.7320508075688774 * (double)TL_FLOAT_ROUNDING)

// A hull this small is scanned in double at once: faster than a call that rounds the direction, scans in float and
// proves the answer. Measured: equal at 16 vertices.
#define SCANNED_HERE 12u

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

// Vertex k of a box: bit i of k says which side on axis i.
static tl_vec3d box_vertex(const tl_convex *shape, uint32_t k)
{
    tl_vec3d c = tl_vec3d_from(shape->corners[0]), h = tl_vec3d_from(shape->corners[1]);
    return tl_vec3d_make(k & 1u ? c.x + h.x : c.x - h.x, k & 2u ? c.y + h.y : c.y - h.y,
                         k & 4u ? c.z + h.z : c.z - h.z);
}

static bool vertex_of(const tl_convex *shape, uint32_t vertex, tl_vec3d *point_out)
{
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        if (vertex < shape->hull->vertex_count) {
            *point_out = tl_vec3d_from(tl_hull_vertices(shape->hull)[vertex]);
            return true;
        }
        return false;
    case TL_CONVEX_POINTS:
        if (vertex < shape->point_count) {
            *point_out = tl_vec3d_from(shape->points[vertex]);
            return true;
        }
        return false;
    case TL_CONVEX_INLINE:
        if (vertex < shape->point_count) {
            *point_out = tl_vec3d_from(shape->corners[vertex]);
            return true;
        }
        return false;
    case TL_CONVEX_BOX:
        *point_out = box_vertex(shape, vertex);
        return vertex < 8;
    default:
        return false;
    }
}

static uint32_t farthest_of(const tl_vec3 *points, uint32_t count, tl_vec3d direction)
{
    uint32_t best = 0;
    double best_dot = tl_vec3d_dot(direction, tl_vec3d_from(points[0]));
    for (uint32_t i = 1; i < count; i++) {
        double dot = tl_vec3d_dot(direction, tl_vec3d_from(points[i]));
        if (dot > best_dot) {
            best_dot = dot;
            best = i;
        }
    }
    return best;
}

// The largest component becomes 1 or -1, so that no float under- or overflows.
static tl_vec3 float_direction(tl_vec3d d)
{
    double size = fabs(d.x) > fabs(d.y) ? fabs(d.x) : fabs(d.y);
    size = fabs(d.z) > size ? fabs(d.z) : size;
    return tl_vec3d_to_float(tl_vec3d_scale(d, 1.0 / size));
}

// Cylinder and cone: the farthest point of a disc's rim lies where the direction's part across the axis points. That
// part is a cross product, which is across the axis even where it is mere rounding; a difference would not be.
static tl_vec3d round_support(const tl_convex *shape, tl_vec3d direction)
{
    tl_vec3d a = tl_vec3d_from(shape->corners[0]), b = tl_vec3d_from(shape->corners[1]);
    tl_vec3d axis = tl_vec3d_sub(b, a);
    double height = tl_vec3d_length(axis), disc_radius = (double)shape->corners[2].x;
    axis = tl_vec3d_scale(axis, 1.0 / height);
    double along = tl_vec3d_dot(direction, axis);
    tl_vec3d across = tl_vec3d_cross(axis, tl_vec3d_cross(direction, axis));
    double length = tl_vec3d_length(across);
    double reach = length > 0.0 ? disc_radius / length : 0.0;
    if (shape->kind == TL_CONVEX_CYLINDER) {
        return tl_vec3d_mul_add(along > 0.0 ? b : a, across, reach);
    }
    return along * height > length * disc_radius ? b : tl_vec3d_mul_add(a, across, reach);
}

static tl_vec3d support_of(const tl_convex *shape, tl_vec3d direction, uint32_t *vertex)
{
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        if (shape->hull->vertex_count <= SCANNED_HERE) {
            *vertex = farthest_of(tl_hull_vertices(shape->hull), shape->hull->vertex_count, direction);
            return tl_vec3d_from(tl_hull_vertices(shape->hull)[*vertex]);
        }
        *vertex = tl_hull_support(shape->hull, float_direction(direction), *vertex);
        return tl_vec3d_from(tl_hull_vertices(shape->hull)[*vertex]);
    case TL_CONVEX_POINTS:
        *vertex = farthest_of(shape->points, shape->point_count, direction);
        return tl_vec3d_from(shape->points[*vertex]);
    case TL_CONVEX_INLINE:
        *vertex = farthest_of(shape->corners, shape->point_count, direction);
        return tl_vec3d_from(shape->corners[*vertex]);
    case TL_CONVEX_BOX:
        *vertex = (direction.x > 0.0 ? 1u : 0u) | (direction.y > 0.0 ? 2u : 0u) | (direction.z > 0.0 ? 4u : 0u);
        return box_vertex(shape, *vertex);
    case TL_CONVEX_CYLINDER:
    case TL_CONVEX_CONE:
        *vertex = TL_NO_VERTEX;
        return round_support(shape, direction);
    default:
        *vertex = TL_NO_VERTEX;
        return tl_vec3d_from(shape->support(float_direction(direction), shape->user));
    }
}

static double size_of(const tl_convex *shape)
{
    if (shape->kind == TL_CONVEX_HULL && shape->hull->vertex_count > SCANNED_HERE) {
        tl_aabb box = shape->hull->bounds;
        return tl_vec3d_length(tl_vec3d_sub(tl_vec3d_from(box.max), tl_vec3d_from(box.min)));
    }
    if (shape->kind == TL_CONVEX_CUSTOM) {
        tl_vec3d size = tl_vec3d_make(0.0, 0.0, 0.0);
        for (int axis = 0; axis < 3; axis++) {
            tl_vec3 d = tl_vec3_make(axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f);
            tl_vec3 high = shape->support(d, shape->user), low = shape->support(tl_neg(d), shape->user);
            double extent = axis == 0   ? (double)high.x - (double)low.x
                            : axis == 1 ? (double)high.y - (double)low.y
                                        : (double)high.z - (double)low.z;
            size = tl_vec3d_add(
                size, tl_vec3d_make(axis == 0 ? extent : 0.0, axis == 1 ? extent : 0.0, axis == 2 ? extent : 0.0));
        }
        return tl_vec3d_length(size);
    }
    return 0.0; // asked in double
}

static tl_vec3d middle_of(const tl_convex *shape)
{
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        return tl_vec3d_scale(
            tl_vec3d_add(tl_vec3d_from(shape->hull->bounds.min), tl_vec3d_from(shape->hull->bounds.max)), 0.5);
    case TL_CONVEX_POINTS:
        return tl_vec3d_from(shape->points[0]);
    case TL_CONVEX_CUSTOM:
        return tl_vec3d_from(shape->support(tl_vec3_make(1.0f, 0.0f, 0.0f), shape->user));
    default:
        return tl_vec3d_from(shape->corners[0]);
    }
}

tl_pair tl_pair_make(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b)
{
    tl_pair pair;
    tl_frame to_world_b = tl_frame_from(pose_b);
    pair.a = a;
    pair.b = b;
    pair.a_to_world = tl_frame_from(pose_a);
    // Rows of transpose(A) * B are the columns of A times B.
    const tl_frame *fa = &pair.a_to_world;
    tl_vec3d columns[3] = { { fa->rows[0].x, fa->rows[1].x, fa->rows[2].x },
                            { fa->rows[0].y, fa->rows[1].y, fa->rows[2].y },
                            { fa->rows[0].z, fa->rows[1].z, fa->rows[2].z } };
    for (int i = 0; i < 3; i++) {
        pair.b_to_a.rows[i] = tl_frame_rotate_back(&to_world_b, columns[i]);
    }
    pair.b_to_a.origin = tl_frame_rotate_back(fa, tl_vec3d_sub(to_world_b.origin, fa->origin));
    pair.direction_error = DIRECTION_ROUNDING * (size_of(a) + size_of(b));
    pair.last_a = pair.last_b = TL_NO_VERTEX;
    return pair;
}

tl_vec3d tl_pair_offset(const tl_pair *pair)
{
    return tl_vec3d_sub(middle_of(pair->a), tl_frame_point(&pair->b_to_a, middle_of(pair->b)));
}

tl_pair_point tl_pair_support(tl_pair *pair, tl_vec3d direction)
{
    tl_pair_point point;
    point.a = support_of(pair->a, direction, &pair->last_a);
    tl_vec3d direction_b = tl_frame_rotate_back(&pair->b_to_a, tl_vec3d_neg(direction));
    point.b = tl_frame_point(&pair->b_to_a, support_of(pair->b, direction_b, &pair->last_b));
    point.w = tl_vec3d_sub(point.a, point.b);
    point.vertex_a = pair->last_a;
    point.vertex_b = pair->last_b;
    return point;
}

bool tl_pair_vertex(const tl_pair *pair, uint32_t vertex_a, uint32_t vertex_b, tl_pair_point *point_out)
{
    if (!vertex_of(pair->a, vertex_a, &point_out->a) || !vertex_of(pair->b, vertex_b, &point_out->b)) {
        return false;
    }
    point_out->b = tl_frame_point(&pair->b_to_a, point_out->b);
    point_out->w = tl_vec3d_sub(point_out->a, point_out->b);
    point_out->vertex_a = vertex_a;
    point_out->vertex_b = vertex_b;
    return true;
}
