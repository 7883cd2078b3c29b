// SPDX-License-Identifier: MIT
//
// The corners of what two faces, an edge and a face, or two edges have in common.
//
// Faces are swept (face_sweep.c). An edge is cut by the lines of the face's edges (Cyrus and Beck, Generalized Two- and
// Three-Dimensional Clipping, 1978). Two edges have in common where each lies beside the other: their ends, where the
// other edge is within the limit.

#include "convex/contact/face_patch.h"

#include "math/tolerance.h"

// Faces whose edges coincide are clipped at the same place: to four float roundings of their size.
#define EDGE_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

static tl_patch_heights face_heights(const tl_face *face, const tl_patch *patch)
{
    double scale = -1.0 / tl_vec3d_dot(face->normal, patch->normal);
    tl_patch_heights heights = { -face->offset * scale, tl_vec3d_dot(face->normal, patch->u) * scale,
                                 tl_vec3d_dot(face->normal, patch->v) * scale };
    return heights;
}

static double extent(const tl_face *face)
{
    double most = 0.0;
    if (face->count > 0) {
        for (uint32_t i = 0; i < face->count; i++) {
            double size = tl_vec3d_size(face->corners[i]);
            most = size > most ? size : most;
        }
        return most;
    }
    uint32_t at = face->first;
    do {
        double size = tl_vec3d_size(tl_face_corner(face, at));
        most = size > most ? size : most;
        at = tl_face_next(face, at);
    } while (at != face->first);
    return most;
}

void tl_patch_add(tl_patch *patch, tl_patch_point *point)
{
    // Whoever sweeps or cuts an edge finds points that coincide soon after one another.
    for (uint32_t i = patch->count, looks = 4; i > 0 && looks > 0; i--, looks--) {
        const tl_patch_point *other = &patch->points[i - 1];
        if (tl_same_place(patch, other->x, other->y, point->x, point->y)) {
            return;
        }
    }
    if (tl_patch_separation(point) > patch->limit) {
        return;
    }
    tl_patch_match(patch, point);
    patch->points[patch->count++] = *point;
    if (patch->count == TL_PATCH_POINTS) {
        tl_patch_thin(patch);
    }
}

// The part of an edge that is within a face, and the features that its ends lie on; nothing when low > high.
typedef struct edge_part {
    double low, high;
    uint32_t at_low, at_high;
} edge_part;

// `turn` is 1 when the face runs counter-clockwise seen against the normal, else -1.
static void cut_face_edge(const tl_patch *patch, tl_point2 p, tl_point2 q, const tl_face *within, double turn,
                          edge_part *part)
{
    uint32_t at = within->first;
    tl_point2 from = tl_patch_project(patch, tl_face_corner(within, at));
    do {
        uint32_t edge_at = at;
        at = tl_face_next(within, at);
        tl_point2 to = tl_patch_project(patch, tl_face_corner(within, at));
        double ex = (to.x - from.x) * turn, ey = (to.y - from.y) * turn;
        double gap = patch->gap * sqrt(ex * ex + ey * ey);
        // How far inside the ends are.
        double at_p = ex * (p.y - from.y) - ey * (p.x - from.x), at_q = ex * (q.y - from.y) - ey * (q.x - from.x);
        if (at_p < -gap && at_q < -gap) {
            part->high = -1.0;
        } else if (at_p < -gap && at_p / (at_p - at_q) > part->low) {
            part->low = at_p / (at_p - at_q);
            part->at_low = tl_face_edge_feature(within, edge_at);
        } else if (at_q < -gap && at_p / (at_p - at_q) < part->high) {
            part->high = at_p / (at_p - at_q);
            part->at_high = tl_face_edge_feature(within, edge_at);
        }
        from = to;
    } while (at != within->first);
}

static void add_edge_point(tl_patch *patch, const tl_face *edge, const tl_point2 ends[2], double share,
                           const tl_patch_heights heights[2], const uint32_t features[2])
{
    tl_point2 p = { ends[0].x + (ends[1].x - ends[0].x) * share, ends[0].y + (ends[1].y - ends[0].y) * share };
    tl_patch_point point = { p.x, p.y, tl_patch_height(&heights[0], p), tl_patch_height(&heights[1], p), { 0 }, 0 };
    // `features` are those of the edge and of the face, in this order.
    bool edge_is_a = edge == NULL;
    point.features[0] = features[edge_is_a ? 0 : 1];
    point.features[1] = features[edge_is_a ? 1 : 0];
    tl_patch_add(patch, &point);
}

