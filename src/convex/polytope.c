// SPDX-License-Identifier: MIT
//
// Incremental hull of at most TL_POLYTOPE_VERTICES points, on the stack.
//
// A point sees a face also when it lies in the face's plane, to within rounding. Then a rim's edge always has a face
// behind it that the point is clearly below, so the point is not on the edge's line and no new triangle is a sliver;
// coplanar triangles are merely fanned anew. Seeing only what is strictly in front (the usual choice) makes slivers
// whose normals point anywhere, and is why EPA has its name for failing on boxes.
//
// The faces that a point sees are walked depth first, the edges of each in their order. So the edges of the rim are met
// in the order of the rim, and need no table to be sorted by.

#include "convex/polytope.h"

#include "base/assert.h"

// From the vectors that lead from its last vertex to its first two.
static void set_plane(tl_polytope *p, uint32_t f, tl_vec3d to_first, tl_vec3d to_second)
{
    tl_polytope_face *face = &p->faces[f];
    tl_vec3d n = tl_vec3d_cross(to_first, to_second);
    double offset = tl_vec3d_dot(n, p->vertices[face->vertices[2]].w), normal_sq = tl_vec3d_dot(n, n);
    face->normal = n;
    face->offset = offset;
    face->normal_sq = normal_sq;
    face->seen = false;
    p->keys[f] = normal_sq > 0.0 ? offset * fabs(offset) / normal_sq : (double)INFINITY;
}

static uint8_t add_vertex(tl_polytope *p, const tl_pair_point *point)
{
    p->vertices[p->vertex_count].w = point->w;
    p->vertices[p->vertex_count].a = point->a;
    return (uint8_t)p->vertex_count++;
}

