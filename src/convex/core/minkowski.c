// SPDX-License-Identifier: MIT
//
// The Minkowski difference A - B of two shapes by their support functions, in A's frame: its support point along d is
// A's along d less B's along -d.
//
// Only differences of the two poses enter, taken in double: two shapes far from the origin see each other as well as
// two near it.

#include "convex/core/minkowski.h"

#include "base/compiler.h"
#include "convex/core/farthest.h"
#include "convex/core/pair_frames.h"
#include "math/tolerance.h"

#include <assert.h>
#include <string.h>

// A direction is rounded to float once in each shape's frame: a component is off by half an ulp, so the direction by at
// most sqrt(3) of that.
#define DIRECTION_ROUNDING (1.7320508075688774 * (double)TL_FLOAT_ROUNDING)

// A hull this small is scanned in double at once: faster than a call that rounds the direction, scans in float and
// proves the answer. Measured: equal at 16 vertices.
#define SCANNED_HERE 12u

// With a hint so many are still scanned: eight products take less than a look at what is around the hint.
#define SCANNED_WITH_HINT 8u

// A scan of so many vertices for the largest product alone takes less than a support query, which has to find the
// lowest of all vertices that have it: along a face's normal these are the corners of the face, compared exactly.
#define SMALL_HULL 64u

// Vertex k of a box: bit i of k says which side on axis i.
static tl_vec3d box_vertex(const tl_convex *shape, uint32_t k)
{
    tl_vec3d c = tl_vec3d_from(shape->corners[0]), h = tl_vec3d_from(shape->corners[1]);
    return tl_vec3d_make(k & 1u ? c.x + h.x : c.x - h.x, k & 2u ? c.y + h.y : c.y - h.y,
                         k & 4u ? c.z + h.z : c.z - h.z);
}

static bool shape_vertex(const tl_convex *shape, uint32_t vertex, tl_vec3d *point_out)
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

// In the range where a hull takes a direction as it is; the largest component of any other becomes 1 or -1, so that no
// float under- or overflows.
static tl_vec3 float_direction(const tl_vec3d *d)
{
    double size = fabs(d->x) > fabs(d->y) ? fabs(d->x) : fabs(d->y);
    size = fabs(d->z) > size ? fabs(d->z) : size;
    return tl_vec3d_to_float(size > 0x1p-10 && size < 0x1p10 ? *d : tl_vec3d_scale(*d, 1.0 / size));
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

static tl_vec3d curved_support(const tl_convex *shape, tl_vec3d direction)
{
    return shape->kind == TL_CONVEX_CUSTOM ? tl_vec3d_from(shape->support(float_direction(&direction), shape->user))
                                           : round_support(shape, direction);
}

// Sets the vertex, which comes as a hint, and the point. What has vertices is done here: it is short and called often.
static void find_support(const tl_minkowski *pair, const tl_convex *shape, const tl_vec3d *direction, uint32_t *vertex,
                         tl_vec3d *point)
{
    const tl_vec3 *points;
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        points = tl_hull_vertices(shape->hull);
        *vertex = shape->hull->vertex_count <= pair->scan_limit
                      ? tl_farthest(points, shape->hull->vertex_count, direction)
                      : tl_hull_support(shape->hull, float_direction(direction), *vertex);
        break;
    case TL_CONVEX_POINTS:
        points = shape->points;
        *vertex = tl_farthest(points, shape->point_count, direction);
        break;
    case TL_CONVEX_INLINE:
        points = shape->corners;
        *vertex = tl_farthest(points, shape->point_count, direction);
        break;
    default:
        *vertex = TL_NO_VERTEX;
        *point = curved_support(shape, *direction);
        return;
    }
    *point = tl_vec3d_from(points[*vertex]);
}

