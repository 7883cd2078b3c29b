// SPDX-License-Identifier: MIT
//
// From a navmesh to its jump links: places along ledges, candidates from each (in parallel: they are independent), then
// the selection, in an order that depends on neither threads nor chance.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "base/stage.h"
#include "nav_links/links_layout.h"
#include "nav_links/selection.h"

#include <float.h>
#include <math.h>
#include <string.h>

// A place takes some 10 to 100 us.
enum { PLACES_PER_TASK = 16, TASKS_PER_BATCH = 8 };

// More chords cost sweeps, a thicker capsule costs links: a sixteenth of the radius, or of a cell.
#define MARGIN_DIVISOR 16.0f

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
    def.min_gain = 3.0f;
    def.max_nodes = 4096;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

typedef struct links_setting {
    const char *field;
    float value, min;
    const char *advice;
} links_setting;

static tl_result check_links_def(const tl_nav_links_def *def, tl_report *report)
{
    const char *length = "make it finite and >= 0", *positive = "make it finite and > 0";
    const links_setting settings[] = {
        { "spacing", def->spacing, FLT_MIN, positive }, { "max_drop", def->max_drop, 0.0f, length },
        { "max_jump", def->max_jump, 0.0f, length },    { "jump_height", def->jump_height, 0.0f, length },
        { "max_speed", def->max_speed, 0.0f, length },  { "gravity", def->gravity, FLT_MIN, positive },
        { "max_climb", def->max_climb, 0.0f, length },  { "min_gain", def->min_gain, 1.0f, "make it finite and >= 1" },
    };
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_links_def()", report));
    for (uint32_t i = 0; i < TL_COUNT_OF(settings); i++) {
        const links_setting *s = &settings[i];
        if (!isfinite(s->value) || s->value < s->min) {
            return tl_report_field(report, isfinite(s->value) ? TL_ERR_ARGUMENT : TL_ERR_NOT_FINITE, s->field,
                                   s->advice);
        }
    }
    return def->max_nodes >= 2 ? TL_OK : tl_report_field(report, TL_ERR_ARGUMENT, "max_nodes", "make it >= 2");
}

typedef struct link_search {
    tl_stage stage;
    tl_nav_landing_search landing;
    tl_nav_ledge_point *places;
    tl_nav_link_candidate *candidates; // [TL_NAV_CANDIDATES_PER_PLACE * place_count]
    uint64_t place_count;
} link_search;

static void try_places(uint32_t index, uint32_t worker, void *user)
{
    link_search *s = user;
    (void)worker;
    uint64_t begin = (uint64_t)index * PLACES_PER_TASK;
    uint64_t end = tl_min_u64(begin + PLACES_PER_TASK, s->place_count);
    for (uint64_t i = begin; i < end; i++) {
        tl_nav_find_candidates(&s->landing, &s->places[i], &s->candidates[TL_NAV_CANDIDATES_PER_PLACE * i]);
    }
}

static tl_result try_all(link_search *s)
{
    const tl_host *host = &s->landing.def->host;
    const uint64_t tasks = (s->place_count + PLACES_PER_TASK - 1) / PLACES_PER_TASK;
    TL_TRY(tl_stage_begin(&s->stage, host, "sweeps", s->place_count));
    TL_TRY(tl_stage_run(&s->stage, try_places, (uint32_t)tasks, s, TASKS_PER_BATCH, s->place_count));
    return tl_stage_end(&s->stage);
}

// Counts what became of the candidates, and moves the proven ones to the front.
static uint32_t gather_proven(link_search *s, tl_nav_links_report *report)
{
    uint32_t count = 0;
    for (uint64_t i = 0; i < TL_NAV_CANDIDATES_PER_PLACE * s->place_count; i++) {
        const tl_nav_link_candidate *candidate = &s->candidates[i];
        tl_nav_links_count *counts = &report->kinds[candidate->link.kind];
        report->no_landing += candidate->fate == TL_NAV_CANDIDATE_NO_LANDING ? 1 : 0;
        report->too_fast += candidate->fate == TL_NAV_CANDIDATE_TOO_FAST ? 1 : 0;
        counts->tried +=
            candidate->fate == TL_NAV_CANDIDATE_BLOCKED || candidate->fate == TL_NAV_CANDIDATE_FREE ? 1 : 0;
        counts->blocked += candidate->fate == TL_NAV_CANDIDATE_BLOCKED ? 1 : 0;
        if (candidate->fate == TL_NAV_CANDIDATE_FREE) {
            s->candidates[count++] = *candidate;
        }
    }
    return count;
}

// Metres across the navmesh, in the plane, and some cells more.
static float widest_jump(const tl_navmesh *navmesh, float cell)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        box = tile != NULL ? tl_aabb_union(box, tile->bounds) : box;
    }
    const double x = (double)box.max.x - (double)box.min.x;
    const double z = (double)box.max.z - (double)box.min.z;
    return (float)sqrt(x * x + z * z) + 8.0f * cell;
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

static void prepare_landing(link_search *s, const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                            const tl_nav_tile *tile)
{
    float margin = fmaxf(tile->agent_radius, tile->cell_size) / MARGIN_DIVISOR;
    s->landing.def = def;
    s->landing.navmesh = navmesh;
    s->landing.walker = tl_nav_walker_make(soup, tile->agent_radius, tile->agent_height, tile->agent_max_climb, margin);
    s->landing.radius = tile->agent_radius;
    s->landing.lift = tile->agent_max_climb;
    s->landing.cell = tile->cell_size;
    s->landing.reach = fminf(def->max_jump, widest_jump(navmesh, tile->cell_size));
}

