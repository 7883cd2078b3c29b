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
#include "nav_query/mending/known_rings.h"

#include <string.h>

// Roundings of the graph by which what lies at one place, or side by side, may be taken for apart or for overlapping.
#define PLACE_MARGIN 8.0

// Slacks of a cone by which it is taken to be wider than it is kept.
#define CONE_MARGIN 4.0

// Of all directions, in which one does not look all around.
#define MOST_DIRECTIONS (TL_NAV_FULL_TURN / 3.0)

static uint64_t looker_count(const tl_nav_change_sectors *s)
{
    return s->changes->first_fresh;
}

tl_nav_sector tl_nav_sector_of_cone(const tl_nav_corner_cones *cones, uint32_t cone)
{
    const double right_x = -(double)cones->right_x[cone], right_z = -(double)cones->right_z[cone];
    const double left_x = (double)cones->left_x[cone], left_z = (double)cones->left_z[cone];
    const tl_nav_sector all = { 0.0, TL_NAV_FULL_TURN };
    if ((right_x == 0.0 && right_z == 0.0) || (left_x == 0.0 && left_z == 0.0)) {
        return all;
    }
    const double margin = CONE_MARGIN * (double)tl_nav_cone_slack(cones->vertex[cone]) / TL_NAV_CONE_STEPS;
    return tl_nav_sector_between(right_x, right_z, left_x, left_z, margin);
}