// The same; boxes and small hulls, which are asked most often, without a call.
static TL_ALWAYS_INLINE void support_of(const tl_minkowski *pair, const tl_convex *shape, const tl_vec3d *direction,
                                        uint32_t *vertex, tl_vec3d *point)
{
    if (shape->kind == TL_CONVEX_HULL && shape->hull->vertex_count == 8 && pair->scan_limit >= 8) {
        const tl_vec3 *points = tl_hull_vertices(shape->hull);
        *vertex = tl_farthest(points, 8, direction);
        *point = tl_vec3d_from(points[*vertex]);
        return;
    }
    if (shape->kind == TL_CONVEX_BOX) {
        tl_vec3d c = tl_vec3d_from(shape->corners[0]), h = tl_vec3d_from(shape->corners[1]);
        bool x = direction->x > 0.0, y = direction->y > 0.0, z = direction->z > 0.0;
        *vertex = (x ? 1u : 0u) | (y ? 2u : 0u) | (z ? 4u : 0u);
        *point = tl_vec3d_make(x ? c.x + h.x : c.x - h.x, y ? c.y + h.y : c.y - h.y, z ? c.z + h.z : c.z - h.z);
        return;
    }
    find_support(pair, shape, direction, vertex, point);
}

static double hull_extent(const tl_hull *hull)
{
    return tl_vec3d_size(tl_vec3d_sub(tl_vec3d_from(hull->bounds.max), tl_vec3d_from(hull->bounds.min)));
}

static double custom_size(const tl_convex *shape)
{
    tl_vec3d size;
    double *extent[3] = { &size.x, &size.y, &size.z };
    for (int axis = 0; axis < 3; axis++) {
        tl_vec3 d = tl_vec3_make(axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f);
        tl_vec3 high = shape->support(d, shape->user), low = shape->support(tl_neg(d), shape->user);
        *extent[axis] = tl_vec3d_dot(tl_vec3d_from(d), tl_vec3d_sub(tl_vec3d_from(high), tl_vec3d_from(low)));
    }
    return tl_vec3d_size(size);
}

// The size of a shape whose support takes float directions; 0 of one that takes double.
static TL_ALWAYS_INLINE double rounded_size(const tl_minkowski *pair, const tl_convex *shape)
{
    if (shape->kind == TL_CONVEX_HULL) {
        return shape->hull->vertex_count > pair->scan_limit ? hull_extent(shape->hull) : 0.0;
    }
    return shape->kind == TL_CONVEX_CUSTOM ? custom_size(shape) : 0.0;
}

static tl_vec3d shape_middle(const tl_convex *shape)
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

static TL_ALWAYS_INLINE void set_hints(tl_minkowski *pair, uint32_t vertex_a, uint32_t vertex_b)
{
    pair->last_a = vertex_a;
    pair->last_b = vertex_b;
    pair->scan_limit = vertex_a == TL_NO_VERTEX ? SCANNED_HERE : SCANNED_WITH_HINT;
    pair->direction_error = DIRECTION_ROUNDING * (rounded_size(pair, pair->a) + rounded_size(pair, pair->b));
}

void tl_minkowski_set_hints(tl_minkowski *pair, uint32_t vertex_a, uint32_t vertex_b)
{
    set_hints(pair, vertex_a, vertex_b);
}

// What shapes hold themselves, by the exponents: they have all bits set in what is not finite.
static bool corners_are_finite(const tl_convex *a, const tl_convex *b)
{
    static_assert(sizeof a->corners == 9 * sizeof(uint32_t), "three points");
    uint32_t full = 0;
    for (size_t i = 0; i < 9; i++) {
        uint32_t of_a, of_b;
        memcpy(&of_a, (const char *)a->corners + 4 * i, sizeof of_a);
        memcpy(&of_b, (const char *)b->corners + 4 * i, sizeof of_b);
        full |= ((of_a & 0x7fffffffu) + 0x00800000u) | ((of_b & 0x7fffffffu) + 0x00800000u);
    }
    return (full & 0x80000000u) == 0;
}

// What is not finite survives a sum, so one test will do for both poses and radii. Every component of both rotations is
// in each one of the rotation between them, but a w of NaN, which tl_quatd_from takes for zero; floats cannot overflow
// in doubles on the way there.
static bool is_finite_pair(const tl_minkowski *pair, const tl_transform *pose_a, const tl_transform *pose_b)
{
    const tl_vec3d origin = pair->a_to_world.origin;
    const double rotations = pair->b_to_a.rows[0].x + ((double)pose_a->rotation.w + (double)pose_b->rotation.w),
                 positions = pair->origin_size + (origin.x + origin.y + origin.z),
                 radii = (double)pair->a->radius + (double)pair->b->radius;
    return isfinite(rotations + positions + radii) && corners_are_finite(pair->a, pair->b);
}

