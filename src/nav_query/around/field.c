// SPDX-License-Identifier: MIT
//
// Fields (Dijkstra maps, flow fields): a flood, written out. In the order of references a polygon is found by binary
// search, without a table beside the caller's entries, and its path by following parents.

#include "base/assert.h"
#include "base/radix_sort.h"
#include "nav_query/around/flood.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/query_memory.h"

// Nodes in the order of their references; each node's heap_at, which nothing needs any more, becomes its place.
static const tl_sort_item *order_nodes(tl_nav_query *query)
{
    tl_sort_item *items = query->sort_items;
    for (uint32_t i = 0; i < query->node_count; i++) {
        items[i].key = query->nodes[i].key;
        items[i].value = i;
        items[i].extra = (uint32_t)*tl_nav_flood_end(query, i);
    }
    tl_radix_sort(items, items + query->max_nodes, query->node_count);
    for (uint32_t i = 0; i < query->node_count; i++) {
        query->nodes[items[i].value].heap_at = i;
    }
    return items;
}

// `end`: by which the way into the node began; `parent`: the place of the entry that it comes from.
static void write_entry(const tl_navmesh *navmesh, const tl_nav_node *node, uint32_t end, uint32_t parent,
                        tl_nav_field_entry *entry)
{
    entry->polygon = node->key;
    entry->link = end == TL_NAV_NO_END ? TL_NAV_NO_REF : tl_nav_offmesh_ref(&navmesh->offmesh, end);
    entry->parent = parent;
    entry->cost = node->cost;
    entry->point = node->point;
}

static void write_as_found(tl_nav_query *query, const tl_navmesh *navmesh, tl_nav_field_entry *entries,
                           uint32_t capacity)
{
    for (uint32_t i = 0; i < query->node_count && i < capacity; i++) {
        const tl_nav_node *node = &query->nodes[i];
        write_entry(navmesh, node, (uint32_t)*tl_nav_flood_end(query, i), node->parent, &entries[i]);
    }
}

static void write_by_reference(tl_nav_query *query, const tl_navmesh *navmesh, tl_nav_field_entry *entries,
                               uint32_t capacity)
{
    const tl_sort_item *items = order_nodes(query);
    for (uint32_t i = 0; i < query->node_count && i < capacity; i++) {
        const tl_nav_node *node = &query->nodes[items[i].value];
        uint32_t parent = node->parent == TL_NAV_NO_NODE ? UINT32_MAX : query->nodes[node->parent].heap_at;
        write_entry(navmesh, node, items[i].extra, parent, &entries[i]);
    }
}

tl_nav_field_def tl_default_nav_field_def(void)
{
    tl_nav_field_def def = { NULL, NULL, INFINITY, false, TL_DEF_COOKIE };
    return def;
}

static tl_result check_field_def(const tl_nav_field_def *def)
{
    float least = 1.0f;
    bool is_uniform = true;
    bool good = def->cookie == TL_DEF_COOKIE && tl_nav_filter_is_begun(def->filter) && def->max_cost >= 0.0f &&
                (def->filter == NULL || tl_nav_filter_costs(def->filter, &least, &is_uniform));
    return good ? TL_OK : TL_ERR_ARGUMENT;
}

// Within the nodes that the query has now.
static tl_result flood_within(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_location *start,
                              const tl_nav_field_def *def, tl_nav_field_entry *entries_out, uint32_t capacity,
                              uint32_t *count_out)
{
    if (query == NULL || navmesh == NULL || start == NULL || count_out == NULL ||
        (entries_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    const tl_nav_field_def used = def != NULL ? *def : tl_default_nav_field_def();
    tl_nav_zone_test zone;
    if (!tl_nav_is_finite(start->point)) {
        return TL_ERR_NOT_FINITE;
    }
    TL_TRY(check_field_def(&used));
    if (used.zone != NULL) {
        TL_TRY(tl_nav_zone_begin(used.zone, &zone));
    }
    tl_nav_flood flood = { query, navmesh, used.filter, false, used.max_cost, used.zone != NULL ? &zone : NULL,
                           false, false };
    if (!tl_nav_flood_run(&flood, start)) {
        return TL_ERR_STALE;
    }
    *count_out = query->node_count;
    if (used.by_reference) {
        write_by_reference(query, navmesh, entries_out, capacity);
    } else {
        write_as_found(query, navmesh, entries_out, capacity);
    }
    if (flood.out_of_nodes) {
        return TL_ERR_NODES;
    }
    return *count_out <= capacity ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_nav_query_flood(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_location *start,
                             const tl_nav_field_def *def, tl_nav_field_entry *entries_out, uint32_t capacity,
                             uint32_t *count_out)
{
    tl_result result;
    do {
        result = flood_within(query, navmesh, start, def, entries_out, capacity, count_out);
    } while (result == TL_ERR_NODES && tl_nav_query_grow(query));
    return result;
}

uint32_t tl_nav_field_find(const tl_nav_field_entry *entries, uint32_t count, tl_nav_ref polygon)
{
    TL_ASSERT(entries != NULL || count == 0);
    uint32_t low = 0;
    uint32_t high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (entries[middle].polygon < polygon) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < count && entries[low].polygon == polygon ? low : UINT32_MAX;
}

tl_result tl_nav_field_path(const tl_nav_field_entry *entries, uint32_t count, uint32_t entry, tl_nav_ref *polygons_out,
                            uint32_t capacity, uint32_t *count_out)
{
    if (entries == NULL || count_out == NULL || (polygons_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    uint32_t length = 0;
    uint32_t steps = 0;
    for (uint32_t i = entry; i != UINT32_MAX; i = entries[i].parent) {
        if (i >= count || steps == count) {
            return TL_NOT_FOUND;
        }
        steps++;
        length += entries[i].link == TL_NAV_NO_REF ? 1 : 2;
    }
    if (length == 0) {
        return TL_NOT_FOUND;
    }
    *count_out = length;
    for (uint32_t i = entry, at = length; i != UINT32_MAX; i = entries[i].parent) {
        if (--at < capacity) {
            polygons_out[at] = entries[i].polygon;
        }
        if (entries[i].link != TL_NAV_NO_REF && --at < capacity) {
            polygons_out[at] = entries[i].link;
        }
    }
    return length <= capacity ? TL_OK : TL_INCOMPLETE;
}
