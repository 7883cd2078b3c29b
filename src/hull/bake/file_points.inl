// SPDX-License-Identifier: MIT
//
// Points against faces, four faces at a time: the body of file_points_*.c, compiled once per instruction set. The file
// defines TL_FILE_POINTS, the function's name, and includes this. All give the same bits, the heights' too.
//
// Which of the faces a point is in front of cannot be guessed, so a loop that asks one after the other waits for a
// wrong guess at nearly each point. Here it is a bit of a mask.

#include "base/assert.h"
#include "base/lowest_bit.h"
#include "hull/bake/file_points.h"
#include "math/simd4d.h"

// The point's heights over four planes, and the faces that it is not surely behind.
static inline uint32_t faces_in_doubt(const tl_plane_block *block, tl_vec3 p, double heights[4])
{
    const tl_f64x4 x = tl_f64x4_mul(tl_f64x4_load(block->x), tl_f64x4_all((double)p.x));
    const tl_f64x4 y = tl_f64x4_mul(tl_f64x4_load(block->y), tl_f64x4_all((double)p.y));
    const tl_f64x4 z = tl_f64x4_mul(tl_f64x4_load(block->z), tl_f64x4_all((double)p.z));
    const tl_f64x4 height = tl_f64x4_sub(tl_f64x4_add(tl_f64x4_add(x, y), z), tl_f64x4_load(block->offset));
    const tl_f64x4 behind = tl_f64x4_sub(tl_f64x4_all(0.0), tl_f64x4_load(block->error));
    tl_f64x4_store(heights, height);
    return ~tl_f64x4_less(height, behind) & 15u;
}

// Whether a point is in front of a face; exact. Its height is that of the lane.
static inline bool is_in_front(const tl_quickhull *hull, const tl_filing *filing, uint32_t block, uint32_t lane,
                               tl_vec3 position, double *height)
{
    return *height > filing->blocks[block].error[lane] ||
           tl_quickhull_side(hull, &hull->faces[filing->faces[4 * block + lane]], position, height) > 0;
}

static inline bool file_under_farthest(tl_quickhull *hull, const tl_filing *filing, uint32_t point)
{
    const tl_vec3 position = hull->local[point].position;
    uint32_t best = TL_NONE;
    double best_distance = 0.0, best_height = 0.0;
    for (uint32_t b = 0; b < filing->block_count; b++) {
        double heights[4];
        for (uint32_t left = faces_in_doubt(&filing->blocks[b], position, heights); left != 0; left &= left - 1) {
            const uint32_t lane = tl_lowest_bit(left);
            double height = heights[lane];
            if (is_in_front(hull, filing, b, lane, position, &height)) {
                const double distance = tl_filing_distance(height, filing->blocks[b].length[lane]);
                const bool is_farther = best == TL_NONE || distance > best_distance;
                best = is_farther ? filing->faces[4 * b + lane] : best;
                best_height = is_farther ? height : best_height;
                best_distance = is_farther ? distance : best_distance;
            }
        }
    }
    if (best != TL_NONE) {
        tl_file_under(hull, best, point, best_height);
    }
    return best != TL_NONE;
}

static inline bool file_under_first(tl_quickhull *hull, const tl_filing *filing, uint32_t point)
{
    const tl_vec3 position = hull->local[point].position;
    for (uint32_t b = 0; b < filing->block_count; b++) {
        double heights[4];
        for (uint32_t left = faces_in_doubt(&filing->blocks[b], position, heights); left != 0; left &= left - 1) {
            const uint32_t lane = tl_lowest_bit(left);
            double height = heights[lane];
            if (is_in_front(hull, filing, b, lane, position, &height)) {
                tl_file_under(hull, filing->faces[4 * b + lane], point, height);
                return true;
            }
        }
    }
    return false;
}

tl_result TL_FILE_POINTS(tl_quickhull *hull, const tl_filing *filing, uint32_t first)
{
    for (uint32_t p = first, next; p != TL_NONE; p = next) {
        next = hull->local[p].next;
        TL_TRY(tl_quickhull_count_work(hull, 1));
        const bool is_outside = p != filing->eye && (hull->each_farthest ? file_under_farthest(hull, filing, p)
                                                                         : file_under_first(hull, filing, p));
        hull->waiting -= !is_outside && p < hull->point_count; // inside, or on the surface
    }
    return TL_OK;
}
