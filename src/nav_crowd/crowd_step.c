// SPDX-License-Identifier: MIT
//
// A step: paths, leaders, the grid, then each agent by itself; and at the end what agents must agree on.
//
// Agents read their neighbours from a copy that was made when the step began, and write to their own places alone. So
// the blocks run in any order, on any number of threads, and give the same bytes.

#include "base/assert.h"
#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

// Who is shut off from its goal asks for a path once in so many steps, if there were edits: in turn.
enum { ASK_STEPS = 64 };

static void revalidate_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const crowd_step *step = (const crowd_step *)user;
    const uint32_t end = tl_block_end(block, CROWD_BLOCK, step->crowd->head->used);
    for (uint32_t i = block * CROWD_BLOCK; i < end; i++) {
        tl_crowd_revalidate(step, i);
    }
}

static void search_one(uint32_t index, uint32_t worker, void *user)
{
    const crowd_step *step = (const crowd_step *)user;
    tl_crowd_search_path(step, step->crowd->work[index], step->crowd->queries[worker]);
}

// The agents of a block that walk on the mesh by themselves, or stand on it.
typedef struct block_agents {
    uint32_t count;
    uint32_t place[CROWD_BLOCK];
    float velocity[CROWD_BLOCK][2]; // that they take
} block_agents;

static void list_block_agents(const crowd_step *step, uint32_t block, block_agents *agents)
{
    const crowd_fields *a = &step->crowd->a;
    const uint32_t end = tl_block_end(block, CROWD_BLOCK, step->crowd->head->used);
    agents->count = 0;
    for (uint32_t i = block * CROWD_BLOCK; i < end; i++) {
        const uint32_t status = a->status[i];
        if (status == TL_NAV_AGENT_ON_LINK) {
            tl_crowd_follow_link(step, i);
        } else if (status != CROWD_FREE && status != TL_NAV_AGENT_FIXED && status != TL_NAV_AGENT_OFF_MESH) {
            agents->place[agents->count++] = i;
        }
    }
}

// Each worker takes the same blocks first in every step, as their agents are in its cache, and then what others have
// left.
static void deal_blocks(tl_nav_crowd *crowd, uint32_t count)
{
    for (uint32_t w = 0; w < crowd->worker_count; w++) {
        atomic_init(&crowd->runs[w].next, (uint64_t)count * w / crowd->worker_count);
        crowd->runs[w].end = (uint64_t)count * (w + 1) / crowd->worker_count;
    }
}

// A block that nobody has taken: as many are asked for as there are.
static uint32_t take_block(tl_nav_crowd *crowd, uint32_t worker)
{
    for (uint32_t n = 0; n < crowd->worker_count; n++) {
        crowd_block_run *run = &crowd->runs[(worker + n) % crowd->worker_count];
        const uint64_t block = atomic_fetch_add_explicit(&run->next, 1, memory_order_relaxed);
        if (block < run->end) {
            return (uint32_t)block;
        }
    }
    TL_ASSERT(false);
    return 0;
}

// In the order of places, not of the snapshot: the fields of an agent, which are written too, fill thirty cache lines
// that it shares with its neighbours in that order, and what it reads of others fills a few. All agents of a block do
// one thing before the next: its code and tables stay in the nearest cache.
static void step_block(uint32_t index, uint32_t worker, void *user)
{
    (void)index;
    const crowd_step *step = (const crowd_step *)user;
    tl_nav_crowd *crowd = step->crowd;
    tl_nav_query *query = crowd->queries[worker];
    block_agents agents;
    list_block_agents(step, take_block(crowd, worker), &agents);
    for (uint32_t n = 0; n < agents.count; n++) {
        const uint32_t i = agents.place[n];
        tl_crowd_look_for_walls(step, i, query);
        if (tl_crowd_follows(crowd, i)) {
            tl_crowd_follow(step, i, query);
        } else {
            tl_crowd_steer(step, i);
        }
    }
    for (uint32_t n = 0; n < agents.count; n++) {
        tl_crowd_avoid(step, crowd->grid.cell[agents.place[n]], agents.velocity[n]);
    }
    for (uint32_t n = 0; n < agents.count; n++) {
        tl_crowd_move(step, agents.place[n], agents.velocity[n], query);
    }
}

