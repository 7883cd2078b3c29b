// SPDX-License-Identifier: MIT
//
// The loops of triangle_block.h, compiled once per instruction set as TL_BLOCK_QUESTIONS.
//
// Choices are between constants: where one is between sums, compilers make a branch of it, and no vectors.

#include "nav_bake/voxels/triangle_block.h"
#include "nav_bake/voxels/voxel_walk.h"

#include <math.h>

// As tl_min_f64 and tl_max_f64, as compilers make vectors of them.
static inline double block_min(double a, double b)
{
    return b < a ? b : a;
}

static inline double block_max(double a, double b)
{
    return b > a ? b : a;
}

#define EACH_TRIANGLE(i) for (uint32_t i = 0; i < TL_TRIANGLE_BLOCK; i++)

// As tl_lattice_map_x.
static inline void block_map_across(const float *restrict metres, double origin, double per_cell, double first_column,
                                    double *restrict lattice)
{
    EACH_TRIANGLE(i)
    {
        lattice[i] = tl_round_to_subdivision(((double)metres[i] - origin) * per_cell) - first_column;
    }
}

static inline void block_map_up(const float *restrict metres, double origin, double per_height,
                                double *restrict lattice)
{
    EACH_TRIANGLE(i)
    {
        lattice[i] = ((double)metres[i] - origin) * per_height;
    }
}

// As tl_triangle_is_walkable, where the floats are long enough and the slope is not at the limit.
static inline void block_judge_slopes(float slope_cos, tl_triangle_block *block)
{
    const float steep = TL_SLOPE_STEEP, walkable = TL_SLOPE_WALKABLE, undecided = TL_SLOPE_UNDECIDED;
    const float cos_square = slope_cos * slope_cos;
    const float *restrict ax = block->metres[0][0], *restrict bx = block->metres[0][1],
                          *restrict cx = block->metres[0][2], *restrict ay = block->metres[1][0],
                          *restrict by = block->metres[1][1], *restrict cy = block->metres[1][2],
                          *restrict az = block->metres[2][0], *restrict bz = block->metres[2][1],
                          *restrict cz = block->metres[2][2];
    int32_t *restrict slope = block->slope;
    EACH_TRIANGLE(i)
    {
        const float ux = bx[i] - ax[i], uy = by[i] - ay[i], uz = bz[i] - az[i];
        const float vx = cx[i] - ax[i], vy = cy[i] - ay[i], vz = cz[i] - az[i];
        const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const float square = nx * nx + ny * ny + nz * nz;
        const float have = ny * ny, needed = cos_square * square, noise = 1e-5f * needed;
        float answer = have > needed ? walkable : steep;
        answer = ny > 0.0f ? answer : steep;
        const float near_limit = have < needed + noise ? undecided : answer;
        answer = have > needed - noise ? near_limit : answer;
        answer = square >= 1e-20f ? answer : undecided;
        answer = square <= 1e30f ? answer : undecided;
        slope[i] = (int32_t)answer;
    }
}

static void block_map_corners(const tl_lattice_map *map, float slope_cos, tl_triangle_block *block)
{
    for (uint32_t corner = 0; corner < 3; corner++) {
        block_map_across(block->metres[0][corner], map->origin_x, map->per_cell, map->first_x,
                         block->lattice[0][corner]);
        block_map_up(block->metres[1][corner], map->origin_y, map->per_height, block->lattice[1][corner]);
        block_map_across(block->metres[2][corner], map->origin_z, map->per_cell, map->first_z,
                         block->lattice[2][corner]);
    }
    block_judge_slopes(slope_cos, block);
}

// How far the triangles reach on an axis.
typedef struct block_reach {
    double min[TL_TRIANGLE_BLOCK], max[TL_TRIANGLE_BLOCK];
} block_reach;

static inline void find_block_reach(double corner[3][TL_TRIANGLE_BLOCK], block_reach *reach)
{
    const double *restrict a = corner[0], *restrict b = corner[1], *restrict c = corner[2];
    double *restrict min = reach->min, *restrict max = reach->max;
    EACH_TRIANGLE(i)
    {
        min[i] = block_min(a[i], block_min(b[i], c[i]));
        max[i] = block_max(a[i], block_max(b[i], c[i]));
    }
}

// A wall exactly on the field's far side moves half a cell inwards.
static inline void close_block_side(double side, double corner[3][TL_TRIANGLE_BLOCK], block_reach *reach)
{
    double inwards[TL_TRIANGLE_BLOCK];
    EACH_TRIANGLE(i)
    {
        inwards[i] = fabs(reach->max[i] - side) + fabs(reach->min[i] - side) > 0.0 ? 0.0 : 0.5;
    }
    EACH_TRIANGLE(i)
    {
        corner[0][i] -= inwards[i];
        corner[1][i] -= inwards[i];
        corner[2][i] -= inwards[i];
        reach->min[i] -= inwards[i];
        reach->max[i] -= inwards[i];
    }
}