// What support queries read first comes while the poses are computed.
static TL_ALWAYS_INLINE void prefetch_shape(const tl_convex *shape)
{
    if (shape->kind == TL_CONVEX_HULL) {
        tl_prefetch(tl_hull_vertices(shape->hull));
    }
}

bool tl_minkowski_init(tl_minkowski *pair, const tl_convex *a, const tl_transform *pose_a, const tl_convex *b,
                       const tl_transform *pose_b)
{
    prefetch_shape(a);
    prefetch_shape(b);
    const tl_quatd rotation_a = tl_quatd_from(pose_a->rotation), rotation_b = tl_quatd_from(pose_b->rotation);
    const tl_vec3d position_a = tl_vec3d_from(pose_a->position), position_b = tl_vec3d_from(pose_b->position);
    pair->a = a;
    pair->b = b;
    tl_pair_frames_set(&pair->a_to_world, &pair->b_to_a, rotation_a, tl_quatd_between(rotation_a, rotation_b),
                       position_a, tl_vec3d_sub(position_b, position_a));
    pair->origin_size = tl_vec3d_size(pair->b_to_a.origin);
    pair->scale = 0.0;
    pair->depth_steps = UINT32_MAX;
    pair->is_placed = false;
    if (!is_finite_pair(pair, pose_a, pose_b)) {
        return false;
    }
    set_hints(pair, TL_NO_VERTEX, TL_NO_VERTEX);
    return true;
}

static bool has_few_vertices(const tl_convex *shape)
{
    return shape->kind == TL_CONVEX_HULL && shape->hull->vertex_count <= 8;
}

void tl_minkowski_place_hulls(tl_minkowski *pair)
{
    if (!pair->is_placed && has_few_vertices(pair->a) && has_few_vertices(pair->b)) {
        const tl_hull *a = pair->a->hull, *b = pair->b->hull;
        const tl_vertex_row row_a = { tl_hull_vertices(a), a->vertex_count },
                            row_b = { tl_hull_vertices(b), b->vertex_count };
        const double scale = tl_hull_size(a) + tl_hull_size(b) + pair->origin_size;
        tl_placed_pair_set(&pair->placed, row_a, row_b, &pair->b_to_a);
        pair->is_placed = true;
        pair->scale = scale > pair->scale ? scale : pair->scale;
    }
}

tl_vec3d tl_minkowski_offset(const tl_minkowski *pair)
{
    tl_vec3d offset = tl_vec3d_sub(shape_middle(pair->a), tl_frame_point(&pair->b_to_a, shape_middle(pair->b)));
    return tl_vec3d_dot(offset, offset) > 0.0 ? offset : tl_vec3d_make(1.0, 0.0, 0.0);
}

// Sets w from the point of B in B's frame.
static TL_ALWAYS_INLINE void finish_point(tl_minkowski *pair, tl_vec3d on_b, tl_minkowski_point *point)
{
    const tl_vec3d origin = tl_vec3d_load_apart(&pair->b_to_a.origin);
    point->w = tl_vec3d_sub(point->a, tl_vec3d_add(tl_frame_rotate(&pair->b_to_a, on_b), origin));
    double scale = tl_vec3d_size(point->a) + tl_vec3d_size(on_b) + pair->origin_size;
    pair->scale = scale > pair->scale ? scale : pair->scale;
}

void tl_minkowski_support(tl_minkowski *pair, tl_vec3d direction, tl_minkowski_point *point)
{
    if (pair->is_placed) {
        const uint32_t at = tl_placed_pair_support(&pair->placed, direction.x, direction.y, direction.z);
        point->a = tl_placed_point(&pair->placed.a, at >> 3);
        point->w = tl_vec3d_sub(point->a, tl_placed_point(&pair->placed.b, at & 7u));
        point->vertex_a = tl_placed_vertex(&pair->placed.a, at >> 3);
        point->vertex_b = tl_placed_vertex(&pair->placed.b, at & 7u);
        return;
    }
    tl_vec3d direction_b = tl_frame_rotate_back(&pair->b_to_a, tl_vec3d_neg(direction)), on_b;
    support_of(pair, pair->a, &direction, &pair->last_a, &point->a);
    support_of(pair, pair->b, &direction_b, &pair->last_b, &on_b);
    point->vertex_a = pair->last_a;
    point->vertex_b = pair->last_b;
    finish_point(pair, on_b, point);
}

