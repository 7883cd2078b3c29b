// SPDX-License-Identifier: MIT
//
// Metres become voxels: here and nowhere else.
//
// A ratio of two decimal settings is rarely the whole number that the user sees: 0.9 / 0.3 is 2.9999998 in floats,
// 0.6 / 0.1 is 6.0000001 exact. Rounding such a ratio up or down would cost or give a voxel by accident, so a ratio
// within the noise of its two operands counts as the whole number. All tiles of a level take their columns from one
// lattice by integer arithmetic; a tile's corner in metres is derived from it, never the other way round.

#include "base/assert.h"
#include "base/host.h"
#include "math/cos_degrees.h"
#include "math/tolerance.h"

#include <talus/nav_bake.h>

#include <math.h>
#include <string.h>

/// Relative noise of a quotient of two floats that stand for decimals: each was rounded once.
#define QUOTIENT_NOISE ((double)TL_FLOAT_GAMMA(2))

/// Columns that a tile sees of its neighbours beyond the agent's radius: the regions and contours at a tile's edge then
/// no longer feel that the field ends.
enum { BORDER_MARGIN = 3 };

tl_nav_def tl_default_nav_def(void)
{
    tl_nav_def def;
    memset(&def, 0, sizeof def);
    def.cell_size = 0.3f;
    def.cell_height = 0.2f;
    def.agent_height = 2.0f;
    def.agent_radius = 0.6f;
    def.agent_max_climb = 0.9f;
    def.agent_max_slope = 45.0f;
    def.region_min_size = 8.0f;
    def.region_merge_size = 20.0f;
    def.edge_max_len = 12.0f;
    def.edge_max_error = 1.3f;
    def.max_verts_per_poly = 6;
    def.detail_sample_dist = 6.0f;
    def.detail_sample_max_error = 1.0f;
    def.partition = TL_NAV_WATERSHED;
    def.polygon_method = TL_PARTITION_CLASSIC;
    def.filter_low_hanging_obstacles = true;
    def.filter_ledge_spans = true;
    def.filter_walkable_low_height_spans = true;
    def.bounds = tl_aabb_empty();
    def.cookie = TL_DEF_COOKIE;
    return def;
}

// length / unit, snapped to the whole number that it stands for.
static double quotient(double length, float unit)
{
    double ratio = length / (double)unit;
    double whole = floor(ratio + 0.5);
    return fabs(ratio - whole) <= whole * QUOTIENT_NOISE ? whole : ratio;
}

// ---- Validation ------------------------------------------------------------------------------------------

typedef struct field_rule {
    const char *name;
    float value;
    float low, high;
    bool low_excluded, high_excluded;
    const char *advice;
} field_rule;

static tl_result check_fields(const tl_nav_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_def()", report));
    const float max = TL_MAX_COORDINATE;
    const field_rule rules[] = {
        { "cell_size", def->cell_size, TL_NAV_MIN_CELL, max, false, false,
          "use a third to a half of the agent's radius, in metres" },
        { "cell_height", def->cell_height, TL_NAV_MIN_CELL, max, false, false,
          "use about half of the cell size, in metres" },
        { "agent_height", def->agent_height, 0, max, true, false, "use the agent's height in metres, above 0" },
        { "agent_radius", def->agent_radius, 0, max, false, false, "use the agent's radius in metres, 0 or more" },
        { "agent_max_climb", def->agent_max_climb, 0, max, false, false, "use the highest step in metres, 0 or more" },
        { "agent_max_slope", def->agent_max_slope, 0, 90, false, true, "use degrees from 0 up to, but not, 90" },
        { "region_min_size", def->region_min_size, 0, 65535, false, false, "use a number of cells, 0 to 65535" },
        { "region_merge_size", def->region_merge_size, 0, 65535, false, false, "use a number of cells, 0 to 65535" },
        { "edge_max_len", def->edge_max_len, 0, max, false, false, "use metres, or 0 for edges of any length" },
        { "edge_max_error", def->edge_max_error, 0, 65535, false, false, "use cells, 1.1 to 1.5 in most cases" },
        { "tile_height", def->tile_height, 0, max, false, false, "use the height of a storey in metres, or 0" },
        { "detail_sample_dist", def->detail_sample_dist, 0, 65535, false, false,
          "use cells, or 0 for a detail mesh without samples" },
        { "detail_sample_max_error", def->detail_sample_max_error, 0, 65535, false, false,
          "use voxel heights, 1 in most cases" },
    };
    for (size_t i = 0; i < TL_COUNT_OF(rules); i++) {
        const field_rule *rule = &rules[i];
        bool above = rule->low_excluded ? rule->value > rule->low : rule->value >= rule->low;
        bool below = rule->high_excluded ? rule->value < rule->high : rule->value <= rule->high;
        if (!(above && below)) { // also when NaN
            return tl_report_field(report, TL_ERR_ARGUMENT, rule->name, rule->advice);
        }
    }
    if (def->max_verts_per_poly < 3 || def->max_verts_per_poly > 64) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_verts_per_poly", "use 3 to 64");
    }
    if (def->partition != TL_NAV_WATERSHED && def->partition != TL_NAV_MONOTONE && def->partition != TL_NAV_LAYERS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "partition",
                               "use TL_NAV_WATERSHED, TL_NAV_MONOTONE or TL_NAV_LAYERS");
    }
    if ((unsigned)def->polygon_method > (unsigned)TL_PARTITION_DELAUNAY) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "polygon_method",
                               "use TL_PARTITION_CLASSIC, TL_PARTITION_OPTIMAL or TL_PARTITION_DELAUNAY");
    }
    return TL_OK;
}

