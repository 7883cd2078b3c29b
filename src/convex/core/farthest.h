// SPDX-License-Identifier: MIT
//
// The farthest of a few points along a direction, in double, with no branch that depends on the data: which vertex wins
// is as good as random to a branch predictor, and a wrong guess costs more than four points.
//
// Points stay where they are, x y z x y z ...; four of them are turned to three registers at a time. The first pass
// keeps the largest product, the second finds the first that equals it: the lowest index wins, as it does in plain C.

#ifndef TALUS_SRC_CONVEX_FARTHEST_H
#define TALUS_SRC_CONVEX_FARTHEST_H

#include "base/compiler.h"
#include "base/lowest_bit.h"
#include "convex/core/scan_four.h"
#include "math/simd2d.h"
#include "math/vec3d.h"

#if TL_HAS_F64X2

enum { TL_FARTHEST_BLOCK = 32 }; // products that are kept at a time; their mask is one word

static inline tl_f64x2 tl_farthest_two(const tl_f64x2 d[3], tl_f64x2 x, tl_f64x2 y, tl_f64x2 z)
{
    return tl_f64x2_add(tl_f64x2_add(tl_f64x2_mul(d[0], x), tl_f64x2_mul(d[1], y)), tl_f64x2_mul(d[2], z));
}

// The products of four points; returns the larger ones.
static inline tl_f64x2 tl_farthest_four(const tl_f64x2 d[3], const tl_vec3 *points, double *dots)
{
    tl_f64x2 x[2], y[2], z[2];
    tl_f64x2_load_points(&points->x, x, y, z);
    tl_f64x2 low = tl_farthest_two(d, x[0], y[0], z[0]), high = tl_farthest_two(d, x[1], y[1], z[1]);
    tl_f64x2_store(dots, low);
    tl_f64x2_store(dots + 2, high);
    return tl_f64x2_max(low, high);
}

// Bit k of the result: product k is the largest. Of four.
static inline uint32_t tl_farthest_mask(const double *dots, tl_f64x2 largest)
{
    return tl_f64x2_two_masks(tl_f64x2_where_equal(tl_f64x2_load(dots), largest),
                              tl_f64x2_where_equal(tl_f64x2_load(dots + 2), largest));
}

// Of 4 .. TL_FARTHEST_BLOCK points.
static inline uint32_t tl_farthest_of_block(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction,
                                            double *dot_out)
{
    _Alignas(16) double dots[TL_FARTHEST_BLOCK];
    const tl_f64x2 d[3] = { tl_f64x2_all(direction->x), tl_f64x2_all(direction->y), tl_f64x2_all(direction->z) };
    tl_f64x2 best = tl_farthest_four(d, points, dots);
    uint32_t i = 4, mask = 0;
    for (; i + 4 <= count; i += 4) {
        best = tl_f64x2_max(best, tl_farthest_four(d, points + i, dots + i));
    }
    if (i < count) {
        // Some of the last four are computed again. What lies beyond in the row must not win: NaN equals nothing, not
        // even where the direction or all points are infinite.
        best = tl_f64x2_max(best, tl_farthest_four(d, points + (count - 4), dots + (count - 4)));
        for (uint32_t k = count; k < i + 4; k++) {
            dots[k] = (double)NAN;
        }
    }
    best = tl_f64x2_max(best, tl_f64x2_swap(best));
    for (i = 0; i < count; i += 4) {
        mask |= tl_farthest_mask(dots + i, best) << i;
    }
    *dot_out = tl_f64x2_get_x(best);
    return mask != 0 ? tl_lowest_bit(mask) : 0; // 0: the direction is not finite
}

// Of eight: all products stay in registers.
static inline uint32_t tl_farthest_of_eight(const tl_vec3 *points, const tl_vec3d *direction)
{
    const tl_f64x2 d[3] = { tl_f64x2_all(direction->x), tl_f64x2_all(direction->y), tl_f64x2_all(direction->z) };
    tl_f64x2 x[4], y[4], z[4], dots[4];
    tl_f64x2_load_points(&points[0].x, x, y, z);
    tl_f64x2_load_points(&points[4].x, x + 2, y + 2, z + 2);
    for (int i = 0; i < 4; i++) {
        dots[i] = tl_farthest_two(d, x[i], y[i], z[i]);
    }
    tl_f64x2 best = tl_f64x2_max(tl_f64x2_max(dots[0], dots[1]), tl_f64x2_max(dots[2], dots[3]));
    best = tl_f64x2_max(best, tl_f64x2_swap(best));
    uint32_t mask = tl_f64x2_two_masks(tl_f64x2_where_equal(dots[0], best), tl_f64x2_where_equal(dots[1], best)) |
                    tl_f64x2_two_masks(tl_f64x2_where_equal(dots[2], best), tl_f64x2_where_equal(dots[3], best)) << 4;
    return mask != 0 ? tl_lowest_bit(mask) : 0; // 0: the direction is not finite
}

#endif

static inline uint32_t tl_farthest_plain(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
    uint32_t best = 0;
    double best_dot = tl_vec3d_dot(*direction, tl_vec3d_from(points[0]));
    for (uint32_t i = 1; i < count; i++) {
        double dot = tl_vec3d_dot(*direction, tl_vec3d_from(points[i]));
        best = dot > best_dot ? i : best;
        best_dot = dot > best_dot ? dot : best_dot;
    }
    return best;
}

#if TL_HAS_F64X2
static inline uint32_t tl_farthest_of_many(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
    uint32_t best = 0;
    double best_dot = -(double)INFINITY, dot;
    for (uint32_t from = 0; from < count;) {
        uint32_t left = count - from, size = left < TL_FARTHEST_BLOCK ? left : TL_FARTHEST_BLOCK;
        if (size < 4) {
            from = count - 4;
            size = 4;
        }
        uint32_t index = from + tl_farthest_of_block(points + from, size, direction, &dot);
        best = dot > best_dot ? index : best;
        best_dot = dot > best_dot ? dot : best_dot;
        from += size;
    }
    return best;
}
#endif

