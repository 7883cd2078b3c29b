// SPDX-License-Identifier: MIT
//
// The audit in order: polygons, paths, floors; then what they met is merged into findings.
//
// Work is cut into shares that do not depend on the number of workers, and the results of shares are added up in their
// order, so the result is the same for any host.

#include "nav_audit/audit.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

#include <math.h>
#include <string.h>

// Shares that run between two calls of progress: from one a worker on twice as many after each batch, while they take
// few steps. Which shares run together does not change the result.
enum { MAX_SHARES_PER_WORKER = 64, STEPS_PER_BATCH = 2 * TL_AUDIT_SHARE_STEPS };

#define MAX_AUDIT_STEPS ((uint64_t)1 << 26)

// A path search takes as long as so many steps, a place that is wrong too.
enum { STEPS_OF_A_SEARCH = 256, STEPS_OF_A_RECORD = 64 };

// Of floor that is missing beside navmesh: fewer columns may be due to dents and ridges between the middles of columns,
// which samples do not see and voxels do.
#define LEAST_MISSING_COLUMNS 8.0f

tl_nav_audit_def tl_default_nav_audit_def(void)
{
    tl_nav_audit_def def;
    memset(&def, 0, sizeof def);
    def.nav = tl_default_nav_def();
    def.path_count = 2000;
    def.seed = 1;
    def.probe_radius = -1.0f;
    def.min_missing_area = -1.0f;
    def.max_steps = MAX_AUDIT_STEPS;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

const char *tl_nav_finding_name(tl_nav_finding_kind kind)
{
    static const char *const names[] = { "blocked", "step", "no floor", "missing" };
    return (unsigned)kind < TL_COUNT_OF(names) ? names[kind] : "unknown";
}

void tl_nav_audit_free(tl_nav_audit *audit)
{
    if (audit != NULL) {
        tl_release_array(&audit->allocator, audit->findings, audit->finding_count, sizeof *audit->findings);
        memset(audit, 0, sizeof *audit);
    }
}

// ---- Shares ------------------------------------------------------------------------------------------------

typedef struct share_batch {
    tl_audit_job *job;
    tl_audit_task *task;
    void *user;
    tl_audit_share *shares;
    uint32_t first;
} share_batch;

static void run_share(uint32_t index, uint32_t worker, void *user)
{
    const share_batch *b = user;
    tl_audit_share *share = &b->shares[index];
    b->task(b->job, b->first + index, worker, share, b->user);
    if (share->result == TL_OK && share->records.count > 0) {
        share->result = tl_audit_records_thin(&share->records);
    }
}

static tl_result add_share(tl_audit_job *job, const tl_audit_share *share)
{
    TL_TRY(share->result);
    TL_TRY(tl_audit_expect_steps(job, share->steps + share->samples));
    job->steps += share->steps + share->samples;
    job->audit->step_count += share->sweeps;
    job->audit->tolerated_count += share->tolerated;
    job->audit->path_count += share->paths;
    job->audit->path_metres += share->metres;
    job->audit->portal_count += share->portals;
    job->audit->floor_samples += share->samples;
    return tl_audit_records_append(&job->records, &share->records);
}

tl_result tl_audit_expect_steps(const tl_audit_job *job, uint64_t more)
{
    return more <= job->def->max_steps - job->steps
               ? TL_OK
               : tl_report_field(job->report, TL_ERR_LIMIT, "max_steps",
                                 "make it larger, or cell_size; or look whether navmesh and soup belong together");
}

// Leaves one record of each place, and refuses too many places.
static tl_result thin_records(tl_audit_job *job)
{
    TL_TRY(tl_audit_records_thin(&job->records));
    return job->records.count <= TL_NAV_AUDIT_MAX_PLACES
               ? TL_OK
               : tl_report_fail(job->report, TL_ERR_LIMIT, "place", job->records.count,
                                "too many are wrong: look whether navmesh, def and soup belong together");
}

tl_result tl_audit_run_shares(tl_audit_job *job, const char *stage, uint32_t count, tl_audit_task *task, void *user)
{
    const tl_allocator *allocator = job->host->allocator;
    const uint32_t workers = tl_worker_count(job->host), most = MAX_SHARES_PER_WORKER * workers;
    share_batch b = { job, task, user, tl_allocate_array(allocator, most, sizeof *b.shares), 0 };
    tl_result result = b.shares != NULL ? TL_OK : TL_ERR_MEMORY;
    uint32_t size = 0;
    for (uint32_t open = workers; b.first < count && result == TL_OK; b.first += size) {
        size = count - b.first < open ? count - b.first : open;
        result = tl_progress_update(job->host, stage, b.first, count);
        if (result != TL_OK) {
            break;
        }
        memset(b.shares, 0, size * sizeof *b.shares);
        for (uint32_t i = 0; i < size; i++) {
            b.shares[i].records.allocator = allocator;
        }
        tl_run_tasks(job->host, run_share, size, &b);
        uint64_t work = 0;
        for (uint32_t i = 0; i < size; i++) {
            const tl_audit_share *share = &b.shares[i];
            work += share->steps + share->samples + STEPS_OF_A_SEARCH * share->paths;
            work += STEPS_OF_A_RECORD * (uint64_t)share->records.count;
            result = result == TL_OK ? add_share(job, share) : result;
            tl_audit_records_free(&b.shares[i].records);
        }
        if (result == TL_OK && job->records.count > 2 * TL_NAV_AUDIT_MAX_PLACES) {
            const tl_stage now = { .host = job->host, .name = stage, .done = b.first, .total = count };
            job->stage = now;
            result = thin_records(job);
        }
        const uint64_t fair = (uint64_t)STEPS_PER_BATCH * workers;
        open = work < fair / 2 ? tl_min_u32(2 * open, most) : work > fair ? tl_max_u32(open / 2, workers) : open;
    }
    tl_release_array(allocator, b.shares, most, sizeof *b.shares);
    return result == TL_OK ? tl_progress_update(job->host, stage, count, count) : result;
}

// ---- Findings ----------------------------------------------------------------------------------------------

static bool is_worse_finding(const tl_nav_finding *a, const tl_nav_finding *b)
{
    if (a->kind != b->kind) {
        return a->kind < b->kind;
    }
    return a->area != b->area ? a->area > b->area : a->depth > b->depth;
}

#define TL_HEAP(name)                 finding_heap_##name
#define TL_HEAP_ITEM                  tl_nav_finding
#define TL_HEAP_BEFORE(context, a, b) is_worse_finding(&(b), &(a))
#include "base/heap.inl"

// Heapsort, the worst first: the heap's top is the least bad. It is not stable, but the same each time.
static void sort_findings(tl_nav_finding *findings, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;) {
        finding_heap_sift_down(findings, count, i, findings[i], NULL);
    }
    for (uint32_t left = count; left > 1;) {
        const tl_nav_finding top = finding_heap_pop(findings, &left, NULL);
        findings[left] = top;
    }
}

