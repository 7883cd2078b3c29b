// SPDX-License-Identifier: MIT
//
// A line sweeps over the points by rising x, then z, and keeps the segments that it crosses in order. Two segments that
// meet become neighbours before they do, so it is enough to test neighbours when they become such, and each point
// against the segments around it.
// Source: Shamos, Hoey, "Geometric intersection problems", 1976; the degenerate cases as in Bentley, Ottmann, 1979,
// without crossing events, since the first contact ends the sweep.
//
// The order is a list, so that neighbours are found at once. All tests are signs of turns, exact.
//
// Segments come in the order of an outline, and those near in number mostly lie near each other on the line. So a point
// is first looked for in the list, a few steps from a segment with a number near its own. Where that fails it is looked
// for in a tree over a part of the list, and from there along the list; a search that goes far leaves every sixteenth
// segment that it passes in the tree (sweep_index.c). So all steps of all searches together are O(n log n), whatever
// the outline, and most outlines need hardly any tree: with all segments in one, which lies in no cache, it was two
// fifths of the sweep of a star of a million vertices, whose line holds half of them.

#include "polygon/outline/sweep.h"

#include "base/compiler.h"
#include "base/radix_sort.h"
#include "polygon/outline/sweep_index.h"

enum { FINGER_REACH = 8, FINGER_STEPS = 8, POINTS_AHEAD = 8, ITEMS_AROUND = 4, INDEX_STEPS = 16 };

typedef struct sweep_line {
    tl_sweep_item *items; // [segment]
    uint32_t count;
    uint32_t lowest; // of the list
    tl_sweep_index index;
    uint32_t *first; // [points + 1] segments at each point; NULL: segment i runs from point i to the next
    uint32_t *around;
    uint32_t *below; // of the point that is passed, in the record; or NULL
} sweep_line;

// A point and the segments there.
typedef struct sweep_star {
    tl_lattice_point point;
    uint32_t count;
    const uint32_t *segments;
    uint32_t pair[2];
} sweep_star;

static void find_star(const sweep_line *s, uint32_t point, sweep_star *star)
{
    if (s->first != NULL) {
        star->count = s->first[point + 1] - s->first[point];
        star->segments = &s->around[s->first[point]];
        return;
    }
    star->count = 2;
    star->segments = star->pair;
    star->pair[0] = point > 0 ? point - 1 : 0;
    star->pair[1] = point > 0 ? point : s->count - 1;
}

// Puts an item between two that are neighbours now, either of which may be missing.
static void insert_between(sweep_line *s, uint32_t item, uint32_t below, uint32_t above)
{
    tl_sweep_item *i = &s->items[item];
    i->neighbour[0] = below;
    i->neighbour[1] = above;
    i->parent = TL_NOT_INDEXED;
    if (below != TL_NO_SEGMENT) {
        s->items[below].neighbour[1] = item;
    } else {
        s->lowest = item;
    }
    if (above != TL_NO_SEGMENT) {
        s->items[above].neighbour[0] = item;
    }
}

static void take_out(sweep_line *s, uint32_t item)
{
    tl_sweep_item *i = &s->items[item];
    if (i->parent != TL_NOT_INDEXED) {
        tl_sweep_index_remove(&s->index, item);
    }
    if (i->neighbour[0] != TL_NO_SEGMENT) {
        s->items[i->neighbour[0]].neighbour[1] = i->neighbour[1];
    } else {
        s->lowest = i->neighbour[1];
    }
    if (i->neighbour[1] != TL_NO_SEGMENT) {
        s->items[i->neighbour[1]].neighbour[0] = i->neighbour[0];
    }
    i->parent = TL_NOT_ON_LINE;
}

// A segment on the line with a number near that of `item`, or TL_NO_SEGMENT.
static uint32_t find_finger(const sweep_line *s, uint32_t item)
{
    for (uint32_t reach = 1; reach <= FINGER_REACH; reach++) {
        if (item >= reach && s->items[item - reach].parent != TL_NOT_ON_LINE) {
            return item - reach;
        }
        if (reach < s->count - item && s->items[item + reach].parent != TL_NOT_ON_LINE) {
            return item + reach;
        }
    }
    return TL_NO_SEGMENT;
}

