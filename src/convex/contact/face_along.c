// SPDX-License-Identifier: MIT
//
// The face of a shape whose normal is closest to a direction: the one that rests on another shape. Where it is too
// steep to rest on, the edge at the support vertex that is most level, as a face of two corners.
//
// A hull of few faces is scanned. On one of many the search begins at the faces around the support vertex, whose
// normals are the corners of the region of directions that this one lies in, and climbs: from a face to the best of
// those that share a corner with it. A face to rest on has a normal close to the direction, and is then around that
// vertex or next to it; far from every normal the climb may end at a face that is not quite the best, and there is
// nothing to rest on.

#include "convex/contact/face_patch.h"

#include "base/compiler.h"
#include "convex/core/farthest.h"

// A face that is steeper than 60 degrees to the direction is no face to rest on.
#define MIN_COSINE 0.5

// Measured: a scan of so many faces takes as long as a support query and the look at what is around its vertex.
#define SCANNED_FACES 96u

typedef struct candidate {
    const tl_hull *hull;
    const double *planes; // the hull's first block
    uint32_t lanes;       // of a row of it
    uint32_t face;
    tl_vec3d direction;
    double dot;
} candidate;

// Makes a face the best one when its normal is closer to the direction; of equals the lower.
static void consider_face(candidate *best, uint32_t face)
{
    const double *x = best->planes + 32 * (size_t)(face / 8) + face % 8, *y = x + best->lanes, *z = y + best->lanes;
    double dot = best->direction.x * *x + best->direction.y * *y + best->direction.z * *z;
    if (dot > best->dot || (dot == best->dot && face < best->face)) {
        best->face = face;
        best->dot = dot;
    }
}

// Of the planes of a block the largest product with the direction; all of them are kept. `lanes` is even.
static TL_ALWAYS_INLINE double block_products(const double *rows, uint32_t lanes, tl_vec3d d, double dots[8])
{
#if TL_HAS_F64X2
    const tl_f64x2 x = tl_f64x2_all(d.x), y = tl_f64x2_all(d.y), z = tl_f64x2_all(d.z);
    tl_f64x2 most = tl_f64x2_all(-2.0);
    for (uint32_t i = 0; i < lanes; i += 2) {
        tl_f64x2 xy =
            tl_f64x2_add(tl_f64x2_mul(x, tl_f64x2_load(rows + i)), tl_f64x2_mul(y, tl_f64x2_load(rows + lanes + i)));
        tl_f64x2 dot = tl_f64x2_add(xy, tl_f64x2_mul(z, tl_f64x2_load(rows + 2 * lanes + i)));
        tl_f64x2_store(&dots[i], dot);
        most = tl_f64x2_max(most, dot);
    }
    return tl_f64x2_get_x(tl_f64x2_max(most, tl_f64x2_swap(most)));
#else
    double most = -2.0;
    for (uint32_t i = 0; i < lanes; i++) {
        dots[i] = d.x * rows[i] + d.y * rows[lanes + i] + d.z * rows[2 * lanes + i];
        most = dots[i] > most ? dots[i] : most;
    }
    return most;
#endif
}

// The first of the products that is the largest.
static uint32_t first_lane(const double dots[8], uint32_t lanes, double most)
{
    uint32_t mask = 0;
#if TL_HAS_F64X2
    for (uint32_t i = 0; i < lanes; i += 2) {
        mask |= tl_f64x2_masks(tl_f64x2_where_equal(tl_f64x2_load(dots + i), tl_f64x2_all(most))) << i;
    }
#else
    for (uint32_t i = 0; i < lanes; i++) {
        mask |= (dots[i] == most ? 1u : 0u) << i;
    }
#endif
    return tl_lowest_bit(mask);
}

// All of them, a block at a time. Lanes beyond the last face are zero, and some face always looks along the direction.
static void consider_faces(candidate *best)
{
    const double *rows = best->planes;
    const uint32_t count = best->hull->face_count, lanes = best->lanes;
    const tl_vec3d direction = best->direction;
    double dots[8], best_dot = best->dot;
    uint32_t face = best->face;
    for (uint32_t from = 0; from < count; from += 8, rows += 32) {
        const double most =
            lanes == 8 ? block_products(rows, 8, direction, dots) : block_products(rows, lanes, direction, dots);
        if (most > best_dot) {
            best_dot = most;
            face = from + first_lane(dots, lanes, most);
        }
    }
    best->dot = best_dot;
    best->face = face;
}

