// SPDX-License-Identifier: MIT
//
// Islands: the connected components of the navmesh over all tiles and off-mesh links. Two polygons on two islands have
// no path between them, whatever the filter, and a few array reads per polygon say so.
//
// Within a tile polygons are labelled once (rings.c); those components are the nodes. A node has a label, and labels
// are joined by union-find: a tile that comes in joins its own to its neighbours', in time in proportion to its seams.
// Nodes point to labels, never to one another, so that a part that is cut off gets a label of its own and all others
// keep theirs (island_split.c). Labels are handed out once; when they run out, the roots are named anew.
// Off-mesh links join as if they led both ways: what is apart then is apart for certain. A second set of labels holds
// the components over seams alone: a link within one of them joins nothing, and removing it splits nothing. Unions go
// by size, so that a reader finds a root in log2(labels) steps without writing. Source: Tarjan, Efficiency of a Good
// But Not Linear Set Union Algorithm, 1975.

#include "nav_query/navmesh/islands.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/navmesh/navmesh.h"

#include <string.h>

static uint32_t node_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    return tl_nav_ring_islands(rings)[tl_nav_component_of(rings, polygon)];
}

static uint32_t label_of(const tl_navmesh *navmesh, tl_nav_island_kind kind, uint32_t slot, uint32_t polygon)
{
    const tl_nav_islands *islands = &navmesh->islands;
    return tl_nav_label_root(islands->labels[kind], islands->nodes[node_of(navmesh, slot, polygon)].labels[kind]);
}

uint32_t tl_nav_island_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    return label_of(navmesh, TL_NAV_ISLANDS, slot, polygon);
}

bool tl_nav_is_same_component(const tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry)
{
    return label_of(navmesh, TL_NAV_SEAM_ISLANDS, entry->ends[0].slot, entry->ends[0].polygon) ==
           label_of(navmesh, TL_NAV_SEAM_ISLANDS, entry->ends[1].slot, entry->ends[1].polygon);
}

static void free_arrays(const tl_allocator *allocator, tl_nav_islands *islands)
{
    const uint64_t capacity = islands->capacity;
    tl_release_array(allocator, islands->nodes, capacity, sizeof *islands->nodes);
    tl_release_array(allocator, islands->labels[0], TL_NAV_ISLAND_KINDS * tl_nav_label_room(islands),
                     sizeof **islands->labels);
}

static void free_seeds(const tl_allocator *allocator, tl_nav_islands *islands)
{
    tl_release_array(allocator, islands->pieces, islands->seed_capacity, sizeof *islands->pieces);
    tl_release_array(allocator, islands->seeds, islands->seed_capacity, sizeof *islands->seeds);
}

void tl_nav_free_islands(tl_navmesh *navmesh)
{
    free_seeds(&navmesh->allocator, &navmesh->islands);
    free_arrays(&navmesh->allocator, &navmesh->islands);
    memset(&navmesh->islands, 0, sizeof navmesh->islands);
}

