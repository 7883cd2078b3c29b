// SPDX-License-Identifier: MIT
//
// The k-d tree, the alternative to the BVH. Planes divide space, not triangles: pairs that a plane cuts are stored on
// both sides, clipped to each, so cells never overlap and a ray meets them strictly one after the other. It is the tree
// of Ericson's article. Wide nodes and leaves are those of the BVH, so the two can be compared, and every query runs on
// both.
//
// Planes are chosen by the surface area heuristic, from the top down. Its minimum lies where a clipped reference begins
// or ends: in small cells all those planes are tried in one sweep over sorted events, in large ones the borders of
// bins, which cost a count instead of a sort and lose little. A cell whose best plane gains nothing (a fan around a
// corner, which no plane separates) is distributed over leaves by count; and so is one whose plane would copy more than
// its share of the copies that are left, which are KD_MAX_COPIES of each pair: 18 levels take 1 to 8, large fans all.
//
// A ray need not remember the triangles that it has tested (mailboxes): finding one twice gives the same t twice, and
// what lies behind the best hit is dropped before it is decided.
//
// Sources: Wald, Havran, On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N), 2006 (costs,
// sweep, planar references, depth); Havran, Bittner, On Improving KD-Trees for Ray Shooting, 2002 (clipping).

#include "base/assert.h"
#include "base/compiler.h"
#include "soup/bake/bvh_split.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

#include <float.h>
#include <string.h>

enum {
    SWEEP_MAX = 64, // the most references of a cell that is swept
    KD_BINS = 64,
    KD_MAX_COPIES = 16,
    DEPTH_MAX = 60 // distributing by count ends within 29 levels more
};
static_assert(DEPTH_MAX + 32 <= TL_SOUP_MAX_DEPTH, "a cell of 2^32 references ends within the depth limit");

// Cutting off empty space ends rays early, which areas alone do not show (Wald and Havran, section 5.1).
#define EMPTY_SPACE_SHARE 0.8f

// A growing array. References are pushed and popped in the order of the recursion.
typedef struct ref_list {
    tl_bvh_ref *refs;
    uint64_t count, capacity;
} ref_list;

typedef struct kd_builder {
    tl_bvh_splitter clipper;
    const tl_allocator *allocator;
    tl_stage *stage;
    ref_list work; // references of the cells on the path
    ref_list out;  // references of leaves
    tl_bvh_node *nodes;
    uint64_t node_count, node_capacity;
    uint64_t copies_max; // references of all leaves together
    uint32_t depth_max;
    uint32_t steps;   // of work since the last progress call
    tl_result result; // the first failure: all calls end
} kd_builder;

typedef struct kd_cell {
    tl_aabb box; // of the cell; references are clipped to it
    uint64_t first;
    uint32_t count;
    uint32_t depth;
} kd_cell;

typedef struct kd_plane {
    float cost; // sum over both sides of half area times blocks
    float position;
    uint32_t axis;
    bool planar_left; // references that lie in the plane go left
} kd_plane;

