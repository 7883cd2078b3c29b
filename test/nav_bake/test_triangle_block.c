// SPDX-License-Identifier: MIT
//
// The first questions about triangles, a block at a time, against the same questions one by one; test_voxelize has
// those about cells and voxels.

#include "nav_bake/voxels/triangle_block.h"

#include "nav_bake/input/level_mesh.h"
#include "nav_fields.h"

#include <math.h>

enum { VERTICES = 300, TRIANGLES = 3 * TL_TRIANGLE_BLOCK + 7 };

typedef struct level {
    tl_vec3 vertices[VERTICES];
    uint32_t indices[3 * TRIANGLES];
    tl_mesh_view view;
} level;

// Slopes of all kinds: random ones, flat ones, ones of exactly 45 degrees, and triangles too small or large for floats.
static void make_level(level *l, uint64_t seed)
{
    test_random random = { seed };
    const float sizes[] = { 1.0f, 1e-9f, 1e9f, 30.0f };
    for (uint32_t v = 0; v < VERTICES; v++) {
        const float size = sizes[test_random_below(&random, 4)];
        l->vertices[v] = test_random_point(&random, tl_vec3_make(-size, -size, -size), tl_vec3_make(size, size, size));
        if (v % 3 == 0) {
            l->vertices[v].y = 0.0f;
        } else if (v % 3 == 1) {
            l->vertices[v].y = l->vertices[v].x;
        }
    }
    for (uint32_t i = 0; i < 3 * TRIANGLES; i++) {
        const uint32_t any = test_random_below(&random, VERTICES / 3);
        l->indices[i] = 3 * any + (i / 3 % 4 < 3 ? i / 3 % 4 : test_random_below(&random, 3));
    }
    l->view = (tl_mesh_view){ l->vertices, VERTICES, l->indices, TRIANGLES, NULL };
}

typedef struct seen_slopes {
    uint32_t steep, walkable, undecided;
} seen_slopes;

static void check_lane(const level *l, const tl_lattice_map *map, const tl_triangle_block *block, uint32_t lane,
                       uint32_t triangle, seen_slopes *seen)
{
    tl_vec3 p[3];
    for (uint32_t c = 0; c < 3; c++) {
        p[c] = l->vertices[l->indices[3 * triangle + c]];
        const tl_voxel_point want = tl_lattice_map_point(map, p[c]), have = tl_triangle_block_corner(block, c, lane);
        TEST_CHECK(memcmp(&want, &have, sizeof want) == 0);
    }
    const bool walkable = tl_triangle_is_walkable(p[0], p[1], p[2], cosf(0.785398f));
    const int32_t slope = block->slope[lane];
    TEST_CHECK(slope == TL_SLOPE_UNDECIDED || (slope == TL_SLOPE_WALKABLE) == walkable);
    seen->steep += slope == TL_SLOPE_STEEP;
    seen->walkable += slope == TL_SLOPE_WALKABLE;
    seen->undecided += slope == TL_SLOPE_UNDECIDED;
}

static void check_blocks(const level *l, const tl_triangle_list *list, const tl_block_questions *ask, seen_slopes *seen)
{
    const tl_nav_lattice lattice = { { -31.3f, -7.1f, 12.9f }, -5, 70 };
    const tl_lattice_map map = tl_lattice_map_make(&lattice, 0.3f, 0.2f);
    tl_triangle_block block;
    memset(&block, 0, sizeof block);
    uint32_t first = 0;
    while (first < list->count) {
        const uint32_t count = tl_triangle_block_fill(&block, &l->view, list, first);
        TEST_CHECK(count > 0 && count <= TL_TRIANGLE_BLOCK);
        ask->map(&map, cosf(0.785398f), &block);
        for (uint32_t lane = 0; lane < TL_TRIANGLE_BLOCK; lane++) {
            const uint32_t i = lane < count ? first + lane : first + count - 1; // the last one is repeated
            check_lane(l, &map, &block, lane, tl_triangle_list_get(list, i), seen);
        }
        first += count;
    }
    TEST_CHECK(first == list->count);
}

static void agrees_with_one_by_one(void **state)
{
    (void)state;
    level l;
    seen_slopes seen = { 0 };
    for (uint64_t seed = 1; seed <= 50; seed++) {
        make_level(&l, seed);
        const uint32_t some[] = { 5, 7, 7, TRIANGLES - 1, 0 };
        const tl_triangle_list all = { NULL, TRIANGLES }, few = { some, 5 };
        check_blocks(&l, &all, &tl_block_questions_scalar, &seen);
        check_blocks(&l, &all, tl_block_questions_best(), &seen);
        check_blocks(&l, &few, tl_block_questions_best(), &seen);
    }
    TEST_CHECK(seen.steep > 1000 && seen.walkable > 1000 && seen.undecided > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_one_by_one) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
