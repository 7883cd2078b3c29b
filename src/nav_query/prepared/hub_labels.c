// SPDX-License-Identifier: MIT
//
// Hub labels: for each corner vertex the distances to a few hundred hubs, chosen so that a shortest path between any
// two vertices passes a hub of both.
//
// Where a table of all pairs is too large, 3.6 GB on a city of 25,000 corner vertices, labels take a hundredth or less.
// They are found by a pruned Dijkstra search from each vertex, the most travelled vertices first, that stops where the
// labels so far know a path as short. How much a vertex is travelled is counted on shortest path trees of a sample.
// Each label holds the first edge to its hub, so that the vertices of a path are read off. A query adds the lengths of
// the start's legs to their labels, hub by hub, and looks the goal's hubs up there. Rejected: an elimination tree
// (Ouyang et al. 2018) needs no hub's number, but sight along streets makes its separators wide: 1,900 distances a
// vertex on that city. Source: Akiba, Iwata, Yoshida, Fast Exact Shortest-Path Distance Queries on Large Networks by
// Pruned Landmark Labeling, SIGMOD 2013; Du, Shen, Cheema, Ultrafast Euclidean Shortest Path Computation Using Hub
// Labeling, AAAI 2023.

#include "nav_query/prepared/hub_labels.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/compiler.h"
#include "base/radix_sort.h"
#include "math/tolerance.h"
#include "nav_query/prepared/dijkstra.h"
#include "nav_query/prepared/landmarks.h"

#include <math.h>
#include <string.h>

enum { SAMPLE_TREES = 128, FIRST_LABELS = 8 };

// Vertices whose labels are compared between two calls of progress, at some us each.
enum { TRIED_PER_CALL = 4096 };

// The labels of a corner vertex while they are found.
typedef struct growing_label {
    tl_nav_hub *hubs;
    uint32_t count, capacity;
} growing_label;

typedef struct labeller {
    const tl_allocator *allocator;
    tl_nav_visibility_graph *graph;
    tl_nav_dijkstra lengths;
    growing_label *labels; // by corner vertex
    tl_sort_item
        *order;     // [2 * vertex_count] corner vertices by rank, the keys the lower the more travelled; then scratch
    float *to_root; // by rank: metres from the corner vertex at hand, INFINITY: it does not know the hub
    uint64_t count, limit;
} labeller;

// Orders corner vertices by how many corner vertices lie behind them on shortest path trees, the most first.
static tl_result order_vertices(labeller *l, uint32_t *behind)
{
    uint32_t n = l->graph->vertex_count;
    uint32_t samples = n < SAMPLE_TREES ? n : SAMPLE_TREES;
    for (uint32_t i = 0; i < n; i++) {
        tl_sort_item item = { UINT64_MAX, i, 0 };
        l->order[i] = item;
    }
    for (uint32_t k = 0; k < samples; k++) {
        // Corner vertices are numbered tile by tile, so these are spread over the world.
        uint32_t root = (uint32_t)((uint64_t)k * n / samples);
        TL_TRY(tl_nav_dijkstra_run(&l->lengths, &root, 1));
        for (uint32_t i = 0; i < n; i++) {
            behind[i] = 1;
        }
        for (uint32_t i = l->lengths.settled_count; i > 0; i--) {
            uint32_t vertex = l->lengths.settled[i - 1];
            l->order[vertex].key -= behind[vertex];
            behind[l->lengths.before[vertex]] += vertex != root ? behind[vertex] : 0;
        }
    }
    return tl_radix_sort_in_stage(l->order, l->order + n, n, l->lengths.stage);
}

// Whether labels know a way from the root at hand to a corner vertex that is as short, within their rounding.
static bool is_known_by_labels(const labeller *l, uint32_t vertex, double length)
{
    const growing_label *label = &l->labels[vertex];
    float limit = (float)(length * (1.0 + (double)TL_FLOAT_GAMMA(3)));
    for (uint32_t i = 0; i < label->count; i++) {
        if (l->to_root[tl_nav_hub_rank(&label->hubs[i])] + label->hubs[i].length <= limit) {
            return true;
        }
    }
    return false;
}

static uint32_t edge_between(const tl_nav_visibility_graph *graph, uint32_t from, uint32_t to)
{
    const tl_nav_corner_vertex *vertex = &graph->vertices[from];
    for (uint32_t k = vertex[0].first_edge; k < vertex[1].first_edge; k++) {
        if (graph->edges[k].to == to) {
            return k - vertex[0].first_edge;
        }
    }
    return 0; // a corner vertex's label of itself
}

