// SPDX-License-Identifier: MIT
//
// Groups stand at their start as sunflower seeds do (Vogel 1979): on a spiral of golden angles every place has the same
// room. Places off the navmesh, or on another island, are passed over.

#include "cli/crowd/crowd_run.h"

#include "cli/shared/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRIES_A_PLACE = 64 };

#define TOUCH 1e-3f // metres: overlaps that nobody sees are none

// One agent of a group on its way through the goals.
typedef struct walker {
    tl_nav_agent agent;
    uint32_t group, next_goal;
    bool follows; // the first of its group
    bool has_set_out, is_done;
    float done_at; // seconds; below 0: has not arrived
} walker;

typedef struct crowd_run {
    tl_cli *cli;
    const tl_navmesh *navmesh;
    const tl_crowd_scenario *scenario;
    tl_crowd_obstacles *obstacles; // NULL: none
    tl_nav_crowd *crowd;
    tl_nav_location **goals; // [group] on the navmesh
    walker *walkers;
    tl_nav_agent *vehicles;
    tl_crowd_film *film;
    tl_crowd_outcome *outcome;
    uint32_t *order;  // of the film's people, by x
    uint32_t waiting; // paths that are still to be searched after the last step
} crowd_run;

static bool locate(const crowd_run *run, tl_vec3 point, uint32_t group, const char *what, tl_nav_location *location,
                   tl_exit *exit_out)
{
    const tl_vec3 extents = { 2.0f, 4.0f, 2.0f };
    if (tl_navmesh_find_nearest(run->navmesh, NULL, point, extents, location) == TL_OK) {
        return true;
    }
    *exit_out = tl_cli_fail(run->cli, TL_EXIT_DATA, "groups[%u]: no navmesh within 2 m of its %s", group, what);
    return false;
}

static bool add_walker(crowd_run *run, const tl_crowd_group *group, tl_vec3 place, walker *who, tl_exit *exit_out)
{
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.position = place;
    def.radius = group->radius;
    def.height = group->height;
    def.max_speed = group->speed;
    def.priority = group->priority;
    tl_report report;
    memset(&report, 0, sizeof(report));
    const tl_result result = tl_nav_crowd_add(run->crowd, run->navmesh, &def, &who->agent, &report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(run->cli, "scenario", result, &report);
    }
    return result == TL_OK;
}

