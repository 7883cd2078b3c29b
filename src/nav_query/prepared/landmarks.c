// SPDX-License-Identifier: MIT
//
// Landmarks: distances from a few far places to every corner vertex, which bound other distances from below (ALT).
//
// A landmark here is a set of places, and its distance that from the nearest of them. Along an edge it changes by no
// more than the edge is long (the triangle inequality), so the difference of two vertices' distances is a lower bound
// for the path between them. On a city the largest of 16 bounds is 5% below the truth where the straight line is 11%
// below, and a search looks at a third of the vertices. A set has one place in each connected component, each as far as
// possible from those of earlier sets.
//
// After an edit distances are mended, not measured anew. A bound needs no distances: any numbers serve that differ
// along no edge by more than it is long. Old ones break that only at edges that are new; from there they are lowered as
// in Dijkstra's algorithm, until none does. They are rounded down, so what is lowered breaks it nowhere, and errors do
// not add up: from a vertex that was lowered to one that was not, a path leaves the first kind once. Nothing raises
// them again where a way has closed: bounds stay right, and are worth a little less after each edit; so now and then
// all are measured. Source: Goldberg and Harrelson, Computing the Shortest Path: A* Search Meets Graph Theory, 2005.

#include "nav_query/prepared/landmarks.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"
#include "math/tolerance.h"
#include "nav_query/prepared/dijkstra.h"

#include <math.h>
#include <string.h>

// Mends after which all distances are measured: those of ways that have closed since then are too short.
enum { MAX_MENDS = 64 };

typedef struct landmark_spread {
    const tl_nav_visibility_graph *graph;
    tl_nav_dijkstra lengths;
    uint32_t *component; // by corner vertex
    uint32_t *source;    // by component: its place in the current set
    uint32_t component_count;
    double *nearest; // by corner vertex: length to any set so far
} landmark_spread;

// Labels connected components; the first source of each is its first vertex.
static void find_components(landmark_spread *s, uint32_t *stack)
{
    memset(s->component, 0xff, s->graph->vertex_count * sizeof *s->component);
    for (uint32_t i = 0; i < s->graph->vertex_count; i++) {
        if (s->component[i] != UINT32_MAX) {
            continue;
        }
        uint32_t depth = 0;
        s->source[s->component_count] = i;
        s->component[i] = s->component_count;
        stack[depth++] = i;
        while (depth > 0) {
            const tl_nav_corner_vertex *vertex = &s->graph->vertices[stack[--depth]];
            for (uint32_t k = vertex[0].first_edge; k < vertex[1].first_edge; k++) {
                uint32_t to = s->graph->edges[k].to;
                if (s->component[to] == UINT32_MAX) {
                    s->component[to] = s->component_count;
                    stack[depth++] = to;
                }
            }
        }
        s->component_count++;
    }
}

static void choose_sources(landmark_spread *s)
{
    for (uint32_t i = 0; i < s->graph->vertex_count; i++) {
        uint32_t *source = &s->source[s->component[i]];
        *source = s->nearest[i] > s->nearest[*source] ? i : *source;
    }
}

static tl_result measure_landmarks(landmark_spread *s, tl_nav_visibility_graph *graph, uint32_t *stack)
{
    double longest = 0.0;
    find_components(s, stack);
    TL_TRY(tl_nav_dijkstra_run(&s->lengths, s->source, s->component_count));
    memcpy(s->nearest, s->lengths.length, graph->vertex_count * sizeof *s->nearest);
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        choose_sources(s);
        TL_TRY(tl_nav_dijkstra_run(&s->lengths, s->source, s->component_count));
        TL_TRY(tl_stage_add(s->lengths.stage, 1));
        for (uint32_t i = 0; i < graph->vertex_count; i++) {
            graph->landmarks[i][k] = (float)s->lengths.length[i];
            longest = tl_max_f64(longest, s->lengths.length[i]);
            // The first set was chosen for its distance from some corner vertex, which is no place of a set.
            s->nearest[i] = k == 0 ? s->lengths.length[i] : tl_min_f64(s->nearest[i], s->lengths.length[i]);
        }
    }
    // Two landmark lengths are rounded, and their difference.
    graph->landmark_error = TL_FLOAT_GAMMA(4) * (float)longest;
    return tl_stage_end(s->lengths.stage);
}