static tl_result add_label(labeller *l, uint32_t vertex, uint32_t rank, double length)
{
    growing_label *label = &l->labels[vertex];
    if (l->count == l->limit) {
        return TL_ERR_LIMIT;
    }
    if (label->count == label->capacity) {
        uint32_t more = label->capacity > 0 ? 2 * label->capacity : FIRST_LABELS;
        tl_nav_hub *grown = tl_allocate_array(l->allocator, more, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        if (label->count > 0) {
            memcpy(grown, label->hubs, label->count * sizeof *grown);
        }
        tl_release_array(l->allocator, label->hubs, label->capacity, sizeof *grown);
        label->hubs = grown;
        label->capacity = more;
    }
    uint32_t edge = edge_between(l->graph, vertex, l->lengths.before[vertex]);
    tl_nav_hub hub = { rank << TL_NAV_HUB_EDGE_BITS | edge, (float)length };
    label->hubs[label->count++] = hub;
    l->count++;
    return TL_OK;
}

// Labels all corner vertices to which the shortest ways from the corner vertex of a rank lead, and which no hub before
// it is on.
static tl_result label_from(labeller *l, uint32_t rank)
{
    tl_nav_dijkstra *s = &l->lengths;
    uint32_t root = l->order[rank].value;
    const growing_label *own = &l->labels[root];
    for (uint32_t i = 0; i < own->count; i++) {
        l->to_root[tl_nav_hub_rank(&own->hubs[i])] = own->hubs[i].length;
    }
    tl_result result = TL_OK;
    uint32_t touched = 0, tried = 0;
    s->length[root] = 0.0;
    s->before[root] = root;
    s->settled[touched++] = root;
    tl_nav_dijkstra_open(s, 0.0, root);
    while (s->heap_count > 0 && result == TL_OK) {
        tl_nav_open_vertex next = tl_nav_dijkstra_next(s);
        result = ++tried % TRIED_PER_CALL == 0 ? tl_stage_add(s->stage, 0) : TL_OK;
        if (result != TL_OK) {
            break;
        }
        if (next.length > s->length[next.vertex] || is_known_by_labels(l, next.vertex, next.length)) {
            continue;
        }
        result = add_label(l, next.vertex, rank, next.length);
        const tl_nav_corner_vertex *vertex = &l->graph->vertices[next.vertex];
        for (uint32_t k = vertex[0].first_edge; k < vertex[1].first_edge; k++) {
            const tl_nav_visibility_edge *edge = &l->graph->edges[k];
            double length = next.length + tl_nav_visibility_edge_length(vertex, edge);
            if (length < s->length[edge->to]) {
                if (s->length[edge->to] == (double)INFINITY) {
                    s->settled[touched++] = edge->to;
                }
                s->length[edge->to] = length;
                s->before[edge->to] = next.vertex;
                tl_nav_dijkstra_open(s, length, edge->to);
                tl_prefetch(l->labels[edge->to].hubs); // each is in a place of its own, and asked for soon
            }
        }
    }
    s->heap_count = 0;
    for (uint32_t i = 0; i < touched; i++) {
        s->length[s->settled[i]] = (double)INFINITY;
    }
    own = &l->labels[root];
    for (uint32_t i = 0; i < own->count; i++) {
        l->to_root[tl_nav_hub_rank(&own->hubs[i])] = INFINITY;
    }
    return result;
}

static tl_result label_all(labeller *l, uint32_t *behind)
{
    uint32_t n = l->graph->vertex_count;
    memset(l->labels, 0, n * sizeof *l->labels);
    TL_TRY(order_vertices(l, behind));
    for (uint32_t i = 0; i < n; i++) {
        l->to_root[i] = INFINITY;
        l->lengths.length[i] = (double)INFINITY;
    }
    for (uint32_t rank = 0; rank < n; rank++) {
        TL_TRY(label_from(l, rank));
        TL_TRY(tl_stage_add(l->lengths.stage, 1));
    }
    return TL_OK;
}

// Puts all labels into one array.
static tl_result gather_labels(labeller *l)
{
    tl_nav_hub_labels *labels = &l->graph->labels;
    uint32_t n = l->graph->vertex_count;
    labels->count = l->count;
    labels->first = tl_allocate_array(l->allocator, (uint64_t)n + 1, sizeof *labels->first);
    labels->hubs = tl_allocate_array(l->allocator, l->count, sizeof *labels->hubs);
    labels->vertex = tl_allocate_array(l->allocator, n, sizeof *labels->vertex);
    if (labels->first == NULL || labels->hubs == NULL || labels->vertex == NULL) {
        tl_nav_free_hub_labels(l->allocator, l->graph);
        return TL_ERR_MEMORY;
    }
    uint64_t at = 0;
    for (uint32_t i = 0; i < n; i++) {
        labels->vertex[i] = l->order[i].value;
        labels->first[i] = at;
        memcpy(labels->hubs + at, l->labels[i].hubs, l->labels[i].count * sizeof *labels->hubs);
        at += l->labels[i].count;
    }
    labels->first[n] = at;
    return TL_OK;
}

// More edges from a corner vertex than a label can tell apart, or more corner vertices.
static bool is_too_large(const tl_nav_visibility_graph *graph)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        uint32_t count = graph->vertices[i + 1].first_edge - graph->vertices[i].first_edge;
        most = count > most ? count : most;
    }
    return most > 1u << TL_NAV_HUB_EDGE_BITS || graph->vertex_count > UINT32_MAX >> TL_NAV_HUB_EDGE_BITS;
}