// Those around the vertex that a half-edge starts at, but for its own.
static void consider_faces_around(candidate *best, uint32_t first)
{
    candidate found = *best; // in registers: what is written to might be the hull, as far as a compiler knows
    const tl_hull *hull = best->hull;
    for (uint32_t edge = first;;) {
        const uint32_t twin = tl_hull_edge_twin(hull, edge), face = tl_hull_edge_face(hull, twin);
        edge = tl_hull_edge_next_in(hull, twin, face);
        if (edge == first) {
            break;
        }
        consider_face(&found, face);
    }
    *best = found;
}

// Each turn but the last finds a better face, so there are at most as many as faces.
static void climb(candidate *best)
{
    const tl_hull *hull = best->hull;
    const uint32_t top = tl_hull_support(hull, tl_vec3d_to_float(best->direction), TL_NO_VERTEX);
    const uint32_t edge = tl_hull_vertex_edge(hull, top);
    consider_face(best, tl_hull_edge_face(hull, edge));
    consider_faces_around(best, edge);
    for (uint32_t from = TL_NO_VERTEX; from != best->face;) {
        from = best->face;
        const uint32_t end = tl_hull_face_first(hull, from + 1);
        for (uint32_t at = tl_hull_face_first(hull, from); at < end; at++) {
            if (tl_hull_edge_origin(hull, at) != top) {
                consider_faces_around(best, at);
            }
        }
    }
}

static inline tl_vec3d place_corner(const tl_frame *frame, tl_vec3 p)
{
    return frame != NULL ? tl_frame_point(frame, tl_vec3d_from(p)) : tl_vec3d_from(p);
}

static inline void keep_hull_corner(tl_face *face, uint32_t k, tl_vec3d p, uint32_t vertex, uint32_t edge,
                                    uint32_t twin)
{
    face->corners[k] = p;
    face->vertices[k] = TL_FEATURE_VERTEX | vertex;
    face->edges[k] = TL_FEATURE_EDGE | (edge < twin ? edge : twin);
}

// The corners of one face, which lie one behind the other, from a half-edge on. What is written might be the hull, as
// far as a compiler knows, so all that is read of it is fetched before.
static TL_ALWAYS_INLINE void keep_face_corners(tl_face *face, uint32_t first, uint32_t count, const tl_frame *frame)
{
    const tl_hull *hull = face->facet.hull;
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    if (hull->index_bytes == 1) {
        const uint8_t *words = (const uint8_t *)(const void *)(vertices + hull->vertex_count) + 3 * (size_t)first;
        for (uint32_t k = 0; k < count; k++, words += 3) {
            keep_hull_corner(face, k, place_corner(frame, vertices[words[0]]), words[0], first + k, words[1]);
        }
        return;
    }
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t vertex = tl_hull_edge_origin(hull, first + k);
        keep_hull_corner(face, k, place_corner(frame, vertices[vertex]), vertex, first + k,
                         tl_hull_edge_twin(hull, first + k));
    }
}

// The corners of a facet that has few, in A's frame, to be walked no more.
static void keep_corners(tl_face *face)
{
    const tl_facet *facet = &face->facet;
    const tl_hull *hull = facet->hull;
    uint32_t at = facet->first, count = 0;
    if (facet->alone) {
        count = tl_hull_face_first(hull, facet->face + 1) - at;
        if (count > TL_FACE_CORNERS) {
            return;
        }
        if (face->frame != NULL) {
            const tl_frame frame = *face->frame;
            keep_face_corners(face, at, count, &frame);
        } else {
            keep_face_corners(face, at, count, NULL);
        }
    } else {
        do {
            if (count == TL_FACE_CORNERS) {
                return;
            }
            const uint32_t vertex = tl_hull_edge_origin(hull, at);
            keep_hull_corner(face, count++, place_corner(face->frame, tl_hull_vertices(hull)[vertex]), vertex, at,
                             tl_hull_edge_twin(hull, at));
            at = tl_facet_next(facet, at);
        } while (at != facet->first);
    }
    face->first = 0;
    face->count = count;
}

static void find_best_face(candidate *best)
{
#if TL_CPU_LEVELS >= 2
    if (best->hull->face_count <= TL_SCAN_PLANES && tl_cpu_has_avx2()) {
        best->face = tl_scan_planes_avx2(best->planes, best->hull->face_count, best->lanes, &best->direction);
        return;
    }
#endif
    if (best->hull->face_count > SCANNED_FACES) {
        climb(best);
    } else {
        consider_faces(best);
    }
}

