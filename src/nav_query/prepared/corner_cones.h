// SPDX-License-Identifier: MIT
//
// Visibility cones of corner vertices, by polygon (corner_cones.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_CONES_H
#define TALUS_SRC_NAV_QUERY_CORNER_CONES_H

#include "base/stage.h"
#include "nav_query/search/wedge.h"

typedef struct tl_nav_visibility_graph tl_nav_visibility_graph; // visibility_graph.h

/// So many cones are tested at once: more than loops that compilers write out, and so leave without vectors.
enum { TL_NAV_CONES_AT_ONCE = 24 };

/// Of a graph, at most: a corner vertex's number shares a word with a cone's slack.
#define TL_NAV_MAX_CORNER_VERTICES (1u << 24)

/// Steps of the larger component of a cone's direction.
#define TL_NAV_CONE_STEPS 32767.0

/// The cones from which a path may go straight to a corner vertex and turn there, by polygon of a tile: 12 bytes each.
/// A cone is two directions from its vertex in whole steps, and a slack for their rounding (corner_cones.c). A batch of
/// TL_NAV_CONES_AT_ONCE can be read from any of them on, whose vertices are all within the graph's room.
typedef struct tl_nav_corner_cones {
    uint32_t *first; ///< [polygon_count + 1]; the block that all arrays stand in, or NULL: there is no tile
    int16_t *left_x, *left_z, *right_x, *right_z;
    uint32_t *vertex; ///< its corner vertex, and in the high 8 bits the code of its slack
    uint32_t polygon_count;
    uint32_t count;
} tl_nav_corner_cones;

// A slack is (1 + (code % 8) / 8) 2^(code / 8 - 1): the high bits of a float.
enum { TL_NAV_SLACK_SHIFT = 20, TL_NAV_SLACK_LOWEST = 126 << 23, TL_NAV_SLACK_CODE_SHIFT = 24 };

/// How much wider a cone is than its directions tell, in steps, by its word in `vertex`.
static inline float tl_nav_cone_slack(uint32_t word)
{
    const union {
        uint32_t bits;
        float value;
    } slack = { (word >> TL_NAV_SLACK_CODE_SHIFT << TL_NAV_SLACK_SHIFT) + TL_NAV_SLACK_LOWEST };
    return slack.value;
}

static inline uint32_t tl_nav_cone_vertex(const tl_nav_corner_cones *cones, uint32_t cone)
{
    return cones->vertex[cone] & (TL_NAV_MAX_CORNER_VERTICES - 1);
}

/// A cone as it is found: between two directions from a corner vertex, in one polygon.
typedef struct tl_nav_corner_cone {
    uint32_t slot, polygon;
    uint32_t vertex;
    int side; ///< to which a path turns there: 1 left, -1 right
    float right_x, right_z, left_x, left_z;
} tl_nav_corner_cone;

typedef struct tl_nav_cone_list {
    const tl_allocator *allocator;
    tl_nav_corner_cone *cones;
    uint64_t count, capacity;
} tl_nav_cone_list;

/// Adds the cones of a wedge that is seen from a corner vertex. TL_ERR_MEMORY.
tl_result tl_nav_add_cones(tl_nav_cone_list *list, const tl_nav_visibility_graph *graph, uint32_t vertex,
                           const tl_nav_wedge *wedge);
/// Makes a tile's cones: those before that are not dropped, and `count` new ones, in any order. `is_dropped`, by cone,
/// may be NULL where there were none. `old_polygons`: by polygon the number that it had before, or TL_NO_POLYGON; NULL:
/// the same. Does not count the tile's bytes. TL_ERR_MEMORY: they are as they were. TL_ERR_LIMIT.
tl_result tl_nav_remake_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint32_t slot,
                              uint32_t polygon_count, const uint32_t *old_polygons, const bool *is_dropped,
                              const tl_nav_corner_cone *fresh, uint64_t count);
/// Releases the block; there is no tile then.
void tl_nav_free_cones(const tl_allocator *allocator, tl_nav_corner_cones *cones);
/// Bytes of the block.
uint64_t tl_nav_cones_size(const tl_nav_corner_cones *cones);

#endif
