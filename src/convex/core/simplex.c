// SPDX-License-Identifier: MIT
//
// The point of a simplex nearest to the origin.
//
// For each face of a tetrahedron that has the origin on its outer side, or that is too flat to tell, the nearest point
// is computed, and the nearest of these wins. Of a triangle that is the foot of the origin on its plane when the foot
// lies inside, else the best of its edges. Johnson's and Ericson's orders of tests compute only one feature; this
// computes a few more, but no rounding can lead it to a wrong one: it compares finished distances. Bad simplices, flat
// and needle-like, are what GJK ends with, so this is where its robustness is decided. Compare: Ericson, Real-Time
// Collision Detection, 5.1; Montanari, Petrinic, Barbieri, Improving the GJK Algorithm for Faster and More Reliable
// Distance Queries, 2017.

#include "convex/core/simplex.h"

#include "math/tolerance.h"

// A determinant of three differences has a relative error of less than 16 roundings of the product of their lengths.
#define VOLUME_ERROR TL_DOUBLE_GAMMA(16)

// Each of the functions below replaces `best` when it has found a nearer point.

static void try_point(const tl_simplex *s, uint32_t i, tl_simplex_point *best)
{
    double distance_sq = tl_vec3d_dot(s->points[i].w, s->points[i].w);
    if (distance_sq < best->distance_sq) {
        best->point = s->points[i].w;
        best->distance_sq = distance_sq;
        best->count = 1;
        best->index[0] = i;
        best->weight[0] = 1.0;
    }
}

static void try_segment(const tl_simplex *s, uint32_t i, uint32_t j, tl_simplex_point *best)
{
    const tl_vec3d a = tl_vec3d_load_apart(&s->points[i].w), d = tl_vec3d_sub(tl_vec3d_load_apart(&s->points[j].w), a);
    double along = -tl_vec3d_dot(a, d), length_sq = tl_vec3d_dot(d, d);
    if (!(along > 0.0)) {
        try_point(s, i, best);
        return;
    }
    if (!(along < length_sq)) {
        try_point(s, j, best);
        return;
    }
    double t = along / length_sq;
    tl_vec3d p = tl_vec3d_mul_add(a, d, t);
    double distance_sq = tl_vec3d_dot(p, p);
    if (distance_sq < best->distance_sq) {
        best->point = p;
        best->distance_sq = distance_sq;
        best->count = 2;
        best->index[0] = i;
        best->index[1] = j;
        best->weight[0] = 1.0 - t;
        best->weight[1] = t;
    }
}

// `all`: the edge from i to j too.
static void try_triangle(const tl_simplex *s, uint32_t i, uint32_t j, uint32_t k, bool all, tl_simplex_point *best)
{
    const tl_vec3d a = tl_vec3d_load_apart(&s->points[i].w), b = tl_vec3d_load_apart(&s->points[j].w),
                   c = tl_vec3d_load_apart(&s->points[k].w);
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double area_sq = tl_vec3d_dot(n, n);
    // Areas of the triangles that the foot of the origin makes with each edge, times the area.
    double u = tl_vec3d_dot(n, tl_vec3d_cross(b, c));
    double v = tl_vec3d_dot(n, tl_vec3d_cross(c, a));
    double w = tl_vec3d_dot(n, tl_vec3d_cross(a, b));
    if (u > 0.0 && v > 0.0 && w > 0.0 && area_sq > 0.0) {
        tl_vec3d foot = tl_vec3d_scale(n, tl_vec3d_dot(n, a) / area_sq);
        double distance_sq = tl_vec3d_dot(foot, foot);
        if (distance_sq < best->distance_sq) {
            double scale = 1.0 / (u + v + w);
            best->point = foot;
            best->distance_sq = distance_sq;
            best->count = 3;
            best->index[0] = i;
            best->index[1] = j;
            best->index[2] = k;
            best->weight[0] = u * scale;
            best->weight[1] = v * scale;
            best->weight[2] = w * scale;
        }
        return;
    }
    if (all) {
        try_segment(s, i, j, best);
    }
    try_segment(s, j, k, best);
    try_segment(s, i, k, best);
}

