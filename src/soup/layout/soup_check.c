// SPDX-License-Identifier: MIT
//
// Whether bytes are a sound soup. Offsets must be those that the encoder computes from the counts; nodes must be
// numbered breadth first, and leaves must lie in the order in which nodes name them. Each child word is then
// determined, so two counters prove that the nodes form a tree, that every query ends, and that nothing lies outside.

#include "soup/layout/compact_layout.h"

#include "base/assert.h"
#include "base/blob_check.h"
#include "base/compiler.h"
#include "base/host.h"

#include <float.h>
#include <string.h>

typedef struct checker {
    const tl_soup *soup;
    uint32_t node; // the node being checked
    uint32_t next_node;
    uint64_t next_leaf; // offset
    uint32_t leaf_count;
    uint32_t reference_count;
    uint32_t triangle_count;
    uint32_t pair_count;
    uint32_t single_count;
    uint32_t depth;
} checker;

static bool coordinate_in_range(float value)
{
    return fabsf(value) <= TL_MAX_COORDINATE; // false for NaN
}

static bool vec_in_range(tl_vec3 v)
{
    return coordinate_in_range(v.x) && coordinate_in_range(v.y) && coordinate_in_range(v.z);
}

static bool extent_in_range(float extent)
{
    return extent >= 0.0f && extent <= 2.0f * TL_MAX_COORDINATE;
}

static bool head_is_sound(const tl_soup *soup)
{
    uint64_t size = soup->blob.size;
    if (soup->layout > TL_SOUP_COMPACT || soup->node_count == 0 || soup->has_materials > 1 ||
        soup->uniform_material > UINT16_MAX || soup->source_triangle_count > TL_MAX_SOUP_TRIANGLES ||
        soup->leaf_bytes > size ||
        (soup->layout == TL_SOUP_COMPACT ? soup->leaf_bytes != soup->reference_count * sizeof(tl_compact_pair)
                                         : soup->vertex_count != 0)) {
        return false;
    }
    // Indices of coincident triangles are behind those of the view.
    if (soup->coincident_words > TL_ID_INDEX - soup->source_triangle_count) {
        return false;
    }
    tl_soup placed = *soup;
    uint64_t end = tl_soup_place_arrays(&placed);
    if (soup->node_offset != placed.node_offset || soup->leaf_offset != placed.leaf_offset ||
        soup->group_offset != placed.group_offset || soup->vertex_offset != placed.vertex_offset ||
        soup->coincident_offset != placed.coincident_offset || soup->material_offset != placed.material_offset ||
        ((end + TL_BLOB_ALIGNMENT - 1) & ~(uint64_t)(TL_BLOB_ALIGNMENT - 1)) != size) {
        return false;
    }
    for (uint32_t i = 0; i < sizeof soup->reserved / sizeof soup->reserved[0]; i++) {
        if (soup->reserved[i] != 0) {
            return false;
        }
    }
    return vec_in_range(soup->bounds_min) && vec_in_range(soup->bounds_max) && !tl_aabb_is_empty(tl_soup_bounds(soup));
}

static bool id_is_sound(const tl_soup *soup, uint32_t id)
{
    uint32_t order = tl_id_order(id);
    return (id & TL_ID_INDEX) < soup->source_triangle_count && order >= 1 && order <= 6;
}

// Lists of TL_MAX_COINCIDENT words at most, so that no lane takes longer, and the last of them has an end.
static bool coincident_are_sound(const tl_soup *soup)
{
    const uint32_t *words = tl_soup_coincident(soup, soup->source_triangle_count);
    uint32_t length = 0;
    for (uint32_t i = 0; i < soup->coincident_words; i++) {
        if (!id_is_sound(soup, words[i]) || length == TL_MAX_COINCIDENT) {
            return false;
        }
        length = (words[i] & TL_ID_LAST) != 0 ? 0 : length + 1;
    }
    return length == 0;
}

// The triangles of a lane; 0: its id word is not sound.
static TL_NOINLINE uint32_t count_of_lane(const tl_soup *soup, uint32_t id)
{
    const uint32_t index = id & TL_ID_INDEX;
    if (index < soup->source_triangle_count) {
        return id_is_sound(soup, id) ? 1 : 0;
    }
    if (index - soup->source_triangle_count >= soup->coincident_words) {
        return 0;
    }
    uint32_t count = 1;
    for (const uint32_t *word = tl_soup_coincident(soup, id); (*word & TL_ID_LAST) == 0; word++) {
        count++;
    }
    return count;
}

static bool vertices_are_there(const tl_soup *soup, uint64_t first, uint32_t count)
{
    for (uint64_t i = first; i < first + count; i++) {
        const tl_compact_pair *pair = &tl_compact_pairs(soup)[i];
        uint32_t base = tl_compact_groups(soup)[i / TL_COMPACT_GROUP];
        for (uint32_t k = 0; k < 4; k++) {
            if ((uint64_t)base + pair->corner[k] >= soup->vertex_count) {
                return false;
            }
        }
    }
    return true;
}

