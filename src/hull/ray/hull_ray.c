// SPDX-License-Identifier: MIT
//
// Ray against a hull: every plane clips the ray; what is left is the part inside. The kernel is in ray_planes.inl.
// Source: Cyrus, Beck, Generalized Two- and Three-Dimensional Clipping, 1978. In double, so that neither the hull's
// distance from the origin nor the ray's length costs precision that a float result could show.

#include "hull/ray/hull_ray.h"

#include "base/assert.h"
#include "math/predicates.h"

tl_ray_planes_fn *tl_ray_planes_for(int level)
{
    static tl_ray_planes_fn *const kernels[] = {
        tl_ray_planes_scalar,
#if TL_CPU_LEVELS >= 1
        tl_ray_planes_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_ray_planes_avx2,
        tl_ray_planes_avx512,
#endif
    };
    return tl_cpu_has_level(level) ? kernels[level] : NULL;
}

bool tl_hull_clip_ray(const tl_hull *hull, const double origin[3], const double direction[3], double max_t,
                      double *t_out, uint32_t *face_out)
{
    TL_ASSERT(hull != NULL && t_out != NULL && face_out != NULL);
    return tl_ray_planes_for(tl_cpu_level_up_to(TL_CPU_LEVELS))(hull, origin, direction, max_t, t_out, face_out);
}

bool tl_hull_cast_ray(const tl_hull *hull, tl_vec3 origin, tl_vec3 direction, float max_t, tl_hull_hit *hit_out)
{
    TL_ASSERT(hull != NULL);
    const double from[3] = { (double)origin.x, (double)origin.y, (double)origin.z };
    const double along[3] = { (double)direction.x, (double)direction.y, (double)direction.z };
    double t;
    uint32_t face;
    if (!tl_hull_clip_ray(hull, from, along, (double)max_t, &t, &face)) {
        return false;
    }
    if (hit_out != NULL) {
        hit_out->t = (float)t;
        hit_out->face = face;
        hit_out->normal = tl_vec3_make(0.0f, 0.0f, 0.0f);
        if (face != TL_NO_VERTEX) {
            tl_hull_plane plane = tl_hull_face_plane(hull, face);
            hit_out->normal = tl_vec3_make((float)plane.normal[0], (float)plane.normal[1], (float)plane.normal[2]);
        }
    }
    return true;
}

// The corners of merged faces do not span their planes.
static bool lies_behind_all_planes(const tl_hull *hull, tl_vec3 point)
{
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f);
        if (plane.normal[0] * (double)point.x + plane.normal[1] * (double)point.y + plane.normal[2] * (double)point.z >
            plane.offset) {
            return false;
        }
    }
    return true;
}

bool tl_hull_contains(const tl_hull *hull, tl_vec3 point)
{
    TL_ASSERT(hull != NULL);
    if (hull->merge_distance > 0.0f) {
        return lies_behind_all_planes(hull, point);
    }
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        // Corners of a face are strict, so any three in a row span its plane.
        const uint32_t h = tl_hull_face_first(hull, f);
        if (tl_orient3d(vertices[tl_hull_edge_origin(hull, h)], vertices[tl_hull_edge_origin(hull, h + 1)],
                        vertices[tl_hull_edge_origin(hull, h + 2)], point) > 0) {
            return false;
        }
    }
    return true;
}
