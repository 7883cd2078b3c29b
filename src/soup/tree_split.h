// SPDX-License-Identifier: MIT
//
// How a range of references is split in two.

#ifndef TALUS_SRC_SOUP_TREE_SPLIT_H
#define TALUS_SRC_SOUP_TREE_SPLIT_H

#include "soup/soup_build.h"

/// References [first, first + count), with room up to first + capacity.
typedef struct tl_tree_range {
    tl_aabb box;
    tl_aabb middles; ///< of the doubled middles of the boxes
    uint32_t first;
    uint32_t count;
    uint32_t capacity;
    uint32_t depth;
} tl_tree_range;

typedef struct tl_tree_split {
    bool found;   ///< false: no plane parts the references; they are halved by count
    bool spatial; ///< a plane that cuts references, not one that sorts them
    uint32_t axis;
    uint32_t bin;   ///< object splits: centroids of bins below it go left
    float position; ///< spatial splits: the plane
    float overlap;  ///< half area of what both sides' boxes share
    float cost;     ///< sum over both sides of half area times blocks of TL_SOUP_LEAF_PAIRS
} tl_tree_split;

typedef struct tl_tree_splitter {
    const tl_mesh *mesh;
    const tl_pair *pairs;
    tl_tree_ref *refs;
    float root_half_area;
} tl_tree_splitter;

/// A range and its boxes, from its references.
tl_tree_range tl_tree_measure_range(const tl_tree_ref *refs, uint32_t first, uint32_t count, uint32_t capacity,
                                    uint32_t depth);

/// The cheapest split that was found. Reads the range only.
tl_tree_split tl_tree_find_split(const tl_tree_splitter *splitter, const tl_tree_range *range);

/// Replaces an object split by a spatial one where that is cheaper and there is room for its references.
void tl_tree_improve_by_spatial_split(const tl_tree_splitter *splitter, const tl_tree_range *range,
                                      tl_tree_split *split);

/// Boxes of the two parts of a reference that a plane cuts, each whole and within the reference's own box. A part may
/// turn out to be empty. Of the splitter mesh and pairs are read.
void tl_tree_cut_reference(const tl_tree_splitter *splitter, const tl_tree_ref *ref, uint32_t axis, float position,
                           tl_aabb *left_out, tl_aabb *right_out);

/// Cuts and sorts the range's references: left ones, then right ones. False, and nothing changed, when the plane does
/// not part them or there is no room.
bool tl_tree_apply_spatial_split(const tl_tree_splitter *splitter, const tl_tree_range *range,
                                 const tl_tree_split *split, uint32_t *left_count_out, uint32_t *right_count_out);

/// Carries a split out. Both sides get at least one reference.
void tl_tree_apply_split(const tl_tree_splitter *splitter, const tl_tree_range *range, const tl_tree_split *split,
                         tl_tree_range *left_out, tl_tree_range *right_out);

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
static inline float tl_tree_blocks(uint32_t count)
{
    return (float)((count + 3u) / 4u);
}

#endif
