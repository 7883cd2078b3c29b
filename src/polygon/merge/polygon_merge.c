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

// Fewer than 2^31 slots: MAX_CONTOUR_VERTICES.
#define ROOT 0x80000000u

enum { TRIANGLES_AHEAD = 12, EDGES_AHEAD = 12, PARTS_AHEAD = 16 };

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
} merge_edge;

typedef struct merge_part {
    uint32_t parent; // union-find; or of a root, which stands for its polygon: ROOT and how many of its edges wait
    uint32_t place;
    uint32_t size; // corners
    uint32_t any_edge;
} merge_part;

// A triangle in one cache line: edge k of triangle t is slot 4t + k, and slot 4t + 3 is its part, named by that number.
typedef union merge_slot {
    merge_edge edge;
    merge_part part;
} merge_slot;

typedef struct polygon_merger {
    const tl_merge_input *input;
    const tl_lattice_point *points;
    merge_slot *slots;
    uint32_t *at_place; // [place] root
    uint32_t place_count;
    waiting_edge *heap; // edges of the current length, where there are several
    uint32_t heap_count;
    uint32_t *heap_place; // [edge], or NOT_WAITING; NULL as long as no two had the same length
} polygon_merger;

static uint32_t polygon_of(polygon_merger *m, uint32_t edge)
{
    merge_slot *slots = m->slots;
    uint32_t t = edge | 3;
    while (slots[t].part.parent < ROOT) {
        const uint32_t parent = slots[t].part.parent, above = slots[parent].part.parent;
        if (above >= ROOT) {
            return parent;
        }
        slots[t].part.parent = above;
        t = above;
    }
    return t;
}

// The pair of places of an edge as one number: low place first.
static uint64_t place_pair(polygon_merger *m, uint32_t edge)
{
    uint64_t a = m->slots[polygon_of(m, edge)].part.place;
    uint64_t b = m->slots[polygon_of(m, m->slots[edge].edge.twin)].part.place;
    return a < b ? a << 32 | b : b << 32 | a;
}

#define TL_HEAP(name)                    waiting_heap_##name
#define TL_HEAP_ITEM                     waiting_edge
#define TL_HEAP_CONTEXT                  polygon_merger *
#define TL_HEAP_BEFORE(context, a, b)    ((a).pair < (b).pair)
#define TL_HEAP_MOVED(context, item, at) ((context)->heap_place[(item).edge] = (at))
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

// One edge more or less of two polygons waits.
static void add_waiting(polygon_merger *m, uint32_t edge, uint32_t more)
{
    m->slots[polygon_of(m, edge)].part.parent += more;
    m->slots[polygon_of(m, m->slots[edge].edge.twin)].part.parent += more;
}

static uint32_t pop_edge(polygon_merger *m)
{
    uint32_t top = waiting_heap_pop(m->heap, &m->heap_count, m).edge;
    m->heap_place[top] = NOT_WAITING;
    add_waiting(m, top, UINT32_MAX);
    return top;
}

// A polygon's place has become lower: its waiting edges move up, one after another, each by its pair of places as
// known so far, so that the heap is in order before each step. Where there are many, the whole heap is ordered again.
static void place_changed(polygon_merger *m, uint32_t root)
{
    if (m->slots[root].part.parent == ROOT) {
        return;
    }
    if (m->slots[root].part.size > m->heap_count) {
        heapify(m);
        return;
    }
    uint32_t start = m->slots[root].part.any_edge;
    uint32_t edge = start;
    do {
        const merge_edge *e = &m->slots[edge].edge;
        if (e->twin != TL_NO_EDGE) {
            const uint32_t key = m->heap_place[edge] != NOT_WAITING ? edge : e->twin, i = m->heap_place[key];
            if (i != NOT_WAITING) {
                m->heap[i].pair = place_pair(m, key);
                waiting_heap_sift_up(m->heap, i, m->heap[i], m);
            }
        }
        edge = e->next;
    } while (edge != start);
}

// Whether the corner where `edge` starts stays convex without it: from before the edge to after its twin.
static int stays_convex(const polygon_merger *m, uint32_t edge)
{
    const merge_edge *e = &m->slots[edge].edge,
                     *after = &m->slots[m->slots[m->slots[e->twin].edge.next].edge.next].edge;
    return tl_turn(m->points[m->slots[e->previous].edge.origin], m->points[e->origin], m->points[after->origin]) > 0;
}

