// SPDX-License-Identifier: MIT
//
// The soup's plain bytes (compact_layout.h has the others): a head, the 16-wide BVH, leaves of one to four pairs,
// materials.
//
//   tl_soup | tl_soup_node[node_count] | leaves, each 16-byte aligned | 64 zero bytes | uint32 coincident[] |
//   uint16 materials[] | zeros
//
// A node holds 16 child boxes as plain floats: 448 bytes, seven cache lines. 16 children, because a ray's time goes
// into visits (a mispredicted branch, a cache miss), not into box arithmetic. Floats, because a ray waits for each
// visit to learn where to go: 16-bit planes halve a node, but widening and converting them costs a third of a visit,
// and rays a tenth of their time. How much memory nodes take then depends on how well they are filled (bvh_collapse.c).
//
// Leaves hold their corners themselves, one array a coordinate, without padding lanes: a ray reads one run of memory. A
// leaf of n pairs, in 4-byte words, follows its head (see tl_leaf_view):
//
//   uint32 ids[2n]; float x: a[n] c[n] b[n] d[n], y: a[n] c[n] b[n] d[n], z: a[n] c[n] b[n] d[n]
//
// Behind c lies e[2n]: b for the first n lanes and d for the last n. With a, e, c one formula serves both triangles of
// a pair.
//
// Coincident triangles, which have the same three corners in any order (both sides of a wall, a part that was exported
// twice), take one lane together. An index that is not below source_triangle_count leads to them: the rest is the place
// of the lowest one's id word in coincident[]; the words of the others follow, by index. So they cost no box, no corner
// and no test, and what has none costs nothing. Rejected: two of them as a pair, which a leaf tests both, half as full;
// a link from each triangle to the next, four bytes for every triangle of a level with one such wall.

#ifndef TALUS_SRC_SOUP_SOUP_LAYOUT_H
#define TALUS_SRC_SOUP_SOUP_LAYOUT_H

#include <assert.h>
#include <talus/soup.h>

enum {
    TL_SOUP_WIDTH = 16,      ///< children of a node
    TL_SOUP_LEAF_PAIRS = 4,  ///< the most pairs of a leaf
    TL_SOUP_LEAF_ALIGN = 16, ///< bytes
    TL_SOUP_TAIL_BYTES = 64, ///< readable zeros behind the last leaf, so that vector loads may run over it
    TL_SOUP_MAX_DEPTH = 96   ///< nodes on a path from root to leaf; bvh_build.c keeps it
};

typedef struct tl_soup_node {
    float plane[6][TL_SOUP_WIDTH]; ///< min x, max x, min y, max y, min z, max z; no child: min INFINITY, max -INFINITY
    uint32_t child[TL_SOUP_WIDTH]; ///< 0: none
} tl_soup_node;

static_assert(sizeof(tl_soup_node) == 448, "a node is seven cache lines");

struct tl_soup {
    tl_blob blob;
    uint32_t source_triangle_count;
    uint32_t triangle_count;
    uint32_t pair_count;
    uint32_t single_count;
    uint32_t reference_count;
    uint32_t leaf_count;
    uint32_t node_count;
    uint32_t depth;
    tl_vec3 bounds_min; ///< these two are read as vectors of four floats, hence the padding
    float padding_a;
    tl_vec3 bounds_max;
    float padding_b;
    uint32_t uniform_material; ///< of all triangles, where there is no table
    uint32_t has_materials;
    uint64_t node_offset;
    uint64_t leaf_offset;
    uint64_t leaf_bytes;
    uint64_t material_offset;
    uint32_t layout;            ///< tl_soup_layout
    uint32_t vertex_count;      ///< compact_layout.h; these three are 0 in the plain layout
    uint64_t group_offset;      ///< uint32_t, one each TL_COMPACT_GROUP pairs
    uint64_t vertex_offset;     ///< tl_vec3
    uint64_t coincident_offset; ///< uint32_t; these two are 0 where no triangles coincide
    uint32_t coincident_words;
    uint32_t reserved[9]; ///< zero
};

