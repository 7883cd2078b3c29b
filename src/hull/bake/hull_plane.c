// SPDX-License-Identifier: MIT
//
// The plane of a face: bake and check fit it by the same steps, so that the check can compare bits.

#include "hull/bake/hull_polygons.h"
#include "math/predicates.h"
#include "math/tolerance.h"
#include "math/vec3d.h"

// A plane's normal is right to this share of its length: 2^-45, which is what tl_area2d promises. At the far end of a
// face as large as the hull the plane is then off by some 3e-14 of the size.
#define TL_NORMAL_ERROR 2.8421709430404007e-14

// Twice the area's vector of a triangle, (b - a) x (c - a), to within TL_NORMAL_ERROR of its length. A face may be
// thinner than double rounding: then the digits are summed exactly.
static tl_vec3d normal_of(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    tl_vec3d u = tl_vec3d_sub(tl_vec3d_from(b), tl_vec3d_from(a));
    tl_vec3d v = tl_vec3d_sub(tl_vec3d_from(c), tl_vec3d_from(a));
    tl_vec3d n = tl_vec3d_cross(u, v);
    double products =
        fabs(u.y * v.z) + fabs(u.z * v.y) + fabs(u.z * v.x) + fabs(u.x * v.z) + fabs(u.x * v.y) + fabs(u.y * v.x);
    if (TL_CROSS_ERROR * products <= TL_NORMAL_ERROR * (fabs(n.x) + fabs(n.y) + fabs(n.z))) {
        return n;
    }
    return tl_vec3d_make(tl_area2d(a.y, a.z, b.y, b.z, c.y, c.z), tl_area2d(a.z, a.x, b.z, b.x, c.z, c.x),
                         tl_area2d(a.x, a.y, b.x, b.y, c.x, c.y));
}

tl_hull_loop tl_hull_loop_of(const tl_hull *hull, uint32_t face)
{
    const tl_hull_face f = tl_hull_face_at(hull, face);
    const uint32_t bytes = hull->index_bytes, stride = 3 * bytes;
    const char *words = (const char *)(tl_hull_vertices(hull) + hull->vertex_count);
    const tl_hull_loop loop = { tl_hull_vertices(hull), words + (size_t)f.first * stride, bytes, stride, f.count };
    return loop;
}

static tl_vec3 loop_corner(const tl_hull_loop *loop, uint32_t k)
{
    const void *word = loop->words + (size_t)k * loop->stride;
    return loop->vertices[loop->word_bytes == 1   ? *(const uint8_t *)word
                          : loop->word_bytes == 2 ? *(const uint16_t *)word
                                                  : *(const uint32_t *)word];
}

// The fan triangle with the largest area spans the plane best.
static uint32_t largest_of_fan(const tl_hull_loop *loop)
{
    const tl_vec3d a = tl_vec3d_from(loop_corner(loop, 0));
    uint32_t best = 1;
    double best_area = 0.0;
    for (uint32_t k = 1; k + 1 < loop->count; k++) {
        tl_vec3d u = tl_vec3d_sub(tl_vec3d_from(loop_corner(loop, k)), a);
        tl_vec3d v = tl_vec3d_sub(tl_vec3d_from(loop_corner(loop, k + 1)), a);
        tl_vec3d normal = tl_vec3d_cross(u, v);
        double area = tl_vec3d_dot(normal, normal);
        if (area > best_area) {
            best_area = area;
            best = k;
        }
    }
    return best;
}

tl_hull_plane tl_hull_fit_plane(tl_hull_loop loop)
{
    const bool is_triangle = loop.count == 3;
    const uint32_t best = is_triangle ? 1 : largest_of_fan(&loop);
    const tl_vec3 three[3] = { loop_corner(&loop, 0), loop_corner(&loop, best), loop_corner(&loop, best + 1) };
    tl_vec3d n = normal_of(three[0], three[1], three[2]);
    double length = tl_vec3d_length(n);
    tl_hull_plane plane = { { n.x / length, n.y / length, n.z / length }, -(double)INFINITY };
    for (uint32_t k = 0; k < loop.count; k++) {
        tl_vec3 p = is_triangle ? three[k] : loop_corner(&loop, k);
        double offset = plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y + plane.normal[2] * (double)p.z;
        plane.offset = offset > plane.offset ? offset : plane.offset;
    }
    return plane;
}

static bool has_flat_neighbour(const tl_hull *hull, uint32_t face, double gap)
{
    const tl_hull_plane plane = tl_hull_face_plane(hull, face);
    const tl_hull_face f = tl_hull_face_at(hull, face);
    for (uint32_t k = 0; k < f.count; k++) {
        const uint32_t twin = tl_hull_edge_twin(hull, f.first + k);
        const tl_hull_face beside = tl_hull_face_at(hull, tl_hull_edge_face(hull, twin));
        const uint32_t off = twin + 2 < beside.first + beside.count ? twin + 2 : twin + 2 - beside.count;
        const tl_vec3 p = tl_hull_vertices(hull)[tl_hull_edge_origin(hull, off)];
        const double *n = plane.normal;
        if (n[0] * (double)p.x + n[1] * (double)p.y + n[2] * (double)p.z - plane.offset >= -gap) {
            return true;
        }
    }
    return false;
}

bool tl_hull_has_sides(const tl_hull *hull)
{
    const tl_vec3 size = tl_max(tl_abs(hull->bounds.min), tl_abs(hull->bounds.max));
    const double gap = TL_HULL_SIDE_GAP * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    for (uint32_t f = 0; f < hull->face_count; f++) {
        if (has_flat_neighbour(hull, f, gap)) {
            return true;
        }
    }
    return false;
}
