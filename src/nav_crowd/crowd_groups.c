// SPDX-License-Identifier: MIT
//
// Groups come, change their formation, and go.
//
// The members of all groups are one table in which those of a group stand together, by their slots; so a group costs
// what its members do. What is removed closes up.

#include "base/assert.h"
#include "base/min_max.h"
#include "math/cos_degrees.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

tl_nav_group_def tl_default_nav_group_def(void)
{
    tl_nav_group_def def;
    memset(&def, 0, sizeof def);
    def.formation = TL_NAV_FORMATION_LOOSE;
    def.spacing = 1.2f;
    def.wait_distance = 4.0f;
    def.lost_distance = 30.0f;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

const char *tl_nav_formation_name(tl_nav_formation formation)
{
    static const char *const names[] = { "loose", "line", "column", "wedge", "ring", "slots" };
    return (uint32_t)formation < TL_COUNT_OF(names) ? names[formation] : "unknown";
}

static tl_result check_group_length(float value, const char *field, tl_report *report)
{
    if (!isfinite(value)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, field, "make it finite");
    }
    return value >= FLT_MIN && value <= CROWD_MAX_SIZE
               ? TL_OK
               : tl_report_field(report, TL_ERR_ARGUMENT, field, "make it > 0, and at most 1000 m");
}

static tl_result check_group_def(const tl_nav_group_def *def, uint32_t count, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_group_def()", report));
    if ((uint32_t)def->formation > TL_NAV_FORMATION_SLOTS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "formation", "make it one of TL_NAV_FORMATION_...");
    }
    TL_TRY(check_group_length(def->spacing, "spacing", report));
    TL_TRY(check_group_length(def->wait_distance, "wait_distance", report));
    TL_TRY(check_group_length(def->lost_distance, "lost_distance", report));
    if (def->formation != TL_NAV_FORMATION_SLOTS) {
        return TL_OK;
    }
    if (def->slots == NULL && count > 1) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "slots", "give one for each agent but the leader");
    }
    for (uint32_t k = 0; k + 1 < count; k++) {
        if (!isfinite(def->slots[k].forward) || !isfinite(def->slots[k].left)) {
            return tl_report_field(report, TL_ERR_NOT_FINITE, "slots", "make them finite");
        }
        if (fabsf(def->slots[k].forward) > CROWD_MAX_SIZE || fabsf(def->slots[k].left) > CROWD_MAX_SIZE) {
            return tl_report_field(report, TL_ERR_ARGUMENT, "slots", "keep them within 1000 m of the leader");
        }
    }
    return TL_OK;
}

// The cosine of an angle from 0 to 360 degrees.
static float cosine_of(float degrees)
{
    const float half = degrees <= 180.0f ? degrees : 360.0f - degrees;
    return half <= 90.0f ? tl_cos_degrees(half) : -tl_cos_degrees(180.0f - half);
}

static tl_nav_formation_slot slot_of(const tl_nav_group_def *def, uint32_t rank, uint32_t count)
{
    const float spacing = def->spacing;
    const float row = (float)((rank + 1) / 2);
    const float side = rank % 2 == 1 ? row : -row;
    tl_nav_formation_slot slot = { 0.0f, 0.0f };
    switch (def->formation) {
    case TL_NAV_FORMATION_LINE:
        slot.left = side * spacing;
        break;
    case TL_NAV_FORMATION_COLUMN:
        slot.forward = -(float)rank * spacing;
        break;
    case TL_NAV_FORMATION_WEDGE:
        slot.forward = -row * spacing * 0.70710678f; // neighbours of a row at 45 degrees
        slot.left = side * spacing * 0.70710678f;
        break;
    case TL_NAV_FORMATION_RING: {
        const float radius = tl_max_f32(spacing, spacing * (float)(count - 1) * 0.15915494f); // 1 / (2 pi)
        const float angle = 360.0f * (float)(rank - 1) / (float)(count - 1);
        slot.forward = radius * cosine_of(angle);
        slot.left = radius * cosine_of(angle >= 90.0f ? angle - 90.0f : angle + 270.0f);
        break;
    }
    case TL_NAV_FORMATION_SLOTS:
        return def->slots[rank - 1];
    default:
        break;
    }
    return slot;
}

