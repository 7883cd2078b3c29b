// SPDX-License-Identifier: MIT
//
// Neighbours: two polygons that run along one edge in opposite directions are linked.
//
// Edges that rise in vertex number are put into a hash table, falling ones look for their counterpart there. Should an
// edge be claimed more than twice, which only floors that lie upon each other can cause, the earliest claims are linked
// and the rest are counted.

#include "polygon/polygon_store.h"

#include "base/assert.h"

#include <string.h>

// An edge of a polygon that rises in vertex number.
typedef struct claim {
    uint32_t place;   // of the edge in indices
    uint32_t polygon; //
    uint32_t next;    // further claim of the same edge, or TL_NO_VALUE
    bool is_linked;
} claim;

typedef struct linker {
    tl_polygon_store *store;
    claim *claims;
    uint32_t claim_count;
    tl_key_table table;
    tl_polygon_report *report;
} linker;

static uint32_t next_corner(const tl_stored_polygon *polygon, uint32_t place)
{
    return place + 1 < polygon->first + polygon->count ? place + 1 : polygon->first;
}

static uint32_t count_rising_edges(const tl_polygon_store *store)
{
    uint32_t count = 0;
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
            count += store->indices[place] < store->indices[next_corner(polygon, place)];
        }
    }
    return count;
}

static void claim_edge(linker *l, uint32_t polygon, uint32_t place, uint32_t from, uint32_t to)
{
    claim item = { place, polygon, TL_NO_VALUE, false };
    uint32_t *link = tl_key_table_at(&l->table, tl_pair_key(from, to));
    l->report->crowded_edges += *link != TL_NO_VALUE;
    while (*link != TL_NO_VALUE) {
        link = &l->claims[*link].next;
    }
    *link = l->claim_count;
    l->claims[l->claim_count++] = item;
}

static void answer_claim(linker *l, uint32_t polygon, uint32_t place, uint32_t from, uint32_t to)
{
    uint32_t found = *tl_key_table_at(&l->table, tl_pair_key(to, from));
    bool was_claimed = found != TL_NO_VALUE;
    while (found != TL_NO_VALUE && l->claims[found].is_linked) {
        found = l->claims[found].next;
    }
    if (found == TL_NO_VALUE) {
        l->report->crowded_edges += was_claimed;
        return;
    }
    l->claims[found].is_linked = true;
    l->store->neighbours[place] = l->claims[found].polygon;
    l->store->neighbours[l->claims[found].place] = polygon;
    l->report->link_count++;
}

static uint32_t portal_side(const tl_polygon_store *store, const tl_contour_set *contours, uint32_t from, uint32_t to)
{
    tl_lattice_point a = tl_stored_point(store, from);
    tl_lattice_point b = tl_stored_point(store, to);
    if (a.x == 0 && b.x == 0) {
        return TL_PORTAL | 0u;
    }
    if (a.z == contours->height && b.z == contours->height) {
        return TL_PORTAL | 1u;
    }
    if (a.x == contours->width && b.x == contours->width) {
        return TL_PORTAL | 2u;
    }
    if (a.z == 0 && b.z == 0) {
        return TL_PORTAL | 3u;
    }
    return TL_NO_POLYGON;
}

tl_result tl_link_neighbours(tl_polygon_store *store, tl_arena *scratch, const tl_contour_set *contours,
                             tl_polygon_report *report)
{
    linker l;
    memset(&l, 0, sizeof l);
    l.store = store;
    l.report = report;
    store->neighbours = TL_PUSH(store->arena, uint32_t, store->index_count);
    const uint32_t rising = count_rising_edges(store);
    l.claims = TL_PUSH(scratch, claim, rising);
    // A falling edge takes no room: looking it up leaves the value free where nobody claims it.
    if (store->neighbours == NULL || l.claims == NULL || !tl_key_table_init(&l.table, scratch, rising)) {
        return TL_ERR_MEMORY;
    }
    memset(store->neighbours, 0xff, store->index_count * sizeof *store->neighbours);
    for (int falling = 0; falling < 2; falling++) {
        for (uint32_t p = 0; p < store->polygon_count; p++) {
            const tl_stored_polygon *polygon = &store->polygons[p];
            for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
                uint32_t from = store->indices[place];
                uint32_t to = store->indices[next_corner(polygon, place)];
                if (falling == 0 && from < to) {
                    claim_edge(&l, p, place, from, to);
                } else if (falling != 0 && from > to) {
                    answer_claim(&l, p, place, from, to);
                }
            }
        }
    }
    if (contours->border_size <= 0) {
        return TL_OK;
    }
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
            if (store->neighbours[place] == TL_NO_POLYGON) {
                store->neighbours[place] =
                    portal_side(store, contours, store->indices[place], store->indices[next_corner(polygon, place)]);
                report->portal_count += store->neighbours[place] != TL_NO_POLYGON;
            }
        }
    }
    return TL_OK;
}
