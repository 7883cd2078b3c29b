// SPDX-License-Identifier: MIT
//
// Goal trees: Dijkstra's algorithm from a goal over polygons, each with the funnel through which it sees the last
// corner of the path; and paths read off it.
//
// Where the flood of a field (flood.c) goes from the nearest point of one edge to that of the next, and takes a floor
// of square polygons for a town with streets, a funnel is carried on from portal to portal: seen through them, the goal
// is as far as it is. The corner moves when the next portal lies beside the funnel. So a polygon knows the exact length
// of its points through the portals of its tree, up to corners that a funnel of two sides forgets.
//
// A tree of polygons has one way out of each; from the far end of a wide one another may be shorter. A path therefore
// asks the funnels of all neighbours where it stands, in each polygon that it comes through, and not the tree's parent.
// One node for each edge would know all ways out by itself, with five times the nodes. An exact map (Mitchell's
// continuous Dijkstra) has a node for each corner and edge that see each other, many times more than polygons.

#include "nav_query/around/goal_tree.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "base/radix_sort.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/node_pool.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// Offers a way from a polygon towards the goal: `end` is the one of an off-mesh link that it leaves, or TL_NAV_NO_END.
static void offer_way(tl_nav_goal_search *search, const tl_nav_way_in *way, const tl_nav_goal_funnel *funnel,
                      uint32_t end)
{
    if (!(way->cost < INFINITY)) {
        return;
    }
    tl_nav_node *node = tl_nav_pool_relax(search->query, *way, &search->out_of_nodes);
    if (node == NULL) {
        return;
    }
    const uint32_t index = (uint32_t)(node - search->query->nodes);
    if (index >= search->tree->capacity) {
        search->out_of_entries = true;
        node->heap_at = TL_NAV_NODE_CLOSED;
        return;
    }
    node->total = way->cost;
    tl_nav_goal_entry *entry = &search->tree->entries[index];
    memset(entry, 0, sizeof *entry);
    entry->polygon = way->key;
    entry->link = end == TL_NAV_NO_END ? TL_NAV_NO_REF : tl_nav_offmesh_ref(&search->navmesh->offmesh, end);
    entry->parent = way->parent;
    entry->min_cost = way->cost;
    entry->cost = funnel->cost;
    entry->corner = funnel->corner;
    memcpy(entry->left, funnel->left, sizeof entry->left);
    memcpy(entry->right, funnel->right, sizeof entry->right);
    tl_nav_heap_improve(search->query, index);
}

// Where area costs differ, paths bend at every edge: the corner is then the point of the edge that is nearest to the
// corner before.
static tl_nav_goal_funnel bend_at(const tl_nav_goal_search *search, const tl_nav_node *node,
                                  const tl_nav_goal_funnel *before, const tl_nav_goal_portal *portal)
{
    const tl_nav_tile *tile = search->navmesh->slots[node->slot].tile;
    const tl_vec3 at = tl_nav_closest_on_edge(portal->right, portal->left, before->corner);
    tl_nav_goal_funnel funnel;
    tl_nav_goal_funnel_open(
        &funnel, at, before->cost + tl_nav_cost_between(search->filter, tile, node->polygon, at, before->corner));
    return funnel;
}

static void leave_by_links(tl_nav_goal_search *search, const tl_nav_node *node, uint32_t index)
{
    const tl_navmesh *navmesh = search->navmesh;
    const tl_nav_goal_funnel funnel = tl_nav_goal_funnel_of(&search->tree->entries[index]);
    for (uint32_t end = tl_nav_first_anchor(navmesh, node->slot, node->polygon); end != TL_NAV_NO_END;) {
        const tl_nav_offmesh_entry *link = &navmesh->offmesh.entries[end / 2];
        const tl_nav_anchor *to = &link->ends[end % 2], *from = &link->ends[1 - end % 2];
        // Against the link's direction: the path leaves the end where the search arrives.
        if (to->slot == node->slot && to->polygon == node->polygon && from->slot != TL_NAV_NO_SLOT &&
            tl_nav_may_cross(link, 1 - end % 2, search->filter) &&
            tl_nav_passes(search->filter, navmesh->slots[from->slot].tile, from->polygon)) {
            const float factor = search->filter != NULL ? search->filter->area_cost[link->offmesh.area] : 1.0f;
            const float landing[2] = { to->point.x, to->point.z };
            const tl_nav_tile *tile = navmesh->slots[node->slot].tile;
            const float rest =
                search->is_uniform
                    ? tl_nav_goal_funnel_cost(&funnel, landing, search->unit)
                    : funnel.cost + tl_nav_cost_between(search->filter, tile, node->polygon, to->point, funnel.corner);
            const float cost = rest + factor * (float)link->cost;
            tl_nav_goal_funnel open;
            tl_nav_goal_funnel_open(&open, from->point, cost);
            const uint64_t key = tl_nav_make_ref(navmesh, from->slot, from->polygon);
            const tl_nav_way_in way = { key, from->slot, from->polygon, from->point, cost, index };
            offer_way(search, &way, &open, end ^ 1u);
        }
        end = to->next;
    }
}

