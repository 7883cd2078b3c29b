// SPDX-License-Identifier: MIT
//
// The depth of two boxes: the least over the 15 axes, the normals of their faces and the cross products of their edges
// (Gottschalk, Lin, Manocha, OBBTree, 1996). A box's support is a sum of three products, so all axes cost less than two
// steps of GJK.
//
// Of axes that are equally deep to four float roundings of the size, a face of A goes before one of B, and faces before
// edges: boxes that rest on each other keep one normal.

#include "convex/contact/contact_axis.h"

#include "base/cpu.h"
#include "convex/contact/box_axes.h"
#include "math/simd2d.h"
#include "math/tolerance.h"

#define TL_FIND_BOX_AXES tl_box_axes_base
#include "convex/contact/box_axes.inl"

// As good as equal, as in EPA.
#define AXIS_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

// Where edges that are so nearly parallel cross cannot be told.
#define LEVEL     1e-4

#define BOX_ERROR TL_DOUBLE_GAMMA(64)

typedef struct box_pair {
    const tl_box *a, *b;
    tl_box_axes axes;
    double best, least;  // depth of the axis chosen, and of any
    double scale, noise; // coordinates, and what rounding leaves of them
    int axis;            // as in tl_box_axes
} box_pair;

// Whether eight points, none of which is outside of a box, are its corners: each coordinate is on one of two sides.
#if TL_HAS_F64X2

static inline tl_f64x2 off_sides(const tl_f64x2 four[2], float low, float high, tl_f64x2 most)
{
    const tl_f64x2 from = tl_f64x2_all((double)low), to = tl_f64x2_all((double)high);
    const tl_f64x2 off = tl_f64x2_min(tl_f64x2_sub(four[0], from), tl_f64x2_sub(to, four[0])),
                   next_off = tl_f64x2_min(tl_f64x2_sub(four[1], from), tl_f64x2_sub(to, four[1]));
    return tl_f64x2_max(tl_f64x2_max(off, next_off), most);
}

static bool are_corners(const tl_vec3 *points, tl_vec3 low, tl_vec3 high)
{
    tl_f64x2 most = tl_f64x2_all(0.0);
    for (int i = 0; i < 8; i += 4) {
        tl_f64x2 x[2], y[2], z[2];
        tl_f64x2_load_points(&points[i].x, x, y, z);
        most = off_sides(x, low.x, high.x, most);
        most = off_sides(y, low.y, high.y, most);
        most = off_sides(z, low.z, high.z, most);
    }
    return tl_f64x2_masks(tl_f64x2_where_less(tl_f64x2_all(0.0), most)) == 0;
}

#else

static bool are_corners(const tl_vec3 *points, tl_vec3 low, tl_vec3 high)
{
    for (int i = 0; i < 8; i++) {
        if ((points[i].x != low.x && points[i].x != high.x) || (points[i].y != low.y && points[i].y != high.y) ||
            (points[i].z != low.z && points[i].z != high.z)) {
            return false;
        }
    }
    return true;
}

#endif

bool tl_box_of(const tl_convex *shape, tl_box *box)
{
    if (shape->kind == TL_CONVEX_BOX) {
        box->middle = tl_vec3d_from(shape->corners[0]);
        box->half = tl_vec3d_from(shape->corners[1]);
        return true;
    }
    const tl_hull *hull = shape->hull;
    if (shape->kind != TL_CONVEX_HULL || hull->vertex_count != 8 || hull->face_count != 6) {
        return false;
    }
    const tl_vec3 low = hull->bounds.min, high = hull->bounds.max;
    if (!are_corners(tl_hull_vertices(hull), low, high)) {
        return false;
    }
    tl_vec3d from = tl_vec3d_from(low), to = tl_vec3d_from(high);
    box->middle = tl_vec3d_scale(tl_vec3d_add(from, to), 0.5);
    box->half = tl_vec3d_scale(tl_vec3d_sub(to, from), 0.5);
    return true;
}

