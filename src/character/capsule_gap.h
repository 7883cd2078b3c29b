// SPDX-License-Identifier: MIT
//
// What is near a character, and how far the core of its capsule is from it. The core is an upright segment.

#ifndef TALUS_SRC_CHARACTER_CAPSULE_GAP_H
#define TALUS_SRC_CHARACTER_CAPSULE_GAP_H

#include "math/vec3d.h"

#include <talus/convex.h>

/// A triangle or a convex shape, in the world.
typedef struct tl_mover_item {
    tl_vec3d low, high; ///< its box
    tl_vec3d normal;    ///< unit, of the front; zero for a needle, whose height is below the precision of its corners
    tl_vec3d corners[3];
    tl_vec3d inward[3];     ///< in its plane, from the edge that begins at each corner inwards, as long as that edge
    double edge_sq[3];      ///< square metres: those lengths squared
    const tl_convex *shape; ///< NULL: a triangle
    const tl_transform *pose;
    uint32_t instance, triangle;
    uint16_t material;
    bool edges_known;
} tl_mover_item;

/// An upright capsule's core: from `low` up by `length`; and the radius, for shapes.
typedef struct tl_mover_core {
    tl_vec3d low;
    double length, radius;
} tl_mover_core;

/// The nearest points. Where the core crosses a triangle the distance is negative: what moves it to the nearer side.
typedef struct tl_mover_nearest {
    double distance; ///< of the core
    tl_vec3d normal; ///< unit, from the item to the core
    tl_vec3d point;  ///< on the item
    bool face;       ///< a triangle's inside is nearest, not an edge or corner of it
} tl_mover_nearest;

/// Box and normal of the triangle with the item's corners.
void tl_mover_set_triangle(tl_mover_item *item);

/// What is farther than `reach` may be called infinitely far: then the distance alone is set.
void tl_mover_nearest_of(tl_mover_item *item, const tl_mover_core *core, double reach, tl_mover_nearest *nearest_out);

/// Whether the item's box lies farther from the core's box than `reach`.
static inline bool tl_mover_is_far(const tl_mover_item *item, const tl_mover_core *core, double reach)
{
    return item->low.x - core->low.x > reach || core->low.x - item->high.x > reach ||
           item->low.z - core->low.z > reach || core->low.z - item->high.z > reach ||
           item->low.y - (core->low.y + core->length) > reach || core->low.y - item->high.y > reach;
}

#endif