static_assert(sizeof(tl_soup) == 192, "no padding holes in the head");

// A child word. Nodes are numbered breadth first, and leaves lie in the order in which nodes name them, so a check
// needs one counter for each, and no marks.
#define TL_CHILD_LEAF 0x80000000u
/// Leaves: bit 31, 29 bits of offset in units of 16 bytes, 2 bits of pair count - 1. 2^29 units are 8 GiB.
#define TL_MAX_LEAF_UNITS 0x1fffffffu

static inline uint32_t tl_child_of_leaf(uint64_t offset, uint32_t pair_count)
{
    return TL_CHILD_LEAF | ((uint32_t)(offset / TL_SOUP_LEAF_ALIGN) << 2) | (pair_count - 1);
}

static inline uint64_t tl_child_leaf_offset(uint32_t child)
{
    return (uint64_t)(child & ~(TL_CHILD_LEAF | 3u)) * (TL_SOUP_LEAF_ALIGN / 4);
}

static inline uint32_t tl_child_pair_count(uint32_t child)
{
    return (child & 3u) + 1;
}

/// The head of a leaf.
typedef struct tl_soup_leaf {
    float extent;          ///< metres: largest extent along an axis of a triangle in this leaf
    uint32_t tagged_count; ///< TL_LEAF_TAG | pairs, 1 .. TL_SOUP_LEAF_PAIRS
} tl_soup_leaf;

/// Vector loads of a short leaf's last array run into the next leaf's head, and arithmetic on denormals is slow: so no
/// word of a head may look like one. The tag, and the corner order (1 or more), set bits of the exponent.
#define TL_LEAF_TAG 0x746c6600u

static inline uint32_t tl_leaf_pair_count(const tl_soup_leaf *leaf)
{
    return leaf->tagged_count & 7u;
}

static inline uint64_t tl_leaf_size(uint32_t pair_count)
{
    uint64_t bytes = sizeof(tl_soup_leaf) + (uint64_t)pair_count * (2 * sizeof(uint32_t) + 12 * sizeof(float));
    return (bytes + TL_SOUP_LEAF_ALIGN - 1) & ~(uint64_t)(TL_SOUP_LEAF_ALIGN - 1);
}

/// Where a leaf's arrays are. The corners: axis k of a begins at floats + k n, of c at floats + (3 + k) n, of e at
/// floats + (6 + 2 k) n.
typedef struct tl_leaf_view {
    uint32_t pair_count;
    const uint32_t *ids; ///< lane i < n: triangle a, e[i], c of pair i; lane n + i: its second triangle
    const float *floats; ///< 12 n
} tl_leaf_view;

static inline tl_leaf_view tl_view_leaf(const tl_soup_leaf *leaf)
{
    tl_leaf_view view;
    view.pair_count = tl_leaf_pair_count(leaf);
    view.ids = (const uint32_t *)(const void *)(leaf + 1);
    view.floats = (const float *)(const void *)(view.ids + 2 * (size_t)view.pair_count);
    return view;
}

// An id word: 28 bits of the triangle's index in the view, one bit for a copy that spatial splits made, three bits for
// the order in which the view has the corners, 1 to 6. TL_ID_NONE in the second lane (the article's bit) marks a single
// triangle.
#define TL_ID_NONE  UINT32_MAX
#define TL_ID_COPY  0x10000000u
#define TL_ID_INDEX 0x0fffffffu

// An id word of coincident[] has this bit where the last of the triangles that coincide stands. More of them than a
// lane takes are in several lanes: spatial splits may copy a lane into many leaves, and that must not multiply a list
// as long as the level.
#define TL_ID_LAST TL_ID_COPY
enum { TL_MAX_COINCIDENT = 8 };

/// Slots 0: a, 1: e, 2: c. Row p, corner k: the slot that holds the view's corner k.
extern const uint8_t tl_soup_corner_slots[8][3];

static inline uint32_t tl_id_order(uint32_t id)
{
    return id >> 29;
}

/// Whether the view's corners run around the triangle the other way than a, e, c.
static inline bool tl_id_is_reversed(uint32_t id)
{
    return tl_id_order(id) >= 4; // the odd permutations are the last three
}

