// SPDX-License-Identifier: MIT
//
// Incremental hull of at most TL_POLYTOPE_VERTICES points, on the stack.
//
// A point sees a face also when it lies in the face's plane, to within rounding. Then a rim's edge always has a face
// behind it that the point is clearly below, so the point is not on the edge's line and no new triangle is a sliver;
// coplanar triangles are merely fanned anew. Seeing only what is strictly in front (the usual choice) makes slivers
// whose normals point anywhere, and is why EPA has its name for failing on boxes.

#include "convex/polytope.h"

#include "base/assert.h"

static void set_plane(tl_polytope *p, uint32_t f)
{
    tl_polytope_face *face = &p->faces[f];
    tl_vec3d a = p->vertices[face->vertices[0]].w, b = p->vertices[face->vertices[1]].w,
             c = p->vertices[face->vertices[2]].w;
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double length = tl_vec3d_length(n);
    face->normal = length > 0.0 ? tl_vec3d_scale(n, 1.0 / length) : n;
    face->live = true;
    face->visible = false;
    p->distances[f] = tl_vec3d_dot(face->normal, a);
}

static uint32_t add_vertex(tl_polytope *p, const tl_pair_point *point)
{
    p->vertices[p->vertex_count].w = point->w;
    p->vertices[p->vertex_count].a = point->a;
    return p->vertex_count++;
}

void tl_polytope_init(tl_polytope *p, const tl_pair_point points[4], double coplanar)
{
    static const uint16_t corners[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };
    static const uint16_t neighbors[4][3] = { { 1, 3, 2 }, { 2, 3, 0 }, { 0, 3, 1 }, { 1, 2, 0 } };
    p->vertex_count = p->free_count = 0;
    p->face_count = 4;
    p->coplanar = coplanar;
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
        set_plane(p, f);
    }
}

uint32_t tl_polytope_nearest_face(const tl_polytope *p)
{
    uint32_t best = 0;
    for (uint32_t f = 1; f < p->face_count; f++) {
        best = p->distances[f] < p->distances[best] ? f : best;
    }
    return best;
}

// Marks what the point sees, starting at a face that it surely sees, and lists it. Connected by construction.
static uint32_t flood(tl_polytope *p, uint32_t first, tl_vec3d point, uint16_t *seen)
{
    uint32_t count = 1;
    seen[0] = (uint16_t)first;
    p->faces[first].visible = true;
    for (uint32_t i = 0; i < count; i++) {
        const tl_polytope_face *face = &p->faces[seen[i]];
        for (int e = 0; e < 3; e++) {
            uint16_t n = face->neighbors[e];
            if (!p->faces[n].visible && tl_vec3d_dot(p->faces[n].normal, point) - p->distances[n] > -p->coplanar) {
                p->faces[n].visible = true;
                seen[count++] = n;
            }
        }
    }
    return count;
}

typedef struct rim_edge {
    uint16_t to;      // the edge's end; the index in the table is its start
    uint16_t outside; // the face beyond it
} rim_edge;

static const uint16_t no_edge = UINT16_MAX;

// The edges between seen and unseen faces, by the vertex that each starts at. Returns how many, 0 when two start at
// one vertex or none is left.
static uint32_t collect_rim(const tl_polytope *p, const uint16_t *seen, uint32_t seen_count, rim_edge *rim,
                            uint16_t *start_out)
{
    uint32_t count = 0;
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        rim[v].to = no_edge;
    }
    for (uint32_t i = 0; i < seen_count; i++) {
        const tl_polytope_face *face = &p->faces[seen[i]];
        for (int e = 0; e < 3; e++) {
            if (!p->faces[face->neighbors[e]].visible) {
                uint16_t from = face->vertices[e];
                if (rim[from].to != no_edge) {
                    return 0;
                }
                rim[from].to = face->vertices[(e + 1) % 3];
                rim[from].outside = face->neighbors[e];
                *start_out = from;
                count++;
            }
        }
    }
    return count;
}

static bool is_one_loop(const rim_edge *rim, uint16_t start, uint32_t count)
{
    uint16_t v = start;
    for (uint32_t i = 0; i < count; i++) {
        v = rim[v].to;
        if (v == no_edge || (v == start && i + 1 < count)) {
            return false;
        }
    }
    return v == start;
}

static uint16_t take_face(tl_polytope *p)
{
    return p->free_count > 0 ? p->free_faces[--p->free_count] : (uint16_t)p->face_count++;
}

// New triangles from the point to each edge of the rim. Neighbour 0 is beyond the rim, 1 the next triangle, 2 the last.
static void fan(tl_polytope *p, const rim_edge *rim, uint16_t start, uint32_t count, uint16_t apex)
{
    uint16_t first = 0, last = 0, v = start;
    for (uint32_t i = 0; i < count; i++) {
        uint16_t f = take_face(p), to = rim[v].to, outside = rim[v].outside;
        tl_polytope_face *face = &p->faces[f];
        face->vertices[0] = v;
        face->vertices[1] = to;
        face->vertices[2] = apex;
        face->neighbors[0] = outside;
        for (int e = 0; e < 3; e++) {
            if (p->faces[outside].vertices[e] == to) {
                p->faces[outside].neighbors[e] = f;
            }
        }
        set_plane(p, f);
        if (i == 0) {
            first = f;
        } else {
            face->neighbors[2] = last;
            p->faces[last].neighbors[1] = f;
        }
        last = f;
        v = to;
    }
    p->faces[first].neighbors[2] = last;
    p->faces[last].neighbors[1] = first;
}

bool tl_polytope_add(tl_polytope *p, uint32_t face, const tl_pair_point *point)
{
    uint16_t seen[TL_POLYTOPE_FACES], start = 0;
    rim_edge rim[TL_POLYTOPE_VERTICES];
    if (p->vertex_count == TL_POLYTOPE_VERTICES) {
        return false;
    }
    uint32_t seen_count = flood(p, face, point->w, seen);
    uint32_t rim_count = collect_rim(p, seen, seen_count, rim, &start);
    // A disk of triangles has at least as many rim edges as a triangle, and at most two more than triangles.
    if (rim_count < 3 || rim_count > seen_count + 2 || !is_one_loop(rim, start, rim_count)) {
        for (uint32_t i = 0; i < seen_count; i++) {
            p->faces[seen[i]].visible = false;
        }
        return false;
    }
    for (uint32_t i = 0; i < seen_count; i++) {
        p->faces[seen[i]].live = false;
        p->faces[seen[i]].visible = false;
        p->distances[seen[i]] = (double)INFINITY;
        p->free_faces[p->free_count++] = seen[i];
    }
    fan(p, rim, start, rim_count, (uint16_t)add_vertex(p, point));
    TL_ASSERT(p->face_count <= TL_POLYTOPE_FACES);
    return true;
}
