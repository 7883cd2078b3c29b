// SPDX-License-Identifier: MIT
//
// The half-edge structure of the text that talus's own one follows, transcribed literally with all its slips, so that
// the tests can show each of them fail. Source: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons
// using Half Edges, 2013.
//
// Two things are ours, to keep the tests from crashing: the arrays have an entry before the first, so that index -1 can
// be read (and `bad_reads` counts it), and loops give up after TEXT_STEPS steps (and `endless` says so).

#ifndef TALUS_TEST_HALF_EDGE_TEXT_H
#define TALUS_TEST_HALF_EDGE_TEXT_H

#include <talus/vec.h>

#include <float.h>
#include <stdbool.h>
#include <string.h>

enum { TEXT_MAX = 4096, TEXT_STEPS = 10000 };

typedef struct text_edge {
    int vert, face, next, prev, twin, free_link;
    bool active;
} text_edge;

typedef struct text_vert {
    tl_vec3 position;
    int edge, free_link;
    bool active;
} text_vert;

typedef struct text_face {
    int edge, free_link;
    bool active;
} text_face;

typedef struct text_mesh {
    text_edge edges[TEXT_MAX + 1]; // entry i + 1 is index i
    text_vert verts[TEXT_MAX + 1];
    text_face faces[TEXT_MAX + 1];
    int edge_size, vert_size, face_size;
    int free_edges, free_verts, free_faces;
    unsigned num_verts, num_edges, num_faces, num_boundary_edges;
    struct {
        int v0, v1, edge;
    } map[TEXT_MAX]; // in the order of insertion; the text's is ordered by key
    int map_size;
    int bad_reads;
    bool endless;
} text_mesh;

static inline text_edge *text_edge_at(text_mesh *m, int e)
{
    m->bad_reads += e < 0;
    return &m->edges[e + 1];
}

static inline void text_clear(text_mesh *m)
{
    m->edge_size = m->vert_size = m->face_size = 0;
    m->num_verts = m->num_edges = m->num_faces = 0; // and not num_boundary_edges
    m->free_verts = m->free_edges = m->free_faces = -1;
    m->map_size = 0;
}

static inline void text_init(text_mesh *m)
{
    memset(m, 0, sizeof *m);
    text_edge none = { -1, -1, -1, -1, -1, -1, false };
    m->edges[0] = none;
    text_clear(m);
}

static inline int text_map_find(const text_mesh *m, int v0, int v1)
{
    for (int i = 0; i < m->map_size; i++) {
        if (m->map[i].v0 == v0 && m->map[i].v1 == v1) {
            return m->map[i].edge;
        }
    }
    return -1;
}

static inline void text_map_erase(text_mesh *m, int v0, int v1)
{
    for (int i = 0; i < m->map_size; i++) {
        if (m->map[i].v0 == v0 && m->map[i].v1 == v1) {
            m->map[i] = m->map[--m->map_size];
            return;
        }
    }
}

static inline int text_allocate_edge(text_mesh *m)
{
    int index = m->free_edges;
    if (index < 0) {
        index = m->edge_size++;
        text_edge none = { -1, -1, -1, -1, -1, -1, false };
        m->edges[index + 1] = none;
    } else {
        m->free_edges = m->edges[index + 1].free_link;
        m->edges[index + 1].free_link = -1;
    }
    m->edges[index + 1].active = true;
    return index;
}

static inline void text_free_edge(text_mesh *m, int e)
{
    m->edges[e + 1].free_link = m->free_edges;
    m->edges[e + 1].active = false;
    m->free_edges = e;
}

static inline int text_add_vert(text_mesh *m, tl_vec3 position)
{
    int v = m->free_verts;
    if (v < 0) {
        v = m->vert_size++;
    } else {
        m->free_verts = m->verts[v + 1].free_link;
    }
    m->verts[v + 1].active = true;
    m->verts[v + 1].free_link = -1;
    m->verts[v + 1].position = position;
    m->verts[v + 1].edge = -1;
    m->num_verts++;
    return v;
}

