// SPDX-License-Identifier: MIT
//
// The faces that a closed walk winds around. Its edges meet only in nodes, so they form a plane graph, which is
// connected since one walk runs along all of them: each face has one outline.
//
// Around each node the edges are sorted by direction; from each edge the next one of the face on its left is the one
// that turns most sharply left. The winding number is 0 outside and changes across an edge by how many times more often
// the walk runs along it forward than backward: 0 across a bridge to a hole. Faces with a winding number of 1 or more
// are the contour's floor.
// Source: winding numbers of arrangements, de Berg et al., Computational Geometry, chapter 2.

#include "polygon/outline/outline.h"

#include "base/assert.h"
#include "polygon/outline/key_table.h"

#include <string.h>

// Half-edge 2e runs as edge e was first run along, 2e + 1 back.
typedef struct graph {
    const tl_lattice_point *points;
    uint32_t node_count;
    uint32_t half_count;
    uint32_t *origin;  // [half_count]
    int32_t *net;      // [half_count / 2] times forward, less times backward
    uint32_t *half_of; // [edge of the walk] the half-edge it runs along
    uint32_t *edge_of; // [half_count] the first edge of the walk that runs along it
    uint32_t *next;    // [half_count] around the face on the left
    uint32_t *face;    // [half_count]
    uint32_t face_count;
    int32_t *winding; // [face_count]
    uint32_t outer;
} graph;

static uint32_t half_twin(uint32_t half)
{
    return half ^ 1u;
}

static tl_result gather_half_edges(graph *g, tl_arena *arena, const tl_outline_edge *edges, uint32_t count)
{
    tl_key_table table;
    g->origin = TL_PUSH(arena, uint32_t, 2 * (uint64_t)count);
    g->net = TL_PUSH_ZERO(arena, int32_t, count);
    g->half_of = TL_PUSH(arena, uint32_t, count);
    g->edge_of = TL_PUSH(arena, uint32_t, 2 * (uint64_t)count);
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    if (g->origin == NULL || g->net == NULL || g->half_of == NULL || g->edge_of == NULL ||
        !tl_key_table_init(&table, arena, count)) {
        return TL_ERR_MEMORY;
    }
    memset(g->edge_of, 0xff, 2 * (size_t)count * sizeof *g->edge_of);
    uint32_t made = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (TL_KEYS_AHEAD < count - i) {
            tl_key_table_fetch(&table, tl_unordered_key(edges[i + TL_KEYS_AHEAD].from, edges[i + TL_KEYS_AHEAD].to));
        }
        uint32_t *place = tl_key_table_at(&table, tl_unordered_key(edges[i].from, edges[i].to));
        if (*place == TL_NO_VALUE) {
            *place = made;
            g->origin[2 * made] = edges[i].from;
            g->origin[2 * made + 1] = edges[i].to;
            made++;
        }
        bool forward = g->origin[2 * *place] == edges[i].from;
        g->half_of[i] = 2 * *place + (forward ? 0 : 1);
        g->net[*place] += forward ? 1 : -1;
        if (g->edge_of[g->half_of[i]] == TL_NO_EDGE_OF_CONTOUR) {
            g->edge_of[g->half_of[i]] = i;
        }
    }
    g->half_count = 2 * made;
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

// Whether direction a comes before b, turning left from +z.
static bool turns_first(const graph *g, uint32_t a, uint32_t b)
{
    tl_lattice_point o = g->points[g->origin[a]];
    tl_lattice_point p = g->points[g->origin[half_twin(a)]];
    tl_lattice_point q = g->points[g->origin[half_twin(b)]];
    bool p_late = !(p.x > o.x || (p.x == o.x && p.z > o.z));
    bool q_late = !(q.x > o.x || (q.x == o.x && q.z > o.z));
    return p_late != q_late ? q_late : tl_turn(o, p, q) > 0;
}

#define TL_HEAP(name)                 direction_heap_##name
#define TL_HEAP_ITEM                  uint32_t
#define TL_HEAP_CONTEXT               const graph *
#define TL_HEAP_BEFORE(context, a, b) turns_first((context), (b), (a))
#include "base/heap.inl"

