// SPDX-License-Identifier: MIT
//
// A matching of triangles over shared edges, as large as linear time gives, compact pairs first.
//
// A triangle with one free neighbour left is matched with it at once: some maximum matching contains that edge, so
// nothing is lost (Karp and Sipser, Maximum matchings in sparse random graphs, 1981). While there is none, the free
// edge whose pair has the smallest box, relative to its two triangles' boxes, is taken: a pair costs the BVH the
// surface that the common box adds. Greedy matching by cost alone leaves every tenth triangle single; a maximum
// matching by augmenting paths ignores the boxes and undoes good pairs.
//
// Any mesh will do. Triangles around one edge form a chain, in which each is a neighbour of the one before and the one
// behind it; two triangles with the same three corners are neighbours too, and winding does not matter.
//
// A link is two triangles across one edge, known by the edge of the earlier one: next[edge] is the other's. Triangles
// and edges are numbered here within the set that is matched, so that all arrays are small.

#include "soup/bake/pair_match.h"

#include "math/box4.h"

#include <string.h>

// Costs are quantized in steps of at most one per cent, from 0.5 to 128: finer steps cost more time than better pairs
// gain. Larger costs, and NaN, are in the last step.
enum { COST_STEPS = 1024, COST_SHIFT = 16, COST_OF_HALF = 0x3f00 };

struct tl_pair_matcher {
    const tl_mesh *mesh;
    uint32_t count;  // triangles
    uint32_t *slots; // of a hash table: the last edge of each chain
    uint32_t slot_bits;
    uint64_t *keys; // of edges: both vertices
    uint32_t *next; // of edges, in their chain
    uint32_t *previous;
    uint32_t *order; // links by cost
    uint16_t *steps; // of links: cost
    tl_box4 *boxes;  // of triangles
    uint8_t *degree; // of triangles that are free: links to others that are
    uint8_t *free;   // of triangles
    uint32_t *stack; // triangles with one free neighbour left
    uint32_t stack_count;
    uint32_t *mates; // of triangles: the partner's edge
};

static uint32_t slot_bits_for(uint32_t triangles)
{
    // At most three edges a triangle, usually one and a half.
    uint32_t bits = 4;
    while (bits < 31 && (uint64_t)1 << bits < 4 * (uint64_t)triangles) {
        bits++;
    }
    return bits;
}

tl_pair_matcher *tl_pair_matcher_make(const tl_mesh *mesh, uint32_t capacity, tl_arena *arena)
{
    tl_pair_matcher *m = TL_PUSH(arena, tl_pair_matcher, 1);
    if (m == NULL) {
        return NULL;
    }
    const uint64_t edges = 3 * (uint64_t)capacity;
    m->mesh = mesh;
    m->slots = TL_PUSH(arena, uint32_t, (uint64_t)1 << slot_bits_for(capacity));
    m->keys = TL_PUSH(arena, uint64_t, edges);
    m->order = (uint32_t *)(void *)m->keys; // the keys are no longer needed then
    m->next = TL_PUSH(arena, uint32_t, edges);
    m->previous = TL_PUSH(arena, uint32_t, edges);
    m->steps = TL_PUSH(arena, uint16_t, edges);
    m->boxes = TL_PUSH(arena, tl_box4, capacity);
    m->degree = TL_PUSH(arena, uint8_t, capacity);
    m->free = TL_PUSH(arena, uint8_t, capacity);
    // A triangle is pushed when its degree falls to one, which happens once: degrees only fall.
    m->stack = TL_PUSH(arena, uint32_t, capacity);
    m->mates = TL_PUSH(arena, uint32_t, capacity);
    bool made = m->slots != NULL && m->keys != NULL && m->next != NULL && m->previous != NULL && m->order != NULL &&
                m->steps != NULL && m->boxes != NULL && m->degree != NULL && m->free != NULL && m->stack != NULL &&
                m->mates != NULL;
    return made ? m : NULL;
}

static void append_to_chain(tl_pair_matcher *m, uint32_t edge)
{
    uint32_t mask = (1u << m->slot_bits) - 1u;
    uint32_t slot = (uint32_t)(m->keys[edge] * 0x9e3779b97f4a7c15u >> (64 - m->slot_bits));
    while (m->slots[slot] != TL_NO_MATE && m->keys[m->slots[slot]] != m->keys[edge]) {
        slot = (slot + 1) & mask;
    }
    uint32_t last = m->slots[slot];
    m->slots[slot] = edge;
    m->previous[edge] = last;
    m->next[edge] = TL_NO_MATE;
    if (last != TL_NO_MATE) {
        m->next[last] = edge;
        m->degree[edge / 3]++;
        m->degree[last / 3]++;
    }
}

static void find_pair_links(tl_pair_matcher *m, const uint32_t *list, uint32_t first)
{
    m->slot_bits = slot_bits_for(m->count);
    memset(m->slots, 0xff, sizeof *m->slots << m->slot_bits);
    for (uint32_t i = 0; i < m->count; i++) {
        const uint32_t *v = m->mesh->indices + 3 * (size_t)(list != NULL ? list[i] : first + i);
        tl_box4 box = tl_box4_empty();
        m->degree[i] = 0;
        m->free[i] = 1;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t from = v[k], to = v[k == 2 ? 0 : k + 1];
            m->keys[3 * i + k] = from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from;
            append_to_chain(m, 3 * i + k);
            tl_vec3 corner = m->mesh->vertices[from];
            tl_aabb point = { corner, corner };
            box = tl_box4_union(box, tl_box4_of(point));
        }
        m->boxes[i] = box;
    }
}

