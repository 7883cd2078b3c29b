// SPDX-License-Identifier: MIT
//
// Floors with walls for crowds, and what is measured of a crowd: overlaps, agents off the mesh, agents too near to
// walls, jitter.

#ifndef TALUS_TEST_CROWD_WORLD_H
#define TALUS_TEST_CROWD_WORLD_H

#include "nav_audit_level.h"

#include <math.h>
#include <stdio.h>
#include <talus/nav_crowd.h>

/// The radius that crowd_bake bakes for.
#define CROWD_BAKE_RADIUS 0.3f

static inline tl_navmesh *crowd_bake(const test_level *level, uint32_t tile_cells)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.1f;
    def.cell_height = 0.1f;
    def.agent_radius = CROWD_BAKE_RADIUS;
    def.agent_height = 1.8f;
    def.agent_max_climb = 0.3f;
    def.tile_size = tile_cells;
    tl_nav_input input = { .mesh = level->mesh };
    return test_nav_bake(&def, &input);
}

/// A floor from -half to half, without walls but its rim.
static inline tl_navmesh *crowd_open_floor(float half_x, float half_z)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -half_x, -half_z, half_x, half_z, 0.0f);
    return crowd_bake(&level, 0);
}

/// Two halls, 20 m by 24 m each, and between them a wall of half a metre with a door of that width.
static inline tl_navmesh *crowd_door_world(float width)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -20.0f, -12.0f, 20.0f, 12.0f, 0.0f);
    audit_block(&level, -0.25f, -1.0f, -12.5f, 0.25f, 3.0f, -0.5f * width);
    audit_block(&level, -0.25f, -1.0f, 0.5f * width, 0.25f, 3.0f, 12.5f);
    return crowd_bake(&level, 0);
}

/// Two floors, `length` metres by 12 each, and between them a ditch of two metres with one link over it, both ways.
static inline tl_navmesh *crowd_ditch_world(float length)
{
    static test_level level;
    memset(&level, 0, sizeof level);
    audit_floor(&level, -1.0f - length, -6.0f, -1.0f, 6.0f, 0.0f);
    audit_floor(&level, 1.0f, -6.0f, 1.0f + length, 6.0f, 0.0f);
    tl_navmesh *navmesh = crowd_bake(&level, 0);
    tl_nav_offmesh jump = tl_default_nav_offmesh();
    tl_nav_ref link;
    jump.start = tl_vec3_make(-1.4f, 0.0f, 0.0f);
    jump.end = tl_vec3_make(1.4f, 0.0f, 0.0f);
    jump.both_ways = true;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &jump, &link, NULL), TL_OK);
    return navmesh;
}

static inline tl_nav_crowd *crowd_make(uint32_t max_agents)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    tl_nav_crowd *crowd = NULL;
    def.max_agents = max_agents;
    TEST_RESULT(tl_nav_crowd_create(&def, &crowd, NULL), TL_OK);
    return crowd;
}

static inline tl_nav_location crowd_place(const tl_navmesh *navmesh, float x, float y, float z)
{
    tl_nav_location at = { TL_NAV_NO_REF, { x, y, z } };
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(x, y, z), tl_vec3_make(2.0f, 1.0f, 2.0f), &at),
                TL_OK);
    return at;
}

/// Adds an agent at a place and, where `goal` is not NULL, sends it there.
static inline tl_nav_agent crowd_send(tl_nav_crowd *crowd, const tl_navmesh *navmesh, tl_nav_agent_def def, float x,
                                      float y, float z, const tl_nav_location *goal)
{
    tl_nav_agent agent = TL_NAV_NO_AGENT;
    def.position = tl_vec3_make(x, y, z);
    TEST_RESULT(tl_nav_crowd_add(crowd, navmesh, &def, &agent, NULL), TL_OK);
    if (goal != NULL) {
        TEST_RESULT(tl_nav_crowd_set_goal(crowd, agent, goal), TL_OK);
    }
    return agent;
}

/// Sums over steps.
typedef struct crowd_measure {
    uint64_t agent_steps;
    uint64_t overlaps; ///< pairs and steps that overlap by more than a hundredth of their radii
    float deepest;     ///< metres
    double depth_sum;  ///< metres, of those
    uint64_t off_mesh; ///< agents and steps
    uint64_t in_walls; ///< agents and steps nearer to a wall than they may be
    double turn_sum;   ///< metres a second: changes of velocity from step to step, of all agents
    double still_sum;  ///< metres: ways of agents that have arrived
    double way;        ///< metres: ways of all agents
    uint32_t steps;
    double arrive_sum; ///< seconds, of those that have arrived: when they did
    uint32_t last_moving;
} crowd_measure;

typedef struct crowd_seen {
    tl_nav_agent_state *states, *before;
    uint32_t count;
} crowd_seen;

