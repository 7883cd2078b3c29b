// SPDX-License-Identifier: MIT
//
// Dealing out is list scheduling: the process that is free first takes the next batch (Graham 1966); by falling cost it
// is his LPT rule (1969), which ends within 4/3 of the best order, and far closer where no tile is large. A heap finds
// the process, so a replay takes n log ranks.

#include "world/job/rank_replay.h"

#include "world/job/bake_tiles.h"

#include <stdlib.h>
#include <string.h>

// Lets the process at the heap's top, which is the first to be free, work for `time`.
static void work_on_top(uint64_t *heap, uint32_t ranks, uint64_t time)
{
    const uint64_t free_at = heap[0] + time;
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        child += child + 1 < ranks && heap[child + 1] < heap[child];
        if (child >= ranks || heap[child] >= free_at) {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = free_at;
}

static uint64_t largest_of(const uint64_t *values, uint64_t count)
{
    uint64_t largest = 0;
    for (uint64_t i = 0; i < count; i++) {
        largest = values[i] > largest ? values[i] : largest;
    }
    return largest;
}

// When the last is done. `order`: NULL is the grid's.
static uint64_t replay_dealt(const uint64_t *times, const uint64_t *order, uint64_t count, uint32_t ranks,
                             uint64_t *heap)
{
    memset(heap, 0, ranks * sizeof *heap);
    for (uint64_t first = 0; first < count;) {
        const uint64_t batch = tl_world_deal_size(count - first, 1, ranks);
        uint64_t sum = 0;
        for (uint64_t i = first; i < first + batch; i++) {
            sum += times[order != NULL ? order[i] : i];
        }
        work_on_top(heap, ranks, sum);
        first += batch;
    }
    return largest_of(heap, ranks);
}

// As tl_world_shard_tiles deals.
static uint64_t replay_shards(const uint64_t *times, const uint64_t *order, uint64_t count, uint32_t ranks,
                              uint64_t *loads)
{
    memset(loads, 0, ranks * sizeof *loads);
    for (uint64_t i = 0; i < count; i++) {
        loads[tl_world_shard_turn(i / ranks, i % ranks, ranks)] += times[order[i]];
    }
    return largest_of(loads, ranks);
}

static uint64_t replay_blocks(const uint64_t *times, uint64_t count, uint32_t ranks)
{
    uint64_t largest = 0;
    for (uint64_t r = 0; r < ranks; r++) {
        uint64_t sum = 0;
        for (uint64_t i = count * r / ranks; i < count * (r + 1) / ranks; i++) {
            sum += times[i];
        }
        largest = sum > largest ? sum : largest;
    }
    return largest;
}

static double idle_share(uint64_t sum, uint64_t last, uint32_t ranks)
{
    return last > 0 ? 1.0 - (double)sum / ((double)last * ranks) : 0.0;
}

tl_result tl_world_replay_ranks(const tl_world_plan *plan, const uint64_t *times, uint32_t ranks,
                                tl_world_replay *replay_out)
{
    const uint64_t count = plan->tile_count;
    const tl_world_shard whole = { 0, 1, NULL };
    uint64_t order_count = 0, sum = 0;
    memset(replay_out, 0, sizeof *replay_out);
    uint64_t *order = tl_world_shard_tiles(plan, &whole, &order_count);
    uint64_t *loads = malloc(ranks * sizeof *loads);
    if (order == NULL || loads == NULL) {
        free(order);
        free(loads);
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < count; i++) {
        sum += times[i];
    }
    replay_out->dealt = idle_share(sum, replay_dealt(times, order, count, ranks, loads), ranks);
    replay_out->dealt_naive = idle_share(sum, replay_dealt(times, NULL, count, ranks, loads), ranks);
    replay_out->shards = idle_share(sum, replay_shards(times, order, count, ranks, loads), ranks);
    replay_out->shards_naive = idle_share(sum, replay_blocks(times, count, ranks), ranks);
    const uint64_t longest = largest_of(times, count), fair = sum / ranks;
    replay_out->least = idle_share(sum, longest > fair ? longest : fair, ranks);
    replay_out->least = replay_out->least > 0.0 ? replay_out->least : 0.0;
    free(order);
    free(loads);
    return TL_OK;
}
