// SPDX-License-Identifier: MIT
//
// The pipeline again, watched at one column. No stage up to erosion looks farther than the agent's radius, so they run
// on a window of columns around the point, which costs microseconds; the lattice is the level's, so these are the very
// voxels of the bake. Regions and outlines depend on the whole tile, so the tile is baked.

#include "nav_audit/why_stages.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"

#include <math.h>
#include <string.h>

typedef struct why_window {
    const tl_why_question *question;
    tl_nav_config config;     ///< of the columns around the point
    uint32_t x, z;            ///< the point's column in it
    tl_nav_heightfield field; ///< as the filters so far left it
    uint32_t span;            ///< of the field: the floor
    uint16_t top;             ///< its height
    tl_nav_compact compact;
    tl_why_finding *finding;
    tl_report *report;
} why_window;

// How far the navmesh's surface may lie from the voxels' floor; but not as far as the next floor.
static float surface_reach(const tl_nav_config *config)
{
    return tl_minf(tl_nav_probe_from_config(config).surface, 0.5f * config->agent_height);
}

bool tl_why_on_navmesh(const tl_navmesh *navmesh, const tl_nav_config *config, tl_vec3 floor,
                       tl_nav_location *location_out)
{
    // A polygon's point is its closest one in the plane, so a box without width holds it only right below.
    const tl_vec3 extents = { 0.0f, surface_reach(config), 0.0f };
    return navmesh != NULL && tl_navmesh_find_nearest(navmesh, NULL, floor, extents, location_out) == TL_OK;
}

// ---- Where the point lies ----------------------------------------------------------------------------------

// The tile under the point, and the point's column in the level's lattice. False: beside all tiles.
static tl_result find_tile(const tl_why_question *question, const tl_nav_def *def, int64_t column[2], bool *inside,
                           tl_why_finding *finding, tl_report *report)
{
    uint32_t tiles[2], tile[2];
    TL_TRY(tl_nav_tile_grid(def, question->mesh_bounds, &tiles[0], &tiles[1], report));
    TL_TRY(tl_nav_config_from_def(def, question->mesh_bounds, 0, 0, &finding->config, report));
    const tl_nav_config *config = &finding->config;
    const float origin[2] = { config->lattice.origin.x, config->lattice.origin.z };
    const float at[2] = { question->point.x, question->point.z };
    const double border = (double)config->walkable_radius + 1.0; // the rim is a ledge, and floors keep away from it
    const uint32_t wide[2] = { config->width, config->height };
    finding->outside = 0.0f;
    for (int axis = 0; axis < 2; axis++) {
        const double place = floor(((double)at[axis] - (double)origin[axis]) / (double)def->cell_size);
        const double columns = def->tile_size > 0 ? (double)tiles[axis] * (double)def->tile_size : (double)wide[axis];
        const double short_by = place < border ? border - place : place + border - (columns - 1.0);
        finding->outside = tl_maxf(finding->outside, (float)(short_by * (double)def->cell_size));
        const double clamped = place < 0.0 ? 0.0 : place > columns - 1.0 ? columns - 1.0 : place;
        column[axis] = (int64_t)clamped;
        tile[axis] = def->tile_size > 0 ? (uint32_t)(column[axis] / def->tile_size) : 0;
        *inside = *inside && place == clamped;
    }
    return tl_nav_config_from_def(def, question->mesh_bounds, tile[0], tile[1], &finding->config, report);
}

// The columns around the point that the stages up to erosion look at, cut to those of the tile.
static void place_window(const tl_nav_config *tile, const int64_t column[2], why_window *w)
{
    const int64_t reach = (int64_t)tile->walkable_radius + 3;
    const int64_t first[2] = { tile->lattice.first_x, tile->lattice.first_z };
    const int64_t end[2] = { first[0] + tile->width, first[1] + tile->height };
    int64_t low[2], high[2];
    for (int axis = 0; axis < 2; axis++) {
        low[axis] = tl_max_i64(column[axis] - reach, first[axis]);
        high[axis] = tl_min_i64(column[axis] + reach + 1, end[axis]);
    }
    tl_nav_config *config = &w->config;
    *config = *tile;
    config->border_size = 0;
    config->lattice.first_x = (int32_t)low[0];
    config->lattice.first_z = (int32_t)low[1];
    config->width = (uint32_t)(high[0] - low[0]);
    config->height = (uint32_t)(high[1] - low[1]);
    const tl_vec3 origin = tile->lattice.origin;
    config->bounds.min.x = tl_nav_lattice_to_world(origin.x, low[0], tile->cell_size);
    config->bounds.min.z = tl_nav_lattice_to_world(origin.z, low[1], tile->cell_size);
    config->bounds.max.x = tl_nav_lattice_to_world(origin.x, high[0], tile->cell_size);
    config->bounds.max.z = tl_nav_lattice_to_world(origin.z, high[1], tile->cell_size);
    w->x = (uint32_t)(column[0] - low[0]);
    w->z = (uint32_t)(column[1] - low[1]);
}