bool tl_minkowski_vertex(tl_minkowski *pair, uint32_t vertex_a, uint32_t vertex_b, tl_minkowski_point *point)
{
    tl_vec3d on_b;
    if (!shape_vertex(pair->a, vertex_a, &point->a) || !shape_vertex(pair->b, vertex_b, &on_b)) {
        return false;
    }
    point->vertex_a = vertex_a;
    point->vertex_b = vertex_b;
    finish_point(pair, on_b, point);
    return true;
}

tl_vec3d tl_minkowski_vertex_of_a(const tl_minkowski *pair, uint32_t vertex)
{
    tl_vec3d point = { 0.0, 0.0, 0.0 };
    shape_vertex(pair->a, vertex, &point);
    return point;
}

// Whether the support's value costs less than its point.
static bool is_small(const tl_convex *shape)
{
    return shape->kind == TL_CONVEX_BOX ||
           (shape->kind == TL_CONVEX_HULL && shape->hull->vertex_count >= 4 && shape->hull->vertex_count <= SMALL_HULL);
}

// How far a small shape reaches along one direction or two; returns the size of its coordinates.
static TL_ALWAYS_INLINE double small_reach(const tl_convex *shape, const tl_vec3d *d, int directions, double *reach)
{
    if (shape->kind == TL_CONVEX_HULL) {
        tl_reach_along(tl_hull_vertices(shape->hull), shape->hull->vertex_count, d, directions, reach);
        return tl_hull_size(shape->hull);
    }
    tl_vec3d c = tl_vec3d_from(shape->corners[0]), h = tl_vec3d_from(shape->corners[1]);
    for (int k = 0; k < directions; k++) {
        reach[k] = tl_vec3d_dot(d[k], c) + (fabs(d[k].x) * h.x + fabs(d[k].y) * h.y + fabs(d[k].z) * h.z);
    }
    return tl_vec3d_size(c) + tl_vec3d_size(h);
}

static TL_ALWAYS_INLINE void reach_along(tl_minkowski *pair, const tl_vec3d *normals, int directions, double *reach)
{
    if (is_small(pair->a) && is_small(pair->b)) {
        tl_vec3d back[2];
        double reach_a[2], reach_b[2];
        for (int k = 0; k < directions; k++) {
            back[k] = tl_vec3d_neg(tl_frame_rotate_back(&pair->b_to_a, tl_vec3d_load_apart(&normals[k])));
        }
        double scale = small_reach(pair->a, normals, directions, reach_a) +
                       small_reach(pair->b, back, directions, reach_b) + pair->origin_size;
        pair->scale = scale > pair->scale ? scale : pair->scale;
        for (int k = 0; k < directions; k++) {
            reach[k] = reach_a[k] + reach_b[k] - tl_vec3d_dot(normals[k], pair->b_to_a.origin);
        }
        return;
    }
    for (int k = 0; k < directions; k++) {
        tl_minkowski_point point;
        tl_minkowski_support(pair, normals[k], &point);
        reach[k] = tl_vec3d_dot(normals[k], point.w) + pair->direction_error;
    }
}

double tl_minkowski_reach(tl_minkowski *pair, tl_vec3d normal)
{
    double reach;
    reach_along(pair, &normal, 1, &reach);
    return reach;
}

void tl_minkowski_reach_of_two(tl_minkowski *pair, const tl_vec3d normals[2], double reach_out[2])
{
    reach_along(pair, normals, 2, reach_out);
}

