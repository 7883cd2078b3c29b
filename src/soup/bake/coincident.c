// SPDX-License-Identifier: MIT
//
// Coincident triangles: the same three corners, in any order. Walls modelled from both sides and parts that were
// exported twice have them. They take one lane of a leaf (soup_layout.h), so they are merged before triangles are
// paired: the tree is that of the level with each triangle once.
//
// Most levels have none, and must not pay for that. So each vertex has a mask: a triangle sets a bit, by the other two
// corners, in that of its lowest one. Two that coincide meet in a bit, and so do a few in a hundred that do not. Only
// those are sorted. Masks are read in the order of the mesh, which is near to that of its memory, where a hash table
// would be read at random: 3 ns a triangle instead of 15. A fan that fills its vertex's mask is sorted whole, by radix:
// linear for any mesh.

#include "base/assert.h"
#include "base/min_max.h"
#include "base/radix_sort.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

#define DROPPED UINT32_MAX

// Of a vertex: bits of the triangles that it is the lowest corner of, and those of two or more.
typedef struct corner_mask {
    uint64_t once, twice;
} corner_mask;

typedef struct coincident_merge {
    tl_mesh *mesh;
    tl_stage *stage;
    uint32_t source_count;
    corner_mask *masks;
    uint32_t meeting_limit;        // no more triangles meet others in a bit
    tl_sort_item *items, *scratch; // those that do, and may coincide with them
    uint32_t item_count;
    tl_coincident found; // its words lie in the items' scratch, when they are sorted
} coincident_merge;

// The lowest corner of a triangle, and its bit there, which the order of the corners does not change.
static inline uint32_t mask_of_triangle(const uint32_t *v, uint64_t *bit_out)
{
    *bit_out = (uint64_t)1 << ((v[0] + v[1] + v[2]) * 0x9e3779b9u >> 26);
    return tl_min_u32(tl_min_u32(v[0], v[1]), v[2]);
}

static tl_result fill_masks(coincident_merge *m)
{
    const uint32_t *v = m->mesh->indices;
    uint64_t later = 0; // triangles that find their bit set
    for (uint32_t i = 0, end; i < m->mesh->triangle_count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, m->mesh->triangle_count);
        for (uint32_t t = i; t < end; t++, v += 3) {
            uint64_t bit;
            corner_mask *mask = &m->masks[mask_of_triangle(v, &bit)];
            const uint64_t met = mask->once & bit;
            mask->twice |= met;
            mask->once |= bit;
            later += met != 0;
        }
    }
    // Of each bit one was there before.
    m->meeting_limit = (uint32_t)tl_min_u64(2 * later, m->mesh->triangle_count);
    return TL_OK;
}

// With the keys of their upper corners.
static tl_result find_meeting(coincident_merge *m)
{
    const uint32_t *v = m->mesh->indices;
    for (uint32_t i = 0, end; i < m->mesh->triangle_count; i = end) {
        TL_TRY(tl_stage_add(m->stage, 0));
        end = tl_stage_step_end(i, m->mesh->triangle_count);
        for (uint32_t t = i; t < end; t++, v += 3) {
            uint64_t bit;
            const uint32_t lowest = mask_of_triangle(v, &bit);
            if ((m->masks[lowest].twice & bit) != 0) {
                const uint32_t highest = tl_max_u32(tl_max_u32(v[0], v[1]), v[2]);
                const uint32_t middle = v[0] ^ v[1] ^ v[2] ^ lowest ^ highest;
                const tl_sort_item item = { (uint64_t)middle << 32 | highest, t, lowest };
                m->items[m->item_count++] = item;
            }
        }
    }
    return TL_OK;
}

// By corners, triangles with the same ones in their order.
static tl_result sort_meeting(coincident_merge *m)
{
    TL_TRY(tl_radix_sort_in_stage(m->items, m->scratch, m->item_count, m->stage));
    for (uint32_t i = 0; i < m->item_count; i++) {
        m->items[i].key = m->items[i].extra;
    }
    return tl_radix_sort_in_stage(m->items, m->scratch, m->item_count, m->stage);
}

static bool has_corner(const uint32_t *v, uint32_t corner)
{
    return v[0] == corner || v[1] == corner || v[2] == corner;
}

static bool coincide(const tl_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t *v = mesh->indices + 3 * (size_t)a, *w = mesh->indices + 3 * (size_t)b;
    // Corners of a triangle differ.
    return has_corner(w, v[0]) && has_corner(w, v[1]) && has_corner(w, v[2]);
}

// Lets triangles that coincide, items [first, end), take the lane of the first of them. Orders are relative to it.
static void share_lane(coincident_merge *m, uint32_t first, uint32_t end)
{
    uint32_t *sources = m->mesh->source_triangles, *word = m->found.words + m->found.word_count;
    const uint32_t lane = m->items[first].value, *slots = m->mesh->indices + 3 * (size_t)lane;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t *v = m->mesh->indices + 3 * (size_t)m->items[i].value;
        const uint32_t order = tl_corner_order(v, slots[0], slots[1], slots[2]);
        *word++ = sources[m->items[i].value] | order << 29 | (i + 1 == end ? TL_ID_LAST : 0);
        sources[m->items[i].value] = DROPPED;
    }
    sources[lane] = m->source_count + m->found.word_count;
    m->found.word_count += end - first;
    m->found.lane_count++;
}