// Goes along the list to the segments next below and above a point where none begins yet. False: it is not near, or a
// segment runs through it.
static bool locate_near(const sweep_line *s, tl_lattice_point p, uint32_t item, uint32_t around[2])
{
    uint32_t at = find_finger(s, item), last = TL_NO_SEGMENT;
    int side = 0;
    for (uint32_t steps = 0; steps <= FINGER_STEPS && at != TL_NO_SEGMENT; steps++) {
        const int64_t turn = tl_turn(s->items[at].begin, s->items[at].end, p);
        if (turn == 0) {
            return false;
        }
        if (last != TL_NO_SEGMENT && (turn > 0) != side) {
            around[!side] = last;
            around[side] = at;
            return true;
        }
        side = turn > 0;
        last = at;
        at = s->items[at].neighbour[side];
    }
    around[!side] = last;
    around[side] = TL_NO_SEGMENT;
    return at == TL_NO_SEGMENT && last != TL_NO_SEGMENT; // it lies beyond the last one
}

// > 0: a segment on the line is below one from p to `target`; 0: it runs through p, or along that one.
static int64_t side_of_segment(const tl_sweep_item *i, tl_lattice_point p, tl_lattice_point target)
{
    // On the left lies what is above.
    return tl_same_point(i->begin, p) ? tl_turn(p, i->end, target) : tl_turn(i->begin, i->end, p);
}

// The segments next below and above where one from p to `target` begins. False: one runs through p or along that
// segment.
static bool locate(sweep_line *s, tl_lattice_point p, tl_lattice_point target, uint32_t around[2])
{
    uint32_t indexed = TL_NO_SEGMENT; // the last one below in the tree
    for (uint32_t item = s->index.root; item != TL_NO_SEGMENT;) {
        const int64_t side = side_of_segment(&s->items[item], p, target);
        if (side == 0) {
            return false;
        }
        indexed = side > 0 ? item : indexed;
        item = s->items[item].child[side > 0];
    }
    around[0] = indexed;
    around[1] = indexed != TL_NO_SEGMENT ? s->items[indexed].neighbour[1] : s->lowest;
    for (uint32_t steps = 1; around[1] != TL_NO_SEGMENT; steps++) {
        const int64_t side = side_of_segment(&s->items[around[1]], p, target);
        if (side <= 0) {
            return side < 0;
        }
        around[0] = around[1];
        around[1] = s->items[around[1]].neighbour[1];
        if (steps % INDEX_STEPS == 0) {
            tl_sweep_index_add(&s->index, indexed, around[0]);
            indexed = around[0];
        }
    }
    return true;
}

// Neighbours that do not share an end and meet.
static bool clash(const sweep_line *s, uint32_t below, uint32_t above)
{
    if (below == TL_NO_SEGMENT || above == TL_NO_SEGMENT) {
        return false;
    }
    const tl_sweep_item *i = &s->items[below];
    const tl_sweep_item *j = &s->items[above];
    tl_lattice_point a = i->begin, b = i->end, c = j->begin, d = j->end;
    if (tl_same_point(a, c) || tl_same_point(a, d) || tl_same_point(b, c) || tl_same_point(b, d)) {
        // Should they overlap, an end of one lies inside the other and is found there.
        return false;
    }
    // Both are in order now; they meet when the one that ends first ends on the wrong side of the other, or on it.
    return tl_is_swept_first(b, d) ? tl_turn(c, d, b) >= 0 : tl_turn(a, b, d) <= 0;
}

// Takes out the segments that end in a point. Those next to the last one, after the others are gone, are next to the
// point, unless a segment that runs through the point stood between them: then it is one of them. Returns how many.
static uint32_t end_segments(sweep_line *s, const sweep_star *star, uint32_t around[2])
{
    uint32_t ended = 0;
    for (uint32_t k = 0; k < star->count; k++) {
        const tl_sweep_item *i = &s->items[star->segments[k]];
        if (tl_same_point(i->end, star->point)) {
            around[0] = i->neighbour[0];
            around[1] = i->neighbour[1];
            take_out(s, star->segments[k]);
            ended++;
        }
    }
    return ended;
}