// ---- The floor ---------------------------------------------------------------------------------------------

static float height_of(const tl_nav_config *config, uint32_t voxels)
{
    return tl_nav_lattice_to_world(config->lattice.origin.y, voxels, config->cell_height);
}

static uint32_t clearance_of(const why_window *w, uint32_t span)
{
    const uint32_t column = w->z * w->field.width + w->x, end = w->field.first_span[column + 1];
    return span + 1 < end ? (uint32_t)w->field.spans[span + 1].min - w->field.spans[span].max : UINT32_MAX;
}

// The span whose top is nearest to the point, within a step of it; one with room for the agent before one without: who
// asks inside a kerb means the kerb's top.
static bool choose_span(why_window *w)
{
    const uint32_t column = w->z * w->field.width + w->x;
    const float y = w->question->point.y, step = tl_nav_probe_from_config(&w->config).step;
    float nearest = INFINITY;
    w->finding->drop = INFINITY;
    for (uint32_t i = w->field.first_span[column]; i < w->field.first_span[column + 1]; i++) {
        const float top = height_of(&w->config, w->field.spans[i].max), away = fabsf(top - y);
        // The penalty is more than any distance that counts.
        const float rank = clearance_of(w, i) >= w->config.walkable_height ? away : away + step;
        if (away <= step && rank < nearest) {
            nearest = rank;
            w->span = i;
            w->top = w->field.spans[i].max;
            w->finding->floor.y = top;
        }
        if (top <= y) {
            w->finding->drop = y - top; // spans rise: the last one is the highest
        }
    }
    w->finding->has_floor = nearest < INFINITY;
    return w->finding->has_floor;
}

// Whether a triangle lies within a step above or below the point: then there is a floor.
static bool is_on_triangle(const why_window *w)
{
    const tl_mesh_view *mesh = &w->question->input->mesh;
    const tl_vec3 p = w->question->point;
    const float step = tl_nav_probe_from_config(&w->config).step;
    const tl_vec3 half = { 0.0f, step, 0.0f };
    const tl_convex line = tl_convex_box(p, half, 0.0f);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        const tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
        const tl_aabb own = { tl_min(a, tl_min(b, c)), tl_max(a, tl_max(b, c)) };
        const tl_aabb around = { tl_sub(p, half), tl_add(p, half) };
        const tl_convex triangle = tl_convex_triangle(a, b, c, 0.0f);
        if (tl_aabb_overlaps(own, around) &&
            tl_convex_overlap(&triangle, tl_transform_identity(), &line, tl_transform_identity(), NULL)) {
            w->finding->triangle = i;
            return true;
        }
    }
    return false;
}

// Metres in the plane from the point to the nearest triangle that no step leads onto, up to the agent's height.
static float distance_to_wall(const why_window *w)
{
    const tl_mesh_view *mesh = &w->question->input->mesh;
    const tl_nav_probe probe = tl_nav_probe_from_config(&w->config);
    const tl_vec3 p = w->question->point;
    const float middle = 0.5f * (probe.step + w->config.agent_height), half = fabsf(w->config.agent_height - middle);
    const tl_convex line = tl_convex_box(tl_vec3_make(p.x, p.y + middle, p.z), tl_vec3_make(0.0f, half, 0.0f), 0.0f);
    float nearest = INFINITY;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        const tl_convex triangle =
            tl_convex_triangle(mesh->vertices[corner[0]], mesh->vertices[corner[1]], mesh->vertices[corner[2]], 0.0f);
        tl_separation apart;
        tl_convex_distance(&triangle, tl_transform_identity(), &line, tl_transform_identity(), NULL, &apart);
        nearest = tl_minf(nearest, apart.distance);
    }
    return nearest;
}