static inline void crowd_look(const tl_nav_crowd *crowd, crowd_seen *seen)
{
    tl_nav_agent_state *swap = seen->before;
    seen->before = seen->states;
    seen->states = swap != NULL ? swap : calloc(tl_nav_crowd_count(crowd), sizeof *swap);
    if (seen->before == NULL) {
        seen->before = calloc(tl_nav_crowd_count(crowd), sizeof *swap);
    }
    uint32_t cursor = 0;
    tl_nav_agent agent;
    seen->count = 0;
    while (tl_nav_crowd_next(crowd, &cursor, &agent)) {
        TEST_RESULT(tl_nav_crowd_agent(crowd, agent, &seen->states[seen->count++]), TL_OK);
    }
}

static inline void crowd_seen_free(crowd_seen *seen)
{
    free(seen->states);
    free(seen->before);
}

/// Adds a step to the sums. All pairs are looked at.
static inline void crowd_measure_step(crowd_measure *m, const tl_navmesh *navmesh, tl_nav_query *query,
                                      const crowd_seen *seen)
{
    m->steps++;
    for (uint32_t i = 0; i < seen->count; i++) {
        const tl_nav_agent_state *a = &seen->states[i], *was = &seen->before[i];
        m->agent_steps++;
        if (a->status == TL_NAV_AGENT_FIXED || a->status == TL_NAV_AGENT_ON_LINK) {
            continue;
        }
        tl_vec3 on;
        bool inside = false;
        m->off_mesh += tl_navmesh_closest_point(navmesh, a->polygon, a->position, &on, &inside) != TL_OK ||
                       fabsf(on.y - a->position.y) > 1e-3f ||
                       hypotf(on.x - a->position.x, on.z - a->position.z) > 1e-5f;
        const float room = 0.995f * (a->radius - CROWD_BAKE_RADIUS);
        if (room > 0.0f) {
            const tl_nav_around_request request = { NULL, { a->polygon, a->position }, room };
            tl_nav_wall wall;
            TEST_RESULT(tl_nav_query_find_wall(query, navmesh, &request, &wall), TL_OK);
            m->in_walls += wall.hit && wall.distance < room * 0.9999f;
        }
        if (m->steps > 1) {
            double way =
                hypot((double)a->position.x - (double)was->position.x, (double)a->position.z - (double)was->position.z);
            m->way += way;
            m->still_sum += a->status == TL_NAV_AGENT_ARRIVED && was->status == TL_NAV_AGENT_ARRIVED ? way : 0.0;
            m->turn_sum += (double)hypotf(a->velocity.x - was->velocity.x, a->velocity.z - was->velocity.z);
            m->last_moving = way > 1e-3 ? m->steps : m->last_moving;
        }
        for (uint32_t k = 0; k < i; k++) {
            const tl_nav_agent_state *b = &seen->states[k];
            float rims = a->radius + b->radius;
            float dx = a->position.x - b->position.x, dz = a->position.z - b->position.z;
            if (dx * dx + dz * dz < rims * rims * 0.9801f && fabsf(a->position.y - b->position.y) < a->height) {
                float depth = rims - sqrtf(dx * dx + dz * dz);
                m->overlaps++;
                m->depth_sum += (double)depth;
                m->deepest = depth > m->deepest ? depth : m->deepest;
            }
        }
    }
}

static inline uint32_t crowd_count_status(const crowd_seen *seen, tl_nav_agent_status status)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < seen->count; i++) {
        count += seen->states[i].status == status;
    }
    return count;
}

/// Steps until all agents have arrived, or `max_steps`; returns the steps taken.
static inline uint32_t crowd_run(tl_nav_crowd *crowd, const tl_navmesh *navmesh, float dt, uint32_t max_steps,
                                 crowd_measure *m)
{
    crowd_seen seen = { NULL, NULL, 0 };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    memset(m, 0, sizeof *m);
    uint32_t step = 0;
    for (bool done = false; !done && step < max_steps; step++) {
        tl_nav_crowd_step_report report;
        TEST_RESULT(tl_nav_crowd_step(crowd, navmesh, dt, &report), TL_OK);
        crowd_look(crowd, &seen);
        crowd_measure_step(m, navmesh, query, &seen);
        done = report.arrived == seen.count;
    }
    crowd_seen_free(&seen);
    tl_nav_query_destroy(query);
    return step;
}

static inline void crowd_print(const char *name, const crowd_measure *m, float dt)
{
    print_message("%-14s %6.1f s  overlaps/1000 %.2f  deepest %.3f m  mean %.3f  off %u  walls %u  turn %.3f m/s/step "
                  " still %.4f m  way %.0f\n",
                  name, (double)((float)m->steps * dt), 1000.0 * (double)m->overlaps / (double)m->agent_steps,
                  (double)m->deepest, m->overlaps > 0 ? m->depth_sum / (double)m->overlaps : 0.0, (unsigned)m->off_mesh,
                  (unsigned)m->in_walls, m->turn_sum / (double)m->agent_steps, m->still_sum, m->way);
}

#endif