// Takes the distances of vertices over that had some; all others have none yet.
static void take_distances_over(const tl_nav_graph_reuse *reuse, tl_nav_visibility_graph *graph)
{
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        const uint32_t before = reuse->before[i];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            graph->landmarks[i][k] = before != TL_NAV_NO_VERTEX ? reuse->old->landmarks[before][k] : INFINITY;
        }
    }
}

static float round_down(double length)
{
    const float rounded = (float)length;
    return (double)rounded > length ? nextafterf(rounded, 0.0f) : rounded;
}

// Lowers a vertex's distances where one of its edges leads to a shorter one.
static void lower_by_edges(tl_nav_visibility_graph *graph, uint32_t i)
{
    const tl_nav_corner_vertex *vertex = &graph->vertices[i];
    for (uint32_t e = vertex[0].first_edge; e < vertex[1].first_edge; e++) {
        const double length = tl_nav_visibility_edge_length(vertex, &graph->edges[e]);
        const float *to = graph->landmarks[graph->edges[e].to];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            if ((double)graph->landmarks[i][k] > (double)to[k] + length) {
                graph->landmarks[i][k] = round_down((double)to[k] + length);
            }
        }
    }
}

// For which landmarks a vertex's distance asks for a lower one at the end of an edge: a bit each.
static uint32_t landmarks_to_lower(const tl_nav_visibility_graph *graph, uint32_t i)
{
    const tl_nav_corner_vertex *vertex = &graph->vertices[i];
    uint32_t asked = 0;
    for (uint32_t e = vertex[0].first_edge; e < vertex[1].first_edge; e++) {
        const double length = tl_nav_visibility_edge_length(vertex, &graph->edges[e]);
        const float *to = graph->landmarks[graph->edges[e].to];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            asked |= (uint32_t)((double)to[k] > (double)graph->landmarks[i][k] + length) << k;
        }
    }
    return asked;
}

// A landmark that is mended: the vertices from which its distances are lowered.
typedef struct landmark_mend {
    tl_nav_visibility_graph *graph;
    tl_nav_open_vertex *heap; // [vertex_count + edge_count]
    uint32_t heap_count;
} landmark_mend;

static void open_lowered(landmark_mend *m, uint32_t vertex, uint32_t landmark)
{
    const tl_nav_open_vertex item = { (double)m->graph->landmarks[vertex][landmark], vertex };
    tl_nav_open_vertex_push(m->heap, &m->heap_count, item, NULL);
}

// Lowers one landmark's distances from open vertices on.
static void spread_lowered(landmark_mend *m, uint32_t landmark)
{
    while (m->heap_count > 0) {
        const tl_nav_open_vertex next = tl_nav_open_vertex_pop(m->heap, &m->heap_count, NULL);
        if (next.length > (double)m->graph->landmarks[next.vertex][landmark]) {
            continue;
        }
        const tl_nav_corner_vertex *vertex = &m->graph->vertices[next.vertex];
        for (uint32_t e = vertex[0].first_edge; e < vertex[1].first_edge; e++) {
            const tl_nav_visibility_edge *edge = &m->graph->edges[e];
            const double length = next.length + tl_nav_visibility_edge_length(vertex, edge);
            if (length < (double)m->graph->landmarks[edge->to][landmark]) {
                m->graph->landmarks[edge->to][landmark] = round_down(length);
                open_lowered(m, edge->to, landmark);
            }
        }
    }
}

// A component of new vertices alone has no place of any set: all of them are as far from it.
static float settle_distances(tl_nav_visibility_graph *graph)
{
    float longest = 0.0f;
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            float *length = &graph->landmarks[i][k];
            *length = *length < INFINITY ? *length : 0.0f;
            longest = *length > longest ? *length : longest;
        }
    }
    return longest;
}

