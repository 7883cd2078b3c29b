// SPDX-License-Identifier: MIT
//
// The closed parts of a mesh: connected components without a border. Directed edges are sorted by their undirected key.
// A group of equal keys connects its triangles (union-find) when as many of them run one way as the other, else none;
// so an open floor does not open the crate that stands on its edge. Then each group is summed part by part: a part is
// closed when all its sums are 0.
//
// A part's volume is that of the tetrahedra between its triangles and one of its corners.
// Sources: the border of a chain, Hatcher, Algebraic Topology, 2002, chapter 2.1; Tarjan, Efficiency of a Good But Not
// Linear Set Union Algorithm, 1975.

#include "base/arena.h"
#include "base/assert.h"
#include "base/disjoint_sets.h"
#include "base/host.h"
#include "base/min_max.h"
#include "base/radix_sort.h"
#include "base/stage.h"
#include "mesh/clean.h"

#include <string.h>

typedef struct parts_search {
    tl_stage *stage;
    const tl_mesh_view *view;
    tl_sort_item *edges; // value: the triangle, extra: 1 when it runs from the lower vertex to the higher
    uint32_t edge_count;
    uint32_t *parent; // [triangle_count] of the union-find; roots have the lowest index
    int32_t *balance; // [triangle_count] of the root at hand
    uint8_t *has_rim; // [triangle_count] of the root
} parts_search;

static tl_result sort_part_edges(parts_search *s, tl_arena *arena)
{
    const tl_mesh_view *view = s->view;
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, 3 * (uint64_t)view->triangle_count);
    s->edges = TL_PUSH(arena, tl_sort_item, 3 * (uint64_t)view->triangle_count);
    if (s->edges == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < 3 * view->triangle_count; i++) {
        TL_TRY(tl_stage_tick(s->stage, i));
        const uint32_t from = view->indices[i], to = view->indices[i - i % 3 + (i + 1) % 3];
        const tl_sort_item item = { (uint64_t)tl_min_u32(from, to) << 32 | tl_max_u32(from, to), i / 3, from < to };
        s->edges[s->edge_count] = item;
        s->edge_count += from != to; // an edge without length runs both ways
    }
    return tl_radix_sort_in_stage(s->edges, scratch, s->edge_count, s->stage);
}

static uint32_t group_end(const parts_search *s, uint32_t begin)
{
    uint32_t end = begin + 1;
    while (end < s->edge_count && s->edges[end].key == s->edges[begin].key) {
        end++;
    }
    return end;
}

static int32_t direction_of(const tl_sort_item *edge)
{
    return edge->extra != 0 ? 1 : -1;
}

static uint32_t part_root(parts_search *s, uint32_t triangle)
{
    return tl_disjoint_sets_find(s->parent, triangle);
}

// Calls progress each TL_STAGE_STEP edges of a walk over groups, which end anywhere.
static tl_result tick_edges(parts_search *s, uint32_t begin, uint32_t *ticked)
{
    if (begin - *ticked < TL_STAGE_STEP) {
        return TL_OK;
    }
    *ticked = begin;
    return tl_stage_add(s->stage, TL_STAGE_STEP / 2);
}

static tl_result join_groups(parts_search *s)
{
    uint32_t ticked = 0;
    for (uint32_t begin = 0; begin < s->edge_count;) {
        TL_TRY(tick_edges(s, begin, &ticked));
        const uint32_t end = group_end(s, begin);
        int64_t sum = 0;
        for (uint32_t i = begin; i < end; i++) {
            sum += direction_of(&s->edges[i]);
        }
        for (uint32_t i = begin + 1; sum == 0 && i < end; i++) {
            tl_disjoint_sets_unite(s->parent, s->edges[begin].value, s->edges[i].value);
        }
        begin = end;
    }
    return TL_OK;
}

static tl_result find_rims(parts_search *s)
{
    uint32_t ticked = 0;
    for (uint32_t begin = 0; begin < s->edge_count;) {
        TL_TRY(tick_edges(s, begin, &ticked));
        const uint32_t end = group_end(s, begin);
        for (uint32_t i = begin; i < end; i++) {
            s->balance[part_root(s, s->edges[i].value)] += direction_of(&s->edges[i]);
        }
        for (uint32_t i = begin; i < end; i++) {
            const uint32_t root = part_root(s, s->edges[i].value);
            s->has_rim[root] |= s->balance[root] != 0;
        }
        for (uint32_t i = begin; i < end; i++) {
            s->balance[part_root(s, s->edges[i].value)] = 0;
        }
        begin = end;
    }
    return TL_OK;
}