// def->bounds, or else the level's; whichever is used must be finite and of computable size.
static tl_result choose_bounds(const tl_nav_def *def, tl_aabb level_bounds, tl_aabb *bounds_out, tl_report *report)
{
    bool from_def = !tl_aabb_is_empty(def->bounds);
    tl_aabb bounds = from_def ? def->bounds : level_bounds;
    const char *name = from_def ? "bounds" : "level_bounds";
    if (tl_aabb_is_empty(bounds)) {
        return tl_report_field(report, TL_ERR_EMPTY, name, "give the bounds of a mesh with triangles");
    }
    if (!tl_is_finite(bounds.min) || !tl_is_finite(bounds.max)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, name, "use finite bounds");
    }
    tl_vec3 extreme = tl_max(tl_abs(bounds.min), tl_abs(bounds.max));
    if (tl_maxf(extreme.x, tl_maxf(extreme.y, extreme.z)) > TL_MAX_COORDINATE) {
        return tl_report_field(report, TL_ERR_RANGE, name, "move or scale the level towards the origin");
    }
    *bounds_out = bounds;
    return TL_OK;
}

// ---- The level's lattice -----------------------------------------------------------------------------------

typedef struct level_lattice {
    tl_aabb bounds;
    uint32_t columns_x, columns_z;
    uint32_t height_voxels;
    uint32_t tiles_x, tiles_z;
    uint32_t walkable_height, walkable_climb, walkable_radius;
    uint32_t border_size;
    uint32_t layer_height;
} level_lattice;

// Rounded to the nearest whole column: less than half a column at the far side is left out, as Recast's users know it.
static double column_count(float min, float max, float cell_size)
{
    double count = floor(((double)max - (double)min) / (double)cell_size + 0.5);
    return count > 1.0 ? count : 1.0;
}

static tl_result agent_voxels(const tl_nav_def *def, level_lattice *level, tl_report *report)
{
    const char *advice = "raise cell_height: the agent is too many voxels tall";
    double height = ceil(quotient((double)def->agent_height, def->cell_height));
    if (height > (double)TL_NAV_MAX_VOXELS) {
        return tl_report_field(report, TL_ERR_LIMIT, "agent_height", advice);
    }
    double climb = floor(quotient((double)def->agent_max_climb, def->cell_height));
    if (climb > (double)TL_NAV_MAX_VOXELS) {
        return tl_report_field(report, TL_ERR_LIMIT, "agent_max_climb",
                               "raise cell_height or lower the climb: the step is too many voxels high");
    }
    double radius = ceil(quotient((double)def->agent_radius, def->cell_size));
    if (radius > (double)TL_NAV_MAX_VOXELS) {
        return tl_report_field(report, TL_ERR_LIMIT, "agent_radius",
                               "raise cell_size: the agent is too many cells wide");
    }
    level->walkable_height = (uint32_t)height;
    level->walkable_climb = (uint32_t)climb;
    level->walkable_radius = (uint32_t)radius;
    level->border_size = def->tile_size > 0 ? level->walkable_radius + BORDER_MARGIN : 0;
    return TL_OK;
}

// The distance from the largest of two coordinates to the next float.
static float float_step(float min, float max)
{
    const float largest = tl_maxf(fabsf(min), fabsf(max));
    return nextafterf(largest, INFINITY) - largest;
}

