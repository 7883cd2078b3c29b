// SPDX-License-Identifier: MIT
//
// Small-region filter and merge.
//
// Filter: regions that touch are one island (connected component, by disjoint sets); an island of too few columns is
// removed, unless it reaches the tile's border, beyond which it may be large. Merge: a region that is small, or touches
// no wall, joins its smallest neighbour of the same area, if the two share one unbroken part of their outlines and do
// not overlap in the plane. Source: Mononen, Recast (rules and order).
//
// Differences from Recast: touching is mutual here (there a patch inside another region is not seen from outside, and
// is dropped as an island or kept, depending on its number); a region that lies in a hole of another and meets it in
// one stretch is merged into it, so that fewer holes are left; islands are the unit of the layers' filter too.
//
// Why it is fast here: rings are linked lists and are spliced, ids are resolved by disjoint sets, so a merge does not
// visit all regions; and overlap is looked up in the columns that have several floors, none in a level of one storey.

#include "nav_bake/regions/region_columns.h"
#include "nav_bake/regions/region_rings.h"

#include "base/assert.h"
#include "base/disjoint_sets.h"

typedef struct region_merger {
    tl_region_work *work;
    tl_region_rings rings;
    tl_region_columns columns;
    uint32_t *parent;        // union-find: the region that a region became part of, or itself
    uint32_t *next_member;   // circular list of the regions that are one now
    uint32_t *overlap_stamp; // [region] the last region for which it was found to share a column
} region_merger;

static uint32_t find_across(const region_merger *m, uint32_t region)
{
    return region == 0 || tl_region_is_border(region) ? region : tl_disjoint_sets_find(m->parent, region);
}

static void reset_parents(region_merger *m)
{
    tl_disjoint_sets_init(m->parent, m->work->region_count);
}

// Unites regions that touch; sizes and border contact are gathered at each island's root.
static void gather_islands(region_merger *m, uint32_t *island_size, uint8_t *at_border)
{
    uint32_t count = m->work->region_count;
    for (uint32_t r = 1; r < count; r++) {
        uint32_t head = m->rings.head[r];
        for (uint32_t e = head; e != TL_NO_REGION_RING;) {
            uint32_t across = m->rings.entries[e].region;
            if (across != 0 && !tl_region_is_border(across)) {
                tl_disjoint_sets_unite(m->parent, r, across);
            }
            e = m->rings.entries[e].next;
            e = e != head ? e : TL_NO_REGION_RING;
        }
    }
    for (uint32_t r = 1; r < count; r++) {
        uint32_t root = tl_disjoint_sets_find(m->parent, r), head = m->rings.head[r];
        island_size[root] += m->rings.span_count[r];
        for (uint32_t e = head; e != TL_NO_REGION_RING;) {
            at_border[root] |= tl_region_is_border(m->rings.entries[e].region);
            e = m->rings.entries[e].next;
            e = e != head ? e : TL_NO_REGION_RING;
        }
    }
}

static tl_result filter_islands(region_merger *m, uint32_t min_area)
{
    tl_region_work *work = m->work;
    uint32_t *island_size = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    uint8_t *at_border = TL_PUSH_ZERO(work->arena, uint8_t, work->region_count);
    if (island_size == NULL || at_border == NULL) {
        return TL_ERR_MEMORY;
    }
    gather_islands(m, island_size, at_border);
    for (uint32_t r = 1; r < work->region_count; r++) {
        uint32_t root = tl_disjoint_sets_find(m->parent, r);
        if (m->rings.span_count[r] > 0 && island_size[root] < min_area && !at_border[root]) {
            work->stats.filtered_regions++;
            work->stats.filtered_spans += m->rings.span_count[r];
            m->rings.span_count[r] = 0;
        }
    }
    return TL_OK;
}

// Drops entries that have become equal to the one after them.
static void normalize_ring(region_merger *m, uint32_t region)
{
    tl_ring_entry *entries = m->rings.entries;
    uint32_t head = m->rings.head[region], last = head;
    for (uint32_t e = head;;) {
        entries[e].region = find_across(m, entries[e].region);
        uint32_t next = entries[e].next;
        if (next == head) {
            last = e;
            break;
        }
        if (find_across(m, entries[next].region) == entries[e].region) {
            entries[e].next = entries[next].next;
            last = e;
            if (entries[e].next == head) {
                break;
            }
        } else {
            e = next;
        }
    }
    if (last != head && entries[last].region == entries[head].region) {
        // As Recast does, the later of the two goes.
        uint32_t before = head;
        while (entries[before].next != last) {
            before = entries[before].next;
        }
        entries[before].next = head;
    }
}

static uint32_t count_in_ring(const region_merger *m, uint32_t region, uint32_t wanted)
{
    uint32_t head = m->rings.head[region], count = 0, e = head;
    if (head == TL_NO_REGION_RING) {
        return 0;
    }
    do {
        count += m->rings.entries[e].region == wanted;
        e = m->rings.entries[e].next;
    } while (e != head);
    return count;
}

// The entry before the one that names `wanted`, which is in the ring.
static uint32_t entry_before(const region_merger *m, uint32_t region, uint32_t wanted)
{
    uint32_t e = m->rings.head[region];
    while (m->rings.entries[m->rings.entries[e].next].region != wanted) {
        e = m->rings.entries[e].next;
    }
    return e;
}

