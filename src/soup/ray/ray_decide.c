// SPDX-License-Identifier: MIT
//
// Whether a ray meets a triangle, exactly, and where.
//
// In double, the ray is sheared into an axis and the triangle's corners into a plane across it. The sidedness of the
// ray and an edge a, b is then E(a, b) = a.x b.y - a.y b.x: the scalar triple product of Ericson's test, divided by the
// direction's largest component. The line meets the closed triangle when no two edges have opposite signs; a sign that
// the error bound does not prove is computed exactly. E of the three edges are also the weights of the opposite
// corners.
//
// Error of E, u = TL_DOUBLE_ROUNDING, M the largest coordinate of the three corners seen from the origin, m the largest
// after the shear: corners are off by at most 8 u M (ray_prepare.h), so E by at most 4 (8 u M) m + 2 (8 u M)^2, and its
// own two products and difference add 4 u m^2.
//
// t, u and v are those of ray_measure.h, from the plane. Where a grazing ray makes them doubtful, t is a quotient of
// two exact sums, each rounded once or twice: right to 8 u of itself, and so is its sign.
//
// Sources: Christer Ericson, Real-Time Collision Detection, 2005, section 5.3.4; Woop, Benthin, Wald, Watertight
// Ray/Triangle Intersection, JCGT 2013.

#include "soup/ray/ray_measure.h"

#include "base/min_max.h"
#include "math/predicates.h"
#include "math/vec3d.h"
#include "soup/ray/ray_filter.h"

#include <float.h>

typedef struct triangle_test {
    tl_leaf_view leaf;
    uint32_t lane, id;
    double weight[3]; // E of the edge across from each corner
    double reach;     // the largest distance along an axis from the origin to a corner
    double error;     // bound of a weight's error
    int sign;         // of the weights that are not zero
} triangle_test;

static inline int sign_of_weight(double value)
{
    return (value > 0.0) - (value < 0.0);
}

// The exact side on which the line passes the edge across from corner k, as the sign of that corner's weight.
static int exact_side(const tl_ray_job *job, const triangle_test *test, int k)
{
    tl_vec3 v[3];
    tl_leaf_corners(&test->leaf, test->lane, test->id, v);
    tl_vec3 a = v[(k + 1) % 3], b = v[(k + 2) % 3];
    int side = job->is_segment ? tl_orient3d(job->origin.point, job->target.point, a, b)
                               : tl_line_side(job->origin.point, job->target.point, a, b);
    return job->direction[job->axes[2]] > 0.0 ? side : -side;
}

static void prepare_exact(tl_ray_job *job)
{
    for (int i = 0; i < 3; i++) {
        double from = job->is_segment ? (double)job->origin.lane[i] : 0.0;
        job->direction[i] = (double)job->target.lane[i] - from;
    }
    job->inverse_z = 1.0 / job->direction[job->axes[2]];
    job->exact_shear[0] = job->direction[job->axes[0]] * job->inverse_z;
    job->exact_shear[1] = job->direction[job->axes[1]] * job->inverse_z;
    job->is_exact = true;
}

// Weights and their common sign; false when the line misses the triangle or lies in its plane.
static bool meets_line(const tl_ray_job *job, triangle_test *test)
{
    double x[3], y[3];
    double size = 0.0;
    test->reach = 0.0;
    double origin_x = (double)job->origin.lane[job->axes[0]];
    double origin_y = (double)job->origin.lane[job->axes[1]];
    double origin_z = (double)job->origin.lane[job->axes[2]];
    const float *corners[3];
    tl_leaf_find_corners(&test->leaf, test->lane, test->id, corners);
    uint32_t stride = tl_leaf_stride(&test->leaf);
    for (int k = 0; k < 3; k++) {
        const float *corner = corners[k];
        double dx = (double)corner[job->axes[0] * stride] - origin_x;
        double dy = (double)corner[job->axes[1] * stride] - origin_y;
        double dz = (double)corner[job->axes[2] * stride] - origin_z;
        x[k] = dx - job->exact_shear[0] * dz;
        y[k] = dy - job->exact_shear[1] * dz;
        test->reach = tl_max_f64(test->reach, tl_max_f64(tl_max_f64(fabs(dx), fabs(dy)), fabs(dz)));
        size = tl_max_f64(size, tl_max_f64(fabs(x[k]), fabs(y[k])));
    }
    double reach = test->reach;
    test->error =
        TL_DOUBLE_ROUNDING * (33.0 * reach * size + 5.0 * size * size + 256.0 * TL_DOUBLE_ROUNDING * reach * reach);
    bool positive = false, negative = false;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        test->weight[k] = x[i] * y[j] - y[i] * x[j];
        positive |= test->weight[k] > test->error;
        negative |= test->weight[k] < -test->error;
    }
    for (int k = 0; k < 3 && !(positive && negative); k++) {
        if (fabs(test->weight[k]) <= test->error) {
            int sign = exact_side(job, test, k);
            test->weight[k] = sign != 0 && sign_of_weight(test->weight[k]) == sign ? test->weight[k] : 0.0;
            positive |= sign > 0;
            negative |= sign < 0;
        }
    }
    test->sign = positive ? 1 : -1;
    return positive != negative;
}

