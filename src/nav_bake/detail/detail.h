// SPDX-License-Identifier: MIT
//
// What the detail stages share. Plane coordinates are integers, in 1/1024 of a column from the polygon's own corner of
// the lattice, so that every side decision is exact; heights are voxels.

#ifndef TALUS_SRC_NAV_BAKE_DETAIL_H
#define TALUS_SRC_NAV_BAKE_DETAIL_H

#include <talus/nav_bake.h>

#include "base/arena.h"

enum {
    TL_DETAIL_FRACTION_BITS = 10,
    TL_DETAIL_ONE = 1 << TL_DETAIL_FRACTION_BITS,
    /// Columns along one polygon: 2^20 * 2^10 leaves a doubled area below 2^61.
    TL_DETAIL_MAX_EXTENT = 1 << 20,
    /// An edge is sampled in 2^n equal steps, so that its samples lie exactly on it; n <= 9.
    TL_DETAIL_MAX_EDGE_BITS = 9,
    /// Of one patch; its corners are 16-bit. 64 corners and 64 * 511 samples on edges fit in any case.
    TL_DETAIL_MAX_VERTICES = 65535
};

#define TL_DETAIL_NONE UINT32_MAX

typedef struct tl_detail_point {
    int32_t x, z;
    int32_t y; ///< voxels
} tl_detail_point;

// ---------------------------------------------------------------------------------------------------------
// Heights: detail_heights.c

/// Which floors a polygon stands on.
typedef struct tl_detail_floors {
    const tl_nav_compact *compact;
    uint32_t region; ///< of the polygon; 0: none was found, heights are the fallback
    uint32_t reach;  ///< columns: how far to look for a floor of the region
    bool several;    ///< the polygon lies on other regions too
    uint32_t anchor; ///< the region's floor nearest to the polygon's middle, or TL_NAV_NO_SPAN
    int64_t anchor_x, anchor_z;
} tl_detail_floors;

/// The region of a polygon of several: of those on which its corners stand, the one of the floor nearest to `height` at
/// its middle, the column (x, z), border included; or near it, within `reach` columns. 0: no corner stands on a floor.
/// Corners are as high as the floors they were found on. A floor nearer to `height` that no corner stands on is another
/// storey's: under a roof the mean of the corners is often nearer to the attic's.
uint32_t tl_detail_choose_region(const tl_nav_compact *compact, const tl_polygon_mesh *polygons, uint32_t polygon,
                                 uint32_t reach, int64_t x, int64_t z, int32_t height);

/// The floors of a polygon whose middle is the column (x, z), border included. `region` 0: there are none.
tl_detail_floors tl_detail_floors_make(const tl_nav_compact *compact, uint32_t region, bool several, uint32_t reach,
                                       int64_t x, int64_t z);

/// The floor's height in a column: that of the region, or of what one walks on from there to the column. `inner`: the
/// column lies well inside the polygon, so that a floor of its region is one of its storey. `expected`: the answer
/// where there is no floor at all, and what decides between two storeys.
int32_t tl_detail_floor_at(const tl_detail_floors *floors, int64_t x, int64_t z, bool inner, int32_t expected);

// ---------------------------------------------------------------------------------------------------------
// Edges: detail_edges.c

/// A height kept along an edge, at step / 2^bits of the way from its lower end (by x, then z).
typedef struct tl_detail_edge_sample {
    uint16_t step;
    uint16_t reserved;
    int32_t y;
} tl_detail_edge_sample;

typedef struct tl_detail_edge {
    uint32_t first;
    uint16_t count;
    uint8_t bits;   ///< sampled in 2^bits steps
    uint8_t coarse; ///< 1: these are longer than the spacing
} tl_detail_edge;

/// The kept samples of all edges, one entry a corner of the polygon mesh; linked edges share theirs.
typedef struct tl_detail_edges {
    tl_detail_edge *edges; ///< [index_count]
    tl_detail_edge_sample *samples;
    uint32_t sample_count, sample_capacity;
} tl_detail_edges;

