// SPDX-License-Identifier: MIT
//
// Edges that meet outside their nodes are split there.
//
// Where edges only touch (a node inside an edge), splitting there is exact. Where two edges cross between lattice
// points, the crossing is rounded to the lattice and becomes a node, and every edge is then drawn through all nodes
// whose unit square it meets, so that rounding cannot move an edge across a vertex. Source: Hobby, "Practical segment
// intersection with finite precision output", 1999 (snap rounding). Squares are taken closed here, which is simpler and
// can leave a crossing where an edge meets only a square's corner; so the whole is repeated until no crossing is left,
// a bounded number of times.

#include "polygon/outline/outline.h"

#include "base/assert.h"
#include "base/radix_sort.h"
#include "polygon/outline/key_table.h"
#include "polygon/outline/packed_boxes.h"
#include "polygon/outline/sweep.h"

#include <string.h>

enum { MAX_ROUNDS = 16 };

// From this many segments on it pays to ask first, by a sweep, whether there is any contact at all.
enum { SMALLEST_SWEEP = 128 };

// Node `node` is to be put into segment `segment`.
typedef struct split_contact_edge {
    uint32_t segment, node;
} split_contact_edge;

typedef struct edge_splitter {
    tl_arena *arena;
    tl_outline_nodes *nodes;
    tl_lattice_segment *segments; // each undirected edge once, however often it is run along
    uint32_t *source;             // [segment] first directed edge along it
    uint32_t segment_count;
    uint32_t *segment_of; // [edge]
    split_contact_edge *splits;
    uint32_t split_count, split_capacity;
    uint32_t crossings;
    uint32_t first_contact; // lowest directed edge of a contact
} edge_splitter;

static void *grow_edges(tl_arena *arena, const void *old, uint64_t old_count, uint64_t new_count, size_t size)
{
    void *array = tl_arena_push(arena, new_count, size);
    if (array != NULL && old_count > 0) {
        memcpy(array, old, (size_t)old_count * size);
    }
    return array;
}

static tl_result add_split(edge_splitter *s, uint32_t segment_index, uint32_t node)
{
    if (s->split_count == s->split_capacity) {
        uint32_t capacity = s->split_capacity > 0 ? 2 * s->split_capacity : 16;
        s->splits = grow_edges(s->arena, s->splits, s->split_count, capacity, sizeof(split_contact_edge));
        if (s->splits == NULL) {
            return TL_ERR_MEMORY;
        }
        s->split_capacity = capacity;
    }
    s->splits[s->split_count].segment = segment_index;
    s->splits[s->split_count++].node = node;
    return TL_OK;
}

static tl_result add_crossing_node(edge_splitter *s, tl_lattice_point point, int32_t height)
{
    tl_outline_nodes *nodes = s->nodes;
    if (nodes->count == nodes->capacity) {
        uint32_t capacity = 2 * nodes->capacity;
        nodes->points = grow_edges(s->arena, nodes->points, nodes->count, capacity, sizeof *nodes->points);
        nodes->heights = grow_edges(s->arena, nodes->heights, nodes->count, capacity, sizeof *nodes->heights);
        nodes->is_border = grow_edges(s->arena, nodes->is_border, nodes->count, capacity, sizeof *nodes->is_border);
        if (nodes->points == NULL || nodes->heights == NULL || nodes->is_border == NULL) {
            return TL_ERR_MEMORY;
        }
        nodes->capacity = capacity;
    }
    nodes->points[nodes->count] = point;
    nodes->heights[nodes->count] = height;
    nodes->is_border[nodes->count++] = 0;
    return TL_OK;
}

// floor(distance * numerator / denominator + 1/2), by binary long multiplication and division. numerator < denominator
// <= 2^62, so twice the remainder and a numerator stay below 2^64.
static int32_t scale_rounded(int64_t distance, uint64_t numerator, uint64_t denominator)
{
    uint64_t length = (uint64_t)(distance < 0 ? -distance : distance);
    uint64_t quotient = 0;
    uint64_t remainder = 0;
    for (int bit = 31; bit >= 0; bit--) {
        remainder = 2 * remainder + (length >> bit & 1 ? numerator : 0);
        quotient *= 2;
        while (remainder >= denominator) {
            remainder -= denominator;
            quotient++;
        }
    }
    quotient += distance < 0 ? 2 * remainder > denominator : 2 * remainder >= denominator;
    return distance < 0 ? -(int32_t)quotient : (int32_t)quotient;
}

