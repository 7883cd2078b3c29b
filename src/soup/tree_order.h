// SPDX-License-Identifier: MIT
//
// The order of a wide node's children.

#ifndef TALUS_SRC_SOUP_TREE_ORDER_H
#define TALUS_SRC_SOUP_TREE_ORDER_H

#include "soup/soup_build.h"

/// For each binary node the chance that it stops a ray which enters its box. Memory is the arena's.
tl_result tl_tree_order_plan(const tl_tree *tree, tl_arena *arena, const float **chance_out);

/// The most likely first; of equal ones, as they were.
void tl_tree_order_children(const float *chance, uint32_t *children, uint32_t count);

#endif
