// SPDX-License-Identifier: MIT
//
// Crowds and their groups. JavaScript reads a def's defaults from the slot, changes what it was told, and writes it
// back. Agents and groups are 64-bit names.

#include "js_navmesh.h"

#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// The crowd.

/// Slot: the numbers of a crowd's def.
void TL_JS_FULL_EXPORT(js_crowd_default)(void)
{
    const tl_nav_crowd_def d = tl_default_nav_crowd_def();
    const double numbers[] = { d.max_agents,
                               d.max_path,
                               d.max_neighbors,
                               d.paths_per_step,
                               d.max_nodes,
                               d.max_shared_goals,
                               d.max_groups,
                               d.max_members,
                               (double)d.neighbor_distance,
                               (double)d.agent_horizon,
                               (double)d.wall_horizon };
    memcpy(tl_js_slot, numbers, sizeof numbers);
}

/// Slot: those numbers; then the result.
tl_nav_crowd *TL_JS_FULL_EXPORT(js_crowd_create)(void)
{
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    uint32_t *const counts[] = { &def.max_agents, &def.max_path,         &def.max_neighbors, &def.paths_per_step,
                                 &def.max_nodes,  &def.max_shared_goals, &def.max_groups,    &def.max_members };
    const uint32_t count = sizeof counts / sizeof counts[0];
    for (uint32_t i = 0; i < count; i++) {
        *counts[i] = tl_js_u32(i);
    }
    def.neighbor_distance = tl_js_f32(count);
    def.agent_horizon = tl_js_f32(count + 1);
    def.wall_horizon = tl_js_f32(count + 2);
    def.host = *tl_js_host();
    tl_nav_crowd *crowd = NULL;
    tl_js_put(0, tl_nav_crowd_create(&def, &crowd, &tl_js_report));
    return crowd;
}

void TL_JS_FULL_EXPORT(js_crowd_free)(tl_nav_crowd *crowd)
{
    tl_nav_crowd_destroy(crowd);
}

/// The filter that was set last, or the default one, at a place.
tl_result TL_JS_FULL_EXPORT(js_crowd_set_filter)(tl_nav_crowd *crowd, uint32_t place, uint32_t flags)
{
    return tl_nav_crowd_set_filter(crowd, place, tl_js_filter_of(flags));
}

/// Slot: what the step did.
tl_result TL_JS_FULL_EXPORT(js_crowd_step)(tl_nav_crowd *crowd, const tl_js_navmesh *navmesh, float dt)
{
    tl_nav_crowd_step_report r;
    memset(&r, 0, sizeof r);
    const tl_result result = tl_nav_crowd_step(crowd, navmesh->navmesh, dt, &r);
    const double numbers[] = { r.searched,    r.waiting, r.walking,  r.arrived,
                               r.unreachable, r.on_link, r.off_mesh, r.shared };
    memcpy(tl_js_slot, numbers, sizeof numbers);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Agents.

/// Slot: the numbers of an agent's def.
void TL_JS_FULL_EXPORT(js_agent_default)(void)
{
    const tl_nav_agent_def d = tl_default_nav_agent_def();
    const uint32_t at = tl_js_put_vec3(0, d.position);
    const double numbers[] = { (double)d.reach,
                               (double)d.radius,
                               (double)d.height,
                               (double)d.max_speed,
                               (double)d.max_acceleration,
                               (double)d.arrive_distance,
                               (double)d.priority,
                               d.filter,
                               d.is_fixed };
    memcpy(tl_js_slot + at, numbers, sizeof numbers);
}

/// Slot: those numbers; then the agent.
tl_result TL_JS_FULL_EXPORT(js_crowd_add)(tl_nav_crowd *crowd, const tl_js_navmesh *navmesh)
{
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.position = tl_js_vec3(0);
    float *const floats[] = { &def.reach,           &def.radius,  &def.height, &def.max_speed, &def.max_acceleration,
                              &def.arrive_distance, &def.priority };
    uint32_t at = 3;
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++) {
        *floats[i] = tl_js_f32(at++);
    }
    def.filter = tl_js_u32(at);
    def.is_fixed = tl_js_slot[at + 1] != 0.0;
    tl_nav_agent agent = TL_NAV_NO_AGENT;
    const tl_result result = tl_nav_crowd_add(crowd, navmesh->navmesh, &def, &agent, &tl_js_report);
    tl_js_put_u64(0, agent);
    return result;
}

