// SPDX-License-Identifier: MIT
//
// Fills the hit of a triangle that ray_decide.c has found.

#include "soup/ray/ray_measure.h"

#include "soup/triangle/triangle_point.h"

#include <string.h>

void tl_ray_describe(const tl_ray_job *job, tl_ray_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->t = job->t;
    hit->triangle = job->triangle;
    hit->material = tl_soup_material(job->soup, job->triangle);
    hit->back = job->back;
    hit->u = job->u;
    hit->v = job->v;
    if (job->has_normal) {
        hit->normal = tl_ray_unit_normal(tl_f64x4_load(job->normal));
        return;
    }
    tl_vec3 corner[3];
    tl_leaf_view leaf = tl_view_leaf(job->leaf);
    tl_leaf_corners(&leaf, job->lane, corner);
    hit->normal = tl_triangle_normal(corner);
}
