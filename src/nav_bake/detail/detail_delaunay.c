// SPDX-License-Identifier: MIT
//
// Incremental Delaunay triangulation of a convex polygon.
//
// A point is put into its triangle, or into the outline, and edges are flipped until each triangle's circle is empty.
// Which side of an edge a point is on is decided exactly in integers. Whether a point is inside a circle is decided in
// double, and a flip is made only when its error bound leaves no doubt: each flip then lowers the surface over the
// lifting paraboloid, so flipping ends, and what is left open is a tie that either diagonal serves.
// Sources: Lawson 1977; Guibas, Stolfi 1985; Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997 (bound).
//
// Why it is fast here: a new point changes only the triangles around it, and the height samples of these move with
// them. Recast triangulates all points anew for each one that it adds, and searches all triangles for each sample.

#include "nav_bake/detail/detail.h"

#include "base/assert.h"
#include "math/tolerance.h"

static int64_t orient_of(const tl_detail_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    return tl_detail_orient(&mesh->points[a], &mesh->points[b], &mesh->points[c]);
}

static uint32_t corner_in_triangle(const tl_detail_triangle *triangle, uint32_t point)
{
    return triangle->corner[0] == point ? 0 : triangle->corner[1] == point ? 1 : 2;
}

static uint32_t edge_to(const tl_detail_triangle *triangle, uint32_t other)
{
    return triangle->across[0] == other ? 0 : triangle->across[1] == other ? 1 : 2;
}

// Whether d is inside the circle of a, b, c beyond doubt. Error of the determinant, all differences being exact: a
// product and a sum for each 2 by 2 minor, as many for each squared length, their product, and three sums.
static bool is_inside_circle(const tl_detail_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const tl_detail_point *pd = &mesh->points[d];
    double x[3], z[3], lift[3];
    const uint32_t corner[3] = { a, b, c };
    for (int k = 0; k < 3; k++) {
        x[k] = (double)mesh->points[corner[k]].x - pd->x;
        z[k] = (double)mesh->points[corner[k]].z - pd->z;
        lift[k] = x[k] * x[k] + z[k] * z[k];
    }
    double determinant = 0, magnitude = 0;
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        double left = x[l] * z[m], right = x[m] * z[l];
        determinant += lift[k] * (right - left); // the polygons' winding is clockwise in (x, z)
        magnitude += lift[k] * (fabs(left) + fabs(right));
    }
    return determinant > TL_DOUBLE_GAMMA(8) * magnitude;
}

static void set_triangle(tl_detail_mesh *mesh, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    tl_detail_triangle *triangle = &mesh->triangles[t];
    triangle->corner[0] = a;
    triangle->corner[1] = b;
    triangle->corner[2] = c;
    mesh->triangle_of[a] = t;
    mesh->triangle_of[b] = t;
    mesh->triangle_of[c] = t;
    mesh->changed[mesh->changed_count++] = t;
}

static void set_across(tl_detail_mesh *mesh, uint32_t t, uint32_t edge, uint32_t other, uint32_t other_was)
{
    mesh->triangles[t].across[edge] = other;
    if (other != TL_DETAIL_NONE) {
        mesh->triangles[other].across[edge_to(&mesh->triangles[other], other_was)] = t;
    }
}

static uint32_t new_triangle(tl_detail_mesh *mesh)
{
    uint32_t t = mesh->triangle_count++;
    tl_detail_triangle empty = { { 0, 0, 0 }, { TL_DETAIL_NONE, TL_DETAIL_NONE, TL_DETAIL_NONE }, TL_DETAIL_NONE };
    mesh->triangles[t] = empty;
    return t;
}

static void put_sample(tl_detail_mesh *mesh, uint32_t t, uint32_t sample)
{
    mesh->next_sample[sample] = mesh->triangles[t].first_sample;
    mesh->triangles[t].first_sample = sample;
}