// The cells of a band, `count` from `begin` on, that the triangles overlap on an axis, as tl_voxel_cell_range has them.
static inline void find_block_cells(const block_reach *reach, double begin, double count, int32_t *restrict first,
                                    int32_t *restrict last)
{
    const double in_last = count - 0.5;
    EACH_TRIANGLE(i)
    {
        const double min = reach->min[i] - begin, max = reach->max[i] - begin;
        const int32_t from = (int32_t)block_min(block_max(min, 0.0), count);
        const int32_t to = (int32_t)block_min(block_max(max, 0.0), in_last);
        // What is only touched is not overlapped, but a single point on a border lies in the higher cell.
        const double least_gap = min < max ? 0.0 : 0.5 / TL_SUBDIVISIONS;
        first[i] = from;
        last[i] = (double)to - max >= least_gap ? to - 1 : to;
    }
}

// Adds to the place: `one` of those within one cell of the lattice, `before` and `behind` of those that reach out of
// the band. What begins before the band and overlaps it overlaps two cells.
static inline void find_block_sides(const block_reach *reach, double begin, double count, double one, double before,
                                    double behind, const int32_t *restrict first, double *restrict place)
{
    EACH_TRIANGLE(i)
    {
        const double min = reach->min[i] - begin, max = reach->max[i] - begin;
        const double in_one = block_min(min, (double)first[i] + 1.0 - max) >= 0.0 ? one : 0.0;
        place[i] += in_one + (min >= 0.0 ? 0.0 : before) + (max < count ? 0.0 : behind);
    }
}

// The voxels of the triangles' heights, as tl_voxel_span_of_heights has them.
static inline void find_block_voxels(double height_voxels, tl_triangle_block *block, double *restrict place)
{
    const double *restrict ay = block->lattice[1][0], *restrict by = block->lattice[1][1],
                           *restrict cy = block->lattice[1][2];
    const double limit = height_voxels * TL_SUBDIVISIONS, least = -TL_SUBDIVISIONS, most = limit + TL_SUBDIVISIONS;
    const int32_t whole_limit = (int32_t)limit;
    int32_t *restrict min = block->min, *restrict max = block->max;
    EACH_TRIANGLE(i)
    {
        const double low = block_min(ay[i], block_min(by[i], cy[i]));
        const double high = block_max(ay[i], block_max(by[i], cy[i]));
        const double low_in = block_min(block_max(low * TL_SUBDIVISIONS, least), most);
        const double high_in = block_min(block_max(high * TL_SUBDIVISIONS, least), most);
        const int32_t bottom = (int32_t)((low_in + TL_WHOLE_ROUNDER) - TL_WHOLE_ROUNDER);
        const int32_t top = (int32_t)((high_in + TL_WHOLE_ROUNDER) - TL_WHOLE_ROUNDER);
        const int32_t first = (bottom > 0 ? bottom : 0) >> TL_SUBDIVISION_BITS;
        const int32_t end = ((top < whole_limit ? top : whole_limit) + TL_SUBDIVISIONS - 1) >> TL_SUBDIVISION_BITS;
        const int32_t outside = (top < 0) | (bottom > whole_limit);
        min[i] = first;
        max[i] = outside != 0 ? 0 : end > first ? end : first + 1;
        const int32_t level =
            (bottom >= 0) & (top <= whole_limit) & (bottom >> TL_SUBDIVISION_BITS == top >> TL_SUBDIVISION_BITS);
        const double inside = block_min(low, height_voxels - high) >= 0.0 ? (double)TL_PLACE_INSIDE : 0.0;
        place[i] = (double)(level * TL_PLACE_LEVEL) + inside;
    }
}

static void block_place_triangles(const tl_voxel_band *band, tl_triangle_block *block)
{
    const double width = (double)band->width, first_row = (double)band->first_row, rows = (double)band->row_count;
    block_reach x, z;
    double place[TL_TRIANGLE_BLOCK];
    find_block_reach(block->lattice[0], &x);
    find_block_reach(block->lattice[2], &z);
    if (band->closed_far_side) {
        close_block_side(width, block->lattice[0], &x);
        close_block_side((double)band->field_height, block->lattice[2], &z);
    }
    find_block_voxels((double)band->height_voxels, block, place);
    find_block_cells(&x, 0.0, width, block->first_x, block->last_x);
    find_block_cells(&z, first_row, rows, block->first_z, block->last_z);
    find_block_sides(&x, 0.0, width, TL_PLACE_ONE_COLUMN, TL_PLACE_BEFORE, TL_PLACE_BEHIND, block->first_x, place);
    find_block_sides(&z, first_row, rows, TL_PLACE_ONE_ROW, 0.0, 0.0, block->first_z, place);
    EACH_TRIANGLE(i)
    {
        block->place[i] = (int32_t)place[i];
    }
}

const tl_block_questions TL_BLOCK_QUESTIONS = { block_map_corners, block_place_triangles };

#undef EACH_TRIANGLE