// The directions in which a place may lie that is seen in this one.
static tl_nav_sector sector_towards(const tl_nav_visibility_graph *graph, double x, double z)
{
    return tl_nav_sector_between(x, z, x, z, PLACE_MARGIN * graph->rounding / (fabs(x) + fabs(z)));
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

static bool is_in_box(const tl_nav_plan_box *box, const tl_nav_corner_vertex *vertex)
{
    return vertex->x >= box->low_x && vertex->x <= box->high_x && vertex->z >= box->low_z && vertex->z <= box->high_z;
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
        if (graph->marks[v] == TL_NAV_MARK_LOOKS && is_in_box(&box, &graph->vertices[v])) {
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
    for (uint64_t k = 0; k < looker_count(s); k++) {
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
    s->first[looker_count(s)] = count;
    tl_release_array(allocator, s->sectors, s->capacity, sizeof *sorted);
    s->sectors = sorted;
    s->count = count;
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Cones beyond a change.

// Where a ray enters a convex polygon and leaves it, in lengths of its direction.
typedef struct ray_chord {
    double enters, leaves; // enters > leaves: it misses
} ray_chord;

typedef struct sight_ray {
    double from_x, from_z, x, z;
} sight_ray;

// In a direction within two sectors that overlap.
static sight_ray shared_ray(const tl_nav_corner_vertex *vertex, const tl_nav_sector_rays *a,
                            const tl_nav_sector_rays *b)
{
    sight_ray ray = { (double)vertex->x, (double)vertex->z, 0.0, 0.0 };
    tl_nav_shared_direction(a, b, &ray.x, &ray.z);
    return ray;
}

static void cut_chord(const sight_ray *ray, double a_x, double a_z, double b_x, double b_z, ray_chord *chord)
{
    a_x -= ray->from_x;
    a_z -= ray->from_z;
    b_x -= ray->from_x;
    b_z -= ray->from_z;
    const double a = ray->x * a_z - ray->z * a_x, b = ray->x * b_z - ray->z * b_x;
    if ((a > 0.0) == (b > 0.0)) {
        return;
    }
    const double t = a / (a - b);
    const double along = ray->x * (a_x + t * (b_x - a_x)) + ray->z * (a_z + t * (b_z - a_z));
    const double length = along / (ray->x * ray->x + ray->z * ray->z);
    chord->enters = length < chord->enters ? length : chord->enters;
    chord->leaves = length > chord->leaves ? length : chord->leaves;
}

static ray_chord chord_of_ring(const sight_ray *ray, const tl_nav_known_edge *edges, uint32_t count)
{
    ray_chord chord = { (double)INFINITY, -(double)INFINITY };
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_known_edge *a = &edges[i], *b = &edges[i + 1 < count ? i + 1 : 0];
        cut_chord(ray, (double)a->x, (double)a->z, (double)b->x, (double)b->z, &chord);
    }
    return chord;
}

static ray_chord chord_of_polygon(const tl_nav_known_rings *known, const sight_ray *ray, uint32_t polygon)
{
    return chord_of_ring(ray, known->edges + known->first[polygon], known->first[polygon + 1] - known->first[polygon]);
}

// The corners of a box, turning the same way around.
static void corners_of_box(const tl_nav_plan_box *box, tl_nav_known_edge corners_out[4])
{
    const tl_nav_known_edge corners[4] = { { box->low_x, box->low_z, 0, 0 },
                                           { box->high_x, box->low_z, 0, 0 },
                                           { box->high_x, box->high_z, 0, 0 },
                                           { box->low_x, box->high_z, 0, 0 } };
    memcpy(corners_out, corners, sizeof corners);
}

static ray_chord chord_of_box(const tl_nav_plan_box *box, const sight_ray *ray)
{
    tl_nav_known_edge corners[4];
    corners_of_box(box, corners);
    return chord_of_ring(ray, corners, 4);
}

static ray_chord chord_of_region(const tl_nav_graph_changes *c, const sight_ray *ray,
                                 const tl_nav_change_sector *sector)
{
    ray_chord chord = { (double)INFINITY, -(double)INFINITY };
    if (sector->slot == TL_NAV_NO_SLOT) {
        const double x = (double)c->gone_spots[sector->polygon].x - ray->from_x;
        const double z = (double)c->gone_spots[sector->polygon].z - ray->from_z;
        chord.enters = chord.leaves = (x * ray->x + z * ray->z) / (ray->x * ray->x + ray->z * ray->z);
        return chord;
    }
    if (sector->polygon != TL_NO_POLYGON) {
        return chord_of_polygon(&c->graph->tiles[sector->slot].rings, ray, sector->polygon);
    }
    return chord_of_box(&c->graph->tiles[sector->slot].box, ray);
}

// Where all polygons of a slot lie to a change that a corner vertex sees: as its box does, if that tells.
typedef enum slot_place { SLOT_APART, SLOT_BEYOND, SLOT_UNCLEAR } slot_place;

// Whether a polygon, by its old number, surely lies before a region, as a ray meets them both.
static bool lies_before(const tl_nav_graph_changes *c, const sight_ray *ray, uint32_t slot, uint32_t polygon,
                        const tl_nav_change_sector *change)
{
    const ray_chord own = chord_of_polygon(&c->graph->tiles[slot].rings, ray, polygon);
    const ray_chord region = chord_of_region(c, ray, change);
    return own.enters <= own.leaves && region.enters <= region.leaves &&
           own.leaves <= region.enters + PLACE_MARGIN * c->graph->rounding;
}

static bool is_beyond(const tl_nav_change_sectors *s, uint32_t v, uint32_t slot, uint32_t polygon, uint32_t cone,
                      slot_place place)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    const uint32_t order = c->graph->orders[v];
    const tl_nav_sector_rays rays = { -(double)cones->right_x[cone], -(double)cones->right_z[cone],
                                      (double)cones->left_x[cone], (double)cones->left_z[cone] };
    const double margin = CONE_MARGIN * (double)tl_nav_cone_slack(cones->vertex[cone]);
    for (uint64_t i = s->first[order]; i < s->first[order + 1]; i++) {
        const tl_nav_change_sector *change = &s->sectors[i];
        if (change->slot == slot && change->polygon == polygon) {
            return true; // it is what has changed, even if it is only touched
        }
        if (tl_nav_are_rays_apart(&change->rays, &rays, margin)) {
            continue;
        }
        const tl_nav_sector sector = tl_nav_sector_of_cone(cones, cone);
        sight_ray ray = { (double)c->graph->vertices[v].x, (double)c->graph->vertices[v].z, 0.0, 0.0 };
        tl_nav_diamond_direction(tl_nav_middle_of_both(&change->sector, &sector), &ray.x, &ray.z);
        if (tl_nav_sectors_overlap(&change->sector, &sector) &&
            (place == SLOT_BEYOND || !lies_before(c, &ray, slot, polygon, change))) {
            return true;
        }
    }
    return false;
}

// From a place outside of it.
static tl_nav_sector_rays rays_of_box(const tl_nav_plan_box *box, const tl_nav_corner_vertex *vertex)
{
    tl_nav_known_edge corners[4];
    corners_of_box(box, corners);
    tl_nav_sector_rays rays = { 0.0, 0.0, 0.0, 0.0 };
    for (int i = 0; i < 4; i++) {
        const double x = (double)corners[i].x - (double)vertex->x, z = (double)corners[i].z - (double)vertex->z;
        if (i == 0 || rays.left_x * z - rays.left_z * x < 0.0) {
            rays.left_x = x;
            rays.left_z = z;
        }
        if (i == 0 || rays.right_x * z - rays.right_z * x > 0.0) {
            rays.right_x = x;
            rays.right_z = z;
        }
    }
    return rays;
}

// The same as tl_nav_are_rays_apart for all rays to a box, at less cost.
static bool lies_beside(const tl_nav_sector_rays *rays, const tl_nav_corner_vertex *vertex, const tl_nav_plan_box *box,
                        double rounding)
{
    const double x = 0.5 * ((double)box->low_x + (double)box->high_x) - (double)vertex->x;
    const double z = 0.5 * ((double)box->low_z + (double)box->high_z) - (double)vertex->z;
    const double half_x = 0.5 * ((double)box->high_x - (double)box->low_x) + PLACE_MARGIN * rounding;
    const double half_z = 0.5 * ((double)box->high_z - (double)box->low_z) + PLACE_MARGIN * rounding;
    return rays->left_x * z - rays->left_z * x < -(fabs(rays->left_x) * half_z + fabs(rays->left_z) * half_x) ||
           rays->right_x * z - rays->right_z * x > fabs(rays->right_x) * half_z + fabs(rays->right_z) * half_x;
}

static slot_place place_of_slot(const tl_nav_change_sectors *s, uint32_t order, uint32_t slot)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_vertex *vertex = &c->graph->vertices[c->lookers.numbers[order]];
    const tl_nav_plan_box *box = &c->graph->tiles[slot].box;
    const double margin = PLACE_MARGIN * c->graph->rounding;
    bool any_before = false, any_beyond = false;
    for (uint64_t i = s->first[order]; i < s->first[order + 1]; i++) {
        const tl_nav_change_sector *change = &s->sectors[i];
        if (change->slot == slot) {
            return SLOT_UNCLEAR;
        }
        if (lies_beside(&change->rays, vertex, box, c->graph->rounding)) {
            continue;
        }
        const tl_nav_sector_rays rays = is_in_box(box, vertex) ? change->rays : rays_of_box(box, vertex);
        const sight_ray ray = shared_ray(vertex, &change->rays, &rays);
        const ray_chord own = chord_of_box(box, &ray), region = chord_of_region(c, &ray, change);
        if (own.enters > own.leaves || region.enters > region.leaves) {
            return SLOT_UNCLEAR;
        }
        const bool before = own.leaves <= region.enters + margin;
        if (!before && own.enters < region.leaves - margin) {
            return SLOT_UNCLEAR;
        }
        any_before = any_before || before;
        any_beyond = any_beyond || !before;
    }
    return !any_beyond ? SLOT_APART : any_before ? SLOT_UNCLEAR : SLOT_BEYOND;
}

// Notes the slots whose cones may go; and which of them corner vertices may see beyond a change: slot and place of the
// looker, as value where the slot lies.
static tl_result note_slots(const tl_nav_change_sectors *s, tl_nav_pair_list *places)
{
    tl_nav_graph_changes *c = s->changes;
    for (uint64_t k = 0; k < looker_count(s); k++) {
        const uint32_t v = c->lookers.numbers[k];
        const tl_nav_corner_vertex *vertex = &c->graph->vertices[v];
        const uint32_t *reach = tl_nav_reach_of(vertex);
        const bool is_whole = c->graph->marks[v] == TL_NAV_MARK_WHOLE;
        for (uint32_t i = 0; i < vertex->reach_count; i++) {
            const slot_place place = is_whole ? SLOT_UNCLEAR : place_of_slot(s, (uint32_t)k, reach[i]);
            if (place != SLOT_APART) {
                const tl_sort_item item = { (uint64_t)reach[i] << 32 | k, (uint32_t)place, 0 };
                TL_TRY(tl_nav_note_slot(c, reach[i], TL_NAV_SLOT_CONES));
                TL_TRY(is_whole ? TL_OK : tl_nav_add_item(c->allocator, places, item));
            }
        }
    }
    return tl_nav_sort_pairs(c->allocator, places, NULL);
}

// A looker's cones in the slot that is gone through.
typedef struct slot_pass {
    slot_place place;
    bool keeps; // some of them
} slot_pass;

// Drops the cones of a corner vertex from `i` on, of a polygon, by its old number, whose cones end at `last`, if it
// sees any beyond a change. Returns where they end.
static tl_result drop_beyond(tl_nav_change_sectors *s, uint32_t slot, uint32_t polygon, uint32_t i, uint32_t last,
                             slot_pass *pass, uint32_t *end_out)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    const uint32_t v = tl_nav_cone_vertex(cones, i);
    bool any = false;
    uint32_t end = i;
    for (; end < last && tl_nav_cone_vertex(cones, end) == v; end++) {
        any = any || is_beyond(s, v, slot, polygon, end, pass->place);
    }
    pass->keeps = pass->keeps || !any;
    for (uint32_t k = i; any && k < end; k++) {
        const tl_sort_item item = { (uint64_t)c->graph->orders[v] << 32 | slot, k,
                                    tl_nav_new_polygon(c, slot, polygon) };
        TL_TRY(tl_nav_add_item(c->allocator, &s->beyond, item));
        TL_TRY(tl_nav_add_pair(c->allocator, &s->dropped, slot, k));
    }
    *end_out = end;
    return TL_OK;
}