// The same for shapes of vertices in a row, which are asked for most.
static const tl_vec3 *vertex_row(const tl_convex *shape, uint32_t *count)
{
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        *count = shape->hull->vertex_count;
        return tl_hull_vertices(shape->hull);
    case TL_CONVEX_POINTS:
        *count = shape->point_count;
        return shape->points;
    case TL_CONVEX_INLINE:
        *count = shape->point_count;
        return shape->corners;
    default:
        return NULL;
    }
}

bool tl_minkowski_simplex(tl_minkowski *pair, const tl_simplex_cache *cache, tl_minkowski_point points[4])
{
    uint32_t count_a = 0, count_b = 0;
    const tl_vec3 *row_a = vertex_row(pair->a, &count_a), *row_b = vertex_row(pair->b, &count_b);
    const uint32_t count = cache->count < 4 ? cache->count : 4;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t vertex_a = cache->vertex_a[i], vertex_b = cache->vertex_b[i];
        if (row_a == NULL || row_b == NULL) {
            if (!tl_minkowski_vertex(pair, vertex_a, vertex_b, &points[i])) {
                return false;
            }
            continue;
        }
        if (vertex_a >= count_a || vertex_b >= count_b) {
            return false;
        }
        points[i].a = tl_vec3d_from(row_a[vertex_a]);
        points[i].vertex_a = vertex_a;
        points[i].vertex_b = vertex_b;
        finish_point(pair, tl_vec3d_from(row_b[vertex_b]), &points[i]);
    }
    return count > 0;
}

bool tl_minkowski_vertices(tl_minkowski *pair, const uint16_t (*vertices)[2], uint32_t count,
                           tl_minkowski_point *points)
{
    uint32_t count_a = 0, count_b = 0;
    const tl_vec3 *row_a = vertex_row(pair->a, &count_a), *row_b = vertex_row(pair->b, &count_b);
    for (uint32_t i = 0; i < count && (row_a == NULL || row_b == NULL); i++) {
        if (!tl_minkowski_vertex(pair, vertices[i][0], vertices[i][1], &points[i])) {
            return false;
        }
    }
    if (row_a == NULL || row_b == NULL) {
        return true;
    }
    const tl_frame b_to_a = pair->b_to_a;
    double most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t vertex_a = vertices[i][0], vertex_b = vertices[i][1];
        if (vertex_a >= count_a || vertex_b >= count_b) {
            return false;
        }
        const tl_vec3d on_b = tl_vec3d_from(row_b[vertex_b]), on_a = tl_vec3d_from(row_a[vertex_a]);
        const double scale = tl_vec3d_size(on_a) + tl_vec3d_size(on_b);
        most = scale > most ? scale : most;
        points[i].a = on_a;
        points[i].w = tl_vec3d_sub(on_a, tl_frame_point(&b_to_a, on_b));
        points[i].vertex_a = vertex_a;
        points[i].vertex_b = vertex_b;
    }
    most += pair->origin_size;
    pair->scale = most > pair->scale ? most : pair->scale;
    return true;
}

// Of the vertices of one side of the pairs: those of a hull by its bounds.
static double size_of_used(const tl_convex *shape, const tl_vec3 *row, const uint16_t (*vertices)[2], uint32_t count,
                           int side)
{
    if (shape->kind == TL_CONVEX_HULL) {
        return tl_hull_size(shape->hull);
    }
    double most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const double size = tl_vec3d_size(tl_vec3d_from(row[vertices[i][side]]));
        most = size > most ? size : most;
    }
    return most;
}

static inline void place_point(tl_placed_points *points, uint32_t i, tl_vec3d w)
{
    points->x[i] = w.x;
    points->y[i] = w.y;
    points->z[i] = w.z;
}

#if TL_HAS_F64X2

static inline tl_f64x2 two_floats(float x, float y)
{
    const double two[2] = { (double)x, (double)y };
    return tl_f64x2_load(two);
}

