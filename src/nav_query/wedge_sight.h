// SPDX-License-Identifier: MIT
//
// What a wedge of the exact search sees: directions from its root, and on which side of its borders a vertex lies. All
// signs are taken from the differences of float coordinates in double; a sign that rounding could have turned is none.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_SIGHT_H
#define TALUS_SRC_NAV_QUERY_WEDGE_SIGHT_H

#include "math/tolerance.h"
#include "nav_query/rings.h"
#include "nav_query/shortest_search.h"

#include <math.h>

// An edge as it is seen from a root: its ends relative to it.
typedef struct seen_edge {
    tl_nav_direction right, left;
} seen_edge;

static inline double cross(tl_nav_direction a, tl_nav_direction b)
{
    return a.x * b.z - a.z * b.x;
}

// The sign of the cross product; 0 within its own rounding: < 0 when b lies left of a.
static inline double side(tl_nav_direction a, tl_nav_direction b)
{
    double p = a.x * b.z;
    double q = a.z * b.x;
    double turn = p - q;
    return fabs(turn) <= TL_CROSS_ERROR * (fabs(p) + fabs(q)) ? 0.0 : turn;
}

static inline double length_of(tl_nav_direction d)
{
    return sqrt(d.x * d.x + d.z * d.z);
}

static inline bool is_open(tl_nav_direction d)
{
    return d.x == 0.0 && d.z == 0.0;
}

// Where the ray from the root along `d` meets the line through a and b (relative to the root).
static inline tl_nav_direction meet(tl_nav_direction d, tl_nav_direction a, tl_nav_direction b)
{
    tl_nav_direction e = { b.x - a.x, b.z - a.z };
    double across = cross(d, e);
    double t = across != 0.0 ? cross(a, e) / across : 0.0;
    tl_nav_direction point = { t * d.x, t * d.z };
    return point;
}

// A vertex as a wedge sees it.
typedef struct seen_vertex {
    tl_nav_direction at;
    bool left_of_left, right_of_left;   // limit; neither: on it within rounding
    bool left_of_right, right_of_right; // limit
} seen_vertex;

// What a wedge compares vertices with.
typedef struct wedge_view {
    tl_nav_direction left, right;
    double root_x, root_z;
    double left_error, right_error; // rounding of a cross product, as a share of the vertex's coordinates
    bool left_open, right_open;
} wedge_view;

static inline wedge_view make_view(const tl_nav_wedge *wedge)
{
    wedge_view view = { wedge->left,
                        wedge->right,
                        (double)wedge->root_x,
                        (double)wedge->root_z,
                        TL_CROSS_ERROR * (fabs(wedge->left.x) + fabs(wedge->left.z)),
                        TL_CROSS_ERROR * (fabs(wedge->right.x) + fabs(wedge->right.z)),
                        is_open(wedge->left),
                        is_open(wedge->right) };
    return view;
}

static inline seen_vertex look_at(const wedge_view *view, const tl_nav_ring_edge *vertex)
{
    seen_vertex seen;
    seen.at.x = (double)vertex->x - view->root_x;
    seen.at.z = (double)vertex->z - view->root_z;
    double size = fabs(seen.at.x) + fabs(seen.at.z);
    double to_left = cross(view->left, seen.at);
    double to_right = cross(view->right, seen.at);
    double left_error = view->left_error * size;
    double right_error = view->right_error * size;
    seen.left_of_left = to_left < -left_error;
    seen.right_of_left = to_left > left_error || view->left_open;
    seen.left_of_right = to_right < -right_error || view->right_open;
    seen.right_of_right = to_right > right_error;
    return seen;
}

#endif