static void hull_face(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    candidate best = { shape->hull, tl_hull_plane_block(shape->hull, 0), tl_hull_plane_lanes(shape->hull), 0, d, -2.0 };
    find_best_face(&best);
    tl_facet_around(shape->hull, best.face, &face->facet);
    face->first = face->facet.first;
    face->feature = TL_FEATURE_FACE | best.face;
    const double *n = best.planes + 32 * (size_t)(best.face / 8) + best.face % 8;
    face->normal = tl_vec3d_make(n[0], n[best.lanes], n[2 * best.lanes]);
    keep_corners(face);
}

// The features of corners that hold the numbers of their vertices, which are less than `stride`.
static void number_face_edges(tl_face *face, uint32_t count, uint32_t stride)
{
    face->count = count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t p = face->vertices[i], q = face->vertices[(i + 1) % count];
        face->edges[i] = TL_FEATURE_EDGE | (p < q ? p * stride + q : q * stride + p);
    }
    for (uint32_t i = 0; i < count; i++) {
        face->vertices[i] |= TL_FEATURE_VERTEX;
    }
}

// Corners of a box's faces, -x, x, -y, ..., by the bits of minkowski.c; counter-clockwise seen from outside.
static const uint8_t box_corners[6][4] = { { 4, 6, 2, 0 }, { 1, 3, 7, 5 }, { 1, 5, 4, 0 },
                                           { 2, 6, 7, 3 }, { 2, 3, 1, 0 }, { 4, 5, 7, 6 } };

static void box_face(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    double x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    uint32_t axis = x >= y && x >= z ? 0
                    : y >= z         ? 1
                                     : 2,
             side = (axis == 0   ? d.x
                     : axis == 1 ? d.y
                                 : d.z) < 0.0
                        ? 0
                        : 1;
    tl_vec3d c = tl_vec3d_from(shape->corners[0]), h = tl_vec3d_from(shape->corners[1]);
    const double ends[3][2] = { { c.x - h.x, c.x + h.x }, { c.y - h.y, c.y + h.y }, { c.z - h.z, c.z + h.z } };
    const uint8_t *bits = box_corners[2 * axis + side];
    for (int i = 0; i < 4; i++) {
        uint32_t p = bits[i], q = bits[i < 3 ? i + 1 : 0], least = p < q ? p : q;
        face->corners[i] = tl_vec3d_make(ends[0][p & 1u], ends[1][p >> 1 & 1u], ends[2][p >> 2]);
        face->vertices[i] = TL_FEATURE_VERTEX | p;
        face->edges[i] = TL_FEATURE_EDGE | (7 * least + p + q); // 8 times the lesser, and the greater
    }
    double sign = side == 0 ? -1.0 : 1.0;
    face->count = 4;
    face->feature = TL_FEATURE_FACE | (2 * axis + side);
    face->normal = tl_vec3d_make(axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0);
}

static bool triangle_face(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    tl_vec3d a = tl_vec3d_from(shape->corners[0]), b = tl_vec3d_from(shape->corners[1]),
             c = tl_vec3d_from(shape->corners[2]);
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double length = tl_vec3d_length(n);
    bool back = tl_vec3d_dot(n, d) < 0.0;
    face->corners[0] = a;
    face->corners[1] = back ? c : b;
    face->corners[2] = back ? b : c;
    face->vertices[0] = 0;
    face->vertices[1] = back ? 2 : 1;
    face->vertices[2] = back ? 1 : 2;
    number_face_edges(face, 3, 3);
    face->feature = TL_FEATURE_FACE | (back ? 1u : 0u);
    face->normal = tl_vec3d_scale(n, (back ? -1.0 : 1.0) / length);
    return length > 0.0;
}

static bool find_face(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    if (shape->kind == TL_CONVEX_HULL) {
        hull_face(shape, d, face);
        return true;
    }
    if (shape->kind == TL_CONVEX_BOX) {
        box_face(shape, d, face);
        return true;
    }
    if (shape->kind == TL_CONVEX_INLINE && shape->point_count == 3) {
        return triangle_face(shape, d, face);
    }
    return tl_face_round(shape, d, face);
}

// Makes the edge from p to q the face when it is the most level one yet. Its normal is the one across it that is
// closest to the direction.
static bool consider_edge(tl_vec3d p, tl_vec3d q, tl_vec3d d, double *best, tl_face *face)
{
    tl_vec3d along = tl_vec3d_sub(q, p);
    double length = tl_vec3d_length(along), rise = tl_vec3d_dot(along, d);
    if (!(length > 0.0) || !(fabs(rise) < *best * length)) {
        return false;
    }
    *best = fabs(rise) / length;
    tl_vec3d across = tl_vec3d_mul_add(d, along, -rise / (length * length));
    face->corners[0] = p;
    face->corners[1] = q;
    face->count = 2;
    face->normal = tl_vec3d_scale(across, 1.0 / tl_vec3d_length(across));
    return true;
}

