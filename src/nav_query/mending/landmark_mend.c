// SPDX-License-Identifier: MIT
//
// Landmark distances after an edit: mended, not measured anew.
//
// A bound needs no distances: any numbers serve that differ along no edge by more than it is long. Old ones break that
// only at edges that are new; from there they are lowered as in Dijkstra's algorithm, until none does. They are rounded
// down, so what is lowered breaks it nowhere, and errors do not add up: from a vertex that was lowered to one that was
// not, a path leaves the first kind once. All are kept a little shorter than they are (TL_NAV_LANDMARK_SCALE): edges
// then have some slack, and where a new corner vertex stands in place of another a rounding lowers none but its own.
//
// Nothing raises distances again where a way has closed: bounds stay right, and are worth less. When as many have been
// lowered as measuring all of them would write, they are measured.

#include "nav_query/mending/landmark_mend.h"

#include "base/arena.h"
#include "base/assert.h"
#include "math/tolerance.h"
#include "nav_query/mending/dijkstra.h"
#include "nav_query/mending/landmark_measure.h"

#include <math.h>
#include <string.h>

// Of lowering new ones by one another: few are farther from all others. What is left is lowered with all.
enum { LOWERING_ROUNDS = 8 };

// The vertices from which a landmark's distances are lowered.
typedef struct landmark_mend {
    const tl_allocator *allocator;
    tl_nav_visibility_graph *graph;
    tl_nav_number_list renewed; // with new edges
    uint64_t *asked;            // by those: for which landmarks their distance asks for a lower one, a bit each
    tl_nav_open_vertex *heap;
    uint64_t heap_capacity;
    uint32_t heap_count;
} landmark_mend;

static float round_down(double length)
{
    const float rounded = (float)length;
    return (double)rounded > length ? nextafterf(rounded, 0.0f) : rounded;
}

// New corner vertices have no distances yet.
static void forget_fresh(const tl_nav_graph_changes *changes)
{
    for (uint64_t i = changes->first_fresh; i < changes->lookers.count; i++) {
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            changes->graph->landmarks[changes->lookers.numbers[i]][k] = INFINITY;
        }
    }
}

// Whether any of a vertex's distances may be larger than another's by more than a length: as floats, which are rounded.
static bool may_exceed(const float *distances, const float *others, double length)
{
    const float least = (float)(length * (1.0 - (double)TL_FLOAT_GAMMA(2)));
    uint32_t any = 0;
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        any |= distances[k] * (1.0f + TL_FLOAT_GAMMA(4)) > others[k] + least ? 1u : 0u;
    }
    return any != 0;
}

// Lowers a vertex's distances where one of its edges leads to a shorter one. `scale`: of the edges' lengths. Whether it
// lowered any.
static bool lower_by_edges(tl_nav_visibility_graph *graph, uint32_t i, double scale)
{
    const tl_nav_corner_vertex *vertex = &graph->vertices[i];
    bool any = false;
    for (uint32_t e = 0; e < vertex->edge_count; e++) {
        const double length = scale * tl_nav_visibility_edge_length(vertex, &vertex->edges[e]);
        const float *to = graph->landmarks[vertex->edges[e].to];
        const bool may = may_exceed(graph->landmarks[i], to, length);
        for (uint32_t k = 0; may && k < TL_NAV_LANDMARKS; k++) {
            if ((double)graph->landmarks[i][k] > (double)to[k] + length) {
                graph->landmarks[i][k] = round_down((double)to[k] + length);
                any = true;
            }
        }
    }
    return any;
}

// New corner vertices have theirs by those around them, and by one another.
static void lower_fresh(const tl_nav_graph_changes *changes)
{
    bool any = true;
    for (uint32_t round = 0; round < LOWERING_ROUNDS && any; round++) {
        any = false;
        for (uint64_t i = changes->first_fresh; i < changes->lookers.count; i++) {
            any = lower_by_edges(changes->graph, changes->lookers.numbers[i], TL_NAV_LANDMARK_SCALE) || any;
        }
    }
}

// For which landmarks a vertex's distance asks for a lower one at the end of an edge: a bit each.
static uint64_t landmarks_to_lower(const tl_nav_visibility_graph *graph, uint32_t i)
{
    const tl_nav_corner_vertex *vertex = &graph->vertices[i];
    uint64_t asked = 0;
    for (uint32_t e = 0; e < vertex->edge_count; e++) {
        const double length = tl_nav_visibility_edge_length(vertex, &vertex->edges[e]);
        const float *to = graph->landmarks[vertex->edges[e].to];
        const bool may = may_exceed(to, graph->landmarks[i], length);
        for (uint32_t k = 0; may && k < TL_NAV_LANDMARKS; k++) {
            asked |= (uint64_t)((double)to[k] > (double)graph->landmarks[i][k] + length) << k;
        }
    }
    return asked;
}

