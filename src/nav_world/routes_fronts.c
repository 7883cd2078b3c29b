// SPDX-License-Identifier: MIT
//
// Lengths between gates over cells of the tree, from the places and blocks up: the customization of a contraction
// hierarchy, with dense matrices, as a multifrontal elimination has them (Duff, Reid, 1983). Over a grid of n places
// that is about 8 lengths a place and doubling, O(n log n), made in O(n^1.5).
//
// `upper` of a gate of the separator to a gate of the cell: the shortest way from gate to gate through their middles
// within the cell. `lower`: the same, over lengths below those from any point of a gate to any of the other. Both are
// closed over the separator, so that a query passes each separator once.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_world/routes.h"

#include <math.h>
#include <string.h>

typedef struct front_work {
    const tl_route_tree *tree;
    const tl_nav_world *world;
    float *lengths;
    double **between; // of each cell: rim x rim, NULL where it is not there, or no more
    bool is_lower;
} front_work;

// A gate of the rim of a cell in the rim of the child that has it.
typedef struct rim_origin {
    uint32_t child, index;
} rim_origin;

static void free_between(front_work *work, uint32_t cell)
{
    const uint64_t rim = work->tree->cells[cell].rim_count;
    tl_release_array(&work->tree->allocator, work->between[cell], rim * rim, sizeof(double));
    work->between[cell] = NULL;
}

static bool make_between(front_work *work, uint32_t cell)
{
    const uint64_t rim = work->tree->cells[cell].rim_count;
    work->between[cell] = tl_allocate_array(&work->tree->allocator, rim * rim, sizeof(double));
    return work->between[cell] != NULL;
}

// A length that no shorter path has, from the shortest one between the middles: to any other point of a gate it is at
// most half the gate's length farther. What a straight line takes is another such length.
static double least_length(const front_work *work, const tl_nav_gate *a, const tl_nav_gate *b, double length)
{
    const tl_nav_world *world = work->world;
    if (length == (double)INFINITY) {
        return length;
    }
    // The base length is rounded up, by a slack for the coordinates of a block.
    const double reach = (double)work->tree->block * (double)world->tile_size * (double)world->cell_size;
    const double walked = length * (1.0 - 0x1p-22) - 2.0 * tl_route_slack(reach) -
                          0.5 * (tl_nav_gate_length(a, world) + tl_nav_gate_length(b, world));
    const double straight = tl_nav_gate_distance(a, b, world);
    return walked > straight ? walked : straight;
}

// Of a place or a block, from its base lengths.
static void begin_between(front_work *work, uint32_t number)
{
    const tl_route_tree *tree = work->tree;
    const tl_route_cell *cell = &tree->cells[number];
    const uint32_t *rim = tl_route_rim(tree, cell);
    double *out = work->between[number];
    for (uint32_t i = 0; i < cell->rim_count; i++) {
        for (uint32_t j = 0; j < cell->rim_count; j++) {
            double length = 0.0;
            if (i != j) {
                length = (double)work->lengths[cell->base + tl_route_pair(i, j)];
                length =
                    work->is_lower ? least_length(work, &tree->gates[rim[i]], &tree->gates[rim[j]], length) : length;
            }
            out[(size_t)i * cell->rim_count + j] = length;
        }
    }
}

static void find_origins(const tl_route_tree *tree, const tl_route_cell *cell, rim_origin *origins)
{
    const uint32_t *rim = tl_route_rim(tree, cell);
    for (uint32_t k = 0; k < 2; k++) {
        const tl_route_cell *child = &tree->cells[cell->child[k]];
        const uint32_t *of_child = tl_route_rim(tree, child);
        uint32_t at = 0;
        for (uint32_t i = cell->gate_count; i < child->rim_count; i++) {
            while (rim[at] != of_child[i]) {
                at++;
            }
            const rim_origin origin = { k, i };
            origins[at] = origin;
        }
    }
}

// out[j] = min(out[j], length + row[j])
static void relax(double *out, double length, const double *row, uint64_t count)
{
    for (uint64_t j = 0; j < count; j++) {
        const double sum = length + row[j];
        out[j] = sum < out[j] ? sum : out[j];
    }
}

// The front of a cell in double: separator x (separator, then rim).
static void eliminate(const front_work *work, const tl_route_cell *cell, const rim_origin *origins, double *front)
{
    const tl_route_tree *tree = work->tree;
    const uint64_t gates = cell->gate_count, rim = cell->rim_count, width = gates + rim;
    const uint64_t rims[2] = { tree->cells[cell->child[0]].rim_count, tree->cells[cell->child[1]].rim_count };
    const double *of[2] = { work->between[cell->child[0]], work->between[cell->child[1]] };
    for (uint64_t u = 0; u < gates; u++) {
        double *row = front + u * width;
        for (uint64_t v = 0; v < gates; v++) {
            const double a = of[0][u * rims[0] + v], b = of[1][u * rims[1] + v];
            row[v] = a < b ? a : b;
        }
        for (uint64_t j = 0; j < rim; j++) {
            row[gates + j] = of[origins[j].child][u * rims[origins[j].child] + origins[j].index];
        }
    }
    // Floyd and Warshall's closure over the separator, with the columns of the rim at once.
    for (uint64_t w = 0; w < gates; w++) {
        const double *through = front + w * width;
        for (uint64_t u = 0; u < gates; u++) {
            const double length = front[u * width + w];
            if (u != w && length < (double)INFINITY) {
                relax(front + u * width, length, through, width);
            }
        }
    }
}