/// Slot: the agent.
tl_result TL_JS_FULL_EXPORT(js_crowd_remove)(tl_nav_crowd *crowd)
{
    return tl_nav_crowd_remove(crowd, tl_js_u64(0));
}

/// Slot: the agent, then a place.
tl_result TL_JS_FULL_EXPORT(js_crowd_set_goal)(tl_nav_crowd *crowd, int32_t has_goal)
{
    const tl_nav_location goal = tl_js_place(1);
    return tl_nav_crowd_set_goal(crowd, tl_js_u64(0), has_goal ? &goal : NULL);
}

/// Slot: the agent, position, velocity.
tl_result TL_JS_FULL_EXPORT(js_crowd_set_motion)(tl_nav_crowd *crowd)
{
    return tl_nav_crowd_set_motion(crowd, tl_js_u64(0), tl_js_vec3(1), tl_js_vec3(4));
}

/// Slot: the agent; then its state.
tl_result TL_JS_FULL_EXPORT(js_crowd_agent)(const tl_nav_crowd *crowd)
{
    tl_nav_agent_state s;
    const tl_result result = tl_nav_crowd_agent(crowd, tl_js_u64(0), &s);
    if (result != TL_OK) {
        return result;
    }
    uint32_t at = tl_js_put_pointer(0, tl_nav_agent_status_name(s.status));
    at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_vec3(at, s.position), s.velocity), s.wanted);
    at = tl_js_put_vec3(tl_js_put_u64(tl_js_put_u64(at, s.polygon), s.link), s.goal);
    tl_js_put(tl_js_put(at, (double)s.radius), (double)s.height);
    return result;
}