static void try_tetrahedron(const tl_simplex *s, bool all, tl_simplex_point *best)
{
    const tl_vec3d a = s->points[0].w, b = s->points[1].w, c = s->points[2].w, d = s->points[3].w;
    tl_vec3d u = tl_vec3d_sub(b, a), v = tl_vec3d_sub(c, a), w = tl_vec3d_sub(d, a);
    double whole = tl_vec3d_dot(u, tl_vec3d_cross(v, w));
    bool flat =
        whole * whole <= VOLUME_ERROR * VOLUME_ERROR * tl_vec3d_dot(u, u) * tl_vec3d_dot(v, v) * tl_vec3d_dot(w, w);
    // The volume of the origin with the face across from each point: of the sign of the whole where the origin is on
    // the inner side.
    tl_vec3d ab = tl_vec3d_cross(a, b), cd = tl_vec3d_cross(c, d);
    double parts[4] = { tl_vec3d_dot(b, cd), -tl_vec3d_dot(a, cd), tl_vec3d_dot(d, ab), -tl_vec3d_dot(c, ab) };
    bool out[4], outside = flat;
    for (int f = 0; f < 4; f++) {
        out[f] = flat || !(whole > 0.0 ? parts[f] > 0.0 : parts[f] < 0.0);
        outside = outside || out[f];
    }
    if (!outside) {
        double scale = 1.0 / (parts[0] + parts[1] + parts[2] + parts[3]);
        best->point = tl_vec3d_make(0.0, 0.0, 0.0);
        best->distance_sq = 0.0;
        best->count = 4;
        for (uint32_t i = 0; i < 4; i++) {
            best->index[i] = i;
            best->weight[i] = parts[i] * scale;
        }
        return;
    }
    if (out[0]) {
        try_triangle(s, 1, 2, 3, all, best);
    }
    if (out[1]) {
        try_triangle(s, 0, 2, 3, all, best);
    }
    if (out[2]) {
        try_triangle(s, 0, 1, 3, all, best);
    }
    if (all && out[3]) {
        try_triangle(s, 0, 1, 2, all, best);
    }
}

static void solve_simplex(const tl_simplex *simplex, bool all, tl_simplex_point *best)
{
    best->point = simplex->points[0].w; // what remains when nothing compares: a point that is not finite
    best->distance_sq = (double)INFINITY;
    best->count = 1;
    best->index[0] = 0;
    best->weight[0] = 1.0;
    switch (simplex->count) {
    case 1:
        try_point(simplex, 0, best);
        break;
    case 2:
        try_segment(simplex, 0, 1, best);
        break;
    case 3:
        try_triangle(simplex, 0, 1, 2, all, best);
        break;
    default:
        try_tetrahedron(simplex, all, best);
    }
}

void tl_simplex_solve(const tl_simplex *simplex, tl_simplex_point *nearest_out)
{
    solve_simplex(simplex, true, nearest_out);
}

void tl_simplex_solve_last(const tl_simplex *simplex, tl_simplex_point *nearest_out)
{
    solve_simplex(simplex, false, nearest_out);
}

void tl_simplex_keep(tl_simplex *simplex, const tl_simplex_point *nearest)
{
    for (uint32_t i = 0; i < nearest->count; i++) {
        if (nearest->index[i] != i) { // ascending, so nothing is overwritten that is still wanted
            const tl_minkowski_point *from = &simplex->points[nearest->index[i]];
            simplex->points[i].w = tl_vec3d_load_apart(&from->w);
            simplex->points[i].a = tl_vec3d_load_apart(&from->a);
            simplex->points[i].vertex_a = from->vertex_a;
            simplex->points[i].vertex_b = from->vertex_b;
        }
        simplex->weights[i] = nearest->weight[i];
    }
    simplex->count = nearest->count;
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
        const tl_minkowski_point *p = &simplex->points[i];
        const tl_vec3d a = tl_vec3d_load_apart(&p->a), w = tl_vec3d_load_apart(&p->w);
        on_a = tl_vec3d_mul_add(on_a, a, simplex->weights[i]);
        on_b = tl_vec3d_mul_add(on_b, tl_vec3d_sub(a, w), simplex->weights[i]);
    }
    *on_a_out = on_a;
    *on_b_out = on_b;
}
