// SPDX-License-Identifier: MIT
//
// Merging into convex polygons: always the two with the longest shared edge, while the result stays convex (Hertel,
// Mehlhorn 1983, with an order).
// Source: "Convex Polygon Generation", Critterai Navigation Mesh Generation documentation, section Merge into Convex
// Polygons.
//
// Polygons of triangles that share an edge share one partition edge, and to merge them is to take that edge away.
// Angles and corner counts only grow, so an edge that cannot go now cannot go later: one pass over the edges by falling
// length does what the plain form, O(n^3), finds by searching all pairs again after each merge.
//
// Among edges of equal length the lowest pair of places goes first. A merged polygon keeps the lower place and
// the last polygon moves into the free one, so places change, and within one length the edges wait in a heap whose
// entries move up when a place changes. That order is arbitrary, but it is the one that users of Recast know.

#include "polygon/merge/polygon_merge.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/radix_sort.h"
#include "polygon/triangulate/triangulate.h"

#include <string.h>

#define NOT_WAITING UINT32_MAX

enum { EDGES_AHEAD = 12 };

// An edge and the places of its two polygons, the lower one in the high bits.
typedef struct waiting_edge {
    uint64_t pair;
    uint32_t edge;
} waiting_edge;

// All of an edge, and all of a polygon, side by side: edges come by length, from anywhere.
typedef struct merge_edge {
    uint32_t origin; // corner where it starts
    uint32_t twin;
    uint32_t next, previous; // around the polygon
    uint32_t heap_place;     // or NOT_WAITING
} merge_edge;

typedef struct merge_part {
    uint32_t parent; // union-find; a root stands for its polygon, and the rest is the root's
    uint32_t place;
    uint32_t size; // corners
    uint32_t any_edge;
} merge_part;

typedef struct polygon_merger {
    const tl_merge_input *input;
    const tl_lattice_point *points;
    merge_edge *edges;
    merge_part *parts;  // [triangle]
    uint32_t *at_place; // [place] root
    uint32_t place_count;
    waiting_edge *heap; // edges of the current length
    uint32_t heap_count;
} polygon_merger;

static uint32_t polygon_of(polygon_merger *m, uint32_t edge)
{
    uint32_t t = edge / 3;
    while (m->parts[t].parent != t) {
        m->parts[t].parent = m->parts[m->parts[t].parent].parent;
        t = m->parts[t].parent;
    }
    return t;
}

// The pair of places of an edge as one number: low place first.
static uint64_t place_pair(polygon_merger *m, uint32_t edge)
{
    uint64_t a = m->parts[polygon_of(m, edge)].place;
    uint64_t b = m->parts[polygon_of(m, m->edges[edge].twin)].place;
    return a < b ? a << 32 | b : b << 32 | a;
}

#define TL_HEAP(name)                    waiting_heap_##name
#define TL_HEAP_ITEM                     waiting_edge
#define TL_HEAP_CONTEXT                  polygon_merger *
#define TL_HEAP_BEFORE(context, a, b)    ((a).pair < (b).pair)
#define TL_HEAP_MOVED(context, item, at) ((context)->edges[(item).edge].heap_place = (at))
#include "base/heap.inl"

static void heapify(polygon_merger *m)
{
    for (uint32_t i = 0; i < m->heap_count; i++) {
        m->heap[i].pair = place_pair(m, m->heap[i].edge);
    }
    for (uint32_t i = m->heap_count / 2; i-- > 0;) {
        waiting_heap_sift_down(m->heap, m->heap_count, i, m->heap[i], m);
    }
}

static uint32_t pop_edge(polygon_merger *m)
{
    uint32_t top = waiting_heap_pop(m->heap, &m->heap_count, m).edge;
    m->edges[top].heap_place = NOT_WAITING;
    return top;
}

