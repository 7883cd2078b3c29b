// SPDX-License-Identifier: MIT
//
// Which polygons of a tile are those of the tile that was in its place.
//
// Where a door closes or a crate comes a tile is baked anew, and many of its polygons are what they were: the same
// corners, maybe under another number. They are looked for by a hash, and compared corner by corner. One of a hundred
// begins at another corner than before: it counts as another.

#include "nav_query/mending/known_rings.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/min_max.h"

#include <string.h>

// Rings of the same hash that are compared: more are only met in tiles made to be slow, whose polygons are then taken
// for others.
enum { MOST_TRIES = 8 };

tl_result tl_nav_keep_rings(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph, uint32_t slot)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    tl_nav_known_rings *known = &graph->tiles[slot].rings;
    tl_nav_known_rings made = { NULL, NULL, NULL, rings->polygon_count, rings->edge_count, rings->seam_count };
    const uint64_t bytes = ((uint64_t)made.polygon_count + 1) * sizeof *made.first +
                           made.edge_count * (uint64_t)sizeof *made.edges +
                           made.seam_count * (uint64_t)sizeof *made.seams;
    graph->tile_bytes -= tl_nav_known_rings_size(known);
    tl_nav_free_known_rings(&navmesh->allocator, known);
    made.first = tl_allocate_array(&navmesh->allocator, bytes, 1);
    if (made.first == NULL) {
        return TL_ERR_MEMORY;
    }
    made.edges = (tl_nav_known_edge *)(void *)(made.first + made.polygon_count + 1);
    made.seams = (tl_nav_ring_seam *)(void *)(made.edges + made.edge_count);
    for (uint32_t i = 0; i < made.seam_count; i++) {
        made.seams[i] = tl_nav_ring_seam_of(rings, TL_NAV_RING_BACK - 1 - i);
    }
    for (uint32_t p = 0; p < made.polygon_count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        made.first[p] = ring.first;
        for (uint32_t i = 0; i < ring.count; i++) {
            const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, i);
            const uint32_t turn = tl_nav_turn_of(rings, edge);
            const tl_nav_known_edge kept = { ring.points[i].x, ring.points[i].z, edge.to,
                                             turn != 0 ? tl_nav_find_name(&graph->names, turn) : TL_NAV_NO_VERTEX };
            made.edges[ring.first + i] = kept;
        }
    }
    made.first[made.polygon_count] = made.edge_count;
    *known = made;
    graph->tile_bytes += bytes;
    return TL_OK;
}

static uint64_t hash_of_point(float x, float z)
{
    const float point[2] = { x, z };
    uint64_t bits;
    memcpy(&bits, point, sizeof bits);
    return tl_hash_mix(bits);
}

static uint64_t hash_of_ring(const tl_nav_ring *ring)
{
    uint64_t sum = ring->count;
    for (uint32_t i = 0; i < ring->count; i++) {
        sum += hash_of_point(ring->points[i].x, ring->points[i].z);
    }
    return sum;
}

static uint64_t hash_of_known(const tl_nav_known_rings *known, uint32_t polygon)
{
    uint64_t sum = known->first[polygon + 1] - known->first[polygon];
    for (uint32_t i = known->first[polygon]; i < known->first[polygon + 1]; i++) {
        sum += hash_of_point(known->edges[i].x, known->edges[i].z);
    }
    return sum;
}

bool tl_nav_has_known_points(const tl_nav_known_rings *known, uint32_t polygon, const tl_nav_ring *ring)
{
    const tl_nav_known_edge *edges = known->edges + known->first[polygon];
    bool same = ring->count == known->first[polygon + 1] - known->first[polygon];
    for (uint32_t i = 0; i < ring->count && same; i++) {
        same = edges[i].x == ring->points[i].x && edges[i].z == ring->points[i].z;
    }
    return same;
}

// Of the polygons of a tile by their hashes, sorted: the one of this hash with the same points, which is taken off.
static uint32_t take_same(const tl_nav_rings *rings, const tl_nav_known_rings *known, uint32_t polygon,
                          tl_nav_pair_list *sorted)
{
    const uint64_t hash = hash_of_known(known, polygon);
    uint64_t i = tl_nav_find_key(sorted, hash);
    for (uint32_t tries = 0; i < sorted->count && sorted->items[i].key == hash && tries < MOST_TRIES; i++, tries++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, sorted->items[i].value);
        if (sorted->items[i].extra == 0 && tl_nav_has_known_points(known, polygon, &ring)) {
            sorted->items[i].extra = 1;
            return sorted->items[i].value;
        }
    }
    return TL_NO_POLYGON;
}

static tl_result map_in_memory(const tl_navmesh *navmesh, const tl_nav_known_rings *known, uint32_t slot,
                               tl_nav_pair_list *sorted, tl_nav_number_list *map)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        const tl_sort_item item = { hash_of_ring(&ring), p, 0 };
        TL_TRY(tl_nav_add_item(&navmesh->allocator, sorted, item));
    }
    TL_TRY(tl_nav_sort_pairs(&navmesh->allocator, sorted, NULL));
    for (uint32_t p = 0; p < known->polygon_count; p++) {
        TL_TRY(tl_nav_add_number(&navmesh->allocator, map, take_same(rings, known, p, sorted)));
    }
    return TL_OK;
}

tl_result tl_nav_map_polygons(const tl_navmesh *navmesh, const tl_nav_known_rings *known, uint32_t slot,
                              tl_nav_number_list *map)
{
    tl_nav_pair_list sorted = { NULL, 0, 0 };
    const tl_result result = map_in_memory(navmesh, known, slot, &sorted, map);
    tl_nav_free_pairs(&navmesh->allocator, &sorted);
    return result;
}

tl_nav_plan_box tl_nav_box_of_edges(const tl_nav_known_edge *edges, uint32_t count)
{
    tl_nav_plan_box box = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    for (uint32_t i = 0; i < count; i++) {
        box.low_x = tl_min_f32(box.low_x, edges[i].x);
        box.low_z = tl_min_f32(box.low_z, edges[i].z);
        box.high_x = tl_max_f32(box.high_x, edges[i].x);
        box.high_z = tl_max_f32(box.high_z, edges[i].z);
    }
    return box;
}
