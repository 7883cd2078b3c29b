// SPDX-License-Identifier: MIT
//
// Pairing: a matching of triangles over shared edges, as large as can be had in linear time, short pairs first.
//
// A triangle that has one free neighbour left is matched with it at once: some maximum matching contains that edge, so
// nothing is lost (Karp and Sipser, Maximum matchings in sparse random graphs, 1981). While there is none, the free
// edge whose pair has the smallest box, measured against its two triangles' boxes, is taken: what pairs cost a tree is
// the surface that their common box adds. Greedy by cost alone leaves every tenth triangle single; a maximum matching
// by augmenting paths alone ignores the boxes and undoes good pairs.
//
// Nothing is assumed about the mesh. An edge with more than two triangles offers each neighbour in its list once, two
// triangles with the same three corners are neighbours too, and winding plays no part: the text's pair A B C, A C D is
// stored with the order in which each triangle really runs.
//
// Source: Christer Ericson, "Chunky triangle soup", 2009.

#include "base/assert.h"
#include "base/radix_sort.h"
#include "soup/soup_build.h"
#include "soup/soup_layout.h"

#include <string.h>

// Rows 1 to 6 are the six orders of three slots; rows 0 and 7 keep any three bits in range.
const uint8_t tl_soup_corner_slots[8][3] = { { 0, 1, 2 }, { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                             { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 }, { 0, 1, 2 } };

// Two triangles across one edge; the edge is edge_k[i] of triangle[i], running from its corner k to k + 1.
typedef struct link {
    uint32_t triangle[2];
    uint8_t edge_k[2];
} link;

typedef struct matcher {
    const tl_mesh *mesh;
    link *links;
    uint32_t link_count;
    uint32_t *order;      // links by cost
    uint32_t *first_link; // [triangle_count + 1] into link_list
    uint32_t *link_list;  // links of each triangle, cheapest first
    uint32_t *degree;     // links to free neighbours; of free triangles
    uint32_t *mate;       // the link by which a triangle is matched, or UINT32_MAX
    uint32_t *stack;      // triangles that came down to one free neighbour
    uint32_t stack_count;
} matcher;

static tl_aabb triangle_box(const tl_mesh *mesh, uint32_t triangle)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t k = 0; k < 3; k++) {
        box = tl_aabb_add_point(box, mesh->vertices[mesh->indices[3 * (size_t)triangle + k]]);
    }
    return box;
}

// Surface of the common box over the surfaces of both boxes; 0.5 for two equal boxes. Flat boxes of zero surface
// (a triangle is never a line, so its box has surface) do not occur; underflow of tiny ones gives NaN, which sorts
// last.
static float link_cost(const tl_aabb *boxes, const link *l)
{
    tl_aabb first = boxes[l->triangle[0]], second = boxes[l->triangle[1]];
    return tl_aabb_half_area(tl_aabb_union(first, second)) / (tl_aabb_half_area(first) + tl_aabb_half_area(second));
}

static inline tl_sort_item edge_item(const tl_mesh *mesh, uint32_t edge)
{
    uint32_t from = mesh->indices[edge];
    uint32_t to = mesh->indices[edge % 3 == 2 ? edge - 2 : edge + 1];
    tl_sort_item item = { from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from, edge, 0 };
    return item;
}

static void add_link(matcher *m, uint32_t first_edge, uint32_t second_edge)
{
    link *l = &m->links[m->link_count++];
    const uint32_t edges[2] = { first_edge, second_edge };
    for (uint32_t side = 0; side < 2; side++) {
        l->triangle[side] = edges[side] / 3;
        l->edge_k[side] = (uint8_t)(edges[side] % 3);
    }
}

