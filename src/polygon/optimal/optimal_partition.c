// SPDX-License-Identifier: MIT
//
// Fewest convex polygons for an outline, by dynamic programming over its chords.
// Source: Keil, "Decomposing a Polygon into Simpler Components", 1985; Keil and Snoeyink, "On the Time Bound for Convex
// Decomposition of Simple Polygons", 2002. New here: polygons are strictly convex and have at most so many corners.
//
// For a chord (i, v) let f(i, v) be the fewest polygons for the part i, i + 1, .. v of the outline. One of them, the
// base, has the chord as an edge; its other corners form a chain i = c0 < c1 < .. < ck = v that bends left, each seen
// from i, and f is 1 + the sum of f over the chain's edges. Chains are grown corner by corner, and a chain that ends in
// v is kept as: its last edge, its first edge, its number of corners.
//
// What makes it fast is that hardly any chains must be kept. A chain to v that costs more than the cheapest one,
// m = f(i, v) - 1, is no better than to close the cheapest at v and to begin anew with the chord (i, v) itself, for
// f(i, v): a fresh chain has the fewest corners, the last edge that lets most corners follow, and the first edge that
// lets most corners close it. So at each chord there wait one fresh chain and those of cost m, of which one that is
// worse than another in all three respects is dropped. The first edge matters only where i itself is reflex.
//
// Plain dynamic programming over (chord, chord, count) is O(n^3 max_corners) in memory and O(n^4 max_corners) in time.
// Here it is O(n^3) steps for a convex outline, and for those of levels close to the number of chords.

#include "polygon/optimal/optimal_partition.h"

#include "base/assert.h"

#include <string.h>

#define NO_CORNER UINT32_MAX

typedef struct chain {
    uint32_t before; // the corner before the last one
    uint32_t second; // the corner after i
    uint32_t count;  // corners, i among them; 0 throughout when there is no bound
    uint32_t back;   // the chain without its last corner, NONE when that is a fresh one
    uint32_t edge;   // chord from `before` to the last corner
    uint32_t start;  // chord from i to `before`
} chain;

typedef struct chord {
    uint32_t to;
    uint32_t fewest;      // f
    uint32_t first_chain; // chains of cost f - 1
    uint32_t chain_count;
} chord;

// A chord by its later end.
typedef struct arrival {
    uint32_t from;
    uint32_t chord;
} arrival;

typedef struct partition_solver {
    tl_arena *arena;
    const tl_lattice_point *points;
    const tl_visibility *visibility;
    uint32_t count;
    uint32_t max_corners;
    chord *chords;
    uint32_t chord_count;
    uint32_t *arrival_first; // [count + 1]
    arrival *arrivals;       // of each corner, by falling `from`
    uint32_t *chord_to;      // [corner] chord from the current i, or NONE
    chain *chains;
    uint32_t chain_count, chain_capacity;
    uint64_t steps, max_steps;
} partition_solver;

static bool allocate_partition(partition_solver *p)
{
    uint32_t n = p->count;
    p->chord_count = p->visibility->first[n];
    p->chords = TL_PUSH(p->arena, chord, p->chord_count);
    p->arrival_first = TL_PUSH_ZERO(p->arena, uint32_t, (uint64_t)n + 1);
    p->arrivals = TL_PUSH(p->arena, arrival, p->chord_count);
    p->chord_to = TL_PUSH(p->arena, uint32_t, n);
    p->chain_capacity = 2 * p->chord_count + 16;
    p->chains = TL_PUSH(p->arena, chain, p->chain_capacity);
    return p->chords != NULL && p->arrival_first != NULL && p->arrivals != NULL && p->chord_to != NULL &&
           p->chains != NULL;
}

static void sort_arrivals(partition_solver *p)
{
    const tl_visibility *seen = p->visibility;
    for (uint32_t k = 0; k < p->chord_count; k++) {
        p->arrival_first[seen->to[k] + 1]++;
    }
    for (uint32_t v = 0; v < p->count; v++) {
        p->arrival_first[v + 1] += p->arrival_first[v];
        p->chord_to[v] = p->arrival_first[v]; // where the next one goes
    }
    for (uint32_t i = p->count; i-- > 0;) {
        for (uint32_t k = seen->first[i]; k < seen->first[i + 1]; k++) {
            arrival a = { i, k };
            p->arrivals[p->chord_to[seen->to[k]]++] = a;
        }
    }
    memset(p->chord_to, 0xff, p->count * sizeof *p->chord_to);
}