// A polygon's place has become lower: its waiting edges move up, one after another, each by its pair of places as
// known so far, so that the heap is in order before each step. Where there are many, the whole heap is ordered again.
static void place_changed(polygon_merger *m, uint32_t root)
{
    if (m->heap_count == 0) {
        return;
    }
    if (m->parts[root].size > m->heap_count) {
        heapify(m);
        return;
    }
    uint32_t start = m->parts[root].any_edge;
    uint32_t edge = start;
    do {
        uint32_t twin = m->edges[edge].twin;
        uint32_t key = twin == TL_NO_EDGE || edge < twin ? edge : twin;
        uint32_t i = m->edges[key].heap_place;
        if (i != NOT_WAITING) {
            m->heap[i].pair = place_pair(m, key);
            waiting_heap_sift_up(m->heap, i, m->heap[i], m);
        }
        edge = m->edges[edge].next;
    } while (edge != start);
}

// Whether the corner where `edge` starts stays convex without it: from before the edge to after its twin.
static int stays_convex(const polygon_merger *m, uint32_t edge)
{
    const merge_edge *e = &m->edges[edge], *after = &m->edges[m->edges[m->edges[e->twin].next].next];
    return tl_turn(m->points[m->edges[e->previous].origin], m->points[e->origin], m->points[after->origin]) > 0;
}

// Whether the polygons of an edge, which are handed out, can be merged.
static bool can_merge_across(polygon_merger *m, uint32_t edge, uint32_t roots[2])
{
    uint32_t twin = m->edges[edge].twin;
    uint32_t a = roots[0] = polygon_of(m, edge);
    uint32_t b = roots[1] = polygon_of(m, twin);
    uint32_t most = m->input->max_corners;
    return a != b && (most == 0 || m->parts[a].size + m->parts[b].size - 2 <= most) &&
           (stays_convex(m, edge) & stays_convex(m, twin)) != 0;
}

static void remove_shared_edge(polygon_merger *m, uint32_t edge, const uint32_t roots[2])
{
    const merge_edge e = m->edges[edge], twin = m->edges[e.twin];
    const uint32_t a = roots[0], b = roots[1];
    const uint32_t size = m->parts[a].size + m->parts[b].size - 2;
    m->edges[e.previous].next = twin.next;
    m->edges[twin.next].previous = e.previous;
    m->edges[twin.previous].next = e.next;
    m->edges[e.next].previous = twin.previous;
    // The larger polygon's root stays, so that roots are found in O(log n).
    uint32_t low = m->parts[a].place < m->parts[b].place ? m->parts[a].place : m->parts[b].place;
    uint32_t free_place = m->parts[a].place ^ m->parts[b].place ^ low;
    uint32_t root = m->parts[a].size >= m->parts[b].size ? a : b;
    m->parts[root == a ? b : a].parent = root;
    m->parts[root].any_edge = e.next;
    m->parts[root].size = size;
    m->parts[root].place = low;
    m->at_place[low] = root;
    uint32_t last = m->at_place[--m->place_count];
    if (free_place != m->place_count) {
        m->parts[last].place = free_place;
        m->at_place[free_place] = last;
        place_changed(m, last);
    }
    place_changed(m, root);
}

static bool start_merge(polygon_merger *m, tl_arena *scratch)
{
    const tl_merge_input *input = m->input;
    m->edges = TL_PUSH(scratch, merge_edge, 3 * (uint64_t)input->triangle_count);
    m->parts = TL_PUSH(scratch, merge_part, input->triangle_count);
    m->at_place = TL_PUSH(scratch, uint32_t, input->triangle_count);
    if (m->edges == NULL || m->parts == NULL || m->at_place == NULL) {
        return false;
    }
    for (uint32_t t = 0; t < input->triangle_count; t++) {
        const merge_part part = { t, t, 3, 3 * t };
        m->parts[t] = part;
        m->at_place[t] = t;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t edge = 3 * t + k;
            const merge_edge e = { input->corners[edge], input->twins[edge], 3 * t + (k + 1) % 3, 3 * t + (k + 2) % 3,
                                   NOT_WAITING };
            m->edges[edge] = e;
        }
    }
    m->place_count = input->triangle_count;
    return true;
}