// t of the triangle's plane by exact sums: for lines that graze it, where the weights are imprecise.
static double exact_t(const tl_ray_job *job, const triangle_test *test)
{
    tl_vec3 v[3];
    tl_leaf_corners(&test->leaf, test->lane, test->id, v);
    double across = tl_normal_dot(v[0], v[1], v[2], v[0], job->origin.point);
    double along = job->is_segment ? tl_normal_dot(v[0], v[1], v[2], job->target.point, job->origin.point)
                                   : tl_normal_dot(v[0], v[1], v[2], job->target.point, tl_vec3_make(0.0f, 0.0f, 0.0f));
    return across / along;
}

// On which side of the point `at` of the line the hit lies, exactly: the origin is t = 0, a segment's end t = 1.
static int exact_order(const tl_ray_job *job, const triangle_test *test, tl_vec3 at)
{
    tl_vec3 v[3];
    tl_leaf_corners(&test->leaf, test->lane, test->id, v);
    // normal . (corner - at) over normal . direction; the latter's sign is that of the weights along the axis.
    int across = -tl_orient3d(v[0], v[1], v[2], at);
    int along = job->direction[job->axes[2]] > 0.0 ? test->sign : -test->sign;
    return across * along;
}

// The largest side of a triangle along an axis, from its first corner.
static double width_of(const triangle_test *test)
{
    tl_vec3 v[3];
    tl_leaf_corners(&test->leaf, test->lane, test->id, v);
    double width = 0.0;
    for (int k = 1; k < 3; k++) {
        tl_vec3d side = tl_vec3d_sub(tl_vec3d_from(v[k]), tl_vec3d_from(v[0]));
        width = tl_max_f64(width, tl_max_f64(tl_max_f64(fabs(side.x), fabs(side.y)), fabs(side.z)));
    }
    return width;
}

// t, right to TL_RAY_T_ERROR of itself and so in its sign; u, v and the normal.
static double find_place(const tl_ray_job *job, const triangle_test *test, float *u_out, float *v_out,
                         double normal_out[3])
{
    const float *corners[3];
    tl_leaf_find_corners(&test->leaf, test->lane, test->id, corners);
    tl_ray_crossing crossing = tl_ray_cross_plane(job, corners, tl_leaf_stride(&test->leaf));
    for (int k = 0; k < 3; k++) {
        normal_out[k] = tl_f64x4_get_x(crossing.normal[k]);
    }
    if (tl_ray_t_is_safe(tl_f64x4_get_y(crossing.sums), width_of(test), test->reach)) {
        double place[4]; // 1, -t, u, v
        tl_f64x4_store(place, tl_f64x4_mul(crossing.sums, tl_f64x4_all(1.0 / tl_f64x4_get_x(crossing.sums))));
        *u_out = (float)place[2];
        *v_out = (float)place[3];
        tl_ray_keep_inside(u_out, v_out);
        return -place[1];
    }
    double sum = test->weight[0] + test->weight[1] + test->weight[2];
    // A needle seen edge-on may have weights that all vanish in double: then the hit is anywhere on it.
    double scale = sum != 0.0 ? 1.0 / sum : 0.0;
    *u_out = (float)(test->weight[1] * scale);
    *v_out = (float)(test->weight[2] * scale);
    return exact_t(job, test);
}

// The reported t; false when the hit lies before the ray's start or beyond a segment's end.
static bool round_t(const tl_ray_job *job, const triangle_test *test, double t, float *t_out)
{
    if (t < 0.0) {
        return false;
    }
    if (job->is_segment && t >= 1.0 - TL_RAY_T_ERROR) {
        int order = t > 1.0 + 2.0 * TL_RAY_T_ERROR ? 1 : exact_order(job, test, job->target.point);
        if (order > 0) {
            return false;
        }
        t = order == 0 || t > 1.0 ? 1.0 : t;
    }
    // Not t >= 0: a zero has no sign.
    t = t > 0.0 ? t : 0.0;
    *t_out = t < (double)FLT_MAX ? (float)t : FLT_MAX;
    return true;
}

bool tl_ray_decide_triangle(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t lane, uint32_t id)
{
    if (!job->is_exact) {
        prepare_exact(job);
    }
    triangle_test test;
    test.leaf = tl_view_leaf(leaf);
    test.lane = lane;
    test.id = id;
    uint32_t triangle = id & TL_ID_INDEX;
    if (!meets_line(job, &test)) {
        return false;
    }
    float t, u, v;
    double normal[3];
    double exact = find_place(job, &test, &u, &v, normal);
    if (!round_t(job, &test, exact, &t)) {
        return false;
    }
    if (!(t < job->t || (t == job->t && triangle < job->triangle))) {
        return false;
    }
    // normal . direction > 0: the ray runs with the normal, so it came from behind.
    bool back = (job->direction[job->axes[2]] > 0.0) == (test.sign > 0);
    if (!tl_ray_filter_accepts(job->soup, job->filter, triangle, back ? TL_SEEN_BACK : TL_SEEN_FRONT)) {
        return false;
    }
    job->t = t;
    job->box_limit = tl_ray_box_limit(job, t);
    job->triangle = triangle;
    job->back = back;
    job->u = u;
    job->v = v;
    memcpy(job->normal, normal, sizeof job->normal);
    return true;
}

bool tl_ray_decide(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t lane)
{
    const uint32_t id = tl_view_leaf(leaf).ids[lane], *word = tl_soup_coincident(job->soup, id);
    if (word == NULL) {
        return tl_ray_decide_triangle(job, leaf, lane, id);
    }
    bool better = tl_ray_decide_triangle(job, leaf, lane, *word);
    while ((*word & TL_ID_LAST) == 0) {
        better |= tl_ray_decide_triangle(job, leaf, lane, *++word);
    }
    return better;
}
