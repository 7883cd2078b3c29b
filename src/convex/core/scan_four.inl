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
    // Both at once: compilers read them as one vector, which would wait for two numbers that were stored one by one.
    const tl_f64x2 both = tl_f64x2_add(tl_f64x4_largest_of_two(most, most_second), tl_f64x2_all(0.0));
    if (direction_count == 2) {
        tl_f64x2_store(reach, both);
    } else {
        *reach = tl_f64x2_get_x(both);
    }
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

static inline four_points four_image(const four_points rows[3], four_points origin, four_points p)
{
    const four_points image = { tl_f64x4_add(four_dots(rows[0], p), origin.x),
                                tl_f64x4_add(four_dots(rows[1], p), origin.y),
                                tl_f64x4_add(four_dots(rows[2], p), origin.z) };
    return image;
}

static inline four_points four_sub(four_points a, four_points b)
{
    const four_points r = { tl_f64x4_sub(a.x, b.x), tl_f64x4_sub(a.y, b.y), tl_f64x4_sub(a.z, b.z) };
    return r;
}

static inline four_points four_vertices(const tl_vec3 *row, const uint16_t (*pairs)[2], int side)
{
    const uint32_t at[4] = { pairs[0][side], pairs[1][side], pairs[2][side], pairs[3][side] };
    four_points p;
    tl_f64x4_gather_points(&row->x, at, &p.x, &p.y, &p.z);
    return p;
}

// Whether all four pairs have vertices; a branch for all of them.
static inline bool are_in_rows(const uint16_t (*pairs)[2], uint32_t count_a, uint32_t count_b)
{
    uint32_t beyond = 0;
    for (int k = 0; k < 4; k++) {
        beyond |= (uint32_t)(pairs[k][0] >= count_a) | (uint32_t)(pairs[k][1] >= count_b);
    }
    return beyond == 0;
}

bool TL_SCAN_PLACE(const tl_frame *b_to_a, tl_vertex_row row_a, tl_vertex_row row_b, const uint16_t (*vertices)[2],
                   uint32_t count, tl_placed_points *points)
{
    const four_points rows[3] = { four_of(b_to_a->rows[0]), four_of(b_to_a->rows[1]), four_of(b_to_a->rows[2]) },
                      origin = four_of(b_to_a->origin);
    for (uint32_t i = 0; i < count; i += 4) {
        const uint32_t at = i + 4 <= count ? i : count - 4;
        if (!are_in_rows(vertices + at, row_a.count, row_b.count)) {
            return false;
        }
        const four_points on_b = four_image(rows, origin, four_vertices(row_b.points, vertices + at, 1)),
                          w = four_sub(four_vertices(row_a.points, vertices + at, 0), on_b);
        tl_f64x4_store(&points->x[at], w.x);
        tl_f64x4_store(&points->y[at], w.y);
        tl_f64x4_store(&points->z[at], w.z);
    }
    return true;
}

static inline four_points corners_of_four(const tl_placed_points *points, const uint8_t (*faces)[3], int corner)
{
    const uint32_t at[4] = { faces[0][corner], faces[1][corner], faces[2][corner], faces[3][corner] };
    const four_points p = { tl_f64x4_gather(points->x, at), tl_f64x4_gather(points->y, at),
                            tl_f64x4_gather(points->z, at) };
    return p;
}

static inline tl_f64x4 four_minor(tl_f64x4 a, tl_f64x4 b, tl_f64x4 c, tl_f64x4 d)
{
    return tl_f64x4_sub(tl_f64x4_mul(a, b), tl_f64x4_mul(c, d));
}

// The first of the faces that is as near as the least.
static inline uint32_t first_nearest(const tl_f64x4 *fours, uint32_t count, tl_f64x4 least)
{
    uint64_t mask = 0;
    for (uint32_t i = 0; i < count; i += 4) {
        mask |= (uint64_t)tl_f64x4_equal(fours[i / 4], least) << (i + 4 <= count ? i : count - 4);
    }
    return mask != 0 && tl_f64x4_get_x(least) > 0.0 ? tl_lowest_bit(mask) : count;
}

uint32_t TL_SCAN_NEAREST(const tl_placed_points *points, const uint8_t (*corners)[3], uint32_t count, double turned,
                         double *nearness)
{
    const tl_f64x4 turned_four = tl_f64x4_all(turned), zero = tl_f64x4_all(0.0);
    // Besides in `nearness`, where the last four lie over those before: a load of what two stores wrote waits for both.
    tl_f64x4 fours[TL_KEPT_FACES / 4 + 1], least = tl_f64x4_all((double)INFINITY);
    for (uint32_t i = 0; i < count; i += 4) {
        const uint32_t at = i + 4 <= count ? i : count - 4; // of the last four some may be computed again
        const four_points last = corners_of_four(points, corners + at, 2),
                          p = four_sub(corners_of_four(points, corners + at, 0), last),
                          q = four_sub(corners_of_four(points, corners + at, 1), last);
        const four_points normal = { four_minor(p.y, q.z, p.z, q.y), four_minor(p.z, q.x, p.x, q.z),
                                     four_minor(p.x, q.y, p.y, q.x) };
        const tl_f64x4 offset = tl_f64x4_sub(four_dots(normal, last), turned_four),
                       size = tl_f64x4_max(offset, tl_f64x4_sub(zero, offset)),
                       near_four = tl_f64x4_div(tl_f64x4_mul(offset, size), four_dots(normal, normal));
        tl_f64x4_store(&nearness[at], near_four);
        fours[i / 4] = near_four;
        least = tl_f64x4_min(near_four, least);
    }
    least = tl_f64x4_min(least, tl_f64x4_swap_halves(least));
    return first_nearest(fours, count, tl_f64x4_min(least, tl_f64x4_swap_lanes(least)));
}

static inline tl_f64x4 four_planes(const double *rows, uint32_t lanes, four_points d)
{
    const four_points normals = { tl_f64x4_load(rows), tl_f64x4_load(rows + lanes),
                                  tl_f64x4_load(rows + 2 * (size_t)lanes) };
    return four_dots(d, normals);
}

uint32_t TL_SCAN_FACES(const double *blocks, uint32_t count, uint32_t lanes, const tl_vec3d *direction)
{
    const four_points d = four_of(*direction);
    const uint32_t second = lanes - 4; // of six lanes two are looked at twice
    tl_f64x4 dots[TL_SCAN_PLANES / 4], best = tl_f64x4_all(-2.0);
    for (uint32_t i = 0; i < count; i += 8) {
        const double *rows = blocks + 4 * (size_t)i;
        tl_f64x4 *two = &dots[i / 4];
        two[0] = four_planes(rows, lanes, d);
        two[1] = four_planes(rows + second, lanes, d);
        best = tl_f64x4_max(best, tl_f64x4_max(two[0], two[1]));
    }
    best = four_largest(best);
    uint64_t mask = 0;
    for (uint32_t i = 0; i < count; i += 8) {
        mask |= (uint64_t)(tl_f64x4_equal(dots[i / 4], best) | tl_f64x4_equal(dots[i / 4 + 1], best) << second) << i;
    }
    return mask != 0 ? tl_lowest_bit(mask) : 0;
}
