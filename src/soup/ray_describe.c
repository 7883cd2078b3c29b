// SPDX-License-Identifier: MIT
//
// What is reported of a hit.
//
// Most rays end here with one triangle that the float filters have proven to be met, in front of the origin and within
// tmax (ray_walk.h). Then no sign is left to decide, and t, u and v are those of ray_decide.c, by the same operations,
// without its tests. One thing must still be sure: that ray_decide.c would take its t from the weights too. For that
// its error is bounded from above with what is known of all triangles of the leaf. Their corners are within the reach
// M, and, sheared, within 3 L of the ray, L the largest extent of the leaf: the error of a weight is at most u (33 M (3
// L) + 5 (3 L)^2 + 256 u M^2), and it moves t by at most 3 (L / |d|) / |sum of weights| times that.

#include "soup/ray.h"

#include "math/tolerance.h"
#include "soup/triangle_point.h"

#include <float.h>
#include <string.h>

// Covers the rounding of the bounds themselves.
#define BOUND_MARGIN 1.01
// t must be clear of the rounding of the corners' own t, which are at most t + L / |d|.
#define T_PER_DEPTH 5.9604644775390625e-8 // 2^-24
// A t that is not near FLT_MAX.
#define T_MAX 1e37

// Corners of a triangle seen from the origin of a ray, by axis of the shear.
typedef struct seen_corners {
    double x[3], y[3], z[3];
} seen_corners;

static void see_corners(const tl_ray_job *job, const tl_leaf_view *leaf, seen_corners *seen)
{
    const uint8_t *slots = tl_soup_corner_slots[tl_id_order(leaf->ids[job->lane])];
    uint32_t stride = tl_leaf_stride(leaf);
    double origin_x = (double)job->origin.lane[job->axis_x];
    double origin_y = (double)job->origin.lane[job->axis_y];
    double origin_z = (double)job->origin.lane[job->axis_z];
    for (int k = 0; k < 3; k++) {
        const float *corner = tl_leaf_corner(leaf, job->lane, slots[k]);
        seen->x[k] = (double)corner[job->axis_x * stride] - origin_x;
        seen->y[k] = (double)corner[job->axis_y * stride] - origin_y;
        seen->z[k] = (double)corner[job->axis_z * stride] - origin_z;
    }
}

static inline double direction_along(const tl_ray_job *job, uint32_t axis)
{
    return (double)job->target.lane[axis] - (job->is_segment ? (double)job->origin.lane[axis] : 0.0);
}

// t and weights of the triangle that waits, as ray_decide.c finds them; false when it would look closer.
static bool measure(tl_ray_job *job, const tl_leaf_view *leaf, float extent)
{
    seen_corners v;
    see_corners(job, leaf, &v);
    double along = direction_along(job, job->axis_z);
    double inverse_z = 1.0 / along;
    double shear_x = direction_along(job, job->axis_x) * inverse_z;
    double shear_y = direction_along(job, job->axis_y) * inverse_z;
    double x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = v.x[k] - shear_x * v.z[k];
        y[k] = v.y[k] - shear_y * v.z[k];
    }
    double *weight = job->weight;
    weight[0] = x[1] * y[2] - y[1] * x[2];
    weight[1] = x[2] * y[0] - y[2] * x[0];
    weight[2] = x[0] * y[1] - y[0] * x[1];
    double sum = weight[0] + weight[1] + weight[2];
    double t =
        (weight[0] * (v.z[0] * inverse_z) + weight[1] * (v.z[1] * inverse_z) + weight[2] * (v.z[2] * inverse_z)) / sum;
    double reach = (double)job->reach, wide = (double)extent, deep = wide * fabs(inverse_z);
    double error = BOUND_MARGIN * TL_DOUBLE_ROUNDING *
                   ((99.0 * reach + 45.0 * wide) * wide + 256.0 * TL_DOUBLE_ROUNDING * reach * reach);
    if (!(3.0 * BOUND_MARGIN * error * deep <= TL_RAY_T_WEIGHT_ERROR * t * fabs(sum) && t > T_PER_DEPTH * deep &&
          t < T_MAX)) {
        return false;
    }
    job->t = (float)t;
    job->triangle = leaf->ids[job->lane] & TL_ID_INDEX;
    job->back = (along > 0.0) == (sum > 0.0);
    return true;
}

bool tl_ray_describe(tl_ray_job *job, tl_ray_hit *hit)
{
    tl_leaf_view leaf = tl_view_leaf(job->leaf);
    if (job->is_waiting && !measure(job, &leaf, job->leaf->extent) && !tl_ray_decide(job, job->leaf, job->lane) &&
        job->triangle == UINT32_MAX) {
        return false;
    }
    memset(hit, 0, sizeof *hit);
    hit->t = job->t;
    hit->triangle = job->triangle;
    hit->material = tl_soup_material(job->soup, job->triangle);
    hit->back = job->back;
    double sum = job->weight[0] + job->weight[1] + job->weight[2];
    // A needle seen edge-on may have weights that all vanish in double: then the hit is anywhere on it.
    double scale = sum != 0.0 ? 1.0 / sum : 0.0;
    hit->u = (float)(job->weight[1] * scale);
    hit->v = (float)(job->weight[2] * scale);
    tl_vec3 corner[3];
    tl_leaf_corners(&leaf, job->lane, corner);
    hit->normal = tl_triangle_normal(corner);
    return true;
}