static void patch_of_edge(tl_patch *patch, const tl_face *edge, const tl_face *within, bool edge_is_a,
                          const tl_patch_heights heights[2])
{
    const tl_point2 ends[2] = { tl_patch_project(patch, edge->corners[0]), tl_patch_project(patch, edge->corners[1]) };
    edge_part part = { 0.0, 1.0, 0, 0 };
    cut_face_edge(patch, ends[0], ends[1], within, edge_is_a ? -1.0 : 1.0, &part);
    if (part.low > part.high) {
        return;
    }
    const double shares[2] = { part.low, part.high };
    const uint32_t cut[2] = { part.at_low, part.at_high };
    for (int i = 0; i < 2; i++) {
        const uint32_t features[2] = { cut[i] == 0 ? edge->vertices[i] : edge->feature,
                                       cut[i] == 0 ? within->feature : cut[i] };
        add_edge_point(patch, edge_is_a ? NULL : edge, ends, shares[i], heights, features);
    }
}

static double nearest_share(const tl_face *edge, tl_vec3d p)
{
    tl_vec3d along = tl_vec3d_sub(edge->corners[1], edge->corners[0]);
    double share = tl_vec3d_dot(tl_vec3d_sub(p, edge->corners[0]), along) / tl_vec3d_dot(along, along);
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

// The ends of each edge, where they lie beside the other one: no farther from it than the limit, or, where the radii
// are what touches, than these allow.
static void patch_of_edges(tl_patch *patch, const tl_face faces[2])
{
    for (int side = 0; side < 2; side++) {
        const tl_face *edge = &faces[side], *other = &faces[1 - side];
        tl_vec3d along = tl_vec3d_sub(other->corners[1], other->corners[0]);
        for (int i = 0; i < 2; i++) {
            tl_vec3d p = edge->corners[i];
            double share = nearest_share(other, p);
            tl_vec3d q = tl_vec3d_mul_add(other->corners[0], along, share), apart = tl_vec3d_sub(q, p);
            double rise = tl_vec3d_dot(apart, patch->normal), run = tl_vec3d_length(apart);
            // Beside it the points differ across both, so along the normal but for a small part.
            if (run * run - rise * rise > 0.01 * run * run + patch->gap * patch->gap) {
                continue;
            }
            tl_vec3d on_a = side == 0 ? p : q, on_b = side == 0 ? q : p;
            tl_point2 at = tl_patch_project(patch, on_a); // the point of B may lie a little beside
            tl_patch_point point = { at.x,  at.y, tl_vec3d_dot(patch->normal, on_a), tl_vec3d_dot(patch->normal, on_b),
                                     { 0 }, 0 };
            point.features[side] = edge->vertices[i];
            point.features[1 - side] = share == 0.0   ? other->vertices[0]
                                       : share == 1.0 ? other->vertices[1]
                                                      : other->feature;
            tl_patch_add(patch, &point);
        }
    }
}

void tl_patch_find(const tl_face *a, const tl_face *b, double limit, const tl_contact_cache *last, tl_patch *patch)
{
    patch->last = last;
    static const tl_contact_cache none = { .count = 0 };
    const tl_contact_cache *known = last != NULL ? last : &none;
    for (uint32_t i = 0; i < TL_MAX_CONTACTS; i++) {
        const uint64_t key = tl_patch_key(known->features[i]);
        patch->known[i] = i < known->count ? key : 0;
    }
    patch->limit = limit;
    patch->count = 0;
    patch->gap = EDGE_GAP * fmax(extent(a), extent(b));
    const tl_patch_heights heights[2] = { face_heights(a, patch), face_heights(b, patch) };
    if (a->count == 2 && b->count == 2) {
        const tl_face faces[2] = { *a, *b };
        patch_of_edges(patch, faces);
    } else if (a->count == 2) {
        patch_of_edge(patch, a, b, true, heights);
    } else if (b->count == 2) {
        patch_of_edge(patch, b, a, false, heights);
    } else if (!(a->count > 0 && a->count <= TL_SMALL_FACE && b->count > 0 && b->count <= TL_SMALL_FACE &&
                 tl_face_clip(a, b, heights, patch))) {
        tl_face_sweep(a, b, heights, patch);
    }
}
