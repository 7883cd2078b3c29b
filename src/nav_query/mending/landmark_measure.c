// SPDX-License-Identifier: MIT
//
// Choosing landmarks, and measuring the distances from them. A set of places has one in each connected component, each
// as far as possible from those of earlier sets.

#include "nav_query/mending/landmark_measure.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"
#include "math/tolerance.h"
#include "nav_query/prepared/dijkstra.h"

#include <math.h>
#include <string.h>

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
    memset(s->component, 0xff, s->graph->vertex_room * sizeof *s->component);
    for (uint32_t i = 0; i < s->graph->vertex_room; i++) {
        if (s->component[i] != UINT32_MAX || s->graph->vertices[i].turn == 0) {
            continue;
        }
        uint32_t depth = 0;
        s->source[s->component_count] = i;
        s->component[i] = s->component_count;
        stack[depth++] = i;
        while (depth > 0) {
            const tl_nav_corner_vertex *vertex = &s->graph->vertices[stack[--depth]];
            for (uint32_t k = 0; k < vertex->edge_count; k++) {
                uint32_t to = vertex->edges[k].to;
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
    for (uint32_t i = 0; i < s->graph->vertex_room; i++) {
        if (s->component[i] != UINT32_MAX) {
            uint32_t *source = &s->source[s->component[i]];
            *source = s->nearest[i] > s->nearest[*source] ? i : *source;
        }
    }
}

static tl_result measure_landmarks(landmark_spread *s, tl_nav_visibility_graph *graph, uint32_t *stack)
{
    double longest = 0.0;
    find_components(s, stack);
    TL_TRY(tl_nav_dijkstra_run(&s->lengths, s->source, s->component_count));
    memcpy(s->nearest, s->lengths.length, graph->vertex_room * sizeof *s->nearest);
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        choose_sources(s);
        TL_TRY(tl_nav_dijkstra_run(&s->lengths, s->source, s->component_count));
        TL_TRY(tl_stage_add(s->lengths.stage, 1));
        for (uint32_t i = 0; i < graph->vertex_room; i++) {
            if (s->component[i] == UINT32_MAX) {
                continue; // a free number
            }
            graph->landmarks[i][k] = (float)(TL_NAV_LANDMARK_SCALE * s->lengths.length[i]);
            longest = tl_max_f64(longest, s->lengths.length[i]);
            // The first set was chosen for its distance from some corner vertex, which is no place of a set.
            s->nearest[i] = k == 0 ? s->lengths.length[i] : tl_min_f64(s->nearest[i], s->lengths.length[i]);
        }
    }
    // Two landmark lengths are rounded, and their difference.
    graph->landmark_error = TL_FLOAT_GAMMA(4) * (float)longest;
    return tl_stage_end(s->lengths.stage);
}

tl_result tl_nav_measure_landmarks(const tl_allocator *allocator, tl_nav_visibility_graph *graph, tl_stage *stage)
{
    landmark_spread s;
    memset(&s, 0, sizeof s);
    s.graph = graph;
    graph->lowered = 0;
    TL_TRY(tl_nav_dijkstra_init(allocator, graph, stage, &s.lengths));
    uint32_t *stack = tl_allocate_array(allocator, graph->vertex_room, sizeof *stack);
    s.component = tl_allocate_array(allocator, graph->vertex_room, sizeof *s.component);
    s.source = tl_allocate_array(allocator, graph->vertex_room, sizeof *s.source);
    s.nearest = tl_allocate_array(allocator, graph->vertex_room, sizeof *s.nearest);
    const bool fits = stack != NULL && s.component != NULL && s.source != NULL && s.nearest != NULL;
    const tl_result result = fits ? measure_landmarks(&s, graph, stack) : TL_ERR_MEMORY;
    tl_nav_dijkstra_free(allocator, &s.lengths);
    tl_release_array(allocator, stack, graph->vertex_room, sizeof *stack);
    tl_release_array(allocator, s.component, graph->vertex_room, sizeof *s.component);
    tl_release_array(allocator, s.source, graph->vertex_room, sizeof *s.source);
    tl_release_array(allocator, s.nearest, graph->vertex_room, sizeof *s.nearest);
    return result;
}