// Passes look at so many references more, a step of the stage at most. False: the bake was cancelled, or has failed.
static bool kd_steps(kd_builder *b, uint32_t count)
{
    b->steps += count;
    if (b->steps >= TL_STAGE_STEP) {
        b->steps = 0;
        const tl_result result = tl_stage_add(b->stage, 0);
        b->result = b->result == TL_OK ? result : b->result;
    }
    return b->result == TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Memory.

// Doubles an array. Once this fails, all later calls fail.
static bool grow_kd_array(kd_builder *b, void **array, uint64_t *capacity, uint64_t needed, size_t size)
{
    if (needed <= *capacity) {
        return true;
    }
    uint64_t wanted = 2 * *capacity > needed ? 2 * *capacity : needed;
    void *larger = b->result != TL_OK ? NULL : tl_allocate_array(b->allocator, wanted, size);
    if (larger == NULL) {
        b->result = b->result == TL_OK ? TL_ERR_MEMORY : b->result;
        return false;
    }
    if (*capacity > 0) {
        memcpy(larger, *array, (size_t)*capacity * size);
    }
    tl_release_array(b->allocator, *array, *capacity, size);
    *array = larger;
    *capacity = wanted;
    return true;
}

static bool push_ref(kd_builder *b, ref_list *list, const tl_bvh_ref *ref)
{
    void *refs = list->refs;
    if (!grow_kd_array(b, &refs, &list->capacity, list->count + 1, sizeof *list->refs)) {
        return false;
    }
    list->refs = refs;
    list->refs[list->count++] = *ref;
    return true;
}

static uint32_t push_kd_node(kd_builder *b)
{
    void *nodes = b->nodes;
    if (!grow_kd_array(b, &nodes, &b->node_capacity, b->node_count + 1, sizeof *b->nodes)) {
        return 0;
    }
    b->nodes = nodes;
    memset(&b->nodes[b->node_count], 0, sizeof *b->nodes);
    return (uint32_t)b->node_count++;
}

// ---------------------------------------------------------------------------------------------------------
// Leaves.

static tl_aabb box_of_refs(const tl_bvh_ref *refs, uint32_t count)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        box.min = tl_min(box.min, refs[i].min);
        box.max = tl_max(box.max, refs[i].max);
    }
    return box;
}

// Distributes references over leaves by count.
static uint32_t make_leaves(kd_builder *b, uint64_t first, uint32_t count)
{
    uint32_t index = push_kd_node(b);
    if (b->result != TL_OK) {
        return 0;
    }
    b->nodes[index].box = box_of_refs(b->work.refs + first, count);
    if (count <= TL_SOUP_LEAF_PAIRS) {
        b->nodes[index].link = (uint32_t)b->out.count;
        b->nodes[index].kind = TL_BVH_LEAF + count;
        for (uint32_t i = 0; i < count; i++) {
            tl_bvh_ref ref = b->work.refs[first + i];
            (void)push_ref(b, &b->out, &ref);
        }
        (void)kd_steps(b, count);
        return index;
    }
    // Full leaves on the left, so that only the last leaf may hold fewer.
    uint32_t blocks = (count + TL_SOUP_LEAF_PAIRS - 1) / TL_SOUP_LEAF_PAIRS;
    uint32_t left_count = blocks / 2 * TL_SOUP_LEAF_PAIRS;
    (void)make_leaves(b, first, left_count);
    uint32_t right = make_leaves(b, first + left_count, count - left_count);
    if (b->result == TL_OK) {
        b->nodes[index].link = right;
    }
    return index;
}

// ---------------------------------------------------------------------------------------------------------
// Planes.

static void part_box(tl_aabb box, uint32_t axis, float position, tl_aabb *left, tl_aabb *right)
{
    *left = box;
    *right = box;
    tl_set_component(&left->max, axis, position);
    tl_set_component(&right->min, axis, position);
}

static inline void try_plane(const kd_cell *cell, uint32_t axis, float position, uint32_t left, uint32_t planar,
                             uint32_t right, kd_plane *best)
{
    tl_aabb left_box, right_box;
    part_box(cell->box, axis, position, &left_box, &right_box);
    float left_area = tl_aabb_half_area(left_box), right_area = tl_aabb_half_area(right_box);
    for (uint32_t side = 0; side < (planar > 0 ? 2u : 1u); side++) {
        uint32_t on_left = left + (side == 0 ? planar : 0), on_right = right + (side == 0 ? 0 : planar);
        float cost = left_area * tl_bvh_blocks(on_left) + right_area * tl_bvh_blocks(on_right);
        cost *= on_left == 0 || on_right == 0 ? EMPTY_SPACE_SHARE : 1.0f;
        if (cost < best->cost) {
            kd_plane plane = { cost, position, axis, side == 0 };
            *best = plane;
        }
    }
}

// At the same position ends come before planar references, and these before beginnings.
typedef enum kd_event_kind { EVENT_END, EVENT_PLANAR, EVENT_BEGIN } kd_event_kind;

