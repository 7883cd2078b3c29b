// SPDX-License-Identifier: MIT
//
// Why a point is not walkable, and what would make it so.
//
// Each stage that can remove a point has one setting to blame, and what is measured at the point gives the nearest
// value with which the point stays: the triangle's own slope, the free height, the columns of the island. That value
// goes into the def, and the search is repeated until the point is walkable or nothing helps. So the answer is not a
// guess: it has been baked.

#include "base/assert.h"
#include "base/host.h"
#include "math/cos_degrees.h"
#include "math/tolerance.h"
#include "nav_audit/polygon_list.h"
#include "nav_audit/why_stages.h"

#include <math.h>
#include <string.h>

// A normal from differences, products and a root in float; the bake rounds it differently.
#define NORMAL_ERROR TL_FLOAT_GAMMA(8)

enum { SLOPE_STEPS = 40, ERROR_STEPS = 5 };

// Cells are made no smaller than a quarter of what they are: a bake of smaller ones takes sixteen times as long.
enum { CELL_SHARES = 16, LEAST_CELL_SHARES = 4 };

typedef struct why_search {
    tl_why_question question;
    tl_nav_why_answer *answer;
    tl_report *report;
} why_search;

const char *tl_nav_cause_name(tl_nav_cause cause)
{
    static const char *const names[] = { "walkable", "outside", "no floor", "slope",  "area of the triangle",
                                         "ledge",    "ceiling", "radius",   "volume", "small island",
                                         "outline",  "changed", "pruned",   "wall" };
    return (unsigned)cause < TL_COUNT_OF(names) ? names[cause] : "unknown";
}

const char *tl_nav_cause_text(tl_nav_cause cause)
{
    static const char *const texts[] = {
        "A polygon of the navmesh lies there.",
        "The point lies beside what was built, or so near to its rim that the agent would reach over it.",
        "There is no triangle within a step of the point.",
        "The floor is too steep, or it faces down.",
        "The triangle has area 0: it was said to be not walkable.",
        "The floor lies beside a drop, or on a stair, of more than the agent climbs.",
        "There is too little height above the floor.",
        "A wall, a low ceiling or a ledge is nearer than the agent's radius.",
        "A volume marks the floor as not walkable.",
        "The floor belongs to an island that is too small to be kept.",
        "The simplified outline cuts the floor off.",
        "These triangles and settings give navmesh here, but the navmesh has none: it was made from others.",
        "The floor belongs to an island that was pruned.",
        "A wall stands so near that it shares a column of voxels with the floor, and buries it.",
    };
    return (unsigned)cause < TL_COUNT_OF(texts) ? texts[cause] : "Unknown.";
}

// ---- What a change of the def gives ------------------------------------------------------------------------

static tl_result find_cause(why_search *s, const tl_nav_def *def, tl_why_finding *finding)
{
    s->answer->bake_count++;
    return tl_why_find(&s->question, def, finding, s->report);
}

static tl_result try_def(why_search *s, const tl_nav_def *def, bool *walkable_out)
{
    tl_why_finding finding;
    TL_TRY(find_cause(s, def, &finding));
    *walkable_out = finding.cause == TL_NAV_CAUSE_NONE;
    return TL_OK;
}

// Whether the lattice of a def is within the limits of bakes.
static bool is_within_limits(const why_search *s, const tl_nav_def *def)
{
    uint32_t tiles_x, tiles_z;
    return tl_nav_tile_grid(def, s->question.mesh_bounds, &tiles_x, &tiles_z, NULL) == TL_OK;
}

// Bounds that reach `more` metres farther to each side, in whole columns, so that the lattice stays where it is.
static tl_nav_def with_wider_bounds(const why_search *s, const tl_nav_def *def, float more)
{
    tl_nav_def wider = *def;
    const float step = def->cell_size * ceilf(more / def->cell_size + 1.0f);
    wider.bounds = tl_aabb_is_empty(def->bounds) ? s->question.mesh_bounds : def->bounds;
    wider.bounds.min.x -= step;
    wider.bounds.min.z -= step;
    wider.bounds.max.x += step;
    wider.bounds.max.z += step;
    return wider;
}

