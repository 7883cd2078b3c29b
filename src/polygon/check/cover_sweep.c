// SPDX-License-Identifier: MIT
//
// Proves in O(n log n) that no two polygons of a group overlap and no corner lies inside an edge, which is what meshes
// are nearly always like. Where the proof fails the pairs are looked at one by one (polygon_cover.c), for the counts.
//
// One sweep tells that edges meet in their ends alone. Then the space just above an edge is one face, all along it, and
// so is that just below. So it is enough to count the polygons that cover each, from the lowest edge up: below the
// edges that begin in a point lies what is above the edge under that point, which the sweep has recorded; and each edge
// adds the polygons above it and takes away those below it. Everywhere must be one polygon or none.

#include "polygon/check/polygon_check.h"

#include "base/assert.h"
#include "polygon/outline/packed_point.h"
#include "polygon/outline/sweep.h"

// Edges of all polygons, each once. There are at most as many as corners.
typedef struct cover_edges {
    tl_lattice_point *points;     // in the sweep's order
    uint32_t *numbers;            // of corners: their points
    tl_lattice_segment *segments; // from the point swept first to the other, by that point
    int32_t *rises;               // polygons above a segment less those below
    int32_t *above;               // polygons that cover the face above it
    tl_sort_item *items;          // [2 corner_count] to sort
    uint32_t corner_count, point_count, segment_count;
} cover_edges;

static bool allocate_cover_edges(cover_edges *e, tl_arena *arena, uint32_t corner_count)
{
    e->corner_count = corner_count;
    e->points = TL_PUSH(arena, tl_lattice_point, corner_count);
    e->numbers = TL_PUSH(arena, uint32_t, corner_count);
    e->segments = TL_PUSH(arena, tl_lattice_segment, corner_count);
    e->rises = TL_PUSH(arena, int32_t, corner_count);
    e->above = TL_PUSH(arena, int32_t, corner_count);
    e->items = TL_PUSH(arena, tl_sort_item, 2 * (uint64_t)corner_count);
    return e->points != NULL && e->numbers != NULL && e->segments != NULL && e->rises != NULL && e->above != NULL &&
           e->items != NULL;
}

// Numbers the group's corners by place, in the sweep's order.
static void number_corners(cover_edges *e, const tl_polygon_mesh *mesh, const tl_sort_item *polygons, uint32_t count)
{
    uint32_t corner = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = mesh->first[polygons[i].value]; k < mesh->first[polygons[i].value + 1]; k++) {
            const tl_sort_item item = { tl_pack_point(tl_mesh_corner(mesh, k)), corner, mesh->indices[k] };
            e->items[corner++] = item;
        }
    }
    tl_radix_sort(e->items, e->items + e->corner_count, e->corner_count);
    e->point_count = 0;
    for (uint32_t i = 0; i < e->corner_count; i++) {
        if (i == 0 || e->items[i].key != e->items[i - 1].key) {
            e->points[e->point_count++] = tl_mesh_point(mesh, e->items[i].extra);
        }
        e->numbers[e->items[i].value] = e->point_count - 1;
    }
}

// A polygon lies left of its edges, and left of a segment that runs on with the sweep is above.
static void gather_cover_edges(cover_edges *e, const tl_polygon_mesh *mesh, const tl_sort_item *polygons,
                               uint32_t count)
{
    uint32_t first = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t corners = mesh->first[polygons[i].value + 1] - mesh->first[polygons[i].value];
        for (uint32_t k = 0; k < corners; k++) {
            const uint32_t a = e->numbers[first + k], b = e->numbers[first + (k + 1 < corners ? k + 1 : 0)];
            const bool on = a < b;
            const tl_sort_item item = { (uint64_t)(on ? a : b) << 32 | (on ? b : a), on ? 1u : 0u, 0 };
            e->items[first + k] = item;
        }
        first += corners;
    }
    tl_radix_sort(e->items, e->items + e->corner_count, e->corner_count);
    e->segment_count = 0;
    for (uint32_t i = 0; i < e->corner_count; i++) {
        if (i == 0 || e->items[i].key != e->items[i - 1].key) {
            const tl_lattice_segment segment = { (uint32_t)(e->items[i].key >> 32), (uint32_t)e->items[i].key };
            e->rises[e->segment_count] = 0;
            e->segments[e->segment_count++] = segment;
        }
        e->rises[e->segment_count - 1] += e->items[i].value != 0 ? 1 : -1;
    }
}

// Whether segment a leaves the point where both begin below b. No two run along each other.
static bool is_lower_segment(const cover_edges *e, uint32_t a, uint32_t b)
{
    const tl_lattice_segment s = e->segments[a];
    return tl_turn(e->points[s.a], e->points[s.b], e->points[e->segments[b].b]) > 0;
}

#define TL_HEAP(name)                 lowest_segment_##name
#define TL_HEAP_ITEM                  uint32_t
#define TL_HEAP_CONTEXT               const cover_edges *
#define TL_HEAP_BEFORE(context, a, b) is_lower_segment(context, a, b)
#include "base/heap.inl"

// Covers the faces above the segments that begin in each point, from the lowest up. False: one is covered twice.
static bool count_covers(const cover_edges *e, const tl_sweep_record *record, uint32_t *heap)
{
    for (uint32_t point = 0, next = 0; point < e->point_count; point++) {
        uint32_t begun = 0;
        while (next < e->segment_count && e->segments[next].a == point) {
            lowest_segment_push(heap, &begun, next++, e);
        }
        if (begun == 0) {
            continue;
        }
        const uint32_t below = record->below[point];
        int32_t cover = below != TL_NO_SEGMENT ? e->above[below] : 0;
        while (begun > 0) {
            const uint32_t segment = lowest_segment_pop(heap, &begun, e);
            cover += e->rises[segment];
            if (cover < 0 || cover > 1) {
                return false;
            }
            e->above[segment] = cover;
        }
    }
    return true;
}

tl_result tl_polygon_sweep_cover(tl_polygon_checker *checker, const tl_sort_item *polygons, uint32_t count,
                                 bool *is_proven_out)
{
    const tl_polygon_mesh *mesh = checker->mesh;
    tl_arena *arena = &checker->arena;
    uint32_t corner_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        corner_count += mesh->first[polygons[i].value + 1] - mesh->first[polygons[i].value];
    }
    cover_edges e;
    tl_sweep_record record;
    *is_proven_out = false;
    if (!allocate_cover_edges(&e, arena, corner_count) || !tl_sweep_record_init(&record, arena, corner_count)) {
        return TL_ERR_MEMORY;
    }
    number_corners(&e, mesh, polygons, count);
    gather_cover_edges(&e, mesh, polygons, count);
    bool apart;
    TL_TRY(tl_sweep_segments(arena, e.points, e.point_count, e.segments, e.segment_count, &record, &apart));
    *is_proven_out = apart && count_covers(&e, &record, e.numbers);
    return TL_OK;
}
