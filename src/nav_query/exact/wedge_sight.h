// SPDX-License-Identifier: MIT
//
// What a wedge of the exact search sees: directions from its root, and on which side of its borders a vertex lies. All
// signs are taken from the differences of float coordinates in double; a sign that rounding could have turned is none.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_SIGHT_H
#define TALUS_SRC_NAV_QUERY_WEDGE_SIGHT_H

#include "math/simd2d.h"
#include "math/tolerance.h"
#include "nav_query/exact/shortest_search.h"
#include "nav_query/navmesh/rings.h"

#include <math.h>

// A vertex counts as on a line when it is no farther from it than rounding its coordinates to float may have moved the
// three points, as a share of the largest coordinate.
#define TL_NAV_ON_LINE ((double)TL_FLOAT_GAMMA(6))

// An edge as it is seen from a root: its ends relative to it.
typedef struct seen_edge {
    tl_nav_direction right, left;
} seen_edge;

static inline double wedge_cross(tl_nav_direction a, tl_nav_direction b)
{
    return a.x * b.z - a.z * b.x;
}

// The sign of the cross product; 0 within its own rounding: < 0 when b lies left of a.
static inline double side_of_direction(tl_nav_direction a, tl_nav_direction b)
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

static inline bool is_open_direction(tl_nav_direction d)
{
    return d.x == 0.0 && d.z == 0.0;
}

// Where the ray from the root along `d` meets the line through a and b (relative to the root).
static inline tl_nav_direction meet_edge_line(tl_nav_direction d, tl_nav_direction a, tl_nav_direction b)
{
    tl_nav_direction e = { b.x - a.x, b.z - a.z };
    double across = wedge_cross(d, e);
    double t = across != 0.0 ? wedge_cross(a, e) / across : 0.0;
    tl_nav_direction point = { t * d.x, t * d.z };
    return point;
}

// Metres from the root through the part of the edge between two directions to the goal, at least.
static inline double min_length_through(const seen_edge *edge, tl_nav_direction left, tl_nav_direction right,
                                        tl_nav_direction goal)
{
    tl_nav_direction along = { edge->left.x - edge->right.x, edge->left.z - edge->right.z };
    tl_nav_direction from_edge = { goal.x - edge->right.x, goal.z - edge->right.z };
    double beyond =
        wedge_cross(along, from_edge); // > 0: on the far side, right of the edge from its right end to its left
    if (beyond < 0.0) {
        double scale = 2.0 * beyond / (along.x * along.x + along.z * along.z);
        goal.x += scale * along.z;
        goal.z -= scale * along.x;
    }
    bool is_left_of = wedge_cross(left, goal) < 0.0;
    if (!is_left_of && !(wedge_cross(right, goal) > 0.0)) {
        return length_of(goal);
    }
    tl_nav_direction limit = is_left_of ? left : right;
    tl_nav_direction vertex = is_left_of ? edge->left : edge->right;
    tl_nav_direction via =
        limit.x == vertex.x && limit.z == vertex.z ? vertex : meet_edge_line(limit, edge->right, edge->left);
    tl_nav_direction rest = { goal.x - via.x, goal.z - via.z };
    return length_of(via) + length_of(rest);
}

// Whether a path that comes along `d` to a vertex has its walls on one hand (1 left, -1 right), so that a shortest one
// may turn to that hand there. Directions of walls are floats. `rounding`: TL_NAV_ON_LINE times the largest coordinate.
static inline bool may_turn(const tl_nav_ring_walls *walls, tl_nav_direction d, int hand, double rounding)
{
    const tl_nav_direction first = { (double)walls->first_x, (double)walls->first_z };
    const tl_nav_direction last = { (double)walls->last_x, (double)walls->last_z };
    double size = fabs(d.x) + fabs(d.z);
    return hand * wedge_cross(d, first) <= 2.0 * rounding * (size + fabs(first.x) + fabs(first.z)) &&
           hand * wedge_cross(d, last) <= 2.0 * rounding * (size + fabs(last.x) + fabs(last.z));
}

// A vertex as a wedge sees it: which of its limits it lies clearly left of, which clearly right of, as bits. Neither:
// on it within rounding.
typedef struct seen_vertex {
    tl_nav_direction at;
    uint32_t left_of, right_of;
} seen_vertex;

#define LEFT_LIMIT  1u
#define RIGHT_LIMIT 2u

// What a wedge compares vertices with: both limits side by side, the left one first.
typedef struct wedge_view {
    double root_x, root_z;
    double x[2], z[2];
    double error[2];                      // rounding of a cross product, as a share of the vertex's coordinates
    uint32_t open_left_of, open_right_of; // open limits: all lies right of a left one, and left of a right one
} wedge_view;

static inline wedge_view make_view(const tl_nav_wedge *wedge)
{
    const tl_nav_direction left = wedge->left, right = wedge->right;
    wedge_view view = { (double)wedge->root_x,
                        (double)wedge->root_z,
                        { left.x, right.x },
                        { left.z, right.z },
                        { TL_CROSS_ERROR * (fabs(left.x) + fabs(left.z)),
                          TL_CROSS_ERROR * (fabs(right.x) + fabs(right.z)) },
                        is_open_direction(right) ? RIGHT_LIMIT : 0,
                        is_open_direction(left) ? LEFT_LIMIT : 0 };
    return view;
}

static inline seen_vertex look_at(const wedge_view *view, const tl_vec3 *vertex)
{
    seen_vertex seen;
    seen.at.x = (double)vertex->x - view->root_x;
    seen.at.z = (double)vertex->z - view->root_z;
    const double size = fabs(seen.at.x) + fabs(seen.at.z);
#if TL_HAS_F64X2
    const tl_f64x2 turn = tl_f64x2_sub(tl_f64x2_mul(tl_f64x2_load(view->x), tl_f64x2_all(seen.at.z)),
                                       tl_f64x2_mul(tl_f64x2_load(view->z), tl_f64x2_all(seen.at.x)));
    const tl_f64x2 error = tl_f64x2_mul(tl_f64x2_load(view->error), tl_f64x2_all(size));
    const tl_f64x2 back = tl_f64x2_sub(tl_f64x2_all(0.0), turn);
    seen.left_of = tl_f64x2_masks(tl_f64x2_where_less(error, back)) | view->open_left_of;
    seen.right_of = tl_f64x2_masks(tl_f64x2_where_less(error, turn)) | view->open_right_of;
#else
    seen.left_of = view->open_left_of;
    seen.right_of = view->open_right_of;
    for (uint32_t i = 0; i < 2; i++) {
        const double turn = view->x[i] * seen.at.z - view->z[i] * seen.at.x;
        const double error = view->error[i] * size;
        seen.left_of |= (uint32_t)(turn < -error) << i;
        seen.right_of |= (uint32_t)(turn > error) << i;
    }
#endif
    return seen;
}

#endif
