// SPDX-License-Identifier: MIT
//
// Boxes along a Morton curve, eight at a time under one box, and so on: no pointers, built by one sort. A node is
// looked into when the segment itself meets its box, not only the segment's box: a long diagonal then visits the nodes
// along it, O(sqrt n + answers) of them where boxes are spread evenly. A list sorted along x makes a segment look at
// all boxes between its ends' x: at 460,000 crossings of 2,000 edges that was nine tenths of the time.
// Source: Roussopoulos and Leifker, Direct Spatial Search on Pictorial Databases Using Packed R-Trees, 1985.

#include "polygon/outline/packed_boxes.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "base/radix_sort.h"

#include <talus/polygon.h>

// Of the 30 bits of a coordinate the Morton code takes the upper 20.
enum { DROPPED_BITS = 10 };

// Spreads 20 bits to every second place.
static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 16) & 0x0000ffff0000ffffu;
    x = (x | x << 8) & 0x00ff00ff00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
    x = (x | x << 2) & 0x3333333333333333u;
    return (x | x << 1) & 0x5555555555555555u;
}

static uint64_t morton_code(const tl_lattice_box *box)
{
    const int64_t x = ((int64_t)box->low.x + box->high.x) / 2 + TL_MAX_CONTOUR_COORDINATE;
    const int64_t z = ((int64_t)box->low.z + box->high.z) / 2 + TL_MAX_CONTOUR_COORDINATE;
    return spread_bits((uint64_t)x >> DROPPED_BITS) | spread_bits((uint64_t)z >> DROPPED_BITS) << 1;
}

static void unite_boxes(tl_lattice_box *box, const tl_lattice_box *other)
{
    box->low.x = box->low.x < other->low.x ? box->low.x : other->low.x;
    box->low.z = box->low.z < other->low.z ? box->low.z : other->low.z;
    box->high.x = box->high.x > other->high.x ? box->high.x : other->high.x;
    box->high.z = box->high.z > other->high.z ? box->high.z : other->high.z;
}

static uint32_t parents_of(uint32_t count)
{
    return (count + TL_PACKED_BOXES_CHILDREN - 1) / TL_PACKED_BOXES_CHILDREN;
}

bool tl_packed_boxes_build(tl_packed_boxes *tree, tl_arena *arena, const tl_lattice_box *boxes, uint32_t count)
{
    TL_ASSERT(count > 0);
    tree->levels = 0;
    tree->level_first[0] = 0;
    for (uint32_t of_level = count;; of_level = parents_of(of_level)) {
        tree->level_first[tree->levels + 1] = tree->level_first[tree->levels] + of_level;
        tree->levels++;
        if (of_level == 1) {
            break;
        }
    }
    tl_sort_item *order = TL_PUSH(arena, tl_sort_item, 2 * (uint64_t)count);
    tree->boxes = TL_PUSH(arena, tl_lattice_box, tree->level_first[tree->levels]);
    tree->items = TL_PUSH(arena, uint32_t, count);
    if (order == NULL || tree->boxes == NULL || tree->items == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_sort_item item = { morton_code(&boxes[i]), i, 0 };
        order[i] = item;
    }
    tl_radix_sort(order, order + count, count);
    for (uint32_t i = 0; i < count; i++) {
        tree->items[i] = order[i].value;
        tree->boxes[i] = boxes[order[i].value];
    }
    for (uint32_t level = 1; level < tree->levels; level++) {
        for (uint32_t i = tree->level_first[level]; i < tree->level_first[level + 1]; i++) {
            const uint32_t below = i - tree->level_first[level];
            const uint32_t first = tree->level_first[level - 1] + TL_PACKED_BOXES_CHILDREN * below;
            const uint32_t end = tl_min_u32(first + TL_PACKED_BOXES_CHILDREN, tree->level_first[level]);
            tree->boxes[i] = tree->boxes[first];
            for (uint32_t k = first + 1; k < end; k++) {
                unite_boxes(&tree->boxes[i], &tree->boxes[k]);
            }
        }
    }
    return true;
}

// Proof of range: coordinates within +-2^29 and a margin of some units, so sums of two are below 2^31, and differences
// of such sums below 2^32; a product with a difference of coordinates is below 2^62, and what is compared below 2^63.
static bool meets_box(const tl_packed_boxes_walk *walk, const tl_lattice_box *box)
{
    const tl_lattice_point a = walk->a, b = walk->b;
    const int32_t margin = walk->margin;
    const int32_t left = box->low.x - margin, right = box->high.x + margin;
    const int32_t low = box->low.z - margin, high = box->high.z + margin;
    if ((a.x < left && b.x < left) || (a.x > right && b.x > right) || (a.z < low && b.z < low) ||
        (a.z > high && b.z > high)) {
        return false;
    }
    // Not all corners on one side of the line: twice the turn of the middle, and how far corners are from that.
    const int64_t dx = (int64_t)b.x - a.x, dz = (int64_t)b.z - a.z;
    const int64_t middle_x = (int64_t)left + right - 2 * (int64_t)a.x,
                  middle_z = (int64_t)low + high - 2 * (int64_t)a.z;
    const int64_t turn = middle_x / 2 * dz - middle_z / 2 * dx;
    const int64_t reach =
        ((int64_t)right - left + 2) / 2 * (dz < 0 ? -dz : dz) + ((int64_t)high - low + 2) / 2 * (dx < 0 ? -dx : dx);
    return turn <= reach && -turn <= reach;
}

void tl_packed_boxes_begin(tl_packed_boxes_walk *walk, const tl_packed_boxes *tree, tl_lattice_point a,
                           tl_lattice_point b, int32_t margin)
{
    walk->tree = tree;
    walk->a = a;
    walk->b = b;
    walk->margin = margin;
    walk->stack[0] = tree->level_first[tree->levels] - 1;
    walk->depth = 1;
}

bool tl_packed_boxes_next(tl_packed_boxes_walk *walk, uint32_t *item_out)
{
    const tl_packed_boxes *tree = walk->tree;
    while (walk->depth > 0) {
        const uint32_t place = walk->stack[--walk->depth];
        if (!meets_box(walk, &tree->boxes[place])) {
            continue;
        }
        if (place < tree->level_first[1]) {
            *item_out = tree->items[place];
            return true;
        }
        uint32_t level = 1;
        while (place >= tree->level_first[level + 1]) {
            level++;
        }
        const uint32_t first =
            tree->level_first[level - 1] + TL_PACKED_BOXES_CHILDREN * (place - tree->level_first[level]);
        for (uint32_t k = tl_min_u32(first + TL_PACKED_BOXES_CHILDREN, tree->level_first[level]); k-- > first;) {
            walk->stack[walk->depth++] = k;
        }
    }
    return false;
}
