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
// and edges are numbered here within the set that is matched, so that all arrays are small. What is needed one after
// the other lies in the same memory, 81 bytes a triangle: a matching of a whole mesh must not be what a bake's memory
// is measured by.

#include "soup/bake/pair_match.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "math/box4.h"

#include <string.h>

// Costs are quantized in steps of at most one per cent, from 0.5 to 128: finer steps cost more time than better pairs
// gain. Larger costs, and NaN, are in the last step.
enum { COST_STEPS = 1024, COST_SHIFT = 16, COST_OF_HALF = 0x3f00 };

// A triangle. Its box is read as two vectors of four floats.
typedef struct match_triangle {
    tl_vec3 min;
    uint32_t mate; // the partner's edge
    tl_vec3 max;
    uint32_t stacked; // of the stack, not of this triangle
} match_triangle;

// Of triangles: this bit while they are free, and the number of links to others that are.
#define MATCH_FREE 0x80u

struct tl_pair_matcher {
    const tl_mesh *mesh;
    tl_stage *stage;
    uint64_t forced; // matches by match_forced
    uint32_t count;  // triangles
    uint32_t slot_bits;
    uint32_t *slots;           // of a hash table: the last edge of each chain
    match_triangle *triangles; // in the same memory: the slots are no longer needed then
    uint64_t *keys;            // of edges: both vertices
    uint32_t *order;           // links by cost; these two are in the memory of the keys
    uint16_t *steps;           // of links: cost
    uint32_t *next;            // of edges, in their chain
    uint32_t *previous;
    uint8_t *degree;      // of triangles
    uint32_t stack_count; // triangles with one free neighbour left, in triangles[].stacked
};

static_assert(sizeof(match_triangle) == 8 * sizeof(float), "two rows of four");

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
    const uint64_t edges = 3 * (uint64_t)capacity, slots = (uint64_t)1 << slot_bits_for(capacity);
    const uint64_t slot_bytes = tl_max_u64(slots * sizeof(uint32_t), capacity * sizeof(match_triangle));
    // One block, of the right size.
    (void)tl_arena_reserve(arena, slot_bytes + edges * (sizeof(uint64_t) + 2 * sizeof(uint32_t)) + capacity + 512);
    tl_pair_matcher *m = TL_PUSH(arena, tl_pair_matcher, 1);
    if (m == NULL) {
        return NULL;
    }
    m->mesh = mesh;
    m->slots = tl_arena_push(arena, slot_bytes, 1);
    m->keys = TL_PUSH(arena, uint64_t, edges);
    m->next = TL_PUSH(arena, uint32_t, edges);
    m->previous = TL_PUSH(arena, uint32_t, edges);
    m->degree = TL_PUSH(arena, uint8_t, capacity);
    if (m->slots == NULL || m->keys == NULL || m->next == NULL || m->previous == NULL || m->degree == NULL) {
        return NULL;
    }
    m->triangles = (match_triangle *)(void *)m->slots;
    m->order = (uint32_t *)(void *)m->keys;
    m->steps = (uint16_t *)(void *)(m->order + edges);
    return m;
}

// Appends an edge with its key to the chain of that key; returns how many links of its triangle that adds.
static inline uint8_t append_to_chain(const tl_pair_matcher *m, uint32_t edge, uint64_t key)
{
    const uint32_t mask = (1u << m->slot_bits) - 1u;
    uint32_t slot = (uint32_t)(key * 0x9e3779b97f4a7c15u >> (64 - m->slot_bits)), last;
    while ((last = m->slots[slot]) != TL_NO_MATE && m->keys[last] != key) {
        slot = (slot + 1) & mask;
    }
    m->keys[edge] = key;
    m->slots[slot] = edge;
    m->previous[edge] = last;
    m->next[edge] = TL_NO_MATE;
    if (last == TL_NO_MATE) {
        return 0;
    }
    m->next[last] = edge;
    m->degree[last / 3]++;
    return 1;
}

