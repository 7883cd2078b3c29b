// SPDX-License-Identifier: MIT
//
// The point of a simplex nearest to the origin.
//
// Each face of a tetrahedron that has the origin on its outer side, or that is too flat to say, is asked for its
// nearest point, and the nearest of these wins; a triangle is its plane's foot when that lies inside, else the best of
// its edges. That asks a little more than the one feature that Johnson's or Ericson's order of tests leads to, but no
// rounding can lead it to a wrong feature: it compares finished distances. Bad simplices, flat and needle-like, are
// what GJK ends with, so this is where its robustness is decided. Compare: Ericson, Real-Time Collision Detection, 5.1;
// Montanari, Petrinic, Barbieri, Improving the GJK Algorithm for Faster and More Reliable Distance Queries, 2017.

#include "convex/simplex.h"

#include "math/tolerance.h"

// A determinant of three differences has a relative error of less than 16 roundings of the product of their lengths.
#define VOLUME_ERROR TL_DOUBLE_GAMMA(16)

typedef tl_simplex_point candidate;

static candidate nearest_on_point(const tl_simplex *s, uint32_t i)
{
    tl_vec3d w = s->points[i].w;
    candidate c = { w, tl_vec3d_dot(w, w), 1, { i, 0, 0, 0 }, { 1.0, 0.0, 0.0, 0.0 } };
    return c;
}

static candidate nearest_on_segment(const tl_simplex *s, uint32_t i, uint32_t j)
{
    tl_vec3d a = s->points[i].w, b = s->points[j].w;
    tl_vec3d d = tl_vec3d_sub(b, a);
    double along = -tl_vec3d_dot(a, d), length_sq = tl_vec3d_dot(d, d);
    if (!(along > 0.0)) {
        return nearest_on_point(s, i);
    }
    if (!(along < length_sq)) {
        return nearest_on_point(s, j);
    }
    double t = along / length_sq;
    tl_vec3d p = tl_vec3d_mul_add(a, d, t);
    candidate c = { p, tl_vec3d_dot(p, p), 2, { i, j, 0, 0 }, { 1.0 - t, t, 0.0, 0.0 } };
    return c;
}

static candidate nearer(candidate a, candidate b)
{
    return b.distance_sq < a.distance_sq ? b : a;
}

static candidate nearest_on_triangle(const tl_simplex *s, uint32_t i, uint32_t j, uint32_t k)
{
    tl_vec3d a = s->points[i].w, b = s->points[j].w, c = s->points[k].w;
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double area_sq = tl_vec3d_dot(n, n);
    // Areas of the triangles that the foot of the origin makes with each edge, times the area.
    double u = tl_vec3d_dot(n, tl_vec3d_cross(b, c));
    double v = tl_vec3d_dot(n, tl_vec3d_cross(c, a));
    double w = tl_vec3d_dot(n, tl_vec3d_cross(a, b));
    if (u > 0.0 && v > 0.0 && w > 0.0 && area_sq > 0.0) {
        double sum = u + v + w;
        tl_vec3d foot = tl_vec3d_scale(n, tl_vec3d_dot(n, a) / area_sq);
        candidate inside = { foot, tl_vec3d_dot(foot, foot), 3, { i, j, k, 0 }, { u / sum, v / sum, w / sum, 0.0 } };
        return inside;
    }
    candidate best = nearest_on_segment(s, i, j);
    best = nearer(best, nearest_on_segment(s, j, k));
    return nearer(best, nearest_on_segment(s, i, k));
}

void tl_simplex_keep(tl_simplex *simplex, const tl_simplex_point *nearest)
{
    for (uint32_t i = 0; i < nearest->count; i++) {
        if (nearest->index[i] != i) { // ascending, so nothing is overwritten that is still wanted
            simplex->points[i] = simplex->points[nearest->index[i]];
        }
        simplex->weights[i] = nearest->weight[i];
    }
    simplex->count = nearest->count;
}

static double volume(tl_vec3d a, tl_vec3d b, tl_vec3d c)
{
    return tl_vec3d_dot(a, tl_vec3d_cross(b, c));
}

static candidate nearest_on_tetrahedron(const tl_simplex *simplex)
{
    // Ascending; turn says which look inward.
    static const uint32_t faces[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };
    static const double turn[4] = { 1.0, -1.0, 1.0, -1.0 };
    const tl_pair_point *p = simplex->points;
    tl_vec3d u = tl_vec3d_sub(p[1].w, p[0].w), v = tl_vec3d_sub(p[2].w, p[0].w), w = tl_vec3d_sub(p[3].w, p[0].w);
    double whole = volume(u, v, w);
    bool flat = fabs(whole) <= VOLUME_ERROR * tl_vec3d_length(u) * tl_vec3d_length(v) * tl_vec3d_length(w);
    double parts[4];
    bool outside = false;
    candidate best = nearest_on_point(simplex, 0);
    for (uint32_t f = 0; f < 4; f++) {
        // The volume of the origin with this face: of the sign of the whole where the origin is inside.
        parts[f] = turn[f] * volume(p[faces[f][0]].w, p[faces[f][1]].w, p[faces[f][2]].w);
        if (flat || !(whole > 0.0 ? parts[f] > 0.0 : parts[f] < 0.0)) {
            outside = true;
            best = nearer(best, nearest_on_triangle(simplex, faces[f][0], faces[f][1], faces[f][2]));
        }
    }
    if (outside) {
        return best;
    }
    double sum = parts[0] + parts[1] + parts[2] + parts[3];
    candidate inside = {
        { 0.0, 0.0, 0.0 }, 0.0, 4, { 0, 1, 2, 3 }, { parts[0] / sum, parts[1] / sum, parts[2] / sum, parts[3] / sum }
    };
    return inside;
}

void tl_simplex_solve(const tl_simplex *simplex, tl_simplex_point *nearest_out)
{
    switch (simplex->count) {
    case 1:
        *nearest_out = nearest_on_point(simplex, 0);
        break;
    case 2:
        *nearest_out = nearest_on_segment(simplex, 0, 1);
        break;
    case 3:
        *nearest_out = nearest_on_triangle(simplex, 0, 1, 2);
        break;
    default:
        *nearest_out = nearest_on_tetrahedron(simplex);
    }
}

tl_vec3d tl_simplex_nearest(tl_simplex *simplex)
{
    tl_simplex_point nearest;
    tl_simplex_solve(simplex, &nearest);
    tl_simplex_keep(simplex, &nearest);
    return nearest.point;
}

void tl_simplex_witness(const tl_simplex *simplex, tl_vec3d *on_a_out, tl_vec3d *on_b_out)
{
    tl_vec3d on_a = tl_vec3d_make(0.0, 0.0, 0.0), on_b = on_a;
    for (uint32_t i = 0; i < simplex->count; i++) {
        on_a = tl_vec3d_mul_add(on_a, simplex->points[i].a, simplex->weights[i]);
        on_b = tl_vec3d_mul_add(on_b, simplex->points[i].b, simplex->weights[i]);
    }
    *on_a_out = on_a;
    *on_b_out = on_b;
}