// What the rim of the bounds removes is not due to the radius or a ledge: with wider bounds it would stay.
static tl_result blame_bounds(why_search *s, const tl_nav_def *def, tl_why_finding *finding)
{
    const bool by_rim = finding->cause == TL_NAV_CAUSE_RADIUS || finding->cause == TL_NAV_CAUSE_LEDGE;
    if (!by_rim || !(finding->outside > 0.0f)) {
        return TL_OK;
    }
    const tl_nav_def wider = with_wider_bounds(s, def, finding->outside);
    tl_why_finding other;
    TL_TRY(find_cause(s, &wider, &other));
    finding->cause = other.cause != finding->cause ? TL_NAV_CAUSE_OUTSIDE : finding->cause;
    return TL_OK;
}

// ---- The setting to blame, cause by cause ------------------------------------------------------------------

// The smallest slope limit, in degrees, with which a triangle of this normal is walkable; 90 when there is none.
static float slope_for(float normal_y, float from, float *measured_out)
{
    normal_y -= normal_y * NORMAL_ERROR;
    float low = 0.0f, high = 90.0f;
    for (int i = 0; i < SLOPE_STEPS; i++) {
        const float middle = low + 0.5f * (high - low);
        if (tl_cos_degrees(middle) < normal_y) {
            high = middle;
        } else {
            low = middle;
        }
    }
    *measured_out = low;
    return high > from ? high : 90.0f; // the triangle was not to blame
}

static void blame_slope(const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    const float needed = slope_for(finding->normal_y, def->agent_max_slope, &reason->measured);
    reason->stage = "rasterize";
    if (finding->triangle != TL_NO_TRIANGLE && finding->normal_y > 0.0f && needed < 90.0f) {
        reason->parameter = "agent_max_slope";
        reason->value = def->agent_max_slope;
        reason->needed = def->agent_max_slope = needed;
    }
}

// The largest cell size, in sixteenths of the one that is, with which the floor is no longer in one column with the
// wall. Each try looks at the columns around the point alone.
static tl_result blame_cells(why_search *s, const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    reason->stage = "rasterize";
    reason->measured = finding->wall;
    tl_nav_def tried = *def;
    tl_result result = TL_OK;
    s->question.window_only = true;
    for (int share = CELL_SHARES - 1; share >= LEAST_CELL_SHARES && result == TL_OK && reason->parameter == NULL;
         share--) {
        tl_why_finding found;
        tried.cell_size = def->cell_size * (float)share / (float)CELL_SHARES;
        if (!is_within_limits(s, &tried)) {
            break;
        }
        result = tl_why_find(&s->question, &tried, &found, s->report);
        if (result == TL_OK && found.cause != TL_NAV_CAUSE_WALL && found.cause != TL_NAV_CAUSE_NO_FLOOR) {
            reason->parameter = "cell_size";
            reason->value = def->cell_size;
            reason->needed = tried.cell_size;
        }
    }
    s->question.window_only = false;
    if (reason->parameter != NULL) {
        *def = tried;
    }
    return result;
}

static void blame_climb(const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    reason->stage = "filter";
    if (finding->needed_climb > 0) {
        reason->parameter = "agent_max_climb";
        reason->value = def->agent_max_climb;
        reason->needed = def->agent_max_climb = (float)finding->needed_climb * def->cell_height;
        reason->measured = reason->needed;
    } else {
        reason->parameter = "filter_ledge_spans";
        reason->value = 1.0f;
        reason->needed = 0.0f;
        reason->measured = INFINITY;
        def->filter_ledge_spans = false;
    }
}

static void blame_height(const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    reason->stage = "filter";
    reason->parameter = "agent_height";
    reason->value = def->agent_height;
    reason->needed = def->agent_height = reason->measured = (float)finding->clearance * def->cell_height;
}

