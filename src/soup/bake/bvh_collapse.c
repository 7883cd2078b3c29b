// SPDX-License-Identifier: MIT
//
// Collapses the binary BVH into 16-wide nodes that rays visit least, by dynamic programming.
//
// A ray visits a node in proportion to its surface, so the sum of surfaces over all wide nodes counts; leaves are
// visited however the tree is collapsed. C(n, i) is the least sum below binary node n when it may become up to i
// children of one wide node: one child that is a wide node itself, or some of n's left and some of n's right subtree.
// Opening the largest child again and again (Wald, Benthin, Boulos 2008) looks one step ahead: it leaves a third more
// nodes, most of them nearly empty, at the bottom.
//
// A wide node also takes cache, however rarely it is visited; without a price for that small nodes abound.
//
// Source: Ylitie, Karras, Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017, section
// 3.1.

#include "soup/bake/bvh_collapse.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "soup/bake/bvh_order.h"

#include <float.h>
#include <string.h>

// What a wide node costs unvisited, in mean surfaces of a binary leaf.
#define NODE_PRICE 1.0f

// How one binary node is divided. Index 0 is for the node as a wide node, index i for up to i children. There are no
// more children than leaves: entries beyond are not filled.
typedef struct tl_collapse_plan {
    uint32_t width; // number of leaves, at most 15
    float cost[TL_SOUP_WIDTH];
    uint8_t left[TL_SOUP_WIDTH]; // children from the left subtree; 0: the node is one child
    uint8_t right[TL_SOUP_WIDTH];
} tl_collapse_plan;

// Tasks plan the parts of a tree; the nodes between them follow, since a node's plan needs its children's. Children lie
// behind their parents, so nodes are planned from the last to the first.
typedef struct planner {
    tl_bvh *tree;
    tl_collapse_plan *plans;
    float *chance;         // by node (bvh_order.h)
    uint32_t *first_plans; // of each part
    float node_price;
} planner;

// What a subtree offers its parent: C(n, i), i from 1 to width.
typedef struct collapse_offer {
    const float *cost;
    uint32_t width;
} collapse_offer;

static collapse_offer offer_of(const planner *p, uint32_t node)
{
    // A leaf costs nothing here.
    static const float leaf[2] = { 0.0f, 0.0f };
    collapse_offer o = { leaf, 1 };
    if (tl_bvh_leaf_count(&p->tree->nodes[node]) == 0) {
        const tl_collapse_plan *plan = &p->plans[p->tree->nodes[node].kind];
        o.cost = plan->cost;
        o.width = plan->width;
    }
    return o;
}

// The cheapest way to take up to `count` children from both subtrees, which have that many leaves.
static float share_out(collapse_offer left, collapse_offer right, uint32_t count, uint8_t *left_out, uint8_t *right_out)
{
    float best = FLT_MAX;
    uint32_t end = tl_min_u32(left.width, count - 1);
    for (uint32_t i = count > right.width ? count - right.width : 1; i <= end; i++) {
        float cost = left.cost[i] + right.cost[count - i];
        if (cost < best) {
            best = cost;
            *left_out = (uint8_t)i;
            *right_out = (uint8_t)(count - i);
        }
    }
    return best;
}

// Plans a node whose children are planned; an inner node takes the plan `next`.
static void plan_node(const planner *p, uint32_t index, uint32_t next)
{
    tl_bvh_node *node = &p->tree->nodes[index];
    tl_bvh_order_node(p->tree, index, p->chance);
    if (tl_bvh_leaf_count(node) > 0) {
        return;
    }
    node->kind = next;
    tl_collapse_plan *plan = &p->plans[next];
    collapse_offer left = offer_of(p, index + 1), right = offer_of(p, node->link);
    uint32_t leaves = left.width + right.width;
    plan->width = tl_min_u32(leaves, TL_SOUP_WIDTH - 1);
    float below = share_out(left, right, tl_min_u32(leaves, TL_SOUP_WIDTH), &plan->left[0], &plan->right[0]);
    plan->cost[0] = below;
    plan->cost[1] = tl_aabb_half_area(node->box) + p->node_price + below;
    plan->left[1] = 0;
    plan->right[1] = 0;
    for (uint32_t i = 2; i <= plan->width; i++) {
        plan->cost[i] = share_out(left, right, i, &plan->left[i], &plan->right[i]);
        if (plan->cost[i] >= plan->cost[i - 1]) {
            plan->cost[i] = plan->cost[i - 1];
            plan->left[i] = plan->left[i - 1];
            plan->right[i] = plan->right[i - 1];
        }
    }
}