static void leave_polygon(tl_nav_goal_search *search, uint32_t index)
{
    const tl_nav_node node = search->query->nodes[index];
    const tl_navmesh *navmesh = search->navmesh;
    const tl_nav_ring ring = tl_nav_ring_at(navmesh, node.slot, node.polygon);
    const tl_nav_goal_funnel before = tl_nav_goal_funnel_of(&search->tree->entries[index]);
    if (navmesh->slots[node.slot].anchor_count > 0) {
        leave_by_links(search, &node, index);
    }
    for (uint32_t i = 0; i < ring.count; i++) {
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            continue;
        }
        const tl_nav_ring_seam to = tl_nav_ring_across(navmesh, node.slot, tl_nav_ring_to(&ring, i));
        if (!search->all_pass && !tl_nav_passes(search->filter, navmesh->slots[to.slot].tile, to.polygon)) {
            continue;
        }
        const tl_nav_goal_portal portal = tl_nav_goal_portal_of(&ring, i);
        const tl_nav_goal_funnel funnel = search->is_uniform ? tl_nav_goal_funnel_pass(&before, &portal, search->unit)
                                                             : bend_at(search, &node, &before, &portal);
        // Seen edge-on a portal may seem to lie nearer than the one before it.
        const float cost = tl_max_f32(
            search->is_uniform ? tl_nav_goal_portal_cost(&funnel, &portal, search->unit) : funnel.cost, node.cost);
        const tl_nav_way_in way = {
            tl_nav_make_ref(navmesh, to.slot, to.polygon), to.slot, to.polygon, funnel.corner, cost, index
        };
        offer_way(search, &way, &funnel, TL_NAV_NO_END);
    }
}

// Puts the entries, which stand in the order of their nodes, in the order of their references.
static void order_entries(tl_nav_query *query, tl_nav_goal_tree *tree)
{
    tl_sort_item *items = query->sort_items;
    for (uint32_t i = 0; i < tree->count; i++) {
        items[i].key = tree->entries[i].polygon;
        items[i].value = i;
        items[i].extra = 0;
    }
    tl_radix_sort(items, items + query->max_nodes, tree->count);
    for (uint32_t i = 0; i < tree->count; i++) {
        query->nodes[items[i].value].heap_at = i;
    }
    for (uint32_t i = 0; i < tree->count; i++) {
        const uint32_t parent = tree->entries[i].parent;
        tree->entries[i].parent = parent != TL_NAV_NO_NODE ? query->nodes[parent].heap_at : UINT32_MAX;
    }
    // Cycle by cycle: each entry moves once.
    for (uint32_t i = 0; i < tree->count; i++) {
        const tl_nav_goal_entry first = tree->entries[i];
        uint32_t at = i;
        while (items[at].extra == 0) {
            items[at].extra = 1;
            const uint32_t from = items[at].value;
            tree->entries[at] = from != i ? tree->entries[from] : first;
            at = from;
        }
    }
}

static tl_result find_tree(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                           tl_nav_goal_tree *tree)
{
    tl_nav_goal_search search;
    memset(&search, 0, sizeof search);
    uint32_t slot = 0, polygon = 0;
    tree->count = 0;
    if (!tl_nav_is_finite(tree->goal.point)) {
        return TL_ERR_NOT_FINITE;
    }
    TL_TRY(tl_nav_goal_begin(filter, &search.unit, &search.is_uniform));
    if (!tl_nav_split_ref(navmesh, tree->goal.polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    search.query = query;
    search.navmesh = navmesh;
    search.filter = filter;
    search.tree = tree;
    search.all_pass = tl_nav_all_pass(navmesh, filter);
    tl_nav_pool_reset(query);
    tl_nav_goal_funnel funnel;
    tl_nav_goal_funnel_open(&funnel, tree->goal.point, 0.0f);
    const tl_nav_way_in way = { tree->goal.polygon, slot, polygon, tree->goal.point, 0.0f, TL_NAV_NO_NODE };
    offer_way(&search, &way, &funnel, TL_NAV_NO_END);
    for (uint32_t index = 0; (index = tl_nav_heap_pop(query)) != TL_NAV_NO_NODE;) {
        leave_polygon(&search, index);
    }
    tree->count = query->node_count < tree->capacity ? query->node_count : tree->capacity;
    order_entries(query, tree);
    return search.out_of_entries ? TL_INCOMPLETE : search.out_of_nodes ? TL_ERR_NODES : TL_OK;
}

tl_result tl_nav_query_find_goal_tree(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                      tl_nav_goal_tree *tree)
{
    if (query == NULL || navmesh == NULL || tree == NULL || (tree->entries == NULL && tree->capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    tl_result result;
    do {
        result = find_tree(query, navmesh, filter, tree);
    } while (result == TL_ERR_NODES && query->max_nodes < tree->capacity && tl_nav_query_grow(query));
    return result;
}
