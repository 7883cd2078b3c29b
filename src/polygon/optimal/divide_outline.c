// SPDX-License-Identifier: MIT
//
// Dispatch of the partition methods over the walks of one outline, and a lower bound that holds for all of them.
//
// The bound: where the floor's angle is 180 degrees or more a chord must end, and a chord has two ends; and n corners
// make n - 2 triangles, of which a polygon of k corners takes k - 2.

#include "polygon/optimal/divide_outline.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "polygon/outline/key_table.h"
#include "polygon/triangulate/delaunay.h"
#include "polygon/triangulate/triangulate.h"

#include <string.h>

// How many open edges start at each corner: as often as the outline passes there.
static tl_result count_passes(tl_arena *arena, const uint32_t *corners, const uint32_t *twins, uint32_t edge_count,
                              uint8_t **passes_out)
{
    uint32_t highest = 0;
    for (uint32_t edge = 0; edge < edge_count; edge++) {
        highest = tl_max_u32(highest, corners[edge]);
    }
    uint8_t *passes = *passes_out = TL_PUSH_ZERO(arena, uint8_t, (uint64_t)highest + 1);
    if (passes == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t edge = 0; edge < edge_count; edge++) {
        uint8_t *at = &passes[corners[edge]];
        *at = twins[edge] != TL_NO_EDGE || *at > 1 ? *at : (uint8_t)(*at + 1);
    }
    return TL_OK;
}

