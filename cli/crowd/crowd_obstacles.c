// SPDX-License-Identifier: MIT
//
// Tiles are rebaked from their heightfields, as in a game: agents notice the edit at their next step.

#include "cli/crowd/crowd_obstacles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TILE_CELLS = 64 }; // where the options give none

static bool bake_changing_tiles(tl_cli *cli, tl_input *input, const tl_bake_settings *settings, tl_crowd_obstacles *o,
                                tl_exit *exit_out)
{
    tl_level_areas areas;
    if (!tl_level_areas_make(cli, &input->level, &settings->areas, &areas, exit_out)) {
        tl_level_areas_free(&areas);
        return false;
    }
    const tl_mesh_view mesh = tl_mesh_as_view(&input->level.mesh);
    const tl_nav_input level = tl_level_areas_input(&areas, &mesh);
    tl_nav_def def = tl_bake_begin_nav(cli, &input->level, settings);
    def.bounds = tl_aabb_is_empty(def.bounds) ? input->level.mesh.bounds : def.bounds;
    def.tile_size = def.tile_size > 0 ? def.tile_size : TILE_CELLS;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof(report));
    tl_result result = tl_nav_obstacles_bake(&def, &level, &o->tiles, NULL, &report);
    result = result == TL_OK ? tl_navmesh_create(NULL, &o->navmesh) : result;
    result = result == TL_OK ? tl_nav_obstacles_update(o->tiles, o->navmesh, UINT32_MAX, NULL, &report) : result;
    tl_level_areas_free(&areas);
    tl_progress_end(&cli->progress);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, input->path, result, &report.base);
    } else if (tl_navmesh_tile_count(o->navmesh) == 0) {
        input->bake.nav_report = report;
        *exit_out = tl_input_fail_empty(cli, input, settings);
        return false;
    }
    return result == TL_OK;
}

bool tl_crowd_obstacles_make(tl_cli *cli, tl_input *input, const tl_bake_settings *settings,
                             const tl_crowd_scenario *scenario, tl_crowd_obstacles *obstacles_out, tl_exit *exit_out)
{
    tl_crowd_obstacles *o = obstacles_out;
    memset(o, 0, sizeof(*o));
    o->scenario = scenario;
    if (input->baked) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_DATA,
                                "%s: a baked file has no room for the scenario's obstacles; give the level itself",
                                input->path);
        return false;
    }
    if (settings->seeds.count > 0 || settings->drop_inside || settings->min_island_area > 0.0f ||
        settings->hand_links.words.count > 0 || settings->hand_links.path != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE,
                                "a scenario with obstacles rebakes tiles, which are neither pruned nor linked by hand "
                                "again; leave those options out");
        return false;
    }
    for (uint32_t i = 0; i < scenario->obstacle_count; ++i) {
        const tl_crowd_obstacle *it = &scenario->obstacles[i];
        const float last = isfinite(it->until) ? it->until : it->from;
        o->last_change = last > o->last_change ? last : o->last_change;
    }
    o->ids = calloc((size_t)scenario->obstacle_count + 1, sizeof(*o->ids));
    if (o->ids == NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
        return false;
    }
    return bake_changing_tiles(cli, input, settings, o, exit_out);
}

// About the centre of its base: tilted, then turned.
static void tilt_box(const tl_crowd_obstacle *it, tl_nav_obstacle *shape)
{
    const double turn = 0.5 * TL_CROWD_DEGREE * (double)it->turn, tilt = 0.5 * TL_CROWD_DEGREE * (double)it->tilt;
    const tl_vec3 half = tl_vec3_make(0.5f * it->size[0], 0.5f * it->height, 0.5f * it->size[1]);
    shape->shape = TL_NAV_OBSTACLE_CONVEX;
    shape->convex = tl_convex_box(tl_vec3_make(0.0f, half.y, 0.0f), half, 0.0f);
    shape->pose.position = it->at;
    shape->pose.rotation = (tl_quat){ (float)(sin(turn) * sin(tilt)), (float)(sin(turn) * cos(tilt)),
                                      (float)(cos(turn) * sin(tilt)), (float)(cos(turn) * cos(tilt)) };
}

static tl_nav_obstacle shape_of(const tl_crowd_obstacle *it)
{
    tl_nav_obstacle shape;
    memset(&shape, 0, sizeof(shape));
    if (it->is_capsule) {
        shape.shape = TL_NAV_OBSTACLE_CONVEX;
        shape.convex = tl_convex_capsule(tl_vec3_make(0, 0, 0), tl_sub(it->to, it->at), it->radius);
        shape.pose.position = it->at;
        return shape;
    }
    if (it->tilt != 0.0f) {
        tilt_box(it, &shape);
        return shape;
    }
    shape.shape = it->radius > 0.0f ? TL_NAV_OBSTACLE_CYLINDER : TL_NAV_OBSTACLE_BOX;
    shape.area = TL_NAV_NULL_AREA;
    shape.base = it->at;
    shape.height = it->height;
    shape.radius = it->radius;
    shape.half_x = 0.5f * it->size[0];
    shape.half_z = 0.5f * it->size[1];
    shape.cosine = (float)cos(TL_CROWD_DEGREE * (double)it->turn);
    shape.sine = (float)sin(TL_CROWD_DEGREE * (double)it->turn);
    return shape;
}

bool tl_crowd_obstacles_set_time(tl_cli *cli, tl_crowd_obstacles *o, float time, tl_exit *exit_out)
{
    tl_report report;
    memset(&report, 0, sizeof(report));
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < o->scenario->obstacle_count && result == TL_OK; ++i) {
        const tl_crowd_obstacle *it = &o->scenario->obstacles[i];
        const bool is_there = time >= it->from && time < it->until;
        if (is_there && o->ids[i] == 0) {
            const tl_nav_obstacle shape = shape_of(it);
            result = tl_nav_obstacles_add(o->tiles, &shape, &o->ids[i], &report);
        } else if (!is_there && o->ids[i] != 0) {
            result = tl_nav_obstacles_remove(o->tiles, o->ids[i]);
            o->ids[i] = 0;
        }
    }
    if (result == TL_OK && tl_nav_obstacles_waiting(o->tiles) > 0) {
        tl_nav_bake_report baked;
        memset(&baked, 0, sizeof(baked));
        result = tl_nav_obstacles_update(o->tiles, o->navmesh, UINT32_MAX, NULL, &baked);
        report = baked.base;
    }
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, "obstacles", result, &report);
    }
    return result == TL_OK;
}

void tl_crowd_obstacles_free(tl_crowd_obstacles *o)
{
    tl_navmesh_destroy(o->navmesh);
    tl_nav_obstacles_destroy(o->tiles);
    free(o->ids);
    memset(o, 0, sizeof(*o));
}