// No floor's top is near the point: is one buried in the voxels of a wall that stands in the same column?
static tl_nav_cause cause_without_floor(why_window *w)
{
    const uint32_t column = w->z * w->field.width + w->x;
    const float y = w->question->point.y, voxel = w->config.cell_height;
    bool buried = false;
    for (uint32_t i = w->field.first_span[column]; i < w->field.first_span[column + 1]; i++) {
        buried = buried || (height_of(&w->config, w->field.spans[i].min) <= y + voxel &&
                            y <= height_of(&w->config, w->field.spans[i].max) + voxel);
    }
    if (!buried || !is_on_triangle(w)) {
        return TL_NAV_CAUSE_NO_FLOOR;
    }
    w->finding->wall = distance_to_wall(w);
    return TL_NAV_CAUSE_WALL;
}

// Of the triangles over the column whose highest point there may be the floor's: the one that is least steep.
static void choose_triangle(why_window *w)
{
    const tl_mesh_view *mesh = &w->question->input->mesh;
    const tl_nav_config *config = &w->config;
    const tl_vec3 origin = config->lattice.origin;
    const int64_t x = (int64_t)config->lattice.first_x + w->x, z = (int64_t)config->lattice.first_z + w->z;
    const float climb = config->cell_height * (float)(config->walkable_climb + 1);
    const tl_aabb box = { { tl_nav_lattice_to_world(origin.x, x, config->cell_size), w->finding->floor.y - climb,
                            tl_nav_lattice_to_world(origin.z, z, config->cell_size) },
                          { tl_nav_lattice_to_world(origin.x, x + 1, config->cell_size), w->finding->floor.y,
                            tl_nav_lattice_to_world(origin.z, z + 1, config->cell_size) } };
    const tl_convex column = tl_convex_box(tl_aabb_center(box), tl_scale(tl_aabb_size(box), 0.5f), 0.0f);
    w->finding->triangle = TL_NO_TRIANGLE;
    w->finding->normal_y = -1.0f;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        const tl_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
        const tl_aabb own = { tl_min(a, tl_min(b, c)), tl_max(a, tl_max(b, c)) };
        if (!tl_aabb_overlaps(own, box)) {
            continue;
        }
        const tl_convex triangle = tl_convex_triangle(a, b, c, 0.0f);
        const float y = tl_normalize(tl_cross(tl_sub(b, a), tl_sub(c, a))).y;
        if (y > w->finding->normal_y &&
            tl_convex_overlap(&triangle, tl_transform_identity(), &column, tl_transform_identity(), NULL)) {
            w->finding->triangle = i;
            w->finding->normal_y = y;
        }
    }
}

// ---- Filters -----------------------------------------------------------------------------------------------

static bool is_span_walkable(const why_window *w)
{
    return w->field.spans[w->span].area != TL_NAV_NULL_AREA;
}

// The smallest climb with which the ledge filter leaves the floor, tried on the spans as they were before it.
static tl_result find_climb(why_window *w, const tl_nav_span *before)
{
    tl_nav_config config = w->config;
    const uint32_t highest = tl_min_u32(config.height_voxels, TL_NAV_MAX_VOXELS);
    w->finding->needed_climb = 0;
    for (config.walkable_climb++; config.walkable_climb <= highest; config.walkable_climb++) {
        memcpy(w->field.spans, before, w->field.span_count * sizeof *before);
        tl_nav_filter_ledge_spans(&config, &w->field);
        if (is_span_walkable(w)) {
            w->finding->needed_climb = config.walkable_climb;
            break;
        }
    }
    return TL_OK;
}

