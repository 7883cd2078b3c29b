// SPDX-License-Identifier: MIT
//
// A walk over all leaves whose boxes a test accepts.
//
// Spatial splits may have stored a triangle several times. Of the first so many triangles a table on the stack tells
// which were reported: that is all of them for a character or a probe. A table for any answer would have to be as large
// as the answer; so of the triangles behind those each is reported in one of its leaves only: the one whose word is
// smallest among those whose boxes meet both the region and the triangle's own box, which a second, short walk finds.
// (A leaf may hold a triangle that its box does not meet, because splits clip pairs.) Both rules together report each
// triangle once: those that the table does not know were in no leaf that was opened before it was full. Without the
// table the second walks took half of a character's step on game maps.
//
// Where triangles are as large as the level the second walks are long, and there are as many as hits. So a region with
// memory has its further triangles found in passes: each walks again, for the triangles of a part of all hashes, which
// are few enough for a table. A ray through 25,000 triangles of a k-d tree takes 0.08 s, by second walks it took 10 s.
// (Looking for copies only around the point of the hit was no faster: a cell holds thousands of such triangles.)

#include "soup/query/region_walk.h"

#include "base/byte_order.h"
#include "base/compiler.h"
#include "base/hash.h"

#include <string.h>

enum { SEEN_SLOTS = 256 };

// The triangles that were reported, by linear probing.
typedef struct seen_triangles {
    uint32_t *slots; // index + 1; 0: free
    uint32_t slot_count, count;
} seen_triangles;

// One walk over the region's leaves.
typedef struct region_pass {
    const tl_region *region;
    seen_triangles *seen;         // by this pass; NULL in soups without copies
    const seen_triangles *before; // by the first pass; NULL in it
    uint32_t part, part_count;    // of all hashes, that is looked for
    bool defers;                  // when `seen` is full, triangles are left to later passes
    uint64_t deferred;            // of them, copies counted too
} region_pass;

// Bit i is lanes[i], which is 0 or 1, of eight: each product with a power of two moves one byte's bit to its place in
// the highest byte, and no two of them meet. For bytes that a vectorized loop has stored: eight that were stored one by
// one are slow to read at once.
static inline uint32_t mask_of_eight(const uint8_t lanes[8])
{
    const uint64_t gather = TL_BIG_ENDIAN ? 0x8040201008040201u : 0x0102040810204080u;
    uint64_t bytes;
    memcpy(&bytes, lanes, sizeof bytes);
    return (uint32_t)(bytes * gather >> 56);
}

static inline uint32_t mask_of_lanes(const uint8_t lanes[TL_WALK_WIDTH])
{
    return mask_of_eight(lanes) | mask_of_eight(lanes + 8) << 8;
}

// Lanes whose boxes share a point with `box`.
static uint32_t lanes_meeting_box(const tl_walk_boxes *boxes, tl_aabb box)
{
    const float *min_x = tl_walk_min(boxes, 0), *min_y = tl_walk_min(boxes, 1), *min_z = tl_walk_min(boxes, 2);
    const float *max_x = tl_walk_max(boxes, 0), *max_y = tl_walk_max(boxes, 1), *max_z = tl_walk_max(boxes, 2);
    uint8_t overlaps[TL_WALK_WIDTH];
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        overlaps[i] = (uint8_t)((min_x[i] <= box.max.x) & (max_x[i] >= box.min.x) & (min_y[i] <= box.max.y) &
                                (max_y[i] >= box.min.y) & (min_z[i] <= box.max.z) & (max_z[i] >= box.min.z));
    }
    return mask_of_lanes(overlaps);
}

static uint32_t enter_region(const tl_walk_boxes *boxes, const tl_region *region)
{
    return region->box != NULL ? lanes_meeting_box(boxes, *region->box) : region->enter(boxes, region->region);
}

// Whether a leaf has a copy of a lane, by the index in its id word.
static bool leaf_has(const tl_walk *walk, uint32_t child, uint32_t index)
{
    tl_walk_leaf leaf;
    tl_walk_open_leaf(walk, child, &leaf);
    for (uint32_t lane = 0; lane < leaf.lane_count; lane++) {
        if (leaf.view.ids[lane] != TL_ID_NONE && (leaf.view.ids[lane] & TL_ID_INDEX) == index) {
            return true;
        }
    }
    return false;
}

