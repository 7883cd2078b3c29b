// SPDX-License-Identifier: MIT
//
// What is near a character, and how far the core of its capsule is from it. The core is an upright segment.

#ifndef TALUS_SRC_CHARACTER_CAPSULE_GAP_H
#define TALUS_SRC_CHARACTER_CAPSULE_GAP_H

#include "math/vec3d.h"

#include <talus/convex_scaled.h>

/// A triangle or a convex shape, in the world.
typedef struct tl_mover_item {
    tl_vec3d low, high; ///< its box
    tl_vec3d normal;    ///< unit, of the front; zero for a needle, whose height is below the precision of its corners
    tl_vec3d corners[3];
    tl_vec3d inward[3];     ///< in its plane, from the edge that begins at each corner inwards, as long as that edge
    double edge_sq[3];      ///< square metres: those lengths squared
    const tl_convex *shape; ///< NULL: a triangle
    const tl_transform *pose;
    tl_vec3 scale; ///< of the shape
    uint32_t instance, triangle;
    uint16_t material;
    bool known; ///< of a triangle: normal, inward, edge_sq
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

/// The box of the triangle with the item's corners.
void tl_mover_set_triangle(tl_mover_item *item);
/// Its normal and edges. Most triangles near are told off by their boxes: the others are computed once.
void tl_mover_know_triangle(tl_mover_item *item);

static inline void tl_mover_know(tl_mover_item *item)
{
    if (item->shape == NULL && !item->known) {
        tl_mover_know_triangle(item);
    }
}

/// The item's shape at its scale: itself, or in the room. A scene has checked that it takes the scale.
const tl_convex *tl_mover_shape(const tl_mover_item *item, tl_scaled_convex *room);

/// What is farther than `reach` may be called infinitely far: then the distance alone is set.
void tl_mover_nearest_of(tl_mover_item *item, const tl_mover_core *core, double reach, tl_mover_nearest *nearest_out);

/// How far a span from `low` to `high` is from another one.
static inline double tl_mover_between(double low, double high, double from, double to)
{
    const double below = from - high, above = low - to, most = below > above ? below : above;
    return most > 0.0 ? most : 0.0;
}

/// Whether the item's box lies farther from the core than `reach`.
static inline bool tl_mover_is_far(const tl_mover_item *item, const tl_mover_core *core, double reach)
{
    const double x = tl_mover_between(item->low.x, item->high.x, core->low.x, core->low.x);
    const double y = tl_mover_between(item->low.y, item->high.y, core->low.y, core->low.y + core->length);
    const double z = tl_mover_between(item->low.z, item->high.z, core->low.z, core->low.z);
    return x * x + y * y + z * z > reach * reach;
}

#endif