tl_result tl_nav_bake_hub_labels(const tl_allocator *allocator, const tl_host *host, tl_nav_visibility_graph *graph,
                                 uint64_t budget)
{
    uint64_t fixed = tl_nav_hub_labels_size(graph);
    if (is_too_large(graph) || budget < fixed) {
        return TL_ERR_LIMIT;
    }
    labeller l;
    memset(&l, 0, sizeof l);
    l.allocator = allocator;
    l.graph = graph;
    l.limit = (budget - fixed) / sizeof(tl_nav_hub);
    tl_stage stage;
    TL_TRY(tl_stage_begin(&stage, host, "hub labels", graph->vertex_count));
    TL_TRY(tl_nav_dijkstra_init(allocator, graph, &stage, &l.lengths));
    uint32_t n = graph->vertex_count;
    uint32_t *behind = tl_allocate_array(allocator, n, sizeof *behind);
    l.labels = tl_allocate_array(allocator, n, sizeof *l.labels);
    l.order = tl_allocate_array(allocator, 2 * (uint64_t)n, sizeof *l.order);
    l.to_root = tl_allocate_array(allocator, n, sizeof *l.to_root);
    tl_result result = TL_ERR_MEMORY;
    if (behind != NULL && l.labels != NULL && l.order != NULL && l.to_root != NULL) {
        result = label_all(&l, behind);
        result = result == TL_OK ? gather_labels(&l) : result;
        result = result == TL_OK ? tl_stage_end(&stage) : result;
        for (uint32_t i = 0; i < n; i++) {
            tl_release_array(allocator, l.labels[i].hubs, l.labels[i].capacity, sizeof(tl_nav_hub));
        }
    }
    tl_nav_dijkstra_free(allocator, &l.lengths);
    tl_release_array(allocator, behind, n, sizeof *behind);
    tl_release_array(allocator, l.labels, n, sizeof *l.labels);
    tl_release_array(allocator, l.order, 2 * (uint64_t)n, sizeof *l.order);
    tl_release_array(allocator, l.to_root, n, sizeof *l.to_root);
    return result;
}

uint64_t tl_nav_hub_labels_size(const tl_nav_visibility_graph *graph)
{
    const tl_nav_hub_labels *labels = &graph->labels;
    return ((uint64_t)graph->vertex_count + 1) * sizeof *labels->first +
           (uint64_t)graph->vertex_count * sizeof *labels->vertex + labels->count * sizeof *labels->hubs;
}

void tl_nav_free_hub_labels(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    tl_nav_hub_labels *labels = &graph->labels;
    tl_release_array(allocator, labels->first, (uint64_t)graph->vertex_count + 1, sizeof *labels->first);
    tl_release_array(allocator, labels->hubs, labels->count, sizeof *labels->hubs);
    tl_release_array(allocator, labels->vertex, graph->vertex_count, sizeof *labels->vertex);
    memset(labels, 0, sizeof *labels);
}

// ---------------------------------------------------------------------------------------------------------
// Asking.

// Metres from any start to each hub of this one, if it is nearer.
static void reach_hubs(const tl_nav_hub_labels *labels, const tl_nav_corner_leg *start, float *to_hub)
{
    for (uint64_t i = labels->first[start->vertex]; i < labels->first[start->vertex + 1]; i++) {
        uint32_t rank = tl_nav_hub_rank(&labels->hubs[i]);
        float length = start->length + labels->hubs[i].length;
        to_hub[rank] = length < to_hub[rank] ? length : to_hub[rank];
    }
}

static void meet_goals(const tl_nav_hub_labels *labels, const tl_nav_ends *ends, const float *to_hub, float margin,
                       tl_nav_meeting *best)
{
    for (uint32_t k = 0; k < ends->goal_count; k++) {
        tl_nav_corner_leg *goal = &ends->goals[k];
        if (!(goal->total < best->length * margin)) {
            continue;
        }
        for (uint64_t i = labels->first[goal->vertex]; i < labels->first[goal->vertex + 1]; i++) {
            uint32_t rank = tl_nav_hub_rank(&labels->hubs[i]);
            float length = to_hub[rank] + labels->hubs[i].length + goal->length;
            if (length < best->length) {
                best->length = length;
                best->goal = goal;
                best->hub = rank;
            }
        }
    }
}

