// SPDX-License-Identifier: MIT
//
// The ears of a small outline in plain lists: which is the shortest, and is it free? Both are asked of all vertices,
// one after another. For the few dozen that contours have, that takes fewer steps than a heap and a k-d tree of reflex
// vertices, whose branches nobody can predict: three quarters of their time at 8 vertices, half at 32. A large outline
// has a partition queue and an ear mesh instead.

#ifndef TALUS_SRC_POLYGON_EAR_LIST_H
#define TALUS_SRC_POLYGON_EAR_LIST_H

#include "base/arena.h"
#include "base/min_max.h"
#include "polygon/outline/lattice_point.h"
#include "polygon/outline/packed_point.h"

#define TL_NO_PARTITION UINT64_MAX

typedef struct tl_ear_list {
    uint64_t *lengths2; // [vertex] of the partition from it to the one after the next, or TL_NO_PARTITION
    uint32_t count;     // vertices
    tl_lattice_point *reflex;
    uint64_t *packed; // the same
    uint32_t reflex_count;
} tl_ear_list;

/// An empty list for `count` vertices. False: out of memory.
static inline bool tl_ear_list_init(tl_ear_list *list, tl_arena *arena, uint32_t count)
{
    list->count = count;
    list->reflex_count = 0;
    list->lengths2 = TL_PUSH(arena, uint64_t, 2 * (uint64_t)count);
    list->reflex = TL_PUSH(arena, tl_lattice_point, count);
    list->packed = list->lengths2 + count;
    return list->lengths2 != NULL && list->reflex != NULL;
}

static inline void tl_ear_list_add_reflex(tl_ear_list *list, tl_lattice_point p)
{
    list->packed[list->reflex_count] = tl_pack_point(p);
    list->reflex[list->reflex_count++] = p;
}

/// Takes one reflex vertex out. Of several at its place any one is as good.
static inline void tl_ear_list_remove_reflex(tl_ear_list *list, tl_lattice_point p)
{
    uint32_t i = 0;
    for (const uint64_t packed = tl_pack_point(p); list->packed[i] != packed;) {
        i++;
    }
    list->packed[i] = list->packed[--list->reflex_count];
    list->reflex[i] = list->reflex[list->reflex_count];
}

/// The vertex where the shortest partition begins, the lowest of several. Some vertex if there is none.
static inline uint32_t tl_ear_list_shortest(const tl_ear_list *list)
{
    // Two minima side by side: one would wait for itself.
    uint64_t least = TL_NO_PARTITION, other = TL_NO_PARTITION;
    for (uint32_t a = list->count & 1; a < list->count; a += 2) {
        least = tl_min_u64(least, list->lengths2[a]);
        other = tl_min_u64(other, list->lengths2[a + 1]);
    }
    least = tl_min_u64(tl_min_u64(least, other), list->lengths2[0]);
    uint32_t first = 0;
    while (list->lengths2[first] != least) {
        first++;
    }
    return first;
}

/// Whether no reflex vertex lies in the closed triangle (a, b, c), which has a turn > 0. Vertices at the place of one
/// of its corners do not count: they are the corners themselves or the far sides of bridges, whose interior angles lie
/// outside.
static inline bool tl_ear_list_is_free(const tl_ear_list *list, tl_lattice_point a, tl_lattice_point b,
                                       tl_lattice_point c)
{
    const tl_packed_range range = tl_packed_range_of(a, b, c);
    for (uint32_t i = 0; i < list->reflex_count; i++) {
        if (!tl_in_packed_range(&range, list->packed[i])) {
            continue;
        }
        const tl_lattice_point p = list->reflex[i];
        if (tl_turn(c, a, p) >= 0 && tl_turn(a, b, p) >= 0 && tl_turn(b, c, p) >= 0 && !tl_same_point(p, a) &&
            !tl_same_point(p, b) && !tl_same_point(p, c)) {
            return false;
        }
    }
    return true;
}

#endif