static tl_result mend_landmarks(const tl_nav_graph_reuse *reuse, landmark_mend *m, uint32_t *asked, tl_stage *stage)
{
    tl_nav_visibility_graph *graph = m->graph;
    take_distances_over(reuse, graph);
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        if (!tl_nav_is_reused(reuse, i)) {
            lower_by_edges(graph, i);
        }
    }
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        asked[i] = tl_nav_is_reused(reuse, i) ? 0 : landmarks_to_lower(graph, i);
    }
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        for (uint32_t i = 0; i < graph->vertex_count; i++) {
            if ((asked[i] >> k & 1) != 0) {
                open_lowered(m, i, k);
            }
        }
        spread_lowered(m, k);
        TL_TRY(tl_stage_add(stage, 1));
    }
    const float longest = settle_distances(graph);
    graph->mends = reuse->old->mends + 1;
    graph->landmark_error = fmaxf(reuse->old->landmark_error, TL_FLOAT_GAMMA(4) * longest);
    return tl_stage_end(stage);
}

static tl_result mend_in_memory(const tl_allocator *allocator, const tl_nav_graph_reuse *reuse,
                                tl_nav_visibility_graph *graph, tl_stage *stage)
{
    const uint64_t room = (uint64_t)graph->vertex_count + graph->edge_count;
    landmark_mend mend = { graph, tl_allocate_array(allocator, room, sizeof *mend.heap), 0 };
    uint32_t *asked = tl_allocate_array(allocator, graph->vertex_count, sizeof *asked);
    const bool fits = mend.heap != NULL && asked != NULL;
    const tl_result result = fits ? mend_landmarks(reuse, &mend, asked, stage) : TL_ERR_MEMORY;
    tl_release_array(allocator, mend.heap, room, sizeof *mend.heap);
    tl_release_array(allocator, asked, graph->vertex_count, sizeof *asked);
    return result;
}

tl_result tl_nav_find_landmarks(const tl_allocator *allocator, const tl_host *host, const tl_nav_graph_reuse *reuse,
                                tl_nav_visibility_graph *graph)
{
    landmark_spread s;
    tl_stage stage;
    memset(&s, 0, sizeof s);
    s.graph = graph;
    TL_TRY(tl_stage_begin(&stage, host, "landmarks", TL_NAV_LANDMARKS));
    if (reuse->old != NULL && reuse->old->mends < MAX_MENDS) {
        return mend_in_memory(allocator, reuse, graph, &stage);
    }
    TL_TRY(tl_nav_dijkstra_init(allocator, graph, &stage, &s.lengths));
    uint32_t *stack = tl_allocate_array(allocator, graph->vertex_count, sizeof *stack);
    s.component = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.component);
    s.source = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.source);
    s.nearest = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.nearest);
    const bool fits = stack != NULL && s.component != NULL && s.source != NULL && s.nearest != NULL;
    const tl_result result = fits ? measure_landmarks(&s, graph, stack) : TL_ERR_MEMORY;
    tl_nav_dijkstra_free(allocator, &s.lengths);
    tl_release_array(allocator, stack, graph->vertex_count, sizeof *stack);
    tl_release_array(allocator, s.component, graph->vertex_count, sizeof *s.component);
    tl_release_array(allocator, s.source, graph->vertex_count, sizeof *s.source);
    tl_release_array(allocator, s.nearest, graph->vertex_count, sizeof *s.nearest);
    return result;
}

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out)
{
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        bounds_out->upper[k] = INFINITY;
        bounds_out->lower[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const float *landmarks = graph->landmarks[legs[i].vertex];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            float up = landmarks[k] + legs[i].length;
            float down = landmarks[k] - legs[i].length;
            bounds_out->upper[k] = up < bounds_out->upper[k] ? up : bounds_out->upper[k];
            bounds_out->lower[k] = down > bounds_out->lower[k] ? down : bounds_out->lower[k];
        }
    }
}

float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex)
{
    const float *landmarks = graph->landmarks[vertex];
    float bounds[TL_NAV_LANDMARKS];
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        float down = landmarks[k] - end->lower[k];
        float up = end->upper[k] - landmarks[k];
        bounds[k] = down > up ? down : up;
    }
    for (uint32_t half = TL_NAV_LANDMARKS / 2; half > 0; half /= 2) {
        for (uint32_t k = 0; k < half; k++) {
            bounds[k] = bounds[k] > bounds[k + half] ? bounds[k] : bounds[k + half];
        }
    }
    return bounds[0] - graph->landmark_error;
}
