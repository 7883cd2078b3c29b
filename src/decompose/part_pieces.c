// SPDX-License-Identifier: MIT
//
// The pieces of a part that hang together: what a plane cut off may be several legs of one table.
//
// Corners meet where their positions are equal, so the mesh need not be indexed or welded. Disjoint sets over the
// triangles, joined along a sort of all corners by a hash of their positions.

#include "base/assert.h"
#include "base/disjoint_sets.h"
#include "base/radix_sort.h"
#include "decompose/part.h"

#include <string.h>

// Mixes a position into 64 bits; -0 is 0. Two positions of one hash would join two pieces, which is no error.
static uint64_t position_key(tl_vec3 p)
{
    const float coordinates[3] = { p.x + 0.0f, p.y + 0.0f, p.z + 0.0f };
    uint64_t key = 0;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &coordinates[i], sizeof bits);
        key = (key ^ bits) * 0x9e3779b97f4a7c15u;
        key ^= key >> 29;
    }
    return key;
}

// Joins triangles that share a corner's position.
static void join_at_corners(tl_sort_item *items, tl_sort_item *scratch, const tl_part *part, uint32_t *sets)
{
    const uint32_t corner_count = 3 * part->triangle_count;
    for (uint32_t i = 0; i < corner_count; i++) {
        items[i] = (tl_sort_item){ position_key(part->corners[i]), i / 3, 0 };
    }
    tl_radix_sort(items, scratch, corner_count);
    tl_disjoint_sets_init(sets, part->triangle_count);
    for (uint32_t i = 1; i < corner_count; i++) {
        if (items[i].key == items[i - 1].key) {
            tl_disjoint_sets_unite(sets, items[i - 1].value, items[i].value);
        }
    }
}

// The piece of each triangle, in the order of first triangles, and how many there are.
static tl_result find_pieces(const tl_part *part, tl_arena *arena, uint32_t **piece_of_out, uint32_t *piece_count_out)
{
    const uint64_t corner_count = 3 * (uint64_t)part->triangle_count;
    uint32_t *piece_of = TL_PUSH(arena, uint32_t, part->triangle_count);
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, 2 * corner_count);
    if (piece_of == NULL || items == NULL) {
        return TL_ERR_MEMORY;
    }
    join_at_corners(items, items + corner_count, part, piece_of);
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        items[i].value = tl_disjoint_sets_find(piece_of, i);
    }
    // A set's root is its lowest triangle, so it is numbered before the others.
    uint32_t count = 0;
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        piece_of[i] = items[i].value == i ? count++ : piece_of[items[i].value];
    }
    *piece_of_out = piece_of;
    *piece_count_out = count;
    return TL_OK;
}

// Gives each piece a part of its own.
static tl_result copy_pieces(const tl_part *part, const uint32_t *piece_of, uint32_t piece_count,
                             const tl_allocator *allocator, tl_part *made, uint32_t *made_count)
{
    uint32_t sizes[TL_MAX_PART_PIECES] = { 0 };
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        sizes[piece_of[i]]++;
    }
    for (uint32_t i = 0; i < piece_count; i++) {
        TL_TRY(tl_part_allocate(sizes[i], allocator, &made[i]));
        made[i].cut_count = part->cut_count;
        sizes[i] = 0;
        ++*made_count;
    }
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        memcpy(made[piece_of[i]].corners + 3 * (size_t)sizes[piece_of[i]]++, part->corners + 3 * (size_t)i,
               3 * sizeof *part->corners);
    }
    return TL_OK;
}

tl_result tl_part_divide(tl_part *part, const tl_allocator *allocator, tl_part *made, uint32_t *made_count)
{
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    uint32_t *piece_of, piece_count;
    tl_result result = find_pieces(part, &arena, &piece_of, &piece_count);
    if (result == TL_OK && (piece_count == 1 || piece_count > TL_MAX_PART_PIECES)) {
        made[0] = *part;
        ++*made_count;
        memset(part, 0, sizeof *part);
    } else if (result == TL_OK) {
        result = copy_pieces(part, piece_of, piece_count, allocator, made, made_count);
    }
    tl_part_free(part, allocator);
    tl_arena_free(&arena);
    return result;
}
