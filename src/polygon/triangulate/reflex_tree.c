// SPDX-License-Identifier: MIT
//
// A k-d tree split at medians, in which nodes without living points are skipped.
//
// Only reflex vertices can block a corner that is to be cut off, and vertices only ever turn from reflex to convex, so
// points are removed and never added. A node is skipped when it is empty or lies outside one edge of the triangle. The
// node nearer to the corner that would be cut off is searched first: where the outline turns, a large triangle is
// mostly blocked by a point near there, and is full of nodes. A uniform grid was rejected: the long thin triangles of
// combs and spirals cross too many of its cells. Those of random stars cross too many nodes as well, so large outlines
// keep a triangulation instead (ear_mesh.c).

#include "polygon/triangulate/reflex_tree.h"

#include "base/assert.h"
#include "base/min_max.h"

// Small outlines, nearly all there are, become one leaf: a plain loop.
enum { LEAF_POINTS = 12, MAX_DEPTH = 64 };

static int32_t reflex_coordinate(const tl_reflex_point *point, bool along_x)
{
    return along_x ? point->position.x : point->position.z;
}

// A total order, so that equal coordinates split evenly too.
static bool before(const tl_reflex_point *a, const tl_reflex_point *b, bool along_x)
{
    int32_t ka = reflex_coordinate(a, along_x);
    int32_t kb = reflex_coordinate(b, along_x);
    return ka != kb ? ka < kb : a->number < b->number;
}

