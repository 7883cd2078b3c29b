// SPDX-License-Identifier: MIT
//
// Bringing a version's arrays up to date: page by page, those that were changed since.
//
// Queries index the table of tiles and the islands directly, so each version has these arrays to itself: some hundred
// bytes a tile. What tiles and links derive, which is as large as the tiles, hangs on them by pointers, and is shared.
// A version that nobody reads any more becomes the next draft: it lacks what was changed in the one or two versions
// since, which stamps of the pages tell. The table of off-mesh links is copied whole where one of them has changed:
// each change of a tile looks at all of them anyway.

#include "nav_query/versions/catch_up.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

enum {
    SLOTS,
    BUCKETS,
    AREA_SUMS,
    ISLAND_NODES,
    ISLAND_LABELS, // of both kinds
    LINK_ENTRIES,
    LINK_BUCKETS,
    SHORT_CUTS,
    VERSION_ARRAYS
};

typedef struct version_array {
    void *at;
    uint64_t count; // that there is room for
    size_t size;    // of an element
} version_array;

static void list_arrays(const tl_navmesh *navmesh, version_array *arrays)
{
    const tl_nav_islands *islands = &navmesh->islands;
    const tl_nav_offmesh_table *links = &navmesh->offmesh;
    const uint64_t sums = navmesh->slot_capacity > 0 ? (uint64_t)navmesh->slot_capacity + 1 : 0;
    const version_array list[VERSION_ARRAYS] = {
        { navmesh->slots, navmesh->slot_capacity, sizeof *navmesh->slots },
        { navmesh->buckets, navmesh->bucket_count, sizeof *navmesh->buckets },
        { navmesh->area_table, sums, sizeof *navmesh->area_table },
        { islands->nodes, islands->capacity, sizeof *islands->nodes },
        { islands->labels[0], TL_NAV_ISLAND_KINDS * tl_nav_label_room(islands), sizeof **islands->labels },
        { links->entries, links->capacity, sizeof *links->entries },
        { links->buckets, 2 * (uint64_t)links->capacity, sizeof *links->buckets },
        { links->short_cuts, links->capacity, sizeof *links->short_cuts },
    };
    memcpy(arrays, list, sizeof list);
}

static void set_arrays(tl_navmesh *navmesh, const version_array *arrays)
{
    tl_nav_islands *islands = &navmesh->islands;
    navmesh->slots = (tl_nav_slot *)arrays[SLOTS].at;
    navmesh->buckets = (uint32_t *)arrays[BUCKETS].at;
    navmesh->area_table = (uint64_t *)arrays[AREA_SUMS].at;
    islands->nodes = (tl_nav_island_node *)arrays[ISLAND_NODES].at;
    islands->labels[0] = (tl_nav_island_label *)arrays[ISLAND_LABELS].at;
    islands->labels[1] = islands->labels[0] != NULL ? islands->labels[0] + tl_nav_label_room(islands) : NULL;
    navmesh->offmesh.entries = (tl_nav_offmesh_entry *)arrays[LINK_ENTRIES].at;
    navmesh->offmesh.buckets = (uint32_t *)arrays[LINK_BUCKETS].at;
    navmesh->offmesh.short_cuts = (uint32_t *)arrays[SHORT_CUTS].at;
}

static void free_listed(tl_nav_history *history, version_array *arrays)
{
    for (int i = 0; i < VERSION_ARRAYS; i++) {
        if (arrays[i].at != NULL) {
            tl_nav_free_block(history, tl_nav_block_of(arrays[i].at));
        }
        arrays[i].at = NULL;
    }
}

void tl_nav_free_arrays(tl_nav_history *history, tl_navmesh *navmesh)
{
    version_array arrays[VERSION_ARRAYS];
    list_arrays(navmesh, arrays);
    free_listed(history, arrays);
    memset(navmesh, 0, sizeof *navmesh);
}

