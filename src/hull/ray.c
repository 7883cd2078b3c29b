// SPDX-License-Identifier: MIT
//
// Ray against a hull: the ray is clipped by every plane; what is left is the part inside.
// Source: Cyrus, Beck, Generalized Two- and Three-Dimensional Clipping, 1978. In double, so that neither the hull's
// distance from the origin nor the ray's length costs precision that a float result could show.

#include "hull/side_plane.h"

#include "base/assert.h"

#include <talus/hull.h>

bool tl_hull_cast_ray(const tl_hull *hull, tl_vec3 origin, tl_vec3 direction, float max_t, tl_hull_hit *hit_out)
{
    const tl_hull_plane *planes = tl_hull_planes(hull);
    double ox = (double)origin.x, oy = (double)origin.y, oz = (double)origin.z;
    double dx = (double)direction.x, dy = (double)direction.y, dz = (double)direction.z;
    double enter = 0.0, leave = (double)max_t;
    uint32_t face = TL_NO_VERTEX;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        const double *n = planes[f].normal;
        double height = n[0] * ox + n[1] * oy + n[2] * oz - planes[f].offset;
        double slope = n[0] * dx + n[1] * dy + n[2] * dz;
        if (slope < 0.0) {
            // Coming in: inside after t.
            if (height > -slope * enter) {
                enter = height / -slope;
                face = f;
            }
        } else if (height > 0.0) {
            return false;
        } else if (slope > 0.0 && -height < slope * leave) {
            leave = -height / slope;
        }
        if (enter > leave) {
            return false;
        }
    }
    if (hit_out != NULL) {
        hit_out->t = (float)enter;
        hit_out->face = face;
        hit_out->normal = face == TL_NO_VERTEX
                              ? tl_vec3_make(0.0f, 0.0f, 0.0f)
                              : tl_vec3_make((float)planes[face].normal[0], (float)planes[face].normal[1],
                                             (float)planes[face].normal[2]);
    }
    return true;
}

bool tl_hull_contains(const tl_hull *hull, tl_vec3 point)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(hull);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        // Corners of a face are strict, so any three in a row span its plane.
        const tl_hull_half_edge *h = &half_edges[tl_hull_faces(hull)[f].first];
        if (tl_orient3d(vertices[h[0].origin], vertices[h[1].origin], vertices[h[2].origin], point) > 0) {
            return false;
        }
    }
    return true;
}