static bool leaf_is_sound(checker *c, uint32_t child)
{
    uint32_t pairs = tl_child_pair_count(child);
    uint64_t offset = tl_child_leaf_offset(child);
    bool compact = c->soup->layout == TL_SOUP_COMPACT;
    uint64_t size = compact ? pairs * sizeof(tl_compact_pair) : tl_leaf_size(pairs);
    // leaf_bytes is within the blob; next_leaf never passes it.
    if (offset != c->next_leaf || size > c->soup->leaf_bytes - offset) {
        return false;
    }
    c->next_leaf += size;
    c->leaf_count++;
    c->reference_count += pairs;
    if (compact && !vertices_are_there(c->soup, offset / sizeof(tl_compact_pair), pairs)) {
        return false;
    }
    tl_leaf_buffer buffer;
    const tl_soup_leaf *leaf = tl_open_leaf(c->soup, child, &buffer);
    if (leaf->tagged_count != (TL_LEAF_TAG | pairs) || !extent_in_range(leaf->extent)) {
        return false;
    }
    tl_leaf_view view = tl_view_leaf(leaf);
    for (uint32_t i = 0; i < pairs; i++) {
        bool single = view.ids[pairs + i] == TL_ID_NONE;
        bool copy = (view.ids[i] & TL_ID_COPY) != 0;
        const uint32_t first = count_of_lane(c->soup, view.ids[i]);
        const uint32_t second = single ? 0 : count_of_lane(c->soup, view.ids[pairs + i]);
        if (first == 0 || (!single && (second == 0 || copy != ((view.ids[pairs + i] & TL_ID_COPY) != 0)))) {
            return false;
        }
        // A lane without a triangle must have no area: then no ray can surely hit it.
        tl_vec3 a = tl_leaf_slot(&view, i, 0), d = tl_leaf_slot(&view, pairs + i, 1);
        if (single && !(a.x == d.x && a.y == d.y && a.z == d.z)) {
            return false;
        }
        c->pair_count += !copy && !single;
        c->single_count += !copy && single;
        c->triangle_count += copy ? 0 : first + second;
    }
    for (uint32_t i = 0; i < 12 * pairs; i++) {
        if (!coordinate_in_range(view.floats[i])) {
            return false;
        }
    }
    return true;
}

// Traversal does not read child words to skip lanes, so a lane without a child must have the box that no ray enters.
static bool boxes_are_sound(const tl_soup_node *node)
{
    for (uint32_t lane = 0; lane < TL_SOUP_WIDTH; lane++) {
        for (uint32_t i = 0; i < 6; i++) {
            float plane = node->plane[i][lane];
            if (node->child[lane] != 0 ? !coordinate_in_range(plane) : plane != (i % 2 == 0 ? INFINITY : -INFINITY)) {
                return false;
            }
        }
    }
    return true;
}

static bool is_power_of_two(float value)
{
    int exponent;
    return value >= FLT_MIN && value <= TL_MAX_COORDINATE && frexpf(value, &exponent) == 0.5f;
}

// In compact nodes the mask skips them.
static bool compact_boxes_are_sound(const tl_compact_node *node)
{
    uint32_t children = 0;
    for (uint32_t lane = 0; lane < TL_SOUP_WIDTH; lane++) {
        children |= (uint32_t)(node->child[lane] != 0) << lane;
    }
    for (uint32_t axis = 0; axis < 3; axis++) {
        // The last step may lie beyond the range; planes in use may not.
        if (!coordinate_in_range(node->origin[axis]) || !is_power_of_two(node->scale[axis])) {
            return false;
        }
    }
    return node->mask == children && node->zero == 0;
}

static bool check_nodes(checker *c)
{
    const tl_soup *soup = c->soup;
    bool compact = soup->layout == TL_SOUP_COMPACT;
    c->next_node = 1;
    c->depth = 1;
    uint32_t level_end = 1;
    for (uint32_t i = 0; i < c->soup->node_count; i++) {
        c->node = i;
        if (i == level_end) {
            if (level_end == c->next_node) {
                return false; // no node names node i
            }
            level_end = c->next_node;
            c->depth++;
        }
        if (compact ? !compact_boxes_are_sound(&tl_compact_nodes(soup)[i])
                    : !boxes_are_sound(&tl_soup_nodes(soup)[i])) {
            return false;
        }
        const uint32_t *children = compact ? tl_compact_nodes(soup)[i].child : tl_soup_nodes(soup)[i].child;
        for (uint32_t k = 0; k < TL_SOUP_WIDTH; k++) {
            uint32_t child = children[k];
            if ((child & TL_CHILD_LEAF) != 0) {
                if (!leaf_is_sound(c, child)) {
                    return false;
                }
            } else if (child != 0 && (child != c->next_node++ || child >= c->soup->node_count)) {
                return false;
            }
        }
    }
    return c->next_node == c->soup->node_count && c->next_leaf == c->soup->leaf_bytes;
}

static bool counts_are_sound(const checker *c)
{
    const tl_soup *soup = c->soup;
    return c->leaf_count == soup->leaf_count && c->reference_count == soup->reference_count &&
           c->triangle_count == soup->triangle_count && c->pair_count == soup->pair_count &&
           c->single_count == soup->single_count && c->depth == soup->depth && c->depth <= TL_SOUP_MAX_DEPTH;
}

tl_result tl_soup_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    tl_blob expected = { TL_SOUP_MAGIC, TL_SOUP_VERSION, sizeof(tl_soup) };
    tl_result result = tl_blob_check_head(bytes, size, expected, TL_BLOB_ALIGNMENT, report_out);
    if (result == TL_ERR_VERSION) {
        expected.version = TL_SOUP_VERSION_ALONE;
        result = tl_blob_check_head(bytes, size, expected, TL_BLOB_ALIGNMENT, report_out);
    }
    TL_TRY(result);
    checker c;
    memset(&c, 0, sizeof c);
    c.soup = bytes;
    const char *advice = "bake the soup again, or copy its file again";
    if (!head_is_sound(c.soup)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, advice);
    }
    if (!coincident_are_sound(c.soup)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "coincident", TL_NO_ELEMENT, advice);
    }
    if (!check_nodes(&c)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "node", c.node, advice);
    }
    return counts_are_sound(&c) ? TL_OK : tl_report_fail(report_out, TL_ERR_CORRUPT, "count", TL_NO_ELEMENT, advice);
}