// By twos, as it is loaded.
static void load_vector(tl_vec3d v, double out[4])
{
#if TL_HAS_F64X2
    tl_f64x2_store(out, tl_f64x2_of_two(v.x, v.y));
    tl_f64x2_store(out + 2, tl_f64x2_of_two(v.z, 0.0));
#else
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
    out[3] = 0.0;
#endif
}

static void load_boxes(const tl_minkowski *pair, const tl_box *a, const tl_box *b, box_pair *p)
{
    tl_box_axes *x = &p->axes;
    const tl_vec3d *rows = pair->b_to_a.rows;
    p->a = a;
    p->b = b;
    load_vector(tl_vec3d_load_apart(&a->half), x->half_a);
    load_vector(tl_vec3d_load_apart(&b->half), x->half_b);
    const tl_vec3d middle = tl_vec3d_load_apart(&a->middle);
    load_vector(tl_vec3d_sub(tl_frame_point(&pair->b_to_a, b->middle), middle), x->apart);
    for (int i = 0; i < 3; i++) {
        load_vector(rows[i], x->turn[i]);
    }
    load_vector(tl_vec3d_make(rows[0].x, rows[1].x, rows[2].x), x->columns[0]);
    load_vector(tl_vec3d_make(rows[0].y, rows[1].y, rows[2].y), x->columns[1]);
    load_vector(tl_vec3d_make(rows[0].z, rows[1].z, rows[2].z), x->columns[2]);
    double reach = x->half_a[0] + x->half_a[1] + x->half_a[2] + x->half_b[0] + x->half_b[1] + x->half_b[2];
    p->scale = reach + tl_vec3d_size(a->middle) + tl_vec3d_size(b->middle) + tl_vec3d_size(pair->b_to_a.origin);
    p->noise = BOX_ERROR * p->scale;
}

static void find_depths(tl_box_axes *axes)
{
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        tl_box_axes_avx2(axes);
        return;
    }
#endif
    tl_box_axes_base(axes);
}

// Which axis is shallowest is as good as random to a branch predictor, so it is chosen without a branch.
static void choose_axis(box_pair *p, double gap)
{
    double best = (double)INFINITY, least = best, gap_now = gap;
    int axis = 0;
    for (int k = 0; k < TL_BOX_AXES; k++) {
        const double depth = p->axes.depths[k / 3][k % 3];
        const bool better = depth < best - gap_now; // of two edges the better one, or their points lie elsewhere
        least = depth < least ? depth : least;
        best = better ? depth : best;
        axis = better ? k : axis;
        gap_now = axis < 6 ? gap : 0.0;
    }
    p->best = best;
    p->least = least;
    p->axis = axis;
}

static tl_vec3d column(const box_pair *p, int j)
{
    const double *c = p->axes.columns[j];
    return tl_vec3d_make(c[0], c[1], c[2]);
}

// Of the axis chosen, from A to B.
static tl_vec3d axis_normal(const box_pair *p)
{
    const double *apart = p->axes.apart;
    if (p->axis < 3) {
        const double side = apart[p->axis] < 0.0 ? -1.0 : 1.0;
        return tl_vec3d_make(p->axis == 0 ? side : 0.0, p->axis == 1 ? side : 0.0, p->axis == 2 ? side : 0.0);
    }
    if (p->axis < 6) {
        const tl_vec3d c = column(p, p->axis - 3);
        const double along = apart[0] * c.x + apart[1] * c.y + apart[2] * c.z;
        return tl_vec3d_scale(c, along < 0 ? -1 : 1);
    }
    const int i = (p->axis - 6) / 3, j = (p->axis - 6) % 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const double n1 = -p->axes.turn[i2][j], n2 = p->axes.turn[i1][j], scale = 1.0 / sqrt(n1 * n1 + n2 * n2),
                 side = n1 * apart[i1] + n2 * apart[i2] < 0.0 ? -scale : scale;
    double n[3] = { 0.0 };
    n[i1] = n1 * side;
    n[i2] = n2 * side;
    return tl_vec3d_make(n[0], n[1], n[2]);
}