static bool form_group(crowd_run *run, const tl_crowd_group *group, walker *walkers, tl_exit *exit_out)
{
    tl_nav_agent *agents = calloc(group->count, sizeof(*agents));
    if (agents == NULL) {
        *exit_out = tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    for (uint32_t i = 0; i < group->count; ++i) {
        agents[i] = walkers[i].agent;
        walkers[i].follows = i > 0;
    }
    tl_nav_group_def form = group->form;
    form.slots = group->slots;
    tl_nav_group formed;
    tl_report report;
    memset(&report, 0, sizeof(report));
    const tl_result result = tl_nav_crowd_add_group(run->crowd, &form, agents, group->count, &formed, &report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(run->cli, "scenario", result, &report);
    }
    free(agents);
    return result == TL_OK;
}

static bool place_group(crowd_run *run, uint32_t index, walker *walkers, tl_exit *exit_out)
{
    const tl_crowd_group *group = &run->scenario->groups[index];
    tl_nav_location center;
    uint32_t island = 0, other = 0, placed = 0;
    if (!locate(run, group->at, index, "\"at\"", &center, exit_out)) {
        return false;
    }
    tl_navmesh_island(run->navmesh, center.polygon, &island);
    const tl_vec3 extents = { 0.25f * group->spacing, 2.0f, 0.25f * group->spacing };
    for (uint64_t i = 0; placed < group->count && i < (uint64_t)TRIES_A_PLACE * group->count + TRIES_A_PLACE; ++i) {
        const double away =
            0.564 * (double)group->spacing * sqrt((double)i); // 1 / sqrt(pi): spacing^2 of room for each
        const double angle = 2.39996322972865332 * (double)i;
        const tl_vec3 place = { center.point.x + (float)(away * cos(angle)), center.point.y,
                                center.point.z + (float)(away * sin(angle)) };
        tl_nav_location at;
        if (tl_navmesh_find_nearest(run->navmesh, NULL, place, extents, &at) != TL_OK ||
            tl_navmesh_island(run->navmesh, at.polygon, &other) != TL_OK || other != island) {
            continue;
        }
        walkers[placed].group = index;
        walkers[placed].done_at = -1.0f;
        if (!add_walker(run, group, at.point, &walkers[placed++], exit_out)) {
            return false;
        }
    }
    if (placed < group->count) {
        *exit_out =
            tl_cli_fail(run->cli, TL_EXIT_DATA, "groups[%u]: there is room for %u of %u agents around its \"at\"",
                        index, placed, group->count);
        return false;
    }
    return !group->is_formed || form_group(run, group, walkers, exit_out);
}

static bool find_goals(crowd_run *run, uint32_t index, tl_exit *exit_out)
{
    const tl_crowd_group *group = &run->scenario->groups[index];
    run->goals[index] = calloc(group->goal_count, sizeof(**run->goals));
    if (run->goals[index] == NULL) {
        *exit_out = tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    for (uint32_t i = 0; i < group->goal_count; ++i) {
        char what[32];
        snprintf(what, sizeof(what), "goals[%u]", i);
        if (!locate(run, group->goals[i], index, what, &run->goals[index][i], exit_out)) {
            return false;
        }
    }
    return true;
}

// Where a vehicle is at a time, and how fast.
static tl_vec3 vehicle_place(const tl_crowd_vehicle *vehicle, float time, tl_vec3 *velocity)
{
    const tl_vec3 way = tl_sub(vehicle->to, vehicle->from);
    const float length = tl_length(way);
    const float driven = vehicle->speed * (time - vehicle->start);
    *velocity = tl_vec3_make(0.0f, 0.0f, 0.0f);
    if (!(driven > 0.0f) || !(length > 0.0f)) {
        return vehicle->from;
    }
    if (driven >= length) {
        return vehicle->to;
    }
    *velocity = tl_scale(way, vehicle->speed / length);
    return tl_mul_add(vehicle->from, way, driven / length);
}

static bool add_vehicles(crowd_run *run, tl_exit *exit_out)
{
    for (uint32_t i = 0; i < run->scenario->vehicle_count; ++i) {
        const tl_crowd_vehicle *vehicle = &run->scenario->vehicles[i];
        tl_nav_agent_def def = tl_default_nav_agent_def();
        def.position = vehicle->from;
        def.radius = vehicle->radius;
        def.height = vehicle->height;
        def.is_fixed = true;
        tl_report report;
        memset(&report, 0, sizeof(report));
        const tl_result result = tl_nav_crowd_add(run->crowd, run->navmesh, &def, &run->vehicles[i], &report);
        if (result != TL_OK) {
            *exit_out = tl_cli_fail_result(run->cli, "scenario", result, &report);
            return false;
        }
    }
    return true;
}

static bool set_up(crowd_run *run, tl_exit *exit_out)
{
    const tl_crowd_scenario *s = run->scenario;
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = s->agent_count + s->vehicle_count;
    def.max_groups = s->group_count;
    def.max_members = s->agent_count;
    def.host.tasks = run->cli->host.tasks;
    run->film->who_count = def.max_agents;
    run->goals = calloc(s->group_count, sizeof(*run->goals));
    run->walkers = calloc(s->agent_count, sizeof(*run->walkers));
    run->vehicles = calloc((size_t)s->vehicle_count + 1, sizeof(*run->vehicles));
    run->order = calloc(def.max_agents, sizeof(*run->order));
    run->film->group_of = calloc(def.max_agents, sizeof(*run->film->group_of));
    run->film->radius = calloc(def.max_agents, sizeof(*run->film->radius));
    run->film->height = calloc(def.max_agents, sizeof(*run->film->height));
    if (run->goals == NULL || run->walkers == NULL || run->vehicles == NULL || run->order == NULL ||
        run->film->group_of == NULL || run->film->radius == NULL || run->film->height == NULL ||
        tl_nav_crowd_create(&def, &run->crowd, NULL) != TL_OK) {
        *exit_out = tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    uint32_t placed = 0;
    for (uint32_t i = 0; i < s->group_count; ++i) {
        if (!find_goals(run, i, exit_out) || !place_group(run, i, run->walkers + placed, exit_out)) {
            return false;
        }
        placed += s->groups[i].count;
    }
    for (uint32_t i = 0; i < def.max_agents; ++i) {
        const bool walks = i < placed;
        const uint32_t group = walks ? run->walkers[i].group : s->group_count;
        run->film->group_of[i] = group;
        run->film->radius[i] = walks ? s->groups[group].radius : s->vehicles[i - placed].radius;
        run->film->height[i] = walks ? s->groups[group].height : s->vehicles[i - placed].height;
    }
    return add_vehicles(run, exit_out);
}

static tl_nav_agent agent_of(const crowd_run *run, uint32_t who)
{
    const uint32_t walkers = run->scenario->agent_count;
    return who < walkers ? run->walkers[who].agent : run->vehicles[who - walkers];
}

static void head_for_next(const crowd_run *run, walker *who)
{
    const tl_crowd_group *group = &run->scenario->groups[who->group];
    if (who->next_goal == group->goal_count) {
        who->next_goal = 0;
    }
    tl_nav_crowd_set_goal(run->crowd, who->agent, &run->goals[who->group][who->next_goal++]);
}

// Whether what is unreachable may become reachable: an obstacle comes or goes later, or that has not been looked at
// yet.
static bool may_open(const crowd_run *run, float time)
{
    return run->obstacles != NULL &&
           (time <= run->obstacles->last_change + 2.0f * run->scenario->step || run->waiting > 0);
}

// One that follows has arrived when it stands in its slot and its leader is done, who is the first of its group.
static void look_after_follower(const crowd_run *run, walker *who, const walker *leader, float time)
{
    tl_nav_agent_state state;
    tl_nav_crowd_agent(run->crowd, who->agent, &state);
    who->has_set_out = true;
    if (leader->is_done && !who->is_done && state.status == TL_NAV_AGENT_ARRIVED) {
        who->is_done = true;
        who->done_at = time;
        run->outcome->arrived++;
    } else if (leader->is_done && !who->is_done && leader->done_at < 0.0f) {
        who->is_done = true; // as unreachable as it is for the leader
        run->outcome->unreachable++;
    }
}

// Sends a walker on: at its start, and from each goal to the next.
static void guide(const crowd_run *run, walker *who, float time)
{
    const tl_crowd_group *group = &run->scenario->groups[who->group];
    if (!who->has_set_out) {
        who->has_set_out = time >= group->start;
        if (who->has_set_out) {
            head_for_next(run, who);
        }
        return;
    }
    if (who->is_done) {
        return;
    }
    tl_nav_agent_state state;
    tl_nav_crowd_agent(run->crowd, who->agent, &state);
    if (state.status == TL_NAV_AGENT_UNREACHABLE || state.status == TL_NAV_AGENT_GAVE_UP) {
        if (may_open(run, time)) {
            return; // it stands as near as it came, and tries again when the level changes
        }
        who->is_done = true;
        run->outcome->unreachable++;
    } else if (state.status == TL_NAV_AGENT_ARRIVED) {
        const bool is_last = who->next_goal == group->goal_count;
        if (is_last && who->done_at < 0.0f) {
            who->done_at = time;
            run->outcome->arrived++;
        }
        who->is_done = is_last && !group->repeat;
        if (!who->is_done) {
            head_for_next(run, who);
        }
    }
}

static bool record(const crowd_run *run)
{
    tl_crowd_film *film = run->film;
    if (film->frame_count == film->frame_capacity) {
        const uint32_t capacity = film->frame_capacity > 0 ? 2 * film->frame_capacity : 64;
        const size_t count = (size_t)capacity * film->who_count;
        tl_vec3 *places = realloc(film->places, count * sizeof(*places));
        film->places = places != NULL ? places : film->places;
        uint8_t *status = realloc(film->status, count);
        film->status = status != NULL ? status : film->status;
        if (places == NULL || status == NULL) {
            return false;
        }
        film->frame_capacity = capacity;
    }
    const size_t first = (size_t)film->frame_count * film->who_count;
    for (uint32_t i = 0; i < film->who_count; ++i) {
        tl_nav_agent_state state;
        tl_nav_crowd_agent(run->crowd, agent_of(run, i), &state);
        film->places[first + i] = state.position;
        film->status[first + i] = (uint8_t)state.status;
    }
    film->frame_count++;
    return true;
}

// Insertion sort: from one frame to the next the order hardly changes.
static void sort_by_x(uint32_t *order, uint32_t count, const tl_vec3 *places)
{
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t who = order[i];
        uint32_t k = i;
        for (; k > 0 && places[order[k - 1]].x > places[who].x; --k) {
            order[k] = order[k - 1];
        }
        order[k] = who;
    }
}

static void count_overlaps(const crowd_run *run, float largest_radius)
{
    const tl_crowd_film *film = run->film;
    const uint32_t count = film->who_count;
    const tl_vec3 *places = film->places + (size_t)(film->frame_count - 1) * count;
    sort_by_x(run->order, count, places);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t a = run->order[i];
        const float reach = film->radius[a] + largest_radius;
        for (uint32_t k = i + 1; k < count && places[run->order[k]].x - places[a].x < reach; ++k) {
            const uint32_t b = run->order[k];
            const float dx = places[a].x - places[b].x, dz = places[a].z - places[b].z;
            const float depth = film->radius[a] + film->radius[b] - sqrtf(dx * dx + dz * dz);
            const bool same_floor =
                places[a].y < places[b].y + film->height[b] && places[b].y < places[a].y + film->height[a];
            if (depth > TOUCH && same_floor) {
                run->outcome->pairs++;
                run->outcome->deepest = depth > run->outcome->deepest ? depth : run->outcome->deepest;
            }
        }
    }
}

static bool step_once(crowd_run *run, float time)
{
    const tl_crowd_scenario *s = run->scenario;
    bool is_over = true;
    uint32_t leader = 0;
    for (uint32_t i = 0; i < s->agent_count; ++i) {
        if (run->walkers[i].follows) {
            look_after_follower(run, &run->walkers[i], &run->walkers[leader], time);
        } else {
            guide(run, &run->walkers[i], time);
            leader = i;
        }
        is_over = is_over && run->walkers[i].is_done;
    }
    for (uint32_t i = 0; i < s->vehicle_count; ++i) {
        tl_vec3 velocity;
        const tl_vec3 place = vehicle_place(&s->vehicles[i], time, &velocity);
        tl_nav_crowd_set_motion(run->crowd, run->vehicles[i], place, velocity);
    }
    const double begin = tl_clock_seconds();
    tl_nav_crowd_step_report report;
    tl_nav_crowd_step(run->crowd, run->navmesh, s->step, &report);
    run->waiting = report.waiting;
    run->outcome->compute_seconds += tl_clock_seconds() - begin;
    run->outcome->agent_steps += s->agent_count;
    return is_over;
}

static bool run_steps(crowd_run *run, tl_exit *exit_out)
{
    const tl_crowd_scenario *s = run->scenario;
    float largest_radius = 0.0f;
    for (uint32_t i = 0; i < run->film->who_count; ++i) {
        largest_radius = fmaxf(largest_radius, run->film->radius[i]);
        run->order[i] = i;
    }
    const tl_progress *progress = run->cli->host.progress;
    const uint64_t steps = (uint64_t)ceil((double)s->seconds / (double)s->step);
    bool is_over = false;
    for (uint64_t i = 0; i <= steps && !is_over; ++i) {
        const double time = (double)i * (double)s->step;
        if (progress != NULL && !progress->update("steps", i, steps, progress->user)) {
            *exit_out = tl_cli_fail(run->cli, TL_EXIT_CANCELLED, "cancelled");
            return false;
        }
        if (time + 1e-6 >= (double)run->film->frame_count * (double)run->film->interval) {
            if (!record(run)) {
                *exit_out = tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
                return false;
            }
            count_overlaps(run, largest_radius);
        }
        if (run->obstacles != NULL && !tl_crowd_obstacles_set_time(run->cli, run->obstacles, (float)time, exit_out)) {
            return false;
        }
        run->outcome->seconds = (float)time;
        is_over = i < steps && step_once(run, (float)time);
    }
    return true;
}

static int compare_times(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static bool sum_up(const crowd_run *run, tl_exit *exit_out)
{
    tl_crowd_outcome *outcome = run->outcome;
    const uint32_t count = run->scenario->agent_count;
    float *times = calloc(count, sizeof(*times));
    if (times == NULL) {
        *exit_out = tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    uint32_t arrived = 0;
    for (uint32_t i = 0; i < count; ++i) {
        tl_nav_agent_state state;
        tl_nav_crowd_agent(run->crowd, run->walkers[i].agent, &state);
        outcome->off_mesh += state.status == TL_NAV_AGENT_OFF_MESH;
        if (run->walkers[i].done_at >= 0.0f) {
            times[arrived++] = run->walkers[i].done_at;
        }
    }
    qsort(times, arrived, sizeof(*times), compare_times);
    outcome->half = arrived > 0 ? times[(arrived - 1) / 2] : 0.0f;
    outcome->last = arrived > 0 ? times[arrived - 1] : 0.0f;
    outcome->hash = tl_nav_crowd_hash(run->crowd);
    free(times);
    return true;
}

bool tl_crowd_run(tl_cli *cli, const tl_crowd_stage *stage, float interval, tl_crowd_film *film_out,
                  tl_crowd_outcome *outcome_out, tl_exit *exit_out)
{
    const tl_crowd_scenario *scenario = stage->scenario;
    memset(film_out, 0, sizeof(*film_out));
    memset(outcome_out, 0, sizeof(*outcome_out));
    film_out->interval = interval;
    crowd_run run;
    memset(&run, 0, sizeof(run));
    run.cli = cli;
    run.navmesh = stage->navmesh;
    run.scenario = scenario;
    run.obstacles = stage->obstacles;
    run.film = film_out;
    run.outcome = outcome_out;
    const bool good = set_up(&run, exit_out) && run_steps(&run, exit_out) && sum_up(&run, exit_out) &&
                      (run.obstacles == NULL || tl_crowd_obstacles_set_time(cli, run.obstacles, -1.0f, exit_out));
    tl_nav_crowd_destroy(run.crowd);
    for (uint32_t i = 0; run.goals != NULL && i < scenario->group_count; ++i) {
        free(run.goals[i]);
    }
    free(run.goals);
    free(run.walkers);
    free(run.vehicles);
    free(run.order);
    return good;
}

void tl_crowd_film_free(tl_crowd_film *film)
{
    free(film->group_of);
    free(film->radius);
    free(film->height);
    free(film->places);
    free(film->status);
    memset(film, 0, sizeof(*film));
}