// Numbers the closed roots. A root comes before all others of its part.
static tl_result number_parts(parts_search *s, tl_closed_parts *parts)
{
    for (uint32_t t = 0; t < parts->triangle_count; t++) {
        TL_TRY(tl_stage_tick(s->stage, t));
        const uint32_t root = part_root(s, t);
        parts->part_of[t] = TL_NO_PART;
        if (s->has_rim[root]) {
            parts->open_part_count += root == t;
        } else {
            parts->part_of[t] = root == t ? parts->part_count++ : parts->part_of[root];
        }
    }
    return TL_OK;
}

static double signed_volume(tl_vec3 apex, tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    const double ax = (double)a.x - (double)apex.x, ay = (double)a.y - (double)apex.y,
                 az = (double)a.z - (double)apex.z;
    const double bx = (double)b.x - (double)apex.x, by = (double)b.y - (double)apex.y,
                 bz = (double)b.z - (double)apex.z;
    const double cx = (double)c.x - (double)apex.x, cy = (double)c.y - (double)apex.y,
                 cz = (double)c.z - (double)apex.z;
    return (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6.0;
}

static tl_result measure_parts(parts_search *s, tl_closed_parts *parts)
{
    for (uint32_t t = 0; t < parts->triangle_count; t++) {
        TL_TRY(tl_stage_tick(s->stage, t));
        if (parts->part_of[t] != TL_NO_PART) {
            const uint32_t *corner = s->view->indices + 3 * (size_t)t;
            const tl_vec3 *vertices = s->view->vertices;
            const tl_vec3 apex = vertices[s->view->indices[3 * (size_t)part_root(s, t)]];
            parts->volumes[parts->part_of[t]] +=
                signed_volume(apex, vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]);
        }
    }
    return TL_OK;
}

static tl_result find_closed_parts(const tl_mesh_view *view, tl_arena *arena, tl_stage *stage, tl_closed_parts *parts)
{
    const tl_allocator *allocator = &parts->allocator;
    parts_search s;
    memset(&s, 0, sizeof s);
    s.view = view;
    s.stage = stage;
    const uint32_t count = view->triangle_count;
    TL_TRY(sort_part_edges(&s, arena));
    s.parent = TL_PUSH(arena, uint32_t, count);
    s.balance = TL_PUSH_ZERO(arena, int32_t, count);
    s.has_rim = TL_PUSH_ZERO(arena, uint8_t, count);
    parts->part_of = tl_allocate_array(allocator, count, sizeof *parts->part_of);
    if (s.parent == NULL || s.balance == NULL || s.has_rim == NULL || parts->part_of == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_disjoint_sets_init(s.parent, count);
    TL_TRY(join_groups(&s));
    TL_TRY(find_rims(&s));
    TL_TRY(number_parts(&s, parts));
    parts->volumes = tl_allocate_array(allocator, parts->part_count, sizeof *parts->volumes);
    if (parts->volumes == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(parts->volumes, 0, parts->part_count * sizeof *parts->volumes);
    return measure_parts(&s, parts);
}

tl_result tl_closed_parts_find(const tl_mesh_view *view, const tl_host *host, tl_closed_parts *parts_out,
                               tl_report *report_out)
{
    tl_report_begin(report_out, "closed parts");
    if (parts_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "parts_out", "give where the parts go");
    }
    memset(parts_out, 0, sizeof *parts_out);
    TL_TRY(tl_mesh_view_check(view, report_out));
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    parts_out->allocator = tl_allocator_or_default(allocator);
    parts_out->triangle_count = view->triangle_count;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_stage stage;
    tl_result result = tl_stage_begin(&stage, host, "closed parts", 3 * (uint64_t)view->triangle_count);
    result = result == TL_OK ? find_closed_parts(view, &arena, &stage, parts_out) : result;
    result = result == TL_OK ? tl_stage_end(&stage) : result;
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + parts_out->triangle_count * sizeof *parts_out->part_of +
                                 parts_out->part_count * sizeof *parts_out->volumes;
    }
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_closed_parts_free(parts_out);
    }
    return result;
}

void tl_closed_parts_free(tl_closed_parts *parts)
{
    if (parts != NULL) {
        tl_release_array(&parts->allocator, parts->part_of, parts->triangle_count, sizeof *parts->part_of);
        tl_release_array(&parts->allocator, parts->volumes, parts->part_count, sizeof *parts->volumes);
        memset(parts, 0, sizeof *parts);
    }
}