// Heapsort: no two directions at a node are equal, so stability does not matter, and a fan of bridges may be large.
static void sort_by_direction(const graph *g, uint32_t *halves, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;) {
        direction_heap_sift_down(halves, count, i, halves[i], g);
    }
    for (uint32_t end = count; end-- > 1;) {
        uint32_t largest = halves[0];
        direction_heap_sift_down(halves, end, 0, halves[end], g);
        halves[end] = largest;
    }
}

static tl_result link_faces(graph *g, tl_arena *arena)
{
    uint32_t *first = TL_PUSH_ZERO(arena, uint32_t, (uint64_t)g->node_count + 2);
    uint32_t *around = TL_PUSH(arena, uint32_t, g->half_count);
    g->next = TL_PUSH(arena, uint32_t, g->half_count);
    if (first == NULL || around == NULL || g->next == NULL) {
        return TL_ERR_MEMORY;
    }
    // Counting sort by node; first[] is shifted by one while it is filled.
    for (uint32_t h = 0; h < g->half_count; h++) {
        first[g->origin[h] + 2]++;
    }
    for (uint32_t n = 0; n < g->node_count; n++) {
        first[n + 2] += first[n + 1];
    }
    for (uint32_t h = 0; h < g->half_count; h++) {
        around[first[g->origin[h] + 1]++] = h;
    }
    for (uint32_t n = 0; n < g->node_count; n++) {
        uint32_t *halves = around + first[n];
        uint32_t degree = first[n + 1] - first[n];
        sort_by_direction(g, halves, degree);
        for (uint32_t k = 0; k < degree; k++) {
            // Arriving by the twin of halves[k], the face on the left goes on along the edge to the right of where
            // it came from.
            g->next[half_twin(halves[k])] = halves[k > 0 ? k - 1 : degree - 1];
        }
    }
    return TL_OK;
}

static tl_result number_plane_faces(graph *g, tl_arena *arena)
{
    g->face = TL_PUSH(arena, uint32_t, g->half_count);
    if (g->face == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(g->face, 0xff, g->half_count * sizeof *g->face);
    g->face_count = 0;
    g->outer = UINT32_MAX;
    for (uint32_t start = 0; start < g->half_count; start++) {
        if (g->face[start] != UINT32_MAX) {
            continue;
        }
        // A bounded face has area > 0; only the outer one has not. Modulo 2^64, exact in the end.
        uint64_t area2 = 0;
        tl_lattice_point corner = g->points[g->origin[start]];
        uint32_t h = start;
        do {
            g->face[h] = g->face_count;
            area2 += (uint64_t)tl_turn(corner, g->points[g->origin[h]], g->points[g->origin[half_twin(h)]]);
            h = g->next[h];
        } while (h != start);
        if ((int64_t)area2 <= 0) {
            g->outer = g->face_count;
        }
        g->face_count++;
    }
    return TL_OK;
}

static tl_result count_windings(graph *g, tl_arena *arena)
{
    g->winding = TL_PUSH_ZERO(arena, int32_t, g->face_count);
    uint8_t *known = TL_PUSH_ZERO(arena, uint8_t, g->face_count);
    uint32_t *one_edge = TL_PUSH(arena, uint32_t, g->face_count);
    uint32_t *stack = TL_PUSH(arena, uint32_t, g->face_count);
    if (g->winding == NULL || known == NULL || one_edge == NULL || stack == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t h = 0; h < g->half_count; h++) {
        one_edge[g->face[h]] = h;
    }
    uint32_t depth = 0;
    stack[depth++] = g->outer;
    known[g->outer] = 1;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        uint32_t start = one_edge[face];
        uint32_t h = start;
        do {
            uint32_t beyond = g->face[half_twin(h)];
            if (!known[beyond]) {
                known[beyond] = 1;
                int32_t net = (h & 1) == 0 ? g->net[h / 2] : -g->net[h / 2];
                g->winding[beyond] = g->winding[face] - net;
                stack[depth++] = beyond;
            }
            h = g->next[h];
        } while (h != start);
    }
    return TL_OK;
}

