// SPDX-License-Identifier: MIT
//
// The walls around each polygon, precomputed up to a largest reach and kept with the navmesh.
//
// A polygon's walls, sorted by the distance that a search must cover to see them, serve every shorter reach by their
// first ones (visible_walls.c). Each side of the polygon has the list of walls that come near to it, sorted too, so
// that a cut visits those few alone; and the pairs of walls that may meet inside, which are rare. What is left to the
// query depends on the radius: the intervals themselves. Looking ends where one wall forbids all of the polygon, as no
// wider agent asks for more there: so a reach beyond the level costs no more than polygons are wide. Answers are the
// same bits as those of walls gathered anew.
//
// Why not intervals for all radii: their ends are roots, and move from wall to wall as the radius grows; a list of such
// events is longer than the list of walls. Why not in the tile: a third of all walls lie across seams, so a tile alone
// knows no polygon near its border. Why not a cache that queries fill: a navmesh is read by many threads, and a query's
// own memory cannot tell a navmesh that was freed from the next one at the same address. An edit drops what it may
// change, by the places of tiles; the next call makes that anew.

#include "nav_query/wide/prepared_walls.h"
#include "nav_query/search/query_memory.h"
#include "nav_query/wide/wall_cell.h"
#include "nav_query/wide/walls_near_shape.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "math/tolerance.h"

#include <string.h>

// Nodes of the query that gathers walls, at first and at most: its memory holds the walls of one polygon. From
// MOST_BEAMS on no more are taken for the sake of lines of sight.
enum { FIRST_NODES = 1 << 10, LAST_NODES = 1 << 24, MOST_BEAMS = 1 << 15 };

// Share by which a kept distance is too small: many roundings of the distance, and of the cut that asks for it.
static const double ROUND_DOWN = 1.0 - 0x1p-20;

// A list that grows.
typedef struct item_list {
    char *at;
    uint64_t count, capacity;
    uint64_t size; // of an element
} item_list;

typedef struct wall_baker {
    const tl_navmesh *navmesh;
    tl_nav_query *query;
    double reach;
    item_list walls, hits, pairs;
    uint32_t *side_first;
    tl_nav_kept_cell *cells;
} wall_baker;

// Room for `count` > 0 more. NULL: out of memory.
static void *append_items(wall_baker *b, item_list *l, uint64_t count)
{
    if (l->count + count > l->capacity) {
        const tl_allocator *allocator = &b->navmesh->allocator;
        uint64_t capacity = 2 * (l->count + count);
        char *grown = tl_allocate_array(allocator, capacity, (size_t)l->size);
        if (grown == NULL) {
            return NULL;
        }
        if (l->count > 0) {
            memcpy(grown, l->at, (size_t)(l->count * l->size));
        }
        tl_release_array(allocator, l->at, l->capacity, (size_t)l->size);
        l->at = grown;
        l->capacity = capacity;
    }
    void *at = l->at + l->count * l->size;
    l->count += count;
    return at;
}

// What is kept of a wall near a side (clearance.h).
static float hit_distance_sq(const tl_nav_wall_cell *cell, uint32_t side, bool is_closed, const tl_nav_near_wall *wall)
{
    float distance_sq = tl_nav_side_distance_sq(cell->corners, cell->count, side, wall);
    if (is_closed) {
        return tl_nav_is_side(cell->corners, cell->count, side, wall) ? -1.0f : distance_sq;
    }
    // A wall that only a long search sees does not count for a shorter reach, however near its hidden part is.
    return tl_maxf((float)((double)distance_sq * ROUND_DOWN), wall->distance_sq);
}