/// All agents, as an array a quantity: names, positions, velocities, statuses in a byte each. Slot: how many, and
/// where.
tl_result TL_JS_FULL_EXPORT(js_crowd_agents)(const tl_nav_crowd *crowd)
{
    const uint32_t count = tl_nav_crowd_count(crowd);
    tl_nav_agent *names = tl_js_buffer_room(count * (sizeof *names + 2 * sizeof(tl_vec3) + 1));
    if (names == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_vec3 *positions = (tl_vec3 *)(void *)(names + count), *velocities = positions + count;
    uint8_t *statuses = (uint8_t *)(velocities + count);
    uint32_t cursor = 0, n = 0;
    tl_nav_agent agent;
    while (n < count && tl_nav_crowd_next(crowd, &cursor, &agent)) {
        tl_nav_agent_state s;
        const tl_result result = tl_nav_crowd_agent(crowd, agent, &s);
        if (result != TL_OK) {
            return result;
        }
        names[n] = agent;
        positions[n] = s.position;
        velocities[n] = s.velocity;
        statuses[n++] = (uint8_t)s.status;
    }
    tl_js_put_pointer(tl_js_put(0, n), names);
    return TL_OK;
}

const char *TL_JS_FULL_EXPORT(js_agent_status)(uint32_t status)
{
    return tl_nav_agent_status_name((tl_nav_agent_status)status);
}

/// Slot: the agent; then how many corners its corridor has, and where: three numbers each.
tl_result TL_JS_FULL_EXPORT(js_crowd_corners)(const tl_nav_crowd *crowd, const tl_js_navmesh *navmesh)
{
    const tl_nav_agent agent = tl_js_u64(0);
    uint32_t count = 64;
    tl_nav_corner *corners = NULL;
    tl_result result = TL_INCOMPLETE;
    while (result == TL_INCOMPLETE) {
        const uint32_t room = count;
        corners = tl_js_buffer_room(room * sizeof *corners);
        if (corners == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_nav_crowd_corners(crowd, navmesh->navmesh, agent, corners, room, &count);
    }
    float *points = (float *)(void *)corners;
    for (uint32_t i = 0; result == TL_OK && i < count; i++) {
        const tl_vec3 p = corners[i].point; // read before its place is written: a corner is larger than a point
        memcpy(points + 3 * (size_t)i, &p, sizeof p);
    }
    tl_js_put_pointer(tl_js_put(0, result == TL_OK ? count : 0), points);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Groups.

// Slot: formation, spacing, distances to wait and to be lost, whether the order is kept, then the slots' address.
static tl_nav_group_def group_def(uint32_t at)
{
    tl_nav_group_def def = tl_default_nav_group_def();
    def.formation = (tl_nav_formation)tl_js_u32(at);
    def.spacing = tl_js_f32(at + 1);
    def.wait_distance = tl_js_f32(at + 2);
    def.lost_distance = tl_js_f32(at + 3);
    def.keep_order = tl_js_slot[at + 4] != 0.0;
    def.slots = (const tl_nav_formation_slot *)(uintptr_t)tl_js_slot[at + 5];
    return def;
}

/// Slot: the numbers of a group's def.
void TL_JS_FULL_EXPORT(js_group_default)(void)
{
    const tl_nav_group_def d = tl_default_nav_group_def();
    const uint32_t at = tl_js_put(tl_js_put(0, d.formation), (double)d.spacing);
    tl_js_put(tl_js_put(tl_js_put(at, (double)d.wait_distance), (double)d.lost_distance), d.keep_order);
}

/// Slot: a def; then the group.
tl_result TL_JS_FULL_EXPORT(js_crowd_add_group)(tl_nav_crowd *crowd, const tl_nav_agent *agents, uint32_t count)
{
    const tl_nav_group_def def = group_def(0);
    tl_nav_group group = TL_NAV_NO_GROUP;
    const tl_result result = tl_nav_crowd_add_group(crowd, &def, agents, count, &group, &tl_js_report);
    tl_js_put_u64(0, group);
    return result;
}

/// Slot: the group.
tl_result TL_JS_FULL_EXPORT(js_crowd_remove_group)(tl_nav_crowd *crowd)
{
    return tl_nav_crowd_remove_group(crowd, tl_js_u64(0));
}

/// Slot: a def, then at 6 the group.
tl_result TL_JS_FULL_EXPORT(js_crowd_set_formation)(tl_nav_crowd *crowd)
{
    const tl_nav_group_def def = group_def(0);
    return tl_nav_crowd_set_formation(crowd, tl_js_u64(6), &def, &tl_js_report);
}

/// Slot: the group; then its state.
tl_result TL_JS_FULL_EXPORT(js_crowd_group)(const tl_nav_crowd *crowd)
{
    tl_nav_group_state s;
    const tl_result result = tl_nav_crowd_group(crowd, tl_js_u64(0), &s);
    if (result != TL_OK) {
        return result;
    }
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(tl_js_put(0, s.formation), s.count), s.in_place), s.on_trail);
    at = tl_js_put_vec3(tl_js_put(tl_js_put(at, (double)s.lag), (double)s.speed), s.heading);
    tl_js_put_u64(at, s.leader);
    return result;
}

/// Slot: the group; then how many agents it has, and where their names are.
tl_result TL_JS_FULL_EXPORT(js_crowd_members)(const tl_nav_crowd *crowd)
{
    const tl_nav_group group = tl_js_u64(0);
    uint32_t count = 64;
    tl_nav_agent *agents = NULL;
    tl_result result = TL_INCOMPLETE;
    while (result == TL_INCOMPLETE) {
        const uint32_t room = count;
        agents = tl_js_buffer_room(room * sizeof *agents);
        if (agents == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_nav_crowd_members(crowd, group, agents, room, &count);
    }
    tl_js_put_pointer(tl_js_put(0, count), agents);
    return result;
}

/// Slot: the agent; then its group.
void TL_JS_FULL_EXPORT(js_crowd_group_of)(const tl_nav_crowd *crowd)
{
    tl_js_put_u64(0, tl_nav_crowd_group_of(crowd, tl_js_u64(0)));
}

// ---------------------------------------------------------------------------------------------------------
// The state as bytes.

/// Slot: how many bytes, and where.
tl_result TL_JS_FULL_EXPORT(js_crowd_save)(const tl_nav_crowd *crowd)
{
    const size_t size = tl_nav_crowd_state_size(crowd);
    void *bytes = tl_js_buffer_room(size);
    if (bytes == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_js_put_pointer(tl_js_put(0, (double)size), bytes);
    return tl_nav_crowd_save(crowd, bytes, size);
}

tl_result TL_JS_FULL_EXPORT(js_crowd_restore)(tl_nav_crowd *crowd, const void *bytes, uint32_t size)
{
    return tl_nav_crowd_restore(crowd, bytes, size, &tl_js_report);
}

/// Slot: the hash.
void TL_JS_FULL_EXPORT(js_crowd_hash)(const tl_nav_crowd *crowd)
{
    tl_js_put_u64(0, tl_nav_crowd_hash(crowd));
}
