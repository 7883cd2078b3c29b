// SPDX-License-Identifier: MIT
//
// A table of the lengths of the shortest ways between all bends, and of the bends on them.
//
// For worlds of up to a few thousand bends the table is small (6 bytes a pair), takes a Dijkstra a bend, and turns a
// search into some hundred look-ups. Floats do: which of two ways that differ by a rounding is taken is no matter, and
// the length of a path is summed up anew from its corners.

#include "nav_query/road_lengths.h"

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

float tl_nav_best_by_table(const tl_nav_roads *roads, const tl_nav_stop *starts, uint32_t start_count,
                           const tl_nav_stop *goals, uint32_t goal_count, uint32_t *start_out, uint32_t *goal_out)
{
    float best = INFINITY;
    for (uint32_t i = 0; i < start_count; i++) {
        const float *row = roads->table + (uint64_t)starts[i].bend * roads->bend_count;
        float to_start = (float)starts[i].cost;
        for (uint32_t k = 0; k < goal_count; k++) {
            float length = to_start + row[goals[k].bend] + (float)goals[k].cost;
            if (length < best) {
                best = length;
                *start_out = i;
                *goal_out = k;
            }
        }
    }
    return best;
}