// Sorted in by their distance: a side has a few.
static tl_result add_hits(wall_baker *b, const tl_nav_wall_cell *cell, uint32_t side)
{
    uint64_t first = b->hits.count;
    bool is_closed = false;
    for (uint32_t i = 0; i < cell->near.wall_count && !is_closed; i++) {
        is_closed = tl_nav_is_side(cell->corners, cell->count, side, &cell->near.walls[i]);
    }
    for (uint32_t i = 0; i < cell->near.wall_count; i++) {
        tl_nav_wall_hit hit = { hit_distance_sq(cell, side, is_closed, &cell->near.walls[i]), i };
        if (!((double)hit.distance_sq < b->reach * b->reach)) {
            continue;
        }
        if (append_items(b, &b->hits, 1) == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_nav_wall_hit *hits = (tl_nav_wall_hit *)(void *)b->hits.at;
        uint64_t at = b->hits.count - 1;
        for (; at > first && hits[at - 1].distance_sq > hit.distance_sq; at--) {
            hits[at] = hits[at - 1];
        }
        hits[at] = hit;
    }
    return TL_OK;
}

// Walls that meet in a corner of the outline take the same off both edges there: a cut joins them anyway.
static bool meet_in_corner(const tl_nav_wall_cell *cell, tl_nav_segment a, tl_nav_segment b)
{
    const tl_nav_spot ends[2] = { a.a, a.b };
    for (int e = 0; e < 2; e++) {
        bool shared = (ends[e].x == b.a.x && ends[e].z == b.a.z) || (ends[e].x == b.b.x && ends[e].z == b.b.z);
        for (uint32_t i = 0; shared && i < cell->count; i++) {
            if (cell->corners[i].x == ends[e].x && cell->corners[i].z == ends[e].z) {
                return true;
            }
        }
    }
    return false;
}

static tl_result add_pairs(wall_baker *b, const tl_nav_wall_cell *cell)
{
    uint64_t first = b->pairs.count;
    for (uint32_t i = 0; i < cell->near.wall_count; i++) {
        for (uint32_t k = i + 1; k < cell->near.wall_count; k++) {
            tl_nav_wall_pair pair;
            if (!tl_nav_pair_walls(cell->corners, cell->count, cell->near.walls, i, k, &pair) ||
                !(pair.distance_sq < 4.0 * b->reach * b->reach) ||
                meet_in_corner(cell, tl_nav_segment_of_wall(&cell->near.walls[i]),
                               tl_nav_segment_of_wall(&cell->near.walls[k]))) {
                continue;
            }
            if (append_items(b, &b->pairs, 1) == NULL) {
                return TL_ERR_MEMORY;
            }
            tl_nav_wall_pair *pairs = (tl_nav_wall_pair *)(void *)b->pairs.at;
            uint64_t at = b->pairs.count - 1;
            for (; at > first && pairs[at - 1].distance_sq > pair.distance_sq; at--) {
                pairs[at] = pairs[at - 1];
            }
            pairs[at] = pair;
        }
    }
    return TL_OK;
}

static tl_result make_wall_query(wall_baker *b, uint32_t nodes)
{
    tl_nav_query_release(b->query);
    b->query = NULL;
    const tl_nav_query_sizes none = { 0, 0 };
    return tl_nav_query_allocate(nodes, none, &b->navmesh->allocator, &b->query);
}

// A first reach to look for walls around a polygon: as wide as it is, and no less than rounding asks of a wall that
// forbids it (visible_walls.c, end_reach_at_cover).
static double first_reach(const wall_baker *b, uint32_t slot, uint32_t polygon)
{
    tl_nav_spot corners[TL_NAV_MAX_CORNERS];
    uint32_t count = tl_nav_corner_spots(b->navmesh, slot, polygon, corners);
    double widest_sq = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        widest_sq = tl_max_f64(tl_nav_spot_distance_sq(corners[0], corners[i]), widest_sq);
    }
    const double slack = TL_NAV_PLACE_ROUNDINGS * (double)TL_FLOAT_ROUNDING * (double)b->navmesh->extent;
    return tl_min_f64(2.0 * (sqrt(widest_sq) + 8.0 * slack), b->reach);
}

