// SPDX-License-Identifier: MIT
//
// Where a ray meets a triangle that it surely meets.
//
// Most rays end with one triangle that the float filters have proven to be met, in front of the origin and within tmax
// (ray_walk.h). Then no sign is left to decide, and t, u, v and the normal are those of ray_decide.c and
// ray_describe.c, by the same operations in lanes, without their tests. One thing must still be sure: that ray_decide.c
// would take its t from the weights too. For that its error is bounded from above with what is known of all triangles
// of the leaf. Their corners are within the reach M, and, sheared, within 3 L of the ray, L the largest extent of the
// leaf: the error of a weight is at most u (33 M (3 L) + 5 (3 L)^2 + 256 u M^2), and it moves t by at most 3 (L / |d|)
// / |sum of weights| times that.

#ifndef TALUS_SRC_SOUP_RAY_MEASURE_H
#define TALUS_SRC_SOUP_RAY_MEASURE_H

#include "math/simd4d.h"
#include "math/tolerance.h"
#include "math/vec3d.h"
#include "soup/ray.h"

// Covers the rounding of the bounds themselves.
#define TL_RAY_BOUND_MARGIN 1.01
// t must be clear of the rounding of the corners' own t, which are at most t + L / |d|.
#define TL_RAY_T_PER_DEPTH 5.9604644775390625e-8 // 2^-24
// A t that is not near FLT_MAX.
#define TL_RAY_T_MAX 1e37

// Corners of a triangle in the order of the view, by axis of the shear; the fourth lane repeats the third.
typedef struct tl_ray_corners {
    tl_f64x4 x, y, z;
} tl_ray_corners;

static TL_ALWAYS_INLINE tl_ray_corners tl_ray_read_corners(const tl_ray_job *job, const tl_leaf_view *leaf)
{
    const float *a[3];
    tl_leaf_find_corners(leaf, job->lane, a);
    uint32_t stride = tl_leaf_stride(leaf);
    uint32_t x = job->axis_x * stride, y = job->axis_y * stride, z = job->axis_z * stride;
    tl_ray_corners v = { tl_f64x4_make(a[0][x], a[1][x], a[2][x], a[2][x]),
                         tl_f64x4_make(a[0][y], a[1][y], a[2][y], a[2][y]),
                         tl_f64x4_make(a[0][z], a[1][z], a[2][z], a[2][z]) };
    return v;
}

static inline double tl_ray_direction_along(const tl_ray_job *job, uint32_t axis)
{
    return (double)job->target.lane[axis] - (job->is_segment ? (double)job->origin.lane[axis] : 0.0);
}

// The normal of the triangle, by the operations of tl_triangle_normal: the axes of the shear follow each other as x, y,
// z do.
static TL_ALWAYS_INLINE tl_vec3 tl_ray_corners_normal(const tl_ray_job *job, const tl_ray_corners *v)
{
    // Sides from corner 0 to 1 and to 2.
    double x[4], y[4], z[4], normal[3];
    tl_f64x4_store(x, tl_f64x4_sub(tl_f64x4_rotate_three(v->x), tl_f64x4_first(v->x)));
    tl_f64x4_store(y, tl_f64x4_sub(tl_f64x4_rotate_three(v->y), tl_f64x4_first(v->y)));
    tl_f64x4_store(z, tl_f64x4_sub(tl_f64x4_rotate_three(v->z), tl_f64x4_first(v->z)));
    normal[job->axis_x] = y[0] * z[1] - z[0] * y[1];
    normal[job->axis_y] = z[0] * x[1] - x[0] * z[1];
    normal[job->axis_z] = x[0] * y[1] - y[0] * x[1];
    return tl_vec3d_unit_or_zero(tl_vec3d_make(normal[0], normal[1], normal[2]));
}

// Describes the triangle that waits; false, and nothing done, when ray_decide.c would look closer.
static TL_ALWAYS_INLINE bool tl_ray_measure(const tl_ray_job *job, tl_ray_hit *hit)
{
    tl_leaf_view leaf = tl_view_leaf(job->leaf);
    tl_ray_corners v = tl_ray_read_corners(job, &leaf);
    double along = tl_ray_direction_along(job, job->axis_z);
    double inverse_z = 1.0 / along;
    tl_f64x4 shear_x = tl_f64x4_all(tl_ray_direction_along(job, job->axis_x) * inverse_z);
    tl_f64x4 shear_y = tl_f64x4_all(tl_ray_direction_along(job, job->axis_y) * inverse_z);
    tl_f64x4 z = tl_f64x4_sub(v.z, tl_f64x4_all((double)job->origin.lane[job->axis_z]));
    tl_f64x4 x = tl_f64x4_sub(v.x, tl_f64x4_all((double)job->origin.lane[job->axis_x]));
    tl_f64x4 y = tl_f64x4_sub(v.y, tl_f64x4_all((double)job->origin.lane[job->axis_y]));
    x = tl_f64x4_sub(x, tl_f64x4_mul(shear_x, z));
    y = tl_f64x4_sub(y, tl_f64x4_mul(shear_y, z));
    tl_f64x4 cross = tl_f64x4_sub(tl_f64x4_mul(x, tl_f64x4_rotate_three(y)), tl_f64x4_mul(y, tl_f64x4_rotate_three(x)));
    tl_f64x4 weights = tl_f64x4_rotate_three(cross);
    double weight[4], product[4];
    tl_f64x4_store(weight, weights);
    tl_f64x4_store(product, tl_f64x4_mul(weights, tl_f64x4_mul(z, tl_f64x4_all(inverse_z))));
    double sum = weight[0] + weight[1] + weight[2];
    double t = (product[0] + product[1] + product[2]) / sum;
    double reach = (double)job->reach, wide = (double)job->leaf->extent, deep = wide * fabs(inverse_z);
    double error = TL_RAY_BOUND_MARGIN * TL_DOUBLE_ROUNDING *
                   ((99.0 * reach + 45.0 * wide) * wide + 256.0 * TL_DOUBLE_ROUNDING * reach * reach);
    bool is_safe = (3.0 * TL_RAY_BOUND_MARGIN * error * deep <= TL_RAY_T_WEIGHT_ERROR * t * fabs(sum)) &
                   (t > TL_RAY_T_PER_DEPTH * deep) & (t < TL_RAY_T_MAX);
    if (!is_safe) {
        return false;
    }
    uint32_t triangle = leaf.ids[job->lane] & TL_ID_INDEX;
    double scale = 1.0 / sum;
    memset(hit, 0, sizeof *hit);
    hit->t = (float)t;
    hit->triangle = triangle;
    hit->u = (float)(weight[1] * scale);
    hit->v = (float)(weight[2] * scale);
    hit->normal = tl_ray_corners_normal(job, &v);
    hit->material = tl_soup_material(job->soup, triangle);
    hit->back = (along > 0.0) == (sum > 0.0);
    return true;
}

#endif
