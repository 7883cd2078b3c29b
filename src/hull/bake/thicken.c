// SPDX-License-Identifier: MIT
//
// Input without volume, made thick on request: every point is replaced by two, four or eight, moved half the thickness
// to both sides along each direction that the cloud lacks. Copy k of point i is point i * copies + k.

#include "hull/bake/quickhull.h"

static void normalize(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

static void cross_axes(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void direction(const tl_quickhull *hull, uint32_t from, uint32_t to, double out[3])
{
    out[0] = (double)hull->points[to].x - (double)hull->points[from].x;
    out[1] = (double)hull->points[to].y - (double)hull->points[from].y;
    out[2] = (double)hull->points[to].z - (double)hull->points[from].z;
    normalize(out);
}

// The unit directions that are missing: 3 - rank of them.
static void missing_axes(const tl_quickhull *hull, const uint32_t seed[4], uint32_t rank, double axes[3][3])
{
    if (rank == 0) {
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                axes[i][k] = i == k ? 1.0 : 0.0;
            }
        }
        return;
    }
    double along[3];
    direction(hull, seed[0], seed[1], along);
    if (rank == 1) {
        // The coordinate axis that is least along the line gives a well-conditioned frame.
        int least = fabs(along[0]) <= fabs(along[1]) && fabs(along[0]) <= fabs(along[2]) ? 0
                    : fabs(along[1]) <= fabs(along[2])                                   ? 1
                                                                                         : 2;
        double unit[3] = { least == 0 ? 1.0 : 0.0, least == 1 ? 1.0 : 0.0, least == 2 ? 1.0 : 0.0 };
        cross_axes(along, unit, axes[0]);
        normalize(axes[0]);
        cross_axes(along, axes[0], axes[1]);
        normalize(axes[1]);
        return;
    }
    double side[3];
    direction(hull, seed[0], seed[2], side);
    cross_axes(along, side, axes[0]);
    normalize(axes[0]);
}

tl_result tl_quickhull_thicken(tl_quickhull *hull, const uint32_t seed[4], uint32_t rank, float thickness,
                               uint32_t *copies_out)
{
    double axes[3][3] = { { 0.0 } };
    missing_axes(hull, seed, rank, axes);
    uint32_t missing = 3 - rank, copies = 1u << missing;
    if (hull->point_count >= TL_MAX_HULL_POINTS / copies) {
        return TL_ERR_LIMIT;
    }
    tl_vec3 *points = TL_PUSH(hull->arena, tl_vec3, (uint64_t)hull->point_count * copies);
    if (points == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < hull->point_count; i++) {
        for (uint32_t k = 0; k < copies; k++) {
            double p[3] = { (double)hull->points[i].x, (double)hull->points[i].y, (double)hull->points[i].z };
            for (uint32_t a = 0; a < missing; a++) {
                double step = (k >> a & 1u ? 0.5 : -0.5) * (double)thickness;
                for (int c = 0; c < 3; c++) {
                    p[c] += axes[a][c] * step;
                }
            }
            points[i * copies + k] = tl_vec3_make((float)p[0], (float)p[1], (float)p[2]);
        }
    }
    hull->points = points;
    hull->point_count *= copies;
    *copies_out = copies;
    return TL_OK;
}
