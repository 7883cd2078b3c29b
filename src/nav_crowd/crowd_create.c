// SPDX-License-Identifier: MIT
//
// A crowd's defs, and its memory: all of it is taken here, so that a step allocates nothing.

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"
#include "nav_crowd/crowd_kernels.h"

#include <math.h>
#include <string.h>

tl_nav_crowd_def tl_default_nav_crowd_def(void)
{
    tl_nav_crowd_def def;
    memset(&def, 0, sizeof def);
    def.max_agents = 1024;
    def.max_path = 20;
    def.max_neighbors = 10;
    def.paths_per_step = 64;
    def.max_nodes = 4096;
    def.neighbor_distance = 4.0f;
    def.agent_horizon = 2.0f;
    def.wall_horizon = 0.25f;
    def.max_shared_goals = 4;
    def.max_groups = 32;
    def.max_members = 256;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static bool is_above_zero(float value)
{
    return isfinite(value) && value > 0.0f;
}

static tl_result check_crowd_def(const tl_nav_crowd_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_crowd_def()", report));
    if (def->max_agents < 1 || def->max_agents > TL_NAV_CROWD_MAX_AGENTS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_agents", "make it 1 to TL_NAV_CROWD_MAX_AGENTS");
    }
    if (def->max_path < 4 || def->max_path > CROWD_MAX_PATH) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_path", "make it 4 to 1024");
    }
    if (def->max_neighbors < 1 || def->max_neighbors > CROWD_MAX_NEIGHBORS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_neighbors", "make it 1 to 32");
    }
    if (def->paths_per_step < 1) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "paths_per_step", "make it at least 1");
    }
    if (def->max_nodes < 2 || def->max_nodes > 1u << 30) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_nodes", "make it 2 to 2^30");
    }
    if (!is_above_zero(def->neighbor_distance) || def->neighbor_distance > 1e6f) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "neighbor_distance", "make it > 0, and at most 1e6 m");
    }
    if (!is_above_zero(def->agent_horizon)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "agent_horizon", "make it > 0");
    }
    if (!is_above_zero(def->wall_horizon)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "wall_horizon", "make it > 0");
    }
    if (def->max_shared_goals > CROWD_MAX_SHARED) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_shared_goals", "make it 0 to 8");
    }
    if (def->max_groups > TL_NAV_CROWD_MAX_AGENTS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_groups", "make it 0 to TL_NAV_CROWD_MAX_AGENTS");
    }
    if (def->max_members > TL_NAV_CROWD_MAX_AGENTS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_members", "make it 0 to TL_NAV_CROWD_MAX_AGENTS");
    }
    return TL_OK;
}

// The scratch arrays: at least as many cells as agents, and at most four times as many.
static bool allocate_step(tl_nav_crowd *crowd)
{
    const uint64_t count = crowd->def.max_agents;
    const tl_allocator *allocator = &crowd->allocator;
    uint32_t bits = 4;
    while ((uint64_t)1 << bits < 2 * count) {
        bits++;
    }
    crowd->grid.mask_x = (1u << (bits + 1) / 2) - 1;
    crowd->grid.mask_z = (1u << bits / 2) - 1;
    crowd->grid.shift_z = (bits + 1) / 2;
    crowd->grid.cell_count = 1u << bits;
    // Kernels read whole vectors, and ignore what lies behind the last agent.
    crowd->seen.agents =
        (crowd_seen_agent *)tl_allocate_array(allocator, count + CROWD_LANES, sizeof *crowd->seen.agents);
    if (crowd->seen.agents != NULL) {
        memset(crowd->seen.agents, 0, (size_t)(count + CROWD_LANES) * sizeof *crowd->seen.agents);
    }
    crowd->work_capacity = tl_min_u32(crowd->def.paths_per_step, crowd->def.max_agents);
    crowd->grid.first =
        (uint32_t *)tl_allocate_array(allocator, (uint64_t)crowd->grid.cell_count + 1, sizeof(uint32_t));
    crowd->grid.cell = (uint32_t *)tl_allocate_array(allocator, count, sizeof(uint32_t));
    crowd->work = (uint32_t *)tl_allocate_array(allocator, crowd->work_capacity, sizeof(uint32_t));
    return crowd->seen.agents != NULL && crowd->grid.first != NULL && crowd->grid.cell != NULL && crowd->work != NULL;
}