static tl_result filter_ledges_at(why_window *w)
{
    const tl_allocator *allocator = w->question->host->allocator;
    const uint32_t count = w->field.span_count;
    tl_nav_span *before = tl_allocate_array(allocator, count, sizeof *before);
    if (before == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(before, w->field.spans, count * sizeof *before);
    tl_nav_filter_ledge_spans(&w->config, &w->field);
    tl_result result = TL_OK;
    if (!is_span_walkable(w)) {
        w->finding->cause = TL_NAV_CAUSE_LEDGE;
        result = find_climb(w, before);
    }
    tl_release_array(allocator, before, count, sizeof *before);
    return result;
}

// The filters one by one, in the pipeline's order, until one removes the floor.
static tl_result filter_floor(why_window *w)
{
    const tl_nav_config *config = &w->config;
    if (config->filter_low_hanging_obstacles) {
        tl_nav_filter_low_hanging_obstacles(config, &w->field);
    }
    if (!is_span_walkable(w)) {
        const uint8_t *areas = w->question->input->areas;
        const uint32_t triangle = w->finding->triangle;
        const bool by_input = areas != NULL && triangle != TL_NO_TRIANGLE && areas[triangle] == TL_NAV_NULL_AREA;
        w->finding->cause = by_input ? TL_NAV_CAUSE_AREA_INPUT : TL_NAV_CAUSE_SLOPE;
        return TL_OK;
    }
    if (config->filter_ledge_spans) {
        TL_TRY(filter_ledges_at(w));
    }
    if (w->finding->cause == TL_NAV_CAUSE_NONE && config->filter_walkable_low_height_spans) {
        tl_nav_filter_walkable_low_height_spans(config, &w->field);
        if (!is_span_walkable(w)) {
            w->finding->cause = TL_NAV_CAUSE_CEILING;
            w->finding->clearance = clearance_of(w, w->span);
        }
    }
    return TL_OK;
}

// ---- Erosion and volumes -----------------------------------------------------------------------------------

// The floor among the open floors of a column.
static uint32_t find_open_floor(const tl_nav_compact *compact, uint32_t x, uint32_t z, uint16_t top)
{
    const uint32_t column = z * compact->width + x;
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        if (compact->floor[i] == top) {
            return i;
        }
    }
    return TL_NAV_NO_SPAN;
}

// Whether the floor outlives an erosion by `radius` columns.
static tl_result outlives(why_window *w, uint32_t radius, bool *outlives_out)
{
    tl_nav_config config = w->config;
    config.walkable_radius = radius;
    tl_nav_compact_free(&w->compact);
    TL_TRY(tl_nav_bake_compact(&config, &w->field, w->question->host, &w->compact, w->report));
    TL_TRY(tl_nav_erode(&config, w->question->host, &w->compact, w->report));
    const uint32_t at = find_open_floor(&w->compact, w->x, w->z, w->top);
    *outlives_out = at != TL_NAV_NO_SPAN && w->compact.area[at] != TL_NAV_NULL_AREA;
    return TL_OK;
}

static tl_result erode_floor(why_window *w)
{
    bool stays;
    TL_TRY(outlives(w, w->config.walkable_radius, &stays));
    if (stays) {
        return TL_OK;
    }
    w->finding->cause = TL_NAV_CAUSE_RADIUS;
    uint32_t radius = w->config.walkable_radius;
    while (!stays && radius > 0) {
        TL_TRY(outlives(w, --radius, &stays));
    }
    w->finding->kept_radius = radius;
    return TL_OK;
}

static void mark_window_volumes(why_window *w)
{
    const tl_nav_input *input = w->question->input;
    for (uint32_t i = 0; i < input->volume_count; i++) {
        tl_nav_mark_volume_area(&w->compact, &input->volumes[i]);
    }
    const uint32_t at = find_open_floor(&w->compact, w->x, w->z, w->top);
    if (w->compact.area[at] == TL_NAV_NULL_AREA) {
        w->finding->cause = TL_NAV_CAUSE_VOLUME;
    }
}

static tl_result look_through_window(why_window *w)
{
    const tl_nav_input *input = w->question->input;
    TL_TRY(tl_nav_rasterize(&w->config, &input->mesh, input->areas, w->question->host, &w->field, w->report));
    if (!choose_span(w)) {
        w->finding->cause = cause_without_floor(w);
        return TL_OK;
    }
    choose_triangle(w);
    TL_TRY(filter_floor(w));
    if (w->finding->cause == TL_NAV_CAUSE_NONE) {
        TL_TRY(erode_floor(w));
    }
    if (w->finding->cause == TL_NAV_CAUSE_NONE) {
        mark_window_volumes(w);
    }
    return TL_OK;
}

// ---- Regions and outlines ----------------------------------------------------------------------------------

