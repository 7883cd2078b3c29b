// SPDX-License-Identifier: MIT
//
// Choosing landmarks, and measuring the distances from them. A set of places has one in each connected component, each
// as far as possible from those of earlier sets.
//
// Sets are chosen some at a time, and tasks measure from all sets of a batch side by side. How far it is to those of
// the same batch is not known when they are chosen; the straight line stands for it, which is never longer.

#include "nav_query/mending/landmark_measure.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"
#include "math/tolerance.h"
#include "nav_query/mending/dijkstra.h"

#include <math.h>
#include <string.h>

enum { BATCH = 8 };

_Static_assert(TL_NAV_LANDMARKS % BATCH == 0, "batches are whole");

typedef struct landmark_spread {
    tl_nav_visibility_graph *graph;
    tl_nav_dijkstra_team team;
    uint32_t *component; // by corner vertex; UINT32_MAX: a free number
    uint32_t *sources;   // of a set after another: by component the corner vertex of the set
    uint32_t component_count;
    double *nearest; // by corner vertex: length to any set that was measured
    double *spaced;  // by corner vertex: the same, and as the crow flies to the sets of the batch
    double *lengths; // from a set after another: by corner vertex
} landmark_spread;

// Labels connected components, and lists the first vertex of each as a set.
static void find_components(landmark_spread *s, uint32_t *stack)
{
    const tl_nav_visibility_graph *graph = s->graph;
    memset(s->component, 0xff, graph->vertex_room * sizeof *s->component);
    for (uint32_t i = 0; i < graph->vertex_room; i++) {
        if (s->component[i] != UINT32_MAX || graph->vertices[i].turn == 0) {
            continue;
        }
        uint32_t depth = 0;
        s->sources[s->component_count] = i;
        s->component[i] = s->component_count;
        stack[depth++] = i;
        while (depth > 0) {
            const tl_nav_corner_vertex *vertex = &graph->vertices[stack[--depth]];
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

static void measure_set(uint32_t set, uint32_t worker, void *user)
{
    landmark_spread *s = user;
    const tl_nav_dijkstra *search =
        tl_nav_dijkstra_run(&s->team, worker, s->sources + (size_t)set * s->component_count, s->component_count);
    if (search != NULL) {
        memcpy(s->lengths + (size_t)set * s->graph->vertex_room, search->length,
               s->graph->vertex_room * sizeof *search->length);
    }
}

// The farthest vertex of each component from all sets so far.
static void choose_set(landmark_spread *s, uint32_t *sources)
{
    const tl_nav_visibility_graph *graph = s->graph;
    memset(sources, 0xff, s->component_count * sizeof *sources);
    for (uint32_t i = 0; i < graph->vertex_room; i++) {
        if (s->component[i] != UINT32_MAX) {
            uint32_t *source = &sources[s->component[i]];
            *source = *source == UINT32_MAX || s->spaced[i] > s->spaced[*source] ? i : *source;
        }
    }
    for (uint32_t i = 0; i < graph->vertex_room; i++) {
        if (s->component[i] != UINT32_MAX) {
            const tl_nav_corner_vertex *vertex = &graph->vertices[i],
                                       *source = &graph->vertices[sources[s->component[i]]];
            const double x = (double)source->x - (double)vertex->x, z = (double)source->z - (double)vertex->z;
            s->spaced[i] = tl_min_f64(s->spaced[i], sqrt(x * x + z * z));
        }
    }
}

// Keeps the distances from a batch of landmarks, whose first is `first`. Returns the longest.
static double keep_distances(landmark_spread *s, uint32_t first)
{
    const size_t room = s->graph->vertex_room;
    double longest = 0.0;
    for (uint32_t i = 0; i < room; i++) {
        // The first sets were chosen for their distance from some corner vertex, which is no landmark.
        double nearest = first == 0 ? (double)INFINITY : s->nearest[i];
        for (uint32_t k = 0; k < BATCH && s->component[i] != UINT32_MAX; k++) {
            const double length = s->lengths[k * room + i];
            s->graph->landmarks[i][first + k] = (float)(TL_NAV_LANDMARK_SCALE * length);
            longest = tl_max_f64(longest, length);
            nearest = tl_min_f64(nearest, length);
        }
        s->nearest[i] = nearest;
    }
    return longest;
}

static tl_result measure_landmarks(landmark_spread *s, uint32_t *stack)
{
    const size_t room = s->graph->vertex_room;
    double longest = 0.0;
    find_components(s, stack);
    measure_set(0, 0, s);
    TL_TRY(tl_nav_dijkstra_result(&s->team));
    memcpy(s->nearest, s->lengths, room * sizeof *s->nearest);
    for (uint32_t first = 0; first < TL_NAV_LANDMARKS; first += BATCH) {
        memcpy(s->spaced, s->nearest, room * sizeof *s->spaced);
        for (uint32_t k = 0; k < BATCH; k++) {
            choose_set(s, s->sources + (size_t)k * s->component_count);
        }
        TL_TRY(tl_stage_run(s->team.stage, measure_set, BATCH, s, 1, BATCH));
        TL_TRY(tl_nav_dijkstra_result(&s->team));
        longest = tl_max_f64(longest, keep_distances(s, first));
    }
    // Two landmark lengths are rounded, and their difference.
    s->graph->landmark_error = TL_FLOAT_GAMMA(4) * (float)longest;
    return tl_stage_end(s->team.stage);
}

tl_result tl_nav_measure_landmarks(const tl_allocator *allocator, tl_nav_visibility_graph *graph, tl_stage *stage)
{
    const uint64_t room = graph->vertex_room;
    landmark_spread s;
    memset(&s, 0, sizeof s);
    s.graph = graph;
    graph->lowered = 0;
    TL_TRY(tl_nav_dijkstra_begin(allocator, graph, stage, &s.team));
    uint32_t *stack = tl_allocate_array(allocator, room, sizeof *stack);
    s.component = tl_allocate_array(allocator, room, sizeof *s.component);
    s.sources = tl_allocate_array(allocator, BATCH * room, sizeof *s.sources);
    s.nearest = tl_allocate_array(allocator, room, sizeof *s.nearest);
    s.spaced = tl_allocate_array(allocator, room, sizeof *s.spaced);
    s.lengths = tl_allocate_array(allocator, BATCH * room, sizeof *s.lengths);
    const bool fits = stack != NULL && s.component != NULL && s.sources != NULL && s.nearest != NULL &&
                      s.spaced != NULL && s.lengths != NULL;
    const tl_result result = fits ? measure_landmarks(&s, stack) : TL_ERR_MEMORY;
    tl_nav_dijkstra_end(&s.team);
    tl_release_array(allocator, stack, room, sizeof *stack);
    tl_release_array(allocator, s.component, room, sizeof *s.component);
    tl_release_array(allocator, s.sources, BATCH * room, sizeof *s.sources);
    tl_release_array(allocator, s.nearest, room, sizeof *s.nearest);
    tl_release_array(allocator, s.spaced, room, sizeof *s.spaced);
    tl_release_array(allocator, s.lengths, BATCH * room, sizeof *s.lengths);
    return result;
}
