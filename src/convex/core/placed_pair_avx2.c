// SPDX-License-Identifier: MIT
//
// placed_pair.c for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#include "base/lowest_bit.h"
#include "convex/core/placed_pair.h"
#include "math/simd4d.h"

typedef struct four_places {
    tl_f64x4 x, y, z;
} four_places;

static inline four_places load_vertices(tl_vertex_row row, uint32_t from)
{
    four_places p;
    tl_f64x4_load_points(&row.points[from].x, &p.x, &p.y, &p.z);
    return p;
}

static inline void store_places(tl_placed_hull *hull, uint32_t from, four_places p)
{
    tl_f64x4_store(&hull->x[from], p.x);
    tl_f64x4_store(&hull->y[from], p.y);
    tl_f64x4_store(&hull->z[from], p.z);
}

static inline tl_f64x4 place_dots(tl_f64x4 x, tl_f64x4 y, tl_f64x4 z, four_places p)
{
    return tl_f64x4_add(tl_f64x4_add(tl_f64x4_mul(x, p.x), tl_f64x4_mul(y, p.y)), tl_f64x4_mul(z, p.z));
}

static inline tl_f64x4 place_images(tl_vec3d row, double origin, four_places p)
{
    return tl_f64x4_add(place_dots(tl_f64x4_all(row.x), tl_f64x4_all(row.y), tl_f64x4_all(row.z), p),
                        tl_f64x4_all(origin));
}

void tl_placed_pair_set_avx2(tl_placed_pair *pair, tl_vertex_row a, tl_vertex_row b, const tl_frame *b_to_a)
{
    store_places(&pair->a, 0, load_vertices(a, 0));
    store_places(&pair->a, 4, load_vertices(a, a.count - 4));
    for (uint32_t k = 0; k < 8; k += 4) {
        const four_places p = load_vertices(b, k == 0 ? 0 : b.count - 4);
        const four_places image = { place_images(b_to_a->rows[0], b_to_a->origin.x, p),
                                    place_images(b_to_a->rows[1], b_to_a->origin.y, p),
                                    place_images(b_to_a->rows[2], b_to_a->origin.z, p) };
        store_places(&pair->b, k, image);
    }
    pair->a.spare = 8 - a.count;
    pair->b.spare = 8 - b.count;
}

static inline tl_f64x4 largest_of_both(tl_f64x4 a, tl_f64x4 b)
{
    a = tl_f64x4_max(a, b);
    a = tl_f64x4_max(a, tl_f64x4_swap_halves(a));
    return tl_f64x4_max(a, tl_f64x4_swap_lanes(a));
}

static inline uint32_t farthest_of_eight_places(const tl_placed_hull *hull, tl_f64x4 x, tl_f64x4 y, tl_f64x4 z)
{
    const four_places low = { tl_f64x4_load(hull->x), tl_f64x4_load(hull->y), tl_f64x4_load(hull->z) },
                      high = { tl_f64x4_load(hull->x + 4), tl_f64x4_load(hull->y + 4), tl_f64x4_load(hull->z + 4) };
    const tl_f64x4 low_dots = place_dots(x, y, z, low), high_dots = place_dots(x, y, z, high),
                   best = largest_of_both(low_dots, high_dots);
    // Bit 8: none of a direction that is not finite.
    return tl_lowest_bit(tl_f64x4_equal(low_dots, best) | tl_f64x4_equal(high_dots, best) << 4 | 256u) & 7u;
}

uint32_t tl_placed_pair_support_avx2(const tl_placed_pair *pair, double x, double y, double z)
{
    return farthest_of_eight_places(&pair->a, tl_f64x4_all(x), tl_f64x4_all(y), tl_f64x4_all(z)) << 3 |
           farthest_of_eight_places(&pair->b, tl_f64x4_all(-x), tl_f64x4_all(-y), tl_f64x4_all(-z));
}

#include "math/simd_target_end.h"
#endif
