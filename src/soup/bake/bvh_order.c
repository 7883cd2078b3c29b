// SPDX-License-Identifier: MIT
//
// The order of a wide node's children: first the one that most likely stops a ray.
//
// An any-hit query takes a node's children as they come, and ends soonest with the likeliest blocker first. Choosing it
// when the tree is baked costs nothing at run time. Closest-hit queries sort children themselves.
//
// A ray that enters a box enters a box inside it with the probability of their surfaces' ratio (as in the SAH). So in a
// leaf a pair stops it with the probability of the pair's own box, taken as full (most pairs are a rectangle that fills
// it); and a ray leaves a node when it passes both halves, taken as independent.
//
// Tried: probabilities by the area of the triangles instead of their box (the same), by probability for the cost of a
// visit (the same), leaves first (a fifth of the gain), largest first (no gain), nearest first at run time (a sixth
// slower than no order at all).

#include "soup/bake/bvh_order.h"

// The probability that a ray that enters the outer box enters the inner one.
static float share(float inner_half_area, float outer_half_area)
{
    return inner_half_area < outer_half_area ? inner_half_area / outer_half_area : 1.0f;
}

static float leaf_chance(const tl_bvh *tree, const tl_bvh_node *node)
{
    float sum = 0.0f;
    for (uint32_t i = 0; i < tl_bvh_leaf_count(node); i++) {
        const tl_bvh_ref *ref = &tree->refs[node->link + i];
        tl_aabb box = { ref->min, ref->max };
        sum += tl_aabb_half_area(box);
    }
    return share(sum, tl_aabb_half_area(node->box));
}

void tl_bvh_order_node(const tl_bvh *tree, uint32_t index, float *chance)
{
    const tl_bvh_node *node = &tree->nodes[index];
    if (tl_bvh_leaf_count(node) > 0) {
        chance[index] = leaf_chance(tree, node);
        return;
    }
    float pass = 1.0f, half_area = tl_aabb_half_area(node->box);
    const uint32_t halves[2] = { index + 1, node->link };
    for (uint32_t k = 0; k < 2; k++) {
        pass *= 1.0f - chance[halves[k]] * share(tl_aabb_half_area(tree->nodes[halves[k]].box), half_area);
    }
    chance[index] = 1.0f - pass;
}

void tl_bvh_order_children(const float *chance, uint32_t *children, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        uint32_t child = children[i], place = i;
        for (; place > 0 && chance[children[place - 1]] < chance[child]; place--) {
            children[place] = children[place - 1];
        }
        children[place] = child;
    }
}
