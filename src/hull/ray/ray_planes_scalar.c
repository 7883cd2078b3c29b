// SPDX-License-Identifier: MIT
//
// A ray against a hull's planes in plain C: the twin that the others are compared with, and the one for machines
// without them.

#include "hull/ray/hull_ray.h"

#include "base/exact_floats.h"

bool tl_ray_planes_scalar(const tl_hull *hull, const double origin[3], const double direction[3], double max_t,
                          double *t_out, uint32_t *face_out)
{
    double enter = 0.0, leave = max_t;
    uint32_t face = TL_NO_VERTEX;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f);
        const double *n = plane.normal;
        double depth = plane.offset - (n[0] * origin[0] + n[1] * origin[1] + n[2] * origin[2]);
        double slope = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
        if (depth < 0.0 && !(slope < 0.0)) {
            return false; // in front of the plane and not coming nearer
        }
        if (slope < 0.0 && depth / slope > enter) {
            enter = depth / slope;
            face = f;
        } else if (slope > 0.0 && depth / slope < leave) {
            leave = depth / slope;
        }
    }
    *t_out = enter;
    *face_out = face;
    return enter <= leave;
}