// Whether the polygons of an edge, which are handed out, can be merged.
static bool can_merge_across(polygon_merger *m, uint32_t edge, uint32_t roots[2])
{
    uint32_t twin = m->slots[edge].edge.twin;
    uint32_t a = roots[0] = polygon_of(m, edge);
    uint32_t b = roots[1] = polygon_of(m, twin);
    uint32_t most = m->input->max_corners;
    return a != b && (most == 0 || m->slots[a].part.size + m->slots[b].part.size - 2 <= most) &&
           (stays_convex(m, edge) & stays_convex(m, twin)) != 0;
}

static void remove_shared_edge(polygon_merger *m, uint32_t edge, const uint32_t roots[2])
{
    const merge_edge e = m->slots[edge].edge, twin = m->slots[e.twin].edge;
    const uint32_t a = roots[0], b = roots[1];
    const uint32_t size = m->slots[a].part.size + m->slots[b].part.size - 2;
    m->slots[e.previous].edge.next = twin.next;
    m->slots[twin.next].edge.previous = e.previous;
    m->slots[twin.previous].edge.next = e.next;
    m->slots[e.next].edge.previous = twin.previous;
    // The larger polygon's root stays, so that roots are found in O(log n).
    uint32_t low = m->slots[a].part.place < m->slots[b].part.place ? m->slots[a].part.place : m->slots[b].part.place;
    uint32_t free_place = m->slots[a].part.place ^ m->slots[b].part.place ^ low;
    uint32_t root = m->slots[a].part.size >= m->slots[b].part.size ? a : b;
    const uint32_t rest = root == a ? b : a, waiting = m->slots[rest].part.parent - ROOT;
    m->slots[root].part.parent += waiting;
    m->slots[rest].part.parent = root;
    m->slots[root].part.any_edge = e.next;
    m->slots[root].part.size = size;
    m->slots[root].part.place = low;
    m->at_place[low] = root;
    uint32_t last = m->at_place[--m->place_count];
    if (EDGES_AHEAD < m->place_count) {
        tl_prefetch(&m->slots[m->at_place[m->place_count - EDGES_AHEAD]]);
    }
    if (free_place != m->place_count) {
        m->slots[last].part.place = free_place;
        m->at_place[free_place] = last;
        place_changed(m, last);
    }
    place_changed(m, root);
}

static bool start_merge(polygon_merger *m, tl_arena *scratch)
{
    const tl_merge_input *input = m->input;
    m->slots = TL_PUSH(scratch, merge_slot, 4 * (uint64_t)input->triangle_count);
    m->at_place = TL_PUSH(scratch, uint32_t, input->triangle_count);
    if (m->slots == NULL || m->at_place == NULL) {
        return false;
    }
    for (uint32_t t = 0; t < input->triangle_count; t++) {
        if (input->places != NULL && PARTS_AHEAD < input->triangle_count - t) {
            tl_prefetch(&m->at_place[input->places[t + PARTS_AHEAD]]);
        }
        merge_slot *slots = &m->slots[4 * t];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t twin = input->twins[3 * t + k];
            const merge_edge e = { input->corners[3 * t + k], twin != TL_NO_EDGE ? twin + twin / 3 : TL_NO_EDGE,
                                   4 * t + (k + 1) % 3, 4 * t + (k + 2) % 3 };
            slots[k].edge = e;
        }
        const merge_part part = { ROOT, input->places != NULL ? input->places[t] : t, 3, 4 * t };
        slots[3].part = part;
        m->at_place[part.place] = 4 * t + 3;
    }
    m->place_count = input->triangle_count;
    return true;
}