// Gathers the walls around a polygon, with more nodes if need be. The list lies in the query's memory. Looks about
// twice as far as it must: beams that start with all of the reach run over the whole level before they come to the
// wall that ends it, and the rounding of a reach far beyond the level would be larger than the level.
static tl_result gather_walls(wall_baker *b, uint32_t slot, uint32_t polygon, tl_nav_wall_cell *cell)
{
    const double whole_level = 4.0 * (double)b->navmesh->extent;
    double reach = first_reach(b, slot, polygon);
    for (;;) {
        tl_nav_clearance clearance;
        tl_nav_clearance_begin(b->query, b->navmesh, NULL, reach, &clearance);
        clearance.filter = NULL;
        clearance.is_enough = true;
        if (tl_nav_gather_cell(&clearance, slot, polygon, reach, cell)) {
            tl_nav_near_walls *near = &cell->near;
            if (near->within < reach || reach == b->reach) {
                near->wall_count = tl_nav_count_within(near->walls, near->wall_count, near->within);
                cell->distance = b->reach;
                return TL_OK;
            }
            reach = reach > 0.0 && 2.0 * reach < whole_level ? tl_min_f64(2.0 * reach, b->reach) : b->reach;
            continue;
        }
        if (b->query->max_nodes == LAST_NODES || (clearance.is_out_of_beams && b->query->max_nodes >= MOST_BEAMS)) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(make_wall_query(b, 2 * b->query->max_nodes));
    }
}

static tl_result add_cell(wall_baker *b, uint32_t slot, uint32_t polygon)
{
    tl_nav_wall_cell cell;
    TL_TRY(gather_walls(b, slot, polygon, &cell));
    b->cells[polygon].wall = (uint32_t)b->walls.count;
    b->cells[polygon].pair = (uint32_t)b->pairs.count;
    b->cells[polygon].within = cell.near.within < b->reach ? (float)cell.near.within : INFINITY;
    const uint32_t first_corner = tl_nav_tile_first_corner(b->navmesh->slots[slot].tile, polygon);
    for (uint32_t side = 0; side < cell.count; side++) {
        b->side_first[first_corner + side] = (uint32_t)b->hits.count;
        TL_TRY(add_hits(b, &cell, side));
    }
    TL_TRY(add_pairs(b, &cell));
    if (cell.near.wall_count > 0) {
        void *walls = append_items(b, &b->walls, cell.near.wall_count);
        if (walls == NULL) {
            return TL_ERR_MEMORY;
        }
        memcpy(walls, cell.near.walls, cell.near.wall_count * sizeof *cell.near.walls);
    }
    return b->walls.count > UINT32_MAX || b->hits.count > UINT32_MAX || b->pairs.count > UINT32_MAX ? TL_ERR_LIMIT
                                                                                                    : TL_OK;
}

// One block: the head and the arrays, those of doubles first.
static tl_nav_kept_walls *pack_walls(const wall_baker *b, uint32_t polygons, uint32_t corners)
{
    uint64_t sizes[5] = { b->pairs.count * sizeof(tl_nav_wall_pair),
                          ((uint64_t)polygons + 1) * sizeof(tl_nav_kept_cell),
                          ((uint64_t)corners + 1) * sizeof(uint32_t), b->walls.count * sizeof(tl_nav_near_wall),
                          b->hits.count * sizeof(tl_nav_wall_hit) };
    const void *from[5] = { b->pairs.at, b->cells, b->side_first, b->walls.at, b->hits.at };
    uint64_t size = sizeof(tl_nav_kept_walls);
    for (int i = 0; i < 5; i++) {
        size += sizes[i];
    }
    char *block = tl_allocate_array(&b->navmesh->allocator, size, 1);
    if (block == NULL) {
        return NULL;
    }
    void *to[5];
    char *at = block + sizeof(tl_nav_kept_walls);
    for (int i = 0; i < 5; i++) {
        to[i] = at;
        if (sizes[i] > 0) {
            memcpy(at, from[i], (size_t)sizes[i]);
        }
        at += sizes[i];
    }
    tl_nav_kept_walls *kept = (tl_nav_kept_walls *)(void *)block;
    kept->pairs = to[0];
    kept->cells = to[1];
    kept->side_first = to[2];
    kept->walls = to[3];
    kept->hits = to[4];
    kept->size = size;
    return kept;
}