// Appends the face left of `start` as a walk, without runs that go there and straight back again.
static void add_walk(const graph *g, uint32_t start, uint32_t *halves, tl_outline *outline)
{
    uint32_t count = 0;
    uint32_t h = start;
    do {
        if (count > 0 && halves[count - 1] == half_twin(h)) {
            count--;
            outline->faults |= TL_CONTOUR_FAULT_SPIKE;
        } else {
            halves[count++] = h;
        }
        h = g->next[h];
    } while (h != start);
    uint32_t first = 0;
    while (count - first > 1 && halves[first] == half_twin(halves[count - 1])) {
        first++;
        count--;
        outline->faults |= TL_CONTOUR_FAULT_SPIKE;
    }
    uint32_t *corners = outline->corners + outline->walk_first[outline->walk_count];
    uint32_t *edges = outline->edges + outline->walk_first[outline->walk_count];
    for (uint32_t i = first; i < count; i++) {
        *corners++ = g->origin[halves[i]];
        *edges++ = g->edge_of[halves[i]];
    }
    outline->walk_count++;
    outline->walk_first[outline->walk_count] = (uint32_t)(corners - outline->corners);
}

// In the order of the contour, and each from its earliest edge on, so that a contour with bridges is walked just as it
// came; last the faces that the contour only runs backward around.
static tl_result add_walks(const graph *g, tl_arena *arena, uint32_t count, tl_outline *outline)
{
    uint8_t *done = TL_PUSH_ZERO(arena, uint8_t, g->face_count);
    uint32_t *halves = TL_PUSH(arena, uint32_t, g->half_count);
    if (done == NULL || halves == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < (uint64_t)count + g->half_count; i++) {
        uint32_t h = i < count ? g->half_of[i] : (uint32_t)(i - count);
        uint32_t face = g->face[h];
        if (g->winding[face] > 0 && !done[face]) {
            done[face] = 1;
            add_walk(g, h, halves, outline);
        }
    }
    return TL_OK;
}

static void find_faults(const graph *g, tl_outline *outline)
{
    for (uint32_t f = 0; f < g->face_count; f++) {
        if (g->winding[f] < 0 || g->winding[f] > 1) {
            outline->faults |= TL_CONTOUR_FAULT_WINDING;
        }
    }
    for (uint32_t h = 0; h < g->half_count; h += 2) {
        if (g->face[h] == g->outer && g->face[h + 1] == g->outer) {
            outline->faults |= TL_CONTOUR_FAULT_SPIKE;
        }
    }
    if (outline->walk_count > 1) {
        outline->faults |= TL_CONTOUR_FAULT_PINCH;
    }
}

tl_result tl_outline_trace_faces(tl_arena *arena, const tl_outline_edge *edges, uint32_t count, tl_outline *outline)
{
    if (count == 0) {
        return TL_OK;
    }
    // A connected plane graph has at most as many bounded faces as edges.
    outline->walk_first = TL_PUSH(arena, uint32_t, (uint64_t)count + 2);
    outline->corners = TL_PUSH(arena, uint32_t, 2 * (uint64_t)count);
    outline->edges = TL_PUSH(arena, uint32_t, 2 * (uint64_t)count);
    if (outline->walk_first == NULL || outline->corners == NULL || outline->edges == NULL) {
        return TL_ERR_MEMORY;
    }
    outline->walk_first[0] = 0;
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    graph g;
    memset(&g, 0, sizeof g);
    g.points = outline->nodes.points;
    g.node_count = outline->nodes.count;
    TL_TRY(gather_half_edges(&g, arena, edges, count));
    TL_TRY(link_faces(&g, arena));
    TL_TRY(number_plane_faces(&g, arena));
    TL_TRY(count_windings(&g, arena));
    TL_TRY(add_walks(&g, arena, count, outline));
    find_faults(&g, outline);
    tl_arena_rollback(arena, mark);
    return TL_OK;
}