static bool runs_through(const sweep_line *s, uint32_t item, tl_lattice_point point)
{
    return item != TL_NO_SEGMENT && tl_turn(s->items[item].begin, s->items[item].end, point) == 0;
}

// Where to put one of two segments that begin in a point, the other one being there. False: one runs along the other.
static bool locate_beside(const sweep_line *s, uint32_t other, uint32_t item, uint32_t around[2])
{
    const tl_sweep_item *o = &s->items[other];
    int64_t turn = tl_turn(o->begin, o->end, s->items[item].end);
    around[0] = turn > 0 ? other : o->neighbour[0];
    around[1] = turn > 0 ? o->neighbour[1] : other;
    return turn != 0;
}

// Puts in the segments that begin in a point; around[] is known where others ended there. False: a contact.
static bool begin_segments(sweep_line *s, const sweep_star *star, uint32_t around[2], bool is_located)
{
    const tl_lattice_point p = star->point;
    uint32_t begun = 0, first = TL_NO_SEGMENT;
    for (uint32_t k = 0; k < star->count; k++) {
        const uint32_t item = star->segments[k];
        if (!tl_same_point(s->items[item].begin, p)) {
            continue;
        }
        bool apart = begun == 1   ? locate_beside(s, first, item, around)
                     : begun > 1  ? locate(s, p, s->items[item].end, around)
                     : is_located ? true
                                  : locate_near(s, p, item, around) || locate(s, p, s->items[item].end, around);
        if (!apart) {
            return false;
        }
        if (begun == 0 && !is_located && s->below != NULL) {
            *s->below = around[0];
        }
        insert_between(s, item, around[0], around[1]);
        first = begun == 0 ? item : first;
        begun++;
    }
    for (uint32_t k = 0; k < star->count && begun > 0; k++) {
        const uint32_t item = star->segments[k];
        if (tl_same_point(s->items[item].begin, p) &&
            (clash(s, s->items[item].neighbour[0], item) || clash(s, item, s->items[item].neighbour[1]))) {
            return false;
        }
    }
    return begun > 0 || !clash(s, around[0], around[1]);
}

// Flipping the sign bits makes the unsigned order the signed one.
static uint64_t sweep_key(tl_lattice_point p)
{
    const uint64_t x = (uint32_t)p.x ^ 0x80000000u, z = (uint32_t)p.z ^ 0x80000000u;
    return x << 32 | z;
}

static tl_lattice_point point_of_key(uint64_t key)
{
    const tl_lattice_point p = { (int32_t)((uint32_t)(key >> 32) ^ 0x80000000u),
                                 (int32_t)((uint32_t)key ^ 0x80000000u) };
    return p;
}

// False: a contact at the point, or of segments that have become neighbours there. All points are ends of segments.
static bool pass_point(sweep_line *s, const tl_sort_item *point)
{
    uint32_t around[2] = { TL_NO_SEGMENT, TL_NO_SEGMENT };
    sweep_star star;
    star.point = point_of_key(point->key);
    find_star(s, point->value, &star);
    const uint32_t ended = end_segments(s, &star, around);
    if (ended > 0 && (runs_through(s, around[0], star.point) || runs_through(s, around[1], star.point))) {
        return false;
    }
    if (ended > 0 && s->below != NULL) {
        *s->below = around[0];
    }
    return begin_segments(s, &star, around, ended > 0);
}

static void init_sweep_item(tl_sweep_item *item, tl_lattice_point a, tl_lattice_point b)
{
    const bool forward = tl_is_swept_first(a, b);
    item->begin = forward ? a : b;
    item->end = forward ? b : a;
    item->parent = TL_NOT_ON_LINE;
}

// A counting sort of segments by point; first[] is shifted by one while it is filled.
static bool gather_stars(sweep_line *s, tl_arena *arena, uint32_t point_count, const tl_lattice_segment *segments)
{
    const uint64_t end_count = 2 * (uint64_t)s->count;
    s->around = TL_PUSH(arena, uint32_t, end_count + 2); // two are fetched of each point, however few it has
    s->first = TL_PUSH_ZERO(arena, uint32_t, (uint64_t)point_count + 2);
    if (s->around == NULL || s->first == NULL) {
        return false;
    }
    s->around[end_count] = s->around[end_count + 1] = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        s->first[segments[i].a + 2]++;
        s->first[segments[i].b + 2]++;
    }
    for (uint32_t p = 0; p < point_count; p++) {
        s->first[p + 2] += s->first[p + 1];
    }
    for (uint32_t i = 0; i < s->count; i++) {
        s->around[s->first[segments[i].a + 1]++] = i;
        s->around[s->first[segments[i].b + 1]++] = i;
    }
    return true;
}

