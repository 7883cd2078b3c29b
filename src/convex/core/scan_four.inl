// SPDX-License-Identifier: MIT
//
// The scans of farthest.h with four points a register. Behind the last whole four some points are looked at again,
// which changes neither the largest nor the lowest of those that are as far. The file that includes this names the
// functions.

#include "base/lowest_bit.h"
#include "convex/core/scan_four.h"
#include "math/simd4d.h"

typedef struct four_points {
    tl_f64x4 x, y, z;
} four_points;

static inline four_points load_four(const tl_vec3 *points, uint32_t at, uint32_t count)
{
    four_points p;
    tl_f64x4_load_points(&points[at + 4 <= count ? at : count - 4].x, &p.x, &p.y, &p.z);
    return p;
}

static inline four_points four_of(tl_vec3d v)
{
    const four_points p = { tl_f64x4_all(v.x), tl_f64x4_all(v.y), tl_f64x4_all(v.z) };
    return p;
}

static inline tl_f64x4 four_dots(four_points a, four_points b)
{
    return tl_f64x4_add(tl_f64x4_add(tl_f64x4_mul(a.x, b.x), tl_f64x4_mul(a.y, b.y)), tl_f64x4_mul(a.z, b.z));
}

// The largest lane in each.
static inline tl_f64x4 four_largest(tl_f64x4 a)
{
    a = tl_f64x4_max(a, tl_f64x4_swap_halves(a));
    return tl_f64x4_max(a, tl_f64x4_swap_lanes(a));
}

// Of eight: all products stay in registers.
static inline uint32_t farthest_of_two_fours(const tl_vec3 *points, four_points d)
{
    const tl_f64x4 low = four_dots(d, load_four(points, 0, 8)), high = four_dots(d, load_four(points, 4, 8)),
                   best = four_largest(tl_f64x4_max(low, high));
    const uint32_t mask = tl_f64x4_equal(low, best) | tl_f64x4_equal(high, best) << 4;
    return mask != 0 ? tl_lowest_bit(mask) : 0; // 0: the direction is not finite
}

uint32_t TL_SCAN_FARTHEST(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
    if (count == 8) {
        return farthest_of_two_fours(points, four_of(*direction));
    }
    const four_points d = four_of(*direction);
    tl_f64x4 dots[TL_SCAN_FOURS], best = four_dots(d, load_four(points, 0, count));
    dots[0] = best;
    for (uint32_t i = 4; i < count; i += 4) {
        dots[i / 4] = four_dots(d, load_four(points, i, count));
        best = tl_f64x4_max(best, dots[i / 4]);
    }
    best = four_largest(best);
    uint32_t mask = tl_f64x4_equal(dots[0], best);
    for (uint32_t i = 4; i < count; i += 4) {
        mask |= tl_f64x4_equal(dots[i / 4], best) << (i + 4 <= count ? i : count - 4);
    }
    return mask != 0 ? tl_lowest_bit(mask) : 0; // 0: the direction is not finite
}

void TL_SCAN_REACH(const tl_vec3 *points, uint32_t count, const tl_vec3d *directions, int direction_count,
                   double *reach)
{
    const four_points first = four_of(directions[0]), second = four_of(directions[direction_count - 1]);
    tl_f64x4 most = tl_f64x4_all(-(double)INFINITY), most_second = most;
    for (uint32_t i = 0; i < count; i += 4) {
        const four_points p = load_four(points, i, count);
        most = tl_f64x4_max(most, four_dots(first, p));
        most_second = tl_f64x4_max(most_second, four_dots(second, p));
    }
    reach[direction_count - 1] = tl_f64x4_get_x(four_largest(most_second)) + 0.0;
    reach[0] = tl_f64x4_get_x(four_largest(most)) + 0.0;
}

double TL_SCAN_IMAGE_SQ(const tl_vec3 *points, uint32_t count, const tl_frame *map)
{
    const four_points rows[3] = { four_of(map->rows[0]), four_of(map->rows[1]), four_of(map->rows[2]) },
                      origin = four_of(map->origin);
    tl_f64x4 most = tl_f64x4_all(0.0);
    for (uint32_t i = 0; i < count; i += 4) {
        const four_points p = load_four(points, i, count);
        const four_points image = { tl_f64x4_add(four_dots(rows[0], p), origin.x),
                                    tl_f64x4_add(four_dots(rows[1], p), origin.y),
                                    tl_f64x4_add(four_dots(rows[2], p), origin.z) };
        most = tl_f64x4_max(most, four_dots(image, image));
    }
    return tl_f64x4_get_x(four_largest(most));
}