static void find_hull_edge(const tl_hull *hull, tl_vec3d d, double *best, tl_face *face)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t vertex = tl_hull_support(hull, tl_vec3d_to_float(d), TL_NO_VERTEX);
    uint32_t first = tl_hull_vertex_edge(hull, vertex), edge = first;
    do {
        uint32_t twin = tl_hull_edge_twin(hull, edge), other = tl_hull_edge_origin(hull, twin);
        if (consider_edge(tl_vec3d_from(vertices[vertex]), tl_vec3d_from(vertices[other]), d, best, face)) {
            face->vertices[0] = TL_FEATURE_VERTEX | vertex;
            face->vertices[1] = TL_FEATURE_VERTEX | other;
            face->edges[0] = face->edges[1] = face->feature = TL_FEATURE_EDGE | (edge < twin ? edge : twin);
        }
        edge = tl_hull_edge_next(hull, twin);
    } while (edge != first);
}

static void find_triangle_edge(const tl_convex *shape, tl_vec3d d, double *best, tl_face *face)
{
    uint32_t top = tl_farthest(shape->corners, 3, &d);
    for (uint32_t i = 1; i < 3; i++) {
        uint32_t other = (top + i) % 3;
        if (consider_edge(tl_vec3d_from(shape->corners[top]), tl_vec3d_from(shape->corners[other]), d, best, face)) {
            face->vertices[0] = top;
            face->vertices[1] = other;
            number_face_edges(face, 2, 3);
            face->feature = face->edges[0];
        }
    }
}

// Of a box some face is never so steep, and round shapes have their edges already.
static bool find_edge(const tl_convex *shape, tl_vec3d d, tl_face *face)
{
    double best = sqrt(1.0 - MIN_COSINE * MIN_COSINE); // an edge is as steep as a face may be
    face->first = face->count = 0;
    if (shape->kind == TL_CONVEX_HULL) {
        find_hull_edge(shape->hull, d, &best, face);
    } else if (shape->kind == TL_CONVEX_INLINE && shape->point_count == 3) {
        find_triangle_edge(shape, d, &best, face);
    }
    return face->count == 2;
}

bool tl_face_along(const tl_convex *shape, const tl_frame *frame, const tl_vec3d *direction, tl_face *face)
{
    tl_vec3d d = frame != NULL ? tl_frame_rotate_back(frame, *direction) : *direction;
    face->shape = shape;
    face->frame = frame;
    face->first = face->count = 0;
    bool is_placed = shape->kind == TL_CONVEX_HULL;
    if (!find_face(shape, d, face)) {
        return false;
    }
    if (tl_vec3d_dot(face->normal, d) < MIN_COSINE) {
        is_placed = false;
        if (!find_edge(shape, d, face)) {
            return false;
        }
    }
    if (frame != NULL) {
        face->normal = tl_frame_rotate(frame, face->normal);
        for (uint32_t i = 0; !is_placed && i < face->count; i++) {
            face->corners[i] = tl_frame_point(frame, face->corners[i]);
        }
    }
    face->offset = tl_vec3d_dot(face->normal, tl_face_corner(face, face->first));
    return true;
}

tl_vec3d tl_face_corner(const tl_face *face, uint32_t at)
{
    if (face->count > 0) {
        return face->corners[at];
    }
    const tl_hull *hull = face->shape->hull;
    tl_vec3d p = tl_vec3d_from(tl_hull_vertices(hull)[tl_hull_edge_origin(hull, at)]);
    return face->frame != NULL ? tl_frame_point(face->frame, p) : p;
}

uint32_t tl_face_next(const tl_face *face, uint32_t at)
{
    return face->count > 0 ? (at + 1 < face->count ? at + 1 : 0) : tl_facet_next(&face->facet, at);
}

uint32_t tl_face_previous(const tl_face *face, uint32_t at)
{
    return face->count > 0 ? (at > 0 ? at : face->count) - 1 : tl_facet_previous(&face->facet, at);
}

uint32_t tl_face_vertex_feature(const tl_face *face, uint32_t at)
{
    return face->count > 0 ? face->vertices[at] : TL_FEATURE_VERTEX | tl_hull_edge_origin(face->shape->hull, at);
}

uint32_t tl_face_edge_feature(const tl_face *face, uint32_t at)
{
    if (face->count > 0) {
        return face->edges[at];
    }
    uint32_t twin = tl_hull_edge_twin(face->shape->hull, at);
    return TL_FEATURE_EDGE | (at < twin ? at : twin);
}
