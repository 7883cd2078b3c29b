// SPDX-License-Identifier: MIT
//
// Looking only in the direction of a change: the directions, and what was seen there.
//
// What a corner vertex v sees of a region that may have changed is in v's cones of the region's polygons. In all other
// directions v sees what it saw. A polygon p that v sees in such a direction too may lie before the region or beyond
// it. Both are convex and do not overlap, so a line separates them, and any ray from v that meets both meets them in
// the same order: one ray tells for all. What lies before is seen as it was. Where p lies beyond, or it cannot be told,
// all of v's cones in p are found anew, and for that v looks in their directions too: then the cones of p are those
// that a look all around would find, to the bit.
//
// A corner vertex that touches a region, or sees changes in more than a third of all directions, looks all around.

#include "nav_query/mending/change_sectors.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/mending/cones_beyond.h"
#include "nav_query/mending/known_rings.h"

#include <string.h>

// Of all directions, in which one does not look all around.
#define MOST_DIRECTIONS (TL_NAV_FULL_TURN / 3.0)

tl_nav_sector tl_nav_sector_of_cone(const tl_nav_corner_cones *cones, uint32_t cone)
{
    const double right_x = -(double)cones->right_x[cone], right_z = -(double)cones->right_z[cone];
    const double left_x = (double)cones->left_x[cone], left_z = (double)cones->left_z[cone];
    const tl_nav_sector all = { 0.0, TL_NAV_FULL_TURN };
    if ((right_x == 0.0 && right_z == 0.0) || (left_x == 0.0 && left_z == 0.0)) {
        return all;
    }
    const double margin = TL_NAV_CONE_MARGIN * (double)tl_nav_cone_slack(cones->vertex[cone]) / TL_NAV_CONE_STEPS;
    return tl_nav_sector_between(right_x, right_z, left_x, left_z, margin);
}

// The directions in which a place may lie that is seen in this one.
static tl_nav_sector sector_towards(const tl_nav_visibility_graph *graph, double x, double z)
{
    return tl_nav_sector_between(x, z, x, z, TL_NAV_PLACE_MARGIN * graph->rounding / (fabs(x) + fabs(z)));
}

// ---------------------------------------------------------------------------------------------------------
// The sectors.

// Unsorted: as items of `found` places in `sectors`, by looker.
typedef struct sector_finder {
    tl_nav_change_sectors *s;
    tl_nav_pair_list found;
} sector_finder;