static bool gather_sweep_segments(sweep_line *s, tl_arena *arena, const tl_lattice_point *points, uint32_t point_count,
                                  const tl_lattice_segment *segments, uint32_t count)
{
    s->items = TL_PUSH(arena, tl_sweep_item, count);
    s->lowest = TL_NO_SEGMENT;
    s->index = (tl_sweep_index){ s->items, TL_NO_SEGMENT, 0, 0 };
    s->count = count;
    s->first = s->around = NULL;
    if (s->items == NULL || (segments != NULL && !gather_stars(s, arena, point_count, segments))) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = i + 1 < count ? i + 1 : 0;
        init_sweep_item(&s->items[i], points[segments != NULL ? segments[i].a : i],
                        points[segments != NULL ? segments[i].b : next]);
    }
    return true;
}

// The two segments at a point of an outline, and some before and after them, which are likely to stand beside them.
static TL_ALWAYS_INLINE void fetch_items(const sweep_line *s, uint32_t point)
{
    const uint32_t first = point > ITEMS_AROUND ? point - ITEMS_AROUND : 0;
    if (2 * ITEMS_AROUND < s->count - first) {
        const char *begin = (const char *)&s->items[first], *end = (const char *)&s->items[first + 2 * ITEMS_AROUND];
        for (const char *line = begin; line < end; line += 64) {
            tl_prefetch(line);
        }
    }
}

// Points come from anywhere in the outline. What leads to their segments is fetched in steps, each of which reads what
// the step before has fetched.
static TL_ALWAYS_INLINE void fetch_points_ahead(const sweep_line *s, const tl_sort_item *order, uint32_t count)
{
    if (3 * POINTS_AHEAD >= count) {
        return;
    }
    if (s->first == NULL) {
        fetch_items(s, order[POINTS_AHEAD].value);
        return;
    }
    tl_prefetch(&s->first[order[3 * POINTS_AHEAD].value]);
    tl_prefetch(&s->around[s->first[order[2 * POINTS_AHEAD].value]]);
    const uint32_t *around = &s->around[s->first[order[POINTS_AHEAD].value]];
    tl_prefetch(&s->items[around[0]]);
    tl_prefetch(&s->items[around[1]]);
}

bool tl_sweep_record_init(tl_sweep_record *record, tl_arena *arena, uint32_t point_count)
{
    record->order = TL_PUSH(arena, uint32_t, point_count);
    record->below = TL_PUSH(arena, uint32_t, point_count);
    return record->order != NULL && record->below != NULL;
}

tl_result tl_sweep_segments(tl_arena *arena, const tl_lattice_point *points, uint32_t point_count,
                            const tl_lattice_segment *segments, uint32_t segment_count, tl_sweep_record *record,
                            bool *apart_out)
{
    tl_sort_item *order = TL_PUSH(arena, tl_sort_item, 2 * (uint64_t)point_count);
    if (order == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < point_count; p++) {
        const tl_sort_item item = { sweep_key(points[p]), p, 0 };
        order[p] = item;
    }
    tl_radix_sort(order, order + point_count, point_count);
    *apart_out = true;
    for (uint32_t i = 1; i < point_count && *apart_out; i++) {
        *apart_out = order[i].key != order[i - 1].key;
    }
    sweep_line s;
    if (*apart_out && !gather_sweep_segments(&s, arena, points, point_count, segments, segment_count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < point_count && *apart_out; i++) {
        fetch_points_ahead(&s, order + i, point_count - i);
        s.below = NULL;
        if (record != NULL) {
            record->order[i] = order[i].value;
            s.below = &record->below[i];
        }
        *apart_out = pass_point(&s, &order[i]);
    }
    return TL_OK;
}