// The lattice point nearest to where two segments cross.
static tl_result add_crossing(edge_splitter *s, uint32_t first, uint32_t second)
{
    const tl_lattice_point *points = s->nodes->points;
    tl_lattice_segment f = s->segments[first];
    tl_lattice_point a = points[f.a];
    tl_lattice_point b = points[f.b];
    tl_lattice_point c = points[s->segments[second].a];
    tl_lattice_point d = points[s->segments[second].b];
    int64_t a_side = tl_turn(c, d, a);
    int64_t b_side = tl_turn(c, d, b);
    uint64_t from_a = (uint64_t)(a_side < 0 ? -a_side : a_side);
    uint64_t from_b = (uint64_t)(b_side < 0 ? -b_side : b_side);
    int32_t *heights = s->nodes->heights;
    tl_lattice_point point = { a.x + scale_rounded((int64_t)b.x - a.x, from_a, from_a + from_b),
                               a.z + scale_rounded((int64_t)b.z - a.z, from_a, from_a + from_b) };
    int64_t rise = (int64_t)heights[f.b] - heights[f.a];
    return add_crossing_node(s, point, heights[f.a] + scale_rounded(rise, from_a, from_a + from_b));
}

static void note_contact(edge_splitter *s, uint32_t first, uint32_t second)
{
    uint32_t a = s->source[first];
    uint32_t b = s->source[second];
    uint32_t lowest = a < b ? a : b;
    s->first_contact = lowest < s->first_contact ? lowest : s->first_contact;
}

// A node of `other` inside the segment becomes a split.
static tl_result touch(edge_splitter *s, uint32_t index, uint32_t other, uint32_t node, bool *touches)
{
    const tl_lattice_point *points = s->nodes->points;
    tl_lattice_segment e = s->segments[index];
    if (node == e.a || node == e.b || tl_turn(points[e.a], points[e.b], points[node]) != 0 ||
        !tl_within_span(points[e.a], points[e.b], points[node])) {
        return TL_OK;
    }
    *touches = true;
    note_contact(s, index, other);
    return add_split(s, index, node);
}

static tl_result test_pair(edge_splitter *s, uint32_t first, uint32_t second)
{
    tl_lattice_segment e = s->segments[first];
    tl_lattice_segment f = s->segments[second];
    bool touches = false;
    TL_TRY(touch(s, first, second, f.a, &touches));
    TL_TRY(touch(s, first, second, f.b, &touches));
    TL_TRY(touch(s, second, first, e.a, &touches));
    TL_TRY(touch(s, second, first, e.b, &touches));
    if (touches || e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b) {
        return TL_OK;
    }
    const tl_lattice_point *p = s->nodes->points;
    // None of these is 0 for segments whose boxes overlap: no end lies in the other segment.
    if ((tl_turn(p[e.a], p[e.b], p[f.a]) > 0) == (tl_turn(p[e.a], p[e.b], p[f.b]) > 0) ||
        (tl_turn(p[f.a], p[f.b], p[e.a]) > 0) == (tl_turn(p[f.a], p[f.b], p[e.b]) > 0)) {
        return TL_OK;
    }
    note_contact(s, first, second);
    if (++s->crossings > TL_MAX_CONTOUR_CROSSINGS) {
        return TL_OK;
    }
    return add_crossing(s, first, second);
}

static uint64_t sort_key(int32_t x)
{
    return (uint64_t)((int64_t)x + TL_MAX_CONTOUR_COORDINATE);
}

static tl_lattice_box segment_box(const edge_splitter *s, uint32_t segment)
{
    const tl_lattice_point a = s->nodes->points[s->segments[segment].a], b = s->nodes->points[s->segments[segment].b];
    const tl_lattice_box box = { { a.x < b.x ? a.x : b.x, a.z < b.z ? a.z : b.z },
                                 { a.x < b.x ? b.x : a.x, a.z < b.z ? b.z : a.z } };
    return box;
}

#define TL_HEAP(name)                 largest_place_##name
#define TL_HEAP_ITEM                  uint32_t
#define TL_HEAP_BEFORE(context, a, b) ((a) > (b))
#include "base/heap.inl"

// Places in an order that came from a tree, which has one of its own.
typedef struct found_places {
    uint32_t *places;
    uint32_t count, capacity;
} found_places;