static void set_slots(const tl_nav_crowd *crowd, crowd_group *group, const tl_nav_group_def *def)
{
    const crowd_fields *a = &crowd->a;
    group->formation = (uint32_t)def->formation;
    group->spacing = def->spacing;
    group->wait_distance = def->wait_distance;
    group->lost_distance = def->lost_distance;
    group->flags = (group->flags & ~CROWD_GROUP_IN_ORDER) | (def->keep_order ? CROWD_GROUP_IN_ORDER : 0);
    group->range = group->spacing * sqrtf((float)group->count);
    for (uint32_t rank = 1; rank < group->count; rank++) {
        const tl_nav_formation_slot slot = slot_of(def, rank, group->count);
        const size_t m = (size_t)group->first + rank;
        a->offset[2 * m] = slot.forward;
        a->offset[2 * m + 1] = slot.left;
        a->member_flags[m] = CROWD_EARLY;
        a->held[m] = 0.0f;
        group->range = tl_max_f32(group->range, sqrtf(slot.forward * slot.forward + slot.left * slot.left));
    }
}

void tl_crowd_deal_slots(const tl_nav_crowd *crowd, crowd_group *group)
{
    const crowd_fields *a = &crowd->a;
    const uint32_t first = group->first + 1, count = group->count - 1;
    if (count < 2 || (group->flags & CROWD_GROUP_IN_ORDER) != 0 || group->formation == TL_NAV_FORMATION_LOOSE) {
        return;
    }
    const tl_slot_deal *all = &crowd->deal;
    const tl_slot_deal deal = { all->from + 2 * (size_t)first,
                                all->to + 2 * (size_t)first,
                                all->taker + first,
                                all->followers + first,
                                all->slots + first,
                                all->scratch + first,
                                count };
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = a->member_agent[first + k];
        deal.from[2 * k] = a->x[i] - group->place[0];
        deal.from[2 * k + 1] = a->z[i] - group->place[2];
        tl_crowd_plan_slot(crowd, group, first + k, &deal.to[2 * k]);
    }
    tl_slot_deal_out(&deal);
    uint32_t *agents = (uint32_t *)(void *)deal.scratch; // of no use now
    memcpy(agents, a->member_agent + first, count * sizeof *agents);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = agents[deal.taker[k]];
        a->member_agent[first + k] = i;
        a->member[i] = first + k + 1;
        a->member_flags[first + k] = CROWD_EARLY;
        a->held[first + k] = 0.0f;
        a->lag[first + k] = 0.0f;
    }
}

// ---------------------------------------------------------------------------------------------------------
// The tables.

static tl_nav_group group_at(const tl_nav_crowd *crowd, uint32_t g)
{
    return (uint64_t)crowd->a.groups[g].generation << 32 | g;
}

static tl_result find_group(const tl_nav_crowd *crowd, tl_nav_group name, crowd_group **group_out)
{
    const uint32_t g = (uint32_t)name;
    *group_out = NULL;
    if (g >= crowd->def.max_groups || crowd->a.groups[g].count == 0 ||
        crowd->a.groups[g].generation != (uint32_t)(name >> 32)) {
        return TL_ERR_STALE;
    }
    *group_out = &crowd->a.groups[g];
    return TL_OK;
}

// Takes members out of the table, who are in no group any more; those behind close up.
static void close_up_members(tl_nav_crowd *crowd, uint32_t first, uint32_t count)
{
    const crowd_fields *a = &crowd->a;
    crowd_head *head = crowd->head;
    const uint32_t behind = head->member_count - first - count;
    for (uint32_t m = first; m < first + count; m++) {
        a->member[a->member_agent[m]] = 0;
    }
#define CLOSE_UP(type, name, per)                                                                                      \
    memmove(a->name + (size_t)first * (per), a->name + (size_t)(first + count) * (per),                                \
            (size_t)behind * (per) * sizeof(type));                                                                    \
    memset(a->name + (size_t)(first + behind) * (per), 0, (size_t)count * (per) * sizeof(type));
    CROWD_MEMBER_FIELDS(CLOSE_UP)
#undef CLOSE_UP
    head->member_count -= count;
    for (uint32_t m = first; m < head->member_count; m++) {
        a->member[a->member_agent[m]] = m + 1;
    }
    for (uint32_t g = 0; g < head->max_groups; g++) {
        a->groups[g].first -= a->groups[g].first > first ? count : 0;
    }
}

static void clear_group(crowd_group *group)
{
    const uint32_t generation = group->generation;
    memset(group, 0, sizeof *group);
    group->generation = generation;
}

static void forget_trail(const tl_nav_crowd *crowd, crowd_group *group)
{
    group->trail_first = 0;
    group->trail_count = 0;
    memset(crowd->a.trail + 3 * (size_t)group->first, 0, 3 * (size_t)group->count * sizeof(float));
    memset(crowd->a.trail_polygon + group->first, 0, group->count * sizeof(uint64_t));
}

// One that followed has its slot as goal, and stops.
static void stop_follower(tl_nav_crowd *crowd, uint32_t i)
{
    crowd->a.member[i] = 0;
    tl_crowd_stop(crowd, i);
}