// Two lines of the lattice must not be the same float: edges of polygons would have no length.
static tl_result check_float_steps(const tl_nav_def *def, const tl_aabb *bounds, tl_report *report)
{
    const float step_x = float_step(bounds->min.x, bounds->max.x), step_z = float_step(bounds->min.z, bounds->max.z);
    if (tl_maxf(step_x, step_z) >= def->cell_size) {
        return tl_report_field(report, TL_ERR_RANGE, "cell_size",
                               "move the level towards the origin, or raise cell_size: floats this far out are no "
                               "finer than the cells");
    }
    if (float_step(bounds->min.y, bounds->max.y) >= def->cell_height) {
        return tl_report_field(report, TL_ERR_RANGE, "cell_height",
                               "move the level towards the origin, or raise cell_height: floats this high up are no "
                               "finer than the voxels");
    }
    return TL_OK;
}

static tl_result level_columns(const tl_nav_def *def, level_lattice *level, tl_report *report)
{
    double columns_x = column_count(level->bounds.min.x, level->bounds.max.x, def->cell_size);
    double columns_z = column_count(level->bounds.min.z, level->bounds.max.z, def->cell_size);
    if (columns_x > (double)TL_NAV_MAX_LATTICE || columns_z > (double)TL_NAV_MAX_LATTICE) {
        return tl_report_field(report, TL_ERR_LIMIT, "cell_size",
                               "raise cell_size, or give smaller bounds: the level has too many columns on one side");
    }
    double voxels = ceil(quotient((double)level->bounds.max.y - (double)level->bounds.min.y, def->cell_height));
    if (voxels > (double)TL_NAV_MAX_HEIGHT) {
        return tl_report_field(report, TL_ERR_LIMIT, "cell_height",
                               "raise cell_height, or cut the level by bounds: it is more than 65534 voxels tall");
    }
    level->columns_x = (uint32_t)columns_x;
    level->columns_z = (uint32_t)columns_z;
    level->height_voxels = (uint32_t)voxels;
    return TL_OK;
}

static tl_result level_tiles(const tl_nav_def *def, level_lattice *level, tl_report *report)
{
    // Higher than any level is as good as infinitely high: layer 0 only.
    double layer = floor(quotient((double)def->tile_height, def->cell_height));
    if (def->tile_height > 0.0f && layer < 1.0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "tile_height",
                               "use the height of a storey in metres, at least cell_height, or 0");
    }
    level->layer_height = layer < (double)UINT16_MAX ? (uint32_t)layer : UINT16_MAX;
    level->tiles_x = level->tiles_z = 1;
    uint64_t width = level->columns_x, height = level->columns_z;
    if (def->tile_size > 0) {
        if (def->tile_size > TL_NAV_MAX_SIDE) {
            return tl_report_field(report, TL_ERR_LIMIT, "tile_size", "use tiles of 32 to 1024 cells");
        }
        level->tiles_x = (level->columns_x - 1) / def->tile_size + 1;
        level->tiles_z = (level->columns_z - 1) / def->tile_size + 1;
        width = height = (uint64_t)def->tile_size + 2 * (uint64_t)level->border_size;
    }
    if ((uint64_t)level->tiles_x * level->tiles_z > TL_NAV_MAX_PLACES) {
        return tl_report_field(report, TL_ERR_LIMIT, "tile_size", "raise tile_size: the level has too many tiles");
    }
    if (width > TL_NAV_MAX_SIDE || height > TL_NAV_MAX_SIDE || width * height > TL_NAV_MAX_COLUMNS) {
        return def->tile_size > 0
                   ? tl_report_field(report, TL_ERR_LIMIT, "tile_size", "use tiles of 32 to 1024 cells")
                   : tl_report_field(report, TL_ERR_LIMIT, "cell_size",
                                     "set tile_size (64, say), or raise cell_size: one tile has too many columns");
    }
    return TL_OK;
}

static tl_result make_level(const tl_nav_def *def, tl_aabb level_bounds, level_lattice *level, tl_report *report)
{
    memset(level, 0, sizeof *level);
    tl_report_begin(report, "config");
    TL_TRY(check_fields(def, report));
    TL_TRY(choose_bounds(def, level_bounds, &level->bounds, report));
    TL_TRY(agent_voxels(def, level, report));
    TL_TRY(level_columns(def, level, report));
    TL_TRY(check_float_steps(def, &level->bounds, report));
    return level_tiles(def, level, report);
}

tl_result tl_nav_tile_grid(const tl_nav_def *def, tl_aabb level_bounds, uint32_t *tiles_x_out, uint32_t *tiles_z_out,
                           tl_report *report_out)
{
    level_lattice level;
    tl_report_begin(report_out, "config");
    TL_REFUSE_NULL(tiles_x_out, report_out);
    TL_REFUSE_NULL(tiles_z_out, report_out);
    *tiles_x_out = *tiles_z_out = 0;
    const tl_nav_def defaults = tl_default_nav_def();
    TL_TRY(make_level(def != NULL ? def : &defaults, level_bounds, &level, report_out));
    *tiles_x_out = level.tiles_x;
    *tiles_z_out = level.tiles_z;
    return TL_OK;
}