// Fills in the areas of missing floors, and drops those that are too small, or may be an island that is.
static uint32_t measure_missing(const tl_audit_job *job, tl_nav_finding *findings, uint32_t count)
{
    const float cell = job->scene.config.cell_size;
    const float beside = LEAST_MISSING_COLUMNS * cell * cell;
    const float island = tl_maxf((float)job->scene.config.min_region_area * cell * cell, beside);
    const float wanted = job->def->min_missing_area;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_finding finding = findings[i];
        if (finding.kind == TL_NAV_FINDING_MISSING) {
            finding.area = (float)finding.count * cell * cell;
            const float least = wanted >= 0.0f ? wanted : finding.polygon != TL_NAV_NO_REF ? beside : island;
            if (finding.area < least) {
                continue;
            }
            job->audit->missing_area += (double)finding.area;
        }
        findings[kept++] = finding;
    }
    return kept;
}

// Merges the records into findings and adds these to the audit: records of one kind whose cubes, `reach` cells wide,
// touch become one.
static tl_result add_findings(tl_audit_job *job, uint32_t reach)
{
    tl_nav_audit *audit = job->audit;
    const tl_allocator *allocator = job->host->allocator;
    tl_nav_finding *findings;
    uint32_t found;
    TL_TRY(tl_stage_begin(&job->stage, job->host, "audit findings", 1));
    TL_TRY(thin_records(job));
    const tl_result clustered = tl_audit_records_cluster(&job->records, reach, &findings, &found);
    if (clustered != TL_OK) {
        tl_release_array(allocator, findings, found, sizeof *findings);
        return clustered;
    }
    const uint32_t kept = measure_missing(job, findings, found);
    for (uint32_t i = 0; i < kept; i++) {
        audit->contradictions += findings[i].count;
    }
    const uint32_t count = audit->finding_count + kept;
    tl_nav_finding *all = tl_allocate_array(allocator, count, sizeof *all);
    if (all != NULL) {
        if (audit->finding_count > 0) {
            memcpy(all, audit->findings, audit->finding_count * sizeof *all);
        }
        if (kept > 0) {
            memcpy(all + audit->finding_count, findings, kept * sizeof *all);
        }
        sort_findings(all, count);
        tl_release_array(allocator, audit->findings, audit->finding_count, sizeof *all);
        audit->findings = all;
        audit->finding_count = count;
    }
    tl_release_array(allocator, findings, found, sizeof *findings);
    tl_audit_records_free(&job->records);
    return all != NULL ? tl_stage_end(&job->stage) : TL_ERR_MEMORY;
}

// ---- The audit ---------------------------------------------------------------------------------------------

