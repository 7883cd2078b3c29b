// SPDX-License-Identifier: MIT
//
// What both layouts are written from: the binary tree, cut into wide nodes in breadth-first order.

#ifndef TALUS_SRC_SOUP_SOUP_BAKE_H
#define TALUS_SRC_SOUP_SOUP_BAKE_H

#include "soup/compact_layout.h"
#include "soup/soup_build.h"
#include "soup/tree_cut.h"

typedef struct tl_baker {
    const tl_mesh_view *view;
    const tl_mesh *mesh;
    const tl_pair *pairs;
    uint32_t pair_count;
    const tl_tree *tree;
    tl_soup_layout layout;
    tl_tree_cut cut;
    uint32_t *roots;  // binary node of each wide node, in breadth-first order
    uint8_t *written; // pairs that have been written once
    uint32_t node_count;
    uint32_t leaf_count;
    uint32_t depth;
    uint64_t leaf_bytes;
} tl_baker;

/// The vertices of the compact layout, numbered in the order of the leaves.
typedef struct tl_compact_plan {
    uint16_t (*corners)[4]; ///< of each pair in leaves
    uint32_t *groups;
    uint32_t *vertices; ///< of the mesh
    uint32_t vertex_count;
} tl_compact_plan;

tl_result tl_compact_plan_vertices(const tl_baker *baker, tl_arena *arena, tl_compact_plan *plan);

/// Writes nodes, pairs, groups and vertices; the soup's head is filled.
void tl_compact_write(tl_baker *baker, const tl_compact_plan *plan, tl_soup *soup);

/// The id word of a pair's first (k 0) or second (k 1) triangle; TL_ID_NONE where it has no second one.
uint32_t tl_bake_id(const tl_baker *baker, const tl_pair *pair, uint32_t k, bool is_copy);

#endif
