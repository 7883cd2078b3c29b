// SPDX-License-Identifier: MIT
//
// From thousands of places to a few findings. Every path past a fault of the level meets it, a cell apart each time; a
// person wants to see the fault once, with its worst place and its extent.
//
// One record per cube is kept. Then cubes are made coarser, and those that touch are merged (union-find over sorted
// cubes, neighbours by binary search). Rejected: merging what lies within a distance, which needs all pairs; and one
// finding per triangle, because a wall has many triangles and a ground triangle can hold many faults.

#include "nav_audit/records.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/disjoint_sets.h"
#include "base/min_max.h"
#include "base/radix_sort.h"

#include <string.h>

enum { FIRST_RECORD_CAPACITY = 64 };

// Records whose neighbours are looked up between two calls of progress, at some us each.
enum { RECORDS_PER_CALL = 4096 };

#define MAX_RECORDS 0x7fffffffu

void tl_audit_records_free(tl_audit_records *list)
{
    tl_release_array(list->allocator, list->records, list->capacity, sizeof *list->records);
    list->records = NULL;
    list->count = list->capacity = 0;
}

static tl_result reserve_records(tl_audit_records *list, uint32_t more)
{
    if (more <= list->capacity - list->count) {
        return TL_OK;
    }
    if (more > MAX_RECORDS - list->count) {
        return TL_ERR_LIMIT;
    }
    const uint64_t wanted = (uint64_t)list->count + more, doubled = 2 * (uint64_t)list->capacity;
    const uint64_t capacity = tl_clamp_u64(tl_max_u64(wanted, doubled), FIRST_RECORD_CAPACITY, MAX_RECORDS);
    tl_audit_record *records = tl_allocate_array(list->allocator, capacity, sizeof *records);
    if (records == NULL) {
        return TL_ERR_MEMORY;
    }
    if (list->count > 0) {
        memcpy(records, list->records, list->count * sizeof *records);
    }
    tl_release_array(list->allocator, list->records, list->capacity, sizeof *records);
    list->records = records;
    list->capacity = (uint32_t)capacity;
    return TL_OK;
}

tl_result tl_audit_records_add(tl_audit_records *list, const tl_audit_record *record)
{
    TL_TRY(reserve_records(list, 1));
    list->records[list->count++] = *record;
    return TL_OK;
}

tl_result tl_audit_records_append(tl_audit_records *list, const tl_audit_records *more)
{
    TL_TRY(reserve_records(list, more->count));
    if (more->count > 0) {
        memcpy(list->records + list->count, more->records, more->count * sizeof *more->records);
    }
    list->count += more->count;
    return TL_OK;
}

// ---- Cubes in order ----------------------------------------------------------------------------------------

// A kind and a cube, as two words that sort by kind, z, x, y.
typedef struct cube_key {
    uint64_t high, low;
} cube_key;

static uint32_t order_preserving(int64_t coordinate)
{
    return (uint32_t)(coordinate + ((int64_t)1 << 31));
}

static int64_t floor_divide(int64_t a, int64_t b)
{
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

// The key of the coarse cube of a record, moved by some coarse cubes.
static cube_key cube_key_of(const tl_audit_record *record, uint32_t reach, const int32_t moved[3])
{
    uint32_t place[3];
    for (int i = 0; i < 3; i++) {
        place[i] = order_preserving(floor_divide(record->cube[i], reach) + moved[i]);
    }
    cube_key key = { (uint64_t)record->kind << 32 | place[2], (uint64_t)place[0] << 32 | place[1] };
    return key;
}

static int compare_keys(cube_key a, cube_key b)
{
    return a.high != b.high ? (a.high < b.high ? -1 : 1) : a.low != b.low ? (a.low < b.low ? -1 : 1) : 0;
}

static const int32_t NOT_MOVED[3] = { 0, 0, 0 };

// The order of the records by their coarse cubes; stable. `items` holds 2 * count.
static tl_result sort_by_cube(const tl_audit_records *list, uint32_t reach, tl_sort_item *items)
{
    for (int word = 0; word < 2; word++) {
        for (uint32_t i = 0; i < list->count; i++) {
            const uint32_t value = word == 0 ? i : items[i].value;
            const cube_key key = cube_key_of(&list->records[value], reach, NOT_MOVED);
            items[i].key = word == 0 ? key.low : key.high;
            items[i].value = value;
            items[i].extra = 0;
        }
        TL_TRY(tl_radix_sort_in_stage(items, items + list->count, list->count, list->stage));
    }
    return TL_OK;
}

tl_result tl_audit_records_thin(tl_audit_records *list)
{
    const uint64_t room = 2 * (uint64_t)list->count;
    tl_sort_item *items = tl_allocate_array(list->allocator, room, sizeof *items);
    tl_audit_record *kept = tl_allocate_array(list->allocator, list->count, sizeof *kept);
    const uint32_t capacity = list->count;
    tl_result result = items != NULL && kept != NULL ? sort_by_cube(list, 1, items) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < list->count; i++) {
            const tl_audit_record *record = &list->records[items[i].value];
            const bool same = count > 0 && compare_keys(cube_key_of(&kept[count - 1], 1, NOT_MOVED),
                                                        cube_key_of(record, 1, NOT_MOVED)) == 0;
            if (!same) {
                kept[count++] = *record;
            } else if (record->depth > kept[count - 1].depth) {
                kept[count - 1] = *record;
            }
        }
        tl_audit_record *old = list->records;
        tl_release_array(list->allocator, old, list->capacity, sizeof *old);
        list->records = kept;
        list->count = count;
        list->capacity = capacity;
    } else {
        tl_release_array(list->allocator, kept, capacity, sizeof *kept);
    }
    tl_release_array(list->allocator, items, room, sizeof *items);
    return result;
}

