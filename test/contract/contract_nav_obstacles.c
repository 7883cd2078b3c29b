// SPDX-License-Identifier: MIT
//
// The functions of nav_obstacles.h under the contract.

#include "backward_tasks.h"
#include "contract.h"

#include <talus/nav_obstacles.h>

#include <string.h>

static tl_nav_def tiled_def(const tl_host *host)
{
    tl_nav_def def = contract_level_get()->nav_def;
    def.bounds.min = tl_vec3_make(0, -1, 0);
    def.bounds.max = tl_vec3_make(20, 4, 20);
    if (host != NULL) {
        def.host = *host;
    }
    return def;
}

static tl_nav_obstacle crate(void)
{
    tl_nav_obstacle obstacle;
    memset(&obstacle, 0, sizeof obstacle);
    obstacle.shape = TL_NAV_OBSTACLE_CYLINDER;
    obstacle.base = tl_vec3_make(4, 0, 4);
    obstacle.radius = obstacle.height = 1.0f;
    return obstacle;
}

static tl_nav_obstacles *make_obstacles(void)
{
    const tl_nav_def def = tiled_def(NULL);
    tl_nav_tile_block block;
    tl_nav_obstacles *obstacles;
    TEST_RESULT(tl_nav_obstacles_bake(&def, &contract_level_get()->nav_input, &obstacles, &block, NULL), TL_OK);
    tl_nav_tile_block_free(&block);
    return obstacles;
}

static bool is_null_input(const contract_run *run, uint32_t input)
{
    return run->what == CONTRACT_NULL_INPUT && run->variant == input;
}

static const char *const BAKE_FIELDS[] = { "tile_size", "bounds", "cell_size", NULL };

static tl_result nav_obstacles_bake(contract_run *run)
{
    tl_nav_def def = tiled_def(run->host);
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.tile_size = run->variant == 0 ? 0 : def.tile_size;
        def.bounds = run->variant == 1 ? tl_aabb_empty() : def.bounds;
        def.cell_size = run->variant == 2 ? -1.0f : def.cell_size;
    }
    tl_nav_obstacles *obstacles = (tl_nav_obstacles *)(uintptr_t)1;
    tl_nav_tile_block block;
    memset(&block, 0x55, sizeof block);
    tl_nav_bake_report report = { 0 };
    const tl_result result = tl_nav_obstacles_bake(
        &def, is_null_input(run, 0) ? NULL : &contract_level_get()->nav_input,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &obstacles, &block, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = (run->what == CONTRACT_NULL_OUTPUT || obstacles == NULL) && contract_is_zero(&block, sizeof block);
    if (result == TL_OK) {
        run->answer = tl_nav_obstacles_bytes(obstacles);
        tl_nav_tile_block_free(&block);
        tl_nav_obstacles_destroy(obstacles);
    }
    return result;
}

static tl_result nav_obstacles_destroy(contract_run *run)
{
    (void)run;
    tl_nav_obstacles_destroy(NULL);
    return TL_OK;
}

