// SPDX-License-Identifier: MIT
//
// The stages of baking a soup, and what they hand on.

#ifndef TALUS_SRC_SOUP_SOUP_BAKE_H
#define TALUS_SRC_SOUP_SOUP_BAKE_H

#include "base/arena.h"
#include "base/stage.h"

#include <talus/mesh.h>
#include <talus/soup.h>

/// Two triangles that share an edge, or one. Corners are vertices of the welded mesh: triangles a, b, c and a, c, d
/// (as sets: the second may run against the first).
typedef struct tl_triangle_pair {
    uint32_t corner[4]; ///< a, b, c, d; a single has d == a
    uint32_t id[2];     ///< id words (soup_layout.h): triangles of the view; the second is TL_ID_NONE for a single
} tl_triangle_pair;

/// The triangles that take one lane together (soup_layout.h).
typedef struct tl_coincident {
    uint32_t *words;     ///< id words; NULL where no triangles coincide
    uint32_t word_count; ///< of all lanes that several triangles take
    uint32_t lane_count; ///< of these lanes
} tl_coincident;

/// Drops the triangles from a mesh that coincide with an earlier one, so that its lane stands for all: its
/// source_triangles entry becomes `source_count` plus the place of the first word. Words are the arena's. Linear.
tl_result tl_merge_coincident(tl_mesh *mesh, uint32_t source_count, tl_stage *stage, tl_arena *arena,
                              tl_coincident *coincident_out);

/// Turns the words' corner orders into those of the lanes, when pairs have given each lane its slots.
void tl_order_coincident(const tl_coincident *coincident, uint32_t source_count, const tl_triangle_pair *pairs,
                         uint32_t pair_count);

/// The row of tl_soup_corner_slots by which a triangle's three corners lie in the slots of vertices a, e and c.
uint32_t tl_corner_order(const uint32_t *corners, uint32_t a, uint32_t e, uint32_t c);

/// Matches triangles over shared edges, on the tasks of the stage's host; NULL stage: silent, one thread. Pairs are the
/// arena's. Adds as much as the mesh has triangles to the stage.
tl_result tl_pair_triangles(const tl_mesh *mesh, bool allow_pairs, tl_stage *stage, tl_arena *arena,
                            tl_triangle_pair **pairs_out, uint32_t *pair_count_out);

/// A reference: a pair's box, or the part of it that spatial splits left. 32 bytes, so that two fill a cache line.
typedef struct tl_bvh_ref {
    tl_vec3 min;
    uint32_t pair;
    tl_vec3 max;
    uint32_t is_copy; ///< 1: an earlier leaf holds the pair too
} tl_bvh_ref;

/// The reference of a whole pair.
static inline tl_bvh_ref tl_bvh_reference(const tl_mesh *mesh, const tl_triangle_pair *pairs, uint32_t pair)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t k = 0; k < 4; k++) {
        box = tl_aabb_add_point(box, mesh->vertices[pairs[pair].corner[k]]);
    }
    tl_bvh_ref ref = { box.min, pair, box.max, 0 };
    return ref;
}

/// A binary tree node. Nodes lie in preorder: an inner node's left child is the next node. 32 bytes, as references.
typedef struct tl_bvh_node {
    tl_aabb box;
    uint32_t link; ///< inner: its right child; leaf: its first reference
    uint32_t kind; ///< leaf: TL_BVH_LEAF + references, 1 to TL_SOUP_LEAF_PAIRS; inner: its plan (bvh_collapse.c)
} tl_bvh_node;

#define TL_BVH_LEAF 0x80000000u

/// References of a leaf; 0: an inner node.
static inline uint32_t tl_bvh_leaf_count(const tl_bvh_node *node)
{
    return node->kind >= TL_BVH_LEAF ? node->kind - TL_BVH_LEAF : 0;
}

/// Indices of nodes are below it, so that they have a bit to spare.
#define TL_BVH_MAX_NODES 0x80000000u

/// A subtree, nodes [first, first + count), that tasks may work on in parallel with the others.
typedef struct tl_bvh_part {
    uint32_t first, count;
} tl_bvh_part;

typedef struct tl_bvh {
    tl_bvh_ref *refs;
    tl_bvh_node *nodes; ///< the root is the first
    uint32_t node_count;
    uint32_t ref_count;       ///< in leaves
    double leaf_surface;      ///< sum of half areas of leaves
    double inner_surface;     ///< and of inner nodes; of a BVH only
    const tl_bvh_part *parts; ///< from left to right; no part holds another
    uint32_t part_count;
} tl_bvh;

/// What a tree is built from.
typedef struct tl_bvh_input {
    const tl_mesh *mesh; ///< its vertices and bounds are used
    const tl_triangle_pair *pairs;
    uint32_t pair_count;
    float split_budget;
} tl_bvh_input;

/// Builds the binary BVH that the wide one is collapsed from. Leaves hold 1 .. TL_SOUP_LEAF_PAIRS references. NULL
/// stage: silent, one thread.
tl_result tl_bvh_build(const tl_bvh_input *input, tl_stage *stage, tl_arena *arena, tl_bvh *tree_out);

/// The better of two trees by the surface area heuristic: with spatial splits within the input's budget, and without.
/// Each is built in an arena of its own; that of the other is freed.
tl_result tl_bvh_build_better(const tl_bvh_input *input, tl_stage *stage, tl_arena arenas[2], tl_bvh *tree_out);

/// The same tree by planes that part space (TL_SOUP_KD_TREE): leaves may share pairs, and no two nodes' boxes overlap
/// but where pairs lie in too many planes to be parted.
tl_result tl_kd_build(const tl_bvh_input *input, tl_stage *stage, tl_arena *arena, tl_bvh *tree_out);

/// What a soup is encoded from.
typedef struct tl_soup_parts {
    const tl_mesh_view *view;
    const tl_mesh *mesh; ///< the view, welded: its vertices, bounds and triangle count are used
    const tl_triangle_pair *pairs;
    uint32_t pair_count;
    tl_coincident coincident;
    tl_bvh *bvh;
} tl_soup_parts;

/// Collapses the binary BVH into wide nodes and lays out the blob.
tl_result tl_soup_encode(const tl_soup_parts *parts, tl_soup_layout layout, tl_stage *stage, tl_arena *arena,
                         tl_soup **soup_out);

#endif
