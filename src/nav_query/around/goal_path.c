// SPDX-License-Identifier: MIT
//
// Paths by a goal tree: from polygon to polygon, each time over the edge from where the goal is nearest.
//
// The rest of the path falls with each step by what was walked. Where it does not, because a funnel had forgotten a
// corner that counts, the path by choice could go round in a circle: the tree's own path is taken instead, which
// cannot.

#include "nav_query/around/goal_tree.h"

#include "base/assert.h"
#include "math/tolerance.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/plane/surface.h"

#include <math.h>
#include <string.h>

enum { MAX_CHOSEN = 4 }; // polygons after the start's

// What a step may make the rest of a path longer by, as a share: the sums of 32 legs, each of two differences, two
// squares and a root, and those of the step itself.
#define REST_ROUNDING TL_FLOAT_GAMMA(32 * 5 + 8)

// A path under way: it stands at a point of a polygon.
typedef struct goal_walk {
    const tl_nav_goal_tree *tree;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    float unit;
    bool is_uniform, all_pass;
    uint32_t before; // the entry from where it came, or UINT32_MAX
    uint32_t entry, slot, polygon;
    tl_vec3 at;
} goal_walk;

// How a path goes on.
typedef struct goal_way {
    float rest;      // what the rest of it costs
    uint32_t entry;  // UINT32_MAX: there is none
    tl_nav_ref link; // by an off-mesh link
    uint32_t slot, polygon;
    tl_vec3 at;     // where that polygon is entered
    tl_vec3 leaves; // where this one is left
} goal_way;

// `near`: an entry. Those of one tile follow one another, mostly without a gap.
static uint32_t find_entry(const tl_nav_goal_tree *tree, tl_nav_ref polygon, uint32_t near)
{
    const uint64_t guess = (uint64_t)near + (polygon - tree->entries[near].polygon);
    if (guess < tree->count && tree->entries[guess].polygon == polygon) {
        return (uint32_t)guess;
    }
    uint32_t low = 0, high = tree->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (tree->entries[middle].polygon < polygon) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < tree->count && tree->entries[low].polygon == polygon ? low : UINT32_MAX;
}

static float cost_within(const goal_walk *walk, uint32_t slot, uint32_t polygon, tl_vec3 from, tl_vec3 to)
{
    return tl_nav_cost_between(walk->filter, walk->navmesh->slots[slot].tile, polygon, from, to);
}

// What the rest costs over an edge, and where it is crossed.
static goal_way over_edge(const goal_walk *walk, uint32_t entry, tl_nav_ring_seam to, const tl_nav_goal_portal *portal)
{
    const float at[2] = { walk->at.x, walk->at.z };
    const tl_nav_goal_funnel before = tl_nav_goal_funnel_of(&walk->tree->entries[entry]);
    goal_way way = { 0.0f, entry, TL_NAV_NO_REF, to.slot, to.polygon, walk->at, walk->at };
    if (walk->is_uniform) {
        const tl_nav_goal_funnel funnel = tl_nav_goal_funnel_pass(&before, portal, walk->unit);
        way.rest = tl_nav_goal_funnel_cost(&funnel, at, walk->unit);
        way.at = tl_nav_goal_funnel_cross(&funnel, portal, at);
    } else {
        tl_nav_goal_funnel open;
        tl_nav_goal_funnel_open(&open, before.corner, 0.0f);
        way.at = tl_nav_goal_funnel_cross(&open, portal, at);
        way.rest = cost_within(walk, walk->slot, walk->polygon, walk->at, way.at) +
                   cost_within(walk, to.slot, to.polygon, way.at, before.corner) + before.cost;
    }
    way.leaves = way.at;
    return way;
}

// The tree's link of this polygon.
static goal_way over_link(const goal_walk *walk)
{
    const tl_nav_goal_entry *here = &walk->tree->entries[walk->entry];
    goal_way way = { INFINITY, UINT32_MAX, here->link, 0, 0, walk->at, here->corner };
    const tl_nav_offmesh_entry *link = tl_nav_find_offmesh(&walk->navmesh->offmesh, here->link);
    if (link == NULL || here->parent >= walk->tree->count) {
        return way;
    }
    const tl_nav_anchor *to = &link->ends[(here->link & TL_NAV_OFFMESH_BACKWARD) != 0 ? 0 : 1];
    const float at[2] = { walk->at.x, walk->at.z };
    const tl_nav_goal_funnel funnel = tl_nav_goal_funnel_of(here);
    if (to->slot == TL_NAV_NO_SLOT ||
        tl_nav_make_ref(walk->navmesh, to->slot, to->polygon) != walk->tree->entries[here->parent].polygon) {
        return way;
    }
    way.rest = walk->is_uniform ? tl_nav_goal_funnel_cost(&funnel, at, walk->unit)
                                : funnel.cost + cost_within(walk, walk->slot, walk->polygon, walk->at, funnel.corner);
    way.entry = here->parent;
    way.slot = to->slot;
    way.polygon = to->polygon;
    way.at = to->point;
    return way;
}