// The label of a corner vertex for a hub, NULL: it has none.
static const tl_nav_hub *find_hub(const tl_nav_hub_labels *labels, uint32_t vertex, uint32_t rank)
{
    uint64_t first = labels->first[vertex];
    uint64_t end = labels->first[vertex + 1];
    while (first < end) {
        uint64_t middle = first + (end - first) / 2;
        uint32_t at = tl_nav_hub_rank(&labels->hubs[middle]);
        if (at == rank) {
            return &labels->hubs[middle];
        }
        first = at < rank ? middle + 1 : first;
        end = at < rank ? end : middle;
    }
    return NULL;
}

// What a way over each leg takes at least, by landmarks, where that says more than the straight line.
static void raise_totals(const tl_nav_visibility_graph *graph, tl_nav_corner_leg *legs, uint32_t count,
                         const tl_nav_corner_leg *others, uint32_t other_count)
{
    tl_nav_landmark_bounds other;
    tl_nav_bound_by_landmarks(graph, others, other_count, &other);
    for (uint32_t i = 0; i < count; i++) {
        float total = legs[i].length + tl_nav_min_by_landmarks(graph, &other, legs[i].vertex);
        legs[i].total = total > legs[i].total ? total : legs[i].total;
    }
}

tl_nav_meeting tl_nav_best_by_labels(const tl_nav_visibility_graph *graph, tl_nav_ends *ends, float *to_hub)
{
    const tl_nav_hub_labels *labels = &graph->labels;
    const float margin = 1.0f + TL_FLOAT_GAMMA(16);
    tl_nav_meeting best = { INFINITY, NULL, NULL, 0 };
    if (ends->start_count == 0) {
        return best;
    }
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        to_hub[i] = INFINITY;
    }
    raise_totals(graph, ends->starts, ends->start_count, ends->goals, ends->goal_count);
    raise_totals(graph, ends->goals, ends->goal_count, ends->starts, ends->start_count);
    // The most promising start first: it bounds what is worth a look. A total may be too long by its roundings.
    uint32_t nearest = 0;
    for (uint32_t i = 1; i < ends->start_count; i++) {
        nearest = ends->starts[i].total < ends->starts[nearest].total ? i : nearest;
    }
    reach_hubs(labels, &ends->starts[nearest], to_hub);
    meet_goals(labels, ends, to_hub, margin, &best);
    for (uint32_t i = 0; i < ends->start_count; i++) {
        if (i != nearest && ends->starts[i].total < best.length * margin) {
            reach_hubs(labels, &ends->starts[i], to_hub);
        }
    }
    meet_goals(labels, ends, to_hub, margin, &best);
    for (uint32_t i = 0; i < ends->start_count && best.length < INFINITY; i++) {
        const tl_nav_hub *hub = find_hub(labels, ends->starts[i].vertex, best.hub);
        if (hub != NULL && ends->starts[i].length + hub->length == to_hub[best.hub]) {
            best.start = &ends->starts[i];
            break;
        }
    }
    return best;
}

// The corner vertices from one to a hub, both among them; returns their number, UINT32_MAX: there is no room.
static uint32_t walk_to_hub(const tl_nav_visibility_graph *graph, uint32_t vertex, uint32_t rank, uint64_t *vertices,
                            uint32_t capacity)
{
    uint32_t count = 0;
    for (uint32_t at = vertex;;) {
        const tl_nav_hub *hub = find_hub(&graph->labels, at, rank);
        if (count == capacity || hub == NULL) {
            return UINT32_MAX;
        }
        vertices[count++] = at;
        if (at == graph->labels.vertex[rank]) {
            return count;
        }
        at = graph->edges[graph->vertices[at].first_edge + tl_nav_hub_edge(hub)].to;
    }
}

uint32_t tl_nav_unpack_labels(const tl_nav_visibility_graph *graph, const tl_nav_meeting *meeting, uint64_t *vertices,
                              uint32_t capacity)
{
    uint32_t count = walk_to_hub(graph, meeting->goal->vertex, meeting->hub, vertices, capacity);
    if (count == UINT32_MAX) {
        return count;
    }
    // The hub comes from both sides.
    uint64_t *rest = vertices + count - 1;
    uint32_t more = walk_to_hub(graph, meeting->start->vertex, meeting->hub, rest, capacity - count + 1);
    if (more == UINT32_MAX) {
        return more;
    }
    for (uint32_t i = 0; i < more / 2; i++) {
        uint64_t kept = rest[i];
        rest[i] = rest[more - 1 - i];
        rest[more - 1 - i] = kept;
    }
    return count - 1 + more;
}
