// SPDX-License-Identifier: MIT
//
// Anchors: each end of an off-mesh link stands on the polygon nearest to it, among the tiles that are there now.
//
// When a tile comes or goes, ends whose box touches it are looked up anew. All links are visited for that, a box
// each: some nanoseconds beside the making of the tile's rings. An index by place would make that less for thousands of
// links, and every link pay for it.

#include "nav_query/navmesh/offmesh_anchor.h"

#include <math.h>

static void put_in_bucket(tl_nav_offmesh_table *table, uint32_t end)
{
    tl_nav_anchor *anchor = &table->entries[end / 2].ends[end % 2];
    uint32_t *bucket = &table->buckets[tl_nav_anchor_bucket(table, anchor->slot, anchor->polygon)];
    anchor->next = *bucket;
    *bucket = end;
}

void tl_nav_fill_buckets(tl_nav_offmesh_table *table)
{
    for (uint32_t i = 0; i < 2 * table->capacity; i++) {
        table->buckets[i] = TL_NAV_NO_END;
    }
    for (uint32_t end = 0; end < 2 * table->used; end++) {
        if (table->entries[end / 2].is_used && table->entries[end / 2].ends[end % 2].slot != TL_NAV_NO_SLOT) {
            put_in_bucket(table, end);
        }
    }
}

// Tells searches under way: those that have seen one of the ends, and where a short cut comes or goes, all, since no
// estimate so far knew of it.
static void note_edit(tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry)
{
    for (int i = 0; i < 2; i++) {
        const tl_nav_tile *tile = navmesh->slots[entry->ends[i].slot].tile;
        if (tile != NULL) {
            tl_nav_begin_edit(navmesh, tile->tile_x, tile->tile_z);
            tl_nav_note_edit(navmesh, entry->ends[i].slot);
        }
    }
    for (uint32_t slot = 0; slot < navmesh->slot_count && entry->short_at != UINT32_MAX; slot++) {
        tl_nav_note_edit(navmesh, slot);
    }
}

// After both ends are anchored: what the link counts, and whether that is less than its length.
static void open_link(tl_navmesh *navmesh, uint32_t index)
{
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    tl_nav_offmesh_entry *entry = &table->entries[index];
    tl_vec3 a = entry->ends[0].point;
    tl_vec3 b = entry->ends[1].point;
    double x = (double)b.x - (double)a.x;
    double y = (double)b.y - (double)a.y;
    double z = (double)b.z - (double)a.z;
    double length = sqrt(x * x + z * z + y * y);
    entry->cost = (double)entry->offmesh.fixed_cost + (double)entry->offmesh.cost_factor * length;
    if (entry->cost < length) {
        entry->short_at = table->short_count;
        table->short_cuts[table->short_count++] = index;
    }
    navmesh->link_count += entry->offmesh.both_ways ? 2 : 1;
    note_edit(navmesh, entry);
}

static void close_link(tl_navmesh *navmesh, uint32_t index)
{
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    tl_nav_offmesh_entry *entry = &table->entries[index];
    note_edit(navmesh, entry);
    if (entry->short_at != UINT32_MAX) {
        uint32_t last = table->short_cuts[--table->short_count];
        table->short_cuts[entry->short_at] = last;
        table->entries[last].short_at = entry->short_at;
        entry->short_at = UINT32_MAX;
    }
    navmesh->link_count -= entry->offmesh.both_ways ? 2 : 1;
}

// Takes an end off its polygon, if it is on one.
static void release(tl_navmesh *navmesh, uint32_t end)
{
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    tl_nav_offmesh_entry *entry = &table->entries[end / 2];
    tl_nav_anchor *anchor = &entry->ends[end % 2];
    if (anchor->slot == TL_NAV_NO_SLOT) {
        return;
    }
    tl_nav_touch_offmesh(navmesh->history);
    tl_nav_touch_slot(navmesh, anchor->slot);
    if (tl_nav_is_anchored(entry)) {
        close_link(navmesh, end / 2);
    }
    uint32_t *at = &table->buckets[tl_nav_anchor_bucket(table, anchor->slot, anchor->polygon)];
    while (*at != end) {
        at = &table->entries[*at / 2].ends[*at % 2].next;
    }
    *at = anchor->next;
    navmesh->slots[anchor->slot].anchor_count--;
    anchor->slot = TL_NAV_NO_SLOT;
}

