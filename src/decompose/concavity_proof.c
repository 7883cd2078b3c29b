// SPDX-License-Identifier: MIT
//
// How far a hull reaches beyond the body, proven by branch and bound.
//
// The distance from the body changes by no more than the way between two points. So the distance at a cube's centre
// and the half diagonal bound it in the whole cube; the cells of the grid are the first cubes, the one of the largest
// bound is divided into eight, and cubes that a face of the hull separates from it are dropped. Samples alone, as
// other methods take them, prove nothing about what lies between them.
//
// Source: Piyavskii 1972 and Shubert 1972, for Lipschitz functions; the octree of Meagher, 1982.

#include "decompose/concavity_proof.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "decompose/hull_rows.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef struct proof_cube {
    double bound; // of what the cube holds of the hull
    tl_vec3 center;
    float half; // half a side, metres
} proof_cube;

// Of equal bounds the order does not matter to the answer, but must be the same everywhere.
static inline bool comes_first_cube(const proof_cube *a, const proof_cube *b)
{
    return a->bound != b->bound         ? a->bound > b->bound
           : a->half != b->half         ? a->half > b->half
           : a->center.z != b->center.z ? a->center.z < b->center.z
           : a->center.y != b->center.y ? a->center.y < b->center.y
                                        : a->center.x < b->center.x;
}

#define TL_HEAP(name)                 proof_queue_##name
#define TL_HEAP_ITEM                  proof_cube
#define TL_HEAP_BEFORE(context, a, b) comes_first_cube(&(a), &(b))
#include "base/heap.inl"

typedef struct concavity_proof {
    const tl_hull *hull;
    const tl_distance_grid *grid;
    const tl_concavity_goal *goal;
    const tl_allocator *allocator;
    tl_hull_rows rows;
    tl_hull_plane *planes;
    proof_cube *queue;
    uint32_t queue_count;
    uint64_t queue_capacity;
    uint32_t measured;
    double reached;
} concavity_proof;

// What is dropped: cubes that cannot raise the bound above what is known, wanted, or precise enough.
static double drop_below(const concavity_proof *p)
{
    return tl_max_f64(p->goal->enough, p->reached + p->goal->precision);
}

// How far a cube's centre lies outside of the hull, measured past the cube: > 0 when the two are apart.
static double gap_to_hull(const concavity_proof *p, tl_vec3 center, double half, bool *holds_center)
{
    double gap = -(double)INFINITY;
    *holds_center = true;
    const tl_vec3d c = tl_vec3d_from(center);
    for (uint32_t i = 0; i < p->hull->face_count && !(gap > p->grid->noise); i++) {
        const double *n = p->planes[i].normal;
        const double height = n[0] * c.x + n[1] * c.y + n[2] * c.z - p->planes[i].offset;
        *holds_center = *holds_center && height <= 0.0;
        gap = tl_max_f64(gap, height - half * (fabs(n[0]) + fabs(n[1]) + fabs(n[2])));
    }
    return gap - p->grid->noise;
}

