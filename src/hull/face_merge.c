// SPDX-License-Identifier: MIT
//
// Triangles to polygons: neighbours that lie in exactly one plane become one face, and vertices that are no strict
// corners of the body go.
//
// Coplanarity is exact, so it is transitive, and a group of coplanar triangles is a convex polygon. A vertex inside
// such a polygon keeps no edge, one inside an edge keeps two; every other vertex meets three planes or more and stays.
// For hill climbing this is needed, not cosmetic: a vertex inside a flat face has no strictly better neighbour when the
// direction points away from the face, so a climb would stop at a minimum.

#include "hull/quickhull.h"

#include "base/assert.h"
#include "base/radix_sort.h"

typedef struct merge_state {
    tl_quickhull *hull;
    uint32_t *group;  // [face_count] of each triangle
    uint32_t *degree; // [point_count] edges between groups at each point; then the vertex's number
    uint32_t *chain;  // [3 * face_count] the merged edge that starts with this half-edge
    uint32_t group_count;
    uint32_t chain_count;
    uint32_t *chain_start; // [chain_count]
    uint32_t *chain_next;  // [chain_count] next merged edge of the same face
    uint32_t *chain_twin;  // [chain_count]
} merge_state;

static bool is_border(const merge_state *m, uint32_t half_edge)
{
    const tl_quickhull_face *face = &m->hull->faces[half_edge / 3];
    return m->group[half_edge / 3] != m->group[face->across[half_edge % 3] / 3];
}

static uint32_t origin(const merge_state *m, uint32_t half_edge)
{
    return m->hull->faces[half_edge / 3].vertex[half_edge % 3];
}

static uint32_t twin(const merge_state *m, uint32_t half_edge)
{
    return m->hull->faces[half_edge / 3].across[half_edge % 3];
}

// The next border half-edge around the same group.
static uint32_t next_border(const merge_state *m, uint32_t half_edge)
{
    uint32_t next = tl_half_edge_next(half_edge);
    while (!is_border(m, next)) {
        next = tl_half_edge_next(twin(m, next));
    }
    return next;
}

static void flood_groups(merge_state *m)
{
    tl_quickhull *hull = m->hull;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        m->group[f] = TL_NONE;
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        if (!hull->faces[f].live || m->group[f] != TL_NONE) {
            continue;
        }
        // All are measured against the first one's plane; hull->visible serves as the queue.
        const tl_side_plane *plane = &hull->faces[f].plane;
        uint32_t count = 0;
        m->group[f] = m->group_count;
        hull->visible[count++] = f;
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t across = hull->faces[hull->visible[i]].across[k];
                uint32_t other = across / 3;
                uint32_t apex = hull->faces[other].vertex[(across + 2) % 3];
                double value;
                if (m->group[other] == TL_NONE && tl_side_plane_test(plane, hull->points[apex], &value) == 0) {
                    m->group[other] = m->group_count;
                    hull->visible[count++] = other;
                }
            }
        }
        m->group_count++;
    }
}

static tl_result make_chains(merge_state *m)
{
    tl_quickhull *hull = m->hull;
    for (uint32_t h = 0; h < 3 * hull->face_count; h++) {
        m->chain[h] = TL_NONE;
        if (hull->faces[h / 3].live && is_border(m, h)) {
            m->degree[origin(m, h)]++;
        }
    }
    for (uint32_t h = 0; h < 3 * hull->face_count; h++) {
        if (hull->faces[h / 3].live && is_border(m, h) && m->degree[origin(m, h)] >= 3) {
            m->chain[h] = m->chain_count++;
        }
    }
    m->chain_start = TL_PUSH(hull->arena, uint32_t, m->chain_count);
    m->chain_next = TL_PUSH(hull->arena, uint32_t, m->chain_count);
    m->chain_twin = TL_PUSH(hull->arena, uint32_t, m->chain_count);
    if (m->chain_start == NULL || m->chain_next == NULL || m->chain_twin == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t h = 0; h < 3 * hull->face_count; h++) {
        uint32_t chain = m->chain[h];
        if (chain == TL_NONE) {
            continue;
        }
        uint32_t last = h, next = next_border(m, h);
        while (m->chain[next] == TL_NONE) {
            last = next;
            next = next_border(m, next);
        }
        m->chain_start[chain] = h;
        m->chain_next[chain] = m->chain[next];
        m->chain_twin[chain] = m->chain[twin(m, last)];
    }
    return TL_OK;
}