// The columns of the walkable floors connected to one: a flood fill.
static tl_result measure_island(const tl_nav_compact *compact, uint32_t from, const tl_host *host, uint32_t *size_out)
{
    const uint32_t count = compact->span_count;
    uint32_t *waiting = tl_allocate_array(host->allocator, count, sizeof *waiting);
    uint8_t *seen = tl_allocate_array(host->allocator, count, sizeof *seen);
    tl_result result = waiting != NULL && seen != NULL ? TL_OK : TL_ERR_MEMORY;
    uint32_t size = 0, end = 0;
    if (result == TL_OK) {
        memset(seen, 0, count);
        seen[from] = 1;
        waiting[end++] = from;
    }
    while (size < end) {
        const uint32_t at = waiting[size++];
        for (uint32_t direction = 0; direction < 4; direction++) {
            const uint32_t next = tl_nav_compact_neighbour(compact, at, direction);
            if (next != TL_NAV_NO_SPAN && !seen[next] && compact->area[next] != TL_NAV_NULL_AREA) {
                seen[next] = 1;
                waiting[end++] = next;
            }
        }
    }
    tl_release_array(host->allocator, waiting, count, sizeof *waiting);
    tl_release_array(host->allocator, seen, count, sizeof *seen);
    *size_out = size;
    return result;
}

static tl_result is_on_tile(const tl_nav_tile *tile, const tl_nav_config *config, tl_vec3 floor,
                            const tl_allocator *allocator, bool *on_out)
{
    *on_out = false;
    if (tile == NULL) {
        return TL_OK;
    }
    tl_navmesh *navmesh;
    tl_nav_location location;
    TL_TRY(tl_navmesh_create(allocator, &navmesh));
    tl_result result = tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED);
    *on_out = result == TL_OK && tl_why_on_navmesh(navmesh, config, floor, &location);
    tl_navmesh_destroy(navmesh);
    return result;
}

// What the tile makes of the floor. A simplified outline may reach over columns that were removed: the point is
// walkable then, whatever the stages before said. Where they let it stay and it is not, regions or outlines took it.
static tl_result look_at_tile(const why_window *w, const int64_t column[2], tl_why_finding *finding)
{
    const tl_host *host = w->question->host;
    const tl_nav_config *config = &finding->config;
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    tl_nav_tile *tile = NULL;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_result result = tl_nav_tile_bake(config, w->question->input, host, &stages, &tile, &report);
    if (result != TL_OK) {
        *w->report = report.base;
        return result;
    }
    bool on_tile = false;
    result = is_on_tile(tile, config, finding->floor, host->allocator, &on_tile);
    if (on_tile) {
        finding->cause = TL_NAV_CAUSE_NONE;
    } else if (result == TL_OK && finding->cause == TL_NAV_CAUSE_NONE) {
        const uint32_t x = (uint32_t)(column[0] - config->lattice.first_x);
        const uint32_t z = (uint32_t)(column[1] - config->lattice.first_z);
        const uint32_t at = find_open_floor(&stages.compact, x, z, w->top);
        const bool dropped = at != TL_NAV_NO_SPAN && stages.compact.region[at] == 0;
        finding->cause = dropped ? TL_NAV_CAUSE_ISLAND : TL_NAV_CAUSE_OUTLINE;
        result = dropped ? measure_island(&stages.compact, at, host, &finding->island) : TL_OK;
    }
    tl_blob_free(tile);
    tl_nav_stages_free(&stages);
    return result;
}

tl_result tl_why_find(const tl_why_question *question, const tl_nav_def *def, tl_why_finding *finding_out,
                      tl_report *report)
{
    why_window w;
    int64_t column[2] = { 0, 0 };
    bool inside = true;
    memset(&w, 0, sizeof w);
    memset(finding_out, 0, sizeof *finding_out);
    finding_out->floor = question->point;
    finding_out->triangle = TL_NO_TRIANGLE;
    TL_TRY(find_tile(question, def, column, &inside, finding_out, report));
    w.question = question;
    w.finding = finding_out;
    w.report = report;
    if (!inside) {
        finding_out->cause = TL_NAV_CAUSE_OUTSIDE;
        return TL_OK;
    }
    place_window(&finding_out->config, column, &w);
    tl_result result = look_through_window(&w);
    tl_nav_heightfield_free(&w.field);
    tl_nav_compact_free(&w.compact);
    if (result == TL_OK && finding_out->cause != TL_NAV_CAUSE_NO_FLOOR && !question->window_only) {
        result = look_at_tile(&w, column, finding_out);
    }
    return result;
}
