// SPDX-License-Identifier: MIT
//
// Nested groups, laid out flat. A scene of scenes would bring a ray into one space after another, rounded at each, and
// keep a stack for each level; a flat scene rounds once, and its tree is built over what is really there. What it costs
// is a record for each instance, where a renderer's nested instances share those too: a level of a game has thousands,
// not billions.
//
// Three passes: what each group comes to is counted once a group, however often it is placed, so groups that double
// sixty times are refused at once; copies are listed as one goes into them; and poses are a loop over that list, for
// parents come first. Moving a copy is that last loop over its part of the list.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "scene/scene_layout.h"

#include <float.h>
#include <string.h>
#include <talus/scene_groups.h>

typedef enum group_state { GROUP_NEW, GROUP_OPEN, GROUP_COUNTED } group_state;

// What a group comes to, with the groups inside.
typedef struct group_total {
    uint64_t instances, copies;
    uint32_t state; // group_state
} group_total;

// A group, or a copy, that one is in, and which of its placements comes next.
typedef struct open_group {
    uint32_t group, copy, next;
} open_group;

static tl_result refuse_group(tl_report *report, tl_result result, uint32_t group, const char *advice)
{
    return tl_report_fail(report, result, "group", group, advice);
}

static tl_result check_placement(const tl_scene_placement *at, uint32_t group, tl_report *report)
{
    if (!tl_pose_is_finite(at->pose)) {
        return refuse_group(report, TL_ERR_NOT_FINITE, group, "check the poses of its placements");
    }
    tl_result result = tl_scale_check(tl_vec3_make(at->scale, at->scale, at->scale), TL_MAX_SCALE);
    return result == TL_OK ? TL_OK : refuse_group(report, result, group, "check the scales of its placements");
}

static tl_result check_group(const tl_scene_group *groups, uint32_t group_count, uint32_t group, tl_report *report)
{
    const tl_scene_group *g = &groups[group];
    if ((g->instances == NULL && g->instance_count > 0) || (g->placements == NULL && g->placement_count > 0)) {
        return refuse_group(report, TL_ERR_ARGUMENT, group, "give its instances and placements");
    }
    for (uint32_t i = 0; i < g->placement_count; i++) {
        if (g->placements[i].group >= group_count) {
            return refuse_group(report, TL_ERR_INDEX, group, "a group that it places is not there");
        }
        TL_TRY(check_placement(&g->placements[i], group, report));
    }
    return TL_OK;
}

static tl_result check_groups(const tl_scene_group *groups, uint32_t group_count, tl_report *report)
{
    if (groups == NULL && group_count > 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "groups", "give the groups");
    }
    return TL_OK;
}

static tl_result check_total(const group_total *total, uint32_t group, tl_report *report)
{
    return total->instances > TL_MAX_SCENE_INSTANCES || total->copies > TL_MAX_SCENE_INSTANCES
               ? refuse_group(report, TL_ERR_LIMIT, group, "make several scenes")
               : TL_OK;
}

// Begins the total of a group with what it holds itself.
static tl_result open_total(const tl_scene_group *groups, uint32_t group_count, uint32_t group, group_total *total,
                            tl_report *report)
{
    TL_TRY(check_group(groups, group_count, group, report));
    group_total own = { groups[group].instance_count, 1, GROUP_OPEN };
    *total = own;
    return check_total(total, group, report);
}

// Fills `totals` of the root and all groups inside. A path holds each group once, so `path` has a place for each.
static tl_result count_groups(const tl_scene_group *groups, uint32_t group_count, uint32_t root, group_total *totals,
                              open_group *path, tl_report *report)
{
    uint32_t depth = 1;
    open_group first = { root, 0, 0 };
    path[0] = first;
    TL_TRY(open_total(groups, group_count, root, &totals[root], report));
    while (depth > 0) {
        open_group *top = &path[depth - 1];
        if (top->next == groups[top->group].placement_count) {
            totals[top->group].state = GROUP_COUNTED;
            depth--;
            continue;
        }
        uint32_t inner = groups[top->group].placements[top->next].group;
        if (totals[inner].state == GROUP_OPEN) {
            return refuse_group(report, TL_ERR_ARGUMENT, inner, "take it out of itself");
        }
        if (totals[inner].state == GROUP_NEW) {
            open_group below = { inner, 0, 0 };
            path[depth++] = below;
            TL_TRY(open_total(groups, group_count, inner, &totals[inner], report));
            continue; // and comes back to this placement
        }
        totals[top->group].instances += totals[inner].instances;
        totals[top->group].copies += totals[inner].copies;
        TL_TRY(check_total(&totals[top->group], top->group, report));
        top->next++;
    }
    return TL_OK;
}

