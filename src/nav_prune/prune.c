// SPDX-License-Identifier: MIT
//
// Pruning by connected components (islands): all tiles are added to a navmesh, which knows the component of each
// polygon; each island is kept or removed as a whole; the tiles that lose polygons are baked again without them. No
// link is cut, since links never leave an island.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "nav_prune/solids.h"

#include <talus/nav_prune.h>
#include <talus/nav_query.h>

#include <math.h>
#include <string.h>

typedef enum prune_verdict { PRUNE_KEPT, PRUNE_INSIDE, PRUNE_UNREACHABLE, PRUNE_SMALL } prune_verdict;

typedef struct prune_island {
    uint64_t polygons;
    double area;
    bool has_seed;
    bool is_free; ///< the middle of some polygon is not inside a solid
    uint8_t verdict;
} prune_island;

typedef struct prune_job {
    const tl_nav_prune_def *def;
    tl_nav_tiles *tiles;
    tl_navmesh *navmesh;
    prune_island *islands; ///< by the navmesh's numbers, not all of which are in use
    uint64_t island_capacity;
    tl_nav_tile **rebaked;     ///< [tiles->tile_count] in place of those that change; NULL: as it is, or `gone`
    tl_nav_tile **removed;     ///< [tiles->tile_count] what they lose, when it is wanted; NULL: nothing
    uint8_t *gone;             ///< [tiles->tile_count]
    tl_nav_tiles *removed_out; ///< or NULL
    tl_nav_prune_report *report;
} prune_job;

tl_nav_prune_def tl_default_nav_prune_def(void)
{
    tl_nav_prune_def def;
    memset(&def, 0, sizeof def);
    def.seed_extents = tl_vec3_make(2.0f, 4.0f, 2.0f);
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static tl_result check_prune_def(const tl_nav_prune_def *def, tl_report *report)
{
    const tl_vec3 e = def->seed_extents;
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_prune_def()", report));
    if (def->seeds == NULL && def->seed_count > 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "seeds", "give points, or a seed_count of 0");
    }
    if (!(e.x >= 0.0f && e.y >= 0.0f && e.z >= 0.0f) || !tl_is_finite(e)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "seed_extents", "make them finite and >= 0");
    }
    if (!(def->min_area >= 0.0) || !isfinite(def->min_area)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "min_area", "make it finite and >= 0");
    }
    return TL_OK;
}

// ---- Islands ---------------------------------------------------------------------------------------------------

static uint32_t island_number(const prune_job *job, uint32_t tile, uint32_t polygon)
{
    uint32_t number = 0;
    tl_navmesh_island(job->navmesh, tl_navmesh_polygon_ref(job->navmesh, tile, polygon), &number);
    return number;
}

static tl_result assemble_tiles(prune_job *job, tl_report *report)
{
    TL_TRY(tl_navmesh_create(job->def->host.allocator, &job->navmesh));
    const uint32_t count = job->tiles->tile_count;
    TL_TRY(tl_navmesh_add_tiles(job->navmesh, job->tiles->tiles, count, TL_NAV_TILE_BORROWED, report));
    for (uint32_t i = 0; i < count; i++) {
        TL_ASSERT(tl_navmesh_slot_tile(job->navmesh, i) == job->tiles->tiles[i]);
    }
    return TL_OK;
}

static tl_result measure_islands(prune_job *job)
{
    uint32_t greatest = 0;
    for (uint32_t t = 0; t < job->tiles->tile_count; t++) {
        for (uint32_t p = 0; p < job->tiles->tiles[t]->polygon_count; p++) {
            const uint32_t number = island_number(job, t, p);
            greatest = tl_max_u32(greatest, number);
        }
    }
    job->islands = tl_allocate_array(job->def->host.allocator, (uint64_t)greatest + 1, sizeof *job->islands);
    if (job->islands == NULL) {
        return TL_ERR_MEMORY;
    }
    job->island_capacity = (uint64_t)greatest + 1;
    memset(job->islands, 0, (size_t)job->island_capacity * sizeof *job->islands);
    for (uint32_t t = 0; t < job->tiles->tile_count; t++) {
        for (uint32_t p = 0; p < job->tiles->tiles[t]->polygon_count; p++) {
            prune_island *i = &job->islands[island_number(job, t, p)];
            job->report->island_count += i->polygons == 0;
            i->polygons++;
            i->area += tl_nav_tile_polygon_area(job->tiles->tiles[t], p);
        }
    }
    return TL_OK;
}

