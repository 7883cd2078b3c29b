// SPDX-License-Identifier: MIT
//
// Paths to goals that many agents have: one tree of paths (goal_tree.c) for each such goal, instead of a search for
// each agent; and after an edit one tree again.
//
// A tree follows from goal, filter and navmesh, so it is no part of the state: whether it was kept or is made anew, the
// paths have the same bytes. Which goals are shared is part of it, since an agent's own search may take another path of
// about the same length. They are counted over all agents, as many come one after the other (a wave, a spawner).
//
// A field of directions over the ground, as flow fields have one, would take memory for the world and know nothing of
// how agents steer: here they walk corridors as before, with exact corners.

#include "base/hash.h"
#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <string.h>

enum {
    SHARE_AT_LEAST = 8, // agents: a tree visits all polygons, a search some
    COUNT_EVERY = 16,   // steps
    COUNT_AT = 16,      // paths that are asked for: counted at once
};

// Not those who follow, whose goals are slots that move.
static bool may_share(const tl_nav_crowd *crowd, uint32_t i)
{
    const crowd_fields *a = &crowd->a;
    const uint32_t status = a->status[i];
    return (a->flags[i] & CROWD_HAS_GOAL) != 0 && a->clearance[i] == 0.0f &&
           (status == TL_NAV_AGENT_WAITING || status == TL_NAV_AGENT_WALKING || status == TL_NAV_AGENT_QUEUED) &&
           !tl_crowd_follows(crowd, i);
}

static crowd_shared_goal goal_of(const crowd_fields *a, uint32_t i)
{
    crowd_shared_goal goal;
    memset(&goal, 0, sizeof goal);
    goal.polygon = a->goal_polygon[i];
    memcpy(goal.point, a->goal + 3 * (size_t)i, sizeof goal.point);
    goal.side = CROWD_RELOCATE_RADII * a->radius[i];
    goal.height = a->height[i];
    goal.filter = a->filter[i];
    return goal;
}

static bool is_same_goal(const crowd_shared_goal *a, const crowd_shared_goal *b)
{
    return a->polygon == b->polygon && a->filter == b->filter && a->point[0] == b->point[0] &&
           a->point[1] == b->point[1] && a->point[2] == b->point[2];
}

// ---------------------------------------------------------------------------------------------------------
// Which goals are shared: the table and the counts are the grid's memory, which is idle now.

static uint32_t hash_goal(const crowd_shared_goal *goal)
{
    uint32_t bits[3];
    memcpy(bits, goal->point, sizeof bits);
    const uint64_t point = (uint64_t)bits[0] << 32 | bits[2];
    return (uint32_t)tl_hash_mix(tl_hash_mix(goal->polygon + goal->filter) ^ point);
}

// The entry of the first agent with a goal, or the empty one where that belongs.
static uint32_t *find_first(const tl_nav_crowd *crowd, const crowd_shared_goal *goal)
{
    uint32_t *table = crowd->grid.first;
    const uint32_t mask = crowd->grid.cell_count - 1;
    uint32_t at = hash_goal(goal) & mask;
    while (table[at] != CROWD_NO_PLACE) {
        const crowd_shared_goal its = goal_of(&crowd->a, table[at]);
        if (is_same_goal(&its, goal)) {
            break;
        }
        at = (at + 1) & mask;
    }
    return &table[at];
}

static void count_goals(const tl_nav_crowd *crowd)
{
    memset(crowd->grid.first, 0xff, (size_t)crowd->grid.cell_count * sizeof *crowd->grid.first);
    for (uint32_t i = 0; i < crowd->head->used; i++) {
        crowd->grid.cell[i] = 0;
        if (may_share(crowd, i)) {
            const crowd_shared_goal goal = goal_of(&crowd->a, i);
            uint32_t *first = find_first(crowd, &goal);
            *first = *first == CROWD_NO_PLACE ? i : *first;
            crowd->grid.cell[*first]++;
        }
    }
}

