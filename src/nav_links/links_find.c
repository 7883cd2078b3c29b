// SPDX-License-Identifier: MIT
//
// From a navmesh to its links: places along ledges, ways from each (in parallel: no two know of one another), then the
// selection, in an order that depends on neither threads nor chance.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_links/layout.h"
#include "nav_links/selection.h"

#include <math.h>
#include <string.h>

enum { PLACES_A_TASK = 64, TASKS_A_BATCH = 64 };

// Thinner chords cost sweeps, a thicker capsule costs ways: a sixteenth of the radius, or of a cell.
#define MARGIN_SHARE 16.0f

tl_nav_links_def tl_default_nav_links_def(void)
{
    tl_nav_links_def def;
    memset(&def, 0, sizeof def);
    def.spacing = 0.5f;
    def.max_drop = 4.0f;
    def.max_jump = 3.0f;
    def.jump_height = 1.0f;
    def.max_speed = 6.0f;
    def.gravity = 9.81f;
    def.max_climb = 1.2f;
    def.least_gain = 3.0f;
    def.max_nodes = 4096;
    return def;
}

static tl_result check_def(const tl_nav_links_def *def, tl_report *report)
{
    const float values[] = { def->spacing,   def->max_drop, def->max_jump,  def->jump_height,
                             def->max_speed, def->gravity,  def->max_climb, def->least_gain };
    for (uint32_t i = 0; i < TL_COUNT_OF(values); i++) {
        if (!isfinite(values[i])) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "setting", i, NULL);
        }
        if (values[i] < 0.0f) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "setting", i, "settings are not negative");
        }
    }
    bool sane = def->spacing > 0.0f && def->gravity > 0.0f && def->least_gain >= 1.0f && def->max_nodes >= 2;
    return sane ? TL_OK
                : tl_report_fail(report, TL_ERR_ARGUMENT, "setting", TL_NO_ELEMENT,
                                 "spacing and gravity are above 0, least_gain is at least 1, max_nodes at least 2");
}

typedef struct link_search {
    tl_nav_landing_search landing;
    tl_nav_ledge_point *places;
    tl_nav_way_try *tries; // TL_NAV_WAYS_A_PLACE a place
    uint64_t place_count;
    uint64_t batch_begin;
} link_search;

static void try_places(uint32_t index, uint32_t worker, void *user)
{
    link_search *s = user;
    (void)worker;
    uint64_t begin = s->batch_begin + (uint64_t)index * PLACES_A_TASK;
    uint64_t end = begin + PLACES_A_TASK < s->place_count ? begin + PLACES_A_TASK : s->place_count;
    for (uint64_t i = begin; i < end; i++) {
        tl_nav_try_ways(&s->landing, &s->places[i], &s->tries[TL_NAV_WAYS_A_PLACE * i]);
    }
}

static tl_result try_all(link_search *s)
{
    const tl_host *host = s->landing.def->host;
    const uint64_t batch = (uint64_t)PLACES_A_TASK * TASKS_A_BATCH;
    for (s->batch_begin = 0; s->batch_begin < s->place_count; s->batch_begin += batch) {
        TL_TRY(tl_progress_update(host, "sweeps", s->batch_begin, s->place_count));
        uint64_t left = s->place_count - s->batch_begin;
        uint64_t tasks = ((left < batch ? left : batch) + PLACES_A_TASK - 1) / PLACES_A_TASK;
        tl_run_tasks(host, try_places, (uint32_t)tasks, s);
    }
    return tl_progress_update(host, "sweeps", s->place_count, s->place_count);
}

// Counts fates, and moves the proven ways to the front.
static uint32_t gather(link_search *s, tl_nav_links_report *report)
{
    uint32_t count = 0;
    for (uint64_t i = 0; i < TL_NAV_WAYS_A_PLACE * s->place_count; i++) {
        const tl_nav_way_try *way = &s->tries[i];
        tl_nav_links_count *counts = &report->kinds[way->link.kind];
        report->no_landing += way->fate == TL_NAV_WAY_NONE ? 1 : 0;
        report->too_fast += way->fate == TL_NAV_WAY_TOO_FAST ? 1 : 0;
        counts->tried += way->fate == TL_NAV_WAY_BLOCKED || way->fate == TL_NAV_WAY_FREE ? 1 : 0;
        counts->blocked += way->fate == TL_NAV_WAY_BLOCKED ? 1 : 0;
        if (way->fate == TL_NAV_WAY_FREE) {
            s->tries[count++] = *way;
        }
    }
    return count;
}