// Surface of the common box over the surfaces of both boxes; 0.5 for two equal boxes. No box has zero surface, since no
// triangle is a line; underflow of tiny boxes gives NaN, which sorts last.
static float link_cost(const tl_box4 *a, const tl_box4 *b)
{
    return tl_box4_half_area(tl_box4_union(*a, *b)) / (tl_box4_half_area(*a) + tl_box4_half_area(*b));
}

static uint32_t cost_step(float cost)
{
    uint32_t bits;
    memcpy(&bits, &cost, sizeof bits);
    uint32_t step = bits >> COST_SHIFT;
    step = step > COST_OF_HALF ? step - COST_OF_HALF : 0;
    return step < COST_STEPS ? step : COST_STEPS - 1;
}

// Links by cost, of equal cost the last first; returns how many.
static uint32_t order_links(tl_pair_matcher *m)
{
    uint32_t begin[COST_STEPS + 1] = { 0 };
    for (uint32_t edge = 0; edge < 3 * m->count; edge++) {
        if (m->next[edge] != TL_NO_MATE) {
            m->steps[edge] = (uint16_t)cost_step(link_cost(&m->boxes[edge / 3], &m->boxes[m->next[edge] / 3]));
            begin[m->steps[edge] + 1]++;
        }
    }
    for (uint32_t step = 1; step <= COST_STEPS; step++) {
        begin[step] += begin[step - 1];
    }
    for (uint32_t edge = 3 * m->count; edge-- > 0;) {
        if (m->next[edge] != TL_NO_MATE) {
            m->order[begin[m->steps[edge]]++] = edge;
        }
    }
    return begin[COST_STEPS];
}

// Neighbour i of a triangle, 0 to 5: its edge, or TL_NO_MATE; the triangle's own goes to `own_out`.
static inline uint32_t neighbour(const tl_pair_matcher *m, uint32_t triangle, uint32_t i, uint32_t *own_out)
{
    *own_out = 3 * triangle + i / 2;
    return i % 2 == 0 ? m->next[*own_out] : m->previous[*own_out];
}

static void join_mates(tl_pair_matcher *m, uint32_t edge, uint32_t other)
{
    m->mates[edge / 3] = other;
    m->mates[other / 3] = edge;
    m->free[edge / 3] = 0;
    m->free[other / 3] = 0;
}

static void lose_neighbour(tl_pair_matcher *m, uint32_t edge)
{
    if (edge != TL_NO_MATE && m->free[edge / 3] && --m->degree[edge / 3] == 1) {
        m->stack[m->stack_count++] = edge / 3;
    }
}

static void match(tl_pair_matcher *m, uint32_t edge, uint32_t other)
{
    const uint32_t pair[2] = { edge / 3, other / 3 };
    join_mates(m, edge, other);
    for (uint32_t side = 0; side < 2; side++) {
        for (uint32_t e = 3 * pair[side]; e < 3 * pair[side] + 3; e++) {
            lose_neighbour(m, m->next[e]);
            lose_neighbour(m, m->previous[e]);
        }
    }
}

// A free neighbour's edge across one of the triangle's, which goes to `own_out`.
static uint32_t find_free_neighbour(const tl_pair_matcher *m, uint32_t triangle, uint32_t *own_out)
{
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t other = neighbour(m, triangle, i, own_out);
        if (other != TL_NO_MATE && m->free[other / 3]) {
            return other;
        }
    }
    return TL_NO_MATE;
}

static void match_forced(tl_pair_matcher *m)
{
    while (m->stack_count > 0) {
        uint32_t triangle = m->stack[--m->stack_count], own;
        uint32_t other = m->free[triangle] ? find_free_neighbour(m, triangle, &own) : TL_NO_MATE;
        if (other != TL_NO_MATE) {
            match(m, own, other);
        }
    }
}

static void match_links(tl_pair_matcher *m, uint32_t link_count)
{
    m->stack_count = 0;
    for (uint32_t i = m->count; i-- > 0;) {
        m->mates[i] = TL_NO_MATE;
        if (m->degree[i] == 1) {
            m->stack[m->stack_count++] = i;
        }
    }
    match_forced(m);
    for (uint32_t i = 0; i < link_count; i++) {
        uint32_t edge = m->order[i], other = m->next[edge];
        if (m->free[edge / 3] && m->free[other / 3]) {
            match(m, edge, other);
            match_forced(m);
        }
    }
}

void tl_pair_match(tl_pair_matcher *m, const uint32_t *list, uint32_t first, uint32_t count, uint32_t *mates)
{
    m->count = count;
    find_pair_links(m, list, first);
    match_links(m, order_links(m));
    for (uint32_t i = 0; i < count; i++) {
        uint32_t mate = m->mates[i], triangle = list != NULL ? list[i] : first + i;
        mates[triangle] = mate == TL_NO_MATE ? mate : 3 * (list != NULL ? list[mate / 3] : first + mate / 3) + mate % 3;
    }
}