static void release_step(tl_nav_crowd *crowd)
{
    const uint64_t count = crowd->def.max_agents;
    const tl_allocator *allocator = &crowd->allocator;
    tl_release_array(allocator, crowd->seen.agents, count + CROWD_LANES, sizeof *crowd->seen.agents);
    tl_release_array(allocator, crowd->grid.first, (uint64_t)crowd->grid.cell_count + 1, sizeof(uint32_t));
    tl_release_array(allocator, crowd->grid.cell, count, sizeof(uint32_t));
    tl_release_array(allocator, crowd->work, crowd->work_capacity, sizeof(uint32_t));
}

static bool allocate_trees(tl_nav_crowd *crowd)
{
    bool all = true;
    for (uint32_t k = 0; k < crowd->def.max_shared_goals; k++) {
        tl_nav_goal_tree *tree = &crowd->trees[k].tree;
        tree->capacity = crowd->def.max_nodes;
        tree->entries =
            (tl_nav_goal_entry *)tl_allocate_array(&crowd->allocator, tree->capacity, sizeof(tl_nav_goal_entry));
        all = all && tree->entries != NULL;
    }
    return all;
}

static void release_trees(tl_nav_crowd *crowd)
{
    for (uint32_t k = 0; k < crowd->def.max_shared_goals; k++) {
        const tl_nav_goal_tree *tree = &crowd->trees[k].tree;
        tl_release_array(&crowd->allocator, tree->entries, tree->capacity, sizeof(tl_nav_goal_entry));
    }
}

static bool allocate_deal(tl_nav_crowd *crowd)
{
    const tl_allocator *allocator = &crowd->allocator;
    tl_slot_deal *deal = &crowd->deal;
    const uint64_t count = crowd->def.max_members;
    if (count == 0) {
        return true;
    }
    deal->from = (float *)tl_allocate_array(allocator, 2 * count, sizeof(float));
    deal->to = (float *)tl_allocate_array(allocator, 2 * count, sizeof(float));
    deal->taker = (uint32_t *)tl_allocate_array(allocator, count, sizeof(uint32_t));
    deal->followers = (tl_sort_item *)tl_allocate_array(allocator, count, sizeof(tl_sort_item));
    deal->slots = (tl_sort_item *)tl_allocate_array(allocator, count, sizeof(tl_sort_item));
    deal->scratch = (tl_sort_item *)tl_allocate_array(allocator, count, sizeof(tl_sort_item));
    return deal->from != NULL && deal->to != NULL && deal->taker != NULL && deal->followers != NULL &&
           deal->slots != NULL && deal->scratch != NULL;
}

static void release_deal(tl_nav_crowd *crowd)
{
    const tl_allocator *allocator = &crowd->allocator;
    const tl_slot_deal *deal = &crowd->deal;
    const uint64_t count = crowd->def.max_members;
    tl_release_array(allocator, deal->from, 2 * count, sizeof(float));
    tl_release_array(allocator, deal->to, 2 * count, sizeof(float));
    tl_release_array(allocator, deal->taker, count, sizeof(uint32_t));
    tl_release_array(allocator, deal->followers, count, sizeof(tl_sort_item));
    tl_release_array(allocator, deal->slots, count, sizeof(tl_sort_item));
    tl_release_array(allocator, deal->scratch, count, sizeof(tl_sort_item));
}

static bool allocate_agents(tl_nav_crowd *crowd)
{
    const tl_nav_crowd_def *def = &crowd->def;
    crowd->state_bytes = tl_crowd_state_bytes(def);
    crowd->head =
        crowd->state_bytes > 0 ? (crowd_head *)tl_allocate_array(&crowd->allocator, crowd->state_bytes, 1) : NULL;
    if (crowd->head == NULL) {
        return false;
    }
    memset(crowd->head, 0, (size_t)crowd->state_bytes);
    crowd->head->magic = CROWD_MAGIC;
    crowd->head->version = CROWD_VERSION;
    crowd->head->size = crowd->state_bytes;
    crowd->head->max_agents = def->max_agents;
    crowd->head->max_path = def->max_path;
    crowd->head->free = CROWD_NO_PLACE;
    crowd->head->max_groups = def->max_groups;
    crowd->head->max_members = def->max_members;
    crowd->a = tl_crowd_fields_at(crowd->head, def);
    return true;
}