static bool grow_bases(partition_solver *p)
{
    if (p->chain_count < p->chain_capacity) {
        return true;
    }
    chain *grown = tl_arena_grow(p->arena, p->chains, &p->chain_capacity, 64, sizeof *grown);
    if (grown != NULL) {
        p->chains = grown;
    }
    return grown != NULL;
}

// Whether whatever can follow b at corner v, or close it, can do so with a as well.
static bool is_as_good(const partition_solver *p, const chain *a, const chain *b, uint32_t v, bool apex_is_reflex)
{
    return a->count <= b->count && (!apex_is_reflex || a->second >= b->second) &&
           (a->before == b->before || tl_turn(p->points[v], p->points[a->before], p->points[b->before]) >= 0);
}

// Adds a chain to those of a chord, the last chord that has any.
static tl_result keep_chain(partition_solver *p, chord *at, const chain *item, bool apex_is_reflex)
{
    chain *kept = p->chains + at->first_chain;
    p->steps += at->chain_count;
    for (uint32_t k = 0; k < at->chain_count; k++) {
        if (is_as_good(p, &kept[k], item, at->to, apex_is_reflex)) {
            return TL_OK;
        }
    }
    uint32_t left = 0;
    for (uint32_t k = 0; k < at->chain_count; k++) {
        if (!is_as_good(p, item, &kept[k], at->to, apex_is_reflex)) {
            kept[left++] = kept[k];
        }
    }
    p->chain_count = at->first_chain + left;
    if (!grow_bases(p)) {
        return TL_ERR_MEMORY;
    }
    p->chains[p->chain_count++] = *item;
    at->chain_count = left + 1;
    return TL_OK;
}

// A cheaper cost than all so far: what was kept goes.
static void lower_cost(partition_solver *p, chord *at, uint32_t cost)
{
    if (cost + 1 < at->fewest) {
        at->fewest = cost + 1;
        at->chain_count = 0;
        p->chain_count = at->first_chain;
    }
}

// Lets the chains that end in the arrival's corner go on to the chord's end.
static tl_result extend(partition_solver *p, uint32_t i, chord *at, const arrival *by, bool apex_is_reflex)
{
    const uint32_t start = p->chord_to[by->from];
    const chord from = p->chords[start];
    const uint32_t rest = p->chords[by->chord].fewest;
    const uint32_t u = by->from, v = at->to;
    const uint32_t step = p->max_corners != 0;
    if (from.fewest + rest > at->fewest) { // even a kept chain, one cheaper, is no better than closing anew
        return TL_OK;
    }
    bool extended = false;
    p->steps += from.chain_count;
    for (uint32_t k = from.first_chain; k < from.first_chain + from.chain_count; k++) {
        const chain old = p->chains[k];
        if ((step != 0 && old.count == p->max_corners) ||
            tl_turn(p->points[old.before], p->points[u], p->points[v]) <= 0 ||
            (apex_is_reflex && tl_turn(p->points[i], p->points[old.second], p->points[v]) <= 0)) {
            continue;
        }
        lower_cost(p, at, from.fewest - 1 + rest);
        chain longer = { u, old.second, old.count + step, k, by->chord, start };
        TL_TRY(keep_chain(p, at, &longer, apex_is_reflex));
        extended = true;
    }
    if (!extended && from.fewest + rest < at->fewest) {
        lower_cost(p, at, from.fewest + rest);
        chain fresh = { u, u, 3 * step, NO_CORNER, by->chord, start };
        TL_TRY(keep_chain(p, at, &fresh, apex_is_reflex));
    }
    return TL_OK;
}