tl_result tl_pair_edges(tl_arena *arena, const uint32_t *corners, uint32_t *twins, uint32_t edge_count,
                        uint32_t *pair_count)
{
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    uint8_t *passes;
    TL_TRY(count_passes(arena, corners, twins, edge_count, &passes));
    // Of a bridge at least one end is passed twice, the other may be a tip. Few edges are left, so the table is small.
    uint32_t *bridges = TL_PUSH(arena, uint32_t, edge_count);
    tl_key_table table;
    uint32_t bridge_count = 0;
    for (uint32_t edge = 0; edge < edge_count && bridges != NULL; edge++) {
        if (twins[edge] == TL_NO_EDGE &&
            (passes[corners[edge]] > 1 || passes[corners[tl_triangle_edge_next(edge)]] > 1)) {
            bridges[bridge_count++] = edge;
        }
    }
    if (bridges == NULL || !tl_key_table_init(&table, arena, bridge_count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < bridge_count; i++) {
        if (TL_KEYS_AHEAD < bridge_count - i) {
            const uint32_t later = bridges[i + TL_KEYS_AHEAD];
            const uint32_t from = corners[later], to = corners[tl_triangle_edge_next(later)];
            tl_key_table_fetch(&table, tl_pair_key(to, from));
            tl_key_table_fetch(&table, tl_pair_key(from, to));
        }
        const uint32_t edge = bridges[i], from = corners[edge], to = corners[tl_triangle_edge_next(edge)];
        uint32_t *back = tl_key_table_at(&table, tl_pair_key(to, from));
        if (*back != TL_NO_VALUE) {
            twins[edge] = *back;
            twins[*back] = edge;
            ++*pair_count;
        } else {
            *tl_key_table_at(&table, tl_pair_key(from, to)) = edge;
        }
    }
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

// Triangulates all walks of an outline; by place where the order of the cuts is not needed.
static tl_result triangulate_walks(tl_arena *arena, const tl_outline *outline, const tl_step_tracer *tracer,
                                   bool by_place, tl_outline_triangles *triangles)
{
    const uint32_t corners = outline->walk_first[outline->walk_count];
    triangles->corners = TL_PUSH(arena, uint32_t, 3 * corners);
    triangles->twins = TL_PUSH(arena, uint32_t, 3 * corners);
    triangles->places = by_place ? TL_PUSH(arena, uint32_t, corners) : NULL;
    triangles->bridge_count = 0;
    if (triangles->corners == NULL || triangles->twins == NULL || (by_place && triangles->places == NULL)) {
        return TL_ERR_MEMORY;
    }
    uint32_t made = 0;
    for (uint32_t w = 0; w < outline->walk_count; w++) {
        const uint32_t *walk = outline->corners + outline->walk_first[w];
        uint32_t count = outline->walk_first[w + 1] - outline->walk_first[w];
        const tl_lattice_point *points = outline->nodes.points;
        if (!outline->is_plain) {
            tl_lattice_point *copy = TL_PUSH(arena, tl_lattice_point, count);
            if (copy == NULL) {
                return TL_ERR_MEMORY;
            }
            for (uint32_t i = 0; i < count; i++) {
                copy[i] = outline->nodes.points[walk[i]];
            }
            points = copy;
        }
        const tl_outline_sweep *sweep = outline->sweep.place_count > 0 ? &outline->sweep : NULL;
        uint32_t *places = by_place ? triangles->places + made : NULL;
        const tl_triangulate_input input = { points, count, sweep, tracer, TL_EARS_BY_SIZE, places };
        TL_TRY(tl_triangulate(arena, &input, triangles->corners + 3 * made, triangles->twins + 3 * made));
        for (uint32_t i = 3 * made; i < 3 * (made + count - 2) && !outline->is_plain; i++) {
            triangles->corners[i] = walk[triangles->corners[i]];
            triangles->twins[i] += triangles->twins[i] != TL_NO_EDGE ? 3 * made : 0;
        }
        for (uint32_t t = 0; t < count - 2 && by_place && made > 0; t++) {
            places[t] += made;
        }
        made += count - 2;
    }
    triangles->count = made;
    return TL_OK;
}

// Corners that need a chord: angles of 180 degrees or more, between edges that have floor on one side only.
static tl_result count_notches(tl_arena *arena, const tl_outline *outline, const tl_outline_triangles *triangles,
                               uint32_t *count_out)
{
    const tl_lattice_point *points = outline->nodes.points;
    // Bridges end in nodes that are passed more than once.
    uint8_t *passes = NULL;
    if (triangles->bridge_count > 0) {
        passes = TL_PUSH_ZERO(arena, uint8_t, outline->nodes.count);
        if (passes == NULL) {
            return TL_ERR_MEMORY;
        }
        for (uint32_t k = 0; k < outline->walk_first[outline->walk_count]; k++) {
            uint8_t *at = &passes[outline->corners[k]];
            *at = *at == 0 ? 1 : 2;
        }
    }
    uint32_t count = 0;
    for (uint32_t w = 0; w < outline->walk_count; w++) {
        uint32_t first = outline->walk_first[w], end = outline->walk_first[w + 1];
        for (uint32_t k = first; k < end; k++) {
            uint32_t a = outline->corners[k > first ? k - 1 : end - 1];
            uint32_t b = outline->corners[k];
            uint32_t c = outline->corners[k + 1 < end ? k + 1 : first];
            bool stands_alone = passes == NULL || passes[b] == 1;
            count += stands_alone && tl_turn(points[a], points[b], points[c]) <= 0;
        }
    }
    *count_out = count;
    return TL_OK;
}

static tl_result bound_from_below(tl_arena *arena, const tl_outline *outline, const tl_outline_triangles *triangles,
                                  uint32_t max_corners, uint32_t *bound_out)
{
    uint32_t notches;
    TL_TRY(count_notches(arena, outline, triangles, &notches));
    // Taking all chords and bridges away leaves what hangs together; each walk is cut off by one chord more, and a
    // bridge that stays joins up around its hole without cutting anything off.
    uint32_t cuts = notches / 2 + notches % 2 + outline->walk_count;
    uint32_t by_notches = cuts > triangles->bridge_count ? cuts - triangles->bridge_count : 1;
    uint32_t by_corners = max_corners != 0 ? (triangles->count + max_corners - 3) / (max_corners - 2) : 1;
    *bound_out = by_notches > by_corners ? by_notches : by_corners;
    return TL_OK;
}

// A strictly convex outline that is small enough is one polygon by every method; of levels' contours every other one
// is.
static bool is_one_polygon(const tl_outline *outline, uint32_t max_corners)
{
    const tl_lattice_point *points = outline->nodes.points;
    const uint32_t count = outline->nodes.count;
    bool is_convex = outline->is_plain && (max_corners == 0 || count <= max_corners);
    for (uint32_t i = 0; i < count && is_convex; i++) {
        const uint32_t before = i > 0 ? i - 1 : count - 1, after = i + 1 < count ? i + 1 : 0;
        is_convex = tl_turn(points[before], points[i], points[after]) > 0;
    }
    return is_convex;
}

static tl_result keep_whole(tl_arena *arena, const tl_outline *outline, tl_division *division)
{
    tl_convex_parts *parts = &division->parts;
    parts->count = 1;
    parts->first = TL_PUSH(arena, uint32_t, 2);
    parts->corners = outline->corners;
    parts->part_of = NULL;
    if (parts->first == NULL) {
        return TL_ERR_MEMORY;
    }
    parts->first[0] = 0;
    parts->first[1] = outline->nodes.count;
    division->triangle_count = outline->nodes.count - 2;
    division->lower_bound = 1;
    return TL_OK;
}

tl_result tl_divide_outline(tl_arena *arena, const tl_outline *outline, tl_partition_method method,
                            uint32_t max_corners, const tl_step_tracer *tracer, tl_division *division_out)
{
    const bool is_one = is_one_polygon(outline, max_corners);
    if (is_one && tracer == NULL) {
        return keep_whole(arena, outline, division_out);
    }
    tl_outline_triangles triangles;
    const bool by_place = method == TL_PARTITION_CLASSIC && tracer == NULL;
    TL_TRY(triangulate_walks(arena, outline, tracer, by_place, &triangles));
    division_out->triangle_count = triangles.count;
    bool is_exact = false;
    if (method == TL_PARTITION_OPTIMAL) {
        TL_TRY(tl_divide_optimally(arena, outline, max_corners, &triangles, &division_out->parts, &is_exact));
    } else {
        // Bridges run there and back: their two sides are partition edges like others.
        if (!outline->is_plain) {
            TL_TRY(
                tl_pair_edges(arena, triangles.corners, triangles.twins, 3 * triangles.count, &triangles.bridge_count));
        }
        if (method == TL_PARTITION_DELAUNAY) {
            TL_TRY(tl_make_delaunay(arena, outline->nodes.points, triangles.corners, triangles.twins, triangles.count));
        }
        const tl_merge_input input = {
            outline->nodes.points, triangles.corners, triangles.twins, triangles.count, max_corners, NULL, tracer,
            triangles.places
        };
        TL_TRY(tl_merge_triangles(arena, &input, &division_out->parts));
    }
    if (is_one) { // it was divided for those who watch
        return keep_whole(arena, outline, division_out);
    }
    if (is_exact) {
        division_out->lower_bound = division_out->parts.count;
        return TL_OK;
    }
    return bound_from_below(arena, outline, &triangles, max_corners, &division_out->lower_bound);
}