// Vertices in the order of their points.
static tl_result number_vertices(merge_state *m, tl_hull_polygons *out)
{
    uint32_t count = 0;
    for (uint32_t p = 0; p < m->hull->point_count; p++) {
        count += m->degree[p] >= 3;
    }
    out->points = TL_PUSH(m->hull->arena, uint32_t, count);
    if (out->points == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < m->hull->point_count; p++) {
        if (m->degree[p] >= 3) {
            m->degree[p] = out->vertex_count;
            out->points[out->vertex_count++] = p;
        }
    }
    return TL_OK;
}

// Faces in the order of (lowest vertex, vertex after it), each starting there: the same for any order of insertion.
static tl_result number_faces(merge_state *m, tl_hull_polygons *out)
{
    tl_arena *arena = m->hull->arena;
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, m->group_count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, m->group_count);
    uint32_t *final = TL_PUSH(arena, uint32_t, m->chain_count);
    out->half_edges = TL_PUSH(arena, tl_hull_half_edge, m->chain_count);
    out->faces = TL_PUSH(arena, tl_hull_face, m->group_count);
    if (items == NULL || scratch == NULL || final == NULL || out->half_edges == NULL || out->faces == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t g = 0; g < m->group_count; g++) {
        items[g].key = UINT64_MAX;
    }
    for (uint32_t c = 0; c < m->chain_count; c++) {
        uint32_t a = m->degree[origin(m, m->chain_start[c])];
        uint32_t b = m->degree[origin(m, m->chain_start[m->chain_next[c]])];
        uint32_t g = m->group[m->chain_start[c] / 3];
        uint64_t key = (uint64_t)a << 32 | b;
        if (key < items[g].key) {
            items[g].key = key;
            items[g].value = c;
        }
    }
    tl_radix_sort(items, scratch, m->group_count);
    uint32_t count = 0;
    for (uint32_t f = 0; f < m->group_count; f++) {
        out->faces[f].first = count;
        uint32_t c = items[f].value;
        do {
            final[c] = count++;
            c = m->chain_next[c];
        } while (c != items[f].value);
        out->faces[f].count = count - out->faces[f].first;
    }
    for (uint32_t f = 0; f < m->group_count; f++) {
        uint32_t c = items[f].value;
        for (uint32_t k = 0; k < out->faces[f].count; k++, c = m->chain_next[c]) {
            tl_hull_half_edge *h = &out->half_edges[final[c]];
            h->origin = m->degree[origin(m, m->chain_start[c])];
            h->twin = final[m->chain_twin[c]];
            h->next = final[m->chain_next[c]];
            h->face = f;
        }
    }
    out->face_count = m->group_count;
    out->half_edge_count = count;
    return TL_OK;
}

tl_result tl_quickhull_merge_faces(tl_quickhull *hull, tl_hull_polygons *polygons_out)
{
    tl_hull_polygons polygons = { 0, 0, 0, NULL, NULL, NULL };
    merge_state m = { hull, NULL, NULL, NULL, 0, 0, NULL, NULL, NULL };
    m.group = TL_PUSH(hull->arena, uint32_t, hull->face_count);
    m.degree = TL_PUSH_ZERO(hull->arena, uint32_t, hull->point_count);
    m.chain = TL_PUSH(hull->arena, uint32_t, 3 * (uint64_t)hull->face_count);
    if (m.group == NULL || m.degree == NULL || m.chain == NULL) {
        return TL_ERR_MEMORY;
    }
    flood_groups(&m);
    TL_TRY(make_chains(&m));
    TL_TRY(number_vertices(&m, &polygons));
    TL_TRY(number_faces(&m, &polygons));
    *polygons_out = polygons;
    return TL_OK;
}