// Deals the samples of a list out to two triangles that meet in the line from a to b; t is the one on its left.
static void deal_samples(tl_detail_mesh *mesh, uint32_t list, uint32_t a, uint32_t b, uint32_t t, uint32_t other)
{
    while (list != TL_DETAIL_NONE) {
        uint32_t next = mesh->next_sample[list];
        bool in_t = tl_detail_orient(&mesh->points[a], &mesh->points[b], &mesh->samples[list]) >= 0;
        put_sample(mesh, in_t ? t : other, list);
        list = next;
    }
}

static uint32_t collect_samples(tl_detail_mesh *mesh, uint32_t t)
{
    uint32_t list = mesh->triangles[t].first_sample;
    mesh->triangles[t].first_sample = TL_DETAIL_NONE;
    return list;
}

// Replaces edge k of t, from a to b, by the other diagonal, from c to d, if d is inside the circle of a, b, c.
// Then t is c, a, d and the other triangle c, d, b.
static bool flip_edge(tl_detail_mesh *mesh, uint32_t t, uint32_t k)
{
    uint32_t other = mesh->triangles[t].across[k];
    if (other == TL_DETAIL_NONE) {
        return false;
    }
    tl_detail_triangle was_t = mesh->triangles[t], was_other = mesh->triangles[other];
    uint32_t j = edge_to(&was_other, t);
    uint32_t a = was_t.corner[k], b = was_t.corner[(k + 1) % 3], c = was_t.corner[(k + 2) % 3];
    uint32_t d = was_other.corner[(j + 2) % 3];
    if (!is_inside_circle(mesh, a, b, c, d)) {
        return false;
    }
    TL_ASSERT(orient_of(mesh, c, a, d) > 0 && orient_of(mesh, c, d, b) > 0);
    uint32_t beyond_bc = was_t.across[(k + 1) % 3], beyond_ca = was_t.across[(k + 2) % 3];
    uint32_t beyond_ad = was_other.across[(j + 1) % 3], beyond_db = was_other.across[(j + 2) % 3];
    set_triangle(mesh, t, c, a, d);
    set_triangle(mesh, other, c, d, b);
    mesh->triangles[t].across[0] = beyond_ca;
    set_across(mesh, t, 1, beyond_ad, other);
    mesh->triangles[t].across[2] = other;
    mesh->triangles[other].across[0] = t;
    mesh->triangles[other].across[1] = beyond_db;
    set_across(mesh, other, 2, beyond_bc, t);
    uint32_t t_samples = collect_samples(mesh, t), other_samples = collect_samples(mesh, other);
    deal_samples(mesh, t_samples, c, d, other, t);
    deal_samples(mesh, other_samples, c, d, other, t);
    return true;
}

// Flips the edges opposite the new point p, as long as one must be. Each flip gives p one more edge, so the stack holds
// at most two entries a triangle.
static void restore(tl_detail_mesh *mesh, uint32_t p, uint32_t waiting)
{
    while (waiting > 0) {
        uint32_t t = mesh->stack[--waiting];
        uint32_t k = (corner_in_triangle(&mesh->triangles[t], p) + 1) % 3;
        uint32_t other = mesh->triangles[t].across[k];
        if (flip_edge(mesh, t, k)) {
            mesh->stack[waiting++] = t;
            mesh->stack[waiting++] = other;
        }
    }
}

void tl_detail_start(tl_detail_mesh *mesh, uint32_t corner_count)
{
    mesh->point_count = corner_count;
    mesh->triangle_count = 0;
    mesh->changed_count = 0;
    for (uint32_t k = 1; k + 1 < corner_count; k++) {
        uint32_t t = new_triangle(mesh);
        set_triangle(mesh, t, 0, k, k + 1);
        mesh->triangles[t].across[0] = k > 1 ? t - 1 : TL_DETAIL_NONE;
        mesh->triangles[t].across[2] = k + 2 < corner_count ? t + 1 : TL_DETAIL_NONE;
    }
    mesh->changed_count = 0; // the caller looks at all
    for (bool flipped = true; flipped;) {
        flipped = false;
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            for (uint32_t k = 0; k < 3; k++) {
                flipped |= flip_edge(mesh, t, k);
                mesh->changed_count = 0;
            }
        }
    }
}