// Goes through the cones of a slot for those who may see it beyond a change: `places` of the slot. `passes`, by looker:
// SLOT_APART before and after.
static tl_result find_beyond(tl_nav_change_sectors *s, uint32_t slot, const tl_sort_item *places, uint64_t count,
                             slot_pass *passes)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    for (uint64_t i = 0; i < count; i++) {
        const slot_pass pass = { (slot_place)places[i].value, false };
        passes[(uint32_t)places[i].key] = pass;
    }
    for (uint32_t p = 0; p < cones->polygon_count; p++) {
        const bool stays = tl_nav_new_polygon(c, slot, p) != TL_NO_POLYGON;
        for (uint32_t i = cones->first[p], end; stays && i < cones->first[p + 1]; i = end) {
            const uint32_t v = tl_nav_cone_vertex(cones, i);
            slot_pass *pass = c->graph->marks[v] == TL_NAV_MARK_LOOKS ? &passes[c->graph->orders[v]] : NULL;
            end = i + 1;
            if (pass != NULL && pass->place != SLOT_APART) {
                TL_TRY(drop_beyond(s, slot, p, i, cones->first[p + 1], pass, &end));
            }
        }
    }
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t order = (uint32_t)places[i].key;
        passes[order].place = SLOT_APART;
        if (!passes[order].keeps) {
            TL_TRY(tl_nav_add_pair(c->allocator, &s->lost, c->lookers.numbers[order], slot));
        }
    }
    return TL_OK;
}

