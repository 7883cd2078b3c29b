// SPDX-License-Identifier: MIT
//
// From lengths to the gates of a route: each length is one that was added up from two others, or one of a place or a
// block, and those two are found by looking for the least sum again.
//
// Lengths stand in the file rounded up, so sums are not met exactly: the least one is taken, whatever it is. Pieces
// grow shorter with each step; what an odd file keeps from growing shorter is left in one piece, which is a way all the
// same.

#include "base/assert.h"
#include "nav_world/router.h"

#include <math.h>
#include <string.h>

enum { MAX_PIECES = 256 };

void tl_route_write_point(tl_route_writer *writer, const double point[3], double length)
{
    if (writer->count < writer->capacity) {
        const tl_nav_world_route_point out = {
            { point[0], point[1], point[2] }, length, writer->place[0], writer->place[1]
        };
        writer->points[writer->count] = out;
    }
    writer->count++;
    writer->length = length;
}

void tl_route_write_gate(tl_route_writer *writer, const tl_nav_gate *gate, double length)
{
    const tl_nav_world *world = writer->world;
    double middle[2], point[3];
    tl_nav_gate_middle(gate, world, 0, 0, middle);
    const double at[3] = { middle[0] + (double)world->lattice_origin.x, (double)gate->height,
                           middle[1] + (double)world->lattice_origin.z };
    tl_nav_world_from_file(world, at, point);
    writer->place[0] = gate->x;
    writer->place[1] = gate->z;
    tl_route_write_point(writer, point, length);
}

// The route goes on from the gate that was written last within a cell: into the gate's place there.
static void go_on_within(const tl_route_tree *tree, uint32_t cell, uint32_t gate, tl_route_writer *writer)
{
    const tl_nav_gate *from = &tree->gates[gate];
    const uint32_t place = tl_route_find_place(tree, from->x, from->z);
    int32_t at[2] = { from->x, from->z };
    if (cell != TL_ROUTE_NO_CELL && place - tree->cells[cell].first_place >= tree->cells[cell].place_count) {
        tl_nav_gate_across(from, at);
    }
    if (writer->count <= writer->capacity) {
        writer->points[writer->count - 1].tile_x = at[0];
        writer->points[writer->count - 1].tile_z = at[1];
    }
}

// ---------------------------------------------------------------------------------------------------------
// Pieces between two gates.

typedef struct piece_split {
    uint32_t cell, through; // over this gate of the cell's separator; UINT32_MAX: not at all
    float length;
} piece_split;

static uint32_t front_column(const tl_route_tree *tree, const tl_route_cell *cell, uint32_t gate)
{
    if (gate - cell->first_gate < cell->gate_count) {
        return gate - cell->first_gate;
    }
    const uint32_t index = tl_route_rim_index(tree, cell, gate);
    return index == UINT32_MAX ? UINT32_MAX : cell->gate_count + index;
}

// Over the gate of the separator with the least sum; only sums of two parts shorter than `most`.
static void split_over_separator(const tl_world_routes *routes, uint32_t number, uint32_t from, uint32_t to, float most,
                                 piece_split *best)
{
    const tl_route_cell *cell = &routes->tree.cells[number];
    const uint32_t a = front_column(&routes->tree, cell, from), b = front_column(&routes->tree, cell, to);
    const uint64_t width = (uint64_t)cell->gate_count + cell->rim_count;
    const float *row = routes->lengths + cell->upper;
    if (a == UINT32_MAX || b == UINT32_MAX) {
        return;
    }
    for (uint32_t w = 0; w < cell->gate_count; w++, row += width) {
        const float sum = row[a] + row[b];
        if (w != a && w != b && row[a] < most && row[b] < most && sum < best->length) {
            const piece_split split = { number, cell->first_gate + w, sum };
            *best = split;
        }
    }
}

// The shortest way between two gates of the rim of a cell, within it: down through the children that have both.
static piece_split split_within(const tl_world_routes *routes, uint32_t number, uint32_t from, uint32_t to)
{
    const tl_route_tree *tree = &routes->tree;
    piece_split best = { TL_ROUTE_NO_CELL, UINT32_MAX, INFINITY };
    while (number != TL_ROUTE_NO_CELL) {
        const tl_route_cell *cell = &tree->cells[number];
        const uint32_t i = tl_route_rim_index(tree, cell, from), j = tl_route_rim_index(tree, cell, to);
        if (i == UINT32_MAX || j == UINT32_MAX || i == j) {
            break;
        }
        if (cell->is_leaf || cell->is_block) {
            const float length = routes->lengths[cell->base + tl_route_pair(i, j)];
            if (length <= best.length) {
                const piece_split whole = { number, UINT32_MAX, length };
                best = whole;
            }
            break;
        }
        split_over_separator(routes, number, from, to, INFINITY, &best);
        const uint32_t left = cell->child[0];
        number = tl_route_rim_index(tree, &tree->cells[left], from) != UINT32_MAX ? left : cell->child[1];
    }
    return best;
}