static tl_result make_slot(wall_baker *b, uint32_t slot, tl_nav_kept_walls **kept_out)
{
    const tl_nav_tile *tile = b->navmesh->slots[slot].tile;
    const tl_allocator *allocator = &b->navmesh->allocator;
    uint64_t polygons = (uint64_t)tile->polygon_count + 1;
    uint64_t corners = (uint64_t)tile->corner_count + 1;
    b->walls.count = b->hits.count = b->pairs.count = 0;
    b->cells = tl_allocate_array(allocator, polygons, sizeof *b->cells);
    b->side_first = tl_allocate_array(allocator, corners, sizeof *b->side_first);
    tl_result result = b->cells != NULL && b->side_first != NULL ? TL_OK : TL_ERR_MEMORY;
    for (uint32_t p = 0; p < tile->polygon_count && result == TL_OK; p++) {
        result = add_cell(b, slot, p);
    }
    if (result == TL_OK) {
        b->cells[tile->polygon_count].wall = (uint32_t)b->walls.count;
        b->cells[tile->polygon_count].pair = (uint32_t)b->pairs.count;
        b->side_first[tile->corner_count] = (uint32_t)b->hits.count;
        *kept_out = pack_walls(b, tile->polygon_count, tile->corner_count);
        result = *kept_out != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    tl_release_array(allocator, b->cells, polygons, sizeof *b->cells);
    tl_release_array(allocator, b->side_first, corners, sizeof *b->side_first);
    return result;
}

static void drop_kept_walls(tl_navmesh *navmesh, tl_nav_slot *slot)
{
    if (slot->kept_walls != NULL) {
        navmesh->kept_bytes -= slot->kept_walls->size;
        tl_release_array(&navmesh->allocator, slot->kept_walls, slot->kept_walls->size, 1);
        slot->kept_walls = NULL;
        tl_nav_touch_slot(navmesh, (uint32_t)(slot - navmesh->slots));
    }
}

static void drop_all_walls(tl_navmesh *navmesh)
{
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        drop_kept_walls(navmesh, &navmesh->slots[i]);
    }
}

static void invalidate_walls(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    if (navmesh->kept_bytes == 0) {
        return;
    }
    // Beams look as far as the reach, and an edit changes the rings of tiles around its own.
    double tile_metres = (double)navmesh->tile_size * (double)navmesh->cell_size;
    double span = tile_metres > 0.0 ? ceil(navmesh->kept_reach / tile_metres) + 1.0 : (double)INFINITY;
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        tl_nav_slot *slot = &navmesh->slots[i];
        if (slot->kept_walls != NULL && fabs((double)slot->tile->tile_x - (double)tile_x) <= span &&
            fabs((double)slot->tile->tile_z - (double)tile_z) <= span) {
            drop_kept_walls(navmesh, slot);
        }
    }
}

tl_nav_wide_def tl_default_nav_wide_def(void)
{
    tl_nav_wide_def def;
    memset(&def, 0, sizeof def);
    def.max_radius = 1.5f;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static void fill_report(const tl_navmesh *navmesh, uint32_t made, tl_nav_wide_report *report)
{
    report->made_tile_count = made;
    report->bytes = navmesh->kept_bytes;
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        const tl_nav_slot *slot = &navmesh->slots[i];
        if (slot->kept_walls != NULL) {
            report->tile_count++;
            report->wall_count += slot->kept_walls->cells[slot->tile->polygon_count].wall;
        }
    }
}

static tl_result make_all(wall_baker *b, tl_navmesh *navmesh, uint32_t *made)
{
    TL_TRY(make_wall_query(b, FIRST_NODES));
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        tl_nav_slot *slot = &navmesh->slots[i];
        if (slot->tile != NULL && slot->kept_walls == NULL) {
            TL_TRY(make_slot(b, i, &slot->kept_walls));
            tl_nav_touch_slot(navmesh, i);
            navmesh->kept_bytes += slot->kept_walls->size;
            (*made)++;
        }
    }
    return TL_OK;
}

static tl_result check_wide_def(const tl_navmesh *navmesh, const tl_nav_wide_def *def, tl_report *report)
{
    if (navmesh == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "navmesh", "it is NULL");
    }
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_wide_def()", report));
    if (!isfinite(def->max_radius)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "max_radius", "make it a number");
    }
    return def->max_radius >= 0.0f ? TL_OK : tl_report_field(report, TL_ERR_ARGUMENT, "max_radius", "make it >= 0");
}

