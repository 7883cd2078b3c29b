// SPDX-License-Identifier: MIT
//
// The boxes of a tile's tree, in metres. They are no smaller than what lies in them: what holds for a box alone, as
// that it is too far away, holds for its polygons, but what is said of a polygon's own box is asked of the polygon.

#ifndef TALUS_SRC_NAV_QUERY_TILE_BOXES_H
#define TALUS_SRC_NAV_QUERY_TILE_BOXES_H

#include "math/simd3f.h"

#include <talus/nav_tile.h>

typedef struct tl_nav_tile_boxes {
    const tl_nav_tile_node *nodes;
    tl_f32x3 base, step; // metres
} tl_nav_tile_boxes;

typedef struct tl_nav_node_box {
    tl_f32x3 min, max;
} tl_nav_node_box;

static inline tl_nav_tile_boxes tl_nav_tile_boxes_of(const tl_nav_tile *tile)
{
    const tl_nav_tile_boxes boxes = { tl_nav_tile_nodes(tile), tl_f32x3_of(tile->bounds.min),
                                      tl_f32x3_of(tl_nav_tile_node_steps(tile)) };
    return boxes;
}

// Rounded as tl_nav_tile_node_box has it.
static inline tl_nav_node_box tl_nav_box_of_node(const tl_nav_tile_boxes *boxes, uint32_t node)
{
    const char *bytes = (const char *)&boxes->nodes[node];
    const tl_f32x3 low = tl_f32x3_from_u16(bytes + offsetof(tl_nav_tile_node, min));
    const tl_f32x3 high = tl_f32x3_from_u16(bytes + offsetof(tl_nav_tile_node, max));
    const tl_nav_node_box box = { tl_f32x3_add(boxes->base, tl_f32x3_mul(low, boxes->step)),
                                  tl_f32x3_add(boxes->base, tl_f32x3_mul(high, boxes->step)) };
    return box;
}

// Of a leaf: a box that lies within its polygon's own, a step farther in. Where it is turned inside out, none is.
static inline tl_nav_node_box tl_nav_box_within_leaf(const tl_nav_tile_boxes *boxes, uint32_t node)
{
    const char *bytes = (const char *)&boxes->nodes[node];
    const tl_f32x3 one = tl_f32x3_of(tl_vec3_make(1.0f, 1.0f, 1.0f));
    const tl_f32x3 low = tl_f32x3_add(tl_f32x3_from_u16(bytes + offsetof(tl_nav_tile_node, min)), one);
    const tl_f32x3 high = tl_f32x3_sub(tl_f32x3_from_u16(bytes + offsetof(tl_nav_tile_node, max)), one);
    const tl_nav_node_box box = { tl_f32x3_add(boxes->base, tl_f32x3_mul(low, boxes->step)),
                                  tl_f32x3_add(boxes->base, tl_f32x3_mul(high, boxes->step)) };
    return box;
}

// As tl_aabb_overlaps has it.
static inline bool tl_nav_node_overlaps(const tl_nav_node_box *box, const tl_nav_node_box *other)
{
    return tl_f32x3_are_ordered(box->min, other->max, other->min, box->max);
}

#endif
