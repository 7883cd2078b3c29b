// SPDX-License-Identifier: MIT
//
// A plain contour, which touches itself nowhere, is triangulated as it is. All others (those with bridges to holes too)
// are prepared: vertices at one place become one node, edges are split where they meet, and the faces that the contour
// winds around are traced.

#include "polygon/outline/outline.h"

#include "base/assert.h"
#include "polygon/outline/key_table.h"
#include "polygon/outline/packed_point.h"
#include "polygon/outline/sweep.h"

#include <string.h>

// Beyond this a sweep is faster than testing all pairs of edges.
enum { MAX_PAIRED_VERTICES = 128 };

static int64_t signed_area2(const tl_lattice_point *points, uint32_t count)
{
    // Modulo 2^64: the sum is below 2^63 in the end, though not always on the way.
    uint64_t sum = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        sum += (uint64_t)tl_turn(points[0], points[i], points[i + 1]);
    }
    return (int64_t)sum;
}

// Closed segments whose boxes overlap.
static bool edges_meet(tl_lattice_point a, tl_lattice_point b, tl_lattice_point c, tl_lattice_point d)
{
    int64_t c_side = tl_turn(a, b, c);
    int64_t d_side = tl_turn(a, b, d);
    if ((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0)) {
        return false;
    }
    int64_t a_side = tl_turn(c, d, a);
    int64_t b_side = tl_turn(c, d, b);
    return !((a_side > 0 && b_side > 0) || (a_side < 0 && b_side < 0));
}

// Whether a corner folds back onto the edge it came by, or has an edge of no length.
static bool folds_back(tl_lattice_point before, tl_lattice_point corner, tl_lattice_point after)
{
    return tl_turn(before, corner, after) == 0 && tl_dot2(corner, before, after) >= 0;
}

// O(n^2), and the fastest way for the few dozen vertices that contours have.
static bool is_plain_by_pairs(const tl_lattice_point *points, uint32_t count)
{
    tl_packed_range ranges[MAX_PAIRED_VERTICES];
    for (uint32_t i = 0; i < count; i++) {
        tl_lattice_point a = points[i];
        tl_lattice_point b = points[i + 1 < count ? i + 1 : 0];
        tl_lattice_point after = points[i + 2 < count ? i + 2 : i + 2 - count];
        if (folds_back(a, b, after)) {
            return false;
        }
        ranges[i] = tl_packed_range_of(a, b, b);
    }
    for (uint32_t i = 0; i + 2 < count; i++) {
        const tl_packed_range range = ranges[i];
        // Edges next to each other were tested at their corner.
        uint32_t last = i == 0 ? count - 1 : count;
        for (uint32_t j = i + 2; j < last; j++) {
            if (tl_packed_ranges_meet(&range, &ranges[j]) &&
                edges_meet(points[i], points[i + 1], points[j], points[j + 1 < count ? j + 1 : 0])) {
                return false;
            }
        }
    }
    return true;
}