void tl_crowd_leave_group(tl_nav_crowd *crowd, uint32_t i)
{
    crowd_group *group = tl_crowd_group_of(crowd, i);
    const crowd_fields *a = &crowd->a;
    if (group == NULL) {
        return;
    }
    const uint32_t m = a->member[i] - 1;
    const bool leads = m == group->first;
    forget_trail(crowd, group);
    // Slots stay where they are: who stands behind moves up by one.
    for (uint32_t k = group->first + group->count - 1; k > m && k > group->first + 1; k--) {
        a->offset[2 * (size_t)k] = a->offset[2 * (size_t)k - 2];
        a->offset[2 * (size_t)k + 1] = a->offset[2 * (size_t)k - 1];
    }
    const uint32_t first = group->first;
    close_up_members(crowd, m, 1);
    group->count--;
    if (group->count == 0) {
        clear_group(group);
    } else if (leads) {
        const uint32_t next = a->member_agent[first];
        const bool has_goal = (a->flags[i] & CROWD_HAS_GOAL) != 0;
        const tl_nav_location goal = { a->goal_polygon[i], tl_crowd_get3(a->goal, i) };
        a->offset[2 * (size_t)first] = a->offset[2 * (size_t)first + 1] = a->lag[first] = 0.0f;
        a->member_flags[first] = 0;
        a->held[first] = 0.0f;
        group->polygon = TL_NAV_NO_REF;
        tl_crowd_stop(crowd, next);
        if (has_goal) {
            tl_crowd_send(crowd, next, &goal);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------
// The calls.

static tl_result check_members(const tl_nav_crowd *crowd, const tl_nav_agent *agents, uint32_t count, tl_report *report)
{
    for (uint32_t k = 0; k < count; k++) {
        uint32_t i = 0;
        if (tl_crowd_find(crowd, agents[k], &i) != TL_OK) {
            return tl_report_fail(report, TL_ERR_STALE, "agents", k, "give agents that are in the crowd");
        }
        if (crowd->a.member[i] != 0) {
            return tl_report_field(report, TL_ERR_ARGUMENT, "agents", "let each be in one group, once");
        }
        if (k > 0 && crowd->a.status[i] == TL_NAV_AGENT_FIXED) {
            return tl_report_field(report, TL_ERR_ARGUMENT, "agents", "let only the first one be fixed");
        }
        crowd->a.member[i] = UINT32_MAX; // so that one who is named twice is found
    }
    return TL_OK;
}

// From the middle of all to the leader, or along z.
static void face_forward(const tl_nav_crowd *crowd, crowd_group *group)
{
    const crowd_fields *a = &crowd->a;
    const uint32_t leader = a->member_agent[group->first];
    double x = 0.0, z = 0.0;
    for (uint32_t k = 0; k < group->count; k++) {
        const uint32_t i = a->member_agent[group->first + k];
        x += (double)a->x[leader] - (double)a->x[i];
        z += (double)a->z[leader] - (double)a->z[i];
    }
    const double length = sqrt(x * x + z * z);
    group->heading[0] = length > 0.0 ? (float)(x / length) : 0.0f;
    group->heading[1] = length > 0.0 ? (float)(z / length) : 1.0f;
    tl_crowd_set3(group->place, 0, tl_crowd_position(crowd, leader));
}

static uint32_t find_free_group(const tl_nav_crowd *crowd)
{
    uint32_t g = 0;
    while (g < crowd->def.max_groups && crowd->a.groups[g].count > 0) {
        g++;
    }
    return g;
}

static void fill_group(tl_nav_crowd *crowd, uint32_t g, const tl_nav_agent *agents, uint32_t count)
{
    crowd_group *group = &crowd->a.groups[g];
    clear_group(group);
    group->generation++;
    group->generation += group->generation == 0;
    group->first = crowd->head->member_count;
    group->count = count;
    group->flags = CROWD_GROUP_NEW_GOAL;
    crowd->head->member_count += count;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = (uint32_t)agents[k], m = group->first + k;
        if (k > 0) {
            stop_follower(crowd, i);
        }
        crowd->a.member[i] = m + 1;
        crowd->a.member_agent[m] = i;
        crowd->a.member_group[m] = g;
    }
}

tl_result tl_nav_crowd_add_group(tl_nav_crowd *crowd, const tl_nav_group_def *def, const tl_nav_agent *agents,
                                 uint32_t count, tl_nav_group *group_out, tl_report *report)
{
    tl_report_begin(report, "group");
    if (group_out != NULL) {
        *group_out = TL_NAV_NO_GROUP;
    }
    TL_REFUSE_NULL(crowd, report);
    TL_REFUSE_NULL(agents, report);
    TL_REFUSE_NULL(group_out, report);
    const tl_nav_group_def defaults = tl_default_nav_group_def();
    def = def != NULL ? def : &defaults;
    if (count < 1) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "count", "give at least the leader");
    }
    TL_TRY(check_group_def(def, count, report));
    const uint32_t g = find_free_group(crowd);
    if (g == crowd->def.max_groups) {
        return tl_report_field(report, TL_ERR_LIMIT, "max_groups", "create the crowd with a larger one");
    }
    if (count > crowd->def.max_members - crowd->head->member_count) {
        return tl_report_field(report, TL_ERR_LIMIT, "max_members", "create the crowd with a larger one");
    }
    const tl_result result = check_members(crowd, agents, count, report);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t i = 0;
        if (tl_crowd_find(crowd, agents[k], &i) == TL_OK && crowd->a.member[i] == UINT32_MAX) {
            crowd->a.member[i] = 0;
        }
    }
    TL_TRY(result);
    fill_group(crowd, g, agents, count);
    face_forward(crowd, &crowd->a.groups[g]);
    set_slots(crowd, &crowd->a.groups[g], def);
    tl_crowd_deal_slots(crowd, &crowd->a.groups[g]);
    *group_out = group_at(crowd, g);
    return TL_OK;
}

