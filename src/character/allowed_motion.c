// SPDX-License-Identifier: MIT
//
// The nearest point of a polyhedron, by increments: the answer for the first planes serves until a plane forbids it;
// then the answer lies on that plane, and the same is asked there with one dimension less. Linear for random orders, at
// worst cubic in the planes, of which a character has few.
//
// Quake clips the motion at one plane after the other, and at the crease of a pair; three planes that meet then stop
// it, or throw it from one to the next (jitter in acute corners). A relaxation over the planes (Box2D, Box3D)
// approaches the answer from outside. This is the answer itself; and the nearest point of a cone never points against
// the wish (Moreau 1962), so a character that is pushed into a corner has no way back out of it.
//
// Source: Seidel, Small-Dimensional Linear Programming and Convex Hulls Made Easy, 1991; Sharir and Welzl, 1992, for
// quadratic goals.

#include "character/allowed_motion.h"

// Planes whose normals' sine is below this are parallel: the line where they meet is farther away than motions are
// long.
#define PARALLEL_SINE_SQ 1e-12

typedef struct motion_problem {
    const tl_mover_plane *planes;
    tl_vec3d wish;
    double slack;
} motion_problem;

static double lacking(const tl_mover_plane *plane, tl_vec3d at)
{
    return plane->least - tl_vec3d_dot(plane->normal, at);
}

// On the line at + t * along, with the first `count` planes.
static bool nearest_on_line(const motion_problem *p, uint32_t count, tl_vec3d at, tl_vec3d along, tl_vec3d *best)
{
    double low = -(double)INFINITY, high = (double)INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double slope = tl_vec3d_dot(p->planes[i].normal, along), lacks = lacking(&p->planes[i], at);
        if (slope * slope < PARALLEL_SINE_SQ) {
            if (lacks > p->slack) {
                return false;
            }
        } else if (slope > 0.0) {
            low = lacks / slope > low ? lacks / slope : low;
        } else {
            high = lacks / slope < high ? lacks / slope : high;
        }
    }
    double t = tl_vec3d_dot(tl_vec3d_sub(p->wish, at), along);
    if (low - high > p->slack) {
        return false;
    }
    t = t < low ? low : t;
    t = t > high ? high : t;
    *best = tl_vec3d_mul_add(at, along, t);
    return true;
}

// On the plane number `count`, with the planes before it.
static bool nearest_on_plane(const motion_problem *p, uint32_t count, tl_vec3d *best)
{
    const tl_mover_plane *on = &p->planes[count];
    tl_vec3d at = tl_vec3d_mul_add(p->wish, on->normal, lacking(on, p->wish));
    *best = at;
    for (uint32_t i = 0; i < count; i++) {
        const tl_mover_plane *plane = &p->planes[i];
        double lacks = lacking(plane, *best);
        if (lacks <= p->slack) {
            continue;
        }
        // Within the first plane, towards the other.
        double cosine = tl_vec3d_dot(plane->normal, on->normal);
        tl_vec3d towards = tl_vec3d_mul_add(plane->normal, on->normal, -cosine);
        double sine_sq = tl_vec3d_dot(towards, towards);
        if (sine_sq < PARALLEL_SINE_SQ) {
            return false;
        }
        tl_vec3d along = tl_vec3d_cross(on->normal, plane->normal);
        along = tl_vec3d_scale(along, 1.0 / tl_vec3d_length(along));
        tl_vec3d meets = tl_vec3d_mul_add(at, towards, lacking(plane, at) / sine_sq);
        if (!nearest_on_line(p, i, meets, along, best)) {
            return false;
        }
    }
    return true;
}

bool tl_allowed_motion(const tl_mover_plane *planes, uint32_t count, tl_vec3d wish, double slack, tl_vec3d *motion_out)
{
    motion_problem p = { planes, wish, slack };
    *motion_out = wish;
    for (uint32_t i = 0; i < count; i++) {
        if (lacking(&planes[i], *motion_out) > slack && !nearest_on_plane(&p, i, motion_out)) {
            return false;
        }
    }
    return true;
}
