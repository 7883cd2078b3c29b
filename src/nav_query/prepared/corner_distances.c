// SPDX-License-Identifier: MIT
//
// The table of all-pairs shortest distances between corner vertices, and of the next vertex on each path.
//
// For worlds of up to a few thousand corner vertices the table is small (6 bytes a pair), takes a Dijkstra search from
// each, and turns a path search into some hundred look-ups. Floats are enough: which of two paths is taken whose
// lengths differ by a rounding does not matter, and the length of a path is summed up anew from its corners.

#include "nav_query/prepared/corner_distances.h"

#include "base/arena.h"
#include "math/tolerance.h"
#include "nav_query/prepared/visibility_graph.h"

#include <math.h>

uint64_t tl_nav_corner_distances_size(const tl_nav_visibility_graph *graph)
{
    uint64_t pairs = (uint64_t)graph->vertex_room * graph->vertex_room;
    // A corner vertex has 16 bits in it.
    return graph->vertex_room <= UINT16_MAX ? pairs * (sizeof *graph->table + sizeof *graph->table_next) : UINT64_MAX;
}

void tl_nav_free_corner_distances(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    uint64_t pairs = (uint64_t)graph->vertex_room * graph->vertex_room;
    tl_release_array(allocator, graph->table, pairs, sizeof *graph->table);
    tl_release_array(allocator, graph->table_next, pairs, sizeof *graph->table_next);
    graph->table = NULL;
    graph->table_next = NULL;
}

static void swap(tl_nav_corner_leg *a, tl_nav_corner_leg *b)
{
    tl_nav_corner_leg kept = *a;
    *a = *b;
    *b = kept;
}

// Moves the legs to the goal by which a path may be shorter than `best` to the front; returns their number.
static uint32_t drop_far_goals(tl_nav_corner_leg *goals, uint32_t count, float best)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (goals[k].total < best) {
            swap(&goals[k], &goals[kept++]);
        }
    }
    return kept;
}

tl_nav_meeting tl_nav_best_by_table(const tl_nav_visibility_graph *graph, tl_nav_ends *ends)
{
    // The leg of the lowest total first: it bounds the others. A total may be too long by its roundings.
    const float margin = 1.0f + TL_FLOAT_GAMMA(16);
    uint32_t goal_count = ends->goal_count;
    tl_nav_meeting best = { INFINITY, NULL, NULL };
    for (uint32_t i = 1; i < ends->start_count; i++) {
        if (ends->starts[i].total < ends->starts[0].total) {
            swap(&ends->starts[i], &ends->starts[0]);
        }
    }
    for (uint32_t i = 0; i < ends->start_count; i++) {
        tl_nav_corner_leg *start = &ends->starts[i];
        if (!(start->total < best.length * margin)) {
            continue;
        }
        const float *row = graph->table + (uint64_t)start->vertex * graph->vertex_room;
        tl_nav_corner_leg *nearest = NULL;
        for (uint32_t k = 0; k < goal_count; k++) {
            float length = start->length + row[ends->goals[k].vertex] + ends->goals[k].length;
            if (length < best.length) {
                best.length = length;
                nearest = &ends->goals[k];
            }
        }
        if (nearest != NULL) {
            tl_nav_corner_leg goal = *nearest;
            goal_count = drop_far_goals(ends->goals, goal_count, best.length * margin);
            best.start = start;
            best.goal = ends->goals;
            while (best.goal->vertex != goal.vertex) {
                best.goal++;
            }
        }
    }
    return best;
}

uint32_t tl_nav_unpack_table(const tl_nav_visibility_graph *graph, const tl_nav_meeting *meeting, uint64_t *vertices,
                             uint32_t capacity)
{
    const uint16_t *next = graph->table_next + (uint64_t)meeting->start->vertex * graph->vertex_room;
    uint32_t count = 0;
    for (uint32_t at = meeting->goal->vertex;; at = next[at]) {
        if (count == capacity) {
            return UINT32_MAX;
        }
        vertices[count++] = at;
        if (at == meeting->start->vertex) {
            return count;
        }
    }
}