typedef struct kd_event {
    float position;
    kd_event_kind kind;
} kd_event;

static bool event_before(kd_event a, kd_event b)
{
    return a.position < b.position || (a.position == b.position && a.kind < b.kind);
}

static void insert_event(kd_event *events, uint32_t *count, kd_event event)
{
    uint32_t place = (*count)++;
    for (; place > 0 && event_before(event, events[place - 1]); place--) {
        events[place] = events[place - 1];
    }
    events[place] = event;
}

static TL_ALWAYS_INLINE uint32_t list_events(const tl_bvh_ref *refs, uint32_t count, uint32_t axis, kd_event *events)
{
    uint32_t event_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        float low = tl_component(refs[i].min, axis), high = tl_component(refs[i].max, axis);
        kd_event begin = { low, low == high ? EVENT_PLANAR : EVENT_BEGIN }, end = { high, EVENT_END };
        insert_event(events, &event_count, begin);
        if (low != high) {
            insert_event(events, &event_count, end);
        }
    }
    return event_count;
}

static TL_ALWAYS_INLINE void sweep_events(const kd_builder *b, const kd_cell *cell, uint32_t axis, kd_plane *best)
{
    kd_event events[2 * SWEEP_MAX];
    uint32_t event_count = list_events(b->work.refs + cell->first, cell->count, axis, events);
    float low = tl_component(cell->box.min, axis), high = tl_component(cell->box.max, axis);
    uint32_t left = 0, right = cell->count;
    for (uint32_t i = 0; i < event_count;) {
        float position = events[i].position;
        uint32_t at[3] = { 0, 0, 0 };
        for (; i < event_count && events[i].position == position; i++) {
            at[events[i].kind]++;
        }
        right -= at[EVENT_END] + at[EVENT_PLANAR];
        if (position > low && position < high) {
            try_plane(cell, axis, position, left, at[EVENT_PLANAR], right, best);
        }
        left += at[EVENT_BEGIN] + at[EVENT_PLANAR];
    }
}

static uint32_t bin_of(float place, float base, float per_metre)
{
    float bin = (place - base) * per_metre;
    return bin <= 0.0f ? 0 : bin >= (float)(KD_BINS - 1) ? KD_BINS - 1 : (uint32_t)bin;
}

// Counts are approximate for references that end on a border of bins; they only choose the plane.
static TL_ALWAYS_INLINE void try_bins(kd_builder *b, const kd_cell *cell, uint32_t axis, kd_plane *best)
{
    float base = tl_component(cell->box.min, axis);
    float width = (tl_component(cell->box.max, axis) - base) / (float)KD_BINS;
    // Bins must be wider than the rounding of their borders.
    if (!(width > 4.0f * FLT_EPSILON * fabsf(base) && width > FLT_MIN && 1.0f / width < FLT_MAX)) {
        return;
    }
    uint32_t begin[KD_BINS] = { 0 }, end[KD_BINS] = { 0 };
    const tl_bvh_ref *refs = b->work.refs + cell->first;
    for (uint32_t i = 0, until; i < cell->count && kd_steps(b, tl_stage_step_end(i, cell->count) - i); i = until) {
        until = tl_stage_step_end(i, cell->count);
        for (uint32_t k = i; k < until; k++) {
            begin[bin_of(tl_component(refs[k].min, axis), base, 1.0f / width)]++;
            end[bin_of(tl_component(refs[k].max, axis), base, 1.0f / width)]++;
        }
    }
    uint32_t left = 0, right = cell->count;
    for (uint32_t bin = 1; bin < KD_BINS; bin++) {
        left += begin[bin - 1];
        right -= end[bin - 1];
        try_plane(cell, axis, base + width * (float)bin, left, 0, right, best);
    }
}