// What every processor of the target can run. Of count >= 1 points.
static inline uint32_t tl_farthest_base(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
#if TL_HAS_F64X2
    if (count == 8) {
        return tl_farthest_of_eight(points, direction);
    }
    if (count >= 4) {
        double dot;
        return count <= TL_FARTHEST_BLOCK ? tl_farthest_of_block(points, count, direction, &dot)
                                          : tl_farthest_of_many(points, count, direction);
    }
#endif
    return tl_farthest_plain(points, count, direction);
}

// Of count >= 4 points.
static TL_ALWAYS_INLINE void tl_reach_along_base(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction,
                                                 int directions, double *reach)
{
#if TL_HAS_F64X2
    tl_f64x2 d[2][3], best[2];
    for (int k = 0; k < directions; k++) {
        d[k][0] = tl_f64x2_all(direction[k].x);
        d[k][1] = tl_f64x2_all(direction[k].y);
        d[k][2] = tl_f64x2_all(direction[k].z);
        best[k] = tl_f64x2_all(-(double)INFINITY);
    }
    for (uint32_t i = 0; i < count; i += 4) {
        tl_f64x2 x[2], y[2], z[2]; // of the last four some are computed again
        tl_f64x2_load_points(&points[i + 4 <= count ? i : count - 4].x, x, y, z);
        for (int k = 0; k < directions; k++) {
            best[k] = tl_f64x2_max(best[k], tl_f64x2_max(tl_farthest_two(d[k], x[0], y[0], z[0]),
                                                         tl_farthest_two(d[k], x[1], y[1], z[1])));
        }
    }
    for (int k = 0; k < directions; k++) {
        reach[k] = tl_f64x2_get_x(tl_f64x2_max(best[k], tl_f64x2_swap(best[k]))) + 0.0; // of zeros the positive
    }
#else
    for (int k = 0; k < directions; k++) {
        uint32_t vertex = tl_farthest_plain(points, count, &direction[k]);
        reach[k] = tl_vec3d_dot(direction[k], tl_vec3d_from(points[vertex])) + 0.0;
    }
#endif
}

// Of count >= 4 points.
static inline double tl_farthest_image_sq_base(const tl_vec3 *points, uint32_t count, const tl_frame *map)
{
#if TL_HAS_F64X2
    tl_f64x2 rows[3][3], origin[3], most = tl_f64x2_all(0.0);
    for (int i = 0; i < 3; i++) {
        rows[i][0] = tl_f64x2_all(map->rows[i].x);
        rows[i][1] = tl_f64x2_all(map->rows[i].y);
        rows[i][2] = tl_f64x2_all(map->rows[i].z);
    }
    origin[0] = tl_f64x2_all(map->origin.x);
    origin[1] = tl_f64x2_all(map->origin.y);
    origin[2] = tl_f64x2_all(map->origin.z);
    for (uint32_t i = 0; i < count; i += 4) {
        tl_f64x2 x[2], y[2], z[2]; // of the last four some are computed again
        tl_f64x2_load_points(&points[i + 4 <= count ? i : count - 4].x, x, y, z);
        for (int k = 0; k < 2; k++) {
            tl_f64x2 sum = tl_f64x2_all(0.0);
            for (int axis = 0; axis < 3; axis++) {
                const tl_f64x2 image = tl_f64x2_add(tl_farthest_two(rows[axis], x[k], y[k], z[k]), origin[axis]);
                sum = tl_f64x2_add(sum, tl_f64x2_mul(image, image));
            }
            most = tl_f64x2_max(most, sum);
        }
    }
    return tl_f64x2_get_x(tl_f64x2_max(most, tl_f64x2_swap(most)));
#else
    double most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3d image = tl_frame_point(map, tl_vec3d_from(points[i]));
        const double length_sq = tl_vec3d_dot(image, image);
        most = length_sq > most ? length_sq : most;
    }
    return most;
#endif
}

#if TL_CPU_LEVELS >= 2
// Whether scans with four points in a register are there, and suit so many points.
static inline bool tl_scans_four(uint32_t count)
{
    return count >= 4 && count <= 4 * TL_SCAN_FOURS && tl_cpu_has_avx2();
}
#endif

// Of count >= 1 points; the lowest index of several that are equally far.
static inline uint32_t tl_farthest(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
#if TL_CPU_LEVELS >= 2
    if (tl_scans_four(count)) {
        return tl_scan_farthest_avx2(points, count, direction);
    }
#endif
    return tl_farthest_base(points, count, direction);
}

// The largest product itself, of count >= 4 points, along one direction or two.
static TL_ALWAYS_INLINE void tl_reach_along(const tl_vec3 *points, uint32_t count, const tl_vec3d *directions,
                                            int direction_count, double *reach)
{
#if TL_CPU_LEVELS >= 2
    if (tl_scans_four(count)) {
        tl_scan_reach_avx2(points, count, directions, direction_count, reach);
        return;
    }
#endif
    tl_reach_along_base(points, count, directions, direction_count, reach);
}

// The largest square of the length of rows * p + origin, which need be no rotation, of count >= 4 points.
static inline double tl_farthest_image_sq(const tl_vec3 *points, uint32_t count, const tl_frame *map)
{
#if TL_CPU_LEVELS >= 2
    if (tl_scans_four(count)) {
        return tl_scan_image_sq_avx2(points, count, map);
    }
#endif
    return tl_farthest_image_sq_base(points, count, map);
}

#endif
