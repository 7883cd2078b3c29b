// SPDX-License-Identifier: MIT
//
// The simplex that GJK walks with: at most four points of A - B, and the point of their hull nearest to the origin.

#ifndef TALUS_SRC_CONVEX_SIMPLEX_H
#define TALUS_SRC_CONVEX_SIMPLEX_H

#include "convex/core/minkowski.h"

typedef struct tl_simplex {
    uint32_t count; // 1 .. 4
    tl_minkowski_point points[4];
    double weights[4]; // of the nearest point; >= 0, sum 1
} tl_simplex;

// The point of a simplex nearest to the origin, and the points that carry it, in ascending order.
typedef struct tl_simplex_point {
    tl_vec3d point;
    double distance_sq;
    double weight[4];
    uint32_t index[4];
    uint32_t count; // 4: the origin is inside, and the point zero
} tl_simplex_point;

void tl_simplex_solve(const tl_simplex *simplex, tl_simplex_point *nearest_out);

// The same among the points that the last one has a part in. When the nearest point of the others is known, one that
// is nearer can only be here.
void tl_simplex_solve_last(const tl_simplex *simplex, tl_simplex_point *nearest_out);

// Cuts the simplex down to what carries the point, and sets the weights.
void tl_simplex_keep(tl_simplex *simplex, const tl_simplex_point *nearest);

// Both. Cuts the simplex down to the points that carry its nearest point, sets their weights and returns that point.
// When the origin lies inside of four points all stay, and the result is zero.
tl_vec3d tl_simplex_nearest(tl_simplex *simplex);

static inline bool tl_simplex_holds(const tl_simplex *simplex, const tl_minkowski_point *point)
{
    for (uint32_t i = 0; i < simplex->count; i++) {
        const tl_vec3d *w = &simplex->points[i].w;
        if (w->x == point->w.x && w->y == point->w.y && w->z == point->w.z) {
            return true;
        }
    }
    return false;
}

// The points of A and of B whose difference is the nearest point, by its weights.
void tl_simplex_witness(const tl_simplex *simplex, tl_vec3d *on_a_out, tl_vec3d *on_b_out);

#endif
