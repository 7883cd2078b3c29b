// SPDX-License-Identifier: MIT
//
// What the calls of the contract are made on.

#include "contract.h"

#include "base/hash.h"

#include <string.h>

uint64_t contract_hash(const void *bytes, size_t size, uint64_t seed)
{
    return tl_hash_bytes(bytes, size, seed);
}

bool contract_is_zero(const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; i++) {
        if (b[i] != 0) {
            return false;
        }
    }
    return true;
}

tl_transform contract_pose(const contract_run *run, tl_vec3 position)
{
    tl_transform pose = tl_transform_identity();
    pose.position = position;
    if (run->what == CONTRACT_ZERO_ROTATION) {
        pose.rotation.w = 0;
    }
    return pose;
}

static bool accept_all(uint32_t triangle, uint16_t material, void *user)
{
    (void)triangle;
    (void)material;
    (void)user;
    return true;
}

const tl_ray_filter *contract_ray_filter(const contract_run *run, tl_ray_filter *filter)
{
    memset(filter, 0, sizeof *filter);
    filter->accept = run->what == CONTRACT_ZEROED_FILTER ? NULL : accept_all;
    return run->what == CONTRACT_NULL_DEF ? NULL : filter;
}

static const tl_vec3 VERTICES[] = {
    { 0, 0, 0 }, { 0, 0, 20 }, { 20, 0, 20 }, { 20, 0, 0 }, // the floor
    { 8, 0, 8 }, { 8, 0, 12 }, { 12, 0, 12 }, { 12, 0, 8 }, // the box's bottom
    { 8, 2, 8 }, { 8, 2, 12 }, { 12, 2, 12 }, { 12, 2, 8 }, // the box's top
};

static const uint32_t INDICES[] = {
    0, 1, 2,  0, 2,  3,                                          // the floor
    8, 9, 10, 8, 10, 11,                                         // the box's top
    4, 8, 11, 4, 11, 7,  7, 11, 10, 7, 10, 6, 6, 10, 9, 6, 9, 5, // its sides
    5, 9, 8,  5, 8,  4,
};

static void make_navmesh(contract_level *level)
{
    level->nav_def = tl_default_nav_def();
    level->nav_def.tile_size = 32;
    level->nav_input.mesh = level->view;
    TEST_RESULT(tl_nav_bake(&level->nav_def, &level->nav_input, &level->tiles, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &level->navmesh), TL_OK);
    for (uint32_t i = 0; i < level->tiles.tile_count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(level->navmesh, level->tiles.tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &level->query, NULL), TL_OK);
    def.max_nodes = 2;
    TEST_RESULT(tl_nav_query_create(&def, &level->tiny_query, NULL), TL_OK);
    level->stale = (tl_nav_ref)0xfffeu << 48 | 1u;
}

const contract_level *contract_level_get(void)
{
    static contract_level level;
    if (level.soup == NULL) {
        level.view.vertices = VERTICES;
        level.view.vertex_count = sizeof VERTICES / sizeof *VERTICES;
        level.view.indices = INDICES;
        level.view.triangle_count = sizeof INDICES / sizeof *INDICES / 3;
        level.here = tl_vec3_make(4, 0, 10);
        level.there = tl_vec3_make(16, 0, 10);
        level.nowhere = tl_vec3_make(500, 0, 500);
        TEST_RESULT(tl_mesh_bake(&level.view, NULL, &level.mesh, NULL), TL_OK);
        TEST_RESULT(tl_soup_bake(&level.view, NULL, &level.soup, NULL), TL_OK);
        TEST_RESULT(tl_hull_bake(VERTICES + 4, 8, NULL, &level.hull, NULL), TL_OK);
        make_navmesh(&level);
    }
    return &level;
}
