// SPDX-License-Identifier: MIT
//
// Triangles to polygons: neighbours that lie in exactly one plane become one face, and vertices that are no strict
// corners of the body go.
//
// Coplanarity is exact, so it is transitive, and a group of coplanar triangles is a convex polygon with one border. So
// it is enough to test once whether each edge is flat, and to walk the borders. A vertex inside such a polygon keeps
// no edge, one inside an edge keeps two; every other vertex meets three planes or more and stays.
// For hill climbing this is needed, not cosmetic: a vertex inside a flat face has no strictly better neighbour when the
// direction points away from the face, so a climb would stop at a minimum.

#include "hull/bake/quickhull.h"

#include "base/assert.h"
#include "base/radix_sort.h"

#include <string.h>

// What is known of a half-edge, before those that start an edge of the result get their final numbers.
#define BORDER 0u      // the group to its left ends here
#define WALKED 1u      // and starts an edge that has been walked
#define FLAT   TL_NONE // both sides lie in one plane, or the face is dead

typedef struct merge_state {
    tl_quickhull *hull;
    uint32_t *degree; // [point_count] border edges at each point
    uint32_t *number; // [point_count] the vertex's number, where the degree is 3 or more
    uint32_t *mark;   // [4 * face_count] BORDER, WALKED or FLAT; then final numbers
    uint32_t group_count;
    uint32_t edge_count;  // final half-edges
    bool has_flat_edges;  // else each triangle is a face
    tl_sort_item *groups; // [group_count] key: lowest vertex and the one after it; value: the half-edge between them
} merge_state;

static uint32_t origin(const merge_state *m, uint32_t half_edge)
{
    return m->hull->faces[tl_half_edge_face(half_edge)].vertex[tl_half_edge_corner(half_edge)];
}

static uint32_t triangle_twin(const merge_state *m, uint32_t half_edge)
{
    return m->hull->faces[tl_half_edge_face(half_edge)].across[tl_half_edge_corner(half_edge)];
}

// The next border half-edge around the same group.
static uint32_t next_border(const merge_state *m, uint32_t half_edge)
{
    uint32_t next = tl_half_edge_next(half_edge);
    while (m->mark[next] == FLAT) {
        next = tl_half_edge_next(triangle_twin(m, next));
    }
    return next;
}

// The same, but to where the next straight edge starts: over the vertices that only two groups meet at. `last_out` gets
// the last border half-edge of this one.
static inline uint32_t next_straight_edge(const merge_state *m, uint32_t half_edge, uint32_t *last_out)
{
    *last_out = half_edge;
    uint32_t next = next_border(m, half_edge);
    while (m->degree[origin(m, next)] < 3) {
        *last_out = next;
        next = next_border(m, next);
    }
    return next;
}

static tl_result find_borders(merge_state *m)
{
    const tl_quickhull *hull = m->hull;
    uint32_t borders = 0;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        TL_TRY(tl_quickhull_count_work(m->hull, 1));
        for (uint32_t k = 0; k < 3; k++) {
            m->mark[4 * f + k] = FLAT;
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        TL_TRY(tl_quickhull_count_work(m->hull, 1));
        const tl_quickhull_face *face = &hull->faces[f];
        for (uint32_t k = 0; k < 3 && hull->conflicts[f].live; k++) {
            uint32_t across = face->across[k], corner = tl_half_edge_corner(across);
            if (across < 4 * f + k) {
                continue; // tested from there
            }
            uint32_t apex = hull->faces[tl_half_edge_face(across)].vertex[corner == 0 ? 2 : corner - 1];
            double height;
            if (tl_quickhull_side(hull, face, hull->local[apex].position, &height) != 0) {
                m->mark[4 * f + k] = m->mark[across] = BORDER;
                borders += 2;
                m->degree[face->vertex[k]]++;
                m->degree[face->vertex[k == 2 ? 0 : k + 1]]++;
            }
        }
    }
    m->has_flat_edges = borders != 3 * hull->live_faces;
    return TL_OK;
}

// Where no edge is flat, as of points in no order, each triangle is a group.
static tl_result take_triangles(merge_state *m, uint32_t key_shift)
{
    const tl_quickhull *hull = m->hull;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        TL_TRY(tl_quickhull_count_work(m->hull, 1));
        if (!hull->conflicts[f].live) {
            continue;
        }
        const uint32_t *v = hull->faces[f].vertex;
        const uint32_t lowest = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
        tl_sort_item *group = &m->groups[m->group_count++];
        group->value = 4 * f + lowest;
        group->key = (uint64_t)v[lowest] << key_shift | v[lowest == 2 ? 0 : lowest + 1];
    }
    m->edge_count = 3 * m->group_count;
    return TL_OK;
}

