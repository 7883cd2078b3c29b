// SPDX-License-Identifier: MIT
//
// Islands: what hangs together over all tiles and off-mesh links. Two polygons on two islands have no path between
// them, whatever the filter, and two array reads per polygon say so.
//
// Within a tile polygons are labelled once (rings.c). Labels of tiles are joined over seams by union-find: a tile that
// comes in joins its labels to its neighbours', in time in proportion to its own seams. A tile that leaves may split an
// island, which union-find cannot undo: all labels (not polygons) are joined anew.
// Off-mesh links join as if they led both ways: what is apart then is apart for certain. A second forest, without them,
// knows the shores: a link from a shore to itself joins nothing, and nothing needs to be joined anew when it goes.
// Unions go by size, so that a reader finds a root in log2(labels) steps without writing; a rebuild flattens to one.
// Source: Tarjan, Efficiency of a Good But Not Linear Set Union Algorithm, 1975.

#include "base/arena.h"
#include "nav_query/ring_step.h"

#include <string.h>

static uint32_t root_of(const tl_navmesh *navmesh, const tl_nav_island *forest, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    uint32_t node = rings->island[rings->component[polygon]];
    while (forest[node].parent != node) {
        node = forest[node].parent;
    }
    return node;
}

uint32_t tl_nav_island_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    return root_of(navmesh, navmesh->islands, slot, polygon);
}

bool tl_nav_is_on_one_shore(const tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry)
{
    return root_of(navmesh, navmesh->shores, entry->ends[0].slot, entry->ends[0].polygon) ==
           root_of(navmesh, navmesh->shores, entry->ends[1].slot, entry->ends[1].polygon);
}

tl_result tl_nav_reserve_islands(tl_navmesh *navmesh, uint32_t count)
{
    uint64_t needed = (uint64_t)navmesh->island_count + count;
    if (needed <= navmesh->island_capacity) {
        return TL_OK;
    }
    uint64_t capacity = 2 * needed;
    if (capacity > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    // Both forests stand in one block.
    tl_nav_island *grown = tl_allocate_array(&navmesh->allocator, 2 * capacity, sizeof *grown);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    if (navmesh->island_count > 0) {
        memcpy(grown, navmesh->islands, navmesh->island_count * sizeof *grown);
        memcpy(grown + capacity, navmesh->shores, navmesh->island_count * sizeof *grown);
    }
    tl_nav_free_islands(navmesh);
    navmesh->islands = grown;
    navmesh->shores = grown + capacity;
    navmesh->island_capacity = (uint32_t)capacity;
    return TL_OK;
}

void tl_nav_free_islands(tl_navmesh *navmesh)
{
    tl_release_array(&navmesh->allocator, navmesh->islands, 2 * (uint64_t)navmesh->island_capacity,
                     sizeof *navmesh->islands);
}

static void join(tl_nav_island *forest, uint32_t a, uint32_t b)
{
    if (a == b) {
        return;
    }
    // The larger one stays; of two alike the elder.
    bool a_stays = forest[a].size != forest[b].size ? forest[a].size > forest[b].size : a < b;
    uint32_t root = a_stays ? a : b;
    uint32_t child = a_stays ? b : a;
    forest[child].parent = root;
    forest[root].size += forest[child].size;
}

static void make_nodes(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_rings *rings = &navmesh->slots[slot].rings;
    for (uint32_t c = 0; c < rings->component_count; c++) {
        tl_nav_island node = { navmesh->island_count, 1 };
        rings->island[c] = navmesh->island_count;
        navmesh->islands[navmesh->island_count] = node;
        navmesh->shores[navmesh->island_count++] = node;
    }
}

// The root, with every second node on the way hung higher; for the writer, who may.
static uint32_t find_root(const tl_navmesh *navmesh, tl_nav_island *forest, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    uint32_t node = rings->island[rings->component[polygon]];
    while (forest[node].parent != node) {
        forest[node].parent = forest[forest[node].parent].parent;
        node = forest[node].parent;
    }
    return node;
}

// Over the sides from `first_side` on: links are mutual, so a seam may be looked at from one of its tiles.
static void join_over_seams(tl_navmesh *navmesh, tl_nav_island *forest, uint32_t slot, uint32_t first_side,
                            uint32_t side_count)
{
    const tl_nav_slot *own = &navmesh->slots[slot];
    for (uint32_t side = first_side; side < first_side + side_count; side++) {
        const tl_nav_side_links *links = &own->sides[side];
        const tl_nav_portal *portals = tl_nav_tile_portals(own->tile) + own->tile->side_first[side];
        for (uint32_t i = 0; links->first != NULL && i < links->portal_count; i++) {
            for (uint32_t k = links->first[i]; k < links->first[i + 1]; k++) {
                const tl_nav_seam_link *link = &links->links[k];
                join(forest, find_root(navmesh, forest, slot, portals[i].polygon),
                     find_root(navmesh, forest, link->slot, link->polygon));
            }
        }
    }
}

void tl_nav_join_islands(tl_navmesh *navmesh, uint32_t slot)
{
    make_nodes(navmesh, slot);
    join_over_seams(navmesh, navmesh->shores, slot, 0, 4);
    join_over_seams(navmesh, navmesh->islands, slot, 0, 4);
}

void tl_nav_join_anchors(tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry)
{
    uint32_t roots[2];
    for (int i = 0; i < 2; i++) {
        roots[i] = find_root(navmesh, navmesh->islands, entry->ends[i].slot, entry->ends[i].polygon);
    }
    join(navmesh->islands, roots[0], roots[1]);
}

static void flatten(tl_nav_island *forest, uint32_t count)
{
    for (uint32_t node = 0; node < count; node++) {
        uint32_t root = node;
        while (forest[root].parent != root) {
            root = forest[root].parent;
        }
        forest[node].parent = root;
    }
}

void tl_nav_rebuild_islands(tl_navmesh *navmesh)
{
    navmesh->island_count = 0;
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL) {
            make_nodes(navmesh, slot);
        }
    }
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL) {
            join_over_seams(navmesh, navmesh->shores, slot, 0, 2);
        }
    }
    flatten(navmesh->shores, navmesh->island_count);
    if (navmesh->island_count > 0) {
        memcpy(navmesh->islands, navmesh->shores, navmesh->island_count * sizeof *navmesh->islands);
    }
    for (uint32_t i = 0; i < navmesh->offmesh.used; i++) {
        const tl_nav_offmesh_entry *entry = &navmesh->offmesh.entries[i];
        if (entry->is_used && tl_nav_is_anchored(entry)) {
            tl_nav_join_anchors(navmesh, entry);
        }
    }
    flatten(navmesh->islands, navmesh->island_count);
}

tl_result tl_navmesh_island(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *island_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    *island_out = 0;
    if (!tl_nav_split_ref(navmesh, ref, &slot, &polygon)) {
        return TL_ERR_NOT_FOUND;
    }
    *island_out = tl_nav_island_of(navmesh, slot, polygon);
    return TL_OK;
}
