// SPDX-License-Identifier: MIT
//
// The boxes of the BVH, parents before children: what a picture of the tree is drawn from.

#include "base/assert.h"
#include "soup/query/bvh_walk.h"

// A child that is not visited yet. A stack of its own, because entries need a depth.
typedef struct box_entry {
    uint32_t node, lane, depth;
} box_entry;

bool tl_soup_bvh_boxes(const tl_soup *soup, uint32_t max_depth, tl_soup_bvh_box_fn *visit, void *user)
{
    TL_ASSERT(soup != NULL && visit != NULL);
    if (!visit(tl_soup_bounds(soup), 0, false, user)) {
        return false;
    }
    tl_walk walk;
    tl_walk_begin(&walk, soup);
    box_entry stack[TL_WALK_STACK_SIZE];
    uint32_t stack_count = 0;
    uint32_t node = 0, depth = 0;
    tl_walk_boxes boxes;
    for (;;) {
        tl_walk_read_boxes(&walk, node, &boxes);
        for (uint32_t lane = TL_WALK_WIDTH; depth < max_depth && lane-- > 0;) {
            if ((boxes.mask >> lane & 1u) != 0) {
                box_entry entry = { node, lane, depth + 1 };
                stack[stack_count++] = entry;
            }
        }
        bool inner = false;
        while (!inner) {
            if (stack_count == 0) {
                return true;
            }
            box_entry entry = stack[--stack_count];
            tl_walk_read_boxes(&walk, entry.node, &boxes);
            inner = !tl_walk_is_leaf(boxes.child[entry.lane]);
            if (!visit(tl_walk_box(&boxes, entry.lane), entry.depth, !inner, user)) {
                return false;
            }
            node = boxes.child[entry.lane];
            depth = entry.depth;
        }
    }
}
