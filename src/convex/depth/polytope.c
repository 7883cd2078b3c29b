// SPDX-License-Identifier: MIT
//
// Incremental hull of at most TL_POLYTOPE_VERTICES points, on the stack.
//
// A point sees a face also when it lies in the face's plane, to within rounding. Then a rim's edge always has a
// face behind it that the point is clearly below, so the point is not on the edge's line and no new triangle is a
// sliver; coplanar triangles are merely fanned anew. Seeing only what is strictly in front (the usual choice) makes
// slivers whose normals point anywhere, and is why EPA has its name for failing on boxes.
//
// The faces that a point sees are walked depth first, the edges of each in their order. So the edges of the rim
// are met in the order of the rim, and need no table to be sorted by.

#include "convex/depth/polytope.h"

#include "base/assert.h"

enum { SEEN = 3 }; // among a face's half-edges

// The corners of a thin face are off by as much as those of others, so its plane may be turned: no edge is longer than
// twice the scale and no corner farther away than that, so the offset along the normal is off by four times the error
// times the square of the scale.
void tl_polytope_set_key(tl_polytope *p, uint32_t f, tl_polytope_plane plane)
{
    const double error = TL_POLYTOPE_ERROR * p->scale, turned = 4.0 * error * p->scale * p->scale;
    p->origins[4 * f + SEEN] = false;
    p->keys[f] = plane.normal_sq > 0.0 ? (plane.offset - turned) / sqrt(plane.normal_sq) - error : (double)INFINITY;
}

static uint16_t polytope_id(uint32_t vertex)
{
    return (uint16_t)(vertex < TL_POLYTOPE_NO_ID ? vertex : TL_POLYTOPE_NO_ID);
}

static uint8_t add_polytope_vertex(tl_polytope *p, const tl_minkowski_point *point)
{
    p->vertices[p->vertex_count].w = point->w;
    p->vertices[p->vertex_count].a = point->a;
    if (p->ids != NULL) {
        p->ids[p->vertex_count][0] = polytope_id(point->vertex_a);
        p->ids[p->vertex_count][1] = polytope_id(point->vertex_b);
    }
    return (uint8_t)p->vertex_count++;
}

void tl_polytope_init(tl_polytope *p, const tl_minkowski_point points[4], double scale)
{
    static const uint8_t corners[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };
    static const uint8_t twins[4][3] = { { 6, 14, 8 }, { 10, 12, 0 }, { 2, 13, 4 }, { 5, 9, 1 } };
    p->vertex_count = p->free_count = 0;
    p->scale = scale;
    p->face_count = 4;
    p->linked = true;
    tl_vec3d u = tl_vec3d_sub(points[1].w, points[0].w), v = tl_vec3d_sub(points[2].w, points[0].w),
             w = tl_vec3d_sub(points[3].w, points[0].w);
    // Face 0 looks away from point 3.
    bool flip = tl_vec3d_dot(tl_vec3d_cross(u, v), w) > 0.0;
    add_polytope_vertex(p, &points[0]);
    add_polytope_vertex(p, &points[flip ? 2 : 1]);
    add_polytope_vertex(p, &points[flip ? 1 : 2]);
    add_polytope_vertex(p, &points[3]);
    for (uint32_t f = 0; f < 4; f++) {
        for (uint32_t i = 0; i < 3; i++) {
            p->origins[4 * f + i] = corners[f][i];
            p->twins[4 * f + i] = twins[f][i];
        }
        tl_polytope_set_key(p, f, tl_polytope_plane_of(p, f));
    }
}

uint32_t tl_polytope_nearest_face(const tl_polytope *p)
{
    uint32_t best = 0;
    double best_key = p->keys[0];
    for (uint32_t f = 1; f < p->face_count; f++) {
        best = p->keys[f] < best_key ? f : best;
        best_key = p->keys[f] < best_key ? p->keys[f] : best_key;
    }
    return best;
}

static bool point_sees(const tl_polytope *p, uint32_t face, tl_vec3d point, double coplanar_sq)
{
    tl_polytope_plane plane = tl_polytope_plane_of(p, face);
    double above = tl_vec3d_dot(plane.normal, point) - plane.offset;
    return above > 0.0 || above * above < coplanar_sq * plane.normal_sq;
}

static uint32_t next_of(uint32_t half_edge)
{
    return (half_edge & 3u) == 2 ? half_edge - 2 : half_edge + 1;
}

static uint32_t previous_of(uint32_t half_edge)
{
    return (half_edge & 3u) == 0 ? half_edge + 2 : half_edge - 1;
}

// What a point sees, and the half-edges of the faces beyond, in the order of the rim.
typedef struct view {
    uint16_t rim[TL_POLYTOPE_FACES];
    uint8_t seen[TL_POLYTOPE_FACES];
    uint32_t seen_count, rim_count;
} view;

