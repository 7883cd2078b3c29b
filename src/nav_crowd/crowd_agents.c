// SPDX-License-Identifier: MIT
//
// Agents come and go, and get goals. A freed place is the first to be used again, so that the places in use stay
// together.

#include "base/assert.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

tl_nav_agent_def tl_default_nav_agent_def(void)
{
    tl_nav_agent_def def;
    memset(&def, 0, sizeof def);
    def.reach = 2.0f;
    def.radius = 0.3f;
    def.height = 1.8f;
    def.max_speed = 1.4f;
    def.max_acceleration = 8.0f;
    def.arrive_distance = 0.1f;
    def.priority = 0.5f;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

const char *tl_nav_agent_status_name(tl_nav_agent_status status)
{
    static const char *const names[] = { "idle",   "waiting", "walking",  "arrived", "unreachable",
                                         "queued", "on link", "off mesh", "gave up", "fixed" };
    return (uint32_t)status < TL_COUNT_OF(names) ? names[status] : "unknown";
}

static tl_result check_range(float value, float low, float high, const char *field, tl_report *report)
{
    if (!isfinite(value)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, field, "make it finite");
    }
    return value >= low && value <= high
               ? TL_OK
               : tl_report_field(report, TL_ERR_ARGUMENT, field, "keep it in the range that nav_crowd.h names");
}

static tl_result check_agent_def(const tl_nav_agent_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_agent_def()", report));
    TL_TRY(check_range(def->position.x, -CROWD_MAX_NUMBER, CROWD_MAX_NUMBER, "position", report));
    TL_TRY(check_range(def->position.y, -CROWD_MAX_NUMBER, CROWD_MAX_NUMBER, "position", report));
    TL_TRY(check_range(def->position.z, -CROWD_MAX_NUMBER, CROWD_MAX_NUMBER, "position", report));
    TL_TRY(check_range(def->reach, 0.0f, CROWD_MAX_NUMBER, "reach", report));
    TL_TRY(check_range(def->radius, FLT_MIN, CROWD_MAX_SIZE, "radius", report));
    TL_TRY(check_range(def->height, FLT_MIN, CROWD_MAX_SIZE, "height", report));
    TL_TRY(check_range(def->max_speed, 0.0f, CROWD_MAX_SIZE, "max_speed", report));
    TL_TRY(check_range(def->max_acceleration, FLT_MIN, CROWD_MAX_NUMBER, "max_acceleration", report));
    TL_TRY(check_range(def->arrive_distance, 0.0f, CROWD_MAX_SIZE, "arrive_distance", report));
    TL_TRY(check_range(def->priority, 0.0f, 1.0f, "priority", report));
    if (def->filter >= TL_NAV_CROWD_FILTER_COUNT) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "filter", "make it below TL_NAV_CROWD_FILTER_COUNT");
    }
    return TL_OK;
}

static bool is_number(tl_vec3 v)
{
    return fabsf(v.x) <= CROWD_MAX_NUMBER && fabsf(v.y) <= CROWD_MAX_NUMBER && fabsf(v.z) <= CROWD_MAX_NUMBER;
}

tl_result tl_crowd_find(const tl_nav_crowd *crowd, tl_nav_agent agent, uint32_t *place_out)
{
    uint32_t i = (uint32_t)agent;
    *place_out = i;
    bool is_there =
        i < crowd->head->used && crowd->a.status[i] != CROWD_FREE && crowd->a.generation[i] == (uint32_t)(agent >> 32);
    return is_there ? TL_OK : TL_ERR_STALE;
}

static tl_nav_agent agent_at(const tl_nav_crowd *crowd, uint32_t i)
{
    return (uint64_t)crowd->a.generation[i] << 32 | i;
}

float tl_crowd_clearance(const tl_navmesh *navmesh, tl_nav_ref polygon, float radius)
{
    const tl_nav_tile *tile = NULL;
    if (tl_navmesh_resolve(navmesh, polygon, &tile, NULL) != TL_OK || radius <= tile->agent_radius) {
        return 0.0f;
    }
    return radius - tile->agent_radius;
}