static inline const tl_soup_node *tl_soup_nodes(const tl_soup *soup)
{
    return (const tl_soup_node *)(const void *)((const char *)soup + soup->node_offset);
}

static inline const tl_soup_leaf *tl_soup_leaf_at(const tl_soup *soup, uint64_t offset)
{
    return (const tl_soup_leaf *)(const void *)((const char *)soup + soup->leaf_offset + offset);
}

/// The id words of the triangles that coincide in the lane of an id word; NULL: it names the only one.
static inline const uint32_t *tl_soup_coincident(const tl_soup *soup, uint32_t id)
{
    const uint32_t index = id & TL_ID_INDEX;
    if (index < soup->source_triangle_count) {
        return NULL;
    }
    return (const uint32_t *)(const void *)((const char *)soup + soup->coincident_offset) +
           (index - soup->source_triangle_count);
}

/// The lowest triangle of a lane.
static inline uint32_t tl_soup_lowest_triangle(const tl_soup *soup, uint32_t id)
{
    const uint32_t *coincident = tl_soup_coincident(soup, id);
    return (coincident != NULL ? *coincident : id) & TL_ID_INDEX;
}

static inline uint16_t tl_soup_material(const tl_soup *soup, uint32_t triangle)
{
    if (!soup->has_materials) {
        return (uint16_t)soup->uniform_material;
    }
    return ((const uint16_t *)(const void *)((const char *)soup + soup->material_offset))[triangle];
}

/// Where the corners a, e, c of a lane are. Axis k of each is at [k * tl_leaf_stride]. Without branches: lane and
/// corner are unpredictable.
static inline void tl_leaf_slots(const tl_leaf_view *leaf, uint32_t lane, const float *slots_out[3])
{
    uint32_t n = leaf->pair_count;
    uint32_t pair = lane - (n & (0u - (uint32_t)(lane >= n)));
    slots_out[0] = leaf->floats + pair;
    slots_out[1] = leaf->floats + 2 * n + lane;
    slots_out[2] = leaf->floats + n + pair;
}

static inline uint32_t tl_leaf_stride(const tl_leaf_view *leaf)
{
    return 4 * leaf->pair_count;
}

/// Where the corners of a lane's triangle are, in the view's order, which its id word has.
static inline void tl_leaf_find_corners(const tl_leaf_view *leaf, uint32_t lane, uint32_t id,
                                        const float *corners_out[3])
{
    uint32_t n = leaf->pair_count;
    uint32_t pair = lane - (n & (0u - (uint32_t)(lane >= n)));
    // Where slots a, e and c begin, a byte each, so that the order needs no table in memory.
    uint32_t slots = pair | (2 * n + lane) << 8 | (n + pair) << 16;
    const uint8_t *order = tl_soup_corner_slots[tl_id_order(id)];
    for (int k = 0; k < 3; k++) {
        corners_out[k] = leaf->floats + (slots >> 8 * order[k] & 0xffu);
    }
}

static inline tl_vec3 tl_leaf_point(const tl_leaf_view *leaf, const float *corner)
{
    uint32_t stride = tl_leaf_stride(leaf);
    return tl_vec3_make(corner[0], corner[stride], corner[2 * (size_t)stride]);
}

/// Corner a (slot 0), e (1) or c (2) of a lane.
static inline tl_vec3 tl_leaf_slot(const tl_leaf_view *leaf, uint32_t lane, uint32_t slot)
{
    const float *slots[3];
    tl_leaf_slots(leaf, lane, slots);
    return tl_leaf_point(leaf, slots[slot]);
}

/// The triangle of a lane, its corners as the view has them.
static inline void tl_leaf_corners(const tl_leaf_view *leaf, uint32_t lane, uint32_t id, tl_vec3 corners[3])
{
    const float *at[3];
    tl_leaf_find_corners(leaf, lane, id, at);
    for (int k = 0; k < 3; k++) {
        corners[k] = tl_leaf_point(leaf, at[k]);
    }
}

#endif