static inline uint64_t edge_key(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static tl_result find_pair_links(tl_pair_matcher *m, const uint32_t *list, uint32_t first)
{
    m->slot_bits = slot_bits_for(m->count);
    memset(m->slots, 0xff, sizeof *m->slots << m->slot_bits);
    const uint32_t *indices = m->mesh->indices;
    for (uint32_t i = 0, end; i < m->count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, m->count);
        for (uint32_t t = i; t < end; t++) {
            const uint32_t *v = indices + 3 * (size_t)(list != NULL ? list[t] : first + t);
            const uint32_t a = v[0], b = v[1], c = v[2];
            m->degree[t] = MATCH_FREE;
            uint8_t links = append_to_chain(m, 3 * t, edge_key(a, b));
            links = (uint8_t)(links + append_to_chain(m, 3 * t + 1, edge_key(b, c)));
            links = (uint8_t)(links + append_to_chain(m, 3 * t + 2, edge_key(c, a)));
            m->degree[t] = (uint8_t)(m->degree[t] + links);
        }
    }
    return TL_OK;
}

static tl_result fill_match_triangles(tl_pair_matcher *m, const uint32_t *list, uint32_t first)
{
    const tl_vec3 *vertices = m->mesh->vertices;
    const uint32_t *indices = m->mesh->indices;
    match_triangle *triangles = m->triangles;
    for (uint32_t i = 0, end; i < m->count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, m->count);
        for (uint32_t t = i; t < end; t++) {
            const uint32_t *v = indices + 3 * (size_t)(list != NULL ? list[t] : first + t);
            tl_vec3 a = vertices[v[0]], b = vertices[v[1]], c = vertices[v[2]];
            triangles[t].min = tl_min(tl_min(a, b), c);
            triangles[t].mate = TL_NO_MATE;
            triangles[t].max = tl_max(tl_max(a, b), c);
            triangles[t].stacked = TL_NO_MATE;
        }
    }
    return TL_OK;
}

static inline tl_box4 match_box(const match_triangle *triangle)
{
    const float *row = (const float *)(const void *)triangle;
    return tl_box4_load(row, row + 4);
}

static inline bool is_free_to_match(const tl_pair_matcher *m, uint32_t triangle)
{
    return (m->degree[triangle] & MATCH_FREE) != 0;
}

// Surface of the common box over the surfaces of both boxes; 0.5 for two equal boxes. No box has zero surface, since no
// triangle is a line; underflow of tiny boxes gives NaN, which sorts last.
static inline float link_cost(tl_box4 a, float half_area_of_a, tl_box4 b)
{
    return tl_box4_half_area(tl_box4_union(a, b)) / (half_area_of_a + tl_box4_half_area(b));
}

static uint32_t cost_step(float cost)
{
    uint32_t bits;
    memcpy(&bits, &cost, sizeof bits);
    uint32_t step = bits >> COST_SHIFT;
    step = step > COST_OF_HALF ? step - COST_OF_HALF : 0;
    return step < COST_STEPS ? step : COST_STEPS - 1;
}

// Links by cost, of equal cost the last first.
static tl_result order_links(tl_pair_matcher *m, uint32_t *link_count_out)
{
    uint32_t begin[COST_STEPS + 1] = { 0 };
    const uint32_t *next = m->next;
    const match_triangle *triangles = m->triangles;
    uint16_t *steps = m->steps;
    for (uint32_t i = 0, end; i < m->count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, m->count);
        for (uint32_t t = i; t < end; t++) {
            const tl_box4 box = match_box(&triangles[t]);
            const float half_area = tl_box4_half_area(box);
            for (uint32_t edge = 3 * t; edge < 3 * t + 3; edge++) {
                if (next[edge] != TL_NO_MATE) {
                    const uint32_t step = cost_step(link_cost(box, half_area, match_box(&triangles[next[edge] / 3])));
                    steps[edge] = (uint16_t)step;
                    begin[step + 1]++;
                }
            }
        }
    }
    for (uint32_t step = 1; step <= COST_STEPS; step++) {
        begin[step] += begin[step - 1];
    }
    for (uint32_t edge = 3 * m->count, end; edge > 0;) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = edge > TL_STAGE_STEP ? edge - TL_STAGE_STEP : 0;
        while (edge-- > end) {
            if (next[edge] != TL_NO_MATE) {
                m->order[begin[steps[edge]]++] = edge;
            }
        }
        edge = end;
    }
    *link_count_out = begin[COST_STEPS];
    return TL_OK;
}