// Its walk is gone from the stack when the triangle is reported.
static TL_NOINLINE bool is_first_copy(const tl_soup *soup, const tl_region *region, const tl_walk_triangle *triangle)
{
    tl_aabb own = tl_walk_triangle_box(triangle);
    const uint32_t index = triangle->leaf->view.ids[triangle->lane] & TL_ID_INDEX;
    tl_walk walk;
    tl_walk_begin_scaled(&walk, soup, triangle->leaf->scale);
    uint32_t child, first = UINT32_MAX;
    while (tl_walk_next(&walk, 0.0f, &child)) {
        if (!tl_walk_is_leaf(child)) {
            tl_walk_boxes boxes;
            tl_walk_read_boxes(&walk, child, &boxes);
            uint32_t mask = lanes_meeting_box(&boxes, own) & enter_region(&boxes, region);
            tl_walk_enter_all(&walk, &boxes, mask);
        } else if (child < first && leaf_has(&walk, child, index)) {
            first = child;
        }
    }
    return triangle->leaf->child == first;
}

// The triangle's slot, or the free one where it would be.
static uint32_t *find_seen(const seen_triangles *seen, uint32_t triangle)
{
    uint32_t slot = (uint32_t)tl_hash_mix(triangle) % seen->slot_count;
    while (seen->slots[slot] != 0 && seen->slots[slot] != triangle + 1) {
        slot = (slot + 1) % seen->slot_count;
    }
    return &seen->slots[slot];
}

// Whether a triangle that belongs is to be reported now.
static bool is_new(const tl_soup *soup, region_pass *pass, const tl_walk_triangle *triangle)
{
    seen_triangles *seen = pass->seen;
    if (seen == NULL) {
        return true;
    }
    uint32_t *slot = find_seen(seen, triangle->triangle);
    if (*slot != 0 || (pass->before != NULL && *find_seen(pass->before, triangle->triangle) != 0)) {
        return false;
    }
    if (seen->count == seen->slot_count / 4 * 3) {
        pass->deferred += pass->defers;
        return !pass->defers && is_first_copy(soup, pass->region, triangle);
    }
    *slot = triangle->triangle + 1;
    seen->count++;
    return true;
}

static bool is_in_part(const region_pass *pass, const tl_walk_triangle *triangle)
{
    return pass->part_count == 1 || (tl_hash_mix(triangle->triangle) >> 32) % pass->part_count == pass->part;
}

// Bit i: the own box of the triangle of lane i, which no walk scales, shares a point with `box`; of lanes without a
// triangle unspecified.
static uint32_t lanes_in_box(const tl_walk_leaf *leaf, tl_aabb box)
{
    const uint32_t n = leaf->view.pair_count;
    const float low[3] = { box.min.x, box.min.y, box.min.z }, high[3] = { box.max.x, box.max.y, box.max.z };
    float gap[2 * TL_SOUP_LEAF_PAIRS] = { 0.0f }; // above 0: they are apart along an axis, and the difference is not 0
    for (uint32_t axis = 0; axis < 3; axis++) {
        // Behind a short leaf's arrays there is something to read, which `in` leaves out.
        const float *a = leaf->view.floats + 4 * (size_t)axis * n, *c = a + n, *b = c + n, *d = b + n;
        for (uint32_t i = 0; i < TL_SOUP_LEAF_PAIRS; i++) {
            const float min = tl_minf(a[i], c[i]), max = tl_maxf(a[i], c[i]);
            const float first = tl_maxf(tl_minf(min, b[i]) - high[axis], low[axis] - tl_maxf(max, b[i]));
            const float second = tl_maxf(tl_minf(min, d[i]) - high[axis], low[axis] - tl_maxf(max, d[i]));
            gap[i] = tl_maxf(gap[i], first);
            gap[TL_SOUP_LEAF_PAIRS + i] = tl_maxf(gap[TL_SOUP_LEAF_PAIRS + i], second);
        }
    }
    uint8_t in[2 * TL_SOUP_LEAF_PAIRS];
    for (uint32_t i = 0; i < 2 * TL_SOUP_LEAF_PAIRS; i++) {
        in[i] = (uint8_t)((gap[i] <= 0.0f) & (i % TL_SOUP_LEAF_PAIRS < n));
    }
    const uint32_t mask = mask_of_eight(in);
    return (mask & ((1u << TL_SOUP_LEAF_PAIRS) - 1u)) | mask >> TL_SOUP_LEAF_PAIRS << n;
}

