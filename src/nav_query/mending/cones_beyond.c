// SPDX-License-Identifier: MIT
//
// Which cones lie beyond a change, or on it, and are found anew: those that a corner vertex sees in the directions of
// the change, but for what surely lies before it (change_sectors.c says why one ray tells).
//
// First where the tiles lie that a corner vertex has cones in, by their boxes: before the change, beyond it, or neither
// for sure. Then tile by tile through the cones, for all who look at once. Both are tasks.

#include "nav_query/mending/cones_beyond.h"

#include "base/arena.h"
#include "base/assert.h"

#include <math.h>
#include <string.h>

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
           own.leaves <= region.enters + TL_NAV_PLACE_MARGIN * c->graph->rounding;
}

static bool is_beyond(const tl_nav_change_sectors *s, uint32_t v, uint32_t slot, uint32_t polygon, uint32_t cone,
                      slot_place place)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    const uint32_t order = c->graph->orders[v];
    const tl_nav_sector_rays rays = { -(double)cones->right_x[cone], -(double)cones->right_z[cone],
                                      (double)cones->left_x[cone], (double)cones->left_z[cone] };
    const double margin = TL_NAV_CONE_MARGIN * (double)tl_nav_cone_slack(cones->vertex[cone]);
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
    const double half_x = 0.5 * ((double)box->high_x - (double)box->low_x) + TL_NAV_PLACE_MARGIN * rounding;
    const double half_z = 0.5 * ((double)box->high_z - (double)box->low_z) + TL_NAV_PLACE_MARGIN * rounding;
    return rays->left_x * z - rays->left_z * x < -(fabs(rays->left_x) * half_z + fabs(rays->left_z) * half_x) ||
           rays->right_x * z - rays->right_z * x > fabs(rays->right_x) * half_z + fabs(rays->right_z) * half_x;
}

static slot_place place_of_slot(const tl_nav_change_sectors *s, uint32_t order, uint32_t slot)
{
    const tl_nav_graph_changes *c = s->changes;
    const tl_nav_corner_vertex *vertex = &c->graph->vertices[c->lookers.numbers[order]];
    const tl_nav_plan_box *box = &c->graph->tiles[slot].box;
    const double margin = TL_NAV_PLACE_MARGIN * c->graph->rounding;
    bool any_before = false, any_beyond = false;
    for (uint64_t i = s->first[order]; i < s->first[order + 1]; i++) {
        const tl_nav_change_sector *change = &s->sectors[i];
        if (change->slot == slot) {
            return SLOT_UNCLEAR;
        }
        if (lies_beside(&change->rays, vertex, box, c->graph->rounding)) {
            continue;
        }
        const tl_nav_sector_rays rays = tl_nav_is_in_box(box, vertex) ? change->rays : rays_of_box(box, vertex);
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

// A looker's cones in the slot that is gone through.
typedef struct slot_pass {
    slot_place place;
    bool keeps; // some of them
} slot_pass;

// What one worker has found.
typedef struct beyond_worker {
    tl_nav_pair_list places;                // slot and place of the looker, as value where the slot lies
    slot_pass *passes;                      // by looker: SLOT_APART but while a slot is gone through
    tl_nav_pair_list beyond, dropped, lost; // as in tl_nav_change_sectors
    tl_result result;                       // of all its tasks; after a failure there is none
} beyond_worker;

// Drops the cones of a corner vertex from `i` on, of a polygon, by its old number, whose cones end at `last`, if it
// sees any beyond a change. Returns where they end.
static tl_result drop_beyond(const tl_nav_change_sectors *s, beyond_worker *worker, uint32_t slot, uint32_t polygon,
                             uint32_t i, uint32_t last, slot_pass *pass, uint32_t *end_out)
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
        TL_TRY(tl_nav_add_item(c->allocator, &worker->beyond, item));
        TL_TRY(tl_nav_add_pair(c->allocator, &worker->dropped, slot, k));
    }
    *end_out = end;
    return TL_OK;
}