// The edge before `edge` in its triangle.
static uint32_t third_edge(uint32_t edge)
{
    return edge % 3 == 0 ? edge + 2 : edge - 1;
}

// Edges that could go if they went first, longest first; each pair of twins once.
static tl_result sort_edges(polygon_merger *m, tl_arena *arena, uint32_t edge_count, tl_sort_item **items_out,
                            uint32_t *count_out)
{
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, edge_count);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint32_t *corners = m->input->corners, *twins = m->input->twins;
    uint32_t count = 0;
    for (uint32_t edge = 0; edge < edge_count; edge++) {
        if (EDGES_AHEAD < edge_count - edge) { // triangles come as they were cut, so their neighbours are anywhere
            const uint32_t later = twins[edge + EDGES_AHEAD];
            tl_prefetch(&corners[later != TL_NO_EDGE ? later : 0]);
            tl_prefetch(&m->points[corners[edge + EDGES_AHEAD]]);
        }
        const uint32_t twin = twins[edge];
        if (twin == TL_NO_EDGE || edge > twin) {
            continue;
        }
        // The triangles (a, b, c) and (b, a, d).
        const tl_lattice_point a = m->points[corners[edge]], b = m->points[corners[twin]];
        const tl_lattice_point c = m->points[corners[third_edge(edge)]], d = m->points[corners[third_edge(twin)]];
        if ((int)(tl_turn(c, a, d) > 0) & (int)(tl_turn(d, b, c) > 0)) {
            bool goes_first = m->input->joined_first != NULL && m->input->joined_first[edge];
            tl_sort_item item = { goes_first ? 0 : ~(uint64_t)tl_distance2(a, b), edge, 0 };
            items[count++] = item;
        }
    }
    // Each pair of twins takes two of edge_count, so the rest of items is scratch enough.
    tl_radix_sort(items, items + count, count);
    *items_out = items;
    *count_out = count;
    return TL_OK;
}

static uint32_t write_part_corners(const polygon_merger *m, uint32_t root, uint32_t *corners)
{
    uint32_t begin = m->parts[root].any_edge;
    uint32_t edge = begin;
    uint32_t count = 0;
    do {
        corners[count++] = m->edges[edge].origin;
        edge = m->edges[edge].next;
    } while (edge != begin);
    return count;
}

