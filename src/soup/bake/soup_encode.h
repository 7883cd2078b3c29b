// SPDX-License-Identifier: MIT
//
// What both layouts are written from: the binary BVH, collapsed into wide nodes in breadth-first order.

#ifndef TALUS_SRC_SOUP_SOUP_ENCODE_H
#define TALUS_SRC_SOUP_SOUP_ENCODE_H

#include "soup/bake/bvh_collapse.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/compact_layout.h"

/// Marks a child of a wide node as a leaf, in the index of its binary node.
#define TL_WIDE_LEAF TL_BVH_MAX_NODES

/// A wide node, and the places of its children.
typedef struct tl_wide_node {
    uint32_t root; ///< binary node
    uint32_t child_count;
    uint32_t child[TL_SOUP_WIDTH]; ///< binary nodes
    uint32_t inner_count;          ///< children that are wide nodes
    uint32_t leaf_count;
    uint32_t first_inner; ///< index of the first of them: they are consecutive
    uint32_t leaf_bytes;
    uint64_t leaf_offset; ///< of its first leaf: they are consecutive
} tl_wide_node;

typedef struct tl_soup_encoder {
    const tl_mesh_view *view;
    const tl_mesh *mesh;
    const tl_triangle_pair *pairs;
    uint32_t pair_count;
    tl_coincident coincident;
    const tl_bvh *tree;
    tl_stage *stage;
    tl_soup_layout layout;
    tl_bvh_collapse cut;
    tl_wide_node *wide; // in breadth-first order
    uint64_t wide_capacity;
    uint32_t node_count;
    uint32_t leaf_count;
    uint32_t depth;
    uint64_t leaf_bytes;
    const struct tl_compact_plan *plan;
    tl_soup *soup;
} tl_soup_encoder;

/// The vertices of the compact layout, numbered in the order of the leaves.
typedef struct tl_compact_plan {
    uint16_t (*corners)[4]; ///< of each pair in leaves
    uint32_t *groups;
    uint32_t *vertices; ///< of the mesh
    uint32_t vertex_count;
} tl_compact_plan;

/// Numbers them, in the arena's memory.
tl_result tl_compact_plan_vertices(const tl_soup_encoder *baker, tl_arena *arena, tl_compact_plan *plan);

/// Writes a node and its pairs.
void tl_compact_write_node(const tl_soup_encoder *baker, uint32_t node);

/// Writes groups and vertices.
tl_result tl_compact_write_vertices(const tl_soup_encoder *baker);

/// The id word of a reference's first (k 0) or second (k 1) triangle; TL_ID_NONE where it has no second one.
uint32_t tl_encode_id(const tl_soup_encoder *baker, const tl_bvh_ref *ref, uint32_t k);

#endif
