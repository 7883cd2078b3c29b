// SPDX-License-Identifier: MIT
//
// Selection: a link is kept where there is no way without it, or a long one. Links kept before count as ways, so of a
// row of links side by side one is kept, then the next one only so far along that it saves as much again: duplicates
// and useless ones fall out by one rule, which means the same on every level.
//
// The shortest first, so that a long jump is not kept where a short one does it.

#include "nav_links/selection.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>

// A navmesh of the same tiles, to which links can be added.
static tl_result copy_navmesh(const tl_navmesh *navmesh, const tl_allocator *allocator, tl_navmesh **copy_out)
{
    TL_TRY(tl_navmesh_create(allocator, copy_out));
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile != NULL) {
            TL_TRY(tl_navmesh_add_tile(*copy_out, tile, TL_NAV_TILE_BORROWED));
        }
    }
    uint32_t cursor = 0;
    tl_nav_ref link;
    while (tl_navmesh_next_offmesh(navmesh, &cursor, &link)) {
        tl_nav_offmesh_state state;
        TL_TRY(tl_navmesh_offmesh_state(navmesh, link, &state));
        TL_TRY(tl_navmesh_add_offmesh(*copy_out, &state.offmesh, &link));
    }
    return TL_OK;
}

// Merge sort by rank: stable, so that ties are kept in the order of the ledges.
static void sort_by_rank(tl_nav_way_try *ways, uint32_t count, tl_nav_way_try *scratch)
{
    for (uint32_t width = 1; width < count; width = width < count / 2 + 1 ? 2 * width : count) {
        for (uint32_t begin = 0; begin<count; begin = count - begin> 2 * width ? begin + 2 * width : count) {
            uint32_t middle = count - begin > width ? begin + width : count;
            uint32_t end = count - middle > width ? middle + width : count;
            uint32_t a = begin;
            uint32_t b = middle;
            for (uint32_t i = begin; i < end; i++) {
                bool takes_a = a < middle && (b == end || ways[a].rank <= ways[b].rank);
                scratch[i] = ways[takes_a ? a++ : b++];
            }
        }
        memcpy(ways, scratch, count * sizeof *ways);
    }
}

typedef struct selection {
    const tl_nav_links_def *def;
    tl_navmesh *navmesh; // with the links that were kept
    tl_nav_query *query;
} selection;

// Whether the way without a link is as long as it must be, or there is none.
static tl_result is_long(const selection *s, const tl_nav_location *from, const tl_nav_location *to, float cost,
                         bool *is_long_out)
{
    tl_nav_shortest_path path;
    const tl_nav_path_request request = { .start = *from, .goal = *to };
    TL_TRY(tl_nav_query_find_shortest_path(s->query, s->navmesh, &request, NULL, &path));
    *is_long_out = path.status != TL_NAV_PATH_COMPLETE || path.length >= (double)s->def->least_gain * (double)cost;
    return TL_OK;
}

static tl_result is_useful(const selection *s, const tl_nav_way_try *way, bool *useful_out)
{
    // Ends lie on the surface: the nearest polygon is theirs.
    tl_nav_location ends[2];
    float slack = tl_default_nav_offmesh().radius;
    tl_vec3 half = tl_vec3_make(slack, slack, slack);
    TL_TRY(tl_navmesh_find_nearest(s->navmesh, NULL, way->link.start, half, &ends[0]));
    TL_TRY(tl_navmesh_find_nearest(s->navmesh, NULL, way->link.end, half, &ends[1]));
    TL_TRY(is_long(s, &ends[0], &ends[1], way->cost, useful_out));
    if (!*useful_out && way->link.both_ways != 0) {
        TL_TRY(is_long(s, &ends[1], &ends[0], way->cost, useful_out));
    }
    return TL_OK;
}

static tl_result select(const selection *s, tl_nav_way_try *ways, uint32_t count, uint32_t *kept,
                        tl_nav_links_report *report)
{
    enum { A_REPORT = 256 };
    for (uint32_t i = 0; i < count; i++) {
        if (i % A_REPORT == 0) {
            TL_TRY(tl_progress_update(s->def->host, "selection", i, count));
        }
        bool useful = false;
        TL_TRY(is_useful(s, &ways[i], &useful));
        tl_nav_links_count *counts = &report->kinds[ways[i].link.kind];
        if (!useful) {
            counts->useless++;
            continue;
        }
        tl_nav_offmesh offmesh = tl_default_nav_offmesh();
        offmesh.start = ways[i].link.start;
        offmesh.end = ways[i].link.end;
        offmesh.both_ways = ways[i].link.both_ways != 0;
        tl_nav_ref unused;
        TL_TRY(tl_navmesh_add_offmesh(s->navmesh, &offmesh, &unused));
        counts->kept++;
        ways[(*kept)++] = ways[i];
    }
    return tl_progress_update(s->def->host, "selection", count, count);
}

tl_result tl_nav_select_ways(const tl_nav_links_def *def, const tl_navmesh *navmesh, tl_nav_way_try *ways,
                             uint32_t count, uint32_t *kept_out, tl_nav_links_report *report)
{
    const tl_allocator *allocator = def->host != NULL ? def->host->allocator : NULL;
    tl_nav_query_def query_def = { def->max_nodes, allocator };
    selection s = { def, NULL, NULL };
    *kept_out = 0;
    tl_nav_way_try *scratch = tl_allocate_array(allocator, count, sizeof *scratch);
    tl_result result = scratch != NULL ? copy_navmesh(navmesh, allocator, &s.navmesh) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        result = tl_nav_query_create(&query_def, &s.query);
    }
    if (result == TL_OK) {
        sort_by_rank(ways, count, scratch);
        result = select(&s, ways, count, kept_out, report);
    }
    tl_nav_query_destroy(s.query);
    tl_navmesh_destroy(s.navmesh);
    tl_release_array(allocator, scratch, count, sizeof *scratch);
    return result;
}