// Between the gates of the rim, through either child or over the separator.
static void join_between(const front_work *work, const tl_route_cell *cell, const rim_origin *origins,
                         const double *front, double *out)
{
    const tl_route_tree *tree = work->tree;
    const uint64_t gates = cell->gate_count, rim = cell->rim_count, width = gates + rim;
    for (uint64_t i = 0; i < rim; i++) {
        const rim_origin from = origins[i];
        const uint64_t child_rim = tree->cells[cell->child[from.child]].rim_count;
        const double *row = work->between[cell->child[from.child]] + from.index * child_rim;
        double *to = out + i * rim;
        for (uint64_t j = 0; j < rim; j++) {
            to[j] = origins[j].child == from.child ? row[origins[j].index] : (double)INFINITY;
        }
        for (uint64_t u = 0; u < gates; u++) {
            if (row[u] < (double)INFINITY) {
                relax(to, row[u], front + u * width + gates, rim);
            }
        }
    }
}

// Sums of at most 2^20 doubles are off by less than 2^-32 of them.
static float round_length(double length, bool down)
{
    return down ? tl_route_round_down(length * (1.0 - 0x1p-32)) : tl_route_round_up(length * (1.0 + 0x1p-32));
}

static tl_result join_cell(front_work *work, uint32_t number)
{
    const tl_route_tree *tree = work->tree;
    const tl_route_cell *cell = &tree->cells[number];
    const uint64_t width = (uint64_t)cell->gate_count + cell->rim_count, size = cell->gate_count * width;
    double *front = tl_allocate_array(&tree->allocator, size, sizeof *front);
    rim_origin *origins = tl_allocate_array(&tree->allocator, cell->rim_count, sizeof *origins);
    const bool fits = front != NULL && origins != NULL && make_between(work, number);
    if (fits) {
        find_origins(tree, cell, origins);
        eliminate(work, cell, origins, front);
        join_between(work, cell, origins, front, work->between[number]);
        float *out = work->lengths + (work->is_lower ? cell->lower : cell->upper);
        for (uint64_t i = 0; i < size; i++) {
            out[i] = round_length(front[i], work->is_lower);
        }
        free_between(work, cell->child[0]);
        free_between(work, cell->child[1]);
    }
    tl_release_array(&tree->allocator, front, size, sizeof *front);
    tl_release_array(&tree->allocator, origins, cell->rim_count, sizeof *origins);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

static tl_result fill_cell(front_work *work, uint32_t number)
{
    const tl_route_cell *cell = &work->tree->cells[number];
    const bool is_within = !cell->is_above && !cell->is_block;
    if (work->is_lower && is_within) {
        return TL_OK;
    }
    if (!cell->is_leaf && (!work->is_lower || cell->is_above)) {
        TL_TRY(join_cell(work, number));
    }
    if (cell->is_leaf || cell->is_block) {
        // What was joined within a block is no shorter than what was searched.
        free_between(work, number);
        if (!make_between(work, number)) {
            return TL_ERR_MEMORY;
        }
        begin_between(work, number);
    }
    return TL_OK;
}

tl_result tl_route_fill_fronts(const tl_route_tree *tree, const tl_nav_world *world, const tl_host *host,
                               float *lengths)
{
    front_work work = { tree, world, lengths, NULL, false };
    tl_result result = TL_OK;
    work.between = tl_allocate_array(&tree->allocator, tree->cell_count, sizeof *work.between);
    if (work.between == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(work.between, 0, tree->cell_count * sizeof *work.between);
    for (uint32_t pass = 0; result == TL_OK && pass < 2; pass++) {
        work.is_lower = pass == 1;
        for (uint32_t i = 0; result == TL_OK && i < tree->cell_count; i++) {
            result = tl_progress_update(host, "routes: join cells", i + (uint64_t)pass * tree->cell_count,
                                        2 * (uint64_t)tree->cell_count);
            if (result == TL_OK) {
                result = fill_cell(&work, i);
            }
        }
        for (uint32_t i = 0; i < tree->cell_count; i++) {
            free_between(&work, i);
        }
    }
    tl_release_array(&tree->allocator, work.between, tree->cell_count, sizeof *work.between);
    if (result == TL_OK) {
        result = tl_progress_update(host, "routes: join cells", 2 * (uint64_t)tree->cell_count,
                                    2 * (uint64_t)tree->cell_count);
    }
    return result;
}
