// SPDX-License-Identifier: MIT
//
// What the contour stages share: the traced loops, and which of their vertices are kept.

#ifndef TALUS_SRC_NAV_BAKE_CONTOURS_H
#define TALUS_SRC_NAV_BAKE_CONTOURS_H

#include <talus/nav_bake.h>

#include "base/arena.h"
#include "base/radix_sort.h"

#define TL_NO_TWIN UINT32_MAX

/// One closed outline of a region: a stretch of the raw vertices. Edge k runs from vertex k to the loop's next vertex,
/// with the region on its right hand side in (x, z) as seen with x to the right and z up: clockwise.
typedef struct tl_contour_loop {
    uint32_t first, count;
    uint32_t region, area;
    int64_t area2; ///< doubled area: > 0 outer outline, < 0 hole, 0 a slit between floors that are not linked
} tl_contour_loop;

typedef struct tl_contour_work {
    const tl_nav_config *config;
    const tl_nav_compact *compact;
    const tl_host *host; ///< whose tasks may share the work; NULL: none
    tl_arena *arena;

    uint32_t vertex_count;
    tl_contour_vertex *vertices; ///< x and z in the tile without its border; flags as polygon.h says
    uint32_t *across;            ///< region on the other side of the edge that starts here; 0 none
    uint32_t *twin;              ///< the same edge as another loop runs it, or TL_NO_TWIN
    uint32_t *loop_of;
    uint8_t *keep;       ///< 1: the simplified outline has this vertex
    const uint8_t *near; ///< [span_count] 1: floors at or near those that were taken away; NULL: none was
    uint8_t *guarded;    ///< [vertex_count] 1: the edge that starts here is of such a floor; NULL: none is
    tl_contour_loop *loops;
    uint32_t loop_count;
    uint32_t *region_first; ///< [region_count + 1] into by_region
    uint32_t *by_region;    ///< [loop_count] loops by region, in the order they were traced

    uint32_t repaired_count; ///< loops that tl_contours_repair mended
} tl_contour_work;

/// The vertices of simplified outlines: for drawing lots, and for bridges. Indices into the raw vertices.
typedef struct tl_contour_path {
    uint32_t *vertices;
    uint32_t count;
} tl_contour_path;

/// How many steps from floor to floor are near.
uint32_t tl_contours_guard_steps(const tl_nav_config *config);

/// Finds the floors near those that were taken away (compact->taken), where outlines may only draw back. Before the
/// trace.
tl_result tl_contours_find_guarded(tl_contour_work *work);

/// Of the traced guarded vertices between begin and end that are not kept, the one that the chord between the two runs
/// past the farthest, on the floor's side; `begin` when there is none.
uint32_t tl_contours_farthest_gain(const tl_contour_work *work, uint32_t begin, uint32_t end);

/// Walks all outlines. Fills all but `keep`. TL_ERR_CORRUPT when neighbour links are not mutual.
tl_result tl_contours_trace(tl_contour_work *work);

/// Decides `keep`: the same on both sides of an edge that two regions share.
tl_result tl_contours_simplify(tl_contour_work *work);

/// Keeps a vertex in all outlines that pass it.
void tl_contours_keep(tl_contour_work *work, uint32_t vertex);

/// Keeps what a loop needs to be within max_error and max_edge_len. `stack` has room for the loop's count.
void tl_contours_refine(tl_contour_work *work, uint32_t loop, uint32_t *stack);

/// Of the traced vertices between begin and end that are not kept, the one farthest from the segment between them;
/// begin or end when all lie on it. The same from both sides of an edge.
uint32_t tl_contours_farthest(const tl_contour_work *work, uint32_t begin, uint32_t end, double *distance_sq_out);

/// Keeps more vertices until no loop has collapsed or turned over, and no edges of one region cross, or touch where the
/// traced ones did not.
tl_result tl_contours_repair(tl_contour_work *work);

/// The kept vertices of a loop, without repeats in a row on xz and without spikes (there and back).
/// `path->vertices` has room for the loop's count.
void tl_contours_simplified(const tl_contour_work *work, uint32_t loop, tl_contour_path *path);

/// Bridges holes into an outline, in place; `outline->vertices` has room for all vertices of both and two more a hole.
/// `order` and `scratch` have room for hole_count items. Returns the number of holes that could not be bridged.
uint32_t tl_contours_bridge_holes(const tl_contour_work *work, tl_contour_path *outline, const tl_contour_path *holes,
                                  uint32_t hole_count, tl_sort_item *order, tl_sort_item *scratch);

static inline uint32_t tl_contour_next(const tl_contour_work *work, uint32_t vertex)
{
    const tl_contour_loop *loop = &work->loops[work->loop_of[vertex]];
    return vertex + 1 < loop->first + loop->count ? vertex + 1 : loop->first;
}

static inline uint32_t tl_contour_previous(const tl_contour_work *work, uint32_t vertex)
{
    const tl_contour_loop *loop = &work->loops[work->loop_of[vertex]];
    return vertex > loop->first ? vertex - 1 : loop->first + loop->count - 1;
}

/// Doubled area of a, b, c: < 0 where an outer outline turns convex. Exact: coordinates are below 2^25.
static inline int64_t tl_contour_area2(const tl_contour_vertex *a, const tl_contour_vertex *b,
                                       const tl_contour_vertex *c)
{
    return ((int64_t)b->x - a->x) * ((int64_t)c->z - a->z) - ((int64_t)c->x - a->x) * ((int64_t)b->z - a->z);
}

static inline bool tl_contour_same_xz(const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    return a->x == b->x && a->z == b->z;
}

#endif