// ---- One tile ----------------------------------------------------------------------------------------------

static void place_tile(const tl_nav_def *def, const level_lattice *level, uint32_t tile_x, uint32_t tile_z,
                       tl_nav_config *config)
{
    uint32_t border = level->border_size;
    config->tile_x = tile_x;
    config->tile_z = tile_z;
    config->border_size = border;
    config->width = def->tile_size > 0 ? def->tile_size + 2 * border : level->columns_x;
    config->height = def->tile_size > 0 ? def->tile_size + 2 * border : level->columns_z;
    config->height_voxels = level->height_voxels;

    // |first| <= TL_NAV_MAX_LATTICE + TL_NAV_MAX_VOXELS + 3 < 2^31.
    tl_nav_lattice *lattice = &config->lattice;
    lattice->origin = level->bounds.min;
    lattice->first_x = (int32_t)(tile_x * def->tile_size) - (int32_t)border;
    lattice->first_z = (int32_t)(tile_z * def->tile_size) - (int32_t)border;

    int64_t end_x = (int64_t)lattice->first_x + config->width, end_z = (int64_t)lattice->first_z + config->height;
    float size = def->cell_size;
    config->bounds.min =
        tl_vec3_make(tl_nav_lattice_to_world(lattice->origin.x, lattice->first_x, size), lattice->origin.y,
                     tl_nav_lattice_to_world(lattice->origin.z, lattice->first_z, size));
    config->bounds.max = tl_vec3_make(tl_nav_lattice_to_world(lattice->origin.x, end_x, size), level->bounds.max.y,
                                      tl_nav_lattice_to_world(lattice->origin.z, end_z, size));
}

// 0 stays 0 (any length), but a length of less than a column is one column. Longer than any lattice: never split.
static uint32_t edge_columns(const tl_nav_def *def)
{
    double edge = floor(quotient((double)def->edge_max_len, def->cell_size));
    if (def->edge_max_len > 0.0f && edge < 1.0) {
        return 1;
    }
    return edge < (double)TL_NAV_MAX_LATTICE ? (uint32_t)edge : TL_NAV_MAX_LATTICE;
}

tl_result tl_nav_config_from_def(const tl_nav_def *def, tl_aabb level_bounds, uint32_t tile_x, uint32_t tile_z,
                                 tl_nav_config *config_out, tl_report *report_out)
{
    level_lattice level;
    tl_report_begin(report_out, "config");
    TL_REFUSE_NULL(config_out, report_out);
    memset(config_out, 0, sizeof *config_out);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    TL_TRY(make_level(def, level_bounds, &level, report_out));
    if (tile_x >= level.tiles_x || tile_z >= level.tiles_z) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, tile_x >= level.tiles_x ? "tile_x" : "tile_z",
                               "ask tl_nav_tile_grid how many tiles there are");
    }
    tl_nav_config *config = config_out;
    place_tile(def, &level, tile_x, tile_z, config);
    config->cell_size = def->cell_size;
    config->cell_height = def->cell_height;
    config->walkable_height = level.walkable_height;
    config->walkable_climb = level.walkable_climb;
    config->walkable_radius = level.walkable_radius;
    config->walkable_slope_cos = tl_cos_degrees(def->agent_max_slope);
    config->min_region_area = (uint32_t)((double)def->region_min_size * (double)def->region_min_size);
    config->merge_region_area = (uint32_t)((double)def->region_merge_size * (double)def->region_merge_size);
    config->max_edge_len = edge_columns(def);
    config->max_simplification_error = def->edge_max_error;
    config->max_verts_per_poly = def->max_verts_per_poly;
    // Below 0.9 cells the samples would lie denser than the floors that they are taken from.
    config->detail_sample_dist = def->detail_sample_dist < 0.9f ? 0.0f : def->detail_sample_dist * def->cell_size;
    config->detail_sample_max_error = def->detail_sample_max_error * def->cell_height;
    config->partition = def->partition;
    config->polygon_method = def->polygon_method;
    config->filter_low_hanging_obstacles = def->filter_low_hanging_obstacles;
    config->filter_ledge_spans = def->filter_ledge_spans;
    config->filter_walkable_low_height_spans = def->filter_walkable_low_height_spans;
    config->layer_height = level.layer_height;
    config->agent_height = def->agent_height;
    config->agent_radius = def->agent_radius;
    config->agent_max_climb = def->agent_max_climb;
    return TL_OK;
}
