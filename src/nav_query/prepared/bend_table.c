// SPDX-License-Identifier: MIT
//
// A table of the lengths of the shortest ways between all bends, and of the bends on them.
//
// For worlds of up to a few thousand bends the table is small (6 bytes a pair), takes a Dijkstra a bend, and turns a
// search into some hundred look-ups. Floats do: which of two ways that differ by a rounding is taken is no matter, and
// the length of a path is summed up anew from its corners.

#include "nav_query/prepared/road_lengths.h"

#include "base/arena.h"
#include "base/assert.h"

#include <math.h>

uint64_t tl_nav_bend_table_size(const tl_nav_roads *roads)
{
    uint64_t pairs = (uint64_t)roads->bend_count * roads->bend_count;
    // Bends have 16 bits in it.
    return roads->bend_count <= UINT16_MAX ? pairs * (sizeof *roads->table + sizeof *roads->table_way) : UINT64_MAX;
}

tl_result tl_nav_make_bend_table(const tl_allocator *allocator, tl_nav_roads *roads)
{
    uint32_t n = roads->bend_count;
    uint64_t pairs = (uint64_t)n * n;
    tl_nav_road_lengths lengths;
    TL_TRY(tl_nav_road_lengths_make(allocator, roads, &lengths));
    roads->table = tl_allocate_array(allocator, pairs, sizeof *roads->table);
    roads->table_way = tl_allocate_array(allocator, pairs, sizeof *roads->table_way);
    bool fits = roads->table != NULL && roads->table_way != NULL;
    for (uint32_t i = 0; i < n && fits; i++) {
        tl_nav_measure_roads(&lengths, &i, 1);
        for (uint32_t k = 0; k < n; k++) {
            roads->table[(uint64_t)i * n + k] = (float)lengths.length[k];
            roads->table_way[(uint64_t)i * n + k] = (uint16_t)lengths.before[k];
        }
    }
    tl_nav_road_lengths_free(allocator, &lengths);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_nav_free_bend_table(const tl_allocator *allocator, tl_nav_roads *roads)
{
    uint64_t pairs = (uint64_t)roads->bend_count * roads->bend_count;
    tl_release_array(allocator, roads->table, pairs, sizeof *roads->table);
    tl_release_array(allocator, roads->table_way, pairs, sizeof *roads->table_way);
    roads->table = NULL;
    roads->table_way = NULL;
}

static void swap(tl_nav_bend_leg *a, tl_nav_bend_leg *b)
{
    tl_nav_bend_leg kept = *a;
    *a = *b;
    *b = kept;
}

// Moves the goals over which a way may be shorter than `best` to the front; returns how many they are.
static uint32_t drop_far_goals(tl_nav_bend_leg *goals, uint32_t count, float best)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (goals[k].total < best) {
            swap(&goals[k], &goals[kept++]);
        }
    }
    return kept;
}

tl_nav_meeting tl_nav_best_by_table(const tl_nav_roads *roads, tl_nav_ends *ends)
{
    // The most promising one first: it bounds what is worth a look. A total may be too long by its roundings.
    const float margin = 1.0f + TL_FLOAT_GAMMA(16);
    uint32_t goal_count = ends->goal_count;
    tl_nav_meeting best = { INFINITY, NULL, NULL, 0 };
    for (uint32_t i = 1; i < ends->start_count; i++) {
        if (ends->starts[i].total < ends->starts[0].total) {
            swap(&ends->starts[i], &ends->starts[0]);
        }
    }
    for (uint32_t i = 0; i < ends->start_count; i++) {
        tl_nav_bend_leg *start = &ends->starts[i];
        if (!(start->total < best.length * margin)) {
            continue;
        }
        const float *row = roads->table + (uint64_t)start->bend * roads->bend_count;
        tl_nav_bend_leg *nearest = NULL;
        for (uint32_t k = 0; k < goal_count; k++) {
            float length = start->length + row[ends->goals[k].bend] + ends->goals[k].length;
            if (length < best.length) {
                best.length = length;
                nearest = &ends->goals[k];
            }
        }
        if (nearest != NULL) {
            tl_nav_bend_leg goal = *nearest;
            goal_count = drop_far_goals(ends->goals, goal_count, best.length * margin);
            best.start = start;
            best.goal = ends->goals;
            while (best.goal->bend != goal.bend) {
                best.goal++;
            }
        }
    }
    return best;
}