static tl_result is_plain_by_sweep(tl_arena *arena, const tl_lattice_point *points, uint32_t count,
                                   tl_outline_sweep *sweep, bool *is_plain)
{
    if (!tl_sweep_record_init(&sweep->record, arena, count)) {
        return TL_ERR_MEMORY;
    }
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    TL_TRY(tl_sweep_segments(arena, points, count, NULL, count, &sweep->record, is_plain));
    sweep->place_count = sweep->segment_count = *is_plain ? count : 0;
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

static tl_result is_plain_outline(tl_arena *arena, tl_outline *outline, bool *plain_out)
{
    const tl_lattice_point *points = outline->nodes.points;
    const uint32_t count = outline->nodes.count;
    if (count > MAX_PAIRED_VERTICES) {
        return is_plain_by_sweep(arena, points, count, &outline->sweep, plain_out);
    }
    *plain_out = is_plain_by_pairs(points, count);
    return TL_OK;
}

static bool allocate_nodes(tl_outline_nodes *nodes, tl_arena *arena, uint32_t count)
{
    nodes->points = TL_PUSH(arena, tl_lattice_point, count);
    nodes->heights = TL_PUSH(arena, int32_t, count);
    nodes->is_border = TL_PUSH(arena, uint8_t, count);
    nodes->count = 0;
    nodes->capacity = count;
    return nodes->points != NULL && nodes->heights != NULL && nodes->is_border != NULL;
}

static tl_result keep_as_it_is(tl_arena *arena, tl_outline *outline)
{
    uint32_t count = outline->nodes.count;
    outline->walk_first = TL_PUSH(arena, uint32_t, 2);
    outline->corners = TL_PUSH(arena, uint32_t, count);
    if (outline->walk_first == NULL || outline->corners == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        outline->corners[i] = i;
    }
    outline->walk_first[0] = 0;
    outline->walk_first[1] = count;
    outline->walk_count = 1;
    outline->is_plain = true;
    return TL_OK;
}

tl_result tl_outline_unite_nodes(tl_arena *arena, tl_outline_nodes *nodes, uint32_t *places)
{
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    tl_key_table table;
    if (!tl_key_table_init(&table, arena, nodes->count)) {
        return TL_ERR_MEMORY;
    }
    uint32_t united = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        if (TL_KEYS_AHEAD < nodes->count - i) {
            const tl_lattice_point later = nodes->points[i + TL_KEYS_AHEAD];
            tl_key_table_fetch(&table, tl_pair_key((uint32_t)later.x, (uint32_t)later.z));
        }
        tl_lattice_point p = nodes->points[i];
        uint32_t *place = tl_key_table_at(&table, tl_pair_key((uint32_t)p.x, (uint32_t)p.z));
        if (*place == TL_NO_VALUE) {
            *place = united;
            nodes->points[united] = p;
            nodes->heights[united] = nodes->heights[i];
            nodes->is_border[united] = nodes->is_border[i];
            united++;
        } else {
            nodes->is_border[*place] |= nodes->is_border[i];
        }
        if (places != NULL) {
            places[i] = *place;
        }
    }
    nodes->count = united;
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

static bool on_other_floor(int32_t a, int32_t b, uint32_t merge_height)
{
    int64_t difference = (int64_t)a - b;
    return (difference < 0 ? -difference : difference) > (int64_t)merge_height;
}

static bool has_other_floors(const tl_contour_vertex *vertices, const uint32_t *starts, uint32_t merge_height,
                             const tl_outline *outline)
{
    const uint32_t corner_count = outline->walk_first[outline->walk_count];
    for (uint32_t i = 0; i < corner_count; i++) {
        if (outline->edges[i] != TL_NO_EDGE_OF_CONTOUR &&
            on_other_floor(vertices[starts[outline->edges[i]]].y, outline->nodes.heights[outline->corners[i]],
                           merge_height)) {
            return true;
        }
    }
    return false;
}

// Parts nodes that the contour passes on two floors. starts[e] is the contour's vertex at which its edge e starts.
// There is room: each node after this is another vertex of the contour.
static tl_result part_floors(tl_arena *arena, const tl_contour_vertex *vertices, const uint32_t *starts,
                             uint32_t merge_height, tl_outline *outline)
{
    tl_outline_nodes *nodes = &outline->nodes;
    uint32_t corner_count = outline->walk_first[outline->walk_count];
    uint32_t united = nodes->count;
    uint8_t *is_border = TL_PUSH_ZERO(arena, uint8_t, united);
    uint8_t *is_parted = TL_PUSH_ZERO(arena, uint8_t, united);
    tl_key_table table;
    if (is_border == NULL || is_parted == NULL || !tl_key_table_init(&table, arena, corner_count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < corner_count; i++) {
        if (outline->edges[i] == TL_NO_EDGE_OF_CONTOUR) {
            continue;
        }
        const tl_contour_vertex *vertex = &vertices[starts[outline->edges[i]]];
        uint8_t border = (vertex->flags & TL_CONTOUR_BORDER_VERTEX) != 0;
        uint32_t node = outline->corners[i];
        if (!on_other_floor(vertex->y, nodes->heights[node], merge_height)) {
            is_border[node] |= border;
            continue;
        }
        is_parted[node] = 1;
        uint32_t *place = tl_key_table_at(&table, tl_pair_key(node, (uint32_t)vertex->y));
        if (*place == TL_NO_VALUE) {
            TL_ASSERT(nodes->count < nodes->capacity);
            *place = nodes->count;
            nodes->points[nodes->count] = nodes->points[node];
            nodes->heights[nodes->count] = vertex->y;
            nodes->is_border[nodes->count++] = 0;
        }
        nodes->is_border[*place] |= border;
        outline->corners[i] = *place;
    }
    for (uint32_t node = 0; node < united; node++) {
        nodes->is_border[node] = is_parted[node] ? is_border[node] : nodes->is_border[node];
    }
    return TL_OK;
}

// The sweep over the contour's edges serves its floor where that has one walk, the contour itself.
static void keep_sweep(tl_outline *outline, uint32_t *places, uint32_t count)
{
    const bool is_one = outline->faults == 0 && outline->walk_count == 1 && outline->walk_first[1] == count;
    if (!is_one || memcmp(outline->corners, places, count * sizeof *places) != 0) {
        outline->sweep.place_count = outline->sweep.segment_count = 0;
    }
    outline->sweep.place_of = places;
}

static tl_result take_apart(tl_arena *arena, const tl_contour_vertex *vertices, uint32_t merge_height,
                            tl_outline *outline)
{
    uint32_t count = outline->nodes.count;
    uint32_t *places = TL_PUSH(arena, uint32_t, count);
    uint32_t *starts = TL_PUSH(arena, uint32_t, count);
    tl_outline_edge *edges = TL_PUSH(arena, tl_outline_edge, count);
    if (places == NULL || starts == NULL || edges == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_outline_unite_nodes(arena, &outline->nodes, places));
    uint32_t edge_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_outline_edge edge = { places[i], places[i + 1 < count ? i + 1 : 0] };
        if (edge.from != edge.to) {
            starts[edge_count] = i;
            edges[edge_count++] = edge;
        } else if (outline->faults == 0) {
            outline->faults = TL_CONTOUR_FAULT_DUPLICATE;
            outline->fault_vertex = i;
        }
    }
    uint32_t fault_edge = 0;
    uint32_t faults = 0;
    TL_TRY(
        tl_outline_split_contacts(arena, &outline->nodes, &edges, &edge_count, &faults, &fault_edge, &outline->sweep));
    if (outline->faults == 0) {
        outline->fault_vertex = fault_edge;
    }
    outline->faults |= faults;
    if (outline->faults & TL_CONTOUR_FAULT_REFUSED) {
        return TL_OK;
    }
    TL_TRY(tl_outline_trace_faces(arena, edges, edge_count, outline));
    keep_sweep(outline, places, count);
    // Where edges were split they are no longer the contour's; such a contour is mended on one floor.
    bool is_split = (faults & (TL_CONTOUR_FAULT_TOUCH | TL_CONTOUR_FAULT_CROSSING)) != 0;
    if (is_split || outline->walk_count == 0 || !has_other_floors(vertices, starts, merge_height, outline)) {
        return TL_OK;
    }
    return part_floors(arena, vertices, starts, merge_height, outline);
}

tl_result tl_outline_prepare(tl_arena *arena, const tl_contour_vertex *vertices, uint32_t count, uint32_t merge_height,
                             tl_outline *outline_out)
{
    memset(outline_out, 0, sizeof *outline_out);
    tl_outline_nodes *nodes = &outline_out->nodes;
    if (!allocate_nodes(nodes, arena, count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        nodes->points[i].x = vertices[i].x;
        nodes->points[i].z = vertices[i].z;
        nodes->heights[i] = vertices[i].y;
        nodes->is_border[i] = (vertices[i].flags & TL_CONTOUR_BORDER_VERTEX) != 0;
    }
    nodes->count = count;
    outline_out->area2 = signed_area2(nodes->points, count);
    if (count < 3) {
        outline_out->faults = TL_CONTOUR_FAULT_EMPTY;
        return TL_OK;
    }
    bool plain = false;
    if (outline_out->area2 > 0) {
        TL_TRY(is_plain_outline(arena, outline_out, &plain));
    }
    if (plain) {
        return keep_as_it_is(arena, outline_out);
    }
    TL_TRY(take_apart(arena, vertices, merge_height, outline_out));
    if (outline_out->walk_count == 0 && outline_out->area2 == 0 && !(outline_out->faults & TL_CONTOUR_FAULT_REFUSED)) {
        outline_out->faults |= TL_CONTOUR_FAULT_EMPTY;
    }
    return TL_OK;
}