// The largest radius with which the point is on the navmesh. Erosion lets its column stay up to the kept radius; the
// simplified outline may reach over columns that are gone, and then the radius may be larger by as much; or the outline
// or an island's size may take the point still, and then it is less.
static tl_result blame_radius(why_search *s, const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    const double beyond = ceil((double)def->edge_max_error) + 1.0 + (double)finding->kept_radius;
    const uint32_t most = finding->config.walkable_radius - 1; // with its own the point was removed
    reason->stage = "erode";
    reason->parameter = "agent_radius";
    reason->value = def->agent_radius;
    reason->needed = reason->measured = (float)finding->kept_radius * def->cell_size;
    for (uint32_t radius = beyond < (double)most ? (uint32_t)beyond + 1 : most + 1; radius-- > 0;) {
        bool walkable;
        def->agent_radius = (float)radius * def->cell_size;
        TL_TRY(try_def(s, def, &walkable));
        if (walkable) {
            reason->needed = def->agent_radius;
            return TL_OK;
        }
    }
    def->agent_radius = reason->needed;
    return TL_OK;
}

static void blame_island(const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    reason->stage = "regions";
    reason->measured = (float)finding->island;
    // In hundredths: an island is kept when it has at least as many columns as the size squared.
    const float size = floorf(100.0f * sqrtf((float)finding->island)) / 100.0f;
    if (size < def->region_min_size) {
        reason->parameter = "region_min_size";
        reason->value = def->region_min_size;
        reason->needed = def->region_min_size = size;
    }
}

// Bisects for the largest error with which the point is on the navmesh. When no error helps, a smaller radius is tried.
static tl_result blame_outline(why_search *s, tl_nav_def *def, tl_nav_reason *reason)
{
    tl_nav_def tried = *def;
    float good = 0.0f, bad = def->edge_max_error;
    bool walkable;
    reason->stage = "contours";
    tried.edge_max_error = 0.0f;
    TL_TRY(try_def(s, &tried, &walkable));
    if (!walkable) {
        if (def->agent_radius > 0.0f) {
            reason->parameter = "agent_radius";
            reason->value = def->agent_radius;
            reason->needed = def->agent_radius = tl_maxf(def->agent_radius - def->cell_size, 0.0f);
        }
        return TL_OK;
    }
    for (int i = 0; i < ERROR_STEPS; i++) {
        tried.edge_max_error = 0.5f * (good + bad);
        TL_TRY(try_def(s, &tried, &walkable));
        good = walkable ? tried.edge_max_error : good;
        bad = walkable ? bad : tried.edge_max_error;
    }
    reason->parameter = "edge_max_error";
    reason->value = def->edge_max_error;
    reason->needed = def->edge_max_error = good;
    return TL_OK;
}

// So far outside that bounds which reach there are refused, nothing helps.
static void blame_outside(const why_search *s, const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    const tl_nav_def wider = with_wider_bounds(s, def, finding->outside);
    const tl_aabb before = tl_aabb_is_empty(def->bounds) ? s->question.mesh_bounds : def->bounds;
    reason->stage = "config";
    reason->measured = finding->outside;
    if (is_within_limits(s, &wider)) {
        reason->parameter = "bounds";
        reason->needed = before.min.x - wider.bounds.min.x;
        *def = wider;
    }
}