static tl_result write_links(const link_search *s, const tl_nav_tile *tile, uint32_t count, tl_nav_links **links_out)
{
    tl_nav_links *links = tl_nav_links_allocate(s->landing.def->host.allocator, count);
    if (links == NULL) {
        return TL_ERR_MEMORY;
    }
    links->agent_radius = tile->agent_radius;
    links->agent_height = tile->agent_height;
    links->agent_max_climb = tile->agent_max_climb;
    links->margin = s->landing.walker.margin;
    tl_nav_jump_link *out = tl_nav_links_writable_array(links);
    for (uint32_t i = 0; i < count; i++) {
        out[i] = s->candidates[i].link;
        links->kind_counts[out[i].kind]++;
    }
    *links_out = links;
    return TL_OK;
}

static tl_result prove_and_select(link_search *s, const tl_nav_tile *tile, tl_nav_links **links_out,
                                  tl_nav_links_report *report)
{
    uint32_t kept = 0;
    report->base.stage = "sweeps";
    TL_TRY(try_all(s));
    uint32_t count = gather_proven(s, report);
    report->base.stage = "selection";
    TL_TRY(tl_nav_select_links(s->landing.def, s->landing.navmesh, s->candidates, count, &kept, report));
    return write_links(s, tile, kept, links_out);
}

static tl_result find_jump_links(link_search *s, const tl_nav_tile *tile, tl_nav_links **links_out,
                                 tl_nav_links_report *report)
{
    const tl_nav_links_def *def = s->landing.def;
    uint64_t edges = 0;
    if (def->spacing < TL_NAV_LINKS_MIN_SPACING * tile->cell_size) {
        return tl_report_field(&report->base, TL_ERR_LIMIT, "spacing",
                               "make it larger: places a 32nd of a cell apart find the same links");
    }
    TL_TRY(tl_stage_begin(&s->stage, &def->host, "ledges", 1));
    tl_result counted =
        tl_nav_sample_ledges(s->landing.navmesh, def->spacing, &s->stage, NULL, 0, &s->place_count, &edges);
    if (counted == TL_ERR_CANCELLED) {
        return counted;
    }
    const double steps = (double)s->landing.reach / (2.0 * (double)s->landing.cell);
    if (counted != TL_OK || (double)s->place_count * steps > (double)TL_NAV_LINKS_MAX_LANDINGS) {
        return tl_report_field(&report->base, TL_ERR_LIMIT, "spacing", "make it larger, or max_jump shorter");
    }
    report->ledge_count = (uint32_t)edges;
    report->sample_count = (uint32_t)s->place_count;
    const tl_allocator *allocator = def->host.allocator;
    const uint64_t candidate_count = TL_NAV_CANDIDATES_PER_PLACE * s->place_count;
    s->places = tl_allocate_array(allocator, s->place_count, sizeof *s->places);
    s->candidates = tl_allocate_array(allocator, candidate_count, sizeof *s->candidates);
    tl_result result = s->places != NULL && s->candidates != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        uint64_t count;
        result = tl_nav_sample_ledges(s->landing.navmesh, def->spacing, &s->stage, s->places, s->place_count, &count,
                                      &edges);
        result = result == TL_OK ? tl_stage_end(&s->stage) : result;
    }
    result = result == TL_OK ? prove_and_select(s, tile, links_out, report) : result;
    tl_release_array(allocator, s->places, s->place_count, sizeof *s->places);
    tl_release_array(allocator, s->candidates, candidate_count, sizeof *s->candidates);
    return result;
}

static tl_result check_links_arguments(const tl_navmesh *navmesh, const tl_soup *soup, const void *links_out,
                                       tl_report *report)
{
    return navmesh != NULL && soup != NULL && links_out != NULL ? TL_OK
                                                                : tl_report_field(report, TL_ERR_ARGUMENT,
                                                                                  navmesh == NULL ? "navmesh"
                                                                                  : soup == NULL  ? "soup"
                                                                                                  : "links_out",
                                                                                  "it may not be NULL");
}

tl_result tl_nav_links_find(const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                            tl_nav_links **links_out, tl_nav_links_report *report_out)
{
    const tl_nav_links_def default_def = tl_default_nav_links_def();
    tl_nav_links_report unused;
    tl_nav_links_report *report = report_out != NULL ? report_out : &unused;
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, "ledges");
    if (links_out != NULL) {
        *links_out = NULL;
    }
    def = def != NULL ? def : &default_def;
    TL_TRY(check_links_arguments(navmesh, soup, links_out, &report->base));
    TL_TRY(check_links_def(def, &report->base));
    const tl_nav_tile *tile = first_tile(navmesh);
    if (tile == NULL) {
        return tl_report_fail(&report->base, TL_ERR_EMPTY, "tile", TL_NO_ELEMENT, "bake a navmesh first");
    }
    link_search s;
    memset(&s, 0, sizeof s);
    prepare_landing(&s, def, navmesh, soup, tile);
    return find_jump_links(&s, tile, links_out, report);
}
