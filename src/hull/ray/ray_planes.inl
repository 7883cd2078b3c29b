// SPDX-License-Identifier: MIT
//
// The planes of a hull against a ray, eight at a time: the body of ray_planes_*.c, compiled once per instruction set.
// The file defines TL_RAY_PLANES, the function's name, and includes this. All give the same bits.
//
// Short rows are read into the next ones: what those lanes hold has an infinite offset, so it is neither entered nor
// left.
//
// Each lane keeps the latest entry and the earliest exit among its planes. One division a step serves both; to compare
// fractions by cross multiplication takes as long, for it needs five registers of state instead of three.

#include "base/lowest_bit.h"
#include "hull/ray/hull_ray.h"
#include "math/simd_f64.h"

bool TL_RAY_PLANES(const tl_hull *hull, const double origin[3], const double direction[3], double max_t, double *t_out,
                   uint32_t *face_out)
{
    const double *rows = tl_hull_plane_block(hull, 0);
    const uint32_t block_count = tl_hull_plane_block_count(hull), lanes = tl_hull_plane_lanes(hull);
    const double *row_y = rows + lanes, *row_z = row_y + lanes, *offsets = row_z + lanes;
    const tl_f64x8 ox = tl_f64x8_all(origin[0]), oy = tl_f64x8_all(origin[1]), oz = tl_f64x8_all(origin[2]);
    const tl_f64x8 dx = tl_f64x8_all(direction[0]), dy = tl_f64x8_all(direction[1]), dz = tl_f64x8_all(direction[2]);
    const tl_f64x8 zero = tl_f64x8_all(0.0), one = tl_f64x8_all(1.0);
    tl_f64x8 enter = zero, leave = tl_f64x8_all(max_t), entered = zero, index = zero;
    for (uint32_t b = 0; b < block_count; b++) {
        const size_t at = 32 * (size_t)b;
        tl_f64x8 x = tl_f64x8_load(rows + at), y = tl_f64x8_load(row_y + at), z = tl_f64x8_load(row_z + at);
        tl_f64x8 depth =
            tl_f64x8_sub(tl_f64x8_load(offsets + at),
                         tl_f64x8_add(tl_f64x8_add(tl_f64x8_mul(x, ox), tl_f64x8_mul(y, oy)), tl_f64x8_mul(z, oz)));
        tl_f64x8 slope = tl_f64x8_add(tl_f64x8_add(tl_f64x8_mul(x, dx), tl_f64x8_mul(y, dy)), tl_f64x8_mul(z, dz));
        tl_mask64x8 coming = tl_f64x8_less(slope, zero), going = tl_f64x8_less(zero, slope);
        if (tl_mask64x8_any(tl_mask64x8_without(tl_f64x8_less(depth, zero), coming))) {
            return false; // in front of a plane and not coming nearer
        }
        // Where the slope is 0 this is no number, and in neither mask.
        tl_f64x8 t = tl_f64x8_div(depth, slope);
        tl_mask64x8 later = tl_mask64x8_and(coming, tl_f64x8_less(enter, t));
        enter = tl_f64x8_select(later, t, enter);
        entered = tl_f64x8_select(later, index, entered);
        leave = tl_f64x8_select(tl_mask64x8_and(going, tl_f64x8_less(t, leave)), t, leave);
        index = tl_f64x8_add(index, one);
    }
    double latest = tl_f64x8_largest(enter);
    if (latest > tl_f64x8_smallest(leave)) {
        return false;
    }
    uint32_t face = TL_NO_VERTEX;
    if (latest > 0.0) {
        // Of several faces entered at once, at an edge, the lowest.
        double blocks_entered[8];
        tl_f64x8_store(blocks_entered, entered);
        for (uint32_t first = tl_f64x8_equal(enter, tl_f64x8_all(latest)); first != 0; first &= first - 1) {
            uint32_t lane = tl_lowest_bit(first), at = 8 * (uint32_t)blocks_entered[lane] + lane;
            face = at < face ? at : face;
        }
    }
    *t_out = latest;
    *face_out = face;
    return true;
}