// The first agents with the goals that most have; ties go to the lower place. Returns how many there are.
static uint32_t find_most(const tl_nav_crowd *crowd, uint32_t most[CROWD_MAX_SHARED])
{
    const uint32_t *counts = crowd->grid.cell;
    uint32_t found = 0;
    for (uint32_t i = 0; i < crowd->head->used; i++) {
        if (counts[i] < SHARE_AT_LEAST) {
            continue;
        }
        uint32_t at = found < crowd->def.max_shared_goals ? found++ : found;
        for (; at > 0 && counts[most[at - 1]] < counts[i]; at--) {
            if (at < found) {
                most[at] = most[at - 1];
            }
        }
        if (at < found) {
            most[at] = i;
        }
    }
    return found;
}

static uint32_t find_shared(const tl_nav_crowd *crowd, const crowd_shared_goal *goal)
{
    for (uint32_t k = 0; k < crowd->def.max_shared_goals; k++) {
        if (is_same_goal(&crowd->head->shared[k], goal)) {
            return k;
        }
    }
    return CROWD_NO_PLACE;
}

// Goals that are shared already keep their place, and their tree.
static void choose_goals(tl_nav_crowd *crowd)
{
    uint32_t most[CROWD_MAX_SHARED];
    crowd_shared_goal added[CROWD_MAX_SHARED];
    bool is_kept[CROWD_MAX_SHARED] = { false };
    count_goals(crowd);
    const uint32_t count = find_most(crowd, most);
    uint32_t added_count = 0;
    for (uint32_t n = 0; n < count; n++) {
        const crowd_shared_goal goal = goal_of(&crowd->a, most[n]);
        const uint32_t k = find_shared(crowd, &goal);
        if (k != CROWD_NO_PLACE) {
            is_kept[k] = true;
        } else {
            added[added_count++] = goal;
        }
    }
    for (uint32_t k = 0, n = 0; k < crowd->def.max_shared_goals; k++) {
        if (!is_kept[k]) {
            memset(&crowd->head->shared[k], 0, sizeof crowd->head->shared[k]);
            if (n < added_count) {
                crowd->head->shared[k] = added[n++];
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------------------
// Their trees.

void tl_crowd_forget_trees(tl_nav_crowd *crowd, uint32_t filter)
{
    for (uint32_t k = 0; k < CROWD_MAX_SHARED; k++) {
        if (filter == UINT32_MAX || crowd->trees[k].of.filter == filter) {
            crowd->trees[k].navmesh = NULL;
        }
    }
}

static bool is_made(const crowd_step *step, uint32_t k)
{
    const crowd_tree *tree = &step->crowd->trees[k];
    const crowd_shared_goal *goal = &step->crowd->head->shared[k];
    return tree->navmesh == step->navmesh && tree->edits == tl_navmesh_edit_count(step->navmesh) &&
           memcmp(&tree->of, goal, sizeof *goal) == 0;
}

// A tree that lacks nodes is of use for those that it holds; one without a goal holds nobody.
static void make_tree(uint32_t index, uint32_t worker, void *user)
{
    const crowd_step *step = (const crowd_step *)user;
    tl_nav_crowd *crowd = step->crowd;
    crowd_tree *tree = &crowd->trees[index];
    if (!tree->is_asked || is_made(step, index)) {
        return;
    }
    tree->of = crowd->head->shared[index];
    tree->navmesh = step->navmesh;
    tree->edits = tl_navmesh_edit_count(step->navmesh);
    tree->tree.count = 0;
    const tl_nav_filter *filter = &crowd->filters[tree->of.filter];
    tl_nav_location goal = { tree->of.polygon, tl_crowd_get3(tree->of.point, 0) };
    const tl_vec3 extents = { tree->of.side, tree->of.height, tree->of.side };
    if (tl_navmesh_resolve(step->navmesh, goal.polygon, NULL, NULL) == TL_OK ||
        tl_navmesh_find_nearest(step->navmesh, filter, goal.point, extents, &goal) == TL_OK) {
        tree->tree.goal = goal;
        if (tl_nav_query_find_goal_tree(crowd->queries[worker], step->navmesh, filter, &tree->tree) ==
            TL_ERR_ARGUMENT) {
            tree->tree.count = 0; // the filter's function refuses costs
        }
    }
}

// ---------------------------------------------------------------------------------------------------------
// The paths.

// cell[i] holds the tree of one who waits, and then whether it has a path.
static void take_path(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    const crowd_tree *tree = &crowd->trees[crowd->grid.cell[i]];
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    tl_nav_ref polygons[CROWD_MAX_PATH];
    const tl_nav_goal_path_request request = { &crowd->filters[crowd->a.filter[i]],
                                               { corridor.path[0], corridor.position },
                                               corridor.capacity };
    tl_nav_path path;
    crowd->grid.cell[i] = CROWD_NO_PLACE;
    if (tl_nav_goal_tree_path(&tree->tree, step->navmesh, &request, polygons, corridor.capacity, &path) != TL_OK) {
        return;
    }
    memcpy(corridor.path, polygons, path.polygon_count * sizeof *polygons);
    corridor.count = path.polygon_count;
    corridor.target = path.end.point;
    corridor.reaches = path.status == TL_NAV_PATH_COMPLETE;
    tl_crowd_begin_path(crowd, i, &corridor, false, false);
    crowd->grid.cell[i] = 0;
}

static void take_paths(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const crowd_step *step = (const crowd_step *)user;
    const tl_nav_crowd *crowd = step->crowd;
    const uint32_t end = tl_block_end(block, CROWD_BLOCK, crowd->head->queue_count);
    for (uint32_t k = block * CROWD_BLOCK; k < end; k++) {
        const uint32_t i = crowd->a.queue[(crowd->head->queue_first + k) % crowd->head->max_agents];
        if (crowd->grid.cell[i] != CROWD_NO_PLACE) {
            take_path(step, i);
        }
    }
}

// Notes which tree each of those who wait needs. Returns how many need one.
static uint32_t ask_for_trees(tl_nav_crowd *crowd)
{
    uint32_t asked = 0;
    for (uint32_t k = 0; k < CROWD_MAX_SHARED; k++) {
        crowd->trees[k].is_asked = false;
    }
    for (uint32_t k = 0; k < crowd->head->queue_count; k++) {
        const uint32_t i = crowd->a.queue[(crowd->head->queue_first + k) % crowd->head->max_agents];
        crowd->grid.cell[i] = CROWD_NO_PLACE;
        if (may_share(crowd, i)) {
            const crowd_shared_goal goal = goal_of(&crowd->a, i);
            crowd->grid.cell[i] = find_shared(crowd, &goal);
            if (crowd->grid.cell[i] != CROWD_NO_PLACE) {
                crowd->trees[crowd->grid.cell[i]].is_asked = true;
                asked++;
            }
        }
    }
    return asked;
}

// Those who have a path leave the queue; the others keep their order.
static uint32_t leave_served(tl_nav_crowd *crowd)
{
    crowd_head *head = crowd->head;
    uint32_t *queue = crowd->a.queue;
    uint32_t kept = 0;
    for (uint32_t k = 0; k < head->queue_count; k++) {
        const uint32_t from = (head->queue_first + k) % head->max_agents;
        const uint32_t i = queue[from];
        if (crowd->grid.cell[i] == CROWD_NO_PLACE) {
            queue[(head->queue_first + kept++) % head->max_agents] = i;
        } else {
            crowd->a.flags[i] &= ~CROWD_IN_QUEUE;
        }
    }
    for (uint32_t k = kept; k < head->queue_count; k++) {
        queue[(head->queue_first + k) % head->max_agents] = 0;
    }
    const uint32_t served = head->queue_count - kept;
    head->queue_count = kept;
    return served;
}

void tl_crowd_share_paths(crowd_step *step)
{
    tl_nav_crowd *crowd = step->crowd;
    const uint32_t waiting = crowd->head->queue_count;
    if (crowd->def.max_shared_goals == 0 || waiting == 0) {
        return;
    }
    if (waiting >= COUNT_AT || crowd->head->step % COUNT_EVERY == 0) {
        choose_goals(crowd);
    }
    if (ask_for_trees(crowd) == 0) {
        return;
    }
    for (uint32_t k = 0; k < crowd->def.max_shared_goals; k++) {
        step->tree_count += crowd->trees[k].is_asked && !is_made(step, k);
    }
    tl_crowd_run_tasks(step, make_tree, crowd->def.max_shared_goals);
    tl_crowd_run_tasks(step, take_paths, tl_block_count(waiting, CROWD_BLOCK));
    step->shared_count = leave_served(crowd);
}