tl_nav_corridor tl_crowd_corridor(const tl_nav_crowd *crowd, uint32_t i)
{
    const uint32_t capacity = crowd->def.max_path;
    tl_nav_corridor corridor = tl_nav_corridor_init(crowd->a.path + (size_t)i * capacity, capacity);
    corridor.count = crowd->a.path_count[i];
    corridor.position = tl_crowd_position(crowd, i);
    corridor.target = tl_crowd_get3(crowd->a.target, i);
    corridor.goal = tl_crowd_get3(crowd->a.goal, i);
    corridor.reaches = (crowd->a.flags[i] & CROWD_REACHES) != 0;
    return corridor;
}

void tl_crowd_keep_corridor(tl_nav_crowd *crowd, uint32_t i, const tl_nav_corridor *corridor)
{
    crowd->a.path_count[i] = corridor->count;
    tl_crowd_set_position(crowd, i, corridor->position);
    tl_crowd_set3(crowd->a.target, i, corridor->target);
    crowd->a.flags[i] = (crowd->a.flags[i] & ~(CROWD_REACHES | CROWD_CORNER)) | (corridor->reaches ? CROWD_REACHES : 0);
}

void tl_crowd_reset_corridor(tl_nav_crowd *crowd, uint32_t i, const tl_nav_location *at)
{
    crowd->a.path[(size_t)i * crowd->def.max_path] = at->polygon;
    crowd->a.path_count[i] = 1;
    crowd->a.flags[i] &= ~(CROWD_REACHES | CROWD_CORNER);
    crowd->a.wall_slack[i] = -1.0f;
    tl_crowd_set_position(crowd, i, at->point);
    tl_crowd_set3(crowd->a.target, i, at->point);
}

static uint32_t take_place(tl_nav_crowd *crowd)
{
    crowd_head *head = crowd->head;
    uint32_t i = head->free;
    if (i != CROWD_NO_PLACE) {
        head->free = crowd->a.next_free[i];
        crowd->a.next_free[i] = 0;
    } else {
        i = head->used++;
    }
    crowd->a.generation[i]++;
    crowd->a.generation[i] += crowd->a.generation[i] == 0;
    head->count++;
    return i;
}

tl_result tl_nav_crowd_add(tl_nav_crowd *crowd, const tl_navmesh *navmesh, const tl_nav_agent_def *def,
                           tl_nav_agent *agent_out, tl_report *report)
{
    tl_report_begin(report, "agent");
    if (agent_out != NULL) {
        *agent_out = TL_NAV_NO_AGENT;
    }
    TL_REFUSE_NULL(crowd, report);
    TL_REFUSE_NULL(navmesh, report);
    TL_REFUSE_NULL(agent_out, report);
    const tl_nav_agent_def defaults = tl_default_nav_agent_def();
    def = def != NULL ? def : &defaults;
    TL_TRY(check_agent_def(def, report));
    if (crowd->head->count == crowd->def.max_agents) {
        return tl_report_field(report, TL_ERR_LIMIT, NULL, "create the crowd with a larger max_agents");
    }
    tl_nav_location at = { TL_NAV_NO_REF, def->position };
    if (!def->is_fixed) {
        const tl_vec3 extents = { def->reach, def->reach, def->reach };
        TL_TRY(tl_navmesh_find_nearest(navmesh, &crowd->filters[def->filter], def->position, extents, &at));
    }
    uint32_t i = take_place(crowd);
    crowd_fields *a = &crowd->a;
    a->status[i] = def->is_fixed ? TL_NAV_AGENT_FIXED : TL_NAV_AGENT_IDLE;
    a->filter[i] = (uint8_t)def->filter;
    a->radius[i] = def->radius;
    a->height[i] = def->height;
    a->max_speed[i] = def->max_speed;
    a->max_acceleration[i] = def->max_acceleration;
    a->arrive_distance[i] = def->arrive_distance;
    a->priority[i] = def->priority;
    tl_crowd_reset_corridor(crowd, i, &at);
    tl_crowd_set3(a->goal, i, at.point);
    if (def->is_fixed) {
        a->path_count[i] = 0;
    } else {
        a->clearance[i] = tl_crowd_clearance(navmesh, at.polygon, def->radius);
    }
    *agent_out = agent_at(crowd, i);
    return TL_OK;
}

// Takes an agent out of the queue; those behind it come one place forward.
static void leave_queue(tl_nav_crowd *crowd, uint32_t agent)
{
    crowd_head *head = crowd->head;
    uint32_t kept = 0;
    for (uint32_t k = 0; k < head->queue_count; k++) {
        uint32_t from = (head->queue_first + k) % head->max_agents;
        if (crowd->a.queue[from] != agent) {
            crowd->a.queue[(head->queue_first + kept) % head->max_agents] = crowd->a.queue[from];
            kept++;
        }
    }
    for (uint32_t k = kept; k < head->queue_count; k++) {
        crowd->a.queue[(head->queue_first + k) % head->max_agents] = 0;
    }
    head->queue_count = kept;
}