static tl_result merge_items(coincident_merge *m)
{
    for (uint32_t i = 0, end; i < m->item_count; i = end) {
        for (end = i + 1; end < m->item_count && end - i < TL_MAX_COINCIDENT &&
                          coincide(m->mesh, m->items[i].value, m->items[end].value);
             end++) {
        }
        // Where indices run out, triangles keep lanes of their own.
        const bool fits = (uint64_t)m->source_count + m->found.word_count + (end - i) <= TL_ID_INDEX;
        if (end - i > 1 && fits) {
            share_lane(m, i, end);
        }
        TL_TRY(tl_stage_tick(m->stage, i));
    }
    return TL_OK;
}

static tl_result drop_coincident(const coincident_merge *m)
{
    tl_mesh *mesh = m->mesh;
    uint32_t kept = 0;
    while (mesh->source_triangles[kept] != DROPPED) { // what stands before the first one stays where it is
        kept++;
    }
    for (uint32_t i = kept; i < mesh->triangle_count; i++) {
        TL_TRY(tl_stage_tick(m->stage, i));
        if (mesh->source_triangles[i] != DROPPED) {
            memmove(mesh->indices + 3 * (size_t)kept, mesh->indices + 3 * (size_t)i, 3 * sizeof *mesh->indices);
            mesh->materials[kept] = mesh->materials[i];
            mesh->source_triangles[kept++] = mesh->source_triangles[i];
        }
    }
    mesh->triangle_count = kept;
    return TL_OK;
}

static tl_result merge_meeting(coincident_merge *m, tl_arena *scratch, tl_arena *arena)
{
    m->masks = TL_PUSH(scratch, corner_mask, m->mesh->vertex_count);
    if (m->masks == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_zero(m->stage, m->masks, (uint64_t)m->mesh->vertex_count * sizeof *m->masks));
    TL_TRY(fill_masks(m));
    if (m->meeting_limit == 0) {
        return TL_OK;
    }
    m->items = TL_PUSH(scratch, tl_sort_item, 2 * (uint64_t)m->meeting_limit);
    if (m->items == NULL) {
        return TL_ERR_MEMORY;
    }
    m->scratch = m->items + m->meeting_limit;
    m->found.words = (uint32_t *)(void *)m->scratch;
    TL_TRY(find_meeting(m));
    TL_TRY(sort_meeting(m));
    TL_TRY(merge_items(m));
    if (m->found.lane_count == 0) {
        return TL_OK;
    }
    TL_TRY(drop_coincident(m));
    uint32_t *words = TL_PUSH(arena, uint32_t, m->found.word_count);
    if (words == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint64_t bytes = (uint64_t)m->found.word_count * sizeof *words;
    TL_TRY(tl_stage_copy(m->stage, words, m->found.words, bytes));
    m->found.words = words;
    return TL_OK;
}

tl_result tl_merge_coincident(tl_mesh *mesh, uint32_t source_count, tl_stage *stage, tl_arena *arena,
                              tl_coincident *coincident_out)
{
    tl_arena scratch;
    tl_arena_init(&scratch, &arena->allocator);
    coincident_merge m = { .mesh = mesh, .stage = stage, .source_count = source_count };
    tl_result result = merge_meeting(&m, &scratch, arena);
    tl_arena_free(&scratch);
    if (m.found.lane_count == 0) {
        m.found.words = NULL;
    }
    *coincident_out = m.found;
    return result;
}

void tl_order_coincident(const tl_coincident *coincident, uint32_t source_count, const tl_triangle_pair *pairs,
                         uint32_t pair_count)
{
    for (uint32_t i = 0; i < (coincident->lane_count > 0 ? pair_count : 0); i++) {
        for (uint32_t k = 0; k < 2; k++) {
            const uint32_t id = pairs[i].id[k];
            if (id == TL_ID_NONE || (id & TL_ID_INDEX) < source_count) {
                continue;
            }
            const uint8_t *lane = tl_soup_corner_slots[tl_id_order(id)];
            uint32_t *word = coincident->words + ((id & TL_ID_INDEX) - source_count);
            for (bool last = false; !last; word++) {
                const uint8_t *own = tl_soup_corner_slots[tl_id_order(*word)];
                const uint32_t corners[3] = { lane[own[0]], lane[own[1]], lane[own[2]] };
                last = (*word & TL_ID_LAST) != 0;
                *word = (*word & (TL_ID_INDEX | TL_ID_LAST)) | tl_corner_order(corners, 0, 1, 2) << 29;
            }
        }
    }
}