static tl_result note_found(found_places *list, tl_arena *arena, uint32_t place)
{
    if (list->count == list->capacity) {
        uint32_t *grown = tl_arena_grow(arena, list->places, &list->capacity, 64, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        list->places = grown;
    }
    list->places[list->count++] = place;
    return TL_OK;
}

static void sort_found(found_places *list)
{
    for (uint32_t i = list->count / 2; i-- > 0;) {
        largest_place_sift_down(list->places, list->count, i, list->places[i], NULL);
    }
    for (uint32_t left = list->count; left > 1;) {
        const uint32_t top = largest_place_pop(list->places, &left, NULL);
        list->places[left] = top;
    }
}

// The pairs of segment order[i] with those behind it in the order, which meet its box or its line.
static tl_result test_pairs_of(edge_splitter *s, const tl_sort_item *order, uint32_t i, const tl_packed_boxes *tree,
                               found_places *found)
{
    const tl_lattice_segment e = s->segments[order[i].value];
    tl_packed_boxes_walk walk;
    uint32_t place;
    found->count = 0;
    tl_packed_boxes_begin(&walk, tree, s->nodes->points[e.a], s->nodes->points[e.b], 0);
    while (tl_packed_boxes_next(&walk, &place)) {
        if (place > i) {
            TL_TRY(note_found(found, s->arena, place));
        }
    }
    sort_found(found);
    for (uint32_t k = 0; k < found->count; k++) {
        TL_TRY(test_pair(s, order[i].value, order[found->places[k]].value));
    }
    return TL_OK;
}

static tl_result test_pairs_by_tree(edge_splitter *s, const tl_sort_item *order)
{
    const uint32_t count = s->segment_count;
    tl_lattice_box *boxes = TL_PUSH(s->arena, tl_lattice_box, count);
    if (boxes == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        boxes[i] = segment_box(s, order[i].value);
    }
    tl_packed_boxes tree;
    found_places found = { NULL, 0, 0 };
    if (!tl_packed_boxes_build(&tree, s->arena, boxes, count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count && s->crossings <= TL_MAX_CONTOUR_CROSSINGS; i++) {
        TL_TRY(test_pairs_of(s, order, i, &tree, &found));
    }
    return TL_OK;
}

static tl_result test_pairs_along_x(edge_splitter *s, const tl_sort_item *order)
{
    const uint32_t count = s->segment_count;
    for (uint32_t i = 0; i < count && s->crossings <= TL_MAX_CONTOUR_CROSSINGS; i++) {
        const tl_lattice_box e = segment_box(s, order[i].value);
        for (uint32_t j = i + 1; j < count && order[j].key <= order[i].extra; j++) {
            const tl_lattice_box f = segment_box(s, order[j].value);
            if (e.low.z <= f.high.z && f.low.z <= e.high.z) {
                TL_TRY(test_pair(s, order[i].value, order[j].value));
            }
        }
    }
    return TL_OK;
}

// All pairs of segments whose boxes overlap, in the order of their low x: of a few segments by that order alone, of
// many by a tree. Both test the pairs that meet in the same order, so crossings get the same numbers.
static tl_result test_all_pairs(edge_splitter *s)
{
    uint32_t count = s->segment_count;
    tl_sort_item *order = TL_PUSH(s->arena, tl_sort_item, 2 * (uint64_t)count);
    if (order == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_lattice_box box = segment_box(s, i);
        tl_sort_item item = { sort_key(box.low.x), i, (uint32_t)sort_key(box.high.x) };
        order[i] = item;
    }
    tl_radix_sort(order, order + count, count);
    return count < SMALLEST_SWEEP ? test_pairs_along_x(s, order) : test_pairs_by_tree(s, order);
}

// Whether a segment meets the unit square around a node, without its sides of larger x and z. The node lies in
// the segment's box; then the line must not leave all corners on one side. With d = b - a and the turn t of the node,
// corner (u, v) / 2 from the node has the turn (2t + u dz - v dx) / 2, u and v being -1 or a shade less than 1.
static bool meets_square(tl_lattice_point a, tl_lattice_point b, tl_lattice_point node)
{
    if (!tl_within_span(a, b, node)) {
        return false;
    }
    int64_t dx = (int64_t)b.x - a.x;
    int64_t dz = (int64_t)b.z - a.z;
    int64_t reach = (dx < 0 ? -dx : dx) + (dz < 0 ? -dz : dz);
    int64_t twice = 2 * tl_turn(a, b, node);
    bool not_all_right = dz > 0 || dx < 0 ? twice + reach > 0 : twice + reach >= 0;
    bool not_all_left = dz < 0 || dx > 0 ? twice - reach < 0 : twice - reach <= 0;
    return not_all_right && not_all_left;
}

// Draws every segment through the nodes whose square it meets. Nodes at the same place along it: in the order of x.
static tl_result snap_segments(edge_splitter *s)
{
    const tl_outline_nodes *nodes = s->nodes;
    tl_sort_item *order = TL_PUSH(s->arena, tl_sort_item, 2 * (uint64_t)nodes->count);
    tl_lattice_box *boxes = TL_PUSH(s->arena, tl_lattice_box, nodes->count);
    if (order == NULL || boxes == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < nodes->count; i++) {
        tl_sort_item item = { sort_key(nodes->points[i].x), i, 0 };
        order[i] = item;
    }
    tl_radix_sort(order, order + nodes->count, nodes->count);
    for (uint32_t i = 0; i < nodes->count; i++) {
        boxes[i].low = boxes[i].high = nodes->points[order[i].value];
    }
    tl_packed_boxes tree;
    found_places found = { NULL, 0, 0 };
    if (!tl_packed_boxes_build(&tree, s->arena, boxes, nodes->count)) {
        return TL_ERR_MEMORY;
    }
    s->split_count = 0;
    for (uint32_t i = 0; i < s->segment_count; i++) {
        const tl_lattice_segment e = s->segments[i];
        const tl_lattice_point a = nodes->points[e.a], b = nodes->points[e.b];
        tl_packed_boxes_walk walk;
        uint32_t place;
        found.count = 0;
        tl_packed_boxes_begin(&walk, &tree, a, b, 1);
        while (tl_packed_boxes_next(&walk, &place)) {
            const uint32_t node = order[place].value;
            if (node != e.a && node != e.b && meets_square(a, b, nodes->points[node])) {
                TL_TRY(note_found(&found, s->arena, place));
            }
        }
        sort_found(&found);
        for (uint32_t k = 0; k < found.count; k++) {
            TL_TRY(add_split(s, i, order[found.places[k]].value));
        }
    }
    return TL_OK;
}

// One segment per undirected edge, in order of first use.
static tl_result gather_segments(edge_splitter *s, const tl_outline_edge *edges, uint32_t count)
{
    tl_key_table table;
    s->segments = TL_PUSH(s->arena, tl_lattice_segment, count);
    s->source = TL_PUSH(s->arena, uint32_t, count);
    s->segment_count = 0;
    if (s->segments == NULL || s->source == NULL || !tl_key_table_init(&table, s->arena, count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (TL_KEYS_AHEAD < count - i) {
            tl_key_table_fetch(&table, tl_unordered_key(edges[i + TL_KEYS_AHEAD].from, edges[i + TL_KEYS_AHEAD].to));
        }
        const uint64_t key = tl_unordered_key(edges[i].from, edges[i].to);
        uint32_t *place = tl_key_table_at(&table, key);
        if (*place == TL_NO_VALUE) {
            const tl_lattice_segment e = { (uint32_t)(key >> 32), (uint32_t)key };
            *place = s->segment_count;
            s->source[s->segment_count] = i;
            s->segments[s->segment_count++] = e;
        }
        s->segment_of[i] = *place;
    }
    return TL_OK;
}

// Sorts splits by segment and along it, so that each segment's chain of nodes is a range. first_out: [segments + 1].
static tl_result sort_splits(edge_splitter *s, uint32_t **first_out)
{
    uint32_t count = s->split_count;
    tl_sort_item *order = TL_PUSH(s->arena, tl_sort_item, 2 * (uint64_t)count);
    split_contact_edge *sorted = TL_PUSH(s->arena, split_contact_edge, count);
    uint32_t *first = TL_PUSH_ZERO(s->arena, uint32_t, (uint64_t)s->segment_count + 1);
    if (order == NULL || sorted == NULL || first == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_lattice_point *p = s->nodes->points;
    for (uint32_t i = 0; i < count; i++) {
        tl_lattice_segment e = s->segments[s->splits[i].segment];
        // Along the segment, and not farther than its length: >= 0 for nodes in its box.
        tl_sort_item item = { (uint64_t)tl_dot2(p[e.a], p[e.b], p[s->splits[i].node]), i, 0 };
        order[i] = item;
        first[s->splits[i].segment + 1]++;
    }
    tl_radix_sort(order, order + count, count);
    for (uint32_t i = 0; i < s->segment_count; i++) {
        first[i + 1] += first[i];
    }
    uint32_t *next = TL_PUSH(s->arena, uint32_t, s->segment_count);
    if (next == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(next, first, s->segment_count * sizeof *next);
    for (uint32_t i = 0; i < count; i++) {
        split_contact_edge item = s->splits[order[i].value];
        sorted[next[item.segment]++] = item;
    }
    s->splits = sorted;
    s->split_capacity = count;
    *first_out = first;
    return TL_OK;
}

static tl_result split_edges(edge_splitter *s, tl_outline_edge **edges, uint32_t *count)
{
    uint32_t *first;
    TL_TRY(sort_splits(s, &first));
    uint64_t total = *count;
    for (uint32_t i = 0; i < *count; i++) {
        total += first[s->segment_of[i] + 1] - first[s->segment_of[i]];
    }
    tl_outline_edge *chains = TL_PUSH(s->arena, tl_outline_edge, total);
    if (chains == NULL || total > UINT32_MAX) {
        return TL_ERR_MEMORY;
    }
    uint32_t made = 0;
    for (uint32_t i = 0; i < *count; i++) {
        tl_outline_edge edge = (*edges)[i];
        uint32_t low = first[s->segment_of[i]];
        uint32_t high = first[s->segment_of[i] + 1];
        bool forward = edge.from == s->segments[s->segment_of[i]].a;
        uint32_t from = edge.from;
        for (uint32_t k = 0; k <= high - low; k++) {
            uint32_t to = k == high - low ? edge.to : s->splits[forward ? low + k : high - 1 - k].node;
            // A touch is found once for each segment that ends there.
            if (to != from) {
                tl_outline_edge piece = { from, to };
                chains[made++] = piece;
            }
            from = to;
        }
    }
    *edges = chains;
    *count = made;
    return TL_OK;
}

tl_result tl_outline_split_contacts(tl_arena *arena, tl_outline_nodes *nodes, tl_outline_edge **edges, uint32_t *count,
                                    uint32_t *faults, uint32_t *fault_edge, tl_outline_sweep *sweep)
{
    memset(sweep, 0, sizeof *sweep);
    for (uint32_t round = 0; round < MAX_ROUNDS; round++) {
        edge_splitter s;
        memset(&s, 0, sizeof s);
        s.arena = arena;
        s.nodes = nodes;
        s.first_contact = UINT32_MAX;
        s.segment_of = TL_PUSH(arena, uint32_t, *count);
        if (s.segment_of == NULL ||
            (*count >= SMALLEST_SWEEP && !tl_sweep_record_init(&sweep->record, arena, nodes->count))) {
            return TL_ERR_MEMORY;
        }
        const tl_arena_mark mark = tl_arena_get_mark(arena);
        TL_TRY(gather_segments(&s, *edges, *count));
        bool apart = false;
        if (s.segment_count >= SMALLEST_SWEEP) {
            TL_TRY(tl_sweep_segments(arena, nodes->points, nodes->count, s.segments, s.segment_count, &sweep->record,
                                     &apart));
        }
        if (apart) {
            sweep->place_count = nodes->count;
            sweep->segment_count = s.segment_count;
            sweep->segment_of = s.segment_of;
        } else {
            TL_TRY(test_all_pairs(&s));
        }
        if (s.crossings > TL_MAX_CONTOUR_CROSSINGS) {
            break;
        }
        if (round == 0 && s.first_contact != UINT32_MAX) {
            *fault_edge = s.first_contact;
            *faults |= s.split_count > 0 ? TL_CONTOUR_FAULT_TOUCH : 0;
            *faults |= s.crossings > 0 ? TL_CONTOUR_FAULT_CROSSING : 0;
        }
        if (s.crossings == 0 && s.split_count == 0) {
            tl_arena_rollback(arena, mark);
            return TL_OK;
        }
        if (s.crossings == 0) {
            return split_edges(&s, edges, count);
        }
        TL_TRY(tl_outline_unite_nodes(s.arena, s.nodes, NULL)); // crossings may fall on other nodes
        TL_TRY(snap_segments(&s));
        TL_TRY(split_edges(&s, edges, count));
    }
    *faults |= TL_CONTOUR_FAULT_REFUSED | TL_CONTOUR_FAULT_CROSSING;
    return TL_OK;
}