tl_result tl_nav_reserve_islands(tl_navmesh *navmesh, uint32_t count)
{
    const tl_nav_islands *old = &navmesh->islands;
    const tl_allocator *allocator = &navmesh->allocator;
    const uint64_t needed = (uint64_t)old->used - old->free_count + count;
    if (needed <= old->capacity) {
        return TL_OK;
    }
    // The first tile is often the only one.
    const uint64_t capacity = old->capacity > 0 ? needed + needed / 8 : needed;
    if (4 * capacity > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_nav_islands grown = *old;
    grown.capacity = (uint32_t)capacity;
    grown.nodes = tl_allocate_array(allocator, capacity, sizeof *grown.nodes);
    const uint64_t room = tl_nav_label_room(&grown);
    grown.labels[0] = tl_allocate_array(allocator, TL_NAV_ISLAND_KINDS * room, sizeof **grown.labels);
    if (grown.nodes == NULL || grown.labels[0] == NULL) {
        free_arrays(allocator, &grown);
        return TL_ERR_MEMORY;
    }
    grown.labels[1] = grown.labels[0] + room;
    if (old->capacity > 0) {
        memcpy(grown.nodes, old->nodes, old->used * sizeof *grown.nodes);
        for (int kind = 0; kind < TL_NAV_ISLAND_KINDS; kind++) {
            memcpy(grown.labels[kind], old->labels[kind], old->label_count[kind] * sizeof **grown.labels);
        }
    } else {
        grown.free = TL_NAV_NO_ISLAND;
    }
    free_arrays(allocator, &navmesh->islands);
    navmesh->islands = grown;
    tl_nav_touch_all(grown.history, TL_NAV_PAGED_ISLAND_NODES, capacity);
    for (uint32_t kind = 0; kind < TL_NAV_ISLAND_KINDS; kind++) {
        tl_nav_touch_all(grown.history, TL_NAV_PAGED_LABELS + kind, room);
    }
    return TL_OK;
}

tl_result tl_nav_reserve_seeds(tl_navmesh *navmesh, uint32_t seams, uint32_t offmesh_capacity)
{
    // A tile that leaves seeds what its seams lead to. At both ends of an off-mesh link lies one node before an edit,
    // and one after it.
    const tl_nav_islands *old = &navmesh->islands;
    const uint32_t most_seams = seams > old->most_seams ? seams : old->most_seams;
    const uint64_t seeds = most_seams + 4 * (uint64_t)offmesh_capacity;
    const uint32_t capacity = seeds < old->capacity ? (uint32_t)seeds : old->capacity;
    navmesh->islands.most_seams = most_seams;
    if (capacity <= old->seed_capacity) {
        return TL_OK;
    }
    tl_nav_islands grown = *old;
    grown.seed_capacity = capacity;
    grown.pieces = tl_allocate_array(&navmesh->allocator, capacity, sizeof *grown.pieces);
    grown.seeds = tl_allocate_array(&navmesh->allocator, capacity, sizeof *grown.seeds);
    if (grown.pieces == NULL || grown.seeds == NULL) {
        free_seeds(&navmesh->allocator, &grown);
        return TL_ERR_MEMORY;
    }
    free_seeds(&navmesh->allocator, &navmesh->islands);
    navmesh->islands = grown;
    return TL_OK;
}

// Each node gets its root for a label, and the roots new numbers in the nodes' order.
static void name_anew(tl_nav_islands *islands, tl_nav_island_kind kind)
{
    tl_nav_island_label *labels = islands->labels[kind];
    tl_nav_touch_all(islands->history, TL_NAV_PAGED_ISLAND_NODES, islands->capacity);
    tl_nav_touch_all(islands->history, TL_NAV_PAGED_LABELS + (uint32_t)kind, tl_nav_label_room(islands));
    for (uint32_t i = 0; i < islands->label_count[kind]; i++) {
        labels[i].parent = tl_nav_label_root(labels, i);
        labels[i].size = UINT32_MAX;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < islands->used; i++) {
        tl_nav_island_node *node = &islands->nodes[i];
        if (node->slot != TL_NAV_NO_SLOT) {
            tl_nav_island_label *root = &labels[labels[node->labels[kind]].parent];
            root->size = root->size == UINT32_MAX ? count++ : root->size;
            node->labels[kind] = root->size;
        }
    }
    islands->label_count[kind] = 0;
    while (islands->label_count[kind] < count) {
        tl_nav_new_label(islands, kind);
    }
}

void tl_nav_reserve_labels(tl_nav_islands *islands, tl_nav_island_kind kind, uint32_t count)
{
    // No more labels are in use than there are nodes, new ones included: of the groups of a split one keeps its label.
    if ((uint64_t)islands->label_count[kind] + count > tl_nav_label_room(islands)) {
        name_anew(islands, kind);
    }
}

uint32_t tl_nav_new_label(tl_nav_islands *islands, tl_nav_island_kind kind)
{
    uint32_t index = islands->label_count[kind]++;
    tl_nav_island_label label = { index, 1 };
    islands->labels[kind][index] = label;
    tl_nav_touch(islands->history, TL_NAV_PAGED_LABELS + (uint32_t)kind, index);
    return index;
}

// The root, with every second label on the way hung higher; for the writer, who may.
static uint32_t find_label_root(tl_nav_islands *islands, tl_nav_island_kind kind, uint32_t label)
{
    tl_nav_island_label *labels = islands->labels[kind];
    while (labels[label].parent != label) {
        labels[label].parent = labels[labels[label].parent].parent;
        tl_nav_touch(islands->history, TL_NAV_PAGED_LABELS + (uint32_t)kind, label);
        label = labels[label].parent;
    }
    return label;
}

static void join_labels(tl_nav_islands *islands, tl_nav_island_kind kind, uint32_t node_a, uint32_t node_b)
{
    tl_nav_island_label *labels = islands->labels[kind];
    uint32_t a = find_label_root(islands, kind, islands->nodes[node_a].labels[kind]);
    uint32_t b = find_label_root(islands, kind, islands->nodes[node_b].labels[kind]);
    if (a == b) {
        return;
    }
    // The larger one stays; of two alike the elder.
    bool a_stays = labels[a].size != labels[b].size ? labels[a].size > labels[b].size : a < b;
    uint32_t root = a_stays ? a : b;
    uint32_t child = a_stays ? b : a;
    labels[child].parent = root;
    labels[root].size += labels[child].size;
    tl_nav_touch(islands->history, TL_NAV_PAGED_LABELS + (uint32_t)kind, child);
    tl_nav_touch(islands->history, TL_NAV_PAGED_LABELS + (uint32_t)kind, root);
}

static void make_nodes(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_islands *islands = &navmesh->islands;
    tl_nav_rings *rings = &navmesh->slots[slot].rings;
    for (uint32_t kind = 0; kind < TL_NAV_ISLAND_KINDS; kind++) {
        tl_nav_reserve_labels(islands, (tl_nav_island_kind)kind, rings->component_count);
    }
    uint32_t made = 0; // components are numbered in the order of their first polygons
    for (uint32_t p = 0; p < rings->polygon_count && made < rings->component_count; p++) {
        if (tl_nav_component_of(rings, p) != made) {
            continue;
        }
        uint32_t index = islands->free;
        if (index != TL_NAV_NO_ISLAND) {
            islands->free = islands->nodes[index].next;
            islands->free_count--;
        } else {
            index = islands->used++;
        }
        tl_nav_island_node node = { slot,
                                    p,
                                    { tl_nav_new_label(islands, TL_NAV_SEAM_ISLANDS),
                                      tl_nav_new_label(islands, TL_NAV_ISLANDS) },
                                    TL_NAV_NO_ISLAND,
                                    TL_NAV_NO_ISLAND };
        islands->nodes[index] = node;
        tl_nav_touch(islands->history, TL_NAV_PAGED_ISLAND_NODES, index);
        tl_nav_ring_islands(rings)[made++] = index;
    }
}

void tl_nav_join_islands(tl_navmesh *navmesh, uint32_t slot)
{
    make_nodes(navmesh, slot);
    const tl_nav_slot *own = &navmesh->slots[slot];
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        const tl_nav_side_links *links = &own->sides[side];
        const tl_nav_portal *portals = tl_nav_tile_portals(own->tile) + tl_nav_tile_side_first(own->tile, side);
        const tl_nav_seam_link *seams = links->first != NULL ? tl_nav_seam_links_of(links) : NULL;
        for (uint32_t i = 0; seams != NULL && i < links->portal_count; i++) {
            for (uint32_t k = links->first[i]; k < links->first[i + 1]; k++) {
                uint32_t node = node_of(navmesh, slot, portals[i].polygon);
                uint32_t neighbour = node_of(navmesh, tl_nav_seam_slot(&seams[k]), tl_nav_seam_polygon(&seams[k]));
                join_labels(&navmesh->islands, TL_NAV_SEAM_ISLANDS, node, neighbour);
                join_labels(&navmesh->islands, TL_NAV_ISLANDS, node, neighbour);
            }
        }
    }
}