// All chords from corner i, by rising other end.
static tl_result solve_corner(partition_solver *p, uint32_t i, bool *found)
{
    const tl_visibility *seen = p->visibility;
    const tl_lattice_point *points = p->points;
    const bool apex_is_reflex = tl_turn(points[i > 0 ? i - 1 : p->count - 1], points[i], points[i + 1]) <= 0;
    for (uint32_t k = seen->first[i]; k < seen->first[i + 1] && *found; k++) {
        chord *at = &p->chords[k];
        at->to = seen->to[k];
        at->first_chain = p->chain_count;
        at->chain_count = 0;
        p->chord_to[at->to] = k;
        if (at->to == i + 1) {
            at->fewest = 0;
            continue;
        }
        at->fewest = NO_CORNER;
        const arrival *first = &p->arrivals[p->arrival_first[at->to]], *by = first;
        for (; by->from > i; by++) {
            if (p->chord_to[by->from] != NO_CORNER) {
                TL_TRY(extend(p, i, at, by, apex_is_reflex));
            }
        }
        p->steps += (uint64_t)(by - first);
        *found = p->steps <= p->max_steps;
    }
    for (uint32_t k = seen->first[i]; k < seen->first[i + 1]; k++) {
        p->chord_to[seen->to[k]] = NO_CORNER;
    }
    return TL_OK;
}

// The base polygon of a chord, its corners rising; chords of its edges that are not on the outline go on the stack.
static uint32_t write_base(const partition_solver *p, uint32_t i, const chord *at, uint32_t *corners, uint32_t *stack,
                           uint32_t *depth)
{
    uint32_t count = 0;
    uint32_t last = at->to;
    const chain *c = &p->chains[at->first_chain];
    corners[count++] = last;
    for (;;) {
        if (last != c->before + 1) {
            stack[(*depth)++] = c->edge;
        }
        last = c->before;
        corners[count++] = last;
        if (c->back == NO_CORNER) {
            break;
        }
        c = &p->chains[c->back];
    }
    if (last != i + 1) {
        stack[(*depth)++] = c->start;
    }
    corners[count++] = i;
    for (uint32_t low = 0, high = count - 1; low < high; low++, high--) {
        uint32_t t = corners[low];
        corners[low] = corners[high];
        corners[high] = t;
    }
    return count;
}

static tl_result write_solved_parts(const partition_solver *p, tl_convex_parts *parts)
{
    // The chord (0, n - 1) is the last one from corner 0.
    const uint32_t root = p->visibility->first[1] - 1;
    parts->count = p->chords[root].fewest;
    parts->first = TL_PUSH(p->arena, uint32_t, (uint64_t)parts->count + 1);
    // n outline edges and two for each chord between polygons.
    parts->corners = TL_PUSH(p->arena, uint32_t, p->count + 2 * ((uint64_t)parts->count - 1));
    uint32_t *stack = TL_PUSH(p->arena, uint32_t, parts->count);
    uint32_t *from = TL_PUSH(p->arena, uint32_t, p->chord_count);
    if (parts->first == NULL || parts->corners == NULL || stack == NULL || from == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < p->count; i++) {
        for (uint32_t k = p->visibility->first[i]; k < p->visibility->first[i + 1]; k++) {
            from[k] = i;
        }
    }
    uint32_t depth = 0, made = 0, filled = 0;
    stack[depth++] = root;
    while (depth > 0) {
        uint32_t k = stack[--depth];
        parts->first[made++] = filled;
        filled += write_base(p, from[k], &p->chords[k], parts->corners + filled, stack, &depth);
    }
    parts->first[made] = filled;
    TL_ASSERT(made == parts->count && filled == p->count + 2 * (made - 1));
    return TL_OK;
}

tl_result tl_partition_optimally(tl_arena *arena, const tl_triangulated_outline *outline,
                                 const tl_visibility *visibility, uint32_t max_corners, uint64_t max_steps,
                                 tl_convex_parts *parts_out, bool *found)
{
    partition_solver p;
    memset(&p, 0, sizeof p);
    p.arena = arena;
    p.points = outline->points;
    p.visibility = visibility;
    p.count = outline->count;
    p.max_corners = max_corners;
    p.max_steps = max_steps;
    *found = true;
    if (!allocate_partition(&p)) {
        return TL_ERR_MEMORY;
    }
    sort_arrivals(&p);
    for (uint32_t i = outline->count - 1; i-- > 0 && *found;) {
        TL_TRY(solve_corner(&p, i, found));
    }
    return *found ? write_solved_parts(&p, parts_out) : TL_OK;
}