// The edge along axis i of a box that is farthest along a direction, by the bits of its first vertex.
static uint32_t edge_along(const double d[3], int i)
{
    uint32_t bits = 0;
    for (int k = 0; k < 3; k++) {
        bits |= k != i && d[k] > 0.0 ? 1u << k : 0u;
    }
    return bits;
}

static tl_vec3d edge_middle(tl_vec3d center, const double half[3], uint32_t bits, int i)
{
    double p[3] = { center.x, center.y, center.z };
    for (int k = 0; k < 3; k++) {
        p[k] += k == i ? 0.0 : bits & 1u << k ? half[k] : -half[k];
    }
    return tl_vec3d_make(p[0], p[1], p[2]);
}

// The points of both edges that are nearest to one another; of edges that are nearly parallel a search knows better.
static void edge_points(const tl_minkowski *pair, const box_pair *p, tl_vec3d normal, tl_deepest *out)
{
    int i = (p->axis - 6) / 3, j = (p->axis - 6) % 3;
    tl_vec3d n = normal, nb = tl_vec3d_neg(tl_frame_rotate_back(&pair->b_to_a, n));
    const double da[3] = { n.x, n.y, n.z }, db[3] = { nb.x, nb.y, nb.z };
    uint32_t bits_a = edge_along(da, i), bits_b = edge_along(db, j);
    tl_vec3d a = edge_middle(p->a->middle, p->axes.half_a, bits_a, i);
    tl_vec3d b = tl_frame_point(&pair->b_to_a, edge_middle(p->b->middle, p->axes.half_b, bits_b, j));
    tl_vec3d u = { i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0 }, v = column(p, j);
    tl_vec3d apart = tl_vec3d_sub(b, a), cross = tl_vec3d_cross(u, v);
    double length_sq = tl_vec3d_dot(cross, cross);
    if (length_sq < LEVEL * LEVEL) {
        return;
    }
    double s = tl_vec3d_dot(tl_vec3d_cross(apart, v), cross) / length_sq,
           t = tl_vec3d_dot(tl_vec3d_cross(apart, u), cross) / length_sq;
    out->on_a = tl_vec3d_mul_add(a, u, fmin(fmax(s, -p->axes.half_a[i]), p->axes.half_a[i]));
    out->on_b = tl_vec3d_mul_add(b, v, fmin(fmax(t, -p->axes.half_b[j]), p->axes.half_b[j]));
    // Edges of hulls have other numbers.
    bool boxes = pair->a->kind == TL_CONVEX_BOX && pair->b->kind == TL_CONVEX_BOX;
    out->features[0] = boxes ? TL_FEATURE_EDGE | (bits_a * 8 + (bits_a | 1u << i)) : 0;
    out->features[1] = boxes ? TL_FEATURE_EDGE | (bits_b * 8 + (bits_b | 1u << j)) : 0;
    out->has_points = true;
}

void tl_box_depth(tl_minkowski *pair, const tl_box *a, const tl_box *b, tl_deepest *out)
{
    box_pair p;
    load_boxes(pair, a, b, &p);
    pair->scale = fmax(pair->scale, p.scale);
    const double *half_a = p.axes.half_a, *half_b = p.axes.half_b;
    find_depths(&p.axes);
    choose_axis(&p, AXIS_GAP * (half_a[0] + half_a[1] + half_a[2] + half_b[0] + half_b[1] + half_b[2]));
    out->normal = axis_normal(&p);
    out->separation = -p.best;
    out->lower_depth = p.least - p.noise;
    out->has_points = false;
    out->features[0] = out->features[1] = 0;
    if (p.least < 0.0) {
        out->separation = -p.least - p.noise;
    } else if (p.axis >= 6) {
        edge_points(pair, &p, out->normal, out);
    }
}