// Goes through the cones of a slot for those who may see it beyond a change: `places` of the slot.
static tl_result find_beyond(const tl_nav_change_sectors *s, beyond_worker *worker, uint32_t slot,
                             const tl_sort_item *places, uint64_t count)
{
    slot_pass *passes = worker->passes;
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
                TL_TRY(drop_beyond(s, worker, slot, p, i, cones->first[p + 1], pass, &end));
            }
        }
    }
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t order = (uint32_t)places[i].key;
        passes[order].place = SLOT_APART;
        if (!passes[order].keeps) {
            TL_TRY(tl_nav_add_pair(c->allocator, &worker->lost, c->lookers.numbers[order], slot));
        }
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// All of them, as tasks.

enum { LOOKERS_A_TASK = 16 };

typedef struct beyond_team {
    const tl_nav_change_sectors *sectors;
    tl_nav_pair_list places;    // of all workers, sorted
    tl_nav_number_list by_slot; // where the places of each slot begin, and where all end
    beyond_worker *workers;
    uint32_t worker_count;
} beyond_team;

// Notes which slots a corner vertex may see beyond a change.
static tl_result place_slots(const tl_nav_change_sectors *s, uint32_t order, beyond_worker *worker)
{
    const tl_nav_graph_changes *c = s->changes;
    const uint32_t v = c->lookers.numbers[order];
    const tl_nav_corner_vertex *vertex = &c->graph->vertices[v];
    const uint32_t *reach = tl_nav_reach_of(vertex);
    for (uint32_t i = 0; i < vertex->reach_count && c->graph->marks[v] != TL_NAV_MARK_WHOLE; i++) {
        const slot_place place = place_of_slot(s, order, reach[i]);
        if (place != SLOT_APART) {
            const tl_sort_item item = { (uint64_t)reach[i] << 32 | order, (uint32_t)place, 0 };
            TL_TRY(tl_nav_add_item(c->allocator, &worker->places, item));
        }
    }
    return TL_OK;
}

static void place_slots_of_some(uint32_t index, uint32_t worker, void *user)
{
    const beyond_team *team = user;
    beyond_worker *w = &team->workers[worker];
    const uint32_t count = (uint32_t)team->sectors->changes->first_fresh;
    const uint32_t end = tl_block_end(index, LOOKERS_A_TASK, count);
    for (uint32_t k = index * LOOKERS_A_TASK; k < end && w->result == TL_OK; k++) {
        w->result = place_slots(team->sectors, k, w);
    }
}

static tl_result make_passes(const tl_nav_graph_changes *c, beyond_worker *worker)
{
    worker->passes = tl_allocate_array(c->allocator, c->first_fresh, sizeof *worker->passes);
    for (uint64_t i = 0; worker->passes != NULL && i < c->first_fresh; i++) {
        worker->passes[i].place = SLOT_APART;
    }
    return worker->passes != NULL ? TL_OK : TL_ERR_MEMORY;
}