static tl_result find_all_beyond(tl_nav_change_sectors *s, const tl_nav_pair_list *places)
{
    const tl_nav_graph_changes *c = s->changes;
    slot_pass *passes = tl_allocate_array(c->allocator, looker_count(s), sizeof *passes);
    if (passes == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < looker_count(s); i++) {
        passes[i].place = SLOT_APART;
    }
    tl_result result = TL_OK;
    for (uint64_t i = 0, end; i < places->count && result == TL_OK; i = end) {
        const uint32_t slot = (uint32_t)(places->items[i].key >> 32);
        end = i + 1;
        while (end < places->count && places->items[end].key >> 32 == slot) {
            end++;
        }
        if ((c->slot_bits[slot] & TL_NAV_SLOT_OTHER) == 0) {
            result = find_beyond(s, slot, places->items + i, end - i, passes);
        }
    }
    tl_release_array(c->allocator, passes, looker_count(s), sizeof *passes);
    return result;
}

// In tiles that went all cones are lost.
static tl_result note_lost_tiles(tl_nav_change_sectors *s)
{
    const tl_nav_graph_changes *c = s->changes;
    for (uint64_t k = 0; k < looker_count(s); k++) {
        for (uint64_t i = s->first[k]; i < s->first[k + 1]; i++) {
            const tl_nav_change_sector *sector = &s->sectors[i];
            if (sector->slot != TL_NAV_NO_SLOT && sector->polygon == TL_NO_POLYGON) {
                TL_TRY(tl_nav_add_pair(c->allocator, &s->lost, c->lookers.numbers[k], sector->slot));
            }
        }
    }
    return TL_OK;
}

tl_result tl_nav_find_change_sectors(tl_nav_graph_changes *changes, tl_nav_change_sectors *sectors_out)
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
    tl_nav_pair_list places = { NULL, 0, 0 };
    result = note_slots(sectors_out, &places);
    result = result == TL_OK ? find_all_beyond(sectors_out, &places) : result;
    tl_nav_free_pairs(changes->allocator, &places);
    TL_TRY(result);
    TL_TRY(note_lost_tiles(sectors_out));
    TL_TRY(tl_nav_sort_pairs(changes->allocator, &sectors_out->beyond, NULL));
    return tl_nav_unite_pairs(changes->allocator, &sectors_out->lost, NULL);
}

void tl_nav_free_change_sectors(tl_nav_change_sectors *s)
{
    const tl_allocator *allocator = s->changes->allocator;
    tl_release_array(allocator, s->first, looker_count(s) + 1, sizeof *s->first);
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