void tl_polytope_init(tl_polytope *p, const tl_pair_point points[4])
{
    static const uint8_t corners[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };
    static const uint8_t neighbors[4][3] = { { 1, 3, 2 }, { 2, 3, 0 }, { 0, 3, 1 }, { 1, 2, 0 } };
    p->vertex_count = p->free_count = 0;
    p->face_count = 4;
    tl_vec3d u = tl_vec3d_sub(points[1].w, points[0].w), v = tl_vec3d_sub(points[2].w, points[0].w),
             w = tl_vec3d_sub(points[3].w, points[0].w);
    // Face 0 looks away from point 3.
    bool flip = tl_vec3d_dot(tl_vec3d_cross(u, v), w) > 0.0;
    add_vertex(p, &points[0]);
    add_vertex(p, &points[flip ? 2 : 1]);
    add_vertex(p, &points[flip ? 1 : 2]);
    add_vertex(p, &points[3]);
    for (uint32_t f = 0; f < 4; f++) {
        for (int i = 0; i < 3; i++) {
            p->faces[f].vertices[i] = corners[f][i];
            p->faces[f].neighbors[i] = neighbors[f][i];
        }
        tl_vec3d apex = p->vertices[corners[f][2]].w;
        set_plane(p, f, tl_vec3d_sub(p->vertices[corners[f][0]].w, apex),
                  tl_vec3d_sub(p->vertices[corners[f][1]].w, apex));
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

static bool sees(const tl_polytope_face *face, tl_vec3d point, double coplanar_sq)
{
    double above = tl_vec3d_dot(face->normal, point) - face->offset;
    return above > 0.0 || above * above < coplanar_sq * face->normal_sq;
}

typedef struct half_edge {
    uint8_t face, edge;
} half_edge;

// What a point sees, and the edges of the faces beyond, in the order of the rim.
typedef struct view {
    uint8_t seen[TL_POLYTOPE_FACES];
    half_edge rim[TL_POLYTOPE_FACES];
    uint32_t seen_count, rim_count;
} view;

static void look(tl_polytope *p, uint32_t first, tl_vec3d point, double coplanar_sq, view *v)
{
    half_edge stack[TL_POLYTOPE_FACES + 2]; // each face seen takes one edge off and puts two on
    uint32_t depth = 0;
    v->seen_count = v->rim_count = 0;
    v->seen[v->seen_count++] = (uint8_t)first;
    p->faces[first].seen = true;
    for (uint8_t e = 3; e-- > 0;) {
        half_edge edge = { (uint8_t)first, e };
        stack[depth++] = edge;
    }
    while (depth > 0) {
        half_edge from = stack[--depth];
        uint8_t n = p->faces[from.face].neighbors[from.edge];
        tl_polytope_face *face = &p->faces[n];
        if (face->seen) {
            continue;
        }
        uint8_t back = face->neighbors[0] == from.face ? 0 : face->neighbors[1] == from.face ? 1 : 2;
        if (sees(face, point, coplanar_sq)) {
            face->seen = true;
            v->seen[v->seen_count++] = n;
            half_edge next = { n, (uint8_t)((back + 1) % 3) }, last = { n, (uint8_t)((back + 2) % 3) };
            stack[depth++] = last;
            stack[depth++] = next;
        } else {
            half_edge edge = { n, back };
            v->rim[v->rim_count++] = edge;
        }
    }
}

// The face beyond an edge of the rim holds it the other way round: the rim runs to its `edge` from the one after.
static uint8_t rim_start(const tl_polytope *p, half_edge edge)
{
    return p->faces[edge.face].vertices[(edge.edge + 1) % 3];
}

static uint8_t rim_end(const tl_polytope *p, half_edge edge)
{
    return p->faces[edge.face].vertices[edge.edge];
}

static bool is_loop(const tl_polytope *p, const view *v)
{
    if (v->rim_count < 3) {
        return false;
    }
    uint8_t at = rim_end(p, v->rim[v->rim_count - 1]);
    for (uint32_t i = 0; i < v->rim_count; i++) {
        if (rim_start(p, v->rim[i]) != at) {
            return false;
        }
        at = rim_end(p, v->rim[i]);
    }
    return true;
}

// The slots of what is seen first, then free ones.
static uint8_t take_face(tl_polytope *p, const view *v, uint32_t i)
{
    return i < v->seen_count   ? v->seen[i]
           : p->free_count > 0 ? p->free_faces[--p->free_count]
                               : (uint8_t)p->face_count++;
}

// New triangles from the point to each edge of the rim. Neighbour 0 is beyond the rim, 1 the next triangle, 2 the last.
static void fan(tl_polytope *p, const view *v, uint8_t apex)
{
    uint8_t start = rim_start(p, v->rim[0]), first = 0, last = 0;
    tl_vec3d top = p->vertices[apex].w, to_start = tl_vec3d_sub(p->vertices[start].w, top);
    for (uint32_t i = 0; i < v->rim_count; i++) {
        uint8_t f = take_face(p, v, i), end = rim_end(p, v->rim[i]);
        tl_vec3d to_end = tl_vec3d_sub(p->vertices[end].w, top);
        tl_polytope_face *face = &p->faces[f];
        face->vertices[0] = start;
        face->vertices[1] = end;
        face->vertices[2] = apex;
        face->neighbors[0] = v->rim[i].face;
        face->neighbors[2] = last;
        p->faces[v->rim[i].face].neighbors[v->rim[i].edge] = f;
        set_plane(p, f, to_start, to_end);
        if (i == 0) {
            first = f;
        } else {
            p->faces[last].neighbors[1] = f;
        }
        last = f;
        start = end;
        to_start = to_end;
    }
    p->faces[first].neighbors[2] = last;
    p->faces[last].neighbors[1] = first;
}

bool tl_polytope_add(tl_polytope *p, uint32_t face, const tl_pair_point *point, double coplanar)
{
    view v;
    if (p->vertex_count == TL_POLYTOPE_VERTICES) {
        return false;
    }
    look(p, face, point->w, coplanar * coplanar, &v);
    if (!is_loop(p, &v)) {
        for (uint32_t i = 0; i < v.seen_count; i++) {
            p->faces[v.seen[i]].seen = false;
        }
        return false;
    }
    fan(p, &v, add_vertex(p, point));
    for (uint32_t i = v.rim_count; i < v.seen_count; i++) {
        p->keys[v.seen[i]] = (double)INFINITY;
        p->faces[v.seen[i]].seen = false;
        p->free_faces[p->free_count++] = v.seen[i];
    }
    TL_ASSERT(p->face_count <= TL_POLYTOPE_FACES);
    return true;
}