// Walks each border once, from the lowest half-edge of it that starts an edge.
static tl_result find_groups(merge_state *m, uint32_t key_shift)
{
    const tl_quickhull *hull = m->hull;
    for (uint32_t h = 0; h < 4 * hull->face_count; h++) {
        if (tl_half_edge_corner(h) == 3 || m->mark[h] != BORDER || m->degree[origin(m, h)] < 3) {
            continue;
        }
        uint32_t edge = h, last, lowest = h, least = origin(m, h);
        do {
            m->mark[edge] = WALKED;
            edge = next_straight_edge(m, edge, &last);
            const uint32_t begin = origin(m, edge);
            lowest = begin < least ? edge : lowest;
            least = begin < least ? begin : least;
            m->edge_count++;
            TL_TRY(tl_quickhull_count_work(m->hull, 1));
        } while (edge != h);
        tl_sort_item *group = &m->groups[m->group_count++];
        group->value = lowest;
        group->key = (uint64_t)least << key_shift | origin(m, next_straight_edge(m, lowest, &last));
    }
    return TL_OK;
}

// Vertices in the order of their points.
static tl_result number_strict_corners(merge_state *m, tl_hull_polygons *out)
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
            m->number[p] = out->vertex_count;
            out->points[out->vertex_count++] = p;
        }
    }
    return TL_OK;
}

// Writes the loop of a group from edge `count` on, its twins still in the triangles' numbers; the count behind it.
static uint32_t number_group(const merge_state *m, uint32_t group, uint32_t count, tl_hull_half_edge *half_edges)
{
    const uint32_t start = m->groups[group].value;
    uint32_t edge = start, last;
    do {
        const uint32_t next = next_straight_edge(m, edge, &last);
        const tl_hull_half_edge half_edge = { m->number[origin(m, edge)], triangle_twin(m, last), count + 1, group };
        m->mark[edge] = count;
        half_edges[count++] = half_edge;
        edge = next;
    } while (edge != start);
    return count;
}

// The same where each group is a triangle.
static uint32_t number_triangle(const merge_state *m, uint32_t group, uint32_t count, tl_hull_half_edge *half_edges)
{
    const uint32_t start = m->groups[group].value, first = start & ~3u;
    const tl_quickhull_face *face = &m->hull->faces[tl_half_edge_face(start)];
    for (uint32_t i = 0, k = start - first; i < 3; i++, k = k == 2 ? 0 : k + 1) {
        const tl_hull_half_edge half_edge = { m->number[face->vertex[k]], face->across[k], count + 1, group };
        m->mark[first + k] = count;
        half_edges[count++] = half_edge;
    }
    return count;
}

// Faces in the order of (lowest vertex, vertex after it), each starting there: the same for any order of insertion.
static tl_result number_polygons(merge_state *m, tl_hull_polygons *out)
{
    tl_sort_item *scratch = TL_PUSH(m->hull->arena, tl_sort_item, m->group_count);
    out->half_edges = TL_PUSH(m->hull->arena, tl_hull_half_edge, m->edge_count);
    out->faces = TL_PUSH(m->hull->arena, tl_hull_face, m->group_count);
    if (scratch == NULL || out->half_edges == NULL || out->faces == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_radix_sort_in_stage(m->groups, scratch, m->group_count, m->hull->stage));
    uint32_t count = 0;
    for (uint32_t f = 0; f < m->group_count; f++) {
        const uint32_t first = count;
        count = m->has_flat_edges ? number_group(m, f, first, out->half_edges)
                                  : number_triangle(m, f, first, out->half_edges);
        out->half_edges[count - 1].next = first;
        out->faces[f].first = first;
        out->faces[f].count = count - first;
        TL_TRY(tl_quickhull_count_work(m->hull, count - first));
    }
    for (uint32_t e = 0; e < count; e++) {
        out->half_edges[e].twin = m->mark[out->half_edges[e].twin];
        TL_TRY(tl_stage_tick(m->hull->stage, e));
    }
    out->face_count = m->group_count;
    out->half_edge_count = count;
    return TL_OK;
}

tl_result tl_quickhull_merge_faces(tl_quickhull *hull, tl_hull_polygons *polygons_out)
{
    merge_state m;
    memset(&m, 0, sizeof m);
    m.hull = hull;
    m.degree = TL_PUSH_ZERO(hull->arena, uint32_t, hull->point_count);
    m.number = hull->cone_face; // no step will need it again
    m.mark = TL_PUSH(hull->arena, uint32_t, 4 * (uint64_t)hull->face_count);
    m.groups = TL_PUSH(hull->arena, tl_sort_item, hull->live_faces);
    if (m.degree == NULL || m.mark == NULL || m.groups == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t key_shift = 0;
    while (hull->point_count >> key_shift != 0) {
        key_shift++;
    }
    memset(polygons_out, 0, sizeof *polygons_out);
    TL_TRY(find_borders(&m));
    TL_TRY(m.has_flat_edges ? find_groups(&m, key_shift) : take_triangles(&m, key_shift));
    TL_TRY(number_strict_corners(&m, polygons_out));
    return number_polygons(&m, polygons_out);
}