static tl_result open_lowered(landmark_mend *m, uint32_t vertex, uint32_t landmark)
{
    if (m->heap_count == m->heap_capacity) {
        tl_nav_open_vertex *grown = tl_grow_array(m->allocator, m->heap, &m->heap_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        m->heap = grown;
    }
    const tl_nav_open_vertex item = { .length = (double)m->graph->landmarks[vertex][landmark], .vertex = vertex };
    tl_nav_open_vertex_push(m->heap, &m->heap_count, item, NULL);
    return TL_OK;
}

// Lowers one landmark's distances from open vertices on.
static tl_result spread_lowered(landmark_mend *m, uint32_t landmark)
{
    tl_nav_visibility_graph *graph = m->graph;
    while (m->heap_count > 0) {
        const tl_nav_open_vertex next = tl_nav_open_vertex_pop(m->heap, &m->heap_count, NULL);
        if (next.length > (double)graph->landmarks[next.vertex][landmark]) {
            continue;
        }
        graph->lowered++;
        const tl_nav_corner_vertex *vertex = &graph->vertices[next.vertex];
        for (uint32_t e = 0; e < vertex->edge_count; e++) {
            const tl_nav_visibility_edge *edge = &vertex->edges[e];
            const double length = next.length + tl_nav_visibility_edge_length(vertex, edge);
            if (length < (double)graph->landmarks[edge->to][landmark]) {
                graph->landmarks[edge->to][landmark] = round_down(length);
                TL_TRY(open_lowered(m, edge->to, landmark));
            }
        }
    }
    return TL_OK;
}

// A component of new vertices alone has no place of any set: all of them are as far from it.
static float settle_fresh(const tl_nav_graph_changes *changes)
{
    float longest = 0.0f;
    for (uint64_t i = changes->first_fresh; i < changes->lookers.count; i++) {
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            float *length = &changes->graph->landmarks[changes->lookers.numbers[i]][k];
            *length = *length < INFINITY ? *length : 0.0f;
            longest = *length > longest ? *length : longest;
        }
    }
    return longest;
}

static tl_result lower_all(const tl_nav_graph_changes *changes, landmark_mend *m, tl_stage *stage)
{
    tl_nav_visibility_graph *graph = m->graph;
    forget_fresh(changes);
    lower_fresh(changes);
    for (uint64_t i = 0; i < m->renewed.count; i++) {
        lower_by_edges(graph, m->renewed.numbers[i], 1.0);
    }
    for (uint64_t i = 0; i < m->renewed.count; i++) {
        m->asked[i] = landmarks_to_lower(graph, m->renewed.numbers[i]);
    }
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        for (uint64_t i = 0; i < m->renewed.count; i++) {
            if ((m->asked[i] >> k & 1) != 0) {
                TL_TRY(open_lowered(m, m->renewed.numbers[i], k));
            }
        }
        TL_TRY(spread_lowered(m, k));
        TL_TRY(tl_stage_add(stage, 1));
    }
    graph->landmark_error = fmaxf(graph->landmark_error, TL_FLOAT_GAMMA(4) * settle_fresh(changes));
    return tl_stage_end(stage);
}

static tl_result list_renewed(landmark_mend *m, const tl_nav_pair_list *seen)
{
    for (uint64_t i = 0; i < seen->count; i++) {
        const uint32_t v = (uint32_t)(seen->items[i].key >> 32);
        const bool is_known = m->renewed.count > 0 && m->renewed.numbers[m->renewed.count - 1] == v;
        TL_TRY(is_known ? TL_OK : tl_nav_add_number(m->allocator, &m->renewed, v));
    }
    m->asked = tl_allocate_array(m->allocator, m->renewed.count, sizeof *m->asked);
    return m->asked != NULL ? TL_OK : TL_ERR_MEMORY;
}

static tl_result mend_in_memory(const tl_nav_graph_changes *changes, const tl_nav_pair_list *seen, tl_stage *stage)
{
    landmark_mend m = { changes->allocator, changes->graph, { NULL, 0, 0 }, NULL, NULL, 0, 0 };
    tl_result result = list_renewed(&m, seen);
    result = result == TL_OK ? lower_all(changes, &m, stage) : result;
    tl_release_array(changes->allocator, m.asked, m.renewed.count, sizeof *m.asked);
    tl_nav_free_numbers(changes->allocator, &m.renewed);
    tl_release_array(changes->allocator, m.heap, m.heap_capacity, sizeof *m.heap);
    return result;
}

tl_result tl_nav_mend_landmarks(const tl_nav_graph_changes *changes, const tl_nav_pair_list *seen, const tl_host *host)
{
    tl_nav_visibility_graph *graph = changes->graph;
    tl_stage stage;
    TL_TRY(tl_stage_begin(&stage, host, "landmarks", TL_NAV_LANDMARKS));
    const bool is_fresh = changes->lookers.count - changes->first_fresh == graph->vertex_count;
    return is_fresh || graph->lowered >= (uint64_t)TL_NAV_LANDMARKS * graph->vertex_count
               ? tl_nav_measure_landmarks(changes->allocator, graph, &stage)
               : mend_in_memory(changes, seen, &stage);
}
