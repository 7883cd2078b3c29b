// SPDX-License-Identifier: MIT
//
// Off-mesh links, taken by one agent at a time: whoever has waited longest at one goes next, ties by place.

#include "base/hash.h"
#include "nav_crowd/crowd.h"

#include <string.h>

// Metres a second below which nobody takes a link: an agent without speed would stay on it for ever.
#define MIN_LINK_SPEED 0.1f

static crowd_link_run *run_of(const tl_nav_crowd *crowd, uint32_t i)
{
    return (crowd_link_run *)(void *)&crowd->a.walls[(size_t)i * 4 * CROWD_MAX_WALLS];
}

static void land_agent(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    const crowd_link_run *run = run_of(crowd, i);
    tl_nav_location at = { a->path[(size_t)i * crowd->def.max_path], tl_vec3_make(run->to[0], run->to[1], run->to[2]) };
    memset(&a->walls[(size_t)i * 4 * CROWD_MAX_WALLS], 0, 4 * CROWD_MAX_WALLS * sizeof(float));
    a->link[i] = TL_NAV_NO_REF;
    a->wall_slack[i] = -1.0f;
    const bool has_goal = (a->flags[i] & CROWD_HAS_GOAL) != 0;
    a->status[i] = has_goal ? TL_NAV_AGENT_WALKING : TL_NAV_AGENT_IDLE;
    tl_crowd_set_position(crowd, i, at.point);
    a->clearance[i] = tl_crowd_clearance(step->navmesh, at.polygon, a->radius[i]);
    if (!has_goal) {
        tl_crowd_reset_corridor(crowd, i, &at);
    }
    // What was removed meanwhile is noticed as after an edit.
    tl_crowd_revalidate(step, i);
}

void tl_crowd_follow_link(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_link_run *run = run_of(crowd, i);
    run->elapsed += step->dt;
    if (run->elapsed >= run->duration) {
        land_agent(step, i);
        return;
    }
    float t = run->elapsed / run->duration;
    tl_vec3 at =
        tl_vec3_make(run->from[0] + t * (run->to[0] - run->from[0]), run->from[1] + t * (run->to[1] - run->from[1]),
                     run->from[2] + t * (run->to[2] - run->from[2]));
    tl_crowd_set_position(crowd, i, at);
}

// The agent steps onto its link: its corridor begins where that lands.
static void take_link(const crowd_step *step, uint32_t i)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    tl_nav_location ends[2];
    const tl_vec3 from = corridor.position;
    if (tl_nav_corridor_pass_link(&corridor, step->navmesh, ends, NULL) != TL_OK) {
        a->status[i] = TL_NAV_AGENT_WALKING;
        a->link[i] = TL_NAV_NO_REF;
        a->flags[i] |= CROWD_NEED_PATH;
        return;
    }
    tl_crowd_keep_corridor(crowd, i, &corridor);
    tl_crowd_set_position(crowd, i, from);
    float speed = a->max_speed[i] > MIN_LINK_SPEED ? a->max_speed[i] : MIN_LINK_SPEED;
    crowd_link_run run;
    memset(&run, 0, sizeof run);
    tl_crowd_set3(run.from, 0, from);
    tl_crowd_set3(run.to, 0, ends[1].point);
    run.duration = tl_distance(from, ends[1].point) / speed;
    memset(&a->walls[(size_t)i * 4 * CROWD_MAX_WALLS], 0, 4 * CROWD_MAX_WALLS * sizeof(float));
    memcpy(run_of(crowd, i), &run, sizeof run);
    float rate = run.duration > 0.0f ? 1.0f / run.duration : 0.0f;
    a->vx[i] = (run.to[0] - run.from[0]) * rate;
    a->vz[i] = (run.to[2] - run.from[2]) * rate;
    a->wanted_x[i] = a->vx[i];
    a->wanted_z[i] = a->vz[i];
    a->status[i] = TL_NAV_AGENT_ON_LINK;
    a->wall_count[i] = 0;
    a->next_free[i] = 0;
}

// The entry of an agent's link: a place of one that uses or claims it, or the empty entry where that belongs. The table
// is that of the grid, which has done its work in this step.
static uint32_t *find_user(const tl_nav_crowd *crowd, uint64_t link)
{
    uint32_t *table = crowd->grid.first;
    const uint32_t mask = crowd->grid.cell_count - 1;
    // A link is one, from whichever end it is taken.
    link &= ~TL_NAV_OFFMESH_BACKWARD;
    uint32_t at = (uint32_t)tl_hash_mix(link) & mask;
    while (table[at] != CROWD_NO_PLACE && (crowd->a.link[table[at]] & ~TL_NAV_OFFMESH_BACKWARD) != link) {
        at = (at + 1) & mask;
    }
    return &table[at];
}

void tl_crowd_grant_links(const crowd_step *step)
{
    tl_nav_crowd *crowd = step->crowd;
    const crowd_fields *a = &crowd->a;
    const uint32_t used = crowd->head->used;
    bool is_any = false;
    for (uint32_t i = 0; i < used; i++) {
        is_any = is_any || a->status[i] == TL_NAV_AGENT_QUEUED;
    }
    if (!is_any) {
        return;
    }
    memset(crowd->grid.first, 0xff, (size_t)crowd->grid.cell_count * sizeof *crowd->grid.first);
    for (uint32_t i = 0; i < used; i++) {
        if (a->status[i] == TL_NAV_AGENT_ON_LINK) {
            *find_user(crowd, a->link[i]) = i;
        }
    }
    for (uint32_t i = 0; i < used; i++) {
        if (a->status[i] == TL_NAV_AGENT_QUEUED) {
            uint32_t *user = find_user(crowd, a->link[i]);
            bool is_better = *user == CROWD_NO_PLACE ||
                             (a->status[*user] == TL_NAV_AGENT_QUEUED && a->next_free[i] > a->next_free[*user]);
            *user = is_better ? i : *user;
        }
    }
    for (uint32_t c = 0; c < crowd->grid.cell_count; c++) {
        uint32_t i = crowd->grid.first[c];
        if (i != CROWD_NO_PLACE && a->status[i] == TL_NAV_AGENT_QUEUED) {
            take_link(step, i);
        }
    }
}