// Edges that could go if they went first, longest first; each pair of twins once, from the side of the lower place.
static tl_result sort_edges(polygon_merger *m, tl_arena *arena, tl_sort_item **items_out, uint32_t *count_out)
{
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, 3 * (uint64_t)m->input->triangle_count);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_lattice_point *points = m->points;
    const uint8_t *joined_first = m->input->joined_first;
    uint32_t count = 0;
    for (uint32_t t = 0; t < m->input->triangle_count; t++) {
        if (TRIANGLES_AHEAD < m->input->triangle_count - t) { // its neighbours may be anywhere
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t later = m->slots[4 * (t + TRIANGLES_AHEAD) + k].edge.twin;
                tl_prefetch(&m->slots[later != TL_NO_EDGE ? later : 0]);
            }
        }
        for (uint32_t edge = 4 * t; edge < 4 * t + 3; edge++) {
            const merge_edge *e = &m->slots[edge].edge;
            if (e->twin == TL_NO_EDGE || m->slots[edge | 3].part.place > m->slots[e->twin | 3].part.place) {
                continue;
            }
            // The triangles (a, b, c) and (b, a, d).
            const merge_edge *twin = &m->slots[e->twin].edge;
            const tl_lattice_point a = points[e->origin], b = points[twin->origin];
            const tl_lattice_point c = points[m->slots[e->previous].edge.origin],
                                   d = points[m->slots[twin->previous].edge.origin];
            if ((int)(tl_turn(c, a, d) > 0) & (int)(tl_turn(d, b, c) > 0)) {
                const bool goes_first = joined_first != NULL && joined_first[edge - t];
                const tl_sort_item item = { goes_first ? 0 : ~(uint64_t)tl_distance2(a, b), edge, 0 };
                items[count++] = item;
            }
        }
    }
    // Each pair of twins takes two of the edges, so the rest of items is scratch enough.
    tl_radix_sort(items, items + count, count);
    *items_out = items;
    *count_out = count;
    return TL_OK;
}

static uint32_t write_part_corners(const polygon_merger *m, uint32_t root, uint32_t *corners)
{
    uint32_t begin = m->slots[root].part.any_edge;
    uint32_t edge = begin;
    uint32_t count = 0;
    do {
        corners[count++] = m->slots[edge].edge.origin;
        edge = m->slots[edge].edge.next;
    } while (edge != begin);
    return count;
}

