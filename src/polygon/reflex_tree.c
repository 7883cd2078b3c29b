// SPDX-License-Identifier: MIT
//
// A k-d tree split at medians, with the number of living points in each node.
//
// Only reflex vertices can block a corner that is to be cut off, and vertices only ever turn from reflex to convex, so
// points are removed and never added. A node is skipped when it is empty or lies outside one edge of the triangle. A
// uniform grid was rejected: the long thin triangles of combs and spirals cross too many of its cells.

#include "polygon/reflex_tree.h"

#include "base/assert.h"

// Small outlines, nearly all there are, become one leaf: a plain loop.
enum { LEAF_POINTS = 12, MAX_DEPTH = 64 };

static int64_t coordinate(const tl_reflex_tree *tree, uint32_t point, bool along_x)
{
    return along_x ? tree->positions[point].x : tree->positions[point].z;
}

// A total order, so that equal coordinates split evenly too.
static bool before(const tl_reflex_tree *tree, uint32_t a, uint32_t b, bool along_x)
{
    int64_t ka = coordinate(tree, a, along_x);
    int64_t kb = coordinate(tree, b, along_x);
    return ka != kb ? ka < kb : a < b;
}

static void swap(uint32_t *a, uint32_t *b)
{
    uint32_t t = *a;
    *a = *b;
    *b = t;
}

// Quickselect (Hoare's FIND): afterwards points[middle] is in its sorted place, smaller ones before it.
static void select_middle(const tl_reflex_tree *tree, uint32_t *points, uint32_t count, uint32_t middle, bool along_x)
{
    uint32_t low = 0;
    uint32_t high = count - 1;
    while (low < high) {
        uint32_t pivot = points[low + (high - low) / 2];
        uint32_t i = low;
        uint32_t j = high;
        for (;;) {
            while (before(tree, points[i], pivot, along_x)) {
                i++;
            }
            while (before(tree, pivot, points[j], along_x)) {
                j--;
            }
            if (i >= j) {
                break;
            }
            swap(&points[i++], &points[j--]);
        }
        // Everything up to j is at most the pivot, everything after it at least. The pivot is not the last of more than
        // one, so j < high and both parts are smaller.
        if (middle <= j) {
            high = j;
        } else {
            low = j + 1;
        }
    }
}

static void fill_box(tl_reflex_tree *tree, tl_reflex_node *node)
{
    tl_lattice_point p = tree->positions[tree->points[node->first]];
    node->min_x = node->max_x = p.x;
    node->min_z = node->max_z = p.z;
    for (uint32_t i = 1; i < node->alive; i++) {
        p = tree->positions[tree->points[node->first + i]];
        node->min_x = p.x < node->min_x ? p.x : node->min_x;
        node->max_x = p.x > node->max_x ? p.x : node->max_x;
        node->min_z = p.z < node->min_z ? p.z : node->min_z;
        node->max_z = p.z > node->max_z ? p.z : node->max_z;
    }
}

// Depth is at most log2(n / LEAF_POINTS) + 1: each level halves the count.
static uint32_t build_node(tl_reflex_tree *tree, uint32_t parent, uint32_t first, uint32_t count)
{
    uint32_t index = tree->node_count++;
    tl_reflex_node *node = &tree->nodes[index];
    node->first = first;
    node->alive = count;
    node->parent = parent;
    node->right = 0;
    fill_box(tree, node);
    if (count <= LEAF_POINTS) {
        for (uint32_t i = 0; i < count; i++) {
            tree->leaf[tree->points[first + i]] = index;
        }
        return index;
    }
    bool along_x = (int64_t)node->max_x - node->min_x >= (int64_t)node->max_z - node->min_z;
    uint32_t half = count / 2;
    select_middle(tree, tree->points + first, count, half, along_x);
    build_node(tree, index, first, half);
    uint32_t right = build_node(tree, index, first + half, count - half);
    tree->nodes[index].right = right;
    return index;
}

bool tl_reflex_tree_build(tl_reflex_tree *tree, tl_arena *arena, const tl_lattice_point *positions,
                          const uint8_t *is_reflex, uint32_t count)
{
    uint32_t reflex_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        reflex_count += is_reflex[i];
    }
    tree->positions = positions;
    tree->node_count = 0;
    // A leaf made by a split holds at least half of LEAF_POINTS + 1 points, rounded down; inner nodes are one less.
    uint64_t leaves = 1 + reflex_count / ((LEAF_POINTS + 1) / 2);
    tree->nodes = TL_PUSH(arena, tl_reflex_node, 2 * leaves);
    tree->points = TL_PUSH(arena, uint32_t, reflex_count);
    tree->leaf = TL_PUSH(arena, uint32_t, count);
    if (tree->nodes == NULL || tree->points == NULL || tree->leaf == NULL) {
        return false;
    }
    uint32_t filled = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_reflex[i]) {
            tree->points[filled++] = i;
        }
    }
    if (reflex_count > 0) {
        build_node(tree, UINT32_MAX, 0, reflex_count);
    }
    return true;
}

void tl_reflex_tree_remove(tl_reflex_tree *tree, uint32_t point)
{
    uint32_t index = tree->leaf[point];
    const tl_reflex_node *leaf = &tree->nodes[index];
    uint32_t *points = tree->points + leaf->first;
    uint32_t place = 0;
    while (points[place] != point) {
        place++;
        TL_ASSERT(place < leaf->alive);
    }
    points[place] = points[leaf->alive - 1];
    for (; index != UINT32_MAX; index = tree->nodes[index].parent) {
        tree->nodes[index].alive--;
    }
}

// Whether all of a box lies strictly right of the line from a to b. The turn is linear in the point, so one corner
// of the box, the one that lies farthest to the left, decides.
static bool is_outside(const tl_reflex_node *node, tl_lattice_point a, tl_lattice_point b)
{
    tl_lattice_point corner = { b.z > a.z ? node->max_x : node->min_x, b.x > a.x ? node->min_z : node->max_z };
    return tl_turn(a, b, corner) < 0;
}

static bool any_in_leaf(const tl_reflex_tree *tree, const tl_reflex_node *leaf, tl_lattice_point a, tl_lattice_point b,
                        tl_lattice_point c)
{
    const uint32_t *points = tree->points + leaf->first;
    for (uint32_t i = 0; i < leaf->alive; i++) {
        tl_lattice_point p = tree->positions[points[i]];
        if (tl_turn(c, a, p) >= 0 && tl_turn(a, b, p) >= 0 && tl_turn(b, c, p) >= 0 && !tl_same_point(p, a) &&
            !tl_same_point(p, b) && !tl_same_point(p, c)) {
            return true;
        }
    }
    return false;
}

bool tl_reflex_tree_any_in_triangle(const tl_reflex_tree *tree, tl_lattice_point a, tl_lattice_point b,
                                    tl_lattice_point c)
{
    uint32_t stack[MAX_DEPTH];
    uint32_t depth = 0;
    if (tree->node_count > 0) {
        stack[depth++] = 0;
    }
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const tl_reflex_node *node = &tree->nodes[index];
        if (node->alive == 0) {
            continue;
        }
        if (node->right == 0) {
            if (any_in_leaf(tree, node, a, b, c)) {
                return true;
            }
            continue;
        }
        if (is_outside(node, a, b) || is_outside(node, b, c) || is_outside(node, c, a)) {
            continue;
        }
        // Each level leaves at most one node behind on the stack.
        TL_ASSERT(depth + 2 <= MAX_DEPTH);
        stack[depth++] = node->right;
        stack[depth++] = index + 1;
    }
    return false;
}