static void find_visible(tl_polytope *p, uint32_t first, tl_vec3d point, double coplanar_sq, view *v)
{
    uint16_t stack[TL_POLYTOPE_FACES + 2]; // each face seen takes one half-edge off and puts two on
    uint32_t depth = 3, seen_count = 1, rim_count = 0;
    v->seen[0] = (uint8_t)first;
    p->origins[4 * first + SEEN] = true;
    stack[0] = p->twins[4 * first + 2];
    stack[1] = p->twins[4 * first + 1];
    stack[2] = p->twins[4 * first];
    while (depth > 0) {
        uint32_t across = stack[--depth];
        if (p->origins[across | SEEN]) {
            continue;
        }
        if (point_sees(p, across >> 2, point, coplanar_sq)) {
            p->origins[across | SEEN] = true;
            v->seen[seen_count++] = (uint8_t)(across >> 2);
            stack[depth++] = p->twins[previous_of(across)];
            stack[depth++] = p->twins[next_of(across)];
        } else {
            v->rim[rim_count++] = (uint16_t)across;
        }
    }
    v->seen_count = seen_count;
    v->rim_count = rim_count;
}

// A half-edge beyond the rim holds the rim's edge the other way round.
static bool is_loop(const tl_polytope *p, const view *v)
{
    if (v->rim_count < 3) {
        return false;
    }
    uint8_t at = p->origins[v->rim[v->rim_count - 1]];
    for (uint32_t i = 0; i < v->rim_count; i++) {
        if (p->origins[next_of(v->rim[i])] != at) {
            return false;
        }
        at = p->origins[v->rim[i]];
    }
    return true;
}

// The slots of what is seen first, then free ones.
static uint32_t take_face(tl_polytope *p, const view *v, uint32_t i)
{
    return i < v->seen_count ? v->seen[i] : p->free_count > 0 ? p->free_faces[--p->free_count] : p->face_count++;
}

// New triangles from the point to each edge of the rim. Half-edge 0 lies on the rim, 1 beside the next triangle, 2
// beside the last.
static void fan_to_apex(tl_polytope *p, const view *v, uint8_t apex)
{
    uint8_t start = p->origins[next_of(v->rim[0])];
    uint32_t first = take_face(p, v, 0), f = first;
    tl_vec3d top = p->vertices[apex].w, to_start = tl_vec3d_sub(p->vertices[start].w, top);
    for (uint32_t i = 0; i < v->rim_count; i++) {
        uint32_t beyond = v->rim[i], next = i + 1 < v->rim_count ? take_face(p, v, i + 1) : first;
        uint8_t end = p->origins[beyond];
        tl_vec3d to_end = tl_vec3d_sub(p->vertices[end].w, top);
        p->origins[4 * f] = start;
        p->origins[4 * f + 1] = end;
        p->origins[4 * f + 2] = apex;
        p->twins[4 * f] = (uint16_t)beyond;
        p->twins[beyond] = (uint16_t)(4 * f);
        p->twins[4 * f + 1] = (uint16_t)(4 * next + 2);
        p->twins[4 * next + 2] = (uint16_t)(4 * f + 1);
        tl_polytope_set_key(p, f, tl_polytope_plane_make(top, to_start, to_end));
        f = next;
        start = end;
        to_start = to_end;
    }
}

bool tl_polytope_add(tl_polytope *p, uint32_t face, const tl_minkowski_point *point, double scale)
{
    view v;
    if (p->vertex_count == TL_POLYTOPE_VERTICES || (!p->linked && !tl_polytope_link(p))) {
        return false;
    }
    const double error = TL_POLYTOPE_ERROR * scale;
    find_visible(p, face, point->w, error * error, &v);
    // Euler leaves space enough, but for what a caller's broken cache was resumed from.
    const uint32_t slots = p->face_count - p->free_count + v.rim_count;
    if (!is_loop(p, &v) || slots > TL_POLYTOPE_FACES + v.seen_count) {
        for (uint32_t i = 0; i < v.seen_count; i++) {
            p->origins[4 * v.seen[i] + SEEN] = false;
        }
        return false;
    }
    p->scale = scale;
    fan_to_apex(p, &v, add_polytope_vertex(p, point));
    for (uint32_t i = v.rim_count; i < v.seen_count; i++) {
        p->keys[v.seen[i]] = (double)INFINITY;
        p->origins[4 * v.seen[i] + SEEN] = false;
        p->free_faces[p->free_count++] = v.seen[i];
    }
    TL_ASSERT(p->face_count <= TL_POLYTOPE_FACES);
    return true;
}
