// SPDX-License-Identifier: MIT
//
// The distance of an upright segment from a triangle or a convex shape.
//
// Where the end that is nearer to the triangle's plane projects into the triangle, the plane's distance is the answer:
// that is the floor under a character, and most of what it ever asks. Else a nearest point lies at the other end or on
// an edge that some point of the segment is outside of: the others are not asked. Source: Ericson, Real-Time Collision
// Detection, 2005, sections 5.1.9 and 5.1.10.

#include "character/capsule_gap.h"

#include "math/scale.h"
#include "math/tolerance.h"

#define ALL_SIDES 7u

// A triangle whose sine at corner 0 is below half an ulp of float has no face.
#define MOVER_NEEDLE_SINE_SQ ((double)TL_FLOAT_ROUNDING * (double)TL_FLOAT_ROUNDING)

static tl_vec3d lesser(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}

static tl_vec3d greater(tl_vec3d a, tl_vec3d b)
{
    return tl_vec3d_make(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

void tl_mover_set_triangle(tl_mover_item *t)
{
    const tl_vec3d *corners = t->corners;
    t->low = lesser(corners[0], lesser(corners[1], corners[2]));
    t->high = greater(corners[0], greater(corners[1], corners[2]));
    t->shape = NULL;
    t->known = false;
}

void tl_mover_know_triangle(tl_mover_item *t)
{
    const tl_vec3d *corners = t->corners;
    const tl_vec3d first = tl_vec3d_sub(corners[1], corners[0]), second = tl_vec3d_sub(corners[2], corners[0]);
    const tl_vec3d normal = tl_vec3d_cross(first, second);
    const double normal_sq = tl_vec3d_dot(normal, normal);
    const bool has_face = normal_sq > MOVER_NEEDLE_SINE_SQ * tl_vec3d_dot(first, first) * tl_vec3d_dot(second, second);
    t->normal = tl_vec3d_scale(normal, has_face ? 1.0 / sqrt(normal_sq) : 0.0);
    for (int k = 0; k < 3; k++) {
        const tl_vec3d edge = tl_vec3d_sub(corners[(k + 1) % 3], corners[k]);
        t->inward[k] = tl_vec3d_cross(t->normal, edge);
        t->edge_sq[k] = tl_vec3d_dot(edge, edge);
    }
    t->known = true;
}

static double clamp_to_one(double share)
{
    return share > 0.0 ? share < 1.0 ? share : 1.0 : 0.0;
}

static bool projects_inside(const tl_mover_item *t, tl_vec3d p)
{
    for (int k = 0; k < 3; k++) {
        if (tl_vec3d_dot(t->inward[k], tl_vec3d_sub(p, t->corners[k])) < 0.0) {
            return false;
        }
    }
    return true;
}

// The point of the plane below an end, `height` over it, signed.
static void take_plane(const tl_mover_item *t, tl_vec3d end, double height, tl_mover_nearest *best)
{
    double side = height < 0.0 ? -1.0 : 1.0;
    best->distance = height * side;
    best->normal = tl_vec3d_scale(t->normal, side);
    best->point = tl_vec3d_mul_add(end, t->normal, -height);
    best->face = true;
}

// The nearest edge so far: its normal and distance are computed when all have been tried.
typedef struct nearest_edge {
    double distance_sq;
    tl_vec3d away, point; ///< from the point on the edge to the core
} nearest_edge;

static void try_edge_of(const tl_mover_item *t, const tl_mover_core *core, int k, nearest_edge *best)
{
    tl_vec3d q = t->corners[k], e = tl_vec3d_sub(t->corners[(k + 1) % 3], q), r = tl_vec3d_sub(core->low, q);
    double length = core->length, ee = t->edge_sq[k], er = tl_vec3d_dot(e, r), de = length * e.y, dr = length * r.y,
           dd = length * length, determinant = dd * ee - de * de;
    // Nearly parallel: any point of the core will do, as the ends are tried by clamping.
    double s = determinant > 0.0 ? clamp_to_one((de * er - dr * ee) / determinant) : 0.0;
    double u = ee > 0.0 ? clamp_to_one((de * s + er) / ee) : 0.0;
    s = dd > 0.0 ? clamp_to_one((de * u - dr) / dd) : 0.0;
    tl_vec3d on_core = core->low, on_edge = tl_vec3d_mul_add(q, e, u);
    on_core.y += length * s;
    tl_vec3d away = tl_vec3d_sub(on_core, on_edge);
    double distance_sq = tl_vec3d_dot(away, away);
    if (distance_sq < best->distance_sq) {
        const nearest_edge edge = { distance_sq, away, on_edge };
        *best = edge;
    }
}

// Edges that no point of the core is outside of hold no nearest point, but for their ends, which other edges have.
static void try_outer_edges(const tl_mover_item *t, const tl_mover_core *core, uint32_t inside_of, double best_sq,
                            tl_mover_nearest *best)
{
    nearest_edge edge = { best_sq, { 0, 0, 0 }, { 0, 0, 0 } };
    for (int k = 0; k < 3; k++) {
        if ((inside_of >> k & 1u) == 0) {
            try_edge_of(t, core, k, &edge);
        }
    }
    if (edge.distance_sq < best_sq) {
        best->distance = sqrt(edge.distance_sq);
        best->point = edge.point;
        best->face = false;
        best->normal = best->distance > 0.0 ? tl_vec3d_scale(edge.away, 1.0 / best->distance) : t->normal;
    }
}

// The core passes through the inside: to the side that is nearer. The front wins a tie.
static bool crosses_triangle(const tl_mover_item *t, const tl_mover_core *core, double low, double high,
                             tl_mover_nearest *best)
{
    if (!(low < 0.0 && high > 0.0) && !(low > 0.0 && high < 0.0)) {
        return false;
    }
    tl_vec3d at = core->low;
    at.y += core->length * (low / (low - high));
    if (!projects_inside(t, at)) {
        return false;
    }
    double below = low < high ? low : high, above = low < high ? high : low;
    bool front = -below <= above;
    best->distance = front ? below : -above;
    best->normal = front ? t->normal : tl_vec3d_neg(t->normal);
    best->point = at;
    best->face = true;
    return true;
}

// On which sides of a triangle's edges the core's ends are: bit k for the inside of edge k, seen along the normal; and
// whether it is all farther than a distance outside of one, in the plane.
typedef struct core_sides {
    uint32_t low, top;
    bool beyond;
} core_sides;

static core_sides sides_of(const tl_mover_item *t, tl_vec3d low, tl_vec3d top, double far_sq)
{
    core_sides sides = { 0, 0, false };
    for (int k = 0; k < 3; k++) {
        const double low_in = tl_vec3d_dot(t->inward[k], tl_vec3d_sub(low, t->corners[k]));
        const double top_in = tl_vec3d_dot(t->inward[k], tl_vec3d_sub(top, t->corners[k]));
        const double most = low_in > top_in ? low_in : top_in;
        sides.low |= (uint32_t)(low_in >= 0.0) << k;
        sides.top |= (uint32_t)(top_in >= 0.0) << k;
        sides.beyond = sides.beyond || (most < 0.0 && most * most > far_sq * t->edge_sq[k]);
    }
    return sides;
}

static void nearest_of_triangle(const tl_mover_item *t, const tl_mover_core *core, double reach, tl_mover_nearest *best)
{
    double best_sq = (double)INFINITY;
    core_sides in = { 0, 0, false };
    if (t->normal.x != 0.0 || t->normal.y != 0.0 || t->normal.z != 0.0) {
        tl_vec3d top = core->low;
        top.y += core->length;
        double low = tl_vec3d_dot(t->normal, tl_vec3d_sub(core->low, t->corners[0])),
               high = low + t->normal.y * core->length;
        if (crosses_triangle(t, core, low, high, best)) {
            return;
        }
        // Of the reach, what lies across the plane is gone before the plane is reached: so a floor's triangles beside
        // the one under the core are told off here.
        bool low_nearer = fabs(low) <= fabs(high), same_side = (low >= 0.0) == (high >= 0.0);
        double over = same_side ? (low_nearer ? low : high) : 0.0;
        in = sides_of(t, core->low, top, reach * reach - over * over);
        if (in.beyond) {
            best->distance = (double)INFINITY;
            return;
        }
        if (same_side && (low_nearer ? in.low : in.top) == ALL_SIDES) {
            take_plane(t, low_nearer ? core->low : top, low_nearer ? low : high, best);
            return;
        }
        if (in.low == ALL_SIDES) {
            take_plane(t, core->low, low, best);
            best_sq = low * low;
        }
        if (in.top == ALL_SIDES && high * high < best_sq) {
            take_plane(t, top, high, best);
            best_sq = high * high;
        }
    }
    try_outer_edges(t, core, in.low & in.top, best_sq, best);
    if (best->distance == 0.0 && tl_vec3d_dot(best->normal, best->normal) == 0.0) {
        best->normal = tl_vec3d_make(0.0, 1.0, 0.0); // a needle through the core
    }
}

const tl_convex *tl_mover_shape(const tl_mover_item *item, tl_scaled_convex *room)
{
    return !tl_scale_is_one(item->scale) && tl_scaled_convex_make(item->shape, item->scale, room, NULL) == TL_OK
               ? &room->shape
               : item->shape;
}

static void nearest_of_shape(const tl_mover_item *item, const tl_mover_core *core, tl_mover_nearest *best)
{
    // Relative to the core, which so is exact; the shape's own place is a float.
    tl_vec3d away = tl_vec3d_sub(tl_vec3d_from(item->pose->position), core->low);
    tl_transform here = tl_transform_identity(), there = { item->pose->rotation, tl_vec3d_to_float(away) };
    tl_convex segment = tl_convex_capsule(tl_vec3_make(0, 0, 0), tl_vec3_make(0, (float)core->length, 0), 0.0f);
    tl_separation s;
    tl_scaled_convex room;
    const tl_convex *shape = tl_mover_shape(item, &room);
    tl_convex_distance(shape, there, &segment, here, NULL, &s);
    best->face = false;
    if (!s.overlap) {
        best->distance = (double)s.distance;
        best->normal = tl_vec3d_from(s.normal);
        best->point = tl_vec3d_add(core->low, tl_vec3d_from(s.point_a));
        return;
    }
    tl_penetration in;
    tl_convex_penetration(shape, there, &segment, here, NULL, &in);
    best->distance = -(double)in.depth;
    best->normal = in.overlap ? tl_vec3d_from(in.normal) : tl_vec3d_make(0.0, 1.0, 0.0);
    best->point = tl_vec3d_add(core->low, tl_vec3d_from(in.point_a));
}

void tl_mover_nearest_of(tl_mover_item *item, const tl_mover_core *core, double reach, tl_mover_nearest *nearest_out)
{
    if (item->shape != NULL) {
        nearest_of_shape(item, core, nearest_out);
    } else {
        tl_mover_know(item);
        nearest_of_triangle(item, core, reach, nearest_out);
    }
}