void tl_crowd_enqueue(tl_nav_crowd *crowd, uint32_t i)
{
    crowd_head *head = crowd->head;
    crowd->a.flags[i] &= ~CROWD_NEED_PATH;
    if ((crowd->a.flags[i] & CROWD_IN_QUEUE) != 0) {
        return;
    }
    crowd->a.flags[i] |= CROWD_IN_QUEUE;
    crowd->a.queue[(head->queue_first + head->queue_count) % head->max_agents] = i;
    head->queue_count++;
}

tl_result tl_nav_crowd_remove(tl_nav_crowd *crowd, tl_nav_agent agent)
{
    uint32_t i = 0;
    if (crowd == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_crowd_find(crowd, agent, &i));
    if ((crowd->a.flags[i] & CROWD_IN_QUEUE) != 0) {
        leave_queue(crowd, i);
    }
    tl_crowd_leave_group(crowd, i);
    // All but its generation is zeroed: states that are the same have the same bytes.
    uint32_t generation = crowd->a.generation[i];
    uint32_t in_queue = crowd->a.queue[i];
    const uint32_t max_path = crowd->def.max_path;
#define CLEAR(type, name, per) memset(crowd->a.name + (size_t)i * (size_t)(per), 0, (size_t)(per) * sizeof(type));
    CROWD_FIELDS(CLEAR)
#undef CLEAR
    crowd->a.generation[i] = generation;
    crowd->a.queue[i] = in_queue; // an entry of the ring, not of the agent
    crowd->a.status[i] = CROWD_FREE;
    crowd->a.next_free[i] = crowd->head->free;
    crowd->head->free = i;
    crowd->head->count--;
    return TL_OK;
}

static bool is_bound(const crowd_fields *a, uint32_t i)
{
    return a->status[i] == TL_NAV_AGENT_ON_LINK || a->status[i] == TL_NAV_AGENT_OFF_MESH;
}

void tl_crowd_stop(tl_nav_crowd *crowd, uint32_t i)
{
    crowd_fields *a = &crowd->a;
    if ((a->flags[i] & CROWD_IN_QUEUE) != 0) {
        leave_queue(crowd, i);
    }
    a->flags[i] = 0;
    a->goal_polygon[i] = TL_NAV_NO_REF;
    tl_nav_location here = { a->path[(size_t)i * crowd->def.max_path], tl_crowd_position(crowd, i) };
    tl_crowd_set3(a->goal, i, here.point);
    if (!is_bound(a, i)) {
        a->status[i] = TL_NAV_AGENT_IDLE;
        a->link[i] = TL_NAV_NO_REF;
        tl_crowd_reset_corridor(crowd, i, &here);
    }
}

void tl_crowd_send(tl_nav_crowd *crowd, uint32_t i, const tl_nav_location *goal)
{
    crowd_fields *a = &crowd->a;
    tl_crowd_set3(a->goal, i, goal->point);
    a->goal_polygon[i] = goal->polygon;
    a->flags[i] = (a->flags[i] & CROWD_IN_QUEUE) | CROWD_HAS_GOAL;
    a->stalled[i] = 0.0f;
    if (!is_bound(a, i) && a->status[i] != TL_NAV_AGENT_WALKING) {
        a->status[i] = TL_NAV_AGENT_WAITING;
        a->link[i] = TL_NAV_NO_REF;
    }
    tl_crowd_enqueue(crowd, i);
    crowd_group *group = tl_crowd_group_of(crowd, i);
    if (group != NULL) {
        group->flags |= CROWD_GROUP_NEW_GOAL;
    }
}