// False: splitting the cell is no cheaper than testing all of it.
static TL_NOINLINE bool find_kd_plane(kd_builder *b, const kd_cell *cell, kd_plane *best)
{
    float area = tl_aabb_half_area(cell->box);
    best->cost = area * (tl_bvh_blocks(cell->count) - TL_BVH_TRAVERSAL_COST);
    float limit = best->cost;
    if (cell->count <= 1 || cell->depth >= b->depth_max) {
        return false;
    }
    // Each axis has code of its own.
    if (cell->count <= SWEEP_MAX) {
        sweep_events(b, cell, 0, best);
        sweep_events(b, cell, 1, best);
        sweep_events(b, cell, 2, best);
    } else {
        try_bins(b, cell, 0, best);
        try_bins(b, cell, 1, best);
        try_bins(b, cell, 2, best);
    }
    return best->cost < limit;
}

// ---------------------------------------------------------------------------------------------------------
// The tree.

// References that a plane cuts.
static uint32_t count_cut(kd_builder *b, const kd_cell *cell, const kd_plane *plane)
{
    uint32_t cut = 0;
    const tl_bvh_ref *refs = b->work.refs + cell->first;
    for (uint32_t i = 0, until; i < cell->count && kd_steps(b, tl_stage_step_end(i, cell->count) - i); i = until) {
        until = tl_stage_step_end(i, cell->count);
        for (uint32_t k = i; k < until; k++) {
            cut += tl_component(refs[k].min, plane->axis) < plane->position &&
                   tl_component(refs[k].max, plane->axis) > plane->position;
        }
    }
    return cut;
}

// Sorts a cell's references to both sides: right ones stay where the cell's were, left ones go behind all others.
static bool part_references(kd_builder *b, const kd_cell *cell, const kd_plane *plane, kd_cell *left, kd_cell *right)
{
    left->first = b->work.count;
    left->count = 0;
    right->first = cell->first;
    right->count = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        if ((i & (TL_STAGE_STEP - 1)) == 0 && !kd_steps(b, tl_stage_step_end(i, cell->count) - i)) {
            return false;
        }
        tl_bvh_ref ref = b->work.refs[cell->first + i];
        float low = tl_component(ref.min, plane->axis), high = tl_component(ref.max, plane->axis);
        bool planar = low == plane->position && high == plane->position;
        tl_aabb on_left = { ref.min, ref.max }, on_right = on_left;
        if (planar ? plane->planar_left : high <= plane->position) {
            on_right = tl_aabb_empty();
        } else if (planar || low >= plane->position) {
            on_left = tl_aabb_empty();
        } else {
            tl_bvh_clip_reference(&b->clipper, &ref, plane->axis, plane->position, &on_left, &on_right);
        }
        if (!tl_aabb_is_empty(on_left)) {
            tl_bvh_ref part = { on_left.min, ref.pair, on_left.max, 0 };
            left->count++;
            if (!push_ref(b, &b->work, &part)) {
                return false;
            }
        }
        if (!tl_aabb_is_empty(on_right)) {
            tl_bvh_ref part = { on_right.min, ref.pair, on_right.max, 0 };
            b->work.refs[right->first + right->count++] = part;
        }
    }
    return b->result == TL_OK;
}

// Whether a cell may have as many references more: copies that are left are shared out by count.
static bool may_copy(const kd_builder *b, const kd_cell *cell, uint32_t copies)
{
    const uint64_t used = b->out.count + b->work.count;
    const uint64_t left = used < b->copies_max ? b->copies_max - used : 0;
    return (double)copies * (double)b->work.count <= (double)left * (double)cell->count;
}

static uint32_t build_cell(kd_builder *b, kd_cell cell)
{
    kd_plane plane = { 0 };
    if (!find_kd_plane(b, &cell, &plane) || !may_copy(b, &cell, count_cut(b, &cell, &plane))) {
        return make_leaves(b, cell.first, cell.count);
    }
    kd_cell left = { .depth = cell.depth + 1 }, right = { .depth = cell.depth + 1 };
    part_box(cell.box, plane.axis, plane.position, &left.box, &right.box);
    if (!part_references(b, &cell, &plane, &left, &right)) {
        return 0;
    }
    if (left.count == 0) {
        return build_cell(b, right);
    }
    if (right.count == 0) {
        return build_cell(b, left);
    }
    uint32_t index = push_kd_node(b);
    if (b->result != TL_OK) {
        return 0;
    }
    b->nodes[index].box = tl_aabb_union(box_of_refs(b->work.refs + left.first, left.count),
                                        box_of_refs(b->work.refs + right.first, right.count));
    (void)build_cell(b, left);
    b->work.count = left.first;
    uint32_t right_node = b->result == TL_OK ? build_cell(b, right) : 0;
    if (b->result == TL_OK) {
        b->nodes[index].link = right_node;
    }
    return index;
}

