// SPDX-License-Identifier: MIT
//
// What is reported of a hit that ray_decide.c has found.

#include "soup/ray.h"

#include "soup/triangle_point.h"

#include <string.h>

void tl_ray_describe(const tl_ray_job *job, tl_ray_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->t = job->t;
    hit->triangle = job->triangle;
    hit->material = tl_soup_material(job->soup, job->triangle);
    hit->back = job->back;
    double sum = job->weight[0] + job->weight[1] + job->weight[2];
    // A needle seen edge-on may have weights that all vanish in double: then the hit is anywhere on it.
    double scale = sum != 0.0 ? 1.0 / sum : 0.0;
    hit->u = (float)(job->weight[1] * scale);
    hit->v = (float)(job->weight[2] * scale);
    tl_vec3 corner[3];
    tl_leaf_view leaf = tl_view_leaf(job->leaf);
    tl_leaf_corners(&leaf, job->lane, corner);
    hit->normal = tl_triangle_normal(corner);
}