static tl_result nav_obstacles_set_tasks(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    tl_tasks tasks;
    test_backward_tasks(&tasks, 4);
    tl_result result = tl_nav_obstacles_set_tasks(is_null_input(run, 0) ? NULL : obstacles, &tasks);
    result = result == TL_OK ? tl_nav_obstacles_set_tasks(obstacles, NULL) : result;
    run->is_clear = true;
    run->answer = tl_nav_obstacles_waiting(obstacles);
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static const char *const OBSTACLE_FIELDS[] = { "shape", "base", "height", "radius", "convex", "pose", NULL };

static tl_nav_obstacle obstacle_of(const contract_run *run)
{
    tl_nav_obstacle obstacle = crate();
    if (run->what == CONTRACT_BAD_FIELD) {
        obstacle.shape = run->variant == 0 ? (tl_nav_obstacle_shape)9 : obstacle.shape;
        obstacle.base.x = run->variant == 1 ? 0.0f / (obstacle.cosine * 0.0f) : obstacle.base.x;
        obstacle.height = run->variant == 2 ? -1.0f : obstacle.height;
        obstacle.radius = run->variant == 3 ? 0.0f : obstacle.radius;
        if (run->variant >= 4) {
            obstacle.shape = TL_NAV_OBSTACLE_CONVEX;
            obstacle.convex = tl_convex_sphere(obstacle.base, run->variant == 4 ? -1.0f : 1.0f);
            obstacle.pose.position.y = run->variant == 5 ? 0.0f / (obstacle.cosine * 0.0f) : 0.0f;
        }
    }
    return obstacle;
}

static tl_result nav_obstacles_add(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_nav_obstacle obstacle = obstacle_of(run);
    tl_nav_obstacle_id id = 99;
    const tl_result result =
        tl_nav_obstacles_add(is_null_input(run, 0) ? NULL : obstacles, is_null_input(run, 1) ? NULL : &obstacle,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &id, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || id == 0;
    run->answer = id;
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static tl_result nav_obstacles_move(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_nav_obstacle before = crate(), after = obstacle_of(run);
    tl_nav_obstacle_id id;
    TEST_RESULT(tl_nav_obstacles_add(obstacles, &before, &id, NULL), TL_OK);
    const tl_result result =
        tl_nav_obstacles_move(is_null_input(run, 0) ? NULL : obstacles, run->what == CONTRACT_STALE ? id + 1 : id,
                              is_null_input(run, 1) ? NULL : &after, run->report);
    run->is_clear = true;
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static tl_result nav_obstacles_remove(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_nav_obstacle obstacle = crate();
    tl_nav_obstacle_id id;
    TEST_RESULT(tl_nav_obstacles_add(obstacles, &obstacle, &id, NULL), TL_OK);
    TEST_CHECK(tl_nav_obstacles_count(obstacles) == 1 && tl_nav_obstacles_waiting(obstacles) > 0);
    const tl_result result =
        tl_nav_obstacles_remove(is_null_input(run, 0) ? NULL : obstacles, run->what == CONTRACT_STALE ? id + 1 : id);
    TEST_CHECK(tl_nav_obstacles_count(obstacles) == (result == TL_OK ? 0u : 1u));
    run->is_clear = true;
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static tl_result nav_obstacles_rebake(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_aabb changed = { { 1, 0, 1 }, { 2, 1, 2 } };
    tl_nav_bake_report report = { 0 };
    const tl_result result = tl_nav_obstacles_rebake(is_null_input(run, 0) ? NULL : obstacles,
                                                     is_null_input(run, 1) ? NULL : &contract_level_get()->nav_input,
                                                     changed, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = true;
    run->answer = tl_nav_obstacles_waiting(obstacles);
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static tl_result nav_obstacles_bake_next(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_nav_obstacle obstacle = crate();
    tl_nav_obstacle_id id;
    if (run->what != CONTRACT_NOT_FOUND) {
        TEST_RESULT(tl_nav_obstacles_add(obstacles, &obstacle, &id, NULL), TL_OK);
    }
    tl_nav_rebaked_tile rebaked;
    memset(&rebaked, 0x55, sizeof rebaked);
    tl_nav_bake_report report = { 0 };
    const tl_result result = tl_nav_obstacles_bake_next(is_null_input(run, 0) ? NULL : obstacles,
                                                        run->what == CONTRACT_NULL_OUTPUT ? NULL : &rebaked,
                                                        run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&rebaked, sizeof rebaked);
    if (result == TL_OK) {
        run->answer = contract_hash(rebaked.stack.tiles[0], (size_t)rebaked.stack.tiles[0]->blob.size, 0);
        tl_nav_tile_stack_free(&rebaked.stack);
    }
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

static tl_result nav_obstacles_update(contract_run *run)
{
    tl_nav_obstacles *obstacles = make_obstacles();
    const tl_nav_obstacle obstacle = crate();
    tl_nav_obstacle_id id;
    tl_navmesh *navmesh;
    TEST_RESULT(tl_nav_obstacles_add(obstacles, &obstacle, &id, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    uint32_t waiting = 99;
    tl_nav_bake_report report = { 0 };
    const tl_result result =
        tl_nav_obstacles_update(is_null_input(run, 0) ? NULL : obstacles, is_null_input(run, 1) ? NULL : navmesh, 1000,
                                &waiting, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = waiting == 0;
    run->answer = tl_navmesh_tile_count(navmesh);
    TEST_CHECK(result != TL_OK || (run->answer > 0 && waiting == 0));
    tl_navmesh_destroy(navmesh);
    tl_nav_obstacles_destroy(obstacles);
    return result;
}

#define CALLS (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT))

const contract_entry CONTRACT_TABLE_nav_obstacles[] = {
    { "tl_nav_obstacles_bake",
      CALLS | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(CANCELLED),
      1, 1, BAKE_FIELDS, nav_obstacles_bake, NULL },
    { "tl_nav_obstacles_destroy", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, nav_obstacles_destroy, NULL },
    { "tl_nav_obstacles_set_tasks", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT), 1, 0, NULL, nav_obstacles_set_tasks,
      NULL },
    { "tl_nav_obstacles_add", CALLS | CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_OUTPUT), 2, 1, OBSTACLE_FIELDS,
      nav_obstacles_add, NULL },
    { "tl_nav_obstacles_move", CALLS | CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(STALE), 2, 0, OBSTACLE_FIELDS,
      nav_obstacles_move, NULL },
    { "tl_nav_obstacles_remove", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(STALE), 1, 0, NULL,
      nav_obstacles_remove, NULL },
    { "tl_nav_obstacles_count", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_obstacles_remove, NULL },
    { "tl_nav_obstacles_waiting", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_obstacles_remove, NULL },
    { "tl_nav_obstacles_bytes", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_obstacles_bake, NULL },
    { "tl_nav_obstacles_rebake", CALLS, 2, 0, NULL, nav_obstacles_rebake, NULL },
    { "tl_nav_obstacles_bake_next", CALLS | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND), 1, 1, NULL,
      nav_obstacles_bake_next, NULL },
    { "tl_nav_obstacles_update", CALLS, 2, 0, NULL, nav_obstacles_update, NULL },
    { 0 },
};