typedef struct tl_detail_work {
    const tl_nav_config *config;
    const tl_nav_compact *compact;
    const tl_polygon_mesh *polygons;
    tl_arena *arena;
    double spacing;   ///< columns between samples; 0: none
    double max_error; ///< voxels
    tl_detail_edges edges;
} tl_detail_work;

tl_result tl_detail_sample_edges(tl_detail_work *work);

/// Columns that a polygon's corners span, border not included.
typedef struct tl_detail_extent {
    int32_t min_x, min_z, max_x, max_z;
    int64_t sum_x, sum_z; ///< of the corners
    int64_t sum_y;
} tl_detail_extent;

tl_detail_extent tl_detail_polygon_extent(const tl_polygon_mesh *polygons, uint32_t polygon);
tl_detail_floors tl_detail_polygon_floors(const tl_detail_work *work, uint32_t polygon);

// ---------------------------------------------------------------------------------------------------------
// Triangulation: detail_delaunay.c

/// A Delaunay triangulation that grows point by point, with the height samples that lie in each triangle.
/// Edge k of a triangle runs from corner k to corner (k + 1) % 3.
typedef struct tl_detail_triangle {
    uint32_t corner[3];
    uint32_t across[3];    ///< triangle, or TL_DETAIL_NONE on the polygon's outline
    uint32_t first_sample; ///< of a list through next_sample, or TL_DETAIL_NONE
} tl_detail_triangle;

typedef struct tl_detail_mesh {
    tl_detail_point *points;
    uint32_t point_count;
    tl_detail_triangle *triangles;
    uint32_t triangle_count;
    uint32_t *triangle_of; ///< [point] some triangle that has it
    const tl_detail_point *samples;
    uint32_t *next_sample;
    uint32_t *changed; ///< triangles made or changed since the caller emptied the list; repeats are possible
    uint32_t changed_count;
    uint32_t *stack; ///< pairs (triangle, edge); scratch
} tl_detail_mesh;

/// Twice the area of a, b, c, > 0 in the polygons' winding. Exact.
static inline int64_t tl_detail_orient(const tl_detail_point *a, const tl_detail_point *b, const tl_detail_point *c)
{
    return ((int64_t)c->x - a->x) * ((int64_t)b->z - a->z) - ((int64_t)b->x - a->x) * ((int64_t)c->z - a->z);
}

/// Triangulates the convex polygon of points 0 .. corner_count - 1.
void tl_detail_start(tl_detail_mesh *mesh, uint32_t corner_count);

/// Inserts the last point, which lies on the outline strictly between point `a` and the next one on it.
void tl_detail_insert_on_outline(tl_detail_mesh *mesh, uint32_t a);

/// Inserts the last point, which lies in `triangle` and on no other point.
void tl_detail_insert_inside(tl_detail_mesh *mesh, uint32_t triangle);

/// The triangle that holds a point of the polygon, found by walking from `start`.
uint32_t tl_detail_locate(const tl_detail_mesh *mesh, const tl_detail_point *p, uint32_t start);

// ---------------------------------------------------------------------------------------------------------
// Samples: detail_samples.c

/// Height samples inside a polygon, no nearer to its edges than half the spacing: at column centres. Stores at most
/// `capacity` and returns their number.
uint32_t tl_detail_sample_inside(const tl_detail_work *work, uint32_t polygon, tl_detail_point *samples,
                                 uint32_t capacity);

/// A bound of what tl_detail_sample_inside returns.
uint64_t tl_detail_sample_bound(const tl_detail_work *work, uint32_t polygon);

/// Heap of triangles by their worst sample.
typedef struct tl_detail_heap {
    uint32_t *triangles; ///< heap order
    uint32_t *place;     ///< [triangle] in `triangles`, or TL_DETAIL_NONE
    double *error;       ///< [triangle] voxels
    uint32_t *worst;     ///< [triangle] sample
    uint32_t count;
} tl_detail_heap;

/// Inserts samples, the worst first, until all are within max_error of the surface or the patch is full. Each sample is
/// in its triangle's list. Returns the largest error left, in voxels: of all samples, against the final surface.
double tl_detail_refine(tl_detail_mesh *mesh, tl_detail_heap *heap, uint32_t sample_count, double max_error);

#endif