// The shortest way between two gates of a cell of which one is in its separator.
static piece_split split_front(const tl_world_routes *routes, const tl_route_piece *piece)
{
    const tl_route_cell *cell = &routes->tree.cells[piece->cell];
    piece_split best = { TL_ROUTE_NO_CELL, UINT32_MAX, INFINITY };
    for (int k = 0; k < 2; k++) {
        const piece_split split = split_within(routes, cell->child[k], piece->from, piece->to);
        if (split.length < best.length) {
            best = split;
        }
    }
    const uint32_t a = front_column(&routes->tree, cell, piece->from);
    const uint32_t b = front_column(&routes->tree, cell, piece->to);
    if (a != UINT32_MAX && b != UINT32_MAX) {
        const bool a_first = a < cell->gate_count;
        const float whole =
            routes->lengths[cell->upper + (uint64_t)(a_first ? a : b) * (cell->gate_count + cell->rim_count) +
                            (a_first ? b : a)];
        split_over_separator(routes, piece->cell, piece->from, piece->to, whole, &best);
        best.length = best.length < INFINITY ? best.length : whole;
    }
    return best;
}

// Writes the gates of a piece, without its first.
static void write_piece(const tl_nav_router *router, tl_route_piece first, tl_route_writer *writer)
{
    const tl_world_routes *routes = router->world->routes;
    const tl_nav_gate *gates = routes->tree.gates;
    tl_route_piece pieces[MAX_PIECES];
    uint32_t count = 0;
    pieces[count++] = first;
    while (count > 0) {
        const tl_route_piece piece = pieces[--count];
        const piece_split split = split_front(routes, &piece);
        // A route passes a gate once.
        if (split.through == UINT32_MAX || count + 2 > MAX_PIECES || writer->count > routes->tree.gate_count) {
            go_on_within(&routes->tree, split.cell, piece.from, writer);
            tl_route_write_gate(writer, &gates[piece.to], writer->length + (double)split.length);
            continue;
        }
        const tl_route_piece second_half = { split.cell, split.through, piece.to };
        const tl_route_piece first_half = { split.cell, piece.from, split.through };
        pieces[count++] = second_half;
        pieces[count++] = first_half;
    }
}

// ---------------------------------------------------------------------------------------------------------
// From the meeting down to an end.

// The gates between an end and one gate, each with the cell over which the next is reached, from the end's.
typedef struct traced_gates {
    uint32_t gates[TL_ROUTE_MAX_DEPTH + 1], cells[TL_ROUTE_MAX_DEPTH + 1];
    uint32_t count;
} traced_gates;

// `column`: of the separator and the rim of the cell at `level`.
static void trace_end(const tl_world_routes *routes, const tl_route_chain *chain, uint32_t level, uint32_t column,
                      traced_gates *out)
{
    const tl_route_tree *tree = &routes->tree;
    out->count = 0;
    for (;; level--) {
        const tl_route_cell *cell = &tree->cells[chain->cells[level]];
        const bool in_separator = column < cell->gate_count;
        const uint32_t gate =
            in_separator ? cell->first_gate + column : tl_route_rim(tree, cell)[column - cell->gate_count];
        if (level == 0) {
            out->gates[out->count] = gate;
            out->cells[out->count++] = TL_ROUTE_NO_CELL;
            return;
        }
        const tl_route_cell *child = &tree->cells[chain->cells[level - 1]];
        const float *below = tl_route_rim_lengths(tree, chain, level - 1);
        const uint64_t width = (uint64_t)cell->gate_count + cell->rim_count;
        const float *row = routes->lengths + cell->upper;
        const uint32_t own = tl_route_rim_index(tree, child, gate);
        float least = own != UINT32_MAX ? below[own] : INFINITY;
        uint32_t at = own;
        for (uint32_t u = 0; u < cell->gate_count; u++, row += width) {
            if (below[u] + row[column] < least) {
                least = below[u] + row[column];
                at = u;
            }
        }
        if (at != own) {
            out->gates[out->count] = gate;
            out->cells[out->count++] = chain->cells[level];
        }
        // Not UINT32_MAX: some sum made the length that led here.
        column = child->gate_count + (at == UINT32_MAX ? 0 : at);
    }
}

void tl_route_trace(const tl_nav_router *router, const tl_route_meeting *meeting, tl_route_writer *writer)
{
    const tl_world_routes *routes = router->world->routes;
    const tl_route_tree *tree = &routes->tree;
    const tl_route_chain *from = &router->ends[0], *to = &router->ends[1];
    traced_gates start, goal;
    trace_end(routes, from, meeting->levels[0], meeting->gate, &start);
    const uint32_t below = meeting->levels[1];
    trace_end(routes, to, below, tree->cells[to->cells[below]].gate_count + meeting->gate, &goal);
    const uint32_t first = start.gates[start.count - 1], last = goal.gates[goal.count - 1];
    const float at_first =
        tl_route_rim_lengths(tree, from, 0)[tl_route_rim_index(tree, &tree->cells[from->cells[0]], first)];
    const float at_last = tl_route_rim_lengths(tree, to, 0)[tl_route_rim_index(tree, &tree->cells[to->cells[0]], last)];
    tl_route_write_gate(writer, &tree->gates[first], (double)at_first);
    for (uint32_t i = start.count - 1; i > 0; i--) {
        const tl_route_piece piece = { start.cells[i - 1], start.gates[i], start.gates[i - 1] };
        write_piece(router, piece, writer);
    }
    for (uint32_t i = 0; i + 1 < goal.count; i++) {
        const tl_route_piece piece = { goal.cells[i], goal.gates[i], goal.gates[i + 1] };
        write_piece(router, piece, writer);
    }
    go_on_within(tree, to->cells[0], last, writer);
    writer->length += (double)at_last;
}
