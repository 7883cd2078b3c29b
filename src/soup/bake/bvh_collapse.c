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

#include "base/host.h"
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

// Tasks plan the parts of a tree; the nodes above them follow, since a node's plan needs its children's.
typedef struct planner {
    const tl_bvh *tree;
    tl_collapse_plan *plans;
    float *chance; // by node (bvh_order.h)
    uint32_t plan_count;
    uint32_t next_part, part_count; // parts that the walk over the nodes above has not reached yet
    float node_price;
    uint32_t *first_plans; // of each part
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
    if (p->tree->nodes[node].count == 0) {
        const tl_collapse_plan *plan = &p->plans[p->tree->nodes[node].first];
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

static bool is_next_part(planner *p, uint32_t index)
{
    bool is_part = p->next_part < p->part_count && p->tree->parts[p->next_part].root == index;
    p->next_part += is_part;
    return is_part;
}

static void plan_node(planner *p, uint32_t index)
{
    tl_bvh_node *node = &p->tree->nodes[index];
    if (is_next_part(p, index)) {
        return;
    }
    if (node->count > 0) {
        tl_bvh_order_node(p->tree, index, p->chance);
        return;
    }
    plan_node(p, node->left);
    plan_node(p, node->right);
    tl_bvh_order_node(p->tree, index, p->chance);
    node->first = p->plan_count;
    tl_collapse_plan *plan = &p->plans[p->plan_count++];
    collapse_offer left = offer_of(p, node->left), right = offer_of(p, node->right);
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

static void add_part(tl_bvh_part *sum, const tl_bvh_part *part)
{
    sum->inner_count += part->inner_count;
    sum->leaf_count += part->leaf_count;
    sum->ref_count += part->ref_count;
    sum->leaf_surface += part->leaf_surface;
}

static void add_leaf(tl_bvh_part *sum, const tl_bvh_node *leaf)
{
    sum->leaf_count++;
    sum->ref_count += leaf->count;
    sum->leaf_surface += (double)tl_aabb_half_area(leaf->box);
}

static void sum_nodes(const tl_bvh_node *nodes, uint32_t index, tl_bvh_part *sum)
{
    const tl_bvh_node *node = &nodes[index];
    if (node->count > 0) {
        add_leaf(sum, node);
        return;
    }
    sum->inner_count++;
    sum_nodes(nodes, node->left, sum);
    sum_nodes(nodes, node->right, sum);
}

tl_bvh_part tl_bvh_sum_part(const tl_bvh_node *nodes, uint32_t root)
{
    tl_bvh_part sum = { root, 0, 0, 0, 0.0 };
    sum_nodes(nodes, root, &sum);
    return sum;
}

// The sum of the whole tree from the sums of its parts, whose plans lie one behind the other.
static void sum_tree(planner *p, uint32_t index, tl_bvh_part *sum)
{
    const tl_bvh_node *node = &p->tree->nodes[index];
    if (is_next_part(p, index)) {
        const tl_bvh_part *part = &p->tree->parts[p->next_part - 1];
        p->first_plans[p->next_part - 1] = p->plan_count;
        p->plan_count += part->inner_count;
        add_part(sum, part);
    } else if (node->count > 0) {
        add_leaf(sum, node);
    } else {
        sum->inner_count++;
        sum_tree(p, node->left, sum);
        sum_tree(p, node->right, sum);
    }
}

static void plan_part(uint32_t part, uint32_t worker, void *user)
{
    (void)worker;
    const planner *whole = user;
    planner p = { .tree = whole->tree, .plans = whole->plans, .chance = whole->chance };
    p.node_price = whole->node_price;
    p.plan_count = whole->first_plans[part];
    plan_node(&p, whole->tree->parts[part].root);
}

tl_result tl_bvh_plan_collapse(const tl_bvh *tree, const tl_host *host, tl_arena *arena, tl_bvh_collapse *cut_out)
{
    planner p = { .tree = tree, .part_count = tree->part_count };
    p.first_plans = TL_PUSH(arena, uint32_t, tree->part_count);
    if (p.first_plans == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_bvh_part sum = { tree->root, 0, 0, 0, 0.0 };
    sum_tree(&p, tree->root, &sum);
    p.plans = TL_PUSH(arena, tl_collapse_plan, sum.inner_count);
    p.chance = TL_PUSH(arena, float, tree->node_capacity);
    if (p.plans == NULL || p.chance == NULL) {
        return TL_ERR_MEMORY;
    }
    p.node_price = (float)(sum.leaf_surface / sum.leaf_count) * NODE_PRICE;
    tl_run_tasks(host, plan_part, tree->part_count, &p);
    p.next_part = 0;
    plan_node(&p, tree->root);
    cut_out->tree = tree;
    cut_out->plans = p.plans;
    cut_out->inner_count = sum.inner_count;
    cut_out->chance = p.chance;
    return TL_OK;
}

// Appends up to `limit` children from a subtree.
static void collect_children(const tl_bvh_collapse *cut, uint32_t index, uint32_t limit, uint32_t *children,
                             uint32_t *count)
{
    const tl_bvh_node *node = &cut->tree->nodes[index];
    if (node->count == 0) {
        const tl_collapse_plan *plan = &cut->plans[node->first];
        limit = tl_min_u32(limit, plan->width);
        if (plan->left[limit] > 0) {
            collect_children(cut, node->left, plan->left[limit], children, count);
            collect_children(cut, node->right, plan->right[limit], children, count);
            return;
        }
    }
    children[(*count)++] = index;
}

uint32_t tl_bvh_collapsed_children(const tl_bvh_collapse *cut, uint32_t root, uint32_t children[TL_SOUP_WIDTH])
{
    const tl_bvh_node *node = &cut->tree->nodes[root];
    uint32_t count = 0;
    if (node->count > 0) {
        children[count++] = root;
        return count;
    }
    const tl_collapse_plan *plan = &cut->plans[node->first];
    collect_children(cut, node->left, plan->left[0], children, &count);
    collect_children(cut, node->right, plan->right[0], children, &count);
    tl_bvh_order_children(cut->chance, children, count);
    return count;
}
