// SPDX-License-Identifier: MIT
//
// The table of off-mesh links: adding, removing, looking up.
//
// Other navmeshes keep a link in the tile under its start and connect it to neighbours of that tile as it comes in.
// Such a link is lost when the tile under its end comes later or goes, is limited to one tile's reach, and changes with
// a tile only. Here links belong to the navmesh and are anchored by their places (offmesh_anchor.c).

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/plane/surface.h"

#include <string.h>

enum { FIRST_LINKS = 16, WALKABLE_AREA = 63 };

tl_nav_offmesh tl_default_nav_offmesh(void)
{
    tl_nav_offmesh offmesh;
    memset(&offmesh, 0, sizeof offmesh);
    offmesh.radius = 0.5f;
    offmesh.cost_factor = 1.0f;
    offmesh.flags = 1;
    offmesh.area = WALKABLE_AREA;
    offmesh.cookie = TL_DEF_COOKIE;
    return offmesh;
}

void tl_nav_free_offmesh(tl_navmesh *navmesh)
{
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    tl_release_array(&navmesh->allocator, table->entries, table->capacity, sizeof *table->entries);
    tl_release_array(&navmesh->allocator, table->buckets, 2 * (uint64_t)table->capacity, sizeof *table->buckets);
    tl_release_array(&navmesh->allocator, table->short_cuts, table->capacity, sizeof *table->short_cuts);
    memset(table, 0, sizeof *table);
}

// Twice the room; ends move to the new buckets.
static tl_result grow_offmesh(tl_navmesh *navmesh)
{
    tl_nav_offmesh_table old = navmesh->offmesh;
    if (old.capacity >= TL_NAV_MAX_OFFMESH) {
        return TL_ERR_LIMIT;
    }
    tl_nav_offmesh_table table = old;
    table.capacity = old.capacity > 0 ? 2 * old.capacity : FIRST_LINKS;
    TL_TRY(tl_nav_reserve_seeds(navmesh, 0, table.capacity));
    table.entries = tl_allocate_array(&navmesh->allocator, table.capacity, sizeof *table.entries);
    table.buckets = tl_allocate_array(&navmesh->allocator, 2 * (uint64_t)table.capacity, sizeof *table.buckets);
    table.short_cuts = tl_allocate_array(&navmesh->allocator, table.capacity, sizeof *table.short_cuts);
    navmesh->offmesh = table;
    if (table.entries == NULL || table.buckets == NULL || table.short_cuts == NULL) {
        tl_nav_free_offmesh(navmesh);
        navmesh->offmesh = old;
        return TL_ERR_MEMORY;
    }
    if (old.capacity > 0) {
        memcpy(table.entries, old.entries, old.used * sizeof *table.entries);
        memcpy(table.short_cuts, old.short_cuts, old.short_count * sizeof *table.short_cuts);
        navmesh->offmesh = old;
        tl_nav_free_offmesh(navmesh);
        navmesh->offmesh = table;
    } else {
        navmesh->offmesh.free = UINT32_MAX;
    }
    tl_nav_fill_buckets(&navmesh->offmesh);
    tl_nav_touch_offmesh(navmesh->history);
    return TL_OK;
}

tl_result tl_navmesh_reserve_offmesh(tl_navmesh *navmesh, uint32_t count)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    while ((uint64_t)navmesh->offmesh.used + count > navmesh->offmesh.capacity) {
        TL_TRY(grow_offmesh(navmesh));
    }
    return TL_OK;
}

static tl_result check_length(float value, const char *field, tl_report *report)
{
    if (!isfinite(value)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, field, "use finite numbers");
    }
    return value >= 0.0f ? TL_OK : tl_report_field(report, TL_ERR_ARGUMENT, field, "make it >= 0");
}

static tl_result check_offmesh(const tl_nav_offmesh *offmesh, tl_report *report)
{
    TL_TRY(tl_def_check(offmesh->cookie, "begin with tl_default_nav_offmesh()", report));
    const bool has_start = tl_nav_is_finite(offmesh->start);
    if (!has_start || !tl_nav_is_finite(offmesh->end)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, has_start ? "end" : "start", "use finite numbers");
    }
    TL_TRY(check_length(offmesh->radius, "radius", report));
    TL_TRY(check_length(offmesh->cost_factor, "cost_factor", report));
    TL_TRY(check_length(offmesh->fixed_cost, "fixed_cost", report));
    if (offmesh->flags == 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "flags", "set a flag: no filter passes 0");
    }
    return TL_OK;
}