// Every edge of every triangle, sorted by its two vertices: runs of equal keys are triangles around one edge. The lower
// vertex has few edges, so one scatter by it leaves little to sort.
static tl_result find_links(matcher *m, tl_arena *arena)
{
    uint32_t edge_count = 3 * m->mesh->triangle_count;
    m->links = TL_PUSH(arena, link, edge_count);
    tl_arena_mark mark = tl_arena_get_mark(arena);
    uint32_t *ends = TL_PUSH_ZERO(arena, uint32_t, (uint64_t)m->mesh->vertex_count + 1);
    tl_sort_item *edges = TL_PUSH(arena, tl_sort_item, edge_count);
    if (m->links == NULL || ends == NULL || edges == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < edge_count; i++) {
        ends[(edge_item(m->mesh, i).key >> 32) + 1]++;
    }
    uint32_t most = 0;
    for (uint32_t i = 1; i <= m->mesh->vertex_count; i++) {
        most = ends[i] > most ? ends[i] : most;
        ends[i] += ends[i - 1];
    }
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, most);
    if (scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    // Each vertex' beginning moves on to its end.
    for (uint32_t i = 0; i < edge_count; i++) {
        tl_sort_item item = edge_item(m->mesh, i);
        edges[ends[item.key >> 32]++] = item;
    }
    m->link_count = 0;
    for (uint32_t vertex = 0, begin = 0; vertex < m->mesh->vertex_count; begin = ends[vertex++]) {
        tl_radix_sort(edges + begin, scratch, ends[vertex] - begin);
        for (uint32_t i = begin + 1; i < ends[vertex]; i++) {
            if (edges[i].key == edges[i - 1].key) {
                add_link(m, edges[i - 1].value, edges[i].value);
            }
        }
    }
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

// Costs as steps of at most a per cent, from 0.5 to 128: finer ones cost more time than better pairs
// gain. What is dearer, or NaN, is in the last step.
enum { COST_STEPS = 1024, COST_SHIFT = 16, COST_OF_HALF = 0x3f00 };

static uint32_t cost_step(float cost)
{
    uint32_t bits;
    memcpy(&bits, &cost, sizeof bits);
    uint32_t step = bits >> COST_SHIFT;
    step = step > COST_OF_HALF ? step - COST_OF_HALF : 0;
    return step < COST_STEPS ? step : COST_STEPS - 1;
}

// Links by cost, of equal cost by index.
static tl_result order_links(matcher *m, tl_arena *arena)
{
    m->order = TL_PUSH(arena, uint32_t, m->link_count);
    tl_arena_mark mark = tl_arena_get_mark(arena);
    tl_aabb *boxes = TL_PUSH(arena, tl_aabb, m->mesh->triangle_count);
    uint16_t *steps = TL_PUSH(arena, uint16_t, m->link_count);
    if (m->order == NULL || boxes == NULL || steps == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < m->mesh->triangle_count; i++) {
        boxes[i] = triangle_box(m->mesh, i);
    }
    uint32_t begin[COST_STEPS + 1] = { 0 };
    for (uint32_t i = 0; i < m->link_count; i++) {
        steps[i] = (uint16_t)cost_step(link_cost(boxes, &m->links[i]));
        begin[steps[i] + 1]++;
    }
    for (uint32_t step = 1; step < COST_STEPS; step++) {
        begin[step] += begin[step - 1];
    }
    for (uint32_t i = 0; i < m->link_count; i++) {
        m->order[begin[steps[i]]++] = i;
    }
    tl_arena_rollback(arena, mark);
    return TL_OK;
}

static tl_result index_links(matcher *m, tl_arena *arena)
{
    uint32_t triangle_count = m->mesh->triangle_count;
    m->first_link = TL_PUSH_ZERO(arena, uint32_t, (uint64_t)triangle_count + 2);
    m->link_list = TL_PUSH(arena, uint32_t, 2 * (uint64_t)m->link_count);
    m->degree = TL_PUSH(arena, uint32_t, triangle_count);
    m->mate = TL_PUSH(arena, uint32_t, triangle_count);
    // A triangle is pushed when its degree falls to one, which happens once: degrees only fall.
    m->stack = TL_PUSH(arena, uint32_t, triangle_count);
    if (m->first_link == NULL || m->link_list == NULL || m->degree == NULL || m->mate == NULL || m->stack == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < m->link_count; i++) {
        m->first_link[m->links[i].triangle[0] + 2]++;
        m->first_link[m->links[i].triangle[1] + 2]++;
    }
    for (uint32_t i = 0; i < triangle_count; i++) {
        m->degree[i] = m->first_link[i + 2];
        m->first_link[i + 2] += m->first_link[i + 1];
        m->mate[i] = UINT32_MAX;
    }
    for (uint32_t i = 0; i < m->link_count; i++) {
        for (uint32_t side = 0; side < 2; side++) {
            m->link_list[m->first_link[m->links[m->order[i]].triangle[side] + 1]++] = m->order[i];
        }
    }
    return TL_OK;
}

static uint32_t other_end(const link *l, uint32_t triangle)
{
    return l->triangle[l->triangle[0] == triangle];
}

static void match(matcher *m, uint32_t link_index)
{
    const link *l = &m->links[link_index];
    m->mate[l->triangle[0]] = link_index;
    m->mate[l->triangle[1]] = link_index;
    for (uint32_t side = 0; side < 2; side++) {
        uint32_t triangle = l->triangle[side];
        for (uint32_t i = m->first_link[triangle]; i < m->first_link[triangle + 1]; i++) {
            uint32_t neighbour = other_end(&m->links[m->link_list[i]], triangle);
            if (m->mate[neighbour] == UINT32_MAX && --m->degree[neighbour] == 1) {
                m->stack[m->stack_count++] = neighbour;
            }
        }
    }
}

static void match_forced(matcher *m)
{
    while (m->stack_count > 0) {
        uint32_t triangle = m->stack[--m->stack_count];
        if (m->mate[triangle] != UINT32_MAX) {
            continue;
        }
        for (uint32_t i = m->first_link[triangle]; i < m->first_link[triangle + 1]; i++) {
            if (m->mate[other_end(&m->links[m->link_list[i]], triangle)] == UINT32_MAX) {
                match(m, m->link_list[i]);
                break;
            }
        }
    }
}

static void match_all(matcher *m)
{
    m->stack_count = 0;
    for (uint32_t i = m->mesh->triangle_count; i-- > 0;) {
        if (m->degree[i] == 1) {
            m->stack[m->stack_count++] = i;
        }
    }
    match_forced(m);
    for (uint32_t i = 0; i < m->link_count; i++) {
        const link *l = &m->links[m->order[i]];
        if (m->mate[l->triangle[0]] == UINT32_MAX && m->mate[l->triangle[1]] == UINT32_MAX) {
            match(m, m->order[i]);
            match_forced(m);
        }
    }
}

// The row of tl_soup_corner_slots by which a triangle's corners lie in slots a, e, c.
static uint8_t corner_order(const uint32_t *indices, uint32_t a, uint32_t e, uint32_t c)
{
    uint32_t slot[3] = { a, e, c };
    for (uint8_t order = 1; order <= 6; order++) {
        const uint8_t *row = tl_soup_corner_slots[order];
        if (slot[row[0]] == indices[0] && slot[row[1]] == indices[1] && slot[row[2]] == indices[2]) {
            return order;
        }
    }
    TL_ASSERT(false);
    return 1;
}

static tl_pair make_single(const tl_mesh *mesh, uint32_t triangle)
{
    const uint32_t *v = mesh->indices + 3 * (size_t)triangle;
    tl_pair pair = { { v[0], v[1], v[2], v[0] }, { triangle, TL_NO_TRIANGLE }, { 1, 1 } };
    return pair;
}

// The shared edge runs from c to a in the first triangle: it is a, b, c from the corner after the edge's first on.
static tl_pair make_pair(const tl_mesh *mesh, const link *l)
{
    const uint32_t *v = mesh->indices + 3 * (size_t)l->triangle[0];
    const uint32_t *w = mesh->indices + 3 * (size_t)l->triangle[1];
    uint32_t k = l->edge_k[0];
    uint32_t c = v[k];
    uint32_t a = v[(k + 1) % 3];
    uint32_t b = v[(k + 2) % 3];
    uint32_t d = w[(l->edge_k[1] + 2u) % 3];
    tl_pair pair = { { a, b, c, d },
                     { l->triangle[0], l->triangle[1] },
                     { corner_order(v, a, b, c), corner_order(w, a, d, c) } };
    return pair;
}

tl_result tl_pair_triangles(const tl_mesh *mesh, bool allow_pairs, tl_arena *arena, tl_pair *pairs,
                            uint32_t *pair_count_out)
{
    tl_arena_mark mark = tl_arena_get_mark(arena);
    matcher m = { .mesh = mesh };
    if (allow_pairs) {
        TL_TRY(find_links(&m, arena));
        TL_TRY(order_links(&m, arena));
        TL_TRY(index_links(&m, arena));
        match_all(&m);
    }
    uint32_t count = 0;
    for (uint32_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        if (!allow_pairs || m.mate[triangle] == UINT32_MAX) {
            pairs[count++] = make_single(mesh, triangle);
        } else if (m.links[m.mate[triangle]].triangle[0] == triangle) {
            pairs[count++] = make_pair(mesh, &m.links[m.mate[triangle]]);
        }
    }
    tl_arena_rollback(arena, mark);
    *pair_count_out = count;
    return TL_OK;
}