static goal_way choose_way(const goal_walk *walk)
{
    goal_way best = over_link(walk);
    const tl_nav_ring ring = tl_nav_ring_at(walk->navmesh, walk->slot, walk->polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            continue;
        }
        const tl_nav_ring_seam to = tl_nav_ring_across(walk->navmesh, walk->slot, tl_nav_ring_to(&ring, i));
        const uint32_t entry = find_entry(walk->tree, tl_nav_make_ref(walk->navmesh, to.slot, to.polygon), walk->entry);
        // Where the tree of the one across leads through this polygon, it is no way out.
        if (entry == UINT32_MAX || walk->tree->entries[entry].parent == walk->entry || entry == walk->before ||
            (!walk->all_pass && !tl_nav_passes(walk->filter, walk->navmesh->slots[to.slot].tile, to.polygon))) {
            continue;
        }
        const tl_nav_goal_portal out = tl_nav_goal_portal_of(&ring, i);
        const tl_nav_goal_portal portal = { out.right, out.left }; // from across it
        const goal_way way = over_edge(walk, entry, to, &portal);
        if (best.entry == UINT32_MAX || way.rest < best.rest || (way.rest == best.rest && way.entry < best.entry)) {
            best = way;
        }
    }
    return best;
}

typedef struct goal_trail {
    tl_nav_ref *polygons;
    uint32_t capacity, count, max_polygons;
    uint32_t chosen[MAX_CHOSEN + 1]; // the first entries
    uint32_t chosen_count;
} goal_trail;

static void add_to_trail(goal_trail *trail, tl_nav_ref ref)
{
    if (trail->count < trail->capacity) {
        trail->polygons[trail->count] = ref;
    }
    trail->count++;
}

static bool is_chosen(const goal_trail *trail, uint32_t entry)
{
    for (uint32_t k = 0; k < trail->chosen_count; k++) {
        if (trail->chosen[k] == entry) {
            return true;
        }
    }
    return false;
}

// Adds an entry and the link that leads to it. False: the trail ends before.
static bool extend_trail(goal_trail *trail, const tl_nav_goal_tree *tree, uint32_t entry, tl_nav_ref link)
{
    if (trail->max_polygons - trail->count < (link != TL_NAV_NO_REF ? 2u : 1u)) {
        return false;
    }
    if (link != TL_NAV_NO_REF) {
        add_to_trail(trail, link);
    }
    add_to_trail(trail, tree->entries[entry].polygon);
    return true;
}

// The first polygons, by choice, for as long as the rest falls. False: the trail ended there.
static bool choose_first(goal_walk *walk, goal_trail *trail, tl_nav_path *path_out)
{
    const tl_nav_goal_tree *tree = walk->tree;
    float rest = INFINITY;
    trail->chosen[trail->chosen_count++] = walk->entry;
    while (trail->chosen_count <= MAX_CHOSEN && tree->entries[walk->entry].parent != UINT32_MAX) {
        const goal_way way = choose_way(walk);
        if (way.entry == UINT32_MAX || is_chosen(trail, way.entry) || !(way.rest <= rest * (1.0f + REST_ROUNDING))) {
            break;
        }
        path_out->cost = trail->chosen_count == 1 ? way.rest : path_out->cost;
        if (!extend_trail(trail, tree, way.entry, way.link)) {
            path_out->end.point = way.leaves;
            return false;
        }
        rest = way.rest;
        walk->before = walk->entry;
        walk->entry = way.entry;
        walk->slot = way.slot;
        walk->polygon = way.polygon;
        walk->at = way.at;
        trail->chosen[trail->chosen_count++] = way.entry;
    }
    return true;
}

// Where the tree leaves a polygon: the middle of what is seen through the edge.
static tl_vec3 leaves_at(const tl_nav_goal_entry *entry)
{
    if (entry->link != TL_NAV_NO_REF) {
        return entry->corner;
    }
    return tl_vec3_make(0.5f * (entry->left[0] + entry->right[0]), entry->corner.y,
                        0.5f * (entry->left[1] + entry->right[1]));
}