tl_result tl_nav_crowd_set_goal(tl_nav_crowd *crowd, tl_nav_agent agent, const tl_nav_location *goal)
{
    uint32_t i = 0;
    if (crowd == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_crowd_find(crowd, agent, &i));
    const crowd_fields *a = &crowd->a;
    if (a->status[i] == TL_NAV_AGENT_FIXED || tl_crowd_follows(crowd, i)) {
        return TL_ERR_ARGUMENT;
    }
    if (goal == NULL) {
        tl_crowd_stop(crowd, i);
        return TL_OK;
    }
    if (!tl_is_finite(goal->point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!is_number(goal->point)) {
        return TL_ERR_RANGE;
    }
    if (goal->polygon == TL_NAV_NO_REF || tl_nav_is_offmesh(goal->polygon)) {
        return TL_ERR_ARGUMENT;
    }
    tl_vec3 old = tl_crowd_get3(a->goal, i);
    if ((a->flags[i] & CROWD_HAS_GOAL) == 0 || a->goal_polygon[i] != goal->polygon || old.x != goal->point.x ||
        old.y != goal->point.y || old.z != goal->point.z) {
        tl_crowd_send(crowd, i, goal);
    }
    return TL_OK;
}

tl_result tl_nav_crowd_set_motion(tl_nav_crowd *crowd, tl_nav_agent agent, tl_vec3 position, tl_vec3 velocity)
{
    uint32_t i = 0;
    if (crowd == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_crowd_find(crowd, agent, &i));
    if (crowd->a.status[i] != TL_NAV_AGENT_FIXED) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_is_finite(position) || !tl_is_finite(velocity)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!is_number(position) || !is_number(velocity)) {
        return TL_ERR_RANGE;
    }
    tl_crowd_set_position(crowd, i, position);
    crowd->a.vx[i] = velocity.x;
    crowd->a.vy[i] = velocity.y;
    crowd->a.vz[i] = velocity.z;
    return TL_OK;
}

tl_result tl_nav_crowd_agent(const tl_nav_crowd *crowd, tl_nav_agent agent, tl_nav_agent_state *state_out)
{
    uint32_t i = 0;
    if (state_out != NULL) {
        memset(state_out, 0, sizeof *state_out);
    }
    if (crowd == NULL || state_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_crowd_find(crowd, agent, &i));
    const crowd_fields *a = &crowd->a;
    state_out->status = (tl_nav_agent_status)a->status[i];
    state_out->position = tl_crowd_position(crowd, i);
    state_out->velocity = tl_vec3_make(a->vx[i], a->vy[i], a->vz[i]);
    state_out->wanted = tl_vec3_make(a->wanted_x[i], 0.0f, a->wanted_z[i]);
    state_out->polygon = a->path_count[i] > 0 ? a->path[(size_t)i * crowd->def.max_path] : TL_NAV_NO_REF;
    state_out->link = a->status[i] == TL_NAV_AGENT_ON_LINK ? a->link[i] : TL_NAV_NO_REF;
    bool has_goal = (a->flags[i] & CROWD_HAS_GOAL) != 0;
    state_out->goal = has_goal ? tl_crowd_get3(a->goal, i) : state_out->position;
    state_out->radius = a->radius[i];
    state_out->height = a->height[i];
    return TL_OK;
}

tl_result tl_nav_crowd_corners(const tl_nav_crowd *crowd, const tl_navmesh *navmesh, tl_nav_agent agent,
                               tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out)
{
    uint32_t i = 0;
    if (count_out != NULL) {
        *count_out = 0;
    }
    if (crowd == NULL || navmesh == NULL || count_out == NULL || (corners_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_crowd_find(crowd, agent, &i));
    uint32_t status = crowd->a.status[i];
    if (status == TL_NAV_AGENT_FIXED || status == TL_NAV_AGENT_OFF_MESH || status == TL_NAV_AGENT_ON_LINK) {
        return TL_NOT_FOUND;
    }
    tl_nav_corridor corridor = tl_crowd_corridor(crowd, i);
    return tl_nav_corridor_corners(&corridor, navmesh, corners_out, capacity, count_out);
}

uint32_t tl_nav_crowd_count(const tl_nav_crowd *crowd)
{
    TL_ASSERT(crowd != NULL);
    return crowd->head->count;
}

bool tl_nav_crowd_next(const tl_nav_crowd *crowd, uint32_t *cursor, tl_nav_agent *agent_out)
{
    TL_ASSERT(crowd != NULL && cursor != NULL && agent_out != NULL);
    uint32_t i = *cursor;
    while (i < crowd->head->used && crowd->a.status[i] == CROWD_FREE) {
        i++;
    }
    bool is_there = i < crowd->head->used;
    *cursor = is_there ? i + 1 : i;
    *agent_out = is_there ? agent_at(crowd, i) : TL_NAV_NO_AGENT;
    return is_there;
}