// Names the setting and puts the needed value into `def`.
static tl_result blame(why_search *s, const tl_why_finding *finding, tl_nav_def *def, tl_nav_reason *reason)
{
    switch (finding->cause) {
    case TL_NAV_CAUSE_OUTSIDE:
        blame_outside(s, finding, def, reason);
        break;
    case TL_NAV_CAUSE_NO_FLOOR:
        reason->stage = "rasterize";
        reason->measured = finding->drop;
        break;
    case TL_NAV_CAUSE_SLOPE:
        blame_slope(finding, def, reason);
        break;
    case TL_NAV_CAUSE_AREA_INPUT:
        reason->stage = "rasterize";
        break;
    case TL_NAV_CAUSE_LEDGE:
        blame_climb(finding, def, reason);
        break;
    case TL_NAV_CAUSE_CEILING:
        blame_height(finding, def, reason);
        break;
    case TL_NAV_CAUSE_RADIUS:
        return blame_radius(s, finding, def, reason);
    case TL_NAV_CAUSE_WALL:
        return blame_cells(s, finding, def, reason);
    case TL_NAV_CAUSE_VOLUME:
        reason->stage = "areas";
        break;
    case TL_NAV_CAUSE_ISLAND:
        blame_island(finding, def, reason);
        break;
    case TL_NAV_CAUSE_OUTLINE:
        return blame_outline(s, def, reason);
    case TL_NAV_CAUSE_NONE:
    case TL_NAV_CAUSE_CHANGED:
    case TL_NAV_CAUSE_PRUNED:
        break;
    }
    return TL_OK;
}

// ---- The answer --------------------------------------------------------------------------------------------

// Square metres of a polygon's island, and of the navmesh's largest.
static tl_result measure_own_island(const why_search *s, const tl_navmesh *navmesh, tl_nav_ref polygon, float *own_out,
                                    float *largest_out)
{
    tl_audit_polygon_list list;
    uint32_t own = 0;
    TL_TRY(tl_navmesh_island(navmesh, polygon, &own));
    TL_TRY(tl_audit_list_polygons(navmesh, s->question.host->allocator, &list));
    for (uint32_t i = 0, begin; i < list.count;) {
        const uint32_t end = tl_audit_island_around(&list, i, &begin);
        const float area = (float)(tl_audit_area_before(&list, end) - tl_audit_area_before(&list, begin));
        *largest_out = tl_maxf(*largest_out, area);
        *own_out = list.polygons[i].island == own ? area : *own_out;
        i = end;
    }
    tl_audit_polygons_free(&list);
    return TL_OK;
}

// Whether another island is larger than the point's.
static tl_result compare_islands(const why_search *s, const tl_navmesh *navmesh, tl_nav_ref polygon)
{
    tl_nav_why_answer *answer = s->answer;
    TL_TRY(measure_own_island(s, navmesh, polygon, &answer->island_area, &answer->largest_island_area));
    answer->apart = answer->island_area < answer->largest_island_area;
    return TL_OK;
}

// A fresh bake has the floor, and so has what was pruned. Its polygon's flags name the rule.
static tl_result blame_pruning(const why_search *s, const tl_nav_pruning *pruning, tl_nav_ref polygon)
{
    tl_nav_reason *reason = &s->answer->reasons[0];
    const tl_nav_tile *tile;
    uint32_t number;
    float largest = 0.0f;
    TL_TRY(tl_navmesh_resolve(pruning->removed, polygon, &tile, &number));
    TL_TRY(measure_own_island(s, pruning->removed, polygon, &reason->measured, &largest));
    const uint64_t flags = tl_nav_tile_flags(tile, number);
    reason->cause = TL_NAV_CAUSE_PRUNED;
    reason->stage = "prune";
    reason->parameter = (flags & TL_NAV_PRUNED_INSIDE) != 0  ? "solids"
                        : (flags & TL_NAV_PRUNED_SMALL) != 0 ? "min_area"
                                                             : "seeds";
    if ((flags & TL_NAV_PRUNED_INSIDE) != 0) {
        reason->value = 1.0f;
    } else if ((flags & TL_NAV_PRUNED_SMALL) != 0) {
        // In hundredths, below the island's own area, whose sum in double this float may exceed.
        reason->value = (float)pruning->min_area;
        reason->needed = floorf(100.0f * reason->measured * (1.0f - NORMAL_ERROR)) / 100.0f;
    }
    return TL_OK;
}