// The config of the whole level as one field, without the limits of a field that is baked.
static tl_result make_level_config(const tl_nav_def *def, tl_aabb soup_bounds, tl_nav_config *config, tl_report *report)
{
    uint32_t tiles_x, tiles_z;
    TL_TRY(tl_nav_tile_grid(def, soup_bounds, &tiles_x, &tiles_z, report));
    TL_TRY(tl_nav_config_from_def(def, soup_bounds, 0, 0, config, report));
    if (def->tile_size > 0) {
        const tl_aabb bounds = tl_aabb_is_empty(def->bounds) ? soup_bounds : def->bounds;
        config->width = tiles_x * def->tile_size;
        config->height = tiles_z * def->tile_size;
        config->border_size = 0;
        config->lattice.first_x = config->lattice.first_z = 0;
        config->bounds.min = bounds.min;
        config->bounds.max = bounds.max;
    }
    return TL_OK;
}

static tl_result prepare_audit(tl_audit_job *job, const tl_navmesh *navmesh, const tl_soup *soup, tl_report *report)
{
    tl_audit_scene *scene = &job->scene;
    scene->navmesh = navmesh;
    scene->soup = soup;
    TL_TRY(make_level_config(&job->def->nav, tl_soup_bounds(soup), &scene->config, report));
    scene->stride = scene->config.cell_size;
    scene->probe = tl_nav_probe_from_config(&scene->config);
    scene->promise = tl_audit_outline_promise(&scene->config);
    if (job->def->probe_radius >= 0.0f) {
        scene->probe.radius = job->def->probe_radius;
        scene->promise = INFINITY;
    }
    // A capsule is no thicker than it is high.
    scene->probe.radius = tl_minf(scene->probe.radius, 0.5f * (scene->probe.height - scene->probe.step));
    scene->probe.radius = tl_maxf(scene->probe.radius, 0.0f);
    job->audit->probe = scene->probe;
    return TL_OK;
}

// One a worker. A search visits each link once at most, so it never runs out of nodes.
static tl_result create_queries(tl_audit_job *job)
{
    const tl_allocator *allocator = job->host->allocator;
    const uint32_t workers = tl_worker_count(job->host);
    tl_nav_query_def def = tl_default_nav_query_def();
    const uint64_t nodes = job->scene.navmesh != NULL ? tl_navmesh_link_count(job->scene.navmesh) + 2 : 2;
    def.max_nodes = (uint32_t)tl_clamp_u64(nodes, def.max_nodes, UINT32_MAX / 2);
    def.allocator = allocator;
    job->queries = tl_allocate_array(allocator, workers, sizeof(*job->queries));
    if (job->queries == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(job->queries, 0, workers * sizeof(*job->queries));
    for (uint32_t i = 0; i < workers; i++) {
        TL_TRY(tl_nav_query_create(&def, &job->queries[i], NULL));
    }
    return TL_OK;
}

static void destroy_queries(tl_audit_job *job)
{
    const uint32_t workers = tl_worker_count(job->host);
    for (uint32_t i = 0; job->queries != NULL && i < workers; i++) {
        tl_nav_query_destroy(job->queries[i]);
    }
    tl_release_array(job->host->allocator, job->queries, workers, sizeof(*job->queries));
}

static tl_result audit_all(tl_audit_job *job)
{
    const uint32_t agent = 2 * (job->scene.config.walkable_radius + 1);
    TL_TRY(create_queries(job));
    TL_TRY(tl_audit_list_polygons(job->scene.navmesh, job->host->allocator, &job->polygons));
    TL_TRY(tl_audit_polygons(job));
    TL_TRY(tl_audit_paths(job));
    TL_TRY(add_findings(job, agent));
    TL_TRY(tl_audit_floors(job));
    return add_findings(job, 1);
}

static tl_result check_audit(const tl_nav_audit_def *def, const tl_soup *soup, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_audit_def()", report));
    if (soup == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "soup", "it may not be NULL");
    }
    return def->volumes != NULL || def->volume_count == 0
               ? TL_OK
               : tl_report_field(report, TL_ERR_ARGUMENT, "volumes", "give volumes, or a volume_count of 0");
}

tl_result tl_nav_audit_run(const tl_nav_audit_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                           tl_nav_audit *audit_out, tl_report *report_out)
{
    const tl_nav_audit_def default_def = tl_default_nav_audit_def();
    tl_audit_job job;
    def = def != NULL ? def : &default_def;
    tl_report_begin(report_out, "audit");
    if (audit_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "audit_out", "it may not be NULL");
    }
    memset(audit_out, 0, sizeof *audit_out);
    TL_TRY(check_audit(def, soup, report_out));
    memset(&job, 0, sizeof job);
    audit_out->allocator = tl_allocator_or_default(def->host.allocator);
    job.def = def;
    job.host = &def->host;
    job.records.allocator = def->host.allocator;
    job.records.stage = &job.stage;
    job.stage.host = &def->host;
    job.audit = audit_out;
    job.report = report_out;
    tl_result result = prepare_audit(&job, navmesh, soup, report_out);
    if (result == TL_OK) {
        result = audit_all(&job);
    }
    tl_audit_records_free(&job.records);
    tl_audit_polygons_free(&job.polygons);
    destroy_queries(&job);
    if (result != TL_OK) {
        tl_nav_audit_free(audit_out);
    }
    return result;
}