static tl_result mark_seeded(prune_job *job, tl_report *report)
{
    for (uint32_t s = 0; s < job->def->seed_count; s++) {
        tl_nav_location location;
        const tl_result result =
            tl_navmesh_find_nearest(job->navmesh, NULL, job->def->seeds[s], job->def->seed_extents, &location);
        if (result != TL_OK) {
            return tl_report_fail(report, result == TL_NOT_FOUND ? TL_ERR_ARGUMENT : result, "seed", s,
                                  "give a point on the navmesh, or larger extents to look for it");
        }
        uint32_t number = 0;
        tl_navmesh_island(job->navmesh, location.polygon, &number);
        job->islands[number].has_seed = true;
    }
    return TL_OK;
}

// ---- Solids ----------------------------------------------------------------------------------------------------

// Over the mean of the corners, which lies in the polygon.
static tl_vec3 point_over(const prune_job *job, uint32_t tile, uint32_t polygon)
{
    const tl_nav_tile *t = job->tiles->tiles[tile];
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(t, polygon, &count);
    double x = 0.0, z = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        x += (double)corners[k].x / (double)count;
        z += (double)corners[k].z / (double)count;
    }
    tl_vec3 middle = tl_vec3_make((float)x, corners[0].y, (float)z);
    tl_navmesh_height(job->navmesh, tl_navmesh_polygon_ref(job->navmesh, tile, polygon), middle.x, middle.z, &middle.y);
    middle.y += 0.5f * t->agent_height;
    return middle;
}

static tl_result look_inside(prune_job *job, tl_solids *solids)
{
    for (uint32_t t = 0; t < job->tiles->tile_count; t++) {
        TL_TRY(tl_progress_update(&job->def->host, "prune", t, job->tiles->tile_count));
        for (uint32_t p = 0; p < job->tiles->tiles[t]->polygon_count; p++) {
            prune_island *i = &job->islands[island_number(job, t, p)];
            bool inside = false;
            if (!i->has_seed && !i->is_free) {
                TL_TRY(tl_solids_contain(solids, point_over(job, t, p), &inside));
            }
            i->is_free = !inside;
        }
    }
    return TL_OK;
}

static tl_result find_insides(prune_job *job, tl_report *report)
{
    tl_solids solids;
    tl_result result = tl_solids_init(job->def->solids, &job->def->host, &solids, report);
    job->report->solid_count = solids.outward_count;
    if (result == TL_OK) {
        result = look_inside(job, &solids);
    }
    tl_solids_free(&solids);
    return result;
}

// ---- Tiles -----------------------------------------------------------------------------------------------------

static void judge(prune_job *job)
{
    tl_nav_pruned *sums[] = { NULL, &job->report->inside, &job->report->unreachable, &job->report->small };
    for (uint64_t n = 0; n < job->island_capacity; n++) {
        prune_island *i = &job->islands[n];
        if (i->polygons == 0 || i->has_seed) {
            continue;
        }
        const bool inside = job->def->solids != NULL && !i->is_free;
        i->verdict = inside                         ? PRUNE_INSIDE
                     : job->def->seed_count > 0     ? PRUNE_UNREACHABLE
                     : i->area < job->def->min_area ? PRUNE_SMALL
                                                    : PRUNE_KEPT;
        if (i->verdict != PRUNE_KEPT) {
            tl_nav_pruned *sum = sums[i->verdict];
            sum->islands++;
            sum->polygons += i->polygons;
            sum->area += i->area;
        }
    }
}