// Points i and i + 1.
static inline void place_two(const tl_frame *b_to_a, const tl_vec3 *row_a, const tl_vec3 *row_b,
                             const uint16_t (*vertices)[2], tl_placed_points *points, uint32_t i)
{
    const tl_vec3 *a = &row_a[vertices[i][0]], *next_a = &row_a[vertices[i + 1][0]], *b = &row_b[vertices[i][1]],
                  *next_b = &row_b[vertices[i + 1][1]];
    const tl_f64x2 x = two_floats(b->x, next_b->x), y = two_floats(b->y, next_b->y), z = two_floats(b->z, next_b->z);
    const tl_f64x2 on_a[3] = { two_floats(a->x, next_a->x), two_floats(a->y, next_a->y), two_floats(a->z, next_a->z) };
    const double origin[3] = { b_to_a->origin.x, b_to_a->origin.y, b_to_a->origin.z };
    double *const out[3] = { points->x, points->y, points->z };
    for (int k = 0; k < 3; k++) {
        const tl_f64x2 row[3] = { tl_f64x2_all(b_to_a->rows[k].x), tl_f64x2_all(b_to_a->rows[k].y),
                                  tl_f64x2_all(b_to_a->rows[k].z) };
        const tl_f64x2 on_b = tl_f64x2_add(tl_farthest_two(row, x, y, z), tl_f64x2_all(origin[k]));
        tl_f64x2_store(&out[k][i], tl_f64x2_sub(on_a[k], on_b));
    }
}

static void place_rows(const tl_frame *b_to_a, const tl_vec3 *row_a, const tl_vec3 *row_b,
                       const uint16_t (*vertices)[2], uint32_t count, tl_placed_points *points)
{
    const tl_frame frame = *b_to_a; // what is written to might be it, as far as a compiler knows
    for (uint32_t i = 0; i < count; i += 2) {
        place_two(&frame, row_a, row_b, vertices, points, i + 2 <= count ? i : count - 2);
    }
}

#else

static void place_rows(const tl_frame *b_to_a, const tl_vec3 *row_a, const tl_vec3 *row_b,
                       const uint16_t (*vertices)[2], uint32_t count, tl_placed_points *points)
{
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3d on_a = tl_vec3d_from(row_a[vertices[i][0]]), on_b = tl_vec3d_from(row_b[vertices[i][1]]);
        place_point(points, i, tl_vec3d_sub(on_a, tl_frame_point(b_to_a, on_b)));
    }
}

#endif

static bool are_vertices(const uint16_t (*vertices)[2], uint32_t count, uint32_t count_a, uint32_t count_b)
{
    for (uint32_t i = 0; i < count; i++) {
        if (vertices[i][0] >= count_a || vertices[i][1] >= count_b) {
            return false;
        }
    }
    return true;
}

// False where a row has no such vertex.
static bool place_all(const tl_frame *b_to_a, tl_vertex_row row_a, tl_vertex_row row_b, const uint16_t (*vertices)[2],
                      uint32_t count, tl_placed_points *points)
{
#if TL_CPU_LEVELS >= 2
    if (count >= 4 && tl_cpu_has_avx2()) {
        return tl_scan_place_avx2(b_to_a, row_a, row_b, vertices, count, points);
    }
#endif
    if (!are_vertices(vertices, count, row_a.count, row_b.count)) {
        return false;
    }
    place_rows(b_to_a, row_a.points, row_b.points, vertices, count, points);
    return true;
}

bool tl_minkowski_place(tl_minkowski *pair, const uint16_t (*vertices)[2], uint32_t count, tl_placed_points *points)
{
    uint32_t count_a = 0, count_b = 0;
    const tl_vec3 *row_a = vertex_row(pair->a, &count_a), *row_b = vertex_row(pair->b, &count_b);
    if (row_a == NULL || row_b == NULL) {
        tl_minkowski_point point;
        for (uint32_t i = 0; i < count; i++) {
            if (!tl_minkowski_vertex(pair, vertices[i][0], vertices[i][1], &point)) {
                return false;
            }
            place_point(points, i, point.w);
        }
        return true;
    }
    const tl_vertex_row a = { row_a, count_a }, b = { row_b, count_b };
    if (!place_all(&pair->b_to_a, a, b, vertices, count, points)) {
        return false;
    }
    const double scale = size_of_used(pair->a, row_a, vertices, count, 0) +
                         size_of_used(pair->b, row_b, vertices, count, 1) + pair->origin_size;
    pair->scale = scale > pair->scale ? scale : pair->scale;
    return true;
}
