// SPDX-License-Identifier: MIT
//
// Landmarks: lengths along edges from a few far places to every corner vertex, which bound how long a way must at least
// be.
//
// A landmark length is the length from the nearest of a set of places. Along an edge it changes by no more than the
// edge is long, so the difference of two corner vertices' landmark lengths is a lower bound for the way between them;
// on a city the largest of 16 is 5% below the truth where the straight line is 11% below, and a search looks at a third
// of the corner vertices. Sets have one place in each part that hangs together, each as far as possible from those
// before it. Source: Goldberg and Harrelson, Computing the Shortest Path: A* Search Meets Graph Theory, 2005.

#include "nav_query/prepared/dijkstra.h"

#include "base/arena.h"
#include "base/assert.h"
#include "math/tolerance.h"

#include <math.h>
#include <string.h>

typedef struct spread {
    const tl_nav_visibility_graph *graph;
    tl_nav_dijkstra lengths;
    uint32_t *part;   // by corner vertex: what hangs together
    uint32_t *source; // by part: the place in the set at hand
    uint32_t part_count;
    double *nearest; // by corner vertex: length to any set so far
} spread;

// Labels parts; the first source of each is its first corner vertex.
static void find_parts(spread *s, uint32_t *stack)
{
    memset(s->part, 0xff, s->graph->vertex_count * sizeof *s->part);
    for (uint32_t i = 0; i < s->graph->vertex_count; i++) {
        if (s->part[i] != UINT32_MAX) {
            continue;
        }
        uint32_t depth = 0;
        s->source[s->part_count] = i;
        s->part[i] = s->part_count;
        stack[depth++] = i;
        while (depth > 0) {
            const tl_nav_corner_vertex *vertex = &s->graph->vertices[stack[--depth]];
            for (uint32_t k = vertex[0].first_edge; k < vertex[1].first_edge; k++) {
                uint32_t to = s->graph->edges[k].to;
                if (s->part[to] == UINT32_MAX) {
                    s->part[to] = s->part_count;
                    stack[depth++] = to;
                }
            }
        }
        s->part_count++;
    }
}

static void choose_sources(spread *s)
{
    for (uint32_t i = 0; i < s->graph->vertex_count; i++) {
        uint32_t *source = &s->source[s->part[i]];
        *source = s->nearest[i] > s->nearest[*source] ? i : *source;
    }
}

static void measure_landmarks(spread *s, tl_nav_visibility_graph *graph, uint32_t *stack)
{
    double longest = 0.0;
    find_parts(s, stack);
    tl_nav_dijkstra_run(&s->lengths, s->source, s->part_count);
    memcpy(s->nearest, s->lengths.length, graph->vertex_count * sizeof *s->nearest);
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        choose_sources(s);
        tl_nav_dijkstra_run(&s->lengths, s->source, s->part_count);
        for (uint32_t i = 0; i < graph->vertex_count; i++) {
            graph->landmarks[i][k] = (float)s->lengths.length[i];
            longest = fmax(longest, s->lengths.length[i]);
            // The first set was chosen for its distance from some corner vertex, which is no place of a set.
            s->nearest[i] = k == 0 ? s->lengths.length[i] : fmin(s->nearest[i], s->lengths.length[i]);
        }
    }
    // Two landmark lengths are rounded, and their difference.
    graph->landmark_error = TL_FLOAT_GAMMA(4) * (float)longest;
}

tl_result tl_nav_find_landmarks(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    spread s;
    memset(&s, 0, sizeof s);
    s.graph = graph;
    TL_TRY(tl_nav_dijkstra_init(allocator, graph, &s.lengths));
    uint32_t *stack = tl_allocate_array(allocator, graph->vertex_count, sizeof *stack);
    s.part = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.part);
    s.source = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.source);
    s.nearest = tl_allocate_array(allocator, graph->vertex_count, sizeof *s.nearest);
    bool fits = stack != NULL && s.part != NULL && s.source != NULL && s.nearest != NULL;
    if (fits) {
        measure_landmarks(&s, graph, stack);
    }
    tl_nav_dijkstra_free(allocator, &s.lengths);
    tl_release_array(allocator, stack, graph->vertex_count, sizeof *stack);
    tl_release_array(allocator, s.part, graph->vertex_count, sizeof *s.part);
    tl_release_array(allocator, s.source, graph->vertex_count, sizeof *s.source);
    tl_release_array(allocator, s.nearest, graph->vertex_count, sizeof *s.nearest);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out)
{
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        bounds_out->least[k] = INFINITY;
        bounds_out->most[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const float *landmarks = graph->landmarks[legs[i].vertex];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            float up = landmarks[k] + legs[i].length;
            float down = landmarks[k] - legs[i].length;
            bounds_out->least[k] = up < bounds_out->least[k] ? up : bounds_out->least[k];
            bounds_out->most[k] = down > bounds_out->most[k] ? down : bounds_out->most[k];
        }
    }
}

float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex)
{
    const float *landmarks = graph->landmarks[vertex];
    float bounds[TL_NAV_LANDMARKS];
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        float down = landmarks[k] - end->most[k];
        float up = end->least[k] - landmarks[k];
        bounds[k] = down > up ? down : up;
    }
    for (uint32_t half = TL_NAV_LANDMARKS / 2; half > 0; half /= 2) {
        for (uint32_t k = 0; k < half; k++) {
            bounds[k] = bounds[k] > bounds[k + half] ? bounds[k] : bounds[k + half];
        }
    }
    return bounds[0] - graph->landmark_error;
}