static tl_result queue_cube(concavity_proof *p, tl_vec3 center, double half, double bound)
{
    if (p->queue_count == p->queue_capacity) {
        if (p->queue_capacity >= UINT32_MAX / 2) {
            return TL_ERR_MEMORY;
        }
        proof_cube *grown = tl_grow_array(p->allocator, p->queue, &p->queue_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        p->queue = grown;
    }
    const proof_cube cube = { bound, center, (float)half };
    proof_queue_push(p->queue, &p->queue_count, cube, NULL);
    return TL_OK;
}

// The bound in a cube around a point at `distance` from the surface, outside of the body or within it.
static double bound_around(const concavity_proof *p, double distance, bool is_inside, double half)
{
    const double reach = half * 1.7320508075688773 + p->grid->noise;
    // From inside, a way out passes the surface first, and from there it is so much shorter.
    return is_inside ? tl_max_f64(reach - distance, 0.0) : reach + distance;
}

// A cube of some size around a centre: measures there, and keeps it where it may raise the bound.
static tl_result measure_cube(concavity_proof *p, tl_vec3 center, double half)
{
    bool holds_center;
    if (gap_to_hull(p, center, half, &holds_center) > 0.0) {
        return TL_OK;
    }
    p->measured++;
    const double distance = tl_surface_distance(p->grid, center, INFINITY);
    const bool is_inside = tl_distance_grid_is_inside(p->grid, center, distance);
    if (holds_center && !is_inside) {
        p->reached = tl_max_f64(p->reached, distance - p->grid->noise);
    }
    const double bound = bound_around(p, distance, is_inside, half);
    return bound > drop_below(p) ? queue_cube(p, center, half, bound) : TL_OK;
}

static tl_result divide_cube(concavity_proof *p, const proof_cube *cube)
{
    const float quarter = cube->half * 0.5f;
    for (uint32_t i = 0; i < 8; i++) {
        const tl_vec3 center = tl_vec3_make(cube->center.x + ((i & 1u) != 0 ? quarter : -quarter),
                                            cube->center.y + ((i & 2u) != 0 ? quarter : -quarter),
                                            cube->center.z + ((i & 4u) != 0 ? quarter : -quarter));
        TL_TRY(measure_cube(p, center, (double)quarter));
    }
    return TL_OK;
}

// A cell that the hull may touch: it is queued where it may raise the bound.
static tl_result queue_cell(concavity_proof *p, uint32_t x, uint32_t y, uint32_t z)
{
    const double distance = (double)p->grid->distance[tl_distance_grid_index(p->grid, x, y, z)];
    const double half = p->grid->cell / 2.0, bound = bound_around(p, fabs(distance), distance < 0.0, half);
    return bound > drop_below(p) ? queue_cube(p, tl_distance_grid_center(p->grid, x, y, z), half, bound) : TL_OK;
}

// What the centres in one row of the hull reach.
static void reach_in_row(concavity_proof *p, uint32_t y, uint32_t z)
{
    // Half a cell from the surface and closer the grid does not say on which side a centre lies.
    const double known = p->grid->cell * 0.5001 + 4.0 * p->grid->noise;
    const tl_cell_run run = tl_hull_rows_run(&p->rows, y, z);
    const float *distance = p->grid->distance + tl_distance_grid_index(p->grid, 0, y, z);
    float largest = 0.0f;
    for (int32_t x = run.first_inside; x <= run.last_inside; x++) {
        largest = tl_max_f32(largest, distance[x]);
    }
    if ((double)largest > known) {
        p->reached = tl_max_f64(p->reached, (double)largest - p->grid->noise);
    }
}

// Most hulls that reach too far do so in many rows: every fourth comes first, both ways.
static void reach_in_rows(concavity_proof *p)
{
    for (uint32_t pass = 0; pass < 2; pass++) {
        for (uint32_t z = p->rows.low[2]; z <= p->rows.high[2]; z++) {
            for (uint32_t y = p->rows.low[1]; y <= p->rows.high[1]; y++) {
                if ((pass == 0) == (y % 4 == 0 && z % 4 == 0)) {
                    reach_in_row(p, y, z);
                }
                if (p->reached > p->goal->too_much) {
                    return;
                }
            }
        }
    }
}

static tl_result queue_rows(concavity_proof *p)
{
    for (uint32_t z = p->rows.low[2]; z <= p->rows.high[2]; z++) {
        for (uint32_t y = p->rows.low[1]; y <= p->rows.high[1]; y++) {
            const tl_cell_run run = tl_hull_rows_run(&p->rows, y, z);
            for (int32_t x = run.first; x <= run.last; x++) {
                TL_TRY(queue_cell(p, (uint32_t)x, y, z));
            }
        }
    }
    return TL_OK;
}

static tl_result divide_cubes(concavity_proof *p, tl_concavity *out)
{
    while (p->queue_count > 0 && p->measured < p->goal->budget && p->reached <= p->goal->too_much &&
           p->queue[0].bound > drop_below(p)) {
        const proof_cube cube = proof_queue_pop(p->queue, &p->queue_count, NULL);
        TL_TRY(divide_cube(p, &cube));
    }
    out->reached = p->reached;
    out->bound = drop_below(p);
    if (p->queue_count > 0) {
        out->bound = tl_max_f64(out->bound, p->queue[0].bound);
    }
    return TL_OK;
}

static tl_result prove_concavity(concavity_proof *p, tl_arena *arena, tl_concavity *out)
{
    p->planes = TL_PUSH(arena, tl_hull_plane, p->hull->face_count);
    if (p->planes == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < p->hull->face_count; i++) {
        p->planes[i] = tl_hull_face_plane(p->hull, i);
    }
    TL_TRY(tl_hull_rows_make(p->hull, p->grid, arena, &p->rows));
    reach_in_rows(p);
    if (p->reached > p->goal->too_much) {
        out->reached = p->reached;
        out->bound = (double)INFINITY;
        return TL_OK;
    }
    TL_TRY(queue_rows(p));
    return divide_cubes(p, out);
}

tl_result tl_concavity_prove(const tl_hull *hull, const tl_distance_grid *grid, const tl_concavity_goal *goal,
                             const tl_allocator *allocator, tl_concavity *concavity_out)
{
    concavity_proof p;
    memset(&p, 0, sizeof p);
    p.hull = hull;
    p.grid = grid;
    p.goal = goal;
    p.allocator = allocator;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    const tl_result result = prove_concavity(&p, &arena, concavity_out);
    tl_release_array(allocator, p.queue, p.queue_capacity, sizeof *p.queue);
    tl_arena_free(&arena);
    return result;
}