// Stamps all regions that share a column with `region` or a part of it.
static void stamp_overlapping_regions(region_merger *m, uint32_t region)
{
    const tl_nav_compact *compact = m->work->compact;
    uint32_t part = region;
    do {
        for (uint32_t k = m->columns.first[part]; k < m->columns.first[part + 1]; k++) {
            uint32_t column = m->columns.column[k];
            for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
                uint32_t other = m->work->region[i];
                if (other != part && other != 0 && !tl_region_is_border(other)) {
                    m->overlap_stamp[tl_disjoint_sets_find(m->parent, other)] = region;
                }
            }
        }
        part = m->next_member[part];
    } while (part != region);
}

// `region` becomes part of `target`; they share one stretch of outline.
static void merge_into(region_merger *m, uint32_t region, uint32_t target)
{
    tl_ring_entry *entries = m->rings.entries;
    uint32_t *head = m->rings.head;
    if (count_in_ring(m, target, region) == 1) { // else region lies in a hole of target, whose outline stays
        uint32_t in_target = entry_before(m, target, region), in_region = entry_before(m, region, target);
        uint32_t after_target = entries[entries[in_target].next].next;
        uint32_t after_region = entries[entries[in_region].next].next;
        bool target_has_more = entries[in_target].next != in_target;
        bool region_has_more = entries[in_region].next != in_region;
        if (target_has_more && region_has_more) {
            entries[in_target].next = after_region;
            entries[in_region].next = after_target;
            head[target] = after_target;
        } else if (target_has_more) {
            entries[in_target].next = after_target;
            head[target] = after_target;
        } else if (region_has_more) {
            entries[in_region].next = after_region;
            head[target] = after_region;
        } else {
            head[target] = TL_NO_REGION_RING;
        }
    }
    m->parent[region] = target;
    uint32_t member = m->next_member[region];
    m->next_member[region] = m->next_member[target];
    m->next_member[target] = member;
    m->rings.span_count[target] += m->rings.span_count[region];
    m->rings.span_count[region] = 0;
    m->work->stats.merged++;
    if (head[target] != TL_NO_REGION_RING) {
        normalize_ring(m, target);
    }
}

// The smallest neighbour that the region may join, or 0; ties go to the first in the ring.
static uint32_t choose_target(region_merger *m, uint32_t region)
{
    uint32_t head = m->rings.head[region], best = 0, smallest = UINT32_MAX, e = head;
    bool stamped = false;
    do {
        uint32_t other = m->rings.entries[e].region;
        e = m->rings.entries[e].next;
        if (other == 0 || tl_region_is_border(other) || m->rings.span_count[other] >= smallest ||
            m->rings.area[other] != m->rings.area[region] || count_in_ring(m, region, other) != 1) {
            continue;
        }
        if (m->rings.head[other] != TL_NO_REGION_RING) {
            normalize_ring(m, other);
        }
        if (count_in_ring(m, other, region) > 1) {
            continue;
        }
        if (!stamped) {
            stamp_overlapping_regions(m, region);
            stamped = true;
        }
        if (m->overlap_stamp[other] != region) {
            best = other;
            smallest = m->rings.span_count[other];
        }
    } while (e != head);
    return best;
}

static void merge_regions(region_merger *m, uint32_t merge_area)
{
    bool merged = true;
    while (merged) { // each round but the last makes one region fewer
        merged = false;
        for (uint32_t r = 1; r < m->work->region_count; r++) {
            if (m->rings.span_count[r] == 0 || m->rings.head[r] == TL_NO_REGION_RING) {
                continue;
            }
            normalize_ring(m, r);
            if (m->rings.span_count[r] > merge_area && count_in_ring(m, r, 0) > 0) {
                continue;
            }
            uint32_t target = choose_target(m, r);
            if (target != 0) {
                merge_into(m, r, target);
                merged = true;
            }
        }
    }
}

// Numbers the regions that are left from 1, in the order of their old ids.
static tl_result renumber(region_merger *m)
{
    tl_region_work *work = m->work;
    uint32_t *new_id = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
    if (new_id == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 1;
    for (uint32_t r = 1; r < work->region_count; r++) {
        uint32_t root = tl_disjoint_sets_find(m->parent, r);
        if (m->rings.span_count[root] > 0 && new_id[root] == 0) {
            new_id[root] = count++;
        }
        new_id[r] = new_id[root];
    }
    for (uint32_t z = 0; z < work->compact->height; z++) {
        const tl_inner_floors row = tl_inner_floors_of_row(work->compact, z);
        for (uint32_t i = row.begin; i < row.end; i++) {
            work->region[i] = tl_region_is_border(work->region[i]) ? work->region[i] : new_id[work->region[i]];
        }
    }
    work->region_count = count;
    return TL_OK;
}

tl_result tl_regions_filter_and_merge(tl_region_work *work, uint32_t min_area, uint32_t merge_area)
{
    region_merger m = { .work = work };
    TL_TRY(tl_region_rings_make(work, &m.rings));
    m.parent = TL_PUSH(work->arena, uint32_t, work->region_count);
    if (m.parent == NULL) {
        return TL_ERR_MEMORY;
    }
    reset_parents(&m);
    TL_TRY(filter_islands(&m, min_area));
    reset_parents(&m);
    if (merge_area != TL_REGIONS_NO_MERGE) {
        TL_TRY(tl_region_columns_make(work, &m.columns));
        m.next_member = TL_PUSH(work->arena, uint32_t, work->region_count);
        m.overlap_stamp = TL_PUSH_ZERO(work->arena, uint32_t, work->region_count);
        if (m.next_member == NULL || m.overlap_stamp == NULL) {
            return TL_ERR_MEMORY;
        }
        for (uint32_t r = 0; r < work->region_count; r++) {
            m.next_member[r] = r;
        }
        merge_regions(&m, merge_area);
    }
    return renumber(&m);
}