// Wald and Havran's depth limit: 8 + 1.3 log2 of the count.
static uint32_t depth_limit(uint32_t count)
{
    uint32_t log2 = 0;
    while (count >> log2 > 1) {
        log2++;
    }
    uint32_t depth = 8 + log2 * 13 / 10;
    return depth < DEPTH_MAX ? depth : DEPTH_MAX;
}

// Hands the tree to the arena, so that baking a soup has one exit; each array is freed as soon as it is copied.
static tl_result copy_to_arena(kd_builder *b, tl_arena *arena, tl_bvh *tree)
{
    if (b->out.count > UINT32_MAX || b->node_count > TL_BVH_MAX_NODES) {
        return TL_ERR_LIMIT;
    }
    tl_release_array(b->allocator, b->work.refs, b->work.capacity, sizeof *b->work.refs);
    b->work.refs = NULL;
    tree->refs = TL_PUSH(arena, tl_bvh_ref, b->out.count);
    if (tree->refs == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_copy(b->stage, tree->refs, b->out.refs, b->out.count * sizeof *tree->refs));
    tl_release_array(b->allocator, b->out.refs, b->out.capacity, sizeof *b->out.refs);
    b->out.refs = NULL;
    tree->nodes = TL_PUSH(arena, tl_bvh_node, b->node_count);
    if (tree->nodes == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_stage_copy(b->stage, tree->nodes, b->nodes, b->node_count * sizeof *tree->nodes));
    tree->node_count = (uint32_t)b->node_count;
    tree->parts = NULL;
    tree->part_count = 0;
    tree->ref_count = (uint32_t)b->out.count;
    tree->leaf_surface = 0.0;
    tree->inner_surface = 0.0;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        if (tl_bvh_leaf_count(&tree->nodes[i]) > 0) {
            tree->leaf_surface += (double)tl_aabb_half_area(tree->nodes[i].box);
        }
        TL_TRY(tl_stage_tick(b->stage, i));
    }
    return TL_OK;
}

tl_result tl_kd_build(const tl_bvh_input *input, tl_stage *stage, tl_arena *arena, tl_bvh *tree_out)
{
    kd_builder b;
    memset(&b, 0, sizeof b);
    b.clipper.mesh = input->mesh;
    b.clipper.pairs = input->pairs;
    b.allocator = &arena->allocator;
    b.stage = stage;
    b.depth_max = depth_limit(input->pair_count);
    b.copies_max = KD_MAX_COPIES * (uint64_t)input->pair_count;
    kd_cell whole = { input->mesh->bounds, 0, input->pair_count, 0 };
    for (uint32_t i = 0; i < input->pair_count && kd_steps(&b, 1); i++) {
        tl_bvh_ref ref = tl_bvh_reference(input->mesh, input->pairs, i);
        (void)push_ref(&b, &b.work, &ref);
    }
    if (b.result == TL_OK) {
        (void)build_cell(&b, whole);
    }
    tl_result result = b.result == TL_OK ? copy_to_arena(&b, arena, tree_out) : b.result;
    tl_release_array(b.allocator, b.work.refs, b.work.capacity, sizeof *b.work.refs);
    tl_release_array(b.allocator, b.out.refs, b.out.capacity, sizeof *b.out.refs);
    tl_release_array(b.allocator, b.nodes, b.node_capacity, sizeof *b.nodes);
    return result;
}