void tl_nav_join_anchors(tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry)
{
    join_labels(&navmesh->islands, TL_NAV_ISLANDS, node_of(navmesh, entry->ends[0].slot, entry->ends[0].polygon),
                node_of(navmesh, entry->ends[1].slot, entry->ends[1].polygon));
}

void tl_nav_seed_island(tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    tl_nav_islands *islands = &navmesh->islands;
    uint32_t index = node_of(navmesh, slot, polygon);
    // Until the search begins a seed is known by any piece's number.
    if (islands->nodes[index].piece == TL_NAV_NO_ISLAND) {
        TL_ASSERT(islands->seed_count < islands->seed_capacity);
        islands->nodes[index].piece = 0;
        islands->seeds[islands->seed_count++] = index;
    }
}

void tl_nav_leave_islands(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_islands *islands = &navmesh->islands;
    const tl_nav_slot *own = &navmesh->slots[slot];
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t k = 0; k < own->sides[side].link_count; k++) {
            const tl_nav_seam_link *link = &tl_nav_seam_links_of(&own->sides[side])[k];
            tl_nav_seed_island(navmesh, tl_nav_seam_slot(link), tl_nav_seam_polygon(link));
        }
    }
    islands->seam_seed_count = islands->seed_count;
    for (uint32_t c = 0; c < own->rings.component_count; c++) {
        const uint32_t index = tl_nav_ring_islands(&own->rings)[c];
        tl_nav_island_node *node = &islands->nodes[index];
        tl_nav_touch(islands->history, TL_NAV_PAGED_ISLAND_NODES, index);
        node->slot = TL_NAV_NO_SLOT;
        node->next = islands->free;
        islands->free = index;
        islands->free_count++;
    }
}

tl_result tl_navmesh_island(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *island_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (navmesh == NULL || island_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *island_out = 0;
    if (!tl_nav_split_ref(navmesh, ref, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    *island_out = tl_nav_island_of(navmesh, slot, polygon);
    return TL_OK;
}