// One cause after another: each is removed before the next is searched.
static tl_result collect_reasons(why_search *s)
{
    tl_nav_why_answer *answer = s->answer;
    bool helped = true;
    for (uint32_t i = 0; helped; i++) {
        tl_why_finding finding;
        TL_TRY(find_cause(s, &answer->needed, &finding));
        TL_TRY(blame_bounds(s, &answer->needed, &finding));
        if (i == 0) {
            answer->floor = finding.floor;
            answer->tile_x = finding.config.tile_x;
            answer->tile_z = finding.config.tile_z;
        }
        answer->proven = finding.cause == TL_NAV_CAUSE_NONE;
        if (answer->proven || i == TL_NAV_MAX_REASONS) {
            return TL_OK;
        }
        tl_nav_reason *reason = &answer->reasons[answer->reason_count++];
        reason->cause = finding.cause;
        reason->triangle = finding.triangle;
        TL_TRY(blame(s, &finding, &answer->needed, reason));
        helped = reason->parameter != NULL;
    }
    return TL_OK;
}

static tl_result measure_mesh(why_search *s)
{
    const tl_mesh_view *mesh = &s->question.input->mesh;
    s->question.mesh_bounds = tl_aabb_empty();
    for (uint64_t i = 0; i < 3 * (uint64_t)mesh->triangle_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count) {
            return tl_report_fail(s->report, TL_ERR_INDEX, "triangle", i / 3, "check the index buffer");
        }
        s->question.mesh_bounds = tl_aabb_add_point(s->question.mesh_bounds, mesh->vertices[mesh->indices[i]]);
    }
    return TL_OK;
}

static tl_result answer_why(why_search *s, const tl_nav_def *def, const tl_navmesh *navmesh,
                            const tl_nav_pruning *pruning)
{
    tl_nav_why_answer *answer = s->answer;
    tl_nav_location location;
    TL_TRY(measure_mesh(s));
    TL_TRY(collect_reasons(s));
    tl_nav_config config;
    TL_TRY(tl_nav_config_from_def(def, s->question.mesh_bounds, answer->tile_x, answer->tile_z, &config, s->report));
    const bool fresh = answer->reason_count == 0;
    const bool there = navmesh != NULL && tl_why_on_navmesh(navmesh, &config, answer->floor, &location);
    answer->walkable = navmesh != NULL ? there : fresh;
    if (there) {
        answer->reason_count = 0;
        return compare_islands(s, navmesh, location.polygon);
    }
    if (navmesh != NULL && fresh) {
        answer->reasons[0].cause = TL_NAV_CAUSE_CHANGED;
        answer->reasons[0].stage = "tile";
        answer->reasons[0].triangle = TL_NO_TRIANGLE;
        answer->reason_count = 1;
        const tl_navmesh *removed = pruning != NULL ? pruning->removed : NULL;
        if (tl_why_on_navmesh(removed, &config, answer->floor, &location)) {
            return blame_pruning(s, pruning, location.polygon);
        }
    }
    return TL_OK;
}

tl_result tl_nav_why(const tl_nav_def *def, const tl_nav_input *input, const tl_navmesh *navmesh,
                     const tl_nav_pruning *pruning, tl_vec3 point, tl_nav_why_answer *answer_out, tl_report *report_out)
{
    const tl_nav_def default_def = tl_default_nav_def();
    tl_report unused;
    tl_report *report = report_out != NULL ? report_out : &unused;
    tl_report_begin(report, "why");
    if (answer_out == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "answer_out", "it may not be NULL");
    }
    memset(answer_out, 0, sizeof *answer_out);
    if (input == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "input", "it may not be NULL");
    }
    if (!tl_is_finite(point)) {
        return tl_report_fail(report, TL_ERR_NOT_FINITE, "point", TL_NO_ELEMENT, "give a finite point");
    }
    def = def != NULL ? def : &default_def;
    answer_out->needed = *def;
    answer_out->floor = point;
    why_search s;
    memset(&s, 0, sizeof s);
    s.question.input = input;
    s.question.point = point;
    s.question.host = &def->host;
    s.answer = answer_out;
    s.report = report;
    const tl_result result = answer_why(&s, def, navmesh, pruning);
    if (result != TL_OK) {
        memset(answer_out, 0, sizeof *answer_out);
    }
    return result;
}