// The rest by the tree. TL_NOT_FOUND: it leads back into what was chosen.
static tl_result follow_tree(const goal_walk *walk, goal_trail *trail, tl_nav_path *path_out)
{
    const tl_nav_goal_tree *tree = walk->tree;
    uint32_t at = walk->entry;
    for (uint32_t steps = 0; steps <= tree->count; steps++) {
        const tl_nav_goal_entry *here = &tree->entries[at];
        uint32_t slot = 0, polygon = 0;
        path_out->end.polygon = here->polygon;
        if (!tl_nav_split_ref(walk->navmesh, here->polygon, &slot, &polygon) ||
            (here->parent != UINT32_MAX && here->parent >= tree->count)) {
            return TL_ERR_STALE;
        }
        if (here->parent == UINT32_MAX) {
            path_out->status = TL_NAV_PATH_COMPLETE;
            path_out->end.point = tree->goal.point;
            return TL_OK;
        }
        if (is_chosen(trail, here->parent)) {
            return TL_NOT_FOUND;
        }
        if (!extend_trail(trail, tree, here->parent, here->link)) {
            path_out->end.point = leaves_at(here);
            return TL_OK;
        }
        at = here->parent;
    }
    return TL_ERR_STALE;
}

static tl_result walk_to_goal(goal_walk *walk, bool chooses, goal_trail *trail, tl_nav_path *path_out)
{
    const tl_nav_goal_entry *start = &walk->tree->entries[walk->entry];
    const float at[2] = { walk->at.x, walk->at.z };
    const tl_nav_goal_funnel funnel = tl_nav_goal_funnel_of(start);
    path_out->status = TL_NAV_PATH_UNFINISHED;
    path_out->cost = tl_nav_goal_funnel_cost(&funnel, at, walk->unit);
    add_to_trail(trail, start->polygon);
    if (chooses && !choose_first(walk, trail, path_out)) {
        path_out->end.polygon = walk->tree->entries[walk->entry].polygon;
        return TL_OK;
    }
    return follow_tree(walk, trail, path_out);
}

tl_result tl_nav_goal_begin(const tl_nav_filter *filter, float *unit_out, bool *is_uniform_out)
{
    *unit_out = 1.0f;
    *is_uniform_out = true;
    const bool is_good =
        tl_nav_filter_is_begun(filter) && (filter == NULL || tl_nav_filter_costs(filter, unit_out, is_uniform_out));
    return is_good ? TL_OK : TL_ERR_ARGUMENT;
}

tl_result tl_nav_goal_tree_path(const tl_nav_goal_tree *tree, const tl_navmesh *navmesh,
                                const tl_nav_goal_path_request *request, tl_nav_ref *polygons_out, uint32_t capacity,
                                tl_nav_path *path_out)
{
    if (tree == NULL || navmesh == NULL || request == NULL || path_out == NULL ||
        (tree->entries == NULL && tree->count > 0) || (polygons_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    goal_walk walk;
    memset(&walk, 0, sizeof walk);
    if (!tl_nav_is_finite(request->start.point)) {
        return TL_ERR_NOT_FINITE;
    }
    TL_TRY(tl_nav_goal_begin(request->filter, &walk.unit, &walk.is_uniform));
    walk.tree = tree;
    walk.navmesh = navmesh;
    walk.filter = request->filter;
    walk.all_pass = tl_nav_all_pass(navmesh, request->filter);
    const uint32_t entry = tree->count > 0 ? find_entry(tree, request->start.polygon, 0) : UINT32_MAX;
    tl_result result = TL_NOT_FOUND;
    for (uint32_t tries = 0; tries < 2 && result == TL_NOT_FOUND; tries++) {
        goal_trail trail;
        memset(&trail, 0, sizeof trail);
        trail.polygons = polygons_out;
        trail.capacity = capacity;
        trail.max_polygons = request->max_polygons > 0 ? request->max_polygons : UINT32_MAX;
        if (!tl_nav_split_ref(navmesh, request->start.polygon, &walk.slot, &walk.polygon)) {
            return TL_ERR_STALE;
        }
        if (entry == UINT32_MAX) {
            return TL_NOT_FOUND;
        }
        walk.entry = entry;
        walk.before = UINT32_MAX;
        walk.at = request->start.point;
        result = walk_to_goal(&walk, tries == 0, &trail, path_out);
        path_out->polygon_count = trail.count;
    }
    if (result != TL_OK) {
        memset(path_out, 0, sizeof *path_out);
        return result;
    }
    return path_out->polygon_count <= capacity ? TL_OK : TL_INCOMPLETE;
}