// Neighbour i of a triangle, 0 to 5: its edge, or TL_NO_MATE; the triangle's own goes to `own_out`.
static inline uint32_t neighbour(const tl_pair_matcher *m, uint32_t triangle, uint32_t i, uint32_t *own_out)
{
    *own_out = 3 * triangle + i / 2;
    return i % 2 == 0 ? m->next[*own_out] : m->previous[*own_out];
}

static void join_mates(tl_pair_matcher *m, uint32_t edge, uint32_t other)
{
    m->triangles[edge / 3].mate = other;
    m->triangles[other / 3].mate = edge;
    m->degree[edge / 3] = 0;
    m->degree[other / 3] = 0;
}

static void lose_neighbour(tl_pair_matcher *m, uint32_t edge)
{
    // A triangle is pushed when one neighbour is left, which happens once: the stack has room for all.
    if (edge != TL_NO_MATE && is_free_to_match(m, edge / 3) && --m->degree[edge / 3] == MATCH_FREE + 1) {
        m->triangles[m->stack_count++].stacked = edge / 3;
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
        if (other != TL_NO_MATE && is_free_to_match(m, other / 3)) {
            return other;
        }
    }
    return TL_NO_MATE;
}

static tl_result match_forced(tl_pair_matcher *m)
{
    while (m->stack_count > 0) {
        uint32_t triangle = m->triangles[--m->stack_count].stacked, own;
        uint32_t other = is_free_to_match(m, triangle) ? find_free_neighbour(m, triangle, &own) : TL_NO_MATE;
        if (other != TL_NO_MATE) {
            match(m, own, other);
            TL_TRY(tl_stage_tick(m->stage, m->forced++));
        }
    }
    return TL_OK;
}

static tl_result match_links(tl_pair_matcher *m, uint32_t link_count)
{
    m->stack_count = 0;
    m->forced = 0;
    for (uint32_t i = m->count; i-- > 0;) {
        if (m->degree[i] == MATCH_FREE + 1) {
            m->triangles[m->stack_count++].stacked = i;
        }
    }
    TL_TRY(match_forced(m));
    for (uint32_t i = 0, end; i < link_count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, link_count);
        for (uint32_t link = i; link < end; link++) {
            uint32_t edge = m->order[link], other = m->next[edge];
            if (is_free_to_match(m, edge / 3) && is_free_to_match(m, other / 3)) {
                match(m, edge, other);
                TL_TRY(match_forced(m));
            }
        }
    }
    return TL_OK;
}

tl_result tl_pair_match(tl_pair_matcher *m, tl_stage *stage, const uint32_t *list, uint32_t first, uint32_t count,
                        uint32_t *mates)
{
    m->stage = stage;
    m->count = count;
    uint32_t link_count = 0;
    TL_TRY(find_pair_links(m, list, first));
    TL_TRY(fill_match_triangles(m, list, first));
    TL_TRY(order_links(m, &link_count));
    TL_TRY(match_links(m, link_count));
    for (uint32_t i = 0; i < count; i++) {
        uint32_t mate = m->triangles[i].mate, triangle = list != NULL ? list[i] : first + i;
        mates[triangle] = mate == TL_NO_MATE ? mate : 3 * (list != NULL ? list[mate / 3] : first + mate / 3) + mate % 3;
    }
    return TL_OK;
}
