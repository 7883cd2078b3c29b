// SPDX-License-Identifier: MIT
//
// Incremental distance field: few floors have changed their area, and only what that reaches is computed again.
//
// Each pass of the field computes a floor's value from its own and its neighbours', in a fixed order. The floors whose
// input has changed wait in a bit set, which is visited in the pass's own order; a floor whose value changes adds those
// that read it, which come later in the order. Each value is computed by the same function from the same values as in a
// whole field, so the result is the same, bit for bit.
//
// Rejected: raising and lowering distances from the changed borders outward (dynamic Euclidean distance fields: Lau,
// Sprunk, Burgard, 2013). It needs distances that are the nearest over all paths; two sweeps give them where floors lie
// side by side as on a map, but not where a stair winds round on itself, and there the bytes would differ.

#include "nav_bake/regions/distance_update.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/lowest_bit.h"
#include "nav_bake/regions/distance_steps.h"

#include <string.h>

typedef struct updater {
    const tl_nav_compact *compact;
    const uint8_t *before;
    uint32_t words;
    uint64_t *first, *second; // floors that wait for this step, and for the next one
    uint16_t *forward, *sharp, *blurred;
} updater;

static inline void add_changed(uint64_t *set, uint32_t floor)
{
    if (floor != TL_NAV_NO_SPAN) {
        set[floor / 64] |= UINT64_C(1) << (floor & 63);
    }
}

static inline uint32_t update_step(const tl_nav_compact *compact, uint32_t floor, uint32_t direction)
{
    return floor != TL_NAV_NO_SPAN ? tl_nav_compact_neighbour(compact, floor, direction) : TL_NAV_NO_SPAN;
}

// Puts the floors that may become borders, or cease to be, into the first set.
static void find_changes(const updater *u)
{
    const tl_nav_compact *compact = u->compact;
    for (uint32_t begin = 0; begin < compact->span_count; begin += 64) {
        const uint32_t left = compact->span_count - begin, count = left < 64 ? left : 64;
        if (memcmp(u->before + begin, compact->area + begin, count) == 0) {
            continue;
        }
        for (uint32_t i = begin; i < begin + count; i++) {
            if (u->before[i] != compact->area[i]) {
                const tl_links links = tl_floor_links(compact, i);
                add_changed(u->first, i);
                for (uint32_t d = 0; d < 4; d++) {
                    add_changed(u->first, links.to[d]);
                }
            }
        }
    }
}

static void update_forward(const updater *u)
{
    const tl_nav_compact *compact = u->compact;
    for (uint32_t w = 0; w < u->words; w++) {
        while (u->first[w] != 0) {
            const uint32_t i = 64 * w + tl_lowest_bit(u->first[w]);
            u->first[w] &= u->first[w] - 1;
            const uint16_t value = tl_distance_forward(compact, u->forward, i);
            if (value == u->forward[i]) {
                continue;
            }
            u->forward[i] = value;
            add_changed(u->second, i);
            const uint32_t right = tl_nav_compact_neighbour(compact, i, 2),
                           below = tl_nav_compact_neighbour(compact, i, 1);
            add_changed(u->first, right); // all four come later
            add_changed(u->first, below);
            add_changed(u->first, update_step(compact, below, 2));
            add_changed(u->first, update_step(compact, tl_nav_compact_neighbour(compact, i, 0), 1));
        }
    }
}

static void update_backward(const updater *u)
{
    const tl_nav_compact *compact = u->compact;
    for (uint32_t w = u->words; w-- > 0;) {
        while (u->second[w] != 0) {
            const uint32_t bit = tl_highest_bit(u->second[w]), i = 64 * w + bit;
            u->second[w] ^= UINT64_C(1) << bit;
            const uint16_t value = tl_chamfer_backward(compact, u->sharp, i, u->forward[i]);
            if (value == u->sharp[i]) {
                continue;
            }
            u->sharp[i] = value;
            add_changed(u->first, i);
            const tl_links links = tl_floor_links(compact, i);
            add_changed(u->second, links.to[0]); // all four come earlier
            add_changed(u->second, links.to[3]);
            add_changed(u->second, update_step(compact, links.to[3], 0));
            add_changed(u->second, update_step(compact, links.to[2], 3));
            for (uint32_t d = 0; d < 4; d++) { // what the blur looks at in d, and then in the next direction
                add_changed(u->first, links.to[d]);
                add_changed(u->first, update_step(compact, links.to[d], (d + 3) & 3));
            }
        }
    }
}

static void update_blur(const updater *u)
{
    for (uint32_t w = 0; w < u->words; w++) {
        for (uint64_t bits = u->first[w]; bits != 0; bits &= bits - 1) {
            const uint32_t i = 64 * w + tl_lowest_bit(bits);
            u->blurred[i] = tl_distance_blurred(u->compact, u->sharp, i);
        }
    }
}

