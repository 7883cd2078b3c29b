// SPDX-License-Identifier: MIT
//
// Splitting a range of references in two: object splits (bvh_split.c) and spatial splits (bvh_split_spatial.c).

#ifndef TALUS_SRC_SOUP_BVH_SPLIT_H
#define TALUS_SRC_SOUP_BVH_SPLIT_H

#include "math/box4.h"
#include "soup/bake/soup_bake.h"

/// References [first, first + count); the array is free up to first + capacity.
typedef struct tl_bvh_range {
    tl_aabb box;
    tl_aabb centroids; ///< of the doubled centroids of the boxes
    uint32_t first;
    uint32_t count;
    uint32_t capacity;
    uint32_t depth;
} tl_bvh_range;

typedef struct tl_bvh_split {
    bool found;   ///< false: no plane separates the references; they are halved by count
    bool spatial; ///< the plane clips references; else it sorts them
    uint32_t axis;
    uint32_t bin;   ///< object splits: references of bins below it go left
    float position; ///< spatial splits: the plane
    float cost;     ///< sum over both sides of half area times blocks of TL_SOUP_LEAF_PAIRS
    tl_box4 box[2]; ///< object splits: of the left and the right side
} tl_bvh_split;

typedef struct tl_bvh_splitter {
    const tl_mesh *mesh;
    const tl_triangle_pair *pairs;
    tl_bvh_ref *refs;
    tl_bvh_ref *scratch; ///< as many as refs
    float root_half_area;
} tl_bvh_splitter;

/// The surface area heuristic's cost of a box test, in leaf tests.
#define TL_BVH_TRAVERSAL_COST 0.25f

enum { TL_BVH_BINS = 16 };

/// Where the bins of an axis begin, and bins per metre of doubled centroid; 0 where no plane separates the references.
typedef struct tl_bvh_grid {
    float base[4], scale[4];
    uint32_t count; ///< bins of an axis, up to TL_BVH_BINS
} tl_bvh_grid;

/// What falls into each bin of each axis. The bins of parts of a range add up to those of the range, in any order.
typedef struct tl_bvh_bins {
    struct {
        tl_box4 box;
        uint32_t count;
    } bin[3][TL_BVH_BINS];
} tl_bvh_bins;

tl_bvh_grid tl_bvh_make_grid(const tl_bvh_range *range);
void tl_bvh_fill_bins(const tl_bvh_ref *refs, uint32_t count, const tl_bvh_grid *grid, tl_bvh_bins *bins_out);
void tl_bvh_add_bins(const tl_bvh_bins *part, const tl_bvh_grid *grid, tl_bvh_bins *sum);

/// The cheapest plane between bins.
tl_bvh_split tl_bvh_choose_plane(const tl_bvh_bins *bins, const tl_bvh_grid *grid);

/// How many of the references in the bins an object split sends left.
uint32_t tl_bvh_count_left(const tl_bvh_bins *bins, const tl_bvh_split *split);

/// Writes references of an object split's left side to `left`, which may be `refs`, and the others to `right`, in their
/// order, and grows the sides' boxes of doubled centroids. Returns how many went left.
uint32_t tl_bvh_divide(const tl_bvh_ref *refs, uint32_t count, const tl_bvh_grid *grid, const tl_bvh_split *split,
                       tl_bvh_ref *left, tl_bvh_ref *right, tl_box4 centroids[2]);

/// The two parts of a range, of so many references each, with the spare capacity shared out. Boxes are left empty.
void tl_bvh_share_range(const tl_bvh_range *range, uint32_t left_count, uint32_t right_count, tl_bvh_range *left_out,
                        tl_bvh_range *right_out);

/// A range with its boxes computed from its references.
tl_bvh_range tl_bvh_measure_range(const tl_bvh_ref *refs, uint32_t first, uint32_t count, uint32_t capacity,
                                  uint32_t depth);

/// The cheapest split found. Does not change the range.
tl_bvh_split tl_bvh_find_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range);

/// Replaces an object split by a spatial one where that is cheaper and its references fit the capacity.
void tl_bvh_improve_by_spatial_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, tl_bvh_split *split);

/// Clips a reference by a plane: the boxes of its two parts, each conservative and within the reference's own box. A
/// part may turn out to be empty. Reads the splitter's mesh and pairs only.
void tl_bvh_clip_reference(const tl_bvh_splitter *splitter, const tl_bvh_ref *ref, uint32_t axis, float position,
                           tl_aabb *left_out, tl_aabb *right_out);

/// Clips and sorts the range's references: left ones, then right ones. False, and nothing changed, when the plane does
/// not separate them or they exceed the capacity.
bool tl_bvh_apply_spatial_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, const tl_bvh_split *split,
                                uint32_t *left_count_out, uint32_t *right_count_out);

/// Applies a split. Both sides get at least one reference.
void tl_bvh_apply_split(const tl_bvh_splitter *splitter, const tl_bvh_range *range, const tl_bvh_split *split,
                        tl_bvh_range *left_out, tl_bvh_range *right_out);

/// Component 0, 1 or 2.
static inline float tl_component(tl_vec3 v, uint32_t axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static inline void tl_set_component(tl_vec3 *v, uint32_t axis, float value)
{
    if (axis == 0) {
        v->x = value;
    } else if (axis == 1) {
        v->y = value;
    } else {
        v->z = value;
    }
}

/// What a side of so many references costs to test.
static inline float tl_bvh_blocks(uint32_t count)
{
    return (float)((count + 3u) / 4u);
}

#endif