static void plan_part(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const planner *p = user;
    const tl_bvh_part *part = &p->tree->parts[index];
    uint32_t next = p->first_plans[index];
    for (uint32_t i = part->first + part->count; i-- > part->first;) {
        plan_node(p, i, next);
        next += tl_bvh_leaf_count(&p->tree->nodes[i]) == 0;
    }
}

// The nodes that are in no part.
static tl_result plan_between(const planner *p, tl_stage *stage, uint32_t next)
{
    const tl_bvh *tree = p->tree;
    uint32_t part = tree->part_count;
    for (uint32_t i = tree->node_count; i > 0;) {
        const tl_bvh_part *before = part > 0 ? &tree->parts[part - 1] : NULL;
        if (before != NULL && before->first + before->count == i) {
            i = before->first;
            part--;
            continue;
        }
        plan_node(p, --i, next);
        next += tl_bvh_leaf_count(&tree->nodes[i]) == 0;
        TL_TRY(tl_stage_tick(stage, i));
    }
    return TL_OK;
}

tl_result tl_bvh_plan_collapse(tl_bvh *tree, tl_stage *stage, tl_arena *arena, tl_bvh_collapse *cut_out)
{
    planner p = { .tree = tree };
    // One leaf more than inner nodes.
    const uint32_t inner_count = tree->node_count / 2, leaf_count = tree->node_count - inner_count;
    p.plans = TL_PUSH(arena, tl_collapse_plan, inner_count);
    p.chance = TL_PUSH(arena, float, tree->node_count);
    p.first_plans = TL_PUSH(arena, uint32_t, tree->part_count);
    if (p.plans == NULL || p.chance == NULL || p.first_plans == NULL) {
        return TL_ERR_MEMORY;
    }
    p.node_price = (float)(tree->leaf_surface / leaf_count) * NODE_PRICE;
    uint32_t plan_count = 0;
    for (uint32_t i = 0; i < tree->part_count; i++) {
        p.first_plans[i] = plan_count;
        plan_count += tree->parts[i].count / 2;
    }
    TL_TRY(tl_stage_run(stage, plan_part, tree->part_count, &p, 4, 0));
    TL_TRY(plan_between(&p, stage, plan_count));
    cut_out->tree = tree;
    cut_out->plans = p.plans;
    cut_out->chance = p.chance;
    return TL_OK;
}

// Appends up to `limit` children from a subtree.
static void collect_children(const tl_bvh_collapse *cut, uint32_t index, uint32_t limit, uint32_t *children,
                             uint32_t *count)
{
    const tl_bvh_node *node = &cut->tree->nodes[index];
    if (tl_bvh_leaf_count(node) == 0) {
        const tl_collapse_plan *plan = &cut->plans[node->kind];
        limit = tl_min_u32(limit, plan->width);
        if (plan->left[limit] > 0) {
            collect_children(cut, index + 1, plan->left[limit], children, count);
            collect_children(cut, node->link, plan->right[limit], children, count);
            return;
        }
    }
    children[(*count)++] = index;
}

uint32_t tl_bvh_collapsed_children(const tl_bvh_collapse *cut, uint32_t root, uint32_t children[TL_SOUP_WIDTH])
{
    const tl_bvh_node *node = &cut->tree->nodes[root];
    uint32_t count = 0;
    if (tl_bvh_leaf_count(node) > 0) {
        children[count++] = root;
        return count;
    }
    const tl_collapse_plan *plan = &cut->plans[node->kind];
    collect_children(cut, root + 1, plan->left[0], children, &count);
    collect_children(cut, node->link, plan->right[0], children, &count);
    tl_bvh_order_children(cut->chance, children, count);
    return count;
}