// The polygons that a tile loses, as a tile; their flags say why.
static tl_result encode_removed(prune_job *job, uint32_t t, uint8_t *keep, tl_report *report)
{
    static const uint64_t flags_of[] = { 0, TL_NAV_PRUNED_INSIDE, TL_NAV_PRUNED_UNREACHABLE, TL_NAV_PRUNED_SMALL };
    const tl_nav_tile *tile = job->tiles->tiles[t];
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        keep[p] = !keep[p];
    }
    TL_TRY(tl_nav_tile_subset(tile, keep, job->def->host.allocator, &job->removed[t], report));
    for (uint32_t p = 0, k = 0; p < tile->polygon_count; p++) {
        if (keep[p]) {
            tl_nav_tile_set_flags(job->removed[t], k++, flags_of[job->islands[island_number(job, t, p)].verdict]);
        }
    }
    return TL_OK;
}

static tl_result rebake_tile(prune_job *job, uint32_t t, uint8_t *keep, tl_report *report)
{
    const tl_nav_tile *tile = job->tiles->tiles[t];
    uint32_t kept = 0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        keep[p] = job->islands[island_number(job, t, p)].verdict == PRUNE_KEPT;
        kept += keep[p];
    }
    job->gone[t] = kept == 0;
    if (kept == tile->polygon_count) {
        return TL_OK;
    }
    if (kept > 0) {
        TL_TRY(tl_nav_tile_subset(tile, keep, job->def->host.allocator, &job->rebaked[t], report));
    }
    return job->removed_out != NULL ? encode_removed(job, t, keep, report) : TL_OK;
}

static tl_result rebake_tiles(prune_job *job, tl_report *report)
{
    const tl_allocator *allocator = job->def->host.allocator;
    const uint32_t count = job->tiles->tile_count;
    uint32_t max_polygons = 0;
    for (uint32_t t = 0; t < count; t++) {
        max_polygons = tl_max_u32(max_polygons, job->tiles->tiles[t]->polygon_count);
    }
    job->rebaked = tl_allocate_array(allocator, count, sizeof(*job->rebaked));
    job->removed = tl_allocate_array(allocator, count, sizeof(*job->removed));
    job->gone = tl_allocate_array(allocator, count, sizeof *job->gone);
    uint8_t *keep = tl_allocate_array(allocator, max_polygons, sizeof *keep);
    const bool has_room = job->rebaked != NULL && job->removed != NULL && job->gone != NULL && keep != NULL;
    tl_result result = has_room ? TL_OK : TL_ERR_MEMORY;
    if (job->rebaked != NULL) {
        memset(job->rebaked, 0, count * sizeof(*job->rebaked));
    }
    if (job->removed != NULL) {
        memset(job->removed, 0, count * sizeof(*job->removed));
    }
    for (uint32_t t = 0; result == TL_OK && t < count; t++) {
        result = rebake_tile(job, t, keep, report);
    }
    tl_release_array(allocator, keep, max_polygons, sizeof *keep);
    return result;
}

// Hands the removed polygons' tiles over, in an array as long as their number.
static tl_result hand_over_removed(prune_job *job)
{
    const tl_allocator *allocator = job->def->host.allocator;
    tl_nav_tiles *out = job->removed_out;
    uint32_t count = 0;
    for (uint32_t t = 0; t < job->tiles->tile_count; t++) {
        count += job->removed[t] != NULL;
    }
    tl_nav_tile **tiles = tl_allocate_array(allocator, count, sizeof(*tiles));
    if (tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t t = 0, k = 0; t < job->tiles->tile_count; t++) {
        if (job->removed[t] != NULL) {
            tiles[k++] = job->removed[t];
            job->removed[t] = NULL;
        }
    }
    out->tiles = tiles;
    out->tile_count = count;
    out->tiles_x = job->tiles->tiles_x;
    out->tiles_z = job->tiles->tiles_z;
    out->allocator = tl_allocator_or_default(allocator);
    return TL_OK;
}

