// SPDX-License-Identifier: MIT
//
// The order of a wide node's children.

#ifndef TALUS_SRC_SOUP_BVH_ORDER_H
#define TALUS_SRC_SOUP_BVH_ORDER_H

#include "soup/bake/soup_bake.h"

/// Writes the probability that a binary node stops a ray that enters its box; its children's are known.
void tl_bvh_order_node(const tl_bvh *tree, uint32_t index, float *chance);

/// Sorts children by that, the likeliest first; equal ones keep their order.
void tl_bvh_order_children(const float *chance, uint32_t *children, uint32_t count);

#endif
