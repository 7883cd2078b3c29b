// SPDX-License-Identifier: MIT
//
// Welding with tolerance 0: vertices that are equal, coordinate by coordinate, become the earliest of them.
//
// Hash partitioning: the low bits of a hash of its point say which part a vertex goes to, so equal vertices are in one
// part, in their order. Each part is a task with a hash table of its own, which fits the caches; one table of all would
// not. The result is that of one pass over all vertices, for any number of parts and tasks.

#include "mesh/weld.h"

#include "base/assert.h"
#include "base/hash.h"

#include <string.h>

// A block of vertices is dealt by one task. Parts have some PART_VERTICES.
enum { WELD_BLOCK_VERTICES = 1 << 14, PART_VERTICES = 1 << 13, MAX_PARTS = 1 << 12, SLOTS_A_VERTEX = 2 };

// Blocks, and vertices of parts, a worker between two progress calls: some 10 ms.
enum { BLOCK_BATCH = 16, PART_BATCH = 1 << 17 };

typedef struct point_welder {
    const tl_mesh_view *view;
    uint32_t *representative;
    uint32_t part_count, block_count;
    uint32_t *hashes; // of vertices
    uint32_t *places; // [block][part]: how many, then where in `dealt` the next one goes; behind it stands its end
    uint32_t *dealt;  // vertices, part by part
    uint32_t *begins; // [part + 1] in `dealt`
    uint32_t *slots;  // SLOTS_A_VERTEX a dealt vertex: the parts' tables
} point_welder;

// Equal points have equal hashes: the sum makes +0 of -0.
static uint32_t hash_of(tl_vec3 p)
{
    const float sums[3] = { p.x + 0.0f, p.y + 0.0f, p.z + 0.0f };
    uint32_t bits[3];
    memcpy(bits, sums, sizeof bits);
    return (uint32_t)tl_hash_mix(tl_hash_mix((uint64_t)bits[0] << 32 | bits[1]) + bits[2]);
}

static bool equal(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void count_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const point_welder *w = user;
    uint32_t *counts = w->places + (size_t)block * w->part_count;
    uint32_t end = tl_block_end(block, WELD_BLOCK_VERTICES, w->view->vertex_count);
    memset(counts, 0, w->part_count * sizeof *counts);
    for (uint32_t v = block * WELD_BLOCK_VERTICES; v < end; v++) {
        if (w->representative[v] != TL_WELD_UNUSED) {
            w->hashes[v] = hash_of(w->view->vertices[v]);
            counts[w->hashes[v] & (w->part_count - 1)]++;
        }
    }
}

static void deal_block(uint32_t block, uint32_t worker, void *user)
{
    (void)worker;
    const point_welder *w = user;
    uint32_t *places = w->places + (size_t)block * w->part_count;
    uint32_t end = tl_block_end(block, WELD_BLOCK_VERTICES, w->view->vertex_count);
    for (uint32_t v = block * WELD_BLOCK_VERTICES; v < end; v++) {
        if (w->representative[v] != TL_WELD_UNUSED) {
            w->dealt[places[w->hashes[v] & (w->part_count - 1)]++] = v;
        }
    }
}

static void weld_part(uint32_t part, uint32_t worker, void *user)
{
    (void)worker;
    const point_welder *w = user;
    const uint32_t begin = w->begins[part], end = w->begins[part + 1];
    uint32_t *slots = w->slots + SLOTS_A_VERTEX * (size_t)begin;
    const uint64_t size = SLOTS_A_VERTEX * (uint64_t)(end - begin);
    memset(slots, 0xff, (size_t)size * sizeof *slots);
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t v = w->dealt[i];
        uint64_t slot = w->hashes[v] * size >> 32; // by the high bits: the low ones say which part
        while (slots[slot] != TL_WELD_UNUSED && !equal(w->view->vertices[slots[slot]], w->view->vertices[v])) {
            slot = slot + 1 < size ? slot + 1 : 0;
        }
        if (slots[slot] == TL_WELD_UNUSED) {
            slots[slot] = v;
        }
        w->representative[v] = slots[slot];
    }
}

// Where each block's share of each part begins: part by part, in each the blocks in their order.
static void place_shares(point_welder *w)
{
    uint32_t place = 0;
    for (uint32_t part = 0; part < w->part_count; part++) {
        w->begins[part] = place;
        for (uint32_t block = 0; block < w->block_count; block++) {
            uint32_t *share = &w->places[(size_t)block * w->part_count + part];
            uint32_t count = *share;
            *share = place;
            place += count;
        }
    }
    w->begins[w->part_count] = place;
}

tl_result tl_weld_points(const tl_mesh_view *view, tl_stage *stage, tl_arena *arena, uint32_t *representative)
{
    const tl_arena_mark mark = tl_arena_get_mark(arena);
    uint32_t count = view->vertex_count;
    point_welder w = { .view = view, .representative = representative, .part_count = 1 };
    while (w.part_count < MAX_PARTS && count / w.part_count > PART_VERTICES) {
        w.part_count *= 2;
    }
    w.block_count = tl_block_count(count, WELD_BLOCK_VERTICES);
    w.hashes = TL_PUSH(arena, uint32_t, count);
    w.places = TL_PUSH(arena, uint32_t, (uint64_t)w.block_count * w.part_count);
    w.dealt = TL_PUSH(arena, uint32_t, count);
    w.begins = TL_PUSH(arena, uint32_t, (uint64_t)w.part_count + 1);
    w.slots = TL_PUSH(arena, uint32_t, SLOTS_A_VERTEX * (uint64_t)count);
    if (w.hashes == NULL || w.places == NULL || w.dealt == NULL || w.begins == NULL || w.slots == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_run(stage, count_block, w.block_count, &w, BLOCK_BATCH, count / 4));
    place_shares(&w);
    TL_TRY(tl_stage_run(stage, deal_block, w.block_count, &w, BLOCK_BATCH, count / 4));
    TL_TRY(tl_stage_run(stage, weld_part, w.part_count, &w, tl_block_count(PART_BATCH, count / w.part_count + 1),
                        count - 2 * (count / 4)));
    tl_arena_rollback(arena, mark);
    return TL_OK;
}