tl_result tl_nav_crowd_remove_group(tl_nav_crowd *crowd, tl_nav_group group)
{
    crowd_group *found = NULL;
    if (crowd == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(find_group(crowd, group, &found));
    for (uint32_t k = 1; k < found->count; k++) {
        stop_follower(crowd, crowd->a.member_agent[found->first + k]);
    }
    close_up_members(crowd, found->first, found->count);
    clear_group(found);
    return TL_OK;
}

tl_result tl_nav_crowd_set_formation(tl_nav_crowd *crowd, tl_nav_group group, const tl_nav_group_def *def,
                                     tl_report *report)
{
    tl_report_begin(report, "group");
    TL_REFUSE_NULL(crowd, report);
    crowd_group *found = NULL;
    TL_TRY(find_group(crowd, group, &found));
    const tl_nav_group_def defaults = tl_default_nav_group_def();
    def = def != NULL ? def : &defaults;
    TL_TRY(check_group_def(def, found->count, report));
    if (found->spacing != def->spacing) {
        forget_trail(crowd, found);
    }
    set_slots(crowd, found, def);
    tl_crowd_deal_slots(crowd, found);
    return TL_OK;
}

tl_result tl_nav_crowd_group(const tl_nav_crowd *crowd, tl_nav_group group, tl_nav_group_state *state_out)
{
    crowd_group *found = NULL;
    if (state_out != NULL) {
        memset(state_out, 0, sizeof *state_out);
    }
    if (crowd == NULL || state_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(find_group(crowd, group, &found));
    const crowd_fields *a = &crowd->a;
    const uint32_t leader = a->member_agent[found->first];
    state_out->formation = (tl_nav_formation)found->formation;
    state_out->count = found->count;
    state_out->in_place = 1;
    for (uint32_t m = found->first + 1; m < found->first + found->count; m++) {
        state_out->in_place += a->lag[m] <= 0.5f * found->spacing;
        state_out->on_trail += (a->member_flags[m] & CROWD_ON_TRAIL) != 0;
    }
    state_out->lag = found->lag;
    state_out->speed = found->speed;
    state_out->heading = tl_vec3_make(found->heading[0], 0.0f, found->heading[1]);
    state_out->leader = (uint64_t)a->generation[leader] << 32 | leader;
    return TL_OK;
}

tl_result tl_nav_crowd_members(const tl_nav_crowd *crowd, tl_nav_group group, tl_nav_agent *agents_out,
                               uint32_t capacity, uint32_t *count_out)
{
    crowd_group *found = NULL;
    if (count_out != NULL) {
        *count_out = 0;
    }
    if (crowd == NULL || count_out == NULL || (agents_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(find_group(crowd, group, &found));
    *count_out = found->count;
    for (uint32_t k = 0; k < found->count && k < capacity; k++) {
        const uint32_t i = crowd->a.member_agent[found->first + k];
        agents_out[k] = (uint64_t)crowd->a.generation[i] << 32 | i;
    }
    return capacity < found->count ? TL_INCOMPLETE : TL_OK;
}

tl_nav_group tl_nav_crowd_group_of(const tl_nav_crowd *crowd, tl_nav_agent agent)
{
    uint32_t i = 0;
    TL_ASSERT(crowd != NULL);
    if (tl_crowd_find(crowd, agent, &i) != TL_OK || crowd->a.member[i] == 0) {
        return TL_NAV_NO_GROUP;
    }
    return group_at(crowd, crowd->a.member_group[crowd->a.member[i] - 1]);
}
