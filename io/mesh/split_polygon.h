// SPDX-License-Identifier: MIT
//
// Triangulating a polygon in space: a fan where it is convex, else by ear clipping.

#ifndef TALUS_IO_SPLIT_POLYGON_H
#define TALUS_IO_SPLIT_POLYGON_H

#include <talus/vec.h>

/// Corners beyond which a polygon is not clipped: the work grows with their square.
#define TL_MAX_SPLIT_CORNERS 1024u

typedef enum tl_split {
    TL_SPLIT_FAN,    ///< convex and without corners in line with the first one, or without any area: left as a fan
    TL_SPLIT_EARS,   ///< clipped ear by ear
    TL_SPLIT_GAVE_UP ///< too many corners, or no ear was found (the outline crosses itself): left as a fan
} tl_split;

/// Scratch, one a corner.
typedef struct tl_split_corner {
    double x, y; // in the polygon's plane, counter-clockwise
    uint32_t previous, next;
    bool blocks; // not convex, so it can lie inside an ear
} tl_split_corner;

/// Splits the polygon vertices[corners[0]], ..., `count` >= 4 of them, into count - 2 triangles of the same winding,
/// three vertex indices each, in `triangles`. That array must hold the fan from the first corner at the call, and still
/// does when the result is not TL_SPLIT_EARS. `scratch` holds `count`; it is not used beyond
/// TL_MAX_SPLIT_CORNERS. The result depends on the positions alone. A polygon need not be quite flat: it is projected
/// along its mean normal's largest axis.
tl_split tl_split_polygon(const tl_vec3 *vertices, const uint32_t *corners, uint32_t count, tl_split_corner *scratch,
                          uint32_t *triangles);

#endif