// The triangle and edge that lead from point a along the outline.
static uint32_t outline_triangle(const tl_detail_mesh *mesh, uint32_t a, uint32_t *edge_out)
{
    uint32_t t = mesh->triangle_of[a];
    for (;;) { // turns round a, from edge to edge, until the outline stops it
        uint32_t k = corner_in_triangle(&mesh->triangles[t], a);
        if (mesh->triangles[t].across[k] == TL_DETAIL_NONE) {
            *edge_out = k;
            return t;
        }
        t = mesh->triangles[t].across[k];
    }
}

void tl_detail_insert_on_outline(tl_detail_mesh *mesh, uint32_t a)
{
    uint32_t p = mesh->point_count - 1, k;
    uint32_t t = outline_triangle(mesh, a, &k);
    tl_detail_triangle was = mesh->triangles[t];
    uint32_t b = was.corner[(k + 1) % 3], c = was.corner[(k + 2) % 3];
    uint32_t beyond_bc = was.across[(k + 1) % 3], beyond_ca = was.across[(k + 2) % 3];
    uint32_t other = new_triangle(mesh);
    uint32_t list = collect_samples(mesh, t);
    set_triangle(mesh, t, p, c, a);
    set_triangle(mesh, other, p, b, c);
    mesh->triangles[t].across[0] = other;
    mesh->triangles[t].across[1] = beyond_ca;
    mesh->triangles[t].across[2] = TL_DETAIL_NONE;
    mesh->triangles[other].across[0] = TL_DETAIL_NONE;
    set_across(mesh, other, 1, beyond_bc, t);
    mesh->triangles[other].across[2] = t;
    deal_samples(mesh, list, p, c, t, other);
    mesh->stack[0] = t;
    mesh->stack[1] = other;
    restore(mesh, p, 2);
}

// Splits t into three around p.
static void split_triangle(tl_detail_mesh *mesh, uint32_t t, uint32_t p)
{
    tl_detail_triangle was = mesh->triangles[t];
    uint32_t a = was.corner[0], b = was.corner[1], c = was.corner[2];
    uint32_t u = new_triangle(mesh), v = new_triangle(mesh), list = collect_samples(mesh, t);
    set_triangle(mesh, t, p, a, b);
    set_triangle(mesh, u, p, b, c);
    set_triangle(mesh, v, p, c, a);
    mesh->triangles[t].across[0] = v;
    mesh->triangles[t].across[1] = was.across[0];
    mesh->triangles[t].across[2] = u;
    mesh->triangles[u].across[0] = t;
    set_across(mesh, u, 1, was.across[1], t);
    mesh->triangles[u].across[2] = v;
    mesh->triangles[v].across[0] = u;
    set_across(mesh, v, 1, was.across[2], t);
    mesh->triangles[v].across[2] = t;
    while (list != TL_DETAIL_NONE) {
        const tl_detail_point *s = &mesh->samples[list];
        uint32_t next = mesh->next_sample[list];
        bool left_of_a = tl_detail_orient(&mesh->points[p], &mesh->points[a], s) >= 0;
        bool left_of_b = tl_detail_orient(&mesh->points[p], &mesh->points[b], s) >= 0;
        bool left_of_c = tl_detail_orient(&mesh->points[p], &mesh->points[c], s) >= 0;
        put_sample(mesh, left_of_a && !left_of_b ? t : left_of_b && !left_of_c ? u : v, list);
        list = next;
    }
    mesh->stack[0] = t;
    mesh->stack[1] = u;
    mesh->stack[2] = v;
    restore(mesh, p, 3);
}