// Removes an edge and hands out the merge, with the edges that could have gone instead.
static tl_result remove_and_trace(polygon_merger *m, tl_arena *arena, uint32_t edge, const uint32_t roots[2])
{
    uint32_t edge_count = 4 * m->input->triangle_count;
    tl_arena_mark mark = tl_arena_get_mark(arena);
    uint32_t *partitions = TL_PUSH(arena, uint32_t, edge_count);
    uint32_t *corners = TL_PUSH(arena, uint32_t, edge_count);
    if (partitions == NULL || corners == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_traced_step step = { TL_POLYGON_STEP_MERGE, partitions, 1, NULL, 0, corners, 0 };
    partitions[0] = m->slots[edge].edge.origin;
    partitions[1] = m->slots[m->slots[edge].edge.twin].edge.origin;
    for (uint32_t other = 0; other < edge_count; other++) {
        uint32_t twin = (other & 3) < 3 ? m->slots[other].edge.twin : TL_NO_EDGE, beside[2];
        if (twin != TL_NO_EDGE && other < twin && other != edge && can_merge_across(m, other, beside)) {
            partitions[2 * step.partition_count] = m->slots[other].edge.origin;
            partitions[2 * step.partition_count++ + 1] = m->slots[twin].edge.origin;
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
        if (PARTS_AHEAD < m->place_count - p) {
            tl_prefetch(&m->slots[m->at_place[p + PARTS_AHEAD]]);
        }
        if (PARTS_AHEAD / 2 < m->place_count - p) {
            tl_prefetch(&m->slots[m->slots[m->at_place[p + PARTS_AHEAD / 2]].part.any_edge]);
            const uint32_t edge = m->slots[m->at_place[p + PARTS_AHEAD / 4]].part.any_edge;
            tl_prefetch(&m->slots[m->slots[edge].edge.next]);
            tl_prefetch(&m->slots[m->slots[edge].edge.previous]);
        }
        parts->first[p] = filled;
        filled += write_part_corners(m, m->at_place[p], parts->corners + filled);
    }
    parts->first[m->place_count] = filled;
    for (uint32_t t = 0; parts->part_of != NULL && t < m->input->triangle_count; t++) {
        parts->part_of[t] = m->slots[polygon_of(m, 4 * t)].part.place;
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

// The points that tell whether a corner stays convex.
static TL_ALWAYS_INLINE void fetch_corners_beside(const polygon_merger *m, uint32_t edge)
{
    const merge_edge *e = &m->slots[edge].edge;
    tl_prefetch(&m->points[m->slots[e->previous].edge.origin]);
    tl_prefetch(&m->points[m->slots[m->slots[e->next].edge.next].edge.origin]);
}

// Edges come by length, so from anywhere: what they need is fetched before their turn.
static TL_ALWAYS_INLINE void fetch_edges_ahead(const polygon_merger *m, const tl_sort_item *items, uint32_t at,
                                               uint32_t count)
{
    if (2 * EDGES_AHEAD < count - at) {
        tl_prefetch(&m->slots[items[at + 2 * EDGES_AHEAD].value]);
    }
    if (EDGES_AHEAD < count - at) {
        const merge_edge *e = &m->slots[items[at + EDGES_AHEAD].value].edge;
        tl_prefetch(&m->slots[e->twin]);
        tl_prefetch(&m->slots[e->next]);
        tl_prefetch(&m->slots[e->previous]);
        tl_prefetch(&m->points[e->origin]);
    }
    if (EDGES_AHEAD / 2 < count - at) {
        const uint32_t edge = items[at + EDGES_AHEAD / 2].value, twin = m->slots[edge].edge.twin;
        const uint32_t parents[2] = { m->slots[edge | 3].part.parent, m->slots[twin | 3].part.parent };
        tl_prefetch(&m->slots[parents[0] < ROOT ? parents[0] : edge]);
        tl_prefetch(&m->slots[parents[1] < ROOT ? parents[1] : twin]);
        tl_prefetch(&m->slots[m->slots[twin].edge.next]);
        tl_prefetch(&m->slots[m->slots[twin].edge.previous]);
    }
    if (EDGES_AHEAD / 4 < count - at) {
        fetch_corners_beside(m, items[at + EDGES_AHEAD / 4].value);
        fetch_corners_beside(m, m->slots[items[at + EDGES_AHEAD / 4].value].edge.twin);
    }
}

static tl_result merge_across(polygon_merger *m, tl_arena *scratch, uint32_t edge)
{
    uint32_t roots[2];
    if (!can_merge_across(m, edge, roots)) {
        return TL_OK;
    }
    if (m->input->tracer != NULL) {
        return remove_and_trace(m, scratch, edge, roots);
    }
    remove_shared_edge(m, edge, roots);
    return TL_OK;
}

// Edges of one length.
static tl_result merge_across_equal(polygon_merger *m, tl_arena *scratch, const tl_sort_item *items, uint32_t count)
{
    if (m->heap_place == NULL) {
        const uint64_t edge_count = 4 * (uint64_t)m->input->triangle_count;
        m->heap_place = TL_PUSH(scratch, uint32_t, edge_count);
        if (m->heap_place == NULL) {
            return TL_ERR_MEMORY;
        }
        memset(m->heap_place, 0xff, (size_t)edge_count * sizeof *m->heap_place);
    }
    for (uint32_t i = 0; i < count; i++) {
        m->heap[i] = (waiting_edge){ 0, items[i].value };
        m->heap_place[items[i].value] = i;
        add_waiting(m, items[i].value, 1);
    }
    m->heap_count = count;
    heapify(m);
    while (m->heap_count > 0) {
        TL_TRY(merge_across(m, scratch, pop_edge(m)));
    }
    return TL_OK;
}

static tl_result merge(polygon_merger *m, tl_arena *scratch)
{
    tl_sort_item *items;
    uint32_t count;
    TL_TRY(sort_edges(m, scratch, &items, &count));
    m->heap = TL_PUSH(scratch, waiting_edge, count);
    if (m->heap == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t low = 0; low < count;) {
        uint32_t high = low;
        do {
            fetch_edges_ahead(m, items, high, count);
            high++;
        } while (high < count && items[high].key == items[low].key);
        TL_TRY(high - low == 1 ? merge_across(m, scratch, items[low].value)
                               : merge_across_equal(m, scratch, items + low, high - low));
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