static tl_result allocate_queries(tl_nav_crowd *crowd)
{
    crowd->worker_count = tl_worker_count(&crowd->def.host);
    crowd->queries = (tl_nav_query **)tl_allocate_array(&crowd->allocator, crowd->worker_count, sizeof(tl_nav_query *));
    if (crowd->queries == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(crowd->queries, 0, crowd->worker_count * sizeof(tl_nav_query *));
    crowd->runs = (crowd_block_run *)tl_allocate_array(&crowd->allocator, crowd->worker_count, sizeof *crowd->runs);
    if (crowd->runs == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = crowd->def.max_nodes;
    def.allocator = &crowd->allocator;
    for (uint32_t i = 0; i < crowd->worker_count; i++) {
        TL_TRY(tl_nav_query_create(&def, &crowd->queries[i], NULL));
        TL_TRY(tl_nav_query_reserve(crowd->queries[i], def.max_nodes));
    }
    return TL_OK;
}

tl_result tl_nav_crowd_create(const tl_nav_crowd_def *def, tl_nav_crowd **crowd_out, tl_report *report)
{
    tl_report_begin(report, "crowd");
    if (crowd_out != NULL) {
        *crowd_out = NULL;
    }
    TL_REFUSE_NULL(crowd_out, report);
    const tl_nav_crowd_def defaults = tl_default_nav_crowd_def();
    def = def != NULL ? def : &defaults;
    TL_TRY(check_crowd_def(def, report));
    tl_allocator allocator = tl_allocator_or_default(def->host.allocator);
    tl_nav_crowd *crowd = (tl_nav_crowd *)tl_allocate_array(&allocator, 1, sizeof *crowd);
    if (crowd == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(crowd, 0, sizeof *crowd);
    crowd->allocator = allocator;
    crowd->def = *def;
    crowd->def.host.allocator = NULL;
    for (uint32_t i = 0; i < TL_NAV_CROWD_FILTER_COUNT; i++) {
        crowd->filters[i] = tl_default_nav_filter();
    }
    const bool good = allocate_agents(crowd) && allocate_step(crowd) && allocate_trees(crowd) && allocate_deal(crowd);
    tl_result result = good ? TL_OK : TL_ERR_MEMORY;
    result = result == TL_OK ? allocate_queries(crowd) : result;
    if (result != TL_OK) {
        tl_nav_crowd_destroy(crowd);
        return result;
    }
    *crowd_out = crowd;
    return TL_OK;
}

void tl_nav_crowd_destroy(tl_nav_crowd *crowd)
{
    if (crowd == NULL) {
        return;
    }
    for (uint32_t i = 0; crowd->queries != NULL && i < crowd->worker_count; i++) {
        tl_nav_query_destroy(crowd->queries[i]);
    }
    tl_release_array(&crowd->allocator, crowd->runs, crowd->worker_count, sizeof *crowd->runs);
    tl_release_array(&crowd->allocator, crowd->queries, crowd->worker_count, sizeof(tl_nav_query *));
    tl_release_array(&crowd->allocator, crowd->head, crowd->state_bytes, 1);
    release_step(crowd);
    release_trees(crowd);
    release_deal(crowd);
    tl_allocator allocator = crowd->allocator;
    tl_release_array(&allocator, crowd, 1, sizeof *crowd);
}

tl_result tl_nav_crowd_set_filter(tl_nav_crowd *crowd, uint32_t place, const tl_nav_filter *filter)
{
    if (crowd == NULL || place >= TL_NAV_CROWD_FILTER_COUNT) {
        return TL_ERR_ARGUMENT;
    }
    if (filter != NULL &&
        (filter->cookie != TL_DEF_COOKIE || !(filter->slack >= 0.0f && filter->slack <= TL_NAV_MAX_SLACK))) {
        return TL_ERR_ARGUMENT;
    }
    for (uint32_t i = 0; filter != NULL && i <= TL_NAV_MAX_AREA; i++) {
        if (!is_above_zero(filter->area_cost[i])) {
            return TL_ERR_ARGUMENT;
        }
    }
    crowd->filters[place] = filter != NULL ? *filter : tl_default_nav_filter();
    crowd->head->filters_changed = 1;
    tl_crowd_forget_trees(crowd, place);
    return TL_OK;
}
