// SPDX-License-Identifier: MIT
//
// What every processor of the target can run.

#include "convex/core/placed_pair.h"

#include "convex/core/farthest.h"

static void place(tl_placed_hull *hull, uint32_t at, tl_vec3d p)
{
    hull->x[at] = p.x;
    hull->y[at] = p.y;
    hull->z[at] = p.z;
}

void tl_placed_pair_set_base(tl_placed_pair *pair, tl_vertex_row a, tl_vertex_row b, const tl_frame *b_to_a)
{
    pair->a.spare = 8 - a.count;
    pair->b.spare = 8 - b.count;
    for (uint32_t i = 0; i < 8; i++) {
        place(&pair->a, i, tl_vec3d_from(a.points[tl_placed_vertex(&pair->a, i)]));
        place(&pair->b, i, tl_frame_point(b_to_a, tl_vec3d_from(b.points[tl_placed_vertex(&pair->b, i)])));
    }
}

static uint32_t farthest_place(const tl_placed_hull *hull, double x, double y, double z)
{
    uint32_t best = 0;
    double most = 0.0;
    for (uint32_t i = 0; i < 8; i++) {
        const double dot = x * hull->x[i] + y * hull->y[i] + z * hull->z[i];
        const bool farther = i == 0 || dot > most;
        best = farther ? i : best;
        most = farther ? dot : most;
    }
    return best;
}

uint32_t tl_placed_pair_support_base(const tl_placed_pair *pair, double x, double y, double z)
{
    return farthest_place(&pair->a, x, y, z) << 3 | farthest_place(&pair->b, -x, -y, -z);
}