static tl_result add_sector(sector_finder *f, uint32_t vertex, tl_nav_sector directions, uint32_t slot,
                            uint32_t polygon)
{
    const tl_nav_change_sector sector = { directions, { 0.0, 0.0, 0.0, 0.0 }, slot, polygon };
    tl_nav_change_sectors *s = f->s;
    if (s->count == s->capacity) {
        tl_nav_change_sector *grown = tl_grow_array(s->changes->allocator, s->sectors, &s->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        s->sectors = grown;
    }
    s->sectors[s->count] = sector;
    return tl_nav_add_pair(s->changes->allocator, &f->found, s->changes->graph->orders[vertex], (uint32_t)s->count++);
}

static tl_nav_plan_box box_of_polygon(const tl_nav_known_rings *known, uint32_t polygon)
{
    const uint32_t first = known->first[polygon];
    return tl_nav_box_of_edges(known->edges + first, known->first[polygon + 1] - first);
}

// `polygon`, by its old number, is one of a region, which is all of the slot if it is of another tile.
static tl_result add_polygon_sectors(sector_finder *f, uint32_t slot, uint32_t polygon, bool is_other)
{
    const tl_nav_visibility_graph *graph = f->s->changes->graph;
    const tl_nav_graph_tile *tile = &graph->tiles[slot];
    const tl_nav_plan_box box = is_other ? tile->box : box_of_polygon(&tile->rings, polygon);
    for (uint32_t i = tile->cones.first[polygon]; i < tile->cones.first[polygon + 1]; i++) {
        const uint32_t v = tl_nav_cone_vertex(&tile->cones, i);
        if (graph->marks[v] == TL_NAV_MARK_LOOKS && tl_nav_is_in_box(&box, &graph->vertices[v])) {
            graph->marks[v] = TL_NAV_MARK_WHOLE;
        }
        if (graph->marks[v] == TL_NAV_MARK_LOOKS) {
            TL_TRY(add_sector(f, v, tl_nav_sector_of_cone(&tile->cones, i), slot, is_other ? TL_NO_POLYGON : polygon));
        }
    }
    return TL_OK;
}

// The directions of corner vertices that are gone. Where they were the polygons may be as before.
static tl_result add_gone_sectors(sector_finder *f)
{
    const tl_nav_graph_changes *c = f->s->changes;
    for (uint64_t i = 0; i < c->gone_sights.count; i++) {
        const uint32_t v = (uint32_t)(c->gone_sights.items[i].key >> 32), gone = (uint32_t)c->gone_sights.items[i].key;
        const double x = (double)c->gone_spots[gone].x - (double)c->graph->vertices[v].x;
        const double z = (double)c->gone_spots[gone].z - (double)c->graph->vertices[v].z;
        if (c->graph->marks[v] == TL_NAV_MARK_LOOKS && fabs(x) + fabs(z) > c->graph->rounding) {
            TL_TRY(add_sector(f, v, sector_towards(c->graph, x, z), TL_NAV_NO_SLOT, gone));
        }
    }
    return TL_OK;
}

static tl_result find_sectors(sector_finder *f)
{
    const tl_nav_graph_changes *c = f->s->changes;
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        const bool is_other = (c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0;
        for (uint32_t p = 0; is_other && p < c->graph->tiles[slot].cones.polygon_count; p++) {
            TL_TRY(add_polygon_sectors(f, slot, p, true));
        }
    }
    for (uint64_t i = 0; i < c->old_polygons.count; i++) {
        const uint64_t key = c->old_polygons.items[i].key;
        TL_TRY(add_polygon_sectors(f, (uint32_t)(key >> 32), (uint32_t)key, false));
    }
    return add_gone_sectors(f);
}

// Adds a sector to those from `begin` to `end` of one corner vertex: with those of the same region that it overlaps it
// becomes one. Returns their new end.
static uint64_t join_sector(tl_nav_change_sector *sectors, uint64_t begin, uint64_t end, tl_nav_change_sector sector)
{
    for (uint64_t i = end; i > begin; i--) {
        const tl_nav_change_sector *other = &sectors[i - 1];
        if (other->slot == sector.slot && other->polygon == sector.polygon &&
            tl_nav_sectors_overlap(&other->sector, &sector.sector)) {
            sector.sector = tl_nav_unite_sectors(&other->sector, &sector.sector);
            sectors[i - 1] = sectors[--end];
            i = end + 1;
        }
    }
    sectors[end] = sector;
    return end + 1;
}

// By looker, joined.
static tl_result sort_sectors(sector_finder *f)
{
    tl_nav_change_sectors *s = f->s;
    const tl_allocator *allocator = s->changes->allocator;
    TL_TRY(tl_nav_sort_pairs(allocator, &f->found, NULL));
    tl_nav_change_sector *sorted = tl_allocate_array(allocator, s->capacity, sizeof *sorted);
    if (sorted == NULL) {
        return TL_ERR_MEMORY;
    }
    uint64_t count = 0, i = 0;
    for (uint64_t k = 0; k < s->changes->first_fresh; k++) {
        const uint32_t v = s->changes->lookers.numbers[k];
        const uint64_t begin = count;
        s->first[k] = count;
        for (; i < f->found.count && f->found.items[i].key >> 32 == k; i++) {
            count = join_sector(sorted, begin, count, s->sectors[(uint32_t)f->found.items[i].key]);
        }
        double width = 0.0;
        for (uint64_t n = begin; n < count; n++) {
            width += sorted[n].sector.width;
        }
        if (width > MOST_DIRECTIONS || count == begin) {
            s->changes->graph->marks[v] = TL_NAV_MARK_WHOLE;
        }
    }
    for (uint64_t n = 0; n < count; n++) {
        sorted[n].rays = tl_nav_rays_of_sector(&sorted[n].sector);
    }
    s->first[s->changes->first_fresh] = count;
    tl_release_array(allocator, s->sectors, s->capacity, sizeof *sorted);
    s->sectors = sorted;
    s->count = count;
    return TL_OK;
}

// In tiles that went all cones are lost.
static tl_result note_lost_tiles(tl_nav_change_sectors *s)
{
    const tl_nav_graph_changes *c = s->changes;
    for (uint64_t k = 0; k < s->changes->first_fresh; k++) {
        for (uint64_t i = s->first[k]; i < s->first[k + 1]; i++) {
            const tl_nav_change_sector *sector = &s->sectors[i];
            if (sector->slot != TL_NAV_NO_SLOT && sector->polygon == TL_NO_POLYGON) {
                TL_TRY(tl_nav_add_pair(c->allocator, &s->lost, c->lookers.numbers[k], sector->slot));
            }
        }
    }
    return TL_OK;
}

tl_result tl_nav_find_change_sectors(tl_nav_graph_changes *changes, const tl_host *host,
                                     tl_nav_change_sectors *sectors_out)
{
    memset(sectors_out, 0, sizeof *sectors_out);
    sectors_out->changes = changes;
    sectors_out->first = tl_allocate_array(changes->allocator, changes->first_fresh + 1, sizeof *sectors_out->first);
    if (sectors_out->first == NULL) {
        return TL_ERR_MEMORY;
    }
    sector_finder finder = { sectors_out, { NULL, 0, 0 } };
    tl_result result = find_sectors(&finder);
    result = result == TL_OK ? sort_sectors(&finder) : result;
    tl_nav_free_pairs(changes->allocator, &finder.found);
    TL_TRY(result);
    TL_TRY(tl_nav_find_cones_beyond(sectors_out, host));
    TL_TRY(note_lost_tiles(sectors_out));
    TL_TRY(tl_nav_sort_pairs(changes->allocator, &sectors_out->beyond, NULL));
    return tl_nav_unite_pairs(changes->allocator, &sectors_out->lost, NULL);
}

void tl_nav_free_change_sectors(tl_nav_change_sectors *s)
{
    const tl_allocator *allocator = s->changes->allocator;
    tl_release_array(allocator, s->first, s->changes->first_fresh + 1, sizeof *s->first);
    tl_release_array(allocator, s->sectors, s->capacity, sizeof *s->sectors);
    tl_nav_free_pairs(allocator, &s->beyond);
    tl_nav_free_pairs(allocator, &s->dropped);
    tl_nav_free_pairs(allocator, &s->lost);
}

// Whether a corner vertex that looks may see a change in the direction of another.
static bool sees_change_towards(const tl_nav_change_sectors *s, uint32_t from, uint32_t to)
{
    const tl_nav_visibility_graph *graph = s->changes->graph;
    const uint32_t order = graph->orders[from];
    const double x = (double)graph->vertices[to].x - (double)graph->vertices[from].x;
    const double z = (double)graph->vertices[to].z - (double)graph->vertices[from].z;
    const tl_nav_sector_rays rays = { x, z, x, z };
    bool any = graph->marks[from] != TL_NAV_MARK_LOOKS;
    for (uint64_t i = any ? 0 : s->first[order]; !any && i < s->first[order + 1]; i++) {
        any = !tl_nav_are_rays_apart(&s->sectors[i].rays, &rays, 0.0);
    }
    return any;
}

bool tl_nav_is_edge_kept(const tl_nav_change_sectors *s, uint32_t from, uint32_t to)
{
    return !sees_change_towards(s, from, to) || !sees_change_towards(s, to, from);
}