// The values that one of the three steps left.
static void read_stage(const tl_distance_stages *stages, uint32_t step, uint32_t count, uint16_t *restrict to)
{
    if (stages->value_size == sizeof *to) {
        memcpy(to, (const uint16_t *)stages->values + (size_t)step * count, count * sizeof *to);
        return;
    }
    const uint8_t *from = (const uint8_t *)stages->values + (size_t)step * count;
    for (uint32_t i = 0; i < count; i++) {
        to[i] = from[i];
    }
}

tl_result tl_distance_field_update(const uint8_t *before, const tl_distance_stages *stages,
                                   const tl_allocator *allocator, tl_nav_compact *compact)
{
    TL_ASSERT(compact->distance == NULL);
    const uint32_t count = compact->span_count, words = (uint32_t)(((uint64_t)count + 63) / 64);
    updater u = { .compact = compact, .before = before, .words = words };
    u.first = tl_allocate_array(allocator, 2 * (uint64_t)words, sizeof *u.first);
    u.forward = tl_allocate_array(allocator, 2 * (uint64_t)count, sizeof *u.forward);
    u.blurred = tl_allocate_array(&compact->allocator, count, sizeof *u.blurred);
    const bool there = u.first != NULL && u.forward != NULL && u.blurred != NULL;
    if (there) {
        u.second = u.first + words;
        u.sharp = u.forward + count;
        memset(u.first, 0, 2 * (size_t)words * sizeof *u.first);
        read_stage(stages, 0, count, u.forward);
        read_stage(stages, 1, count, u.sharp);
        read_stage(stages, 2, count, u.blurred);
        find_changes(&u);
        update_forward(&u);
        update_backward(&u);
        update_blur(&u);
        compact->max_distance = tl_largest_distance(u.sharp, count);
        compact->distance = u.blurred;
    } else {
        tl_release_array(&compact->allocator, u.blurred, count, sizeof *u.blurred);
    }
    tl_release_array(allocator, u.first, 2 * (uint64_t)words, sizeof *u.first);
    tl_release_array(allocator, u.forward, 2 * (uint64_t)count, sizeof *u.forward);
    return there ? TL_OK : TL_ERR_MEMORY;
}

uint64_t tl_distance_stages_bytes(const tl_distance_stages *stages, uint32_t span_count)
{
    return 3 * (uint64_t)stages->value_size * span_count;
}

void tl_distance_stages_free(tl_distance_stages *stages, uint32_t span_count, const tl_allocator *allocator)
{
    tl_release_array(allocator, stages->values, 3 * (uint64_t)span_count, stages->value_size);
    memset(stages, 0, sizeof *stages);
}

// Keeps a byte a value instead of two, for values that fit. TL_ERR_MEMORY: nothing has changed.
static tl_result narrow_stages(tl_distance_stages *stages, uint32_t span_count, const tl_allocator *allocator)
{
    const uint64_t count = 3 * (uint64_t)span_count;
    const uint16_t *wide = stages->values;
    uint8_t *restrict narrow = tl_allocate_array(allocator, count, 1);
    if (narrow == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < count; i++) {
        narrow[i] = (uint8_t)wide[i];
    }
    tl_distance_stages_free(stages, span_count, allocator);
    stages->values = narrow;
    stages->value_size = 1;
    return TL_OK;
}

tl_result tl_distance_stages_make(const tl_nav_compact *compact, const tl_allocator *allocator,
                                  tl_distance_stages *stages_out)
{
    const uint32_t count = compact->span_count;
    memset(stages_out, 0, sizeof *stages_out);
    const tl_host host = { allocator, NULL, NULL };
    tl_floor_bands bands;
    TL_TRY(tl_floor_bands_make(compact, &host, &bands));
    uint16_t *forward = tl_allocate_array(allocator, 3 * (uint64_t)count, sizeof *forward);
    if (forward == NULL) {
        tl_floor_bands_free(&bands);
        return TL_ERR_MEMORY;
    }
    uint16_t *sharp = forward + count, *blurred = sharp + count;
    tl_distance_stages stages = { forward, sizeof *forward };
    tl_chamfer chamfer = tl_distance_chamfer(compact, &bands, forward);
    tl_chamfer_sweep_forward(&chamfer, NULL);
    memcpy(sharp, forward, count * sizeof *sharp);
    chamfer.distance = sharp;
    tl_chamfer_sweep_backward(&chamfer, NULL);
    tl_distance_blur(&chamfer, NULL, blurred);
    tl_floor_bands_free(&bands);
    if (tl_largest_distance(forward, 3 * (size_t)count) <= UINT8_MAX &&
        narrow_stages(&stages, count, allocator) != TL_OK) {
        tl_distance_stages_free(&stages, count, allocator);
        return TL_ERR_MEMORY;
    }
    *stages_out = stages;
    return TL_OK;
}