// The array of tiles is made as long as their new number, which tl_nav_tiles_free rests on.
static tl_result replace_tiles(prune_job *job)
{
    tl_nav_tiles *tiles = job->tiles;
    const tl_allocator *allocator = tiles->tiles != NULL ? &tiles->allocator : job->def->host.allocator;
    for (uint32_t t = 0; t < tiles->tile_count; t++) {
        job->report->removed_tiles += job->gone[t];
        job->report->changed_tiles += job->rebaked[t] != NULL;
    }
    tl_nav_tile **left = tl_allocate_array(allocator, tiles->tile_count - job->report->removed_tiles, sizeof(*left));
    if (left == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t t = 0; t < tiles->tile_count; t++) {
        tl_nav_tile *tile = tiles->tiles[t];
        if (job->gone[t] || job->rebaked[t] != NULL) {
            tl_blob_free(tile);
            tile = job->rebaked[t];
            job->rebaked[t] = NULL;
        }
        if (tile != NULL) {
            left[count++] = tile;
        }
    }
    tl_release_array(allocator, tiles->tiles, tiles->tile_count, sizeof(*left));
    tiles->allocator = tl_allocator_or_default(allocator);
    tiles->tiles = left;
    tiles->tile_count = count;
    return TL_OK;
}

static tl_result prune(prune_job *job, tl_report *report)
{
    TL_TRY(check_prune_def(job->def, report));
    TL_TRY(assemble_tiles(job, report));
    TL_TRY(measure_islands(job));
    TL_TRY(mark_seeded(job, report));
    if (job->def->solids != NULL) {
        TL_TRY(find_insides(job, report));
    }
    judge(job);
    tl_report_begin(report, "prune");
    TL_TRY(rebake_tiles(job, report));
    TL_TRY(tl_progress_update(&job->def->host, "prune", job->tiles->tile_count, job->tiles->tile_count));
    tl_navmesh_destroy(job->navmesh); // it looks at its tiles to the last
    job->navmesh = NULL;
    if (job->removed_out != NULL) {
        TL_TRY(hand_over_removed(job));
    }
    return replace_tiles(job);
}

static void free_prune_job(prune_job *job, uint32_t tile_count)
{
    const tl_allocator *allocator = job->def->host.allocator;
    for (uint32_t t = 0; job->rebaked != NULL && t < tile_count; t++) {
        tl_blob_free(job->rebaked[t]);
    }
    for (uint32_t t = 0; job->removed != NULL && t < tile_count; t++) {
        tl_blob_free(job->removed[t]);
    }
    tl_release_array(allocator, job->rebaked, tile_count, sizeof(*job->rebaked));
    tl_release_array(allocator, job->removed, tile_count, sizeof(*job->removed));
    tl_release_array(allocator, job->gone, tile_count, sizeof *job->gone);
    tl_release_array(allocator, job->islands, job->island_capacity, sizeof *job->islands);
    tl_navmesh_destroy(job->navmesh);
}

tl_result tl_nav_prune(const tl_nav_prune_def *def, tl_nav_tiles *tiles, tl_nav_tiles *removed_out,
                       tl_nav_prune_report *report_out)
{
    const tl_nav_prune_def default_def = tl_default_nav_prune_def();
    tl_nav_prune_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "prune");
    if (removed_out != NULL) {
        memset(removed_out, 0, sizeof *removed_out);
    }
    prune_job job;
    memset(&job, 0, sizeof job);
    job.def = def != NULL ? def : &default_def;
    job.tiles = tiles;
    job.removed_out = removed_out;
    job.report = &report;
    const uint32_t count = tiles != NULL ? tiles->tile_count : 0;
    const tl_result result = tiles != NULL
                                 ? prune(&job, &report.base)
                                 : tl_report_field(&report.base, TL_ERR_ARGUMENT, "tiles", "it may not be NULL");
    free_prune_job(&job, count);
    if (result != TL_OK) {
        tl_nav_tiles_free(removed_out);
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}
