// SPDX-License-Identifier: MIT
//
// The tiles that a box in the plane touches: by their places, or, where the box covers more places than there are
// tiles, all of them. And the boxes of a tile's tree, in metres: they are no smaller than what lies in them, so what
// holds for a box, as that it is too far away, holds for its polygons; what is said of a polygon's own box is asked of
// the polygon.

#ifndef TALUS_SRC_NAV_QUERY_TILE_WALK_H
#define TALUS_SRC_NAV_QUERY_TILE_WALK_H

#include "math/simd3f.h"
#include "nav_query/navmesh/navmesh.h"

typedef struct tl_nav_tile_walk {
    const tl_navmesh *navmesh;
    bool by_place;
    uint32_t slot; // the next one to look at
    int64_t first_x, last_x, last_z;
    int64_t x, z;  // the next place to look at
    uint32_t next; // at the same place, or TL_NAV_NO_SLOT
} tl_nav_tile_walk;

// Tiles along one axis that an interval touches, one cell of margin on each side for rounding.
static inline void tl_nav_tile_interval(double low, double high, double origin, const tl_navmesh *navmesh,
                                        int64_t *first_out, int64_t *last_out)
{
    double cell = (double)navmesh->cell_size;
    double size = cell * (double)navmesh->tile_size;
    double limit = (double)TL_NAV_MAX_TILE_INDEX;
    double first = floor((low - origin - cell) / size);
    double last = floor((high - origin + cell) / size);
    *first_out = (int64_t)(first < -limit ? -limit : first > limit ? limit : first);
    *last_out = (int64_t)(last < -limit ? -limit : last > limit ? limit : last);
}

static inline tl_nav_tile_walk tl_nav_tiles_over(const tl_navmesh *navmesh, tl_aabb box)
{
    tl_nav_tile_walk walk = { navmesh, false, 0, 0, 0, 0, 0, 0, TL_NAV_NO_SLOT };
    if (navmesh->tile_size > 0) {
        tl_nav_tile_interval((double)box.min.x, (double)box.max.x, (double)navmesh->origin.x, navmesh, &walk.first_x,
                             &walk.last_x);
        tl_nav_tile_interval((double)box.min.z, (double)box.max.z, (double)navmesh->origin.z, navmesh, &walk.z,
                             &walk.last_z);
        walk.x = walk.first_x;
        // Places are below 2^25 an axis: the product fits 64 bits.
        walk.by_place = (walk.last_x - walk.first_x + 1) * (walk.last_z - walk.z + 1) <= (int64_t)navmesh->slot_count;
    }
    return walk;
}

/// The slot of the next tile, or TL_NAV_NO_SLOT.
static inline uint32_t tl_nav_next_tile(tl_nav_tile_walk *walk)
{
    while (walk->by_place && (walk->next != TL_NAV_NO_SLOT || walk->z <= walk->last_z)) {
        uint32_t slot = walk->next;
        if (slot == TL_NAV_NO_SLOT) {
            slot = tl_nav_find_slot(walk->navmesh, walk->x, walk->z);
            bool ends_row = walk->x == walk->last_x;
            walk->x = ends_row ? walk->first_x : walk->x + 1;
            walk->z += ends_row ? 1 : 0;
        }
        if (slot != TL_NAV_NO_SLOT) {
            walk->next = tl_nav_next_slot(walk->navmesh, slot);
            return slot;
        }
    }
    while (!walk->by_place && walk->slot < walk->navmesh->slot_count) {
        uint32_t slot = walk->slot++;
        if (walk->navmesh->slots[slot].tile != NULL) {
            return slot;
        }
    }
    return TL_NAV_NO_SLOT;
}

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