// Lists the copies; what they hold is known.
static void list_copies(const tl_scene_group *groups, const group_total *totals, uint32_t root, open_group *path,
                        tl_scene_copy *copies)
{
    uint32_t depth = 0, count = 0, instances = 0, group = root, parent = TL_NO_COPY, placement = 0;
    do {
        tl_scene_copy *copy = &copies[count];
        memset(copy, 0, sizeof *copy);
        copy->group = group;
        copy->parent = parent;
        copy->placement = placement;
        copy->first_instance = instances;
        copy->instance_count = (uint32_t)totals[group].instances;
        copy->copy_count = (uint32_t)totals[group].copies;
        instances += groups[group].instance_count;
        open_group below = { group, count++, 0 };
        path[depth++] = below;
        while (depth > 0 && path[depth - 1].next == groups[path[depth - 1].group].placement_count) {
            depth--;
        }
        if (depth > 0) {
            open_group *top = &path[depth - 1];
            parent = top->copy;
            placement = top->next++;
            group = groups[top->group].placements[placement].group;
        }
    } while (depth > 0);
}

// Factors of scales, of which none is 0: a product that is too small is one that no scene takes, not 0, which is 1.
static float scale_times(float a, float b)
{
    float product = a * b;
    return product == 0.0f ? FLT_MIN : product;
}

// First `inner`, then `outer`.
static tl_quat quat_product(tl_quat outer, tl_quat inner)
{
    const tl_quatd q = tl_quatd_between(tl_quatd_from(tl_quat_conjugate(outer)), tl_quatd_from(inner));
    const double unit = 1.0 / sqrt(q.length_sq);
    const tl_quat r = { (float)(q.x * unit), (float)(q.y * unit), (float)(q.z * unit), (float)(q.w * unit) };
    return r;
}

static tl_transform pose_in_world(const tl_scene_copy *copy, tl_transform pose)
{
    const tl_quat turn = copy->pose.rotation;
    if (tl_scene_rigid_way(&copy->pose) != TL_SCENE_IDENTITY || copy->scale != 1.0f) {
        tl_frame frame = tl_frame_from(copy->pose);
        tl_vec3d scaled = tl_vec3d_scale(tl_vec3d_from(pose.position), (double)copy->scale);
        pose.position = tl_vec3d_to_float(tl_frame_point(&frame, scaled));
    }
    if (tl_scene_is_rotated(turn)) {
        pose.rotation = tl_scene_is_rotated(pose.rotation) ? quat_product(turn, pose.rotation) : turn;
    }
    return pose;
}

static tl_vec3 scale_in_world(const tl_scene_copy *copy, tl_vec3 scale)
{
    if (copy->scale == 1.0f) {
        return scale;
    }
    tl_vec3 s = tl_scale_factors(scale);
    if (s.x == 0.0f || s.y == 0.0f || s.z == 0.0f) {
        return s; // a scene refuses it
    }
    return tl_vec3_make(scale_times(s.x, copy->scale), scale_times(s.y, copy->scale), scale_times(s.z, copy->scale));
}

static void place_instances(const tl_scene_group *group, const tl_scene_copy *copy, tl_scene_instance *out)
{
    for (uint32_t i = 0; i < group->instance_count; i++) {
        out[i] = group->instances[i];
        out[i].pose = pose_in_world(copy, out[i].pose);
        out[i].scale = scale_in_world(copy, out[i].scale);
    }
}

static float factor_or_one(float scale)
{
    return scale != 0.0f ? scale : 1.0f;
}

// Places a copy, and all that is inside it.
static void place_copies(const tl_scene_group *groups, tl_scene_expansion *e, uint32_t first,
                         const tl_scene_placement *at)
{
    e->copies[first].pose = at->pose;
    e->copies[first].scale = factor_or_one(at->scale);
    for (uint32_t i = first; i < first + e->copies[first].copy_count; i++) {
        tl_scene_copy *copy = &e->copies[i];
        if (i > first) {
            const tl_scene_copy *parent = &e->copies[copy->parent];
            const tl_scene_placement *inner = &groups[parent->group].placements[copy->placement];
            copy->pose = pose_in_world(parent, inner->pose);
            copy->scale = scale_times(parent->scale, factor_or_one(inner->scale));
        }
        place_instances(&groups[copy->group], copy, e->instances + copy->first_instance);
    }
}

static tl_result expand_counted(const tl_scene_group *groups, uint32_t root, const group_total *totals,
                                open_group *path, tl_scene_expansion *e)
{
    uint32_t instances = (uint32_t)totals[root].instances, copies = (uint32_t)totals[root].copies;
    e->instances = tl_allocate_array(&e->allocator, instances, sizeof *e->instances);
    e->instance_count = e->instances != NULL ? instances : 0;
    e->copies = tl_allocate_array(&e->allocator, copies, sizeof *e->copies);
    e->copy_count = e->copies != NULL ? copies : 0;
    if (e->instances == NULL || e->copies == NULL) {
        return TL_ERR_MEMORY;
    }
    list_copies(groups, totals, root, path, e->copies);
    tl_scene_placement origin = { root, tl_transform_identity(), 1.0f };
    place_copies(groups, e, 0, &origin);
    return TL_OK;
}