static void find_beyond_in_slot(uint32_t index, uint32_t worker, void *user)
{
    const beyond_team *team = user;
    const tl_nav_graph_changes *c = team->sectors->changes;
    beyond_worker *w = &team->workers[worker];
    const uint32_t first = team->by_slot.numbers[index], end = team->by_slot.numbers[index + 1];
    const tl_sort_item *places = team->places.items + first;
    const uint32_t slot = (uint32_t)(places->key >> 32);
    if ((c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0) {
        return;
    }
    if (w->result == TL_OK && w->passes == NULL) {
        w->result = make_passes(c, w);
    }
    if (w->result == TL_OK) {
        w->result = find_beyond(team->sectors, w, slot, places, end - first);
    }
}

static tl_result gather_slot_places(beyond_team *team)
{
    const tl_allocator *allocator = team->sectors->changes->allocator;
    for (uint32_t w = 0; w < team->worker_count; w++) {
        TL_TRY(team->workers[w].result);
        TL_TRY(tl_nav_gather_pairs(allocator, &team->workers[w].places, &team->places));
    }
    TL_TRY(tl_nav_sort_pairs(allocator, &team->places, NULL));
    for (uint64_t i = 0; i < team->places.count; i++) {
        const uint64_t key = team->places.items[i].key;
        if (i == 0 || team->places.items[i - 1].key >> 32 != key >> 32) {
            TL_TRY(tl_nav_add_number(allocator, &team->by_slot, (uint32_t)i));
            TL_TRY(tl_nav_note_slot(team->sectors->changes, (uint32_t)(key >> 32), TL_NAV_SLOT_CONES));
        }
    }
    return tl_nav_add_number(allocator, &team->by_slot, (uint32_t)team->places.count);
}

static tl_result gather_beyond(const beyond_team *team, tl_nav_change_sectors *s)
{
    const tl_allocator *allocator = s->changes->allocator;
    for (uint32_t w = 0; w < team->worker_count; w++) {
        beyond_worker *worker = &team->workers[w];
        TL_TRY(worker->result);
        TL_TRY(tl_nav_gather_pairs(allocator, &worker->beyond, &s->beyond));
        TL_TRY(tl_nav_gather_pairs(allocator, &worker->dropped, &s->dropped));
        TL_TRY(tl_nav_gather_pairs(allocator, &worker->lost, &s->lost));
    }
    return TL_OK;
}

// Of corner vertices that look all around any slot's cones may go.
static tl_result note_whole_reaches(tl_nav_graph_changes *c)
{
    for (uint64_t k = 0; k < c->first_fresh; k++) {
        const uint32_t v = c->lookers.numbers[k];
        const tl_nav_corner_vertex *vertex = &c->graph->vertices[v];
        const uint32_t *reach = tl_nav_reach_of(vertex);
        for (uint32_t i = 0; i < vertex->reach_count && c->graph->marks[v] == TL_NAV_MARK_WHOLE; i++) {
            TL_TRY(tl_nav_note_slot(c, reach[i], TL_NAV_SLOT_CONES));
        }
    }
    return TL_OK;
}

static tl_result find_as_team(beyond_team *team, tl_nav_change_sectors *s, const tl_host *host)
{
    const uint32_t tasks = tl_block_count((uint32_t)s->changes->first_fresh, LOOKERS_A_TASK);
    team->workers = tl_allocate_array(s->changes->allocator, team->worker_count, sizeof *team->workers);
    if (team->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(team->workers, 0, team->worker_count * sizeof *team->workers);
    TL_TRY(note_whole_reaches(s->changes));
    tl_run_tasks(host, place_slots_of_some, tasks, team);
    TL_TRY(gather_slot_places(team));
    tl_run_tasks(host, find_beyond_in_slot, (uint32_t)team->by_slot.count - 1, team);
    return gather_beyond(team, s);
}

tl_result tl_nav_find_cones_beyond(tl_nav_change_sectors *sectors, const tl_host *host)
{
    const tl_nav_graph_changes *c = sectors->changes;
    beyond_team team;
    memset(&team, 0, sizeof team);
    team.sectors = sectors;
    team.worker_count = tl_worker_count(host);
    const tl_result result = find_as_team(&team, sectors, host);
    for (uint32_t w = 0; team.workers != NULL && w < team.worker_count; w++) {
        beyond_worker *worker = &team.workers[w];
        tl_nav_free_pairs(c->allocator, &worker->places);
        tl_nav_free_pairs(c->allocator, &worker->beyond);
        tl_nav_free_pairs(c->allocator, &worker->dropped);
        tl_nav_free_pairs(c->allocator, &worker->lost);
        tl_release_array(c->allocator, worker->passes, c->first_fresh, sizeof *worker->passes);
    }
    tl_release_array(c->allocator, team.workers, team.worker_count, sizeof *team.workers);
    tl_nav_free_pairs(c->allocator, &team.places);
    tl_nav_free_numbers(c->allocator, &team.by_slot);
    return result;
}