// Sets how far walls are found; what was kept for another distance goes.
static void set_reach(tl_navmesh *navmesh, float max_radius)
{
    static const tl_nav_derived derived = { invalidate_walls, drop_all_walls, NULL };
    navmesh->derived[TL_NAV_DERIVED_WALLS] = &derived;
    double reach = 0.0;
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        if (navmesh->slots[i].tile != NULL) {
            reach = fmax(reach, tl_nav_extra_reach(navmesh->slots[i].tile, max_radius));
        }
    }
    double touch = tl_nav_touch_of(navmesh);
    if (reach != navmesh->kept_reach || touch != navmesh->kept_touch) {
        drop_all_walls(navmesh);
        navmesh->kept_reach = reach;
        navmesh->kept_touch = touch;
    }
}

tl_result tl_navmesh_prepare_wide(tl_navmesh *navmesh, const tl_nav_wide_def *def, tl_nav_wide_report *report_out)
{
    const tl_nav_wide_def used = def != NULL ? *def : tl_default_nav_wide_def();
    tl_report *report = report_out != NULL ? &report_out->base : NULL;
    if (report_out != NULL) {
        memset(report_out, 0, sizeof *report_out);
    }
    tl_report_begin(report, "walls");
    TL_TRY(check_wide_def(navmesh, &used, report));
    set_reach(navmesh, used.max_radius);
    wall_baker b;
    memset(&b, 0, sizeof b);
    b.navmesh = navmesh;
    b.reach = navmesh->kept_reach;
    b.walls.size = sizeof(tl_nav_near_wall);
    b.hits.size = sizeof(tl_nav_wall_hit);
    b.pairs.size = sizeof(tl_nav_wall_pair);
    uint32_t made = 0;
    tl_result result = b.reach > 0.0 ? make_all(&b, navmesh, &made) : TL_OK;
    tl_nav_query_release(b.query);
    item_list *lists[3] = { &b.walls, &b.hits, &b.pairs };
    for (int i = 0; i < 3; i++) {
        tl_release_array(&navmesh->allocator, lists[i]->at, lists[i]->capacity, (size_t)lists[i]->size);
    }
    if (report_out != NULL) {
        fill_report(navmesh, made, report_out);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Asking.

bool tl_nav_gather_cell(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, double distance,
                        tl_nav_wall_cell *cell_out)
{
    cell_out->distance = distance;
    cell_out->is_kept = false;
    cell_out->count = tl_nav_corner_spots(clearance->navmesh, slot, polygon, cell_out->corners);
    return tl_nav_find_visible_walls(clearance, slot, polygon, cell_out->corners, cell_out->count, distance,
                                     &cell_out->near);
}

static bool is_covered(const tl_nav_wall_cell *cell, double distance)
{
    bool covered = false;
    for (uint32_t i = 0; distance > 0.0 && i < cell->near.wall_count && !covered; i++) {
        covered =
            tl_nav_wall_covers(tl_nav_segment_of_wall(&cell->near.walls[i]), cell->corners, cell->count, distance);
    }
    return covered;
}

bool tl_nav_wall_cell_of(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon, double distance,
                         tl_nav_wall_cell *cell_out)
{
    const tl_navmesh *navmesh = clearance->navmesh;
    const tl_nav_kept_walls *kept = navmesh->slots[slot].kept_walls;
    if (kept == NULL || clearance->filter != NULL || distance > navmesh->kept_reach ||
        clearance->touch != navmesh->kept_touch) {
        return tl_nav_gather_cell(clearance, slot, polygon, distance, cell_out);
    }
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    const tl_nav_kept_cell *cell = &kept->cells[polygon];
    memset(&cell_out->near, 0, sizeof cell_out->near);
    cell_out->distance = distance;
    cell_out->is_kept = true;
    cell_out->count = tl_nav_corner_spots(navmesh, slot, polygon, cell_out->corners);
    cell_out->near.walls = kept->walls + cell[0].wall;
    cell_out->near.wall_count = tl_nav_count_within(cell_out->near.walls, cell[1].wall - cell[0].wall, distance);
    cell_out->near.is_covered = is_covered(cell_out, clearance->cover);
    cell_out->near.within = tl_min_f64((double)cell->within, distance);
    cell_out->side_first = kept->side_first + tl_nav_tile_first_corner(tile, polygon);
    cell_out->hits = kept->hits;
    cell_out->pairs = kept->pairs + cell[0].pair;
    cell_out->pair_count = cell[1].pair - cell[0].pair;
    return true;
}
