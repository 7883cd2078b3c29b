// SPDX-License-Identifier: MIT
//
// The state saved, restored and compared. Bytes that come back may be anybody's: each index and each number that a step
// rests on is checked before they are taken. References to polygons need no check, as every query looks them up.

#include "base/arena.h"
#include "base/assert.h"
#include "base/byte_order.h"
#include "base/hash.h"
#include "nav_crowd/crowd.h"

#include <math.h>
#include <string.h>

size_t tl_nav_crowd_state_size(const tl_nav_crowd *crowd)
{
    TL_ASSERT(crowd != NULL);
    return (size_t)crowd->state_bytes;
}

tl_result tl_nav_crowd_save(const tl_nav_crowd *crowd, void *bytes_out, size_t capacity)
{
    if (crowd == NULL || bytes_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (capacity < crowd->state_bytes) {
        return TL_ERR_LIMIT;
    }
    memcpy(bytes_out, crowd->head, (size_t)crowd->state_bytes);
    if (TL_BIG_ENDIAN) {
        tl_crowd_swap_words(bytes_out, crowd->state_bytes, &crowd->def);
    }
    return TL_OK;
}

uint64_t tl_nav_crowd_hash(const tl_nav_crowd *crowd)
{
    TL_ASSERT(crowd != NULL);
    if (!TL_BIG_ENDIAN) {
        return tl_hash_bytes(crowd->head, (size_t)crowd->state_bytes, 0);
    }
    // Turned round in place, and back: the crowd is one thread's at a time.
    tl_crowd_swap_words(crowd->head, crowd->state_bytes, &crowd->def);
    uint64_t hash = tl_hash_bytes(crowd->head, (size_t)crowd->state_bytes, 0);
    tl_crowd_swap_words(crowd->head, crowd->state_bytes, &crowd->def);
    return hash;
}

static bool are_finite(const float *items, uint32_t i, uint32_t per)
{
    bool all = true;
    for (uint32_t k = 0; k < per; k++) {
        all = all && fabsf(items[(size_t)i * per + k]) <= CROWD_MAX_NUMBER;
    }
    return all;
}

static bool is_agent_finite(const crowd_fields *a, uint32_t i)
{
    const float *const ones[] = { a->x,
                                  a->y,
                                  a->z,
                                  a->vx,
                                  a->vy,
                                  a->vz,
                                  a->wanted_x,
                                  a->wanted_z,
                                  a->radius,
                                  a->height,
                                  a->max_speed,
                                  a->priority,
                                  a->clearance,
                                  a->stalled,
                                  a->wall_slack,
                                  a->max_acceleration,
                                  a->arrive_distance };
    bool all = are_finite(a->target, i, 3) && are_finite(a->goal, i, 3) && are_finite(a->wall_center, i, 2) &&
               are_finite(a->corner, i, 2) && are_finite(a->walls, i, 4 * CROWD_MAX_WALLS);
    for (uint32_t k = 0; k < TL_COUNT_OF(ones); k++) {
        all = all && fabsf(ones[k][i]) <= CROWD_MAX_NUMBER; // false for NaN
    }
    return all;
}

static bool is_agent_sound(const crowd_fields *a, uint32_t i, uint32_t max_path)
{
    const uint32_t status = a->status[i];
    const bool is_fixed = status == TL_NAV_AGENT_FIXED;
    return status <= TL_NAV_AGENT_FIXED && a->generation[i] != 0 && a->filter[i] < TL_NAV_CROWD_FILTER_COUNT &&
           (a->flags[i] & ~(CROWD_ALL_FLAGS | CROWD_TRAVEL_MASK)) == 0 && a->path_count[i] <= max_path &&
           (a->path_count[i] > 0) != is_fixed && a->wall_count[i] <= CROWD_MAX_WALLS && a->radius[i] > 0.0f &&
           a->radius[i] <= CROWD_MAX_SIZE && a->height[i] > 0.0f && a->height[i] <= CROWD_MAX_SIZE &&
           a->max_speed[i] >= 0.0f && a->max_speed[i] <= CROWD_MAX_SIZE && a->max_acceleration[i] > 0.0f &&
           a->arrive_distance[i] >= 0.0f && a->priority[i] >= 0.0f && a->priority[i] <= 1.0f &&
           a->clearance[i] >= 0.0f && !(is_fixed && a->flags[i] != 0);
}

// The chain of free places holds each of them once, and the queue each agent once that says so.
static bool are_chains_sound(const tl_nav_crowd *crowd, const crowd_head *head, const crowd_fields *a, uint32_t agents,
                             uint32_t in_queue)
{
    uint32_t free_count = 0;
    uint32_t i = head->free;
    while (i != CROWD_NO_PLACE && free_count <= head->used) {
        if (i >= head->used || a->status[i] != CROWD_FREE) {
            return false;
        }
        i = a->next_free[i];
        free_count++;
    }
    if (agents != head->count || free_count != head->used - agents || in_queue != head->queue_count) {
        return false;
    }
    uint32_t *seen = crowd->grid.cell; // idle between steps
    memset(seen, 0, (size_t)head->used * sizeof *seen);
    for (uint32_t k = 0; k < head->queue_count; k++) {
        uint32_t at = a->queue[(head->queue_first + k) % head->max_agents];
        if (at >= head->used || a->status[at] == CROWD_FREE || (a->flags[at] & CROWD_IN_QUEUE) == 0 || seen[at] != 0) {
            return false;
        }
        seen[at] = 1;
    }
    return true;
}

static bool are_goals_sound(const crowd_head *head)
{
    bool all = true;
    for (uint32_t k = 0; k < CROWD_MAX_SHARED; k++) {
        const crowd_shared_goal *goal = &head->shared[k];
        all = all && are_finite(goal->point, 0, 3) && goal->filter < TL_NAV_CROWD_FILTER_COUNT && goal->side >= 0.0f &&
              goal->side <= CROWD_RELOCATE_RADII * CROWD_MAX_SIZE && goal->height >= 0.0f &&
              goal->height <= CROWD_MAX_SIZE;
    }
    return all;
}

static bool is_member_sound(const crowd_head *head, const crowd_fields *a, uint32_t m)
{
    const uint32_t i = a->member_agent[m];
    return i < head->used && a->status[i] != CROWD_FREE && a->member[i] == m + 1 && a->lag[m] >= 0.0f &&
           (a->member_flags[m] & ~CROWD_FOLLOWING) == 0 && are_finite(a->offset, m, 2) && are_finite(a->trail, m, 3) &&
           are_finite(a->slot, m, 3) && are_finite(a->lag, m, 1) && are_finite(a->held, m, 1);
}

static bool is_group_sound(const crowd_fields *a, const crowd_group *group)
{
    const float *const numbers[] = { &group->spacing, &group->wait_distance, &group->lost_distance };
    bool all = are_finite(group->place, 0, 3) && are_finite(group->velocity, 0, 2) &&
               are_finite(group->heading, 0, 2) && group->speed >= 0.0f && group->speed <= CROWD_MAX_SIZE &&
               group->lag >= 0.0f && group->lag <= CROWD_MAX_NUMBER && group->range >= 0.0f &&
               group->range <= CROWD_MAX_NUMBER && group->formation <= TL_NAV_FORMATION_SLOTS &&
               (group->flags & ~CROWD_GROUP_ALL_FLAGS) == 0 && group->generation != 0 &&
               group->trail_first < group->count && group->trail_count <= group->count;
    for (uint32_t k = 0; k < TL_COUNT_OF(numbers); k++) {
        all = all && *numbers[k] >= FLT_MIN && *numbers[k] <= CROWD_MAX_SIZE;
    }
    for (uint32_t m = group->first + 1; m < group->first + group->count; m++) {
        all = all && a->status[a->member_agent[m]] != TL_NAV_AGENT_FIXED;
    }
    return all;
}

// The groups divide the members among them, and each member is an agent that says so. `at_out`: the first group that is
// wrong.
static bool are_groups_sound(const crowd_head *head, const crowd_fields *a, uint32_t in_groups, uint32_t *at_out)
{
    *at_out = 0;
    if (head->member_count > head->max_members || in_groups != head->member_count) {
        return false;
    }
    for (uint32_t m = 0; m < head->member_count; m++) {
        if (!is_member_sound(head, a, m) || a->member_group[m] >= head->max_groups) {
            return false;
        }
    }
    uint64_t members = 0;
    for (uint32_t g = 0; g < head->max_groups; g++) {
        const crowd_group *group = &a->groups[g];
        *at_out = g;
        if (group->count == 0) {
            continue;
        }
        if (group->count > head->member_count || group->first > head->member_count - group->count ||
            !is_group_sound(a, group)) {
            return false;
        }
        for (uint32_t m = group->first; m < group->first + group->count; m++) {
            if (a->member_group[m] != g) {
                return false;
            }
        }
        members += group->count;
    }
    return members == head->member_count;
}

static tl_result check_state(const tl_nav_crowd *crowd, const crowd_head *head, const crowd_fields *a,
                             tl_report *report)
{
    static const char *const advice = "restore only what tl_nav_crowd_save wrote";
    if (head->used > head->max_agents || head->count > head->used || head->queue_first >= head->max_agents ||
        head->queue_count > head->count || head->filters_changed > 1 || !are_goals_sound(head)) {
        return tl_report_fail(report, TL_ERR_CORRUPT, "head", 0, advice);
    }
    uint32_t agents = 0, in_queue = 0, in_groups = 0, wrong = 0;
    for (uint32_t i = 0; i < head->used; i++) {
        in_groups += a->member[i] != 0;
        if (a->status[i] == CROWD_FREE) {
            continue;
        }
        if (!is_agent_finite(a, i)) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "agent", i, advice);
        }
        if (!is_agent_sound(a, i, head->max_path)) {
            return tl_report_fail(report, TL_ERR_CORRUPT, "agent", i, advice);
        }
        agents++;
        in_queue += (a->flags[i] & CROWD_IN_QUEUE) != 0;
    }
    if (!are_groups_sound(head, a, in_groups, &wrong)) {
        return tl_report_fail(report, TL_ERR_CORRUPT, "group", wrong, advice);
    }
    return are_chains_sound(crowd, head, a, agents, in_queue)
               ? TL_OK
               : tl_report_fail(report, TL_ERR_CORRUPT, "head", 0, advice);
}