tl_result tl_scene_groups_expand(const tl_scene_group *groups, uint32_t group_count, uint32_t root, const tl_host *host,
                                 tl_scene_expansion *expansion_out, tl_report *report_out)
{
    tl_report_begin(report_out, "expand groups");
    TL_REFUSE_NULL(expansion_out, report_out);
    memset(expansion_out, 0, sizeof *expansion_out);
    TL_TRY(check_groups(groups, group_count, report_out));
    if (root >= group_count) {
        return refuse_group(report_out, TL_ERR_INDEX, root, "the root is one of the groups");
    }
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    group_total *totals = TL_PUSH_ZERO(&arena, group_total, group_count);
    open_group *path = TL_PUSH(&arena, open_group, group_count);
    tl_result result = TL_ERR_MEMORY;
    if (totals != NULL && path != NULL) {
        result = count_groups(groups, group_count, root, totals, path, report_out);
    }
    if (result == TL_OK) {
        expansion_out->allocator = tl_allocator_or_default(allocator);
        result = expand_counted(groups, root, totals, path, expansion_out);
    }
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes +
                                 (uint64_t)expansion_out->instance_count * sizeof *expansion_out->instances +
                                 (uint64_t)expansion_out->copy_count * sizeof *expansion_out->copies;
    }
    if (result != TL_OK) {
        tl_scene_expansion_free(expansion_out);
    }
    tl_arena_free(&arena);
    return result;
}

static uint32_t own_instance_count(const tl_scene_expansion *e, uint32_t copy)
{
    const tl_scene_copy *c = &e->copies[copy];
    uint32_t end = c->copy_count > 1 ? e->copies[copy + 1].first_instance : c->first_instance + c->instance_count;
    return end - c->first_instance;
}

// Whether a group still holds what it held: the right number of instances, and of placements the one that `copy` is.
static bool is_as_expanded(const tl_scene_group *groups, const tl_scene_expansion *e, uint32_t copy, bool is_inside)
{
    const tl_scene_copy *c = &e->copies[copy];
    if (groups[c->group].instance_count != own_instance_count(e, copy)) {
        return false;
    }
    if (!is_inside) {
        return true;
    }
    const tl_scene_group *parent = &groups[e->copies[c->parent].group];
    return c->placement < parent->placement_count && parent->placements[c->placement].group == c->group;
}

static uint32_t inner_copy_count(const tl_scene_expansion *e, uint32_t copy)
{
    uint32_t count = 0;
    for (uint32_t i = copy + 1; i < copy + e->copies[copy].copy_count; i += e->copies[i].copy_count) {
        count++;
    }
    return count;
}

tl_result tl_scene_groups_place(const tl_scene_group *groups, uint32_t group_count, tl_scene_expansion *expansion,
                                uint32_t copy, const tl_scene_placement *at, tl_report *report_out)
{
    tl_report_begin(report_out, "place a copy");
    TL_REFUSE_NULL(expansion, report_out);
    TL_REFUSE_NULL(at, report_out);
    TL_TRY(check_groups(groups, group_count, report_out));
    if (copy >= expansion->copy_count) {
        return tl_report_fail(report_out, TL_ERR_INDEX, "copy", copy, "there are fewer copies");
    }
    uint32_t end = copy + expansion->copies[copy].copy_count;
    for (uint32_t i = copy; i < end; i++) {
        uint32_t group = expansion->copies[i].group;
        if (group >= group_count) {
            return refuse_group(report_out, TL_ERR_INDEX, group, "give the groups that were expanded");
        }
        TL_TRY(check_group(groups, group_count, group, report_out));
        if (!is_as_expanded(groups, expansion, i, i > copy) ||
            inner_copy_count(expansion, i) != groups[group].placement_count) {
            return refuse_group(report_out, TL_ERR_ARGUMENT, group, "it holds other things now: expand again");
        }
    }
    TL_TRY(check_placement(at, expansion->copies[copy].group, report_out));
    place_copies(groups, expansion, copy, at);
    return TL_OK;
}

uint32_t tl_scene_copy_of(const tl_scene_expansion *expansion, uint32_t instance)
{
    if (expansion == NULL || instance >= expansion->instance_count) {
        return TL_NO_COPY;
    }
    // The last copy whose instances begin at or before this one; of those that begin there, all but the last hold none
    // of their own.
    uint32_t low = 0, high = expansion->copy_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (expansion->copies[middle].first_instance <= instance) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

void tl_scene_expansion_free(tl_scene_expansion *expansion)
{
    if (expansion != NULL) {
        tl_release_array(&expansion->allocator, expansion->instances, expansion->instance_count,
                         sizeof *expansion->instances);
        tl_release_array(&expansion->allocator, expansion->copies, expansion->copy_count, sizeof *expansion->copies);
        memset(expansion, 0, sizeof *expansion);
    }
}