// Removes an edge and hands out the merge, with the edges that could have gone instead.
static tl_result remove_and_trace(polygon_merger *m, tl_arena *arena, uint32_t edge, const uint32_t roots[2])
{
    uint32_t edge_count = 3 * m->input->triangle_count;
    tl_arena_mark mark = tl_arena_get_mark(arena);
    uint32_t *partitions = TL_PUSH(arena, uint32_t, edge_count);
    uint32_t *corners = TL_PUSH(arena, uint32_t, edge_count);
    if (partitions == NULL || corners == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_traced_step step = { TL_POLYGON_STEP_MERGE, partitions, 1, NULL, 0, corners, 0 };
    partitions[0] = m->edges[edge].origin;
    partitions[1] = m->edges[m->edges[edge].twin].origin;
    for (uint32_t other = 0; other < edge_count; other++) {
        uint32_t twin = m->edges[other].twin, beside[2];
        if (twin != TL_NO_EDGE && other < twin && other != edge && can_merge_across(m, other, beside)) {
            partitions[2 * step.partition_count] = m->edges[other].origin;
            partitions[2 * step.partition_count++ + 1] = m->edges[twin].origin;
        }
    }
    remove_shared_edge(m, edge, roots);
    step.corner_count = write_part_corners(m, polygon_of(m, edge), corners);
    TL_TRY(tl_trace_step(m->input->tracer, arena, m->points, &step));
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

static void write_merged_parts(polygon_merger *m, tl_convex_parts *parts)
{
    uint32_t filled = 0;
    parts->count = m->place_count;
    for (uint32_t p = 0; p < m->place_count; p++) {
        parts->first[p] = filled;
        filled += write_part_corners(m, m->at_place[p], parts->corners + filled);
    }
    parts->first[m->place_count] = filled;
    for (uint32_t t = 0; parts->part_of != NULL && t < m->input->triangle_count; t++) {
        parts->part_of[t] = m->parts[polygon_of(m, 3 * t)].place;
    }
}

// As large as the parts can become, before anything else: the rest of the memory goes back.
static bool allocate_parts(tl_convex_parts *parts, tl_arena *arena, const tl_merge_input *input)
{
    parts->first = TL_PUSH(arena, uint32_t, (uint64_t)input->triangle_count + 1);
    parts->corners = TL_PUSH(arena, uint32_t, 3 * (uint64_t)input->triangle_count);
    parts->part_of = NULL;
    if (input->joined_first != NULL) {
        parts->part_of = TL_PUSH(arena, uint32_t, input->triangle_count);
    }
    return parts->first != NULL && parts->corners != NULL && (input->joined_first == NULL || parts->part_of != NULL);
}

// Edges come by length, so from anywhere: what they need is fetched before their turn.
static void fetch_edges_ahead(const polygon_merger *m, const tl_sort_item *items, uint32_t at, uint32_t count)
{
    if (2 * EDGES_AHEAD < count - at) {
        const uint32_t edge = items[at + 2 * EDGES_AHEAD].value;
        tl_prefetch(&m->edges[edge]);
        tl_prefetch(&m->parts[edge / 3]);
    }
    if (EDGES_AHEAD < count - at) {
        const merge_edge *e = &m->edges[items[at + EDGES_AHEAD].value];
        tl_prefetch(&m->edges[e->twin]);
        tl_prefetch(&m->parts[e->twin / 3]);
        tl_prefetch(&m->points[e->origin]);
        tl_prefetch(&m->edges[e->previous]);
    }
}

static tl_result merge(polygon_merger *m, tl_arena *scratch)
{
    const uint32_t edge_count = 3 * m->input->triangle_count;
    tl_sort_item *items;
    uint32_t count;
    TL_TRY(sort_edges(m, scratch, edge_count, &items, &count));
    m->heap = TL_PUSH(scratch, waiting_edge, count);
    if (m->heap == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t low = 0; low < count;) {
        uint32_t high = low;
        for (; high < count && items[high].key == items[low].key; high++) {
            fetch_edges_ahead(m, items, high, count);
            m->heap[high - low] = (waiting_edge){ 0, items[high].value };
            m->edges[items[high].value].heap_place = high - low;
        }
        m->heap_count = high - low;
        if (m->heap_count > 1) {
            heapify(m);
        }
        while (m->heap_count > 0) {
            uint32_t edge = pop_edge(m), roots[2];
            if (!can_merge_across(m, edge, roots)) {
                continue;
            }
            if (m->input->tracer == NULL) {
                remove_shared_edge(m, edge, roots);
            } else {
                TL_TRY(remove_and_trace(m, scratch, edge, roots));
            }
        }
        low = high;
    }
    return TL_OK;
}

tl_result tl_merge_triangles(tl_arena *arena, const tl_merge_input *input, tl_convex_parts *parts_out)
{
    polygon_merger m;
    memset(&m, 0, sizeof m);
    m.input = input;
    m.points = input->points;
    if (!allocate_parts(parts_out, arena, input)) {
        return TL_ERR_MEMORY;
    }
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    if (!start_merge(&m, arena)) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(merge(&m, arena));
    write_merged_parts(&m, parts_out);
    tl_arena_rollback(arena, mark);
    return TL_OK;
}
