// SPDX-License-Identifier: MIT
//
// Dijkstra's algorithm over polygons: each is entered once, by the cheapest way, at the point of its edge that is
// nearest to the point before. That is all a field needs; the funnel finds the exact length of a path. Source:
// Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959.

#include "nav_query/around/flood.h"
#include "nav_query/navmesh/offmesh_anchor.h"

#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/plane/nearest_on_edge.h"
#include "nav_query/plane/surface.h"

// Offers a way into a polygon: `end` is the one of an off-mesh link that was left, or TL_NAV_NO_END.
static void enter_polygon(tl_nav_flood *flood, uint32_t slot, uint32_t polygon, tl_vec3 point, float cost,
                          uint32_t from, uint32_t end)
{
    if (!(cost <= flood->max_cost) || !(cost < INFINITY)) {
        return;
    }
    const uint64_t key = tl_nav_make_ref(flood->navmesh, slot, polygon);
    const tl_nav_way_in way = { key, slot, polygon, point, cost, from };
    tl_nav_node *node = tl_nav_pool_relax(flood->query, way, &flood->out_of_nodes);
    if (node != NULL) {
        const uint32_t index = (uint32_t)(node - flood->query->nodes);
        node->total = cost;
        *tl_nav_flood_end(flood->query, index) = end;
        tl_nav_heap_improve(flood->query, index);
    }
}

static float cost_between(const tl_nav_flood *flood, const tl_nav_node *node, tl_vec3 to)
{
    if (flood->in_metres || flood->filter == NULL) {
        return tl_distance(node->point, to);
    }
    const tl_nav_tile *tile = flood->navmesh->slots[node->slot].tile;
    return tl_nav_cost_between(flood->filter, tile, node->polygon, node->point, to);
}

static void enter_by_links(tl_nav_flood *flood, const tl_nav_node *node, uint32_t index)
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
            enter_polygon(flood, to->slot, to->polygon, to->point, node->cost + cost, index, end);
        }
        end = from->next;
    }
}

static void expand_polygon(tl_nav_flood *flood, uint32_t index)
{
    const tl_nav_node node = flood->query->nodes[index];
    const tl_nav_node *parent = node.parent != TL_NAV_NO_NODE ? &flood->query->nodes[node.parent] : NULL;
    const tl_nav_ring ring = tl_nav_ring_at(flood->navmesh, node.slot, node.polygon);
    const bool all_pass = flood->all_pass;
    if (flood->navmesh->slots[node.slot].anchor_count > 0) {
        enter_by_links(flood, &node, index);
    }
    for (uint32_t i = 0; i < ring.count; i++) {
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, i))) {
            continue;
        }
        tl_nav_ring_seam to = tl_nav_ring_across(flood->navmesh, node.slot, tl_nav_ring_to(&ring, i));
        if (parent != NULL && to.polygon == parent->polygon && to.slot == parent->slot) {
            continue; // closed already
        }
        const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
        const tl_vec3 right = ring.points[i];
        const tl_vec3 left = *end;
        if ((flood->zone != NULL && !tl_nav_zone_meets_segment(flood->zone, right, left)) ||
            (!all_pass && !tl_nav_passes(flood->filter, flood->navmesh->slots[to.slot].tile, to.polygon))) {
            continue;
        }
        double t = tl_nav_nearest_on_edge(&ring.points[i], end, (double)node.point.x, (double)node.point.z).t;
        tl_vec3 point = tl_nav_point_on_edge(&ring.points[i], end, t);
        float cost = cost_between(flood, &node, point);
        enter_polygon(flood, to.slot, to.polygon, point, node.cost + cost, index, TL_NAV_NO_END);
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
    flood->all_pass = tl_nav_all_pass(flood->navmesh, flood->filter);
    tl_nav_pool_reset(flood->query);
    enter_polygon(flood, slot, polygon, start->point, 0.0f, TL_NAV_NO_NODE, TL_NAV_NO_END);
    for (uint32_t index = 0; (index = tl_nav_heap_pop(flood->query)) != TL_NAV_NO_NODE;) {
        expand_polygon(flood, index);
    }
    return true;
}
