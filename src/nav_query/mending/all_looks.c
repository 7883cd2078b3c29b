// SPDX-License-Identifier: MIT
//
// The looks of all corner vertices that a mend asks for, as tasks.
//
// No look depends on another, so some at a time are a task, and each worker keeps what its looks have seen. Edges and
// reaches are sorted anyway, by whoever reads them. Cones are put together in the order of looks: which of them are
// joined depends on it, and so the graph is the same for any number of workers.

#include "nav_query/mending/all_looks.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"

#include <string.h>

// Looks of one task, and tasks between two calls of progress: some milliseconds.
enum { LOOKS_A_TASK = 4, TASKS_A_CALL = 16 };

// Where the cones of a task are.
typedef struct cone_run {
    uint32_t worker;
    uint64_t begin, end; // of the worker's list
} cone_run;

typedef struct look_team {
    const tl_allocator *allocator;
    const tl_nav_number_list *lookers;
    tl_nav_look_ground ground;
    tl_nav_corner_look *workers;
    cone_run *runs; // by task
    uint32_t worker_count, task_count;
} look_team;

static void look_from_some(uint32_t index, uint32_t worker, void *user)
{
    look_team *team = user;
    tl_nav_corner_look *look = &team->workers[worker];
    const uint64_t first = (uint64_t)index * LOOKS_A_TASK;
    const uint64_t end = tl_min_u64(first + LOOKS_A_TASK, team->lookers->count);
    team->runs[index].worker = worker;
    team->runs[index].begin = look->cones.count;
    for (uint64_t i = first; i < end; i++) {
        tl_nav_look_from(&team->ground, look, team->lookers->numbers[i]);
    }
    team->runs[index].end = look->cones.count;
}

// Groups the cones of all tasks, stably.
static tl_result group_cones(const look_team *team, tl_nav_all_looks *looks)
{
    const uint32_t slot_count = team->ground.changes->graph->slot_count;
    for (uint32_t w = 0; w < team->worker_count; w++) {
        looks->cone_count += team->workers[w].cones.count;
    }
    if (looks->cone_count > UINT32_MAX) {
        looks->cone_count = 0;
        return TL_ERR_LIMIT;
    }
    looks->cones = tl_allocate_array(team->allocator, looks->cone_count, sizeof *looks->cones);
    if (looks->cones == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t *first = looks->first_cones;
    for (uint32_t w = 0; w < team->worker_count; w++) {
        for (uint64_t i = 0; i < team->workers[w].cones.count; i++) {
            first[team->workers[w].cones.cones[i].slot]++;
        }
    }
    for (uint32_t slot = 1; slot <= slot_count; slot++) {
        first[slot] += first[slot - 1];
    }
    for (uint32_t t = team->task_count; t > 0; t--) {
        const cone_run *run = &team->runs[t - 1];
        const tl_nav_corner_cone *cones = team->workers[run->worker].cones.cones;
        for (uint64_t i = run->end; i > run->begin; i--) {
            looks->cones[--first[cones[i - 1].slot]] = cones[i - 1];
        }
    }
    return TL_OK;
}

static tl_result gather_seen(const look_team *team, tl_nav_change_sectors *sectors, tl_nav_all_looks *looks)
{
    for (uint32_t w = 0; w < team->worker_count; w++) {
        tl_nav_corner_look *look = &team->workers[w];
        TL_TRY(look->result);
        TL_TRY(tl_nav_gather_pairs(team->allocator, &look->seen.edges, &looks->seen.edges));
        TL_TRY(tl_nav_gather_pairs(team->allocator, &look->seen.reaches, &looks->seen.reaches));
        TL_TRY(tl_nav_gather_pairs(team->allocator, &look->dropped, &sectors->dropped));
    }
    return group_cones(team, looks);
}

static tl_result look_as_team(look_team *team, tl_nav_change_sectors *sectors, tl_stage *stage, tl_nav_all_looks *looks)
{
    team->workers = tl_allocate_array(team->allocator, team->worker_count, sizeof *team->workers);
    team->runs = tl_allocate_array(team->allocator, team->task_count, sizeof *team->runs);
    if (team->workers != NULL) {
        memset(team->workers, 0, team->worker_count * sizeof *team->workers);
    }
    if (team->workers == NULL || team->runs == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_nav_make_look_ground(sectors, &team->ground));
    TL_TRY(tl_stage_run(stage, look_from_some, team->task_count, team, TASKS_A_CALL, team->lookers->count));
    return gather_seen(team, sectors, looks);
}

tl_result tl_nav_look_from_all(tl_nav_change_sectors *sectors, tl_stage *stage, tl_nav_all_looks *looks_out)
{
    const tl_nav_graph_changes *changes = sectors->changes;
    const uint64_t slots = changes->graph->slot_count;
    memset(looks_out, 0, sizeof *looks_out);
    looks_out->first_cones = tl_allocate_array(changes->allocator, slots + 1, sizeof *looks_out->first_cones);
    if (looks_out->first_cones == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(looks_out->first_cones, 0, (size_t)(slots + 1) * sizeof *looks_out->first_cones);
    if (changes->lookers.count == 0) {
        return TL_OK;
    }
    look_team team;
    memset(&team, 0, sizeof team);
    team.allocator = changes->allocator;
    team.lookers = &changes->lookers;
    team.ground.changes = changes;
    team.worker_count = tl_worker_count(stage->host);
    team.task_count = tl_block_count((uint32_t)changes->lookers.count, LOOKS_A_TASK);
    const tl_result result = look_as_team(&team, sectors, stage, looks_out);
    for (uint32_t w = 0; team.workers != NULL && w < team.worker_count; w++) {
        tl_nav_end_looks(&team.workers[w]);
    }
    tl_nav_free_look_ground(&team.ground);
    tl_release_array(team.allocator, team.workers, team.worker_count, sizeof *team.workers);
    tl_release_array(team.allocator, team.runs, team.task_count, sizeof *team.runs);
    return result;
}

void tl_nav_free_all_looks(const tl_nav_graph_changes *changes, tl_nav_all_looks *looks)
{
    const tl_allocator *allocator = changes->allocator;
    tl_nav_free_pairs(allocator, &looks->seen.edges);
    tl_nav_free_pairs(allocator, &looks->seen.reaches);
    tl_release_array(allocator, looks->cones, looks->cone_count, sizeof *looks->cones);
    tl_release_array(allocator, looks->first_cones, (uint64_t)changes->graph->slot_count + 1,
                     sizeof *looks->first_cones);
}