tl_result tl_navmesh_add_offmesh(tl_navmesh *navmesh, const tl_nav_offmesh *offmesh, tl_nav_ref *link_out,
                                 tl_report *report)
{
    tl_report_begin(report, "off-mesh link");
    TL_REFUSE_NULL(link_out, report);
    *link_out = TL_NAV_NO_REF;
    TL_REFUSE_NULL(navmesh, report);
    TL_REFUSE_NULL(offmesh, report);
    TL_TRY(check_offmesh(offmesh, report));
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    bool is_full = table->used == table->capacity && (table->capacity == 0 || table->free == UINT32_MAX);
    if (is_full) {
        TL_TRY(grow_offmesh(navmesh));
    }
    tl_nav_touch_offmesh(navmesh->history);
    uint32_t index = table->free != UINT32_MAX ? table->free : table->used++;
    tl_nav_offmesh_entry *entry = &table->entries[index];
    if (index == table->free) {
        table->free = entry->next;
    } else {
        memset(entry, 0, sizeof *entry);
        entry->salt = 1;
    }
    entry->offmesh = *offmesh;
    entry->is_used = true;
    entry->short_at = UINT32_MAX;
    entry->ends[0].slot = TL_NAV_NO_SLOT;
    entry->ends[1].slot = TL_NAV_NO_SLOT;
    table->count++;
    tl_nav_count_flags(&navmesh->flags, offmesh->flags, 1);
    tl_nav_settle_flags(&navmesh->flags);
    tl_nav_anchor_link(navmesh, index);
    if (tl_nav_is_anchored(entry)) {
        tl_nav_join_anchors(navmesh, entry);
    }
    *link_out = tl_nav_offmesh_ref(table, 2 * index);
    return TL_OK;
}

tl_result tl_navmesh_remove_offmesh(tl_navmesh *navmesh, tl_nav_ref link)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_offmesh_table *table = &navmesh->offmesh;
    tl_nav_offmesh_entry *entry = tl_nav_find_offmesh(table, link);
    if (entry == NULL) {
        return TL_ERR_STALE;
    }
    if (tl_nav_is_anchored(entry) && !tl_nav_is_same_component(navmesh, entry)) {
        tl_nav_seed_island(navmesh, entry->ends[0].slot, entry->ends[0].polygon);
        tl_nav_seed_island(navmesh, entry->ends[1].slot, entry->ends[1].polygon);
    }
    tl_nav_touch_offmesh(navmesh->history);
    uint32_t index = (uint32_t)(entry - table->entries);
    tl_nav_release_anchors(navmesh, index);
    tl_nav_count_flags(&navmesh->flags, entry->offmesh.flags, -1);
    tl_nav_settle_flags(&navmesh->flags);
    entry->is_used = false;
    table->count--;
    if (entry->salt < TL_NAV_LAST_LINK_SALT) {
        entry->salt++;
        entry->next = table->free;
        table->free = index;
    }
    tl_nav_split_islands(navmesh);
    return TL_OK;
}

tl_result tl_navmesh_offmesh_state(const tl_navmesh *navmesh, tl_nav_ref link, tl_nav_offmesh_state *state_out)
{
    if (state_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(state_out, 0, sizeof *state_out);
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_offmesh_entry *entry = tl_nav_find_offmesh(&navmesh->offmesh, link);
    if (entry == NULL) {
        return TL_ERR_STALE;
    }
    state_out->offmesh = entry->offmesh;
    for (int i = 0; i < 2; i++) {
        const tl_nav_anchor *anchor = &entry->ends[i];
        if (anchor->slot != TL_NAV_NO_SLOT) {
            state_out->ends[i].polygon = tl_nav_make_ref(navmesh, anchor->slot, anchor->polygon);
            state_out->ends[i].point = anchor->point;
        }
    }
    state_out->anchored = tl_nav_is_anchored(entry);
    if (state_out->anchored) {
        state_out->length = tl_distance(entry->ends[0].point, entry->ends[1].point);
        state_out->cost = (float)entry->cost;
    }
    return TL_OK;
}

uint32_t tl_navmesh_offmesh_count(const tl_navmesh *navmesh)
{
    return navmesh->offmesh.count;
}

bool tl_navmesh_next_offmesh(const tl_navmesh *navmesh, uint32_t *cursor, tl_nav_ref *link_out)
{
    const tl_nav_offmesh_table *table = &navmesh->offmesh;
    while (*cursor < table->used) {
        uint32_t index = (*cursor)++;
        if (table->entries[index].is_used) {
            *link_out = tl_nav_offmesh_ref(table, 2 * index);
            return true;
        }
    }
    *link_out = TL_NAV_NO_REF;
    return false;
}

tl_result tl_navmesh_offmesh_from(const tl_navmesh *navmesh, tl_nav_ref polygon, tl_nav_ref *links_out,
                                  uint32_t capacity, uint32_t *count_out)
{
    uint32_t slot = 0;
    uint32_t index = 0;
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (navmesh == NULL || (links_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &index)) {
        return TL_ERR_STALE;
    }
    for (uint32_t end = tl_nav_first_anchor(navmesh, slot, index); end != TL_NAV_NO_END;) {
        const tl_nav_offmesh_entry *entry = &navmesh->offmesh.entries[end / 2];
        const tl_nav_anchor *anchor = &entry->ends[end % 2];
        if (anchor->slot == slot && anchor->polygon == index && tl_nav_may_cross(entry, end % 2, NULL)) {
            if (*count_out < capacity) {
                links_out[*count_out] = tl_nav_offmesh_ref(&navmesh->offmesh, end);
            }
            (*count_out)++;
        }
        end = anchor->next;
    }
    return *count_out <= capacity ? TL_OK : TL_INCOMPLETE;
}