// The bytes in this machine's order, or NULL: out of memory.
static const crowd_head *host_order(const tl_nav_crowd *crowd, const void *bytes, void **copy_out)
{
    *copy_out = NULL;
    if (!TL_BIG_ENDIAN) {
        return (const crowd_head *)bytes;
    }
    *copy_out = tl_allocate_array(&crowd->allocator, crowd->state_bytes, 1);
    if (*copy_out != NULL) {
        memcpy(*copy_out, bytes, (size_t)crowd->state_bytes);
        tl_crowd_swap_words(*copy_out, crowd->state_bytes, &crowd->def);
    }
    return (const crowd_head *)*copy_out;
}

static uint32_t read_saved_word(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

// What can be said before the rest is looked at.
static tl_result check_outside(const tl_nav_crowd *crowd, const void *bytes, size_t size, tl_report *report)
{
    const uint8_t *words = (const uint8_t *)bytes;
    if ((uintptr_t)bytes % 8 != 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "bytes", "align them to 8 bytes");
    }
    if (size < sizeof(crowd_head)) {
        return TL_ERR_TRUNCATED;
    }
    if (read_saved_word(words) != CROWD_MAGIC) {
        return TL_ERR_MAGIC;
    }
    if (read_saved_word(words + 4) != CROWD_VERSION) {
        return TL_ERR_VERSION;
    }
    if (read_saved_word(words + offsetof(crowd_head, max_agents)) != crowd->def.max_agents ||
        read_saved_word(words + offsetof(crowd_head, max_path)) != crowd->def.max_path ||
        read_saved_word(words + offsetof(crowd_head, max_groups)) != crowd->def.max_groups ||
        read_saved_word(words + offsetof(crowd_head, max_members)) != crowd->def.max_members) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "bytes", "restore the state of a crowd of the same size");
    }
    return size < crowd->state_bytes ? TL_ERR_TRUNCATED : TL_OK;
}

tl_result tl_nav_crowd_restore(tl_nav_crowd *crowd, const void *bytes, size_t size, tl_report *report)
{
    tl_report_begin(report, "restore");
    TL_REFUSE_NULL(crowd, report);
    TL_REFUSE_NULL(bytes, report);
    TL_TRY(check_outside(crowd, bytes, size, report));
    void *copy = NULL;
    const crowd_head *head = host_order(crowd, bytes, &copy);
    if (head == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = head->size == crowd->state_bytes ? TL_OK : TL_ERR_CORRUPT;
    if (result == TL_OK) {
        // The fields are read alone: their pointers are those of a state that may change.
        const crowd_fields a = tl_crowd_fields_at((void *)(uintptr_t)head, &crowd->def);
        result = check_state(crowd, head, &a, report);
    }
    if (result == TL_OK) {
        memcpy(crowd->head, head, (size_t)crowd->state_bytes);
        tl_crowd_forget_trees(crowd, UINT32_MAX);
    }
    tl_release_array(&crowd->allocator, copy, crowd->state_bytes, 1);
    return result;
}