// Puts an end that is nowhere on the polygon nearest to it, if there is one.
static void anchor_end(tl_navmesh *navmesh, uint32_t end)
{
    tl_nav_offmesh_entry *entry = &navmesh->offmesh.entries[end / 2];
    float radius = entry->offmesh.radius;
    tl_nav_location found;
    // Flags change while the game runs; anchors are to depend on the tiles alone.
    if (tl_nav_find_nearest_of_any_flags(navmesh, end % 2 == 0 ? entry->offmesh.start : entry->offmesh.end,
                                         tl_vec3_make(radius, radius, radius), &found) != TL_OK) {
        return;
    }
    tl_nav_anchor *anchor = &entry->ends[end % 2];
    tl_nav_split_ref(navmesh, found.polygon, &anchor->slot, &anchor->polygon);
    tl_nav_touch_offmesh(navmesh->history);
    tl_nav_touch_slot(navmesh, anchor->slot);
    anchor->point = found.point;
    put_in_bucket(&navmesh->offmesh, end);
    navmesh->slots[anchor->slot].anchor_count++;
    if (tl_nav_is_anchored(entry)) {
        open_link(navmesh, end / 2);
    }
}

void tl_nav_anchor_link(tl_navmesh *navmesh, uint32_t index)
{
    anchor_end(navmesh, 2 * index);
    anchor_end(navmesh, 2 * index + 1);
}

void tl_nav_release_anchors(tl_navmesh *navmesh, uint32_t index)
{
    release(navmesh, 2 * index);
    release(navmesh, 2 * index + 1);
}

// Whether an end may find a polygon of a tile.
static bool is_end_near(const tl_nav_offmesh_entry *entry, uint32_t end, const tl_nav_tile *tile)
{
    tl_vec3 center = end == 0 ? entry->offmesh.start : entry->offmesh.end;
    tl_vec3 half = tl_vec3_make(entry->offmesh.radius, entry->offmesh.radius, entry->offmesh.radius);
    tl_aabb box = { tl_sub(center, half), tl_add(center, half) };
    return tl_aabb_overlaps(box, tile->bounds);
}

// After an end has left its polygon: the link may have been all that connected two components.
static void seed_ends(tl_navmesh *navmesh, const tl_nav_anchor *before, const tl_nav_anchor *other)
{
    const tl_nav_anchor *ends[2] = { before, other };
    for (int i = 0; i < 2; i++) {
        if (navmesh->slots[ends[i]->slot].tile != NULL) {
            tl_nav_seed_island(navmesh, ends[i]->slot, ends[i]->polygon);
        }
    }
}

void tl_nav_anchor_near(tl_navmesh *navmesh, uint32_t slot, bool tile_leaves)
{
    const tl_nav_offmesh_table *table = &navmesh->offmesh;
    for (uint32_t end = 0; end < 2 * table->used; end++) {
        const tl_nav_offmesh_entry *entry = &table->entries[end / 2];
        const tl_nav_anchor *anchor = &entry->ends[end % 2];
        const tl_nav_anchor *other = &entry->ends[1 - end % 2];
        const tl_nav_anchor before = *anchor;
        bool touched = tile_leaves ? before.slot == slot : is_end_near(entry, end % 2, navmesh->slots[slot].tile);
        if (!entry->is_used || !touched) {
            continue;
        }
        bool was_anchored = tl_nav_is_anchored(entry);
        release(navmesh, end);
        anchor_end(navmesh, end);
        if (was_anchored && (anchor->slot != before.slot || anchor->polygon != before.polygon)) {
            seed_ends(navmesh, &before, other);
        }
        // While a tile leaves, the other end may still stand on it; its turn comes.
        if (tl_nav_is_anchored(entry) && navmesh->slots[other->slot].tile != NULL) {
            tl_nav_join_anchors(navmesh, entry);
        }
    }
}