// ---- Groups ------------------------------------------------------------------------------------------------

// The records in the order of their coarse cubes, and which of them belong together.
typedef struct grouping {
    const tl_audit_records *list;
    uint32_t reach;
    tl_sort_item *order; // [2 * count]
    uint32_t *parents;   // [count] disjoint sets, by place in the order
} grouping;

static cube_key key_at(const grouping *g, uint32_t at)
{
    return cube_key_of(&g->list->records[g->order[at].value], g->reach, NOT_MOVED);
}

// The first record of a cube, or count.
static uint32_t find_cube(const grouping *g, cube_key key)
{
    uint32_t low = 0, high = g->list->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (compare_keys(key_at(g, middle), key) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < g->list->count && compare_keys(key_at(g, low), key) == 0 ? low : g->list->count;
}

// Each cube with the 13 of its neighbours that come before it in the order.
static tl_result unite_cubes(const grouping *g)
{
    for (uint32_t i = 0; i < g->list->count; i++) {
        if (i % RECORDS_PER_CALL == RECORDS_PER_CALL - 1) {
            TL_TRY(tl_stage_add(g->list->stage, 0));
        }
        if (i > 0 && compare_keys(key_at(g, i - 1), key_at(g, i)) == 0) {
            tl_disjoint_sets_unite(g->parents, i - 1, i);
            continue;
        }
        for (int32_t neighbour = 0; neighbour < 13; neighbour++) {
            const int32_t moved[3] = { neighbour / 3 % 3 - 1, neighbour % 3 - 1, neighbour / 9 - 1 };
            const uint32_t other = find_cube(g, cube_key_of(&g->list->records[g->order[i].value], g->reach, moved));
            if (other < g->list->count) {
                tl_disjoint_sets_unite(g->parents, other, i);
            }
        }
    }
    return TL_OK;
}

static void take_record(tl_nav_finding *finding, const tl_audit_record *record)
{
    finding->triangle = record->triangle;
    finding->polygon = record->depth > 0.0f || finding->polygon == TL_NAV_NO_REF ? record->polygon : finding->polygon;
    finding->point = record->point;
    finding->contact = record->contact;
    finding->depth = record->depth;
}

static void add_record(tl_nav_finding *finding, const tl_audit_record *record)
{
    if (finding->count == 0) {
        memset(finding, 0, sizeof *finding);
        finding->kind = record->kind;
        finding->bounds = tl_aabb_empty();
        take_record(finding, record);
    } else if (record->depth > finding->depth) {
        take_record(finding, record);
    }
    finding->polygon = finding->polygon != TL_NAV_NO_REF ? finding->polygon : record->polygon;
    finding->count++;
    finding->bounds = tl_aabb_add_point(finding->bounds, record->point);
}

// Missing floors have no depth: the record nearest to the middle of the box represents them.
static void move_to_middle(tl_nav_finding *finding, const tl_audit_record *record)
{
    const tl_vec3 middle = tl_aabb_center(finding->bounds);
    if (finding->depth == 0.0f && tl_distance_sq(record->point, middle) < tl_distance_sq(finding->point, middle)) {
        take_record(finding, record);
    }
}

static uint32_t number_groups(const grouping *g)
{
    uint32_t groups = 0;
    for (uint32_t i = 0; i < g->list->count; i++) {
        const uint32_t root = tl_disjoint_sets_find(g->parents, i); // the lowest of its group: it is numbered already
        g->order[i].extra = root == i ? groups++ : g->order[root].extra;
    }
    return groups;
}

static tl_result fill_findings(const grouping *g, uint32_t count, tl_nav_finding *findings)
{
    const tl_audit_records *list = g->list;
    memset(findings, 0, count * sizeof *findings);
    for (uint32_t i = 0; i < list->count; i++) {
        add_record(&findings[g->order[i].extra], &list->records[g->order[i].value]);
    }
    TL_TRY(tl_stage_add(list->stage, 0));
    for (uint32_t i = 0; i < list->count; i++) {
        move_to_middle(&findings[g->order[i].extra], &list->records[g->order[i].value]);
    }
    return tl_stage_add(list->stage, 0);
}

tl_result tl_audit_records_cluster(const tl_audit_records *list, uint32_t reach, tl_nav_finding **findings_out,
                                   uint32_t *count_out)
{
    const uint64_t room = 2 * (uint64_t)list->count;
    grouping g = { list, reach, tl_allocate_array(list->allocator, room, sizeof *g.order),
                   tl_allocate_array(list->allocator, list->count, sizeof *g.parents) };
    *findings_out = NULL;
    *count_out = 0;
    tl_result result = g.order != NULL && g.parents != NULL ? sort_by_cube(list, reach, g.order) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        tl_disjoint_sets_init(g.parents, list->count);
        result = unite_cubes(&g);
    }
    if (result == TL_OK) {
        const uint32_t groups = number_groups(&g);
        tl_nav_finding *findings = tl_allocate_array(list->allocator, groups, sizeof *findings);
        result = findings != NULL ? fill_findings(&g, groups, findings) : TL_ERR_MEMORY;
        *findings_out = findings;
        *count_out = groups;
    }
    tl_release_array(list->allocator, g.order, room, sizeof *g.order);
    tl_release_array(list->allocator, g.parents, list->count, sizeof *g.parents);
    return result;
}