// The lanes of a leaf whose triangles may belong. At a scale each triangle's box is looked at when it is read.
static uint32_t lanes_to_read(const tl_walk_leaf *leaf, const tl_region *region)
{
    const uint32_t all = (1u << leaf->lane_count) - 1u;
    return region->box != NULL && leaf->scale == NULL ? lanes_in_box(leaf, *region->box) : all;
}

static bool belongs(const tl_region *region, const tl_walk_triangle *triangle)
{
    const bool is_known = region->box == NULL || triangle->leaf->scale == NULL;
    return (is_known || tl_aabb_overlaps(tl_walk_triangle_box(triangle), *region->box)) &&
           (region->belongs == NULL || region->belongs(triangle, region->user));
}

static bool report_leaf(const tl_walk *walk, region_pass *pass, uint32_t child)
{
    const tl_region *region = pass->region;
    tl_walk_leaf leaf;
    tl_walk_open_leaf(walk, child, &leaf);
    for (uint32_t lanes = lanes_to_read(&leaf, region); lanes != 0; lanes &= lanes - 1) {
        const uint32_t lane = tl_lowest_bit(lanes);
        tl_walk_triangle triangle;
        for (bool more = tl_walk_read_triangle(&leaf, lane, &triangle); more;
             more = tl_walk_next_coincident(&triangle)) {
            if (is_in_part(pass, &triangle) && belongs(region, &triangle) && is_new(walk->soup, pass, &triangle) &&
                !region->found(&triangle, region->user)) {
                return false;
            }
        }
    }
    return true;
}

static bool walk_leaves(const tl_soup *soup, const tl_walk_scale *scale, region_pass *pass)
{
    tl_walk walk;
    tl_walk_begin_scaled(&walk, soup, scale);
    uint32_t child;
    while (tl_walk_next(&walk, 0.0f, &child)) {
        if (!tl_walk_is_leaf(child)) {
            tl_walk_boxes boxes;
            tl_walk_read_boxes(&walk, child, &boxes);
            tl_walk_enter_all(&walk, &boxes, enter_region(&boxes, pass->region));
        } else if (!report_leaf(&walk, pass, child)) {
            return false;
        }
    }
    return true;
}

// What the first pass has left: in parts that fill half of the table's room on average, so that none overflows but by
// hashes that were made for it.
static bool walk_in_passes(const tl_soup *soup, const tl_walk_scale *scale, const region_pass *first)
{
    const uint64_t part_count = first->deferred / (TL_REGION_SLOTS / 8 * 3) + 1;
    seen_triangles seen = { first->region->memory->slots, TL_REGION_SLOTS, 0 };
    region_pass pass = { first->region, &seen, first->seen, 0, (uint32_t)part_count, false, 0 };
    for (; pass.part < pass.part_count; pass.part++) {
        memset(seen.slots, 0, TL_REGION_SLOTS * sizeof *seen.slots);
        seen.count = 0;
        if (!walk_leaves(soup, scale, &pass)) {
            return false;
        }
    }
    return true;
}

bool tl_region_walk_scaled(const tl_soup *soup, const tl_walk_scale *scale, const tl_region *region)
{
    uint32_t slots[SEEN_SLOTS];
    seen_triangles seen = { slots, SEEN_SLOTS, 0 };
    region_pass pass = { .region = region, .part_count = 1, .defers = region->memory != NULL };
    if (tl_walk_has_copies(soup)) {
        memset(slots, 0, sizeof slots);
        pass.seen = &seen;
    }
    return walk_leaves(soup, scale, &pass) && (pass.deferred == 0 || walk_in_passes(soup, scale, &pass));
}
