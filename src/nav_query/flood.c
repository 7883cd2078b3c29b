// SPDX-License-Identifier: MIT
//
// Dijkstra over polygons: each is entered where the way into it is nearest to the point where the one before was, and
// once, by the cheapest way. A path needs less than that for its polygons, and its length is the funnel's affair.
// Source: Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959.

#include "nav_query/flood.h"

#include "nav_query/filter.h"
#include "nav_query/surface.h"

// Offers a way into a polygon: `end` is the one of an off-mesh link that was left, or TL_NAV_NO_END.
static void enter(tl_nav_flood *flood, uint32_t slot, uint32_t polygon, tl_vec3 point, float cost, uint32_t from,
                  uint32_t end)
{
    if (!(cost <= flood->max_cost) || !(cost < INFINITY)) {
        return;
    }
    uint32_t index = tl_nav_pool_get(flood->query, tl_nav_make_ref(flood->navmesh, slot, polygon));
    if (index == TL_NAV_NO_NODE) {
        flood->out_of_nodes = true;
        return;
    }
    tl_nav_node *node = &flood->query->nodes[index];
    if (node->heap_at == TL_NAV_NODE_CLOSED || (node->heap_at != TL_NAV_NODE_NEW && cost >= node->cost)) {
        return;
    }
    node->slot = slot;
    node->polygon = polygon;
    node->point = point;
    node->cost = cost;
    node->total = cost;
    node->parent = from;
    *tl_nav_flood_end(flood->query, index) = end;
    tl_nav_heap_improve(flood->query, index);
}

static float cost_between(const tl_nav_flood *flood, const tl_nav_node *node, tl_vec3 to)
{
    const tl_nav_tile *tile = flood->navmesh->slots[node->slot].tile;
    return flood->in_metres ? tl_distance(node->point, to)
                            : tl_nav_cost_between(flood->filter, tile, node->polygon, node->point, to);
}

static void cross_links(tl_nav_flood *flood, const tl_nav_node *node, uint32_t index)
{
    const tl_navmesh *navmesh = flood->navmesh;
    for (uint32_t end = tl_nav_first_anchor(navmesh, node->slot, node->polygon); end != TL_NAV_NO_END;) {
        const tl_nav_offmesh_entry *link = &navmesh->offmesh.entries[end / 2];
        const tl_nav_anchor *from = &link->ends[end % 2];
        const tl_nav_anchor *to = &link->ends[1 - end % 2];
        if (from->slot == node->slot && from->polygon == node->polygon &&
            tl_nav_may_cross(link, end % 2, flood->filter) &&
            tl_nav_passes(flood->filter, navmesh->slots[to->slot].tile, to->polygon) &&
            (flood->zone == NULL || tl_nav_zone_meets_segment(flood->zone, to->point, to->point))) {
            bool priced = flood->filter != NULL && !flood->in_metres;
            float factor = priced ? flood->filter->area_cost[link->offmesh.area] : 1.0f;
            float cost = cost_between(flood, node, from->point) + factor * (float)link->cost;
            enter(flood, to->slot, to->polygon, to->point, node->cost + cost, index, end);
        }
        end = from->next;
    }
}

static void go_on(tl_nav_flood *flood, uint32_t index)
{
    const tl_nav_node node = flood->query->nodes[index];
    cross_links(flood, &node, index);
    tl_nav_ways ways = tl_nav_ways_of(flood->navmesh, node.slot, node.polygon);
    tl_nav_way way;
    while (tl_nav_ways_next(&ways, &way)) {
        if (!tl_nav_passes(flood->filter, flood->navmesh->slots[way.slot].tile, way.polygon) ||
            (flood->zone != NULL && !tl_nav_zone_meets_segment(flood->zone, way.right, way.left))) {
            continue;
        }
        tl_vec3 point = tl_nav_closest_on_edge(way.right, way.left, node.point);
        float cost = cost_between(flood, &node, point);
        enter(flood, way.slot, way.polygon, point, node.cost + cost, index, TL_NAV_NO_END);
    }
}

bool tl_nav_flood_run(tl_nav_flood *flood, const tl_nav_location *start)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_split_ref(flood->navmesh, start->polygon, &slot, &polygon)) {
        return false;
    }
    flood->out_of_nodes = false;
    tl_nav_pool_reset(flood->query);
    enter(flood, slot, polygon, start->point, 0.0f, TL_NAV_NO_NODE, TL_NAV_NO_END);
    for (uint32_t index = 0; (index = tl_nav_heap_pop(flood->query)) != TL_NAV_NO_NODE;) {
        go_on(flood, index);
    }
    return true;
}
