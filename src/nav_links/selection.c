// SPDX-License-Identifier: MIT
//
// Greedy selection: a link is kept where the shortest path without it is long, or there is none. Paths use the links
// kept before, so of a row of links side by side one is kept, then the next only so far along that it saves as much
// again: one rule drops duplicates and useless links, and needs no distance that would suit some levels only.
//
// The shortest candidates come first, so that a long jump is not kept where a short one will do.

#include "nav_links/selection.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

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
        TL_TRY(tl_navmesh_add_offmesh(*copy_out, &state.offmesh, &link, NULL));
    }
    return TL_OK;
}

// Merge sort by rank: stable, so that ties are kept in the order of the ledges.
static void sort_by_rank(tl_nav_link_candidate *candidates, uint32_t count, tl_nav_link_candidate *scratch)
{
    for (uint32_t width = 1; width < count; width = width < count / 2 + 1 ? 2 * width : count) {
        for (uint32_t begin = 0, end; begin < count; begin = end) {
            uint32_t middle = begin + tl_min_u32(width, count - begin);
            end = middle + tl_min_u32(width, count - middle);
            uint32_t a = begin;
            uint32_t b = middle;
            for (uint32_t i = begin; i < end; i++) {
                bool takes_a = a < middle && (b == end || candidates[a].rank <= candidates[b].rank);
                scratch[i] = candidates[takes_a ? a++ : b++];
            }
        }
        memcpy(candidates, scratch, count * sizeof *candidates);
    }
}

typedef struct link_selection {
    const tl_nav_links_def *def;
    tl_navmesh *navmesh; // with the links that were kept
    tl_nav_query *query;
} link_selection;

// Whether the shortest path without a link is long enough, or there is none.
static tl_result is_long_without(const link_selection *s, const tl_nav_location *from, const tl_nav_location *to,
                                 float cost, bool *is_long_out)
{
    tl_nav_shortest_path path;
    const tl_nav_path_request request = { .start = *from, .goal = *to };
    TL_TRY(tl_nav_query_find_shortest_path(s->query, s->navmesh, &request, NULL, &path));
    *is_long_out = path.status != TL_NAV_PATH_COMPLETE || path.length >= (double)s->def->min_gain * (double)cost;
    return TL_OK;
}

static tl_result is_useful(const link_selection *s, const tl_nav_link_candidate *candidate, bool *useful_out)
{
    // Ends lie on the surface: the nearest polygon is theirs.
    tl_nav_location ends[2];
    float slack = tl_default_nav_offmesh().radius;
    tl_vec3 half = tl_vec3_make(slack, slack, slack);
    TL_TRY(tl_navmesh_find_nearest(s->navmesh, NULL, candidate->link.start, half, &ends[0]));
    TL_TRY(tl_navmesh_find_nearest(s->navmesh, NULL, candidate->link.end, half, &ends[1]));
    TL_TRY(is_long_without(s, &ends[0], &ends[1], candidate->cost, useful_out));
    if (!*useful_out && candidate->link.both_ways != 0) {
        TL_TRY(is_long_without(s, &ends[1], &ends[0], candidate->cost, useful_out));
    }
    return TL_OK;
}

static tl_result select_in_order(const link_selection *s, tl_nav_link_candidate *candidates, uint32_t count,
                                 uint32_t *kept, tl_nav_links_report *report)
{
    enum { LINKS_PER_REPORT = 8 }; // a link takes up to two path searches
    for (uint32_t i = 0; i < count; i++) {
        if (i % LINKS_PER_REPORT == 0) {
            TL_TRY(tl_progress_update(&s->def->host, "selection", i, count));
        }
        bool useful = false;
        TL_TRY(is_useful(s, &candidates[i], &useful));
        tl_nav_links_count *counts = &report->kinds[candidates[i].link.kind];
        if (!useful) {
            counts->useless++;
            continue;
        }
        tl_nav_offmesh offmesh = tl_default_nav_offmesh();
        offmesh.start = candidates[i].link.start;
        offmesh.end = candidates[i].link.end;
        offmesh.both_ways = candidates[i].link.both_ways != 0;
        tl_nav_ref unused;
        TL_TRY(tl_navmesh_add_offmesh(s->navmesh, &offmesh, &unused, NULL));
        counts->kept++;
        candidates[(*kept)++] = candidates[i];
    }
    return tl_progress_update(&s->def->host, "selection", count, count);
}

tl_result tl_nav_select_links(const tl_nav_links_def *def, const tl_navmesh *navmesh, tl_nav_link_candidate *candidates,
                              uint32_t count, uint32_t *kept_out, tl_nav_links_report *report)
{
    const tl_allocator *allocator = def->host.allocator;
    tl_nav_query_def query_def = tl_default_nav_query_def();
    link_selection s = { def, NULL, NULL };
    query_def.max_nodes = def->max_nodes;
    query_def.allocator = allocator;
    *kept_out = 0;
    tl_nav_link_candidate *scratch = tl_allocate_array(allocator, count, sizeof *scratch);
    tl_result result = scratch != NULL ? copy_navmesh(navmesh, allocator, &s.navmesh) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        result = tl_nav_query_create(&query_def, &s.query, NULL);
    }
    if (result == TL_OK) {
        sort_by_rank(candidates, count, scratch);
        result = select_in_order(&s, candidates, count, kept_out, report);
    }
    tl_nav_query_destroy(s.query);
    tl_navmesh_destroy(s.navmesh);
    tl_release_array(allocator, scratch, count, sizeof *scratch);
    return result;
}
