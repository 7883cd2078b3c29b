// SPDX-License-Identifier: MIT
//
// How well shaped are a mesh's polygons?
//
// Angles are given as cosines: they need no trigonometric function, which differs between C libraries, and order as
// angles do.

#include "base/assert.h"
#include <talus/polygon.h>

#include "polygon/check/polygon_check.h"

#include <math.h>
#include <string.h>

static double cosine_at(tl_lattice_point before, tl_lattice_point corner, tl_lattice_point after)
{
    double length2 = (double)tl_distance2(corner, before) * (double)tl_distance2(corner, after);
    return (double)tl_dot2(corner, before, after) / sqrt(length2);
}

// The extents along and across the longest edge, whichever is larger by the other. Both are in units of 1 / length.
static double aspect_of(const tl_polygon_mesh *mesh, uint32_t p)
{
    uint32_t longest = mesh->first[p];
    int64_t longest2 = 0;
    for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
        int64_t length2 = tl_distance2(tl_mesh_corner(mesh, k), tl_mesh_corner(mesh, tl_mesh_next(mesh, p, k)));
        longest = length2 > longest2 ? k : longest;
        longest2 = length2 > longest2 ? length2 : longest2;
    }
    tl_lattice_point a = tl_mesh_corner(mesh, longest);
    tl_lattice_point b = tl_mesh_corner(mesh, tl_mesh_next(mesh, p, longest));
    int64_t low = 0, high = 0, across = 0;
    for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
        tl_lattice_point c = tl_mesh_corner(mesh, k);
        int64_t along = tl_dot2(a, b, c);
        int64_t away = tl_turn(a, b, c);
        low = along < low ? along : low;
        high = along > high ? along : high;
        across = away > across ? away : across;
    }
    double ratio = (double)(high - low) / (double)across;
    return ratio < 1.0 ? 1.0 / ratio : ratio;
}

tl_polygon_quality tl_polygon_mesh_measure(const tl_polygon_mesh *mesh)
{
    TL_ASSERT(mesh != NULL);
    tl_polygon_quality q;
    memset(&q, 0, sizeof q);
    q.polygon_count = mesh->polygon_count;
    q.smallest_angle_cosine = -1.0;
    if (mesh->polygon_count == 0) {
        return q;
    }
    double cosines = 0.0, aspects = 0.0;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        uint32_t corners = mesh->first[p + 1] - mesh->first[p];
        q.max_corners = corners > q.max_corners ? corners : q.max_corners;
        double sharpest = -1.0;
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            uint32_t next = tl_mesh_next(mesh, p, k);
            double cosine = cosine_at(tl_mesh_corner(mesh, k), tl_mesh_corner(mesh, next),
                                      tl_mesh_corner(mesh, tl_mesh_next(mesh, p, next)));
            sharpest = cosine > sharpest ? cosine : sharpest;
        }
        double aspect = aspect_of(mesh, p);
        cosines += sharpest;
        aspects += aspect;
        q.smallest_angle_cosine = sharpest > q.smallest_angle_cosine ? sharpest : q.smallest_angle_cosine;
        q.worst_aspect = aspect > q.worst_aspect ? aspect : q.worst_aspect;
    }
    q.mean_corners = (double)mesh->index_count / mesh->polygon_count;
    q.mean_sharpest_cosine = cosines / mesh->polygon_count;
    q.mean_aspect = aspects / mesh->polygon_count;
    return q;
}