static const tl_nav_tile *first_tile(const tl_navmesh *navmesh)
{
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        if (tl_navmesh_slot_tile(navmesh, slot) != NULL) {
            return tl_navmesh_slot_tile(navmesh, slot);
        }
    }
    return NULL;
}

static void prepare(link_search *s, const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                    const tl_nav_tile *tile)
{
    float margin = fmaxf(tile->agent_radius, tile->cell_size) / MARGIN_SHARE;
    s->landing.def = def;
    s->landing.navmesh = navmesh;
    s->landing.walker = tl_nav_walker_make(soup, tile->agent_radius, tile->agent_height, tile->agent_max_climb, margin);
    s->landing.radius = tile->agent_radius;
    s->landing.lift = tile->agent_max_climb;
    s->landing.cell = tile->cell_size;
}

static tl_result write_links(const link_search *s, const tl_nav_tile *tile, uint32_t count, tl_nav_links **links_out)
{
    const tl_host *host = s->landing.def->host;
    tl_nav_links *links = tl_nav_links_create(host != NULL ? host->allocator : NULL, count);
    if (links == NULL) {
        return TL_ERR_MEMORY;
    }
    links->agent_radius = tile->agent_radius;
    links->agent_height = tile->agent_height;
    links->agent_lift = tile->agent_max_climb;
    links->margin = s->landing.walker.margin;
    tl_nav_found_link *out = tl_nav_links_array(links);
    for (uint32_t i = 0; i < count; i++) {
        out[i] = s->tries[i].link;
        links->kind_counts[out[i].kind]++;
    }
    *links_out = links;
    return TL_OK;
}

static tl_result find(link_search *s, const tl_nav_tile *tile, tl_nav_links **links_out, tl_nav_links_report *report)
{
    uint32_t kept = 0;
    report->base.stage = "sweeps";
    TL_TRY(try_all(s));
    uint32_t count = gather(s, report);
    report->base.stage = "selection";
    TL_TRY(tl_nav_select_ways(s->landing.def, s->landing.navmesh, s->tries, count, &kept, report));
    return write_links(s, tile, kept, links_out);
}

tl_result tl_nav_links_find(const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                            tl_nav_links **links_out, tl_nav_links_report *report_out)
{
    tl_nav_links_report unused;
    tl_nav_links_report *report = report_out != NULL ? report_out : &unused;
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, "ledges");
    *links_out = NULL;
    TL_TRY(check_def(def, &report->base));
    const tl_nav_tile *tile = first_tile(navmesh);
    if (tile == NULL) {
        return tl_report_fail(&report->base, TL_ERR_EMPTY, "tile", TL_NO_ELEMENT, "bake a navmesh first");
    }
    TL_TRY(tl_progress_update(def->host, "ledges", 0, 1));
    link_search s;
    memset(&s, 0, sizeof s);
    prepare(&s, def, navmesh, soup, tile);
    uint64_t edges = 0;
    s.place_count = tl_nav_sample_ledges(navmesh, def->spacing, NULL, 0, &edges);
    if (s.place_count > UINT32_MAX / TL_NAV_WAYS_A_PLACE) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "place", s.place_count, "take a larger spacing");
    }
    report->ledge_count = (uint32_t)edges;
    report->sample_count = (uint32_t)s.place_count;
    const tl_allocator *allocator = def->host != NULL ? def->host->allocator : NULL;
    s.places = tl_allocate_array(allocator, s.place_count, sizeof *s.places);
    s.tries = tl_allocate_array(allocator, TL_NAV_WAYS_A_PLACE * s.place_count, sizeof *s.tries);
    tl_result result = s.places != NULL && s.tries != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        tl_nav_sample_ledges(navmesh, def->spacing, s.places, s.place_count, &edges);
        result = tl_progress_update(def->host, "ledges", 1, 1);
    }
    result = result == TL_OK ? find(&s, tile, links_out, report) : result;
    tl_release_array(allocator, s.places, s.place_count, sizeof *s.places);
    tl_release_array(allocator, s.tries, TL_NAV_WAYS_A_PLACE * s.place_count, sizeof *s.tries);
    return result;
}
