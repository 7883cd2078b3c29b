// SPDX-License-Identifier: MIT
//
// Whether a line crosses a triangle, so that every passage through a surface counts once.
//
// A line through an edge meets both of its triangles, and through a corner all of its fan, so the number of triangles
// met is not the number of crossings. Simulation of simplicity answers: the line is moved by an infinitesimal step
// along x, then by a smaller one along y, then z, so that it passes through no edge. The sidedness of an edge a, b is
// det(d, a - o, b - o); the step e changes it by e . (d x (b - a)), so where it is zero, the first component of
// d x (b - a) that is not zero has its sign. All are zero only for edges along the line, whose triangles are seen
// edge-on and cannot be hit. The sign belongs to the edge, not to the triangle: so the moved line crosses every closed
// surface an even number of times, exactly, whatever the line passed through.
//
// Source: Edelsbrunner, Mucke, Simulation of Simplicity, 1990.

#include "soup/triangle/line_triangle.h"

#include "math/predicates.h"

// The side of an edge on which the moved line passes; 0 only for an edge along the line.
static int moved_side(tl_vec3 origin, tl_vec3 d, tl_vec3 a, tl_vec3 b)
{
    int side = tl_line_side(origin, d, a, b);
    side = side != 0 ? side : tl_compare_along(tl_vec3_make(0.0f, -d.z, d.y), b, a);
    side = side != 0 ? side : tl_compare_along(tl_vec3_make(d.z, 0.0f, -d.x), b, a);
    return side != 0 ? side : tl_compare_along(tl_vec3_make(-d.y, d.x, 0.0f), b, a);
}

bool tl_moved_line_crosses(tl_vec3 origin, tl_vec3 direction, const tl_vec3 corners[3])
{
    int first = moved_side(origin, direction, corners[0], corners[1]);
    return first != 0 && first == moved_side(origin, direction, corners[1], corners[2]) &&
           first == moved_side(origin, direction, corners[2], corners[0]);
}
