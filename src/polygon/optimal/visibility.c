// SPDX-License-Identifier: MIT
//
// Visibility between the corners of an outline: from each corner a cone is pushed through the triangles that it sees.
// Source: Bungiu, Hemmer, Hershberger, Huang, Kroeller, "Efficient Computation of Visibility Polygons", 2014
// (triangular expansion).
//
// A triangulation is at hand anyway, each triangle that is entered costs two turns, and where corners coincide (bridges
// to holes) the triangles still say which side of the outline is meant. Testing each chord against each edge is O(n^3);
// the linear-time sweeps around a corner need an outline that does not touch itself.
//
// Corners come out in the order of the turning cone, which is their order along the outline. So the lists need no
// sorting, and the walk ends where it has come around to corner 0.

#include "polygon/optimal/visibility.h"

#include "base/assert.h"
#include "polygon/triangulate/triangulate.h"

#include <string.h>

// An edge that the cone between two corners leaves a triangle by; or, with edge TL_NO_EDGE, a corner to be listed.
typedef struct gate_edge {
    uint32_t edge;
    uint32_t low, high;
} gate_edge;

typedef struct viewer {
    const tl_lattice_point *points;
    const uint32_t *triangles;
    const uint32_t *twins;
    gate_edge *stack;
    uint32_t *to;
    uint64_t count, limit;
    uint64_t steps, max_steps;
} viewer;

static uint32_t opposite_corner(const viewer *v, uint32_t edge)
{
    return v->triangles[edge % 3 > 0 ? edge - 1 : edge + 2];
}

// Lists what is seen from `eye` through one edge of a triangle at it. False: too many.
static bool look_through(viewer *v, uint32_t eye, gate_edge gate)
{
    const tl_lattice_point p = v->points[eye];
    uint32_t depth = 0;
    v->stack[depth++] = gate;
    while (depth > 0) {
        gate_edge at = v->stack[--depth];
        if (at.edge == TL_NO_EDGE) {
            if (v->count == v->limit) {
                return false;
            }
            v->to[v->count++] = at.low;
            continue;
        }
        uint32_t twin = v->twins[at.edge];
        // Corners before the eye list this chord themselves; all behind an edge lie between its ends.
        if (twin == TL_NO_EDGE || v->triangles[at.edge] < eye) {
            continue;
        }
        if (v->steps++ == v->max_steps) {
            return false;
        }
        uint32_t apex = opposite_corner(v, twin);
        bool above_low = tl_turn(p, v->points[at.low], v->points[apex]) > 0;
        bool below_high = tl_turn(p, v->points[apex], v->points[at.high]) > 0;
        uint32_t early = tl_triangle_edge_next(twin);
        gate_edge late_gate = { tl_triangle_edge_next(early), above_low ? apex : at.low, at.high };
        gate_edge early_gate = { early, at.low, below_high ? apex : at.high };
        if (below_high) {
            v->stack[depth++] = late_gate;
        }
        if (above_low && below_high && apex > eye) {
            gate_edge seen = { TL_NO_EDGE, apex, 0 };
            v->stack[depth++] = seen;
        }
        if (above_low) {
            v->stack[depth++] = early_gate;
        }
    }
    return true;
}

// All that corner `eye` sees, triangle by triangle around it. `edge` starts at it and lies on the outline.
static bool look_from_corner(viewer *v, uint32_t eye, uint32_t edge)
{
    if (v->count == v->limit) {
        return false;
    }
    uint32_t last = v->triangles[tl_triangle_edge_next(edge)];
    v->to[v->count++] = last;
    while (edge != TL_NO_EDGE && last > eye) {
        uint32_t across = tl_triangle_edge_next(edge);
        uint32_t corner = v->triangles[tl_triangle_edge_next(across)];
        gate_edge gate = { across, last, corner };
        if (!look_through(v, eye, gate)) {
            return false;
        }
        if (corner > eye) {
            if (v->count == v->limit) {
                return false;
            }
            v->to[v->count++] = corner;
        }
        last = corner;
        edge = v->twins[tl_triangle_edge_next(across)];
    }
    return true;
}

tl_result tl_find_visibility(tl_arena *arena, const tl_triangulated_outline *outline, uint64_t max_chords,
                             tl_visibility *visibility_out, bool *found)
{
    const uint32_t count = outline->count;
    // Hidden corners cost a step without being listed; outlines with many of them per chord are given up as well.
    enum { STEPS_PER_CHORD = 8 };
    const uint64_t all_chords = (uint64_t)count * (count - 1) / 2;
    viewer v;
    memset(&v, 0, sizeof v);
    v.points = outline->points;
    v.triangles = outline->triangles;
    v.twins = outline->twins;
    v.limit = max_chords < all_chords ? max_chords : all_chords;
    v.max_steps = STEPS_PER_CHORD * max_chords;
    // Each triangle entered takes one place and leaves at most three.
    v.stack = TL_PUSH(arena, gate_edge, 2 * (uint64_t)count + 1);
    v.to = TL_PUSH(arena, uint32_t, v.limit);
    uint32_t *first = TL_PUSH(arena, uint32_t, (uint64_t)count + 1);
    uint32_t *outline_edge = TL_PUSH(arena, uint32_t, count);
    if (v.stack == NULL || v.to == NULL || first == NULL || outline_edge == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t edge = 0; edge < 3 * (count - 2); edge++) {
        if (outline->twins[edge] == TL_NO_EDGE) {
            outline_edge[outline->triangles[edge]] = edge;
        }
    }
    *found = true;
    for (uint32_t i = 0; i + 1 < count && *found; i++) {
        first[i] = (uint32_t)v.count;
        *found = look_from_corner(&v, i, outline_edge[i]);
    }
    if (*found) {
        first[count - 1] = first[count] = (uint32_t)v.count;
    }
    visibility_out->first = first;
    visibility_out->to = v.to;
    return TL_OK;
}