// Splits edge k of t and both its triangles: p lies on it.
static void split_edge(tl_detail_mesh *mesh, uint32_t t, uint32_t k, uint32_t p)
{
    uint32_t o = mesh->triangles[t].across[k];
    tl_detail_triangle was_t = mesh->triangles[t], was_o = mesh->triangles[o];
    uint32_t j = edge_to(&was_o, t);
    uint32_t a = was_t.corner[k], b = was_t.corner[(k + 1) % 3], c = was_t.corner[(k + 2) % 3];
    uint32_t d = was_o.corner[(j + 2) % 3];
    uint32_t beyond_bc = was_t.across[(k + 1) % 3], beyond_ca = was_t.across[(k + 2) % 3];
    uint32_t beyond_ad = was_o.across[(j + 1) % 3], beyond_db = was_o.across[(j + 2) % 3];
    uint32_t u = new_triangle(mesh), v = new_triangle(mesh);
    uint32_t t_list = collect_samples(mesh, t), o_list = collect_samples(mesh, o);
    set_triangle(mesh, t, p, c, a);
    set_triangle(mesh, u, p, b, c);
    set_triangle(mesh, o, p, a, d);
    set_triangle(mesh, v, p, d, b);
    mesh->triangles[t].across[0] = u;
    mesh->triangles[t].across[1] = beyond_ca;
    mesh->triangles[t].across[2] = o;
    mesh->triangles[u].across[0] = v;
    set_across(mesh, u, 1, beyond_bc, t);
    mesh->triangles[u].across[2] = t;
    mesh->triangles[o].across[0] = t;
    mesh->triangles[o].across[1] = beyond_ad;
    mesh->triangles[o].across[2] = v;
    mesh->triangles[v].across[0] = o;
    set_across(mesh, v, 1, beyond_db, o);
    mesh->triangles[v].across[2] = u;
    deal_samples(mesh, t_list, p, c, t, u);
    deal_samples(mesh, o_list, p, d, v, o);
    mesh->stack[0] = t;
    mesh->stack[1] = u;
    mesh->stack[2] = o;
    mesh->stack[3] = v;
    restore(mesh, p, 4);
}

void tl_detail_insert_inside(tl_detail_mesh *mesh, uint32_t triangle)
{
    uint32_t p = mesh->point_count - 1;
    const tl_detail_triangle *t = &mesh->triangles[triangle];
    for (uint32_t k = 0; k < 3; k++) {
        if (orient_of(mesh, t->corner[k], t->corner[(k + 1) % 3], p) == 0) {
            split_edge(mesh, triangle, k, p);
            return;
        }
    }
    split_triangle(mesh, triangle, p);
}

// The edge of a triangle that has p strictly outside, or 3.
static uint32_t edge_before(const tl_detail_mesh *mesh, uint32_t t, const tl_detail_point *p)
{
    const tl_detail_triangle *triangle = &mesh->triangles[t];
    for (uint32_t k = 0; k < 3; k++) {
        const tl_detail_point *a = &mesh->points[triangle->corner[k]];
        const tl_detail_point *b = &mesh->points[triangle->corner[(k + 1) % 3]];
        if (tl_detail_orient(a, b, p) < 0) {
            return k;
        }
    }
    return 3;
}

uint32_t tl_detail_locate(const tl_detail_mesh *mesh, const tl_detail_point *p, uint32_t start)
{
    // In a Delaunay triangulation such a walk visits no triangle twice.
    uint32_t t = start;
    for (uint32_t steps = 0; steps < mesh->triangle_count; steps++) {
        uint32_t k = edge_before(mesh, t, p);
        if (k == 3) {
            return t;
        }
        t = mesh->triangles[t].across[k];
    }
    // Where ties were left open it may; then all are asked.
    for (t = 0; t + 1 < mesh->triangle_count && edge_before(mesh, t, p) != 3; t++) {
    }
    return t;
}