// Takes the oldest requests that can be searched now from the queue. Those of agents on links wait behind the others.
static void take_work(crowd_step *step)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_head *head = crowd->head;
    const uint32_t asked = head->queue_count;
    step->work_count = 0;
    for (uint32_t k = 0; k < asked && step->work_count < crowd->work_capacity; k++) {
        const uint32_t i = crowd->a.queue[head->queue_first];
        crowd->a.queue[head->queue_first] = 0;
        head->queue_first = (head->queue_first + 1) % head->max_agents;
        head->queue_count--;
        crowd->a.flags[i] &= ~CROWD_IN_QUEUE;
        const uint32_t status = crowd->a.status[i];
        if (status == TL_NAV_AGENT_ON_LINK) {
            tl_crowd_enqueue(crowd, i);
        } else if (status != TL_NAV_AGENT_OFF_MESH) { // which asks again when it finds a polygon
            crowd->work[step->work_count++] = i;
        }
    }
}

void tl_crowd_run_tasks(const crowd_step *step, tl_task_fn *task, uint32_t count)
{
    tl_host host = step->crowd->def.host;
    host.progress = NULL;
    crowd_step copy = *step;
    tl_run_tasks(&host, task, count, &copy);
}

static void finish(const crowd_step *step, tl_nav_crowd_step_report *report)
{
    tl_nav_crowd *crowd = step->crowd;
    uint32_t counts[CROWD_FREE + 1] = { 0 };
    for (uint32_t i = 0; i < crowd->head->used; i++) {
        if ((crowd->a.flags[i] & CROWD_ASK_LATER) != 0 && (crowd->head->step + i) % ASK_STEPS == 0) {
            crowd->a.flags[i] = (crowd->a.flags[i] & ~CROWD_ASK_LATER) | CROWD_NEED_PATH;
        }
        if ((crowd->a.flags[i] & CROWD_NEED_PATH) != 0 && crowd->a.status[i] != TL_NAV_AGENT_OFF_MESH) {
            tl_crowd_enqueue(crowd, i);
        }
        counts[crowd->a.status[i]]++;
    }
    if (report != NULL) {
        report->searched = step->work_count + step->tree_count;
        report->shared = step->shared_count;
        report->waiting = crowd->head->queue_count;
        report->walking = counts[TL_NAV_AGENT_WALKING];
        report->arrived = counts[TL_NAV_AGENT_ARRIVED];
        report->unreachable = counts[TL_NAV_AGENT_UNREACHABLE];
        report->on_link = counts[TL_NAV_AGENT_ON_LINK];
        report->off_mesh = counts[TL_NAV_AGENT_OFF_MESH];
    }
}

tl_result tl_nav_crowd_step(tl_nav_crowd *crowd, const tl_navmesh *navmesh, float dt,
                            tl_nav_crowd_step_report *report_out)
{
    if (report_out != NULL) {
        memset(report_out, 0, sizeof *report_out);
    }
    if (crowd == NULL || navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!isfinite(dt)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!(dt > 0.0f && dt <= 1.0f)) {
        return TL_ERR_ARGUMENT;
    }
    crowd_head *head = crowd->head;
    crowd_step step = { crowd, navmesh, dt, 0, 0, 0, { 0.0f, 0.0f } };
    tl_crowd_preferred_direction(head->milliseconds, step.preferred);
    const uint64_t edits = tl_navmesh_edit_count(navmesh);
    if (head->edits != edits || head->filters_changed != 0) {
        tl_crowd_run_tasks(&step, revalidate_block, tl_block_count(head->used, CROWD_BLOCK));
        head->edits = edits;
        head->filters_changed = 0;
    }
    tl_crowd_share_paths(&step);
    take_work(&step);
    tl_crowd_run_tasks(&step, search_one, step.work_count);
    tl_crowd_lead_groups(&step);
    tl_crowd_fill_grid(&step);
    const uint32_t blocks = tl_block_count(head->used, CROWD_BLOCK);
    deal_blocks(crowd, blocks);
    tl_crowd_run_tasks(&step, step_block, blocks);
    tl_crowd_grant_links(&step);
    finish(&step, report_out);
    head->step++;
    head->milliseconds += (uint64_t)((double)dt * 1000.0 + 0.5);
    return TL_OK;
}