static inline int text_add_face(text_mesh *m, int a, int b, int c)
{
    const int face_verts[3] = { a, b, c };
    int f = m->free_faces;
    if (f < 0) {
        f = m->face_size++;
        m->faces[f + 1].edge = -1;
    } else {
        m->free_faces = m->faces[f + 1].free_link;
    }
    m->faces[f + 1].active = true;
    int face_edges[3] = { -1, -1, -1 };
    for (int i = 2, j = 0; j < 3; i = j++) {
        int v0 = face_verts[i], v1 = face_verts[j];
        int e01 = text_map_find(m, v0, v1), e10;
        if (e01 >= 0) {
            e10 = m->edges[e01 + 1].twin;
        } else {
            e01 = text_allocate_edge(m);
            e10 = text_allocate_edge(m);
            m->edges[e01 + 1].twin = e10;
            m->edges[e10 + 1].twin = e01;
            m->map[m->map_size].v0 = v0;
            m->map[m->map_size].v1 = v1;
            m->map[m->map_size++].edge = e01;
            m->map[m->map_size].v0 = v1;
            m->map[m->map_size].v1 = v0;
            m->map[m->map_size++].edge = e10;
            m->num_edges += 2;
            m->num_boundary_edges += 2;
        }
        text_edge *edge01 = text_edge_at(m, e01), *edge10 = text_edge_at(m, e10);
        if (edge01->vert < 0) {
            edge01->vert = v1;
        }
        if (edge10->vert < 0) {
            edge10->vert = v0;
        }
        if (edge01->face < 0) {
            edge01->face = f;
            m->num_boundary_edges--;
        }
        if (m->verts[v0 + 1].edge < 0) {
            m->verts[v0 + 1].edge = e01;
        }
        if (m->faces[f + 1].edge < 0) {
            m->faces[f + 1].edge = e01;
        }
        face_edges[i] = e01;
    }
    for (int i = 2, j = 0; j < 3; i = j++) {
        m->edges[face_edges[i] + 1].next = face_edges[j];
        m->edges[face_edges[j] + 1].prev = face_edges[i];
    }
    m->num_faces++;
    return f;
}

static inline int text_find_vert_edge(const text_mesh *m, int v)
{
    for (int i = 0; i < m->map_size; i++) {
        if (m->map[i].v0 == v) {
            return m->map[i].edge;
        }
    }
    return -1;
}

static inline void text_remove_face(text_mesh *m, int f)
{
    int start = m->faces[f + 1].edge, e = start, i = 0, steps = 0;
    int face_verts[3] = { -1, -1, -1 }, face_edges[3] = { -1, -1, -1 };
    do {
        text_edge *edge = text_edge_at(m, e);
        int t = edge->twin, n = edge->next, p = edge->prev;
        text_edge *twin = text_edge_at(m, t), *prev = text_edge_at(m, p);
        if (i < 3) {
            face_verts[i] = edge->vert;
            face_edges[i] = e;
        }
        i++;
        if (twin->face < 0) {
            text_map_erase(m, edge->vert, prev->vert);
            text_map_erase(m, prev->vert, edge->vert);
            edge->twin = -1;
            twin->twin = -1;
            text_free_edge(m, e);
            text_free_edge(m, t);
            m->num_edges -= 2;
            m->num_boundary_edges -= 2;
        }
        m->num_boundary_edges++;
        e = n;
        m->endless = m->endless || ++steps > TEXT_STEPS;
    } while (e != start && !m->endless && e >= 0);
    for (i = 0; i < 3; i++) {
        text_edge *edge = text_edge_at(m, face_edges[i]);
        edge->next = edge->prev = edge->vert = edge->face = -1;
    }
    for (i = 0; i < 3; i++) {
        m->verts[face_verts[i] + 1].edge = text_find_vert_edge(m, face_verts[i]);
    }
    m->faces[f + 1].edge = -1;
    m->faces[f + 1].free_link = m->free_faces;
    m->faces[f + 1].active = false;
    m->free_faces = f;
    m->num_faces--;
}

static inline void text_remove_vert(text_mesh *m, int v)
{
    int start = m->verts[v + 1].edge, steps = 0;
    if (start >= 0) {
        int e = start;
        do {
            int face = text_edge_at(m, e)->face;
            if (face >= 0) {
                text_remove_face(m, face);
            }
            e = text_edge_at(m, text_edge_at(m, e)->prev)->twin;
            m->endless = m->endless || ++steps > TEXT_STEPS;
        } while (e != start && !m->endless && e >= 0);
    }
    m->verts[v + 1].edge = -1;
    m->verts[v + 1].free_link = m->free_verts;
    m->verts[v + 1].active = false;
    m->free_verts = v;
    m->num_verts--;
}

/// The text's support with its index slip; the epsilon is what a reader would take for it.
static inline int text_support(text_mesh *m, tl_vec3 dir, int first, float epsilon, bool index_slip)
{
    int best_index = first;
    text_vert *best = &m->verts[first + 1];
    float best_dot = tl_dot(dir, best->position);
    bool end = false;
    int steps = 0;
    while (!end && steps < TEXT_STEPS) {
        int start = best->edge, e = start;
        float old = best_dot;
        do {
            int vert = text_edge_at(m, e)->vert;
            float dot = tl_dot(dir, m->verts[vert + 1].position);
            if (dot >= best_dot + epsilon) {
                best_index = index_slip ? best_index : vert;
                best = &m->verts[vert + 1];
                best_dot = dot;
            }
            int twin = text_edge_at(m, e)->twin;
            e = text_edge_at(m, twin)->next;
            m->endless = m->endless || ++steps > TEXT_STEPS;
        } while (start != e && e >= 0 && !m->endless);
        end = best_dot == old;
    }
    return best_index;
}

#endif