// Fresh arrays as large as those listed. Slots that were never used are zero.
static tl_result allocate_listed(const tl_navmesh *from, version_array *arrays)
{
    for (int i = 0; i < VERSION_ARRAYS; i++) {
        const bool is_empty = arrays[i].count == 0;
        arrays[i].at = is_empty ? NULL : tl_allocate_array(&from->allocator, arrays[i].count, arrays[i].size);
        if (arrays[i].at == NULL && !is_empty) {
            while (++i < VERSION_ARRAYS) {
                arrays[i].at = NULL;
            }
            free_listed(from->history, arrays);
            return TL_ERR_MEMORY;
        }
    }
    if (arrays[SLOTS].at != NULL) {
        memset(arrays[SLOTS].at, 0, (size_t)arrays[SLOTS].count * arrays[SLOTS].size);
    }
    return TL_OK;
}

// The first `used` elements of a paged array, where pages were changed after a version.
static void copy_pages(const tl_nav_history *history, uint32_t array, uint64_t version, const void *from, void *to,
                       uint64_t used, size_t size)
{
    const uint32_t shift = history->shift[array];
    for (uint64_t page = 0; page << shift < used; page++) {
        if (history->touched[array][page] > version) {
            const uint64_t begin = page << shift;
            const uint64_t end = (page + 1) << shift < used ? (page + 1) << shift : used;
            memcpy((char *)to + begin * size, (const char *)from + begin * size, (size_t)(end - begin) * size);
        }
    }
}

static void copy_changes(const tl_nav_history *history, const tl_navmesh *from, uint64_t version, tl_navmesh *to)
{
    const tl_nav_islands *islands = &from->islands;
    const tl_nav_offmesh_table *links = &from->offmesh;
    copy_pages(history, TL_NAV_PAGED_SLOTS, version, from->slots, to->slots, from->slot_count, sizeof *from->slots);
    copy_pages(history, TL_NAV_PAGED_BUCKETS, version, from->buckets, to->buckets, from->bucket_count,
               sizeof *from->buckets);
    copy_pages(history, TL_NAV_PAGED_AREAS, version, from->area_table, to->area_table,
               from->slot_capacity > 0 ? (uint64_t)from->slot_capacity + 1 : 0, sizeof *from->area_table);
    copy_pages(history, TL_NAV_PAGED_ISLAND_NODES, version, islands->nodes, to->islands.nodes, islands->used,
               sizeof *islands->nodes);
    for (uint32_t kind = 0; kind < TL_NAV_ISLAND_KINDS; kind++) {
        copy_pages(history, TL_NAV_PAGED_LABELS + kind, version, islands->labels[kind], to->islands.labels[kind],
                   islands->label_count[kind], sizeof **islands->labels);
    }
    if (history->offmesh_touched > version && links->capacity > 0) {
        memcpy(to->offmesh.entries, links->entries, links->used * sizeof *links->entries);
        memcpy(to->offmesh.buckets, links->buckets, 2 * (size_t)links->capacity * sizeof *links->buckets);
        memcpy(to->offmesh.short_cuts, links->short_cuts, links->short_count * sizeof *links->short_cuts);
    }
}

tl_result tl_nav_catch_up(tl_nav_history *history, const tl_navmesh *from, uint64_t version, tl_navmesh *to)
{
    version_array arrays[VERSION_ARRAYS], wanted[VERSION_ARRAYS];
    list_arrays(to, arrays);
    list_arrays(from, wanted);
    bool fits = true;
    for (int i = 0; i < VERSION_ARRAYS; i++) {
        fits = fits && arrays[i].count == wanted[i].count;
    }
    if (!fits) {
        TL_TRY(allocate_listed(from, wanted));
        free_listed(history, arrays);
        memcpy(arrays, wanted, sizeof arrays);
        version = 0;
    }
    *to = *from;
    set_arrays(to, arrays);
    copy_changes(history, from, version, to);
    return TL_OK;
}