// Quickselect (Hoare's FIND): afterwards points[middle] is in its sorted place, smaller ones before it.
static void select_middle(tl_reflex_point *points, uint32_t count, uint32_t middle, bool along_x)
{
    uint32_t low = 0;
    uint32_t high = count - 1;
    while (low < high) {
        tl_reflex_point pivot = points[low + (high - low) / 2];
        uint32_t i = low;
        uint32_t j = high;
        for (;;) {
            while (before(&points[i], &pivot, along_x)) {
                i++;
            }
            while (before(&pivot, &points[j], along_x)) {
                j--;
            }
            if (i >= j) {
                break;
            }
            tl_reflex_point t = points[i];
            points[i++] = points[j];
            points[j--] = t;
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

static void fill_box(const tl_reflex_tree *tree, tl_reflex_node *node, uint32_t count)
{
    tl_lattice_point p = tree->points[node->first].position;
    node->min_x = node->max_x = p.x;
    node->min_z = node->max_z = p.z;
    for (uint32_t i = 1; i < count; i++) {
        p = tree->points[node->first + i].position;
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
    node->alive = count <= LEAF_POINTS ? count : 2;
    node->parent = parent;
    node->right = 0;
    fill_box(tree, node, count);
    if (count <= LEAF_POINTS) {
        for (uint32_t i = 0; i < count; i++) {
            tree->leaf[tree->points[first + i].number] = index;
        }
        return index;
    }
    bool along_x = (int64_t)node->max_x - node->min_x >= (int64_t)node->max_z - node->min_z;
    uint32_t half = count / 2;
    select_middle(tree->points + first, count, half, along_x);
    build_node(tree, index, first, half);
    uint32_t right = build_node(tree, index, first + half, count - half);
    tree->nodes[index].right = right;
    return index;
}

bool tl_reflex_tree_init(tl_reflex_tree *tree, tl_arena *arena, const tl_lattice_point *positions,
                         const uint8_t *is_reflex, uint32_t count)
{
    uint32_t reflex_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        reflex_count += is_reflex[i];
    }
    tree->node_count = 0;
    // A leaf made by a split holds at least half of LEAF_POINTS + 1 points, rounded down; inner nodes are one less.
    uint64_t leaves = 1 + reflex_count / ((LEAF_POINTS + 1) / 2);
    tree->nodes = TL_PUSH(arena, tl_reflex_node, 2 * leaves);
    tree->points = TL_PUSH(arena, tl_reflex_point, reflex_count);
    tree->leaf = TL_PUSH(arena, uint32_t, count);
    if (tree->nodes == NULL || tree->points == NULL || tree->leaf == NULL) {
        return false;
    }
    uint32_t filled = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_reflex[i]) {
            tl_reflex_point point = { positions[i], i };
            tree->points[filled++] = point;
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
    tl_reflex_point *points = tree->points + leaf->first;
    uint32_t place = 0;
    while (points[place].number != point) {
        place++;
        TL_ASSERT(place < leaf->alive);
    }
    points[place] = points[leaf->alive - 1];
    // A node that still lives keeps its parent alive.
    while (--tree->nodes[index].alive == 0 && tree->nodes[index].parent != UINT32_MAX) {
        index = tree->nodes[index].parent;
    }
}

// Whether all of a box lies strictly right of the line from a to b. The turn is linear in the point, so one corner
// of the box, the one that lies farthest to the left, decides.
static bool is_outside(const tl_reflex_node *node, tl_lattice_point a, tl_lattice_point b)
{
    tl_lattice_point corner = { b.z > a.z ? node->max_x : node->min_x, b.x > a.x ? node->min_z : node->max_z };
    return tl_turn(a, b, corner) < 0;
}

// The triangle with its box.
typedef struct query {
    tl_lattice_point a, b, c;
    int32_t min_x, max_x, min_z, max_z;
} query;

static bool any_in_leaf(const tl_reflex_tree *tree, const tl_reflex_node *leaf, const query *q)
{
    const tl_reflex_point *points = tree->points + leaf->first;
    for (uint32_t i = 0; i < leaf->alive; i++) {
        tl_lattice_point p = points[i].position;
        if (p.x < q->min_x || p.x > q->max_x || p.z < q->min_z || p.z > q->max_z) {
            continue;
        }
        if (tl_turn(q->c, q->a, p) >= 0 && tl_turn(q->a, q->b, p) >= 0 && tl_turn(q->b, q->c, p) >= 0 &&
            !tl_same_point(p, q->a) && !tl_same_point(p, q->b) && !tl_same_point(p, q->c)) {
            return true;
        }
    }
    return false;
}

static bool may_hold_a_point(const tl_reflex_node *node, const query *q)
{
    if (node->alive == 0 || node->min_x > q->max_x || node->max_x < q->min_x || node->min_z > q->max_z ||
        node->max_z < q->min_z) {
        return false;
    }
    // Around the whole triangle nothing can be said; so it is on most of the way down.
    if (node->min_x <= q->min_x && node->max_x >= q->max_x && node->min_z <= q->min_z && node->max_z >= q->max_z) {
        return true;
    }
    return !is_outside(node, q->c, q->a) && !is_outside(node, q->a, q->b) && !is_outside(node, q->b, q->c);
}

static int64_t distance2_to_box(const tl_reflex_node *node, tl_lattice_point p)
{
    int64_t dx = p.x < node->min_x ? (int64_t)node->min_x - p.x : p.x > node->max_x ? (int64_t)p.x - node->max_x : 0;
    int64_t dz = p.z < node->min_z ? (int64_t)node->min_z - p.z : p.z > node->max_z ? (int64_t)p.z - node->max_z : 0;
    return dx * dx + dz * dz;
}

bool tl_reflex_tree_any_in_triangle(const tl_reflex_tree *tree, tl_lattice_point a, tl_lattice_point b,
                                    tl_lattice_point c)
{
    query q = { a,
                b,
                c,
                tl_min_i32(tl_min_i32(a.x, b.x), c.x),
                tl_max_i32(tl_max_i32(a.x, b.x), c.x),
                tl_min_i32(tl_min_i32(a.z, b.z), c.z),
                tl_max_i32(tl_max_i32(a.z, b.z), c.z) };
    uint32_t stack[MAX_DEPTH];
    uint32_t depth = 0;
    if (tree->node_count > 0) {
        stack[depth++] = 0;
    }
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const tl_reflex_node *node = &tree->nodes[index];
        if (node->right == 0) {
            if (any_in_leaf(tree, node, &q)) {
                return true;
            }
            continue;
        }
        // Each level leaves at most one node behind on the stack.
        TL_ASSERT(depth + 2 <= MAX_DEPTH);
        const uint32_t child[2] = { index + 1, node->right };
        const bool open[2] = { may_hold_a_point(&tree->nodes[child[0]], &q),
                               may_hold_a_point(&tree->nodes[child[1]], &q) };
        const int nearer = open[0] && open[1] &&
                           distance2_to_box(&tree->nodes[child[1]], b) < distance2_to_box(&tree->nodes[child[0]], b);
        if (open[!nearer]) {
            stack[depth++] = child[!nearer];
        }
        if (open[nearer]) {
            stack[depth++] = child[nearer];
        }
    }
    return false;
}
